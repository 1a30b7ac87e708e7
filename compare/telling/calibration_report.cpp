#include "compare/telling/calibration_report.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "bekker_wong/gsl.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/report/number_text.hpp"
#include "compare/sweep/result_json.hpp"
#include "compare/sweep/varying.hpp"
#include "scenario/nearest_word.hpp"

namespace soilbin::compare {
namespace {

constexpr OfChannels<const char*> wholes = {"W", "W r", "r", "W"};

bool is_measured(const Decision& decision, std::size_t channel) {
  for (const Setpoint& setpoint : decision.setpoints)
    if (setpoint.measured[channel]) return true;
  return false;
}

bool has_reruns(const Decision& decision) {
  for (const Setpoint& setpoint : decision.setpoints)
    for (const std::optional<Estimate>& measured : setpoint.measured)
      if (measured && measured->std_error > 0) return true;
  return false;
}

std::vector<std::string> tied_names(const Decision& decision, std::size_t but) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < decision.trials.size(); ++k)
    if (k != but && decision.trials[k].error && !decision.trials[k].apart) names.push_back(candidate_name(k));
  return names;
}

std::string error_text(const Estimate& error) { return number(error, 100) + " %"; }

std::string failure_of(const Trial& trial) {
  for (const Answer& answer : trial.answers)
    if (!answer.result) return fmt::format("at {}: {}", in_words(answer.at), answer.error);
  return "";
}

std::string verdict(const Decision& decision, std::size_t candidate) {
  const Trial& trial = decision.trials[candidate];
  if (!trial.error) return failure_of(trial);
  if (candidate == decision.chosen) return "chosen";
  if (trial.apart) return "farther off";
  return candidate == decision.nearest ? "nearest, not told apart" : "not told apart";
}

Json by_channel(const OfChannels<std::optional<Estimate>>& values) {
  Json json = Json::object();
  for (std::size_t c = 0; c < values.size(); ++c)
    if (values[c]) json[std::string(channel_views[c].name)] = estimate_json(*values[c]);
  return json;
}

Json json_of(const Trial& trial) {
  return {{"error", or_null(trial.error)},
          {"errors", by_channel(trial.errors)},
          {"apart", trial.apart},
          {"answers", list_of(trial.answers, [](const Answer& answer) { return to_json(answer); })}};
}

}  // namespace

std::vector<std::string> decision_sentences(const Decision& decision) {
  if (!decision.decided())
    return {
        fmt::format("In the soil bin no candidate had a result at all {} setpoints of {}: the likeliest is kept. {}.",
                    decision.setpoints.size(), decision.campaign, failure_of(decision.trials.front()))};
  std::vector<std::string> said;
  said.push_back(fmt::format("In the soil bin {} is nearest to {}: {} of the load off, over {}.",
                             candidate_name(decision.nearest), decision.campaign,
                             error_text(*decision.trials[decision.nearest].error),
                             counted(decision.setpoints.size(), "setpoint")));
  if (decision.tied() > 1)
    said.push_back(fmt::format(
        "It does not differ from {} by two standard errors: {}, the likeliest of these on the targets, is chosen.",
        listed(tied_names(decision, decision.nearest)), candidate_name(decision.chosen)));
  if (!has_reruns(decision))
    said.push_back(
        fmt::format("{} repeats no setpoint: its own scatter is not known and counts as none.", decision.campaign));
  if (decision.not_steady > 0)
    said.push_back(fmt::format("{} of the {} runs did not become steady.", decision.not_steady, decision.runs));
  return said;
}

std::vector<std::string> decision_columns(const Decision& decision) {
  std::vector<std::string> header;
  for (std::size_t c = 0; c < channel_views.size(); ++c)
    if (is_measured(decision, c)) header.push_back(fmt::format("{} off [% {}]", channel_views[c].title, wholes[c]));
  header.insert(header.end(), {"off [%]", "soil bin"});
  return header;
}

std::vector<std::string> decision_cells(const Decision& decision, std::size_t candidate) {
  const Trial& trial = decision.trials[candidate];
  std::vector<std::string> row;
  for (std::size_t c = 0; c < channel_views.size(); ++c)
    if (is_measured(decision, c)) row.push_back(trial.errors[c] ? number(*trial.errors[c], 100) : "-");
  row.push_back(trial.error ? number(*trial.error, 100) : "-");
  row.push_back(verdict(decision, candidate));
  return row;
}

