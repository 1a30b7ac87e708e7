// Answers made ready for statistical tests: their errors must be independent and hold the scatter between packings.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "compare/measured/channels.hpp"
#include "compare/recorded/recorded_model.hpp"
#include "compare/reproduction/reproduction.hpp"
#include "compare/sweep/alike.hpp"
#include "scenario/errors.hpp"

namespace soilbin::compare {
namespace {

using Runs = std::vector<const RecordedRun*>;

std::vector<Runs> by_condition(const Record& record) {
  std::vector<Runs> groups;
  for (const RecordedRun& run : record.runs) {
    if (!run.answer.result) continue;
    const auto same = [&](const Runs& group) { return alike(group.front()->answer.at, run.answer.at); };
    const auto group = std::find_if(groups.begin(), groups.end(), same);
    if (group == groups.end())
      groups.push_back({&run});
    else
      group->push_back(&run);
  }
  return groups;
}

constexpr double least_freedom = 4;

}  // namespace

std::optional<double> packing_factor(const Record& record, Estimate TractionResult::*channel) {
  double between = 0, own = 0, freedom = 0;
  for (const Runs& runs : by_condition(record)) {
    if (runs.size() < 2) continue;
    const double degrees = static_cast<double>(runs.size() - 1);
    const double scatter = scatter_between(runs, channel);
    double mean_own = 0;
    for (const RecordedRun* run : runs)
      mean_own += std::pow(((*run->answer.result).*channel).std_error, 2) / static_cast<double>(runs.size());
    between += degrees * scatter * scatter, own += degrees * mean_own, freedom += degrees;
  }
  if (freedom < least_freedom || !(own > 0)) return std::nullopt;
  return std::sqrt(between / own);
}

std::vector<Answer> taken_as_exact(std::vector<Answer> answers) {
  for (Answer& answer : answers)
    for (const ChannelView& channel : channel_views)
      if (answer.result) ((*answer.result).*channel.predicted).std_error = 0;
  return answers;
}

std::vector<Answer> recorded_answers(const Record& record, const std::vector<OperatingCondition>& conditions,
                                     std::string& remark) {
  std::array<double, channel_views.size()> factors{};
  remark.clear();
  for (std::size_t c = 0; c < channel_views.size(); ++c) {
    const std::optional<double> factor = packing_factor(record, channel_views[c].predicted);
    factors[c] = std::max(1.0, factor.value_or(1.0));
    if (factor) remark += fmt::format("{}{} {:.2g}", remark.empty() ? "" : ", ", channel_views[c].title, *factor);
  }
  remark = remark.empty()
               ? "errors are those of single runs: too few conditions have several packings to know more"
               : "scatter between packings over the errors of single runs (errors are widened by it where it "
                 "is above 1): " +
                     remark;
  const RecordedModel model(record);
  std::vector<Answer> answers;
  for (const OperatingCondition& at : conditions) {
    answers.push_back(ask(model, {}, at));
    if (!answers.back().result) continue;
    const Runs runs = model.runs(at);
    for (std::size_t c = 0; c < channel_views.size(); ++c) {
      double own = 0;
      for (const RecordedRun* run : runs)
        own += std::pow(((*run->answer.result).*channel_views[c].predicted).std_error, 2);
      ((*answers.back().result).*channel_views[c].predicted).std_error =
          factors[c] * std::sqrt(own) / static_cast<double>(runs.size());
    }
  }
  return answers;
}

}  // namespace soilbin::compare
