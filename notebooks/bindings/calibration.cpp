// compare/calibrate: contacts of grains from virtual element tests.
#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>

#include "compare/experiments/element_experiments.hpp"
#include "compare/sweep/result_json.hpp"
#include "compare/telling/calibration_report.hpp"
#include "notebooks/bindings/keywords.hpp"
#include "scenario/errors.hpp"

namespace soilbin::python {
namespace {

using compare::CalibrationRun;
using compare::Candidate;
using compare::ContactKind;
using compare::ContactQuestion;
using compare::VarianceRow;
using compare::VirtualTest;

/// Question and answer.
struct NamedCalibration {
  Soil soil;
  ContactKind kind = ContactKind::grain_grain;
  VirtualTest test;
  compare::CalibrationOptions options;
  compare::Calibration found;
};

template <class Value>
using ByName = std::map<std::string, Value>;

/// Values by the names of what they belong to: of factors or targets.
template <class Named>
ByName<double> by_name(const std::vector<Named>& named, const Eigen::VectorXd& values) {
  ByName<double> out;
  for (std::size_t k = 0; k < named.size(); ++k) out[named[k].name] = values[static_cast<Eigen::Index>(k)];
  return out;
}
template <class Named, class Value>
ByName<Value> by_name(const std::vector<Named>& named, const std::vector<Value>& values) {
  ByName<Value> out;
  for (std::size_t k = 0; k < named.size() && k < values.size(); ++k) out[named[k].name] = values[k];
  return out;
}

/// The library's values with their names.
struct NamedRun {
  std::string stage;
  std::uint64_t seed;
  ByName<double> values;
  ByName<Estimate> results;
  std::string error;
  double seconds;
  bool from_store;
};
struct NamedCandidate {
  ByName<double> values;
  ByName<Estimate> predicted;
  double chi_square, chance;
  int runs;
};
struct NamedRow {
  VarianceRow row;
  std::vector<double> level_means{};
  double range = std::numeric_limits<double>::quiet_NaN();
};

std::vector<NamedRun> runs_of(const NamedCalibration& answer) {
  std::vector<NamedRun> out;
  for (const CalibrationRun& run : answer.found.runs) {
    const compare::Experiment& e = run.experiment;
    out.push_back({compare::stage_name(run.stage), e.seed, by_name(answer.test.factors, e.values),
                   by_name(answer.test.targets, e.results), e.error, e.seconds, e.from_store});
  }
  return out;
}

NamedCandidate named(const NamedCalibration& answer, const Candidate& c) {
  return {by_name(answer.test.factors, c.values), by_name(answer.test.targets, c.predicted), c.chi_square, c.chance,
          c.runs};
}

std::vector<NamedCandidate> candidates_of(const NamedCalibration& answer) {
  std::vector<NamedCandidate> out;
  for (const Candidate& candidate : answer.found.candidates) out.push_back(named(answer, candidate));
  return out;
}

/// Rows of each target: factors with their range analysis, then what is left.
ByName<std::vector<NamedRow>> variance_of(const NamedCalibration& answer) {
  ByName<std::vector<NamedRow>> out;
  for (std::size_t t = 0; t < answer.found.analyses.size(); ++t) {
    const compare::TargetAnalysis& analysis = answer.found.analyses[t];
    std::vector<NamedRow>& rows = out[answer.test.targets[t].name];
    for (std::size_t j = 0; j < analysis.variance.factors.size(); ++j)
      rows.push_back(
          {analysis.variance.factors[j], analysis.ranges.factors[j].means, analysis.ranges.factors[j].range});
    if (analysis.variance.left.freedom > 0) rows.push_back({analysis.variance.left});
  }
  return out;
}

py::array_t<double> copied(const Eigen::VectorXd& values) { return py::array_t<double>(values.size(), values.data()); }

py::dict left_out_of(const NamedCalibration& answer) {
  py::dict out;
  for (std::size_t t = 0; t < answer.found.held_out.size(); ++t) {
    const compare::LeaveOneOut& test = answer.found.held_out[t];
    out[answer.test.targets[t].name.c_str()] = dict_of(
        {{"residual", copied(test.residual)}, {"sd", copied(test.sd)}, {"standardised", copied(test.standardised)}});
  }
  return out;
}

ContactKind kind_of(const std::string& contact) {
  if (contact == "sand") return ContactKind::grain_grain;
  if (contact == "tire") return ContactKind::grain_tire;
  throw InputError("contact: 'sand' or 'tire', not '" + contact + "'");
}

using Targets = std::map<std::string, Estimate>;
using Bounds = std::map<std::string, std::pair<double, double>>;

std::vector<compare::Target> targets_of(const Soil& soil, ContactKind kind, const std::optional<Targets>& asked) {
  if (!asked) return compare::targets_of(soil, kind);
  std::vector<compare::Target> targets;
  const std::vector<std::string> right = compare::target_names(kind);
  for (const auto& [name, measured] : *asked) {
    if (std::find(right.begin(), right.end(), name) == right.end())
      throw InputError("targets: '" + name + "' is none of this contact's");
    targets.push_back({name, measured, compare::unit_of_target(name)});
  }
  return targets;
}

std::vector<compare::Factor> factors_of(ContactKind kind, const GranularSoil& soil, const Bounds& vary,
                                        const std::vector<std::string>& keep) {
  std::vector<compare::Factor> factors = compare::usual_factors(kind, soil);
  const auto called = [&](const std::string& name) {
    const auto found = std::find_if(factors.begin(), factors.end(), [&](const auto& f) { return f.name == name; });
    if (found == factors.end()) throw InputError("'" + name + "' is no number of this contact that is varied");
    return found;
  };
  for (const auto& [name, bounds] : vary) {
    if (!(0 <= bounds.first && bounds.first < bounds.second))
      throw InputError("vary: the bounds of '" + name + "' must rise from 0 or more");
    called(name)->lower = bounds.first, called(name)->upper = bounds.second;
  }
  for (const std::string& name : keep) factors.erase(called(name));
  return factors;
}

/// Calibrates; tells progress over all runs that there may be.
NamedCalibration calibrate(const Soil& soil, ContactQuestion question, compare::CalibrationOptions options,
                           const std::filesystem::path& store, const py::object& progress) {
  Watch watch(progress);
  std::string run;
  double done = 0;
  const auto tell = [&](double share, const std::string& doing) {
    watch(done + share / options.most_runs, run + doing);
  };
  question.how.progress = [&](const dem::Progress& p) { tell(std::min(p.done, 0.999), fmt::format(", {}", p.stage)); };
  options.watch = [&](const dem::Progress& now) { run = now.stage, done = now.done, tell(0, ""); };
  NamedCalibration answer{soil, question.kind, compare::contact_test(soil, question), options, {}};
  unlocked([&] {
    compare::ExperimentStore kept(store);
    answer.found = compare::calibrate(answer.test, options, kept);
  });
  answer.test.run = nullptr, answer.options.watch = nullptr;
  return answer;
}

void bind_calibration_parts(py::module_& module) {
  py::class_<NamedRun>(module, "CalibrationRun", "One experiment of a calibration. SI.")
      .def_readonly("stage", &NamedRun::stage, "'design', 'candidates' or 'refinement'")
      .def_readonly("seed", &NamedRun::seed, "of its packings")
      .def_readonly("values", &NamedRun::values, "of the factors")
      .def_readonly("results", &NamedRun::results, "of the targets; empty where it failed")
      .def_readonly("error", &NamedRun::error, "why it failed")
      .def_readonly("seconds", &NamedRun::seconds, "that it took on the clock on the wall")
      .def_readonly("from_store", &NamedRun::from_store, "whether it had been made before");
  py::class_<NamedCandidate>(module, "CalibrationCandidate", "A point between the bounds, and what is known of it. SI.")
      .def_readonly("values", &NamedCandidate::values, "of the factors")
      .def_readonly("predicted", &NamedCandidate::predicted, "of the targets, by the surrogates of all runs")
      .def_readonly("chi_square", &NamedCandidate::chi_square,
                    "sum over targets of (predicted - measured)^2/(both errors squared)")
      .def_readonly("chance", &NamedCandidate::chance, "that every target is met within the share asked for [-]")
      .def_readonly("runs", &NamedCandidate::runs, "made at this very point");
  const auto of = [](auto member) { return [member](const NamedRow& r) { return r.row.*member; }; };
  py::class_<NamedRow>(module, "VarianceRow",
                       "A factor in the analyses of an orthogonal design; or what none explains.")
      .def_property_readonly("source", of(&VarianceRow::source), "the factor's name")
      .def_readonly("range", &NamedRow::range, "R: largest level mean less smallest [SI]; NaN of what is left")
      .def_readonly("level_means", &NamedRow::level_means, "k_i: mean of the runs at each level [SI]")
      .def_property_readonly("sum_of_squares", of(&VarianceRow::sum_of_squares), "about the mean [SI, squared]")
      .def_property_readonly("freedom", of(&VarianceRow::freedom), "degrees of it")
      .def_property_readonly("mean_square", of(&VarianceRow::mean_square), "[SI, squared]")
      .def_property_readonly("f", of(&VarianceRow::f), "mean square over the error's; NaN where it is the error")
      .def_property_readonly("p_value", of(&VarianceRow::p_value), "of so large an F by chance; NaN as f")
      .def_property_readonly("pooled", of(&VarianceRow::pooled), "whether it was taken for error");
}

Bounds bounds_of(const NamedCalibration& answer) {
  Bounds out;
  for (const compare::Factor& factor : answer.test.factors) out[factor.name] = {factor.lower, factor.upper};
  return out;
}

Targets measured_of(const NamedCalibration& answer) {
  Targets out;
  for (const compare::Target& target : answer.test.targets) out[target.name] = target.measured;
  return out;
}

void bind_calibration_answer(py::module_& module) {
  using C = NamedCalibration;
  py::class_<C>(module, "Calibration",
                "What a calibration found (docs/theory/calibration.md). SI; by names of factors, targets.")
      .def_property_readonly("targets", &measured_of, "what was to be reached")
      .def_property_readonly("factors", &bounds_of, "lower and upper bound of what was varied")
      .def_property_readonly("runs", &runs_of, "every experiment, in order")
      .def_property_readonly("variance", &variance_of,
                             "of each target, the orthogonal design's range analysis and analysis of variance; empty "
                             "where a run of the design failed")
      .def_property_readonly("left_out", &left_out_of,
                             "of each target, the surrogate at each run from all others, arrays: residual, sd [SI], "
                             "standardised [-]")
      .def_property_readonly("candidates", &candidates_of, "run, and predicted near every target, the likeliest first")
      .def_property_readonly(
          "best", [](const C& c) { return named(c, c.found.best); }, "the one that is chosen")
      .def_property_readonly(
          "reached", [](const C& c) { return c.found.reached; },
          "whether best's chance is at least the probability asked for")
      .def_property_readonly(
          "parameters", [](const C& c) { return by_name(c.test.factors, c.found.parameters); },
          "of the factors, given the targets and a flat prior between the bounds")
      .def_property_readonly(
          "told", [](const C& c) { return by_name(c.test.factors, c.found.learned); },
          "1 - sd of parameters over that of the flat prior; 0: the test says nothing of it [-]")
      .def_property_readonly(
          "sentences", [](const C& c) { return compare::calibration_sentences(c.test, c.options, c.found); },
          "the verdict and what stands behind it, in plain words")
      .def(
          "soil", [](const C& c) { return compare::calibrated_soil(c.soil, c.kind, c.test, c.options, c.found); },
          "The soil with best's values in the contact; its sources say where they come from.")
      .def(
          "json", [](const C& c) { return compare::json_text(compare::to_json(c.test, c.options, c.found)); },
          "soilbin-calibration/1")
      .def("__repr__", [](const C& c) {
        return fmt::format("Calibration({} runs, {})", c.found.runs.size(),
                           c.found.reached ? "reached" : "not reached");
      });
}

/// What Python asks of a calibration, member by member a keyword argument.
struct CalibrationQuestion {
  std::string contact = "sand";
  std::optional<Targets> targets;
  Bounds vary;
  std::vector<std::string> keep;
  std::string test = "triaxial", strength = "peak";
  std::optional<std::filesystem::path> store;
  ContactQuestion contact_test;  ///< stresses, settling friction, grains across, packings
  compare::CalibrationOptions options;
};

}  // namespace

void bind_calibration(py::module_& module) {
  bind_calibration_parts(module);
  bind_calibration_answer(module);
  using Q = CalibrationQuestion;
  using Options = compare::CalibrationOptions;
  const auto run = [](const Soil& soil, const Q& asked, int threads, const py::object& progress) {
    ContactQuestion question = asked.contact_test;
    question.kind = kind_of(asked.contact);
    question.factors = factors_of(question.kind, grains_of(soil), asked.vary, asked.keep);
    question.targets = targets_of(soil, question.kind, asked.targets);
    if (asked.test != "triaxial" && asked.test != "direct-shear")
      throw InputError("test: 'triaxial' or 'direct-shear'");
    question.test = asked.test == "triaxial" ? compare::SandTest::triaxial : compare::SandTest::direct_shear;
    if (asked.strength != "peak" && asked.strength != "residual") throw InputError("strength: 'peak' or 'residual'");
    question.strength = asked.strength == "peak" ? compare::Strength::peak : compare::Strength::residual;
    question.how.threads = threads;
    return calibrate(soil, std::move(question), asked.options, asked.store.value_or(""), progress);
  };
  def_with_settings<Soil, Q>(
      module, "calibrate", run,
      "Contacts of grains from virtual tests: soilbin.compare.calibrate tells the arguments. Raises InputError for a "
      "question that makes no sense, NoSolution where too many experiments fail to learn from the rest.",
      keyword("contact", &Q::contact), keyword("targets", &Q::targets), keyword("vary", &Q::vary),
      keyword("keep", &Q::keep), keyword("design", &Q::options, &Options::design),
      keyword("runs", &Q::options, &Options::most_runs), keyword("near", &Q::options, &Options::near),
      keyword("within", &Q::options, &Options::within), keyword("probability", &Q::options, &Options::probability),
      keyword("test", &Q::test), keyword("strength", &Q::strength),
      keyword("stresses", &Q::contact_test, &ContactQuestion::stresses),
      keyword("settling_friction", &Q::contact_test, &ContactQuestion::settling_friction),
      keyword("across", &Q::contact_test, &ContactQuestion::across),
      keyword("packings", &Q::contact_test, &ContactQuestion::packings), keyword("seed", &Q::options, &Options::seed),
      keyword("store", &Q::store));
}

}  // namespace soilbin::python