nlohmann::ordered_json to_json(const Decision& decision) {
  const Json setpoints = list_of(decision.setpoints, [](const Setpoint& one) {
    return Json{{"at", to_json(one.at)}, {"runs", one.runs}, {"measured", by_channel(one.measured)}};
  });
  const Json trials = list_of(decision.trials, [](const Trial& trial) { return json_of(trial); });
  return {{"campaign", decision.campaign},     {"decided", decision.decided()}, {"nearest", decision.nearest},
          {"chosen", decision.chosen},         {"tied", decision.tied()},       {"runs", decision.runs},
          {"not_steady", decision.not_steady}, {"setpoints", setpoints},        {"trials", trials}};
}

namespace {

/// Where the error of an analysis of variance comes from.
std::string error_of_analysis(const AnalysisOfVariance& analysis) {
  switch (analysis.error_from) {
    case ErrorFrom::known_noise:
      return "Error: the runs' own standard errors. What is left over beyond them is interactions of factors.";
    case ErrorFrom::free_columns:
      return fmt::format("Error: the columns without a factor, {} degrees of freedom; interactions are in it.",
                         analysis.left.freedom);
    case ErrorFrom::pooled_factors:
      break;
  }
  std::string names;
  for (const VarianceRow& row : analysis.factors)
    if (row.pooled) names += (names.empty() ? "" : ", ") + row.source;
  return "Error: no column is free, so the weakest factors are pooled (" + names + "); the p-values are too small.";
}

std::string value_with_unit(const Estimate& value, const std::string& unit) {
  return number(value, per_unit(unit)) + unit_behind(unit);
}

std::string off_in_words(const Target& target, double off) {
  return target.tolerance ? fmt::format("{:+.1f} tolerances", off / *target.tolerance)
                          : fmt::format("{:+.1f} %", 100 * off / target.measured.value);
}

std::string misses(const VirtualTest& test, const Candidate& candidate) {
  std::string text;
  for (std::size_t t = 0; t < test.targets.size(); ++t) {
    const Target& target = test.targets[t];
    const double off = candidate.predicted[t].value - target.measured.value;
    text += fmt::format("{}{} {} for {} ({})", t == 0 ? "" : ", ", target.name,
                        value_with_unit(candidate.predicted[t], target.unit),
                        value_with_unit({target.measured.value, 0}, target.unit), off_in_words(target, off));
  }
  return text;
}

std::string values_in_words(const VirtualTest& test, const Eigen::VectorXd& values) {
  std::string text;
  for (std::size_t j = 0; j < test.factors.size(); ++j)
    text += fmt::format("{}{} {}", j == 0 ? "" : ", ", test.factors[j].name,
                        value_with_unit({values[j], 0}, test.factors[j].unit));
  return text;
}

int fresh_runs(const Calibration& calibration) {
  int fresh = 0;
  for (const CalibrationRun& run : calibration.runs) fresh += !run.experiment.from_store;
  return fresh;
}

/// Chance of so large a chi square, a target a degree of freedom, below which the targets are out of reach.
constexpr double unlikely = 0.003;

/// So many targets are told in a table, fewer in a sentence.
constexpr std::size_t many_targets = 4;

/// How near every target has to come.
std::string nearness(const VirtualTest& test, const CalibrationOptions& options) {
  const auto own =
      std::ranges::count_if(test.targets, [](const Target& target) { return target.tolerance.has_value(); });
  if (own == 0) return percent(options.within);
  return static_cast<std::size_t>(own) == test.targets.size() ? "its tolerance"
                                                              : percent(options.within) + " or its tolerance";
}

/// Pairs of factors that the targets determine only together.
std::vector<std::string> sentences_on_correlations(const VirtualTest& test, const Calibration& calibration) {
  constexpr double strong = 0.7;
  std::vector<std::string> said;
  for (Eigen::Index i = 0; i < calibration.correlations.rows(); ++i)
    for (Eigen::Index j = i + 1; j < calibration.correlations.cols(); ++j)
      if (const double r = calibration.correlations(i, j); std::abs(r) >= strong)
        said.push_back(fmt::format("The targets determine {} and {} only together: their correlation is {:.2f}.",
                                   test.factors[static_cast<std::size_t>(i)].name,
                                   test.factors[static_cast<std::size_t>(j)].name, r));
  return said;
}

/// The density that a calibration found belongs to the bed and not to the soil's file.
std::vector<std::string> sentences_on_settling(const VirtualTest& test, const Calibration& calibration) {
  const auto factor = std::ranges::find(test.factors, settling_friction_factor, &Factor::name);
  if (factor == test.factors.end()) return {};
  return {fmt::format("Beds of this density settle with --settling-friction {:.2f}.",
                      calibration.best.values[factor - test.factors.begin()])};
}

std::string order_sentence(const VirtualTest& test, const Calibration& calibration, std::size_t target) {
  const TargetAnalysis& analysis = calibration.analyses[target];
  std::string order;
  for (const int j : analysis.ranges.order)
    order += fmt::format("{}{} (R {})", order.empty() ? "" : " > ", test.factors[j].name,
                         value_with_unit({analysis.ranges.factors[j].range, 0}, test.targets[target].unit));
  return fmt::format("On {}: {}.", test.targets[target].name, order);
}

std::vector<std::string> sentences_on_decision(const CalibrationOptions& options, const Calibration& calibration) {
  if (calibration.decision) return decision_sentences(*calibration.decision);
  if (!options.decide) return {};
  return {fmt::format("No point that was run is within {} of the targets: there were no candidates for the soil bin.",
                      percent(options.near))};
}

std::vector<std::string> columns_of(const VirtualTest& test) {
  std::vector<std::string> header;
  for (const Factor& factor : test.factors) header.push_back(heading(factor.name, factor.unit));
  for (const Target& target : test.targets) header.push_back(heading(target.name, target.unit));
  return header;
}

void add_cells(std::vector<TableCell>& row, const VirtualTest& test, const Eigen::VectorXd& values,
               const std::vector<Estimate>& results) {
  for (std::size_t j = 0; j < test.factors.size(); ++j)
    row.push_back(number(values[j] * per_unit(test.factors[j].unit)));
  for (std::size_t t = 0; t < test.targets.size(); ++t)
    row.push_back(results.empty() ? "-" : number(results[t], per_unit(test.targets[t].unit)));
}

/// The decision's part of a value's source.
std::string decided_by(const Calibration& calibration) {
  if (!calibration.decision || !calibration.decision->decided()) return "";
  const Decision& decision = *calibration.decision;
  if (const int tied = decision.tied(); tied > 1)
    return fmt::format("; the likeliest of {} candidates that the soil bin does not separate on {}", tied,
                       decision.campaign);
  return fmt::format("; of {} candidates the nearest to {} in the soil bin", decision.trials.size(), decision.campaign);
}

/// An error with its hint, for a cell of a table.
std::string on_one_line(std::string error) {
  for (std::size_t at; (at = error.find("\n  hint: ")) != std::string::npos;) error.replace(at, 9, "; hint: ");
  std::ranges::replace(error, '\n', ' ');
  return error;
}

}  // namespace

