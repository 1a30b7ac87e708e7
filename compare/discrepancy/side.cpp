#include "compare/discrepancy/side.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "compare/sweep/alike.hpp"
#include "scenario/errors.hpp"
#include "scenario/estimate.hpp"

namespace soilbin::compare {
namespace {

/// How far apart two conditions are, in units of what counts as near; above 1: not near.
double apart(const OperatingCondition& a, const OperatingCondition& b, const Nearness& near) {
  if (a.pass != b.pass) return std::numeric_limits<double>::infinity();
  return std::max({std::abs(a.load - b.load) / (near.load * b.load), std::abs(a.slip - b.slip) / near.slip,
                   std::abs(a.longitudinal_incline - b.longitudinal_incline) / near.angle,
                   std::abs(a.transverse_incline - b.transverse_incline) / near.angle,
                   std::abs(a.yaw - b.yaw) / near.angle});
}

void check_wheel(const Tire& measured, const Tire& asked, const std::string& campaign) {
  constexpr double same = 0.05;
  const auto differ = [](double a, double b) { return std::abs(a - b) > same * b; };
  if (differ(measured.radius, asked.radius) || differ(measured.width, asked.width))
    throw InputError(
        fmt::format("campaign '{}' measured a wheel of {:.4g} x {:.4g} mm, the study asks of one of "
                    "{:.4g} x {:.4g} mm (radius x width)\n  hint: a study with the campaign's wheel",
                    campaign, 1000 * measured.radius, 1000 * measured.width, 1000 * asked.radius, 1000 * asked.width));
}

SidePoint measured_point(const std::vector<const Run*>& runs, const OperatingCondition& at) {
  SidePoint point;
  point.runs = runs.size();
  point.has = {};
  if (runs.empty()) {
    point.error = "not measured";
    return point;
  }
  TractionResult result;
  result.at = at;
  result.tractive_efficiency = result.entry_angle = result.exit_angle = result.max_stress_angle = not_a_number;
  for (std::size_t c = 0; c < channel_views.size(); ++c) {
    std::vector<double> values;
    for (const Run* run : runs)
      if (const auto& value = run->*channel_views[c].measured) values.push_back(*value);
    point.has[c] = !values.empty();
    point.scatter[c] = spread_of(values);
    result.*channel_views[c].predicted = values.empty() ? Estimate{not_a_number, 0.0} : mean_of(values);
  }
  if (runs.size() == 1) point.doubts.push_back("one measured run: its scatter is not known");
  point.result = result;
  return point;
}

}  // namespace

Side side_of(const ModelAnswers& answers) {
  Side side{answers.choice.label, answers.choice.model == ModelKind::dem ? SideKind::grains : SideKind::analytic, {}};
  for (const Answer& answer : answers.answers) {
    SidePoint point;
    point.result = answer.result;
    point.error = answer.error;
    if (answer.result && side.kind == SideKind::grains) {
      for (std::size_t c = 0; c < channel_views.size(); ++c)
        point.scatter[c] = ((*answer.result).*channel_views[c].predicted).std_error;
      point.doubts.push_back("one run: the scatter between packings is not known");
    }
    side.points.push_back(std::move(point));
  }
  return side;
}

SidePoint combine(const std::vector<const RecordedRun*>& runs) {
  SidePoint point;
  std::vector<const RecordedRun*> solved;
  for (const RecordedRun* run : runs)
    if (run->answer.result) solved.push_back(run);
  point.runs = solved.size();
  if (solved.empty()) {
    point.error = runs.empty() ? "not run" : runs.front()->answer.error;
    return point;
  }
  point.result = mean_of_packings(solved);
  for (std::size_t c = 0; c < channel_views.size(); ++c) {
    double own = 0.0;  // mean variance of a single run's mean
    for (const RecordedRun* run : solved)
      own += std::pow(((*run->answer.result).*channel_views[c].predicted).std_error, 2);
    point.scatter[c] = std::max(std::sqrt(own / static_cast<double>(solved.size())),
                                scatter_between(solved, channel_views[c].predicted));
  }
  if (solved.size() < runs.size())
    point.doubts.push_back(fmt::format("{} of {} runs without a result", runs.size() - solved.size(), runs.size()));
  const auto drifting = std::count_if(solved.begin(), solved.end(), [](const auto* run) { return !run->steady; });
  double most = 0.0;
  for (const RecordedRun* run : solved)
    if (std::isfinite(run->drift)) most = std::max(most, run->drift);
  if (drifting > 0)
    point.doubts.push_back(fmt::format("{} of {} run{} not steady: halves differ by up to {:.1f} standard errors",
                                       drifting, solved.size(), solved.size() == 1 ? "" : "s", most));
  if (std::all_of(solved.begin(), solved.end(),
                  [&](const auto* run) { return run->packing == solved.front()->packing; }))
    point.doubts.push_back("one packing: the scatter between packings is not known");
  return point;
}

Side side_of(const std::string& label, const std::vector<RecordedRun>& runs,
             const std::vector<OperatingCondition>& conditions) {
  Side side{label, SideKind::grains, {}};
  for (const OperatingCondition& at : conditions) {
    std::vector<const RecordedRun*> members;
    for (const RecordedRun& run : runs)
      if (alike(run.answer.at, at)) members.push_back(&run);
    side.points.push_back(combine(members));
  }
  return side;
}

Side side_of(const Campaign& campaign, const Case& question, const Nearness& near) {
  check_wheel(campaign.wheel, question.scenario.tire, campaign.name);
  const std::vector<OperatingCondition>& conditions = question.study.conditions;
  std::vector<std::vector<const Run*>> members(conditions.size());
  for (const Run& run : campaign.runs) {
    const auto nearest = std::min_element(conditions.begin(), conditions.end(), [&](const auto& a, const auto& b) {
      return apart(run.at, a, near) < apart(run.at, b, near);
    });
    if (nearest == conditions.end() || apart(run.at, *nearest, near) > 1.0) continue;
    members[static_cast<std::size_t>(nearest - conditions.begin())].push_back(&run);
  }
  Side side{campaign.name + " (measured)", SideKind::measured, {}};
  bool any = false;
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    side.points.push_back(measured_point(members[i], conditions[i]));
    any = any || !members[i].empty();
  }
  if (!any)
    throw InputError(
        fmt::format("no run of campaign '{}' is near a condition of study '{}'\n  hint: within {:.0f} % of the load, "
                    "{:.3g} % slip and {:.2g} deg",
                    campaign.name, question.study.name, 100 * near.load, 100 * near.slip, near.angle * 57.2957795));
  return side;
}

}  // namespace soilbin::compare
