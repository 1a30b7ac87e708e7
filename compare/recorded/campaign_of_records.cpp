#include "compare/recorded/campaign_of_records.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "compare/design/factor.hpp"
#include "compare/measured/channels.hpp"
#include "compare/measured/run_columns.hpp"
#include "compare/sweep/varying.hpp"
#include "scenario/errors.hpp"
#include "scenario/nearest_word.hpp"
#include "scenario/source_text.hpp"

namespace soilbin::compare {
namespace {

/// Columns of conditions that a run has by default, so that leaving them out says something else than the truth.
bool can_be_hidden(const RunColumn& column) {
  return !column.required && !column.channel && column.set && column.get && column.get(Run{}).has_value();
}

void hide_conditions(const std::set<std::string>& hide, Run& run) {
  const Run plain;
  for (const RunColumn& column : run_columns())
    if (can_be_hidden(column) && hide.contains(column.quantity)) column.set(run, *column.get(plain));
}

/// The setpoint's number, from 1: that of the first row whose conditions agree.
std::size_t setpoint_of(const OperatingCondition& at, std::vector<OperatingCondition>& known) {
  const auto found = std::ranges::find_if(known, [&](const auto& k) { return alike(k, at); });
  if (found != known.end()) return static_cast<std::size_t>(found - known.begin()) + 1;
  known.push_back(at);
  return known.size();
}

bool has_side(const RecordedRun& run) { return run.answer.at.yaw != 0 || run.answer.at.transverse_incline != 0; }

void check_words(const std::set<std::string>& hide) {
  const std::vector<std::string> right = things_to_hide();
  for (const std::string& word : hide)
    if (std::ranges::find(right, word) == right.end())
      throw InputError(fmt::format("nothing to hide is called '{}'{}\n  hint: what can be hidden is {}", clipped(word),
                                   did_you_mean(word, right), listed(right)));
}

Campaign empty_campaign(const Scenario& scenario, const Disclosure& disclosed, const OperatingCondition& first) {
  Campaign campaign;
  campaign.name = disclosed.name;
  campaign.wheel = scenario.tire;
  campaign.wheel.name.clear();
  if (disclosed.hide.contains("lugs")) campaign.wheel.lugs = {};
  campaign.soil = *scenario.soil.semi_empirical;
  if (!disclosed.hide.contains("bin")) campaign.bin = scenario.bin;
  campaign.effects = disclosed.effects;
  campaign.force_frame = first.force_frame;
  campaign.slip_by = first.slip_by;
  return campaign;
}

}  // namespace

std::vector<std::string> things_to_hide() {
  std::vector<std::string> things;
  for (const RunColumn& column : run_columns())
    if (can_be_hidden(column)) things.push_back(column.quantity);
  things.insert(things.end(), {"lugs", "bin"});
  return things;
}

CampaignOfRecords tell_campaign(const Scenario& scenario, const std::vector<RecordedRun>& runs,
                                const Disclosure& disclosed) {
  check_words(disclosed.hide);
  if (!scenario.soil.semi_empirical)
    throw InputError(
        fmt::format("soil '{}' has no semi-empirical values, which a campaign declares\n  hint: soilbin bevameter "
                    "gives them from the grains; --soil takes the file",
                    scenario.soil.name));
  CampaignOfRecords made;
  if (!runs.empty()) made.campaign = empty_campaign(scenario, disclosed, runs.front().answer.at);
  const bool sideways = std::ranges::any_of(runs, has_side);
  std::vector<OperatingCondition> setpoints;
  for (const std::size_t index : drawn_order(runs.size(), disclosed.seed)) {
    const RecordedRun& run = runs[index];
    if (!run.answer.result) {
      ++made.without_result;
      continue;
    }
    if (disclosed.only_steady && !run.steady) {
      ++made.not_steady;
      continue;
    }
    Run row;
    row.at = run.answer.at;
    hide_conditions(disclosed.hide, row);
    row.setpoint = fmt::format("S{:02}", setpoint_of(row.at, setpoints));
    row.at.run = static_cast<int>(made.runs.size()) + 1;
    for (const ChannelView& channel : channel_views)
      if (sideways || !channel.sideways) row.*channel.measured = ((*run.answer.result).*channel.predicted).value;
    made.campaign.runs.push_back(row);
    made.runs.push_back(run);
  }
  if (made.runs.empty()) throw InputError("no run is left to tell of");
  return made;
}

}  // namespace soilbin::compare