std::vector<std::string> calibration_sentences(const VirtualTest& test, const CalibrationOptions& options,
                                               const Calibration& calibration) {
  std::vector<std::string> said;
  const std::string chance = fmt::format("with probability {:.0f} %", 100 * calibration.best.chance);
  if (calibration.reached)
    said.push_back(fmt::format("Reached: every target within {} {}.", nearness(test, options), chance));
  else
    said.push_back(fmt::format("Not reached in {} runs: every target within {} only {}.", calibration.runs.size(),
                               nearness(test, options), chance));
  said.push_back("Chosen: " + values_in_words(test, calibration.best.values) + ".");
  if (test.targets.size() < many_targets) said.push_back("It gives " + misses(test, calibration.best) + ".");
  for (std::string& sentence : sentences_on_settling(test, calibration)) said.push_back(std::move(sentence));
  for (std::string& sentence : sentences_on_decision(options, calibration)) said.push_back(std::move(sentence));
  if (gsl::chi_square_tail(calibration.smallest_chi_square, static_cast<double>(test.targets.size())) < unlikely)
    said.push_back(
        fmt::format("Nowhere between the bounds are the targets met (chi square at least {:.1f}): widen them.",
                    calibration.smallest_chi_square));
  if (test.targets.size() < many_targets)
    for (std::size_t t = 0; t < calibration.analyses.size(); ++t) said.push_back(order_sentence(test, calibration, t));
  if (calibration.analyses.empty())
    said.push_back("A run of the design failed, so it has no range analysis; the surrogate learnt from the others.");
  else
    said.push_back(error_of_analysis(calibration.analyses[0].variance));
  for (std::size_t j = 0; j < test.factors.size(); ++j)
    if (calibration.learned[j] < 0.2)
      said.push_back(fmt::format("These targets hardly determine {}: {} is as good as the bounds.",
                                 test.factors[j].name,
                                 value_with_unit(calibration.parameters[j], test.factors[j].unit)));
  for (std::string& sentence : sentences_on_correlations(test, calibration)) said.push_back(std::move(sentence));
  said.push_back(fmt::format("{} runs, {} made now.", calibration.runs.size(), fresh_runs(calibration)));
  return said;
}

