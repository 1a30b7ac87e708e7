#include "compare/recorded/recorded_model.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "compare/measured/campaign.hpp"
#include "compare/sweep/varying.hpp"
#include "scenario/errors.hpp"

namespace soilbin::compare {
namespace {

using Runs = std::vector<const RecordedRun*>;

Estimate mean_channel(const Runs& runs, Estimate TractionResult::*channel) {
  std::vector<Estimate> values;
  for (const RecordedRun* run : runs) values.push_back((*run->answer.result).*channel);
  return mean_over_packings(values);
}

double mean_angle(const Runs& runs, double TractionResult::*angle) {
  double sum = 0;
  for (const RecordedRun* run : runs) sum += (*run->answer.result).*angle;
  return sum / static_cast<double>(runs.size());
}

double efficiency(const Runs& runs) {
  std::vector<const TractionResult*> results;
  for (const RecordedRun* run : runs) results.push_back(&*run->answer.result);
  return mean_efficiency(results);
}

std::vector<StressSample> mean_patch(const Runs& runs) {
  std::map<double, StressSample> at;
  const double share = 1 / static_cast<double>(runs.size());
  for (const RecordedRun* run : runs)
    for (const StressSample& one : run->answer.result->patch) {
      StressSample& sum = at[one.theta];
      sum.theta = one.theta;
      sum.normal += share * one.normal, sum.shear += share * one.shear;
      sum.lateral_shear += share * one.lateral_shear;
    }
  std::vector<StressSample> patch;
  for (const auto& [theta, sample] : at) patch.push_back(sample);
  return patch;
}

std::vector<Contribution> mean_budget(const Runs& runs) {
  std::vector<Contribution> budget;
  for (const RecordedRun* run : runs)
    for (const Contribution& part : run->answer.result->budget) {
      const auto same = [&](const Contribution& known) { return known.name == part.name; };
      auto found = std::ranges::find_if(budget, same);
      if (found == budget.end()) found = budget.insert(budget.end(), {part.name, 0.0});
      found->force += part.force / static_cast<double>(runs.size());
    }
  return budget;
}

BudgetRest mean_rest(const Runs& runs) {
  double force = 0, squared_bounds = 0;
  for (const RecordedRun* run : runs) {
    const BudgetRest& rest = run->answer.result->budget_rest;
    force += rest.force, squared_bounds += rest.bound * rest.bound;
  }
  const double n = static_cast<double>(runs.size());
  return {force / n, std::sqrt(squared_bounds) / n};
}

std::vector<Runs> by_condition(const std::vector<RecordedRun>& runs) {
  std::vector<Runs> groups;
  for (const RecordedRun& run : runs) {
    if (!run.answer.result) continue;
    const auto same = [&](const Runs& group) { return alike(group.front()->answer.at, run.answer.at); };
    const auto group = std::ranges::find_if(groups, same);
    if (group == groups.end())
      groups.push_back({&run});
    else
      group->push_back(&run);
  }
  return groups;
}

constexpr double least_freedom = 4;

/// The mean over packings, and its standard error by their scatter and by their own errors.
struct OverPackings {
  double n, mean, by_scatter, by_own;
};

OverPackings over_packings(const std::vector<Estimate>& packings) {
  const double n = static_cast<double>(packings.size());
  double sum = 0, own = 0;
  std::vector<double> values;
  for (const Estimate& one : packings) {
    sum += one.value, own += one.std_error * one.std_error;
    values.push_back(one.value);
  }
  return {n, sum / n, spread_of(values) / std::sqrt(n), std::sqrt(own) / n};
}

}  // namespace

Estimate mean_over_packings(const std::vector<Estimate>& packings) {
  const OverPackings over = over_packings(packings);
  return {over.mean, std::max(over.by_scatter, over.by_own)};
}

double freedom_over_packings(const std::vector<Estimate>& packings) {
  const OverPackings over = over_packings(packings);
  return over.by_scatter > over.by_own ? over.n - 1 : std::numeric_limits<double>::infinity();
}

double own_variance(const Runs& runs, Estimate TractionResult::*channel) {
  double variance = 0;
  for (const RecordedRun* run : runs)
    variance += std::pow(((*run->answer.result).*channel).std_error, 2) / static_cast<double>(runs.size());
  return variance;
}

double scatter_between(const Runs& runs, Estimate TractionResult::*channel) {
  std::vector<double> values;
  for (const RecordedRun* run : runs)
    if (run->answer.result) values.push_back(((*run->answer.result).*channel).value);
  return spread_of(values);
}

std::optional<PackingScatter> packing_scatter(const std::vector<RecordedRun>& all, Estimate TractionResult::*channel) {
  double between = 0, own = 0, freedom = 0;
  for (const Runs& runs : by_condition(all)) {
    if (runs.size() < 2) continue;
    const double degrees = static_cast<double>(runs.size() - 1);
    const double scatter = scatter_between(runs, channel);
    between += degrees * scatter * scatter, own += degrees * own_variance(runs, channel), freedom += degrees;
  }
  if (freedom == 0 || !(own > 0)) return std::nullopt;
  return PackingScatter{std::sqrt(between / own), freedom};
}

std::optional<double> packing_factor(const Record& record, Estimate TractionResult::*channel) {
  const std::optional<PackingScatter> scatter = packing_scatter(record.runs, channel);
  if (!scatter || scatter->freedom < least_freedom) return std::nullopt;
  return scatter->factor;
}

double usual_packing_factor(const std::vector<RecordedRun>& runs, Estimate TractionResult::*channel) {
  return channel == &TractionResult::sinkage && std::ranges::any_of(runs, &RecordedRun::early_errors) ? 2.0 : 1.0;
}

ToldScatter told_scatter(const std::vector<RecordedRun>& runs) {
  ToldScatter told;
  for (std::size_t c = 0; c < told.size(); ++c) {
    const auto channel = traction_channels[c].predicted;
    const double usual = usual_packing_factor(runs, channel);
    const std::optional<PackingScatter> found = packing_scatter(runs, channel);
    const double least = found && found->freedom >= least_freedom ? 1.0 : usual;
    told[c] = found && found->factor > least ? *found : PackingScatter{least, std::numeric_limits<double>::infinity()};
  }
  return told;
}

RunScatter scatter_of_a_run(const Runs& runs, const ToldScatter& told, std::size_t channel) {
  constexpr std::size_t enough = 5;  // packings, which know their scatter to a third
  const auto of = traction_channels[channel].predicted;
  const double own = told[channel].factor * std::sqrt(own_variance(runs, of));
  const double between = runs.size() >= enough || !(own > 0.0) ? scatter_between(runs, of) : 0.0;
  if (between > own) return {between, static_cast<double>(runs.size() - 1)};
  return {own, told[channel].freedom};
}

namespace {

Runs solved_of(const Runs& all) {
  Runs runs;
  for (const RecordedRun* run : all)
    if (run->answer.result) runs.push_back(run);
  return runs;
}

}  // namespace

TractionResult told_answer(const Runs& all, const ToldScatter& told) {
  TractionResult answer = mean_of_packings(all);
  const Runs runs = solved_of(all);
  for (std::size_t c = 0; c < told.size(); ++c)
    (answer.*traction_channels[c].predicted).std_error =
        scatter_of_a_run(runs, told, c).deviation / std::sqrt(static_cast<double>(runs.size()));
  return answer;
}

TractionResult mean_of_packings(const Runs& all) {
  if (all.empty()) throw InputError("no bed sample to answer with: at least one is needed");
  const Runs runs = solved_of(all);
  if (runs.empty())
    throw NoSolution(all.size() == 1
                         ? all.front()->answer.error
                         : fmt::format("bed sample {}: {}", all.front()->packing, all.front()->answer.error));
  TractionResult mean = *runs.front()->answer.result;
  if (runs.size() == 1) return mean;
  for (const ChannelView& channel : channel_views) mean.*channel.predicted = mean_channel(runs, channel.predicted);
  mean.tractive_efficiency = efficiency(runs);
  for (double TractionResult::*angle :
       {&TractionResult::entry_angle, &TractionResult::max_stress_angle, &TractionResult::exit_angle})
    mean.*angle = mean_angle(runs, angle);
  mean.patch = mean_patch(runs);
  mean.budget = mean_budget(runs);
  mean.budget_rest = mean_rest(runs);
  return mean;
}

TractionResult RunOnPackings::evaluate(const Scenario& scenario, const OperatingCondition& at) const {
  std::vector<RecordedRun> runs;
  for (const std::uint64_t packing : packings_) runs.push_back(run_(scenario, {at, packing}));
  Runs all;
  for (const RecordedRun& run : runs) all.push_back(&run);
  return mean_of_packings(all);
}

std::vector<const RecordedRun*> RecordedModel::runs(const OperatingCondition& at) const {
  Runs found;
  for (const RecordedRun& run : record_.runs)
    if (alike(run.answer.at, at)) found.push_back(&run);
  return found;
}

TractionResult RecordedModel::evaluate(const Scenario&, const OperatingCondition& at) const {
  const Runs found = runs(at);
  if (found.empty()) throw NoSolution("not in the record: no run at " + in_words(at));
  return told_answer(found, told_);
}

}  // namespace soilbin::compare
