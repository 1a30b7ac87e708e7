// compare/calibrate: contacts of grains from virtual element tests.
#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>

#include "compare/experiments/element_experiments.hpp"
#include "compare/report/result_json.hpp"
#include "notebooks/bindings/bindings.hpp"
#include "scenario/errors.hpp"

namespace soilbin::python {
namespace {

using compare::CalibrationProgress;
using compare::CalibrationRun;
using compare::Candidate;
using compare::ContactKind;
using compare::ContactQuestion;
using compare::VarianceRow;
using compare::VirtualTest;

/// Question and answer.
struct ToldCalibration {
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
struct ToldRun {
  std::string stage;
  std::uint64_t seed;
  ByName<double> values;
  ByName<Estimate> results;
  std::string error;
  double seconds;
  bool from_store;
};
struct ToldCandidate {
  ByName<double> values;
  ByName<Estimate> predicted;
  double chi_square, chance;
  int runs;
};
struct ToldRow {
  VarianceRow row;
  std::vector<double> level_means{};
  double range = std::numeric_limits<double>::quiet_NaN();
};

std::vector<ToldRun> runs_of(const ToldCalibration& told) {
  std::vector<ToldRun> out;
  for (const CalibrationRun& run : told.found.runs) {
    const compare::Experiment& e = run.experiment;
    out.push_back({compare::stage_name(run.stage), e.seed, by_name(told.test.factors, e.values),
                   by_name(told.test.targets, e.results), e.error, e.seconds, run.from_store});
  }
  return out;
}

ToldCandidate named(const ToldCalibration& told, const Candidate& c) {
  return {by_name(told.test.factors, c.values), by_name(told.test.targets, c.predicted), c.chi_square, c.chance,
          c.runs};
}

std::vector<ToldCandidate> candidates_of(const ToldCalibration& told) {
  std::vector<ToldCandidate> out;
  for (const Candidate& candidate : told.found.candidates) out.push_back(named(told, candidate));
  return out;
}

/// Rows of each target: factors with their range analysis, then what is left.
ByName<std::vector<ToldRow>> variance_of(const ToldCalibration& told) {
  ByName<std::vector<ToldRow>> out;
  for (std::size_t t = 0; t < told.found.analyses.size(); ++t) {
    const compare::TargetAnalysis& analysis = told.found.analyses[t];
    std::vector<ToldRow>& rows = out[told.test.targets[t].name];
    for (std::size_t j = 0; j < analysis.variance.factors.size(); ++j)
      rows.push_back(
          {analysis.variance.factors[j], analysis.ranges.factors[j].means, analysis.ranges.factors[j].range});
    if (analysis.variance.left.freedom > 0) rows.push_back({analysis.variance.left});
  }
  return out;
}

py::array_t<double> copied(const Eigen::VectorXd& values) { return py::array_t<double>(values.size(), values.data()); }

py::dict left_out_of(const ToldCalibration& told) {
  py::dict out;
  for (std::size_t t = 0; t < told.found.held_out.size(); ++t) {
    const compare::LeaveOneOut& test = told.found.held_out[t];
    out[told.test.targets[t].name.c_str()] = dict_of(
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

std::vector<compare::Factor> factors_of(ContactKind kind, const Bounds& vary, const std::vector<std::string>& keep) {
  std::vector<compare::Factor> factors = compare::usual_factors(kind);
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
ToldCalibration calibrate(const Soil& soil, ContactQuestion question, compare::CalibrationOptions options,
                          const std::filesystem::path& store, const py::object& progress) {
  Watch watch(progress);
  CalibrationProgress at{compare::Stage::design, 0, options.most_runs, 0, 0};
  const auto tell = [&](double share, std::string_view doing) {
    watch((at.done + share) / std::max(1, at.at_most),
          fmt::format("{}, run {} of at most {}{}", compare::stage_name(at.stage), at.done + 1, at.at_most, doing));
  };
  question.how.progress = [&](const dem::Progress& p) { tell(std::min(p.done, 0.999), fmt::format(", {}", p.stage)); };
  options.progress = [&](const CalibrationProgress& now) { at = now, tell(0, ""); };
  ToldCalibration told{soil, question.kind, compare::contact_test(soil, question), options, {}};
  unlocked([&] {
    compare::ExperimentStore kept(store);
    told.found = compare::calibrate(told.test, options, kept);
  });
  told.test.run = nullptr, told.options.progress = nullptr;
  return told;
}

void bind_calibration_parts(py::module_& module) {
  py::class_<ToldRun>(module, "CalibrationRun", "One experiment of a calibration. SI.")
      .def_readonly("stage", &ToldRun::stage, "'design', 'candidates' or 'refinement'")
      .def_readonly("seed", &ToldRun::seed, "of its packings")
      .def_readonly("values", &ToldRun::values, "of the factors")
      .def_readonly("results", &ToldRun::results, "of the targets; empty where it failed")
      .def_readonly("error", &ToldRun::error, "why it failed")
      .def_readonly("seconds", &ToldRun::seconds, "that it took on the clock on the wall")
      .def_readonly("from_store", &ToldRun::from_store, "whether it had been made before");
  py::class_<ToldCandidate>(module, "CalibrationCandidate", "A point between the bounds, and what is known of it. SI.")
      .def_readonly("values", &ToldCandidate::values, "of the factors")
      .def_readonly("predicted", &ToldCandidate::predicted, "of the targets, by the surrogates of all runs")
      .def_readonly("chi_square", &ToldCandidate::chi_square,
                    "sum over targets of (predicted - measured)^2/(both errors squared)")
      .def_readonly("chance", &ToldCandidate::chance, "that every target is met within the share asked for [-]")
      .def_readonly("runs", &ToldCandidate::runs, "made at this very point");
  const auto of = [](auto member) { return [member](const ToldRow& r) { return r.row.*member; }; };
  py::class_<ToldRow>(module, "VarianceRow", "A factor in the analyses of an orthogonal design; or what none explains.")
      .def_property_readonly("source", of(&VarianceRow::source), "the factor's name")
      .def_readonly("range", &ToldRow::range, "R: largest level mean less smallest [SI]; NaN of what is left")
      .def_readonly("level_means", &ToldRow::level_means, "k_i: mean of the runs at each level [SI]")
      .def_property_readonly("sum_of_squares", of(&VarianceRow::sum_of_squares), "about the mean [SI, squared]")
      .def_property_readonly("freedom", of(&VarianceRow::freedom), "degrees of it")
      .def_property_readonly("mean_square", of(&VarianceRow::mean_square), "[SI, squared]")
      .def_property_readonly("f", of(&VarianceRow::f), "mean square over the error's; NaN where it is the error")
      .def_property_readonly("p_value", of(&VarianceRow::p_value), "of so large an F by chance; NaN as f")
      .def_property_readonly("pooled", of(&VarianceRow::pooled), "whether it was taken for error");
}

Bounds bounds_of(const ToldCalibration& told) {
  Bounds out;
  for (const compare::Factor& factor : told.test.factors) out[factor.name] = {factor.lower, factor.upper};
  return out;
}

Targets measured_of(const ToldCalibration& told) {
  Targets out;
  for (const compare::Target& target : told.test.targets) out[target.name] = target.measured;
  return out;
}

void bind_calibration_answer(py::module_& module) {
  using C = ToldCalibration;
  py::class_<C>(module, "Calibration",
                "What a calibration found (docs/calibration.md). SI; by names of factors, targets.")
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
          "told", [](const C& c) { return by_name(c.test.factors, c.found.told); },
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

}  // namespace

void bind_calibration(py::module_& module) {
  bind_calibration_parts(module);
  bind_calibration_answer(module);
  const compare::CalibrationOptions usual;
  module.def(
      "calibrate",
      [](const Soil& soil, const std::string& contact, const std::optional<Targets>& targets, const Bounds& vary,
         const std::vector<std::string>& keep, const std::string& design, int runs, double near, double within,
         double probability, const std::string& strength, const std::vector<double>& stresses, double settling_friction,
         int across, int packings, std::uint64_t seed, int threads, const std::optional<std::filesystem::path>& store,
         const py::object& progress) {
        ContactQuestion question;
        question.kind = kind_of(contact);
        question.factors = factors_of(question.kind, vary, keep);
        question.targets = targets_of(soil, question.kind, targets);
        if (strength != "peak" && strength != "residual") throw InputError("strength: 'peak' or 'residual'");
        question.strength = strength == "peak" ? compare::Strength::peak : compare::Strength::residual;
        question.stresses = stresses, question.settling_friction = settling_friction, question.across = across;
        question.packings = packings, question.how.threads = threads;
        compare::CalibrationOptions options;
        options.design = design, options.most_runs = runs, options.near = near, options.within = within;
        options.probability = probability, options.seed = seed;
        return calibrate(soil, std::move(question), std::move(options), store.value_or(""), progress);
      },
      py::arg("soil"), py::arg("contact") = "sand", py::arg("targets") = py::none(), py::arg("vary") = Bounds{},
      py::arg("keep") = std::vector<std::string>{}, py::arg("design") = usual.design, py::arg("runs") = usual.most_runs,
      py::arg("near") = usual.near, py::arg("within") = usual.within, py::arg("probability") = usual.probability,
      py::arg("strength") = "peak", py::arg("stresses") = ContactQuestion{}.stresses,
      py::arg("settling_friction") = 1.0, py::arg("across") = 16, py::arg("packings") = 0, py::arg("seed") = usual.seed,
      py::arg("threads") = 0, py::arg("store") = py::none(), py::arg("progress") = py::none(),
      "Contacts of grains from virtual tests: soilbin.compare.calibrate tells the arguments. Raises InputError for a "
      "question that makes no sense, NoSolution where too many experiments fail to learn from the rest.");
}

}  // namespace soilbin::python