Table level_table(const VirtualTest& test, const Calibration& calibration, std::size_t target) {
  const TargetAnalysis& analysis = calibration.analyses.at(target);
  const double factor = per_unit(test.targets[target].unit);
  Table table{heading(test.targets[target].name, test.targets[target].unit), {"factor"}};
  for (std::size_t i = 0; i < analysis.ranges.factors[0].means.size(); ++i)
    table.header.push_back(fmt::format("k{}", i + 1));
  for (const char* name : {"R", "sum of squares", "F", "p"}) table.header.emplace_back(name);
  const auto variance_cells = [&](std::vector<TableCell>& row, const VarianceRow& from) {
    row.push_back(number(from.sum_of_squares * factor * factor));
    row.push_back(from.pooled ? "pooled" : number(from.f));
    row.push_back(from.pooled || !std::isfinite(from.p_value) ? "-" : fmt::format("{:.2g}", from.p_value));
  };
  for (std::size_t j = 0; j < test.factors.size(); ++j) {
    std::vector<TableCell> row{test.factors[j].name};
    for (const double k : analysis.ranges.factors[j].means) row.push_back(number(k * factor));
    row.push_back(number(analysis.ranges.factors[j].range * factor));
    variance_cells(row, analysis.variance.factors[j]);
    table.add(std::move(row));
  }
  if (analysis.variance.left.freedom > 0) {
    std::vector<TableCell> row{analysis.variance.left.source};
    row.resize(table.header.size() - 3);
    variance_cells(row, analysis.variance.left);
    table.add(std::move(row));
  }
  return table;
}

Table targets_table(const VirtualTest& test, const Calibration& calibration) {
  Table table{"Targets at the chosen point", {"", "measured", "grains", "off"}};
  for (std::size_t t = 0; t < test.targets.size(); ++t) {
    const Target& target = test.targets[t];
    const double per = per_unit(target.unit), off = calibration.best.predicted[t].value - target.measured.value;
    table.add({heading(target.name, target.unit), number(target.measured, per),
               number(calibration.best.predicted[t], per), off_in_words(target, off)});
  }
  return table;
}

Table allowed_table(const VirtualTest& test, const Calibration& calibration) {
  Table table{"What the targets alone allow", {"", "value", "bounds", "determined"}};
  for (const Factor& factor : test.factors) table.header.push_back("correlation with " + factor.name);
  for (std::size_t j = 0; j < test.factors.size(); ++j) {
    const Factor& factor = test.factors[j];
    const double per = per_unit(factor.unit);
    std::vector<TableCell> row{heading(factor.name, factor.unit), number(calibration.parameters[j], per),
                               number(factor.lower * per) + " to " + number(factor.upper * per),
                               percent(calibration.learned[j])};
    for (std::size_t k = 0; k < test.factors.size(); ++k)
      row.push_back(
          fmt::format("{:.2f}", calibration.correlations(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(k))));
    table.add(std::move(row));
  }
  return table;
}

Table runs_table(const VirtualTest& test, const Calibration& calibration) {
  Table table{"Runs", {"stage"}};
  for (std::string& name : columns_of(test)) table.header.push_back(std::move(name));
  table.header.emplace_back("failure");
  for (const CalibrationRun& run : calibration.runs) {
    std::vector<TableCell> row{stage_name(run.stage)};
    add_cells(row, test, run.experiment.values, run.experiment.results);
    row.push_back(on_one_line(run.experiment.error));
    table.add(std::move(row));
  }
  return table;
}

