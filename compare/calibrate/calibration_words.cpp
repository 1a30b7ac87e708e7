#include "compare/calibrate/calibration_words.hpp"

#include <fmt/core.h>

#include <cmath>
#include <stdexcept>

#include "compare/calibrate/decision_words.hpp"
#include "compare/report/number_text.hpp"

namespace soilbin::compare {
namespace {

std::string with_unit(const std::string& text, const std::string& unit) {
  return unit == "-" ? text : text + " " + unit;
}

std::string value_with_unit(const Estimate& value, const std::string& unit) {
  return with_unit(number(value, per_unit(unit)), unit);
}

std::string misses(const VirtualTest& test, const Candidate& candidate) {
  std::string text;
  for (std::size_t t = 0; t < test.targets.size(); ++t) {
    const Target& target = test.targets[t];
    text += fmt::format("{}{} {} for {} ({:+.1f} %)", t == 0 ? "" : ", ", target.name,
                        value_with_unit(candidate.predicted[t], target.unit),
                        value_with_unit({target.measured.value, 0}, target.unit),
                        100 * (candidate.predicted[t].value / target.measured.value - 1));
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
  for (const CalibrationRun& run : calibration.runs) fresh += !run.from_store;
  return fresh;
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
  return {fmt::format("No point that was run lies within {} of the targets: the soil bin had nothing to decide.",
                      percent(options.near))};
}

std::vector<std::string> columns_of(const VirtualTest& test) {
  std::vector<std::string> header;
  for (const Factor& factor : test.factors) header.push_back(heading(factor.name, factor.unit));
  for (const Target& target : test.targets) header.push_back(heading(target.name, target.unit));
  return header;
}

void add_cells(std::vector<std::string>& row, const VirtualTest& test, const Eigen::VectorXd& values,
               const std::vector<Estimate>& results) {
  for (std::size_t j = 0; j < test.factors.size(); ++j)
    row.push_back(number(values[j] * per_unit(test.factors[j].unit)));
  for (std::size_t t = 0; t < test.targets.size(); ++t)
    row.push_back(results.empty() ? "-" : number(results[t], per_unit(test.targets[t].unit)));
}

/// What of a value's source is the decision's.
std::string decided_by(const Calibration& calibration) {
  if (!calibration.decision || !calibration.decision->decided()) return "";
  const Decision& decision = *calibration.decision;
  if (const int tied = decision.tied(); tied > 1)
    return fmt::format("; the likeliest of {} candidates that the soil bin doesn't tell apart on {}", tied,
                       decision.campaign);
  return fmt::format("; of {} candidates the nearest to {} in the soil bin", decision.trials.size(), decision.campaign);
}

}  // namespace

std::vector<std::string> calibration_sentences(const VirtualTest& test, const CalibrationOptions& options,
                                               const Calibration& calibration) {
  std::vector<std::string> said;
  const std::string chance = fmt::format("with probability {:.0f} %", 100 * calibration.best.chance);
  if (calibration.reached)
    said.push_back(fmt::format("Reached: every target within {} {}.", percent(options.within), chance));
  else
    said.push_back(fmt::format("Not reached in {} runs: every target within {} only {}.", calibration.runs.size(),
                               percent(options.within), chance));
  said.push_back("Chosen: " + values_in_words(test, calibration.best.values) + ".");
  said.push_back("It gives " + misses(test, calibration.best) + ".");
  for (std::string& sentence : sentences_on_decision(options, calibration)) said.push_back(std::move(sentence));
  if (calibration.smallest_chi_square > 9)
    said.push_back(
        fmt::format("Nowhere between the bounds are the targets met (chi square at least {:.1f}): widen them.",
                    calibration.smallest_chi_square));
  for (std::size_t t = 0; t < calibration.analyses.size(); ++t) said.push_back(order_sentence(test, calibration, t));
  if (calibration.analyses.empty())
    said.push_back("A run of the design failed, so it has no range analysis; the surrogate learnt from the others.");
  else
    said.push_back(sentence(calibration.analyses[0].variance));
  for (std::size_t j = 0; j < test.factors.size(); ++j)
    if (calibration.learned[j] < 0.2)
      said.push_back(fmt::format("These targets hardly determine {}: {} is as good as the bounds.",
                                 test.factors[j].name,
                                 value_with_unit(calibration.parameters[j], test.factors[j].unit)));
  said.push_back(fmt::format("{} runs, {} made now.", calibration.runs.size(), fresh_runs(calibration)));
  return said;
}

HtmlTable level_table(const VirtualTest& test, const Calibration& calibration, std::size_t target) {
  const TargetAnalysis& analysis = calibration.analyses.at(target);
  const double factor = per_unit(test.targets[target].unit);
  HtmlTable table{heading(test.targets[target].name, test.targets[target].unit), {"factor"}};
  for (std::size_t i = 0; i < analysis.ranges.factors[0].means.size(); ++i)
    table.header.push_back(fmt::format("k{}", i + 1));
  for (const char* name : {"R", "sum of squares", "F", "p"}) table.header.emplace_back(name);
  const auto variance_cells = [&](std::vector<std::string>& row, const VarianceRow& from) {
    row.push_back(number(from.sum_of_squares * factor * factor));
    row.push_back(from.pooled ? "pooled" : number(from.f));
    row.push_back(from.pooled || !std::isfinite(from.p_value) ? "-" : fmt::format("{:.2g}", from.p_value));
  };
  for (std::size_t j = 0; j < test.factors.size(); ++j) {
    std::vector<std::string> row{test.factors[j].name};
    for (const double k : analysis.ranges.factors[j].means) row.push_back(number(k * factor));
    row.push_back(number(analysis.ranges.factors[j].range * factor));
    variance_cells(row, analysis.variance.factors[j]);
    table.rows.push_back(std::move(row));
  }
  if (analysis.variance.left.freedom > 0) {
    std::vector<std::string> row{analysis.variance.left.source};
    row.resize(table.header.size() - 3);
    variance_cells(row, analysis.variance.left);
    table.rows.push_back(std::move(row));
  }
  return table;
}

HtmlTable runs_table(const VirtualTest& test, const Calibration& calibration) {
  HtmlTable table{"Runs", {"stage"}};
  for (std::string& name : columns_of(test)) table.header.push_back(std::move(name));
  table.header.emplace_back("failure");
  for (const CalibrationRun& run : calibration.runs) {
    std::vector<std::string> row{stage_name(run.stage)};
    add_cells(row, test, run.experiment.values, run.experiment.results);
    row.push_back(run.experiment.error);
    table.rows.push_back(std::move(row));
  }
  return table;
}

HtmlTable candidates_table(const VirtualTest& test, const Calibration& calibration) {
  HtmlTable table{"Candidates", {""}};
  for (std::string& name : columns_of(test)) table.header.push_back(std::move(name));
  for (const char* name : {"runs", "chi square", "chance"}) table.header.emplace_back(name);
  if (calibration.decision)
    for (std::string& name : decision_columns(*calibration.decision)) table.header.push_back(std::move(name));
  for (std::size_t k = 0; k < calibration.candidates.size(); ++k) {
    const Candidate& candidate = calibration.candidates[k];
    std::vector<std::string> row{candidate_name(k)};
    add_cells(row, test, candidate.values, candidate.predicted);
    row.push_back(std::to_string(candidate.runs));
    row.push_back(number(candidate.chi_square));
    row.push_back(percent(candidate.chance));
    if (calibration.decision)
      for (std::string& cell : decision_cells(*calibration.decision, k)) row.push_back(std::move(cell));
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string key_of(ContactKind kind) { return kind == ContactKind::grain_grain ? "grain_grain" : "grain_tire"; }

ContactPair& pair_of(GranularSoil& soil, ContactKind kind) {
  return kind == ContactKind::grain_grain ? soil.grain_grain : soil.grain_tire;
}

double& value_of(ContactPair& pair, const std::string& name) {
  if (name == "restitution") return pair.restitution;
  if (name == "sliding_friction") return pair.sliding_friction;
  if (name == "rolling_friction") return pair.rolling_friction;
  if (name == "cohesion") return pair.cohesion;
  throw std::invalid_argument("a contact has no number '" + name + "'");
}

void put_values(GranularSoil& soil, ContactKind kind, const std::vector<Factor>& factors,
                const Eigen::VectorXd& values) {
  for (std::size_t j = 0; j < factors.size(); ++j) value_of(pair_of(soil, kind), factors[j].name) = values[j];
}

Soil calibrated_soil(Soil soil, ContactKind kind, const VirtualTest& test, const CalibrationOptions& options,
                     const Calibration& calibration) {
  GranularSoil& grains = soil.granular.value();
  put_values(grains, kind, test.factors, calibration.best.values);
  for (std::size_t j = 0; j < test.factors.size(); ++j) {
    const Factor& factor = test.factors[j];
    grains.sources[key_of(kind) + "." + factor.name] =
        fmt::format("calibrated by soilbin calibrate ({}, {} runs): {}; the targets alone allow {}{}", options.design,
                    calibration.runs.size(), misses(test, calibration.best),
                    value_with_unit(calibration.parameters[j], factor.unit), decided_by(calibration));
  }
  return soil;
}

}  // namespace soilbin::compare
