#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "compare/sweep/doubt_parts.hpp"
#include "compare/sweep/doubts.hpp"
#include "compare/sweep/unheard.hpp"
#include "compare/sweep/varying.hpp"

namespace soilbin::compare {
namespace {

using Warnings = std::vector<std::string>;

/// A campaign's runs as questions to a model.
Case question_of(const Campaign& campaign, const Scenario& asked) {
  Case question;
  question.scenario = asked;
  question.study.models = {{ModelKind::bekker_wong, asked.effects, ""}};
  question.scenario.effects.clear();
  for (const Run& run : campaign.runs) question.study.conditions.push_back(run.at);
  return question;
}

void add_row_doubts(const Campaign& campaign, Warnings& warnings) {
  for (const Run& run : campaign.runs) {
    if (run.sinkage && std::abs(*run.sinkage) > 2 * campaign.wheel.radius)
      warnings.push_back(fmt::format("line {}: a measured sinkage of {:.4g} mm is more than the wheel's diameter",
                                     run.csv_line, 1000 * *run.sinkage));
    if (run.drawbar_pull && std::abs(*run.drawbar_pull) > 3 * run.at.load)
      warnings.push_back(fmt::format("line {}: a drawbar pull of {:.4g} N is more than three times the load",
                                     run.csv_line, *run.drawbar_pull));
  }
}

/// Wheels stand above the undisturbed surface here and there; not in most runs.
void add_flipped_sinkage(const std::vector<Run>& runs, Warnings& warnings) {
  const auto measured = std::count_if(runs.begin(), runs.end(), [](const Run& run) { return run.sinkage.has_value(); });
  const auto above =
      std::count_if(runs.begin(), runs.end(), [](const Run& run) { return run.sinkage.value_or(0.0) < 0.0; });
  if (2 * above > measured)
    warnings.push_back(
        fmt::format("{} of {} measured sinkages are negative: is their sign flipped? Below the undisturbed surface is "
                    "positive",
                    above, measured));
}

/// All that was set and measured in a run, but for the line it stands in.
auto values_of(const Run& run) {
  return std::tie(run.setpoint, run.drawbar_pull, run.torque, run.sinkage, run.lateral_force, run.at);
}

/// Rows that were copied: a run's number that was there before, or every value equal to that of an earlier row.
void add_repeated_rows(const std::vector<Run>& runs, Warnings& warnings) {
  std::map<decltype(values_of(runs.front())), int> line_of_values;
  std::map<int, int> line_of_number;
  for (const Run& run : runs) {
    const int same = line_of_values.try_emplace(values_of(run), run.csv_line).first->second;
    const int numbered = run.at.run ? line_of_number.try_emplace(*run.at.run, run.csv_line).first->second : same;
    const int earlier = std::min(same, numbered);
    if (earlier == run.csv_line) continue;
    warnings.push_back(
        earlier == same
            ? fmt::format("line {}: all its values are those of line {}: counted twice", run.csv_line, earlier)
            : fmt::format("line {}: run {} stands in line {} already", run.csv_line, *run.at.run, earlier));
  }
}

/// Correlation within groups of two columns; 0 where one of them doesn't vary.
double correlation(const std::vector<double>& x, const std::vector<double>& y, const std::vector<std::size_t>& group) {
  const std::size_t groups = group.empty() ? 0 : *std::max_element(group.begin(), group.end()) + 1;
  std::vector<double> n(groups), sum_x(groups), sum_y(groups);
  for (std::size_t i = 0; i < x.size(); ++i) n[group[i]] += 1, sum_x[group[i]] += x[i], sum_y[group[i]] += y[i];
  double xx = 0, xy = 0, yy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const std::size_t g = group[i];
    const double dx = x[i] - sum_x[g] / n[g], dy = y[i] - sum_y[g] / n[g];
    xx += dx * dx, xy += dx * dy, yy += dy * dy;
  }
  return xx > 0 && yy > 0 ? xy / std::sqrt(xx * yy) : 0.0;
}

/// A pull whose sign is flipped falls along each curve against slip while the torque rises, and lies nearer to what the
/// model says once it is turned round.
void add_flipped_pull(const Campaign& campaign, const Case& question, const std::vector<Answer>& answers,
                      Warnings& warnings) {
  constexpr std::size_t fewest = 6;
  constexpr double clearly = 0.7;
  const std::vector<std::size_t> curve_of = curves_against_slip(question.study.conditions, Spread::measured).curve_of;
  std::vector<double> slip, pull, torque;
  std::vector<std::size_t> curve;
  for (std::size_t i = 0; i < campaign.runs.size(); ++i) {
    const Run& run = campaign.runs[i];
    if (!run.drawbar_pull || !run.torque) continue;
    slip.push_back(run.at.slip), pull.push_back(*run.drawbar_pull), torque.push_back(*run.torque);
    curve.push_back(curve_of[i]);
  }
  if (slip.size() < fewest ||
      !(correlation(slip, pull, curve) < -clearly && correlation(slip, torque, curve) > clearly))
    return;
  double as_told = 0, turned_round = 0;
  for (std::size_t i = 0; i < campaign.runs.size(); ++i) {
    const auto& measured = campaign.runs[i].drawbar_pull;
    const auto& predicted = answers[i].result;
    if (!measured || !predicted) continue;
    as_told += std::pow(*measured - predicted->drawbar_pull.value, 2);
    turned_round += std::pow(*measured + predicted->drawbar_pull.value, 2);
  }
  if (turned_round < as_told)
    warnings.emplace_back(
        "the drawbar pull falls as slip rises while the torque rises: is its sign flipped? Positive pulls forward");
}

/// Each row has a run and a place: so a campaign is told, whether or not its model asks for them.
bool only_tells_the_row(const Unheard& one) { return one.key == "run" || one.key == "position"; }

enum class Fit { none, will_look_for_effects };

Warnings doubts_of(const Campaign& campaign, const Case& question, const std::vector<ModelAnswers>& study,
                   Answered answered, Fit fit) {
  Warnings warnings = doubts_but_unheard(question, study, answered), of_rows;
  if (fit == Fit::none)
    for (Unheard& one : unheard(question))
      if (!only_tells_the_row(one)) warnings.push_back(std::move(one.words));
  add_row_doubts(campaign, of_rows);
  add_flipped_sinkage(campaign.runs, of_rows);
  add_repeated_rows(campaign.runs, of_rows);
  add_flipped_pull(campaign, question, study.front().answers, of_rows);
  for (std::string& warning : once_each(of_rows)) warnings.push_back(std::move(warning));
  return warnings;
}

Warnings doubts_as_declared(const Campaign& campaign, Fit fit) {
  const Case question = question_of(campaign, scenario_of(campaign));
  return doubts_of(campaign, question, quick_answers(question), Answered::no, fit);
}

}  // namespace

Warnings doubts(const Campaign& campaign) { return doubts_as_declared(campaign, Fit::none); }

Warnings doubts_before_fit(const Campaign& campaign) {
  return doubts_as_declared(campaign, Fit::will_look_for_effects);
}

Warnings doubts(const Campaign& campaign, const Scenario& asked, const Prediction& prediction) {
  const Case question = question_of(campaign, asked);
  ModelAnswers answers{question.study.models.front(), {}};
  for (const PredictedRun& run : prediction.runs) answers.answers.push_back(run.predicted);
  return doubts_of(campaign, question, {answers}, Answered::yes, Fit::none);
}

}  // namespace soilbin::compare