Table candidates_table(const VirtualTest& test, const Calibration& calibration) {
  Table table{"Candidates", {""}};
  for (std::string& name : columns_of(test)) table.header.push_back(std::move(name));
  for (const char* name : {"runs", "chi square", "chance"}) table.header.emplace_back(name);
  if (calibration.decision)
    for (std::string& name : decision_columns(*calibration.decision)) table.header.push_back(std::move(name));
  for (std::size_t k = 0; k < calibration.candidates.size(); ++k) {
    const Candidate& candidate = calibration.candidates[k];
    std::vector<TableCell> row{candidate_name(k)};
    add_cells(row, test, candidate.values, candidate.predicted);
    row.push_back(std::to_string(candidate.runs));
    row.push_back(number(candidate.chi_square));
    row.push_back(percent(candidate.chance));
    if (calibration.decision)
      for (std::string& cell : decision_cells(*calibration.decision, k)) row.push_back(std::move(cell));
    table.add(std::move(row));
  }
  return table;
}

Soil calibrated_soil(Soil soil, ContactKind kind, const VirtualTest& test, const CalibrationOptions& options,
                     const Calibration& calibration) {
  GranularSoil& grains = soil.granular.value();
  put_values(grains, kind, test.factors, calibration.best.values);
  for (std::size_t j = 0; j < test.factors.size(); ++j) {
    const Factor& factor = test.factors[j];
    if (factor.name == settling_friction_factor) continue;
    const std::string key = factor.name == "youngs_modulus" ? factor.name : key_of(kind) + "." + factor.name;
    grains.sources[key] = fmt::format("calibrated by soilbin calibrate ({}, {} runs): {}; the targets alone allow {}{}",
                                      options.design, calibration.runs.size(), misses(test, calibration.best),
                                      value_with_unit(calibration.parameters[j], factor.unit), decided_by(calibration));
  }
  return soil;
}

// A calibration as JSON.

namespace {

Json values_json(const VirtualTest& test, const Eigen::VectorXd& values) {
  Json json = Json::object();
  for (std::size_t j = 0; j < test.factors.size(); ++j) json[test.factors[j].name] = values[j];
  return json;
}

Json results_json(const VirtualTest& test, const std::vector<Estimate>& results) {
  Json json = Json::object();
  for (std::size_t t = 0; t < results.size(); ++t) json[test.targets[t].name] = estimate_json(results[t]);
  return json;
}

Json json_of(const VirtualTest& test, const Candidate& candidate) {
  return {{"values", values_json(test, candidate.values)},
          {"predicted", results_json(test, candidate.predicted)},
          {"chi_square", finite(candidate.chi_square)},
          {"chance", candidate.chance},
          {"runs", candidate.runs}};
}

Json json_of(const VarianceRow& row) {
  return {{"source", row.source},   {"sum_of_squares", row.sum_of_squares},
          {"freedom", row.freedom}, {"pooled", row.pooled},
          {"f", finite(row.f)},     {"p_value", finite(row.p_value)}};
}

Json analysis_json(const VirtualTest& test, const TargetAnalysis& analysis) {
  Json ranges = Json::array(), rows = Json::array(), order = Json::array();
  for (std::size_t j = 0; j < test.factors.size(); ++j) {
    const FactorRange& factor = analysis.ranges.factors[j];
    ranges.push_back({{"factor", test.factors[j].name}, {"K", factor.sums}, {"k", factor.means}, {"R", factor.range}});
    rows.push_back(json_of(analysis.variance.factors[j]));
  }
  for (const int j : analysis.ranges.order) order.push_back(test.factors[j].name);
  if (analysis.variance.left.freedom > 0) rows.push_back(json_of(analysis.variance.left));
  return {{"ranges", ranges},
          {"order", order},
          {"variance", rows},
          {"total", analysis.variance.total},
          {"error", error_of_analysis(analysis.variance)}};
}

Json runs_json(const VirtualTest& test, const Calibration& calibration) {
  Json runs = Json::array();
  for (const CalibrationRun& run : calibration.runs) {
    Json json{{"stage", stage_name(run.stage)},    {"values", values_json(test, run.experiment.values)},
              {"seed", run.experiment.seed},       {"results", results_json(test, run.experiment.results)},
              {"seconds", run.experiment.seconds}, {"from_store", run.experiment.from_store}};
    if (!run.experiment.error.empty()) json["error"] = run.experiment.error;
    runs.push_back(std::move(json));
  }
  return runs;
}

}  // namespace

Table beside_table(const VirtualTest& test, const std::vector<PublishedSet>& sets) {
  Table table{"Published beside ours", {"set"}};
  for (const Factor& factor : test.factors) table.header.push_back(heading(factor.name, factor.unit));
  for (const Target& target : test.targets)
    for (const char* whose : {" published", " ours", " measured"})
      table.header.push_back(heading(target.name + whose, target.unit));
  for (const PublishedSet& set : sets) {
    std::vector<TableCell> row{set.name};
    for (std::size_t j = 0; j < test.factors.size(); ++j)
      row.push_back(number(set.values[j] * per_unit(test.factors[j].unit)));
    for (std::size_t t = 0; t < test.targets.size(); ++t) {
      const double per = per_unit(test.targets[t].unit);
      row.push_back(number(set.published[t] * per));
      row.push_back(set.ours.results.empty() ? set.ours.error : number(set.ours.results[t], per));
      row.push_back(number(test.targets[t].measured, per));
    }
    table.add(std::move(row));
  }
  return table;
}

Json to_json(const VirtualTest& test, const CalibrationOptions& options, const Calibration& calibration) {
  Json factors = Json::array(), targets = Json::array(), candidates = Json::array(), correlations = Json::array();
  for (Eigen::Index j = 0; j < calibration.correlations.rows(); ++j) {
    const Eigen::VectorXd row = calibration.correlations.row(j);
    correlations.push_back(std::vector<double>(row.begin(), row.end()));
  }
  for (std::size_t j = 0; j < test.factors.size(); ++j)
    factors.push_back({{"name", test.factors[j].name},
                       {"lower", test.factors[j].lower},
                       {"upper", test.factors[j].upper},
                       {"given_targets", estimate_json(calibration.parameters[j])},
                       {"told", calibration.learned[j]}});
  for (std::size_t t = 0; t < test.targets.size(); ++t) {
    Json target{{"name", test.targets[t].name},
                {"measured", estimate_json(test.targets[t].measured)},
                {"held_out_rms", calibration.held_out[t].rms()},
                {"extra_sd", calibration.extra_sd[t]}};
    if (test.targets[t].tolerance) target["tolerance"] = *test.targets[t].tolerance;
    if (!calibration.analyses.empty()) target["design"] = analysis_json(test, calibration.analyses[t]);
    targets.push_back(std::move(target));
  }
  for (const Candidate& candidate : calibration.candidates) candidates.push_back(json_of(test, candidate));
  Json json{{"format", "soilbin-calibration/1"},
            {"test", test.identity},
            {"design", options.design},
            {"near", options.near},
            {"within", options.within},
            {"probability", options.probability},
            {"seed", options.seed},
            {"reached", calibration.reached},
            {"best", json_of(test, calibration.best)},
            {"factors", factors},
            {"correlations", correlations},
            {"targets", targets},
            {"candidates", candidates},
            {"runs", runs_json(test, calibration)},
            {"sentences", calibration_sentences(test, options, calibration)}};
  if (calibration.decision) json["decision"] = to_json(*calibration.decision);
  return json;
}

Report report_on(const VirtualTest& test, const CalibrationOptions& options, const Calibration& calibration,
                 bool with_runs) {
  Report report{"A contact of grains, calibrated",
                "Contact values of grains that give the measured targets, by virtual tests."};
  report.add(Sentences(calibration_sentences(test, options, calibration)));
  const bool many = test.targets.size() >= many_targets;
  if (many) report.add("Targets", targets_table(test, calibration));
  report.add("What the targets alone allow", allowed_table(test, calibration));
  for (std::size_t t = 0; t < calibration.analyses.size(); ++t)
    report.add("What each factor does to " + test.targets[t].name, level_table(test, calibration, t),
               many ? Told::to_look_at : Told::everywhere);
  if (!calibration.candidates.empty()) report.add("Candidates", candidates_table(test, calibration));
  report.add("Runs", runs_table(test, calibration), with_runs ? Told::everywhere : Told::to_look_at);
  report.data = [&] { return to_json(test, options, calibration); };
  report.data_name = "calibration";
  return report;
}

}  // namespace soilbin::compare
