#include "compare/recorded/campaign_of_records.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "compare/design/factor.hpp"
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

Campaign empty_campaign(const Scenario& scenario, const CampaignOptions& told, const OperatingCondition& first) {
  Campaign campaign;
  campaign.name = told.name;
  campaign.wheel = scenario.tire;
  campaign.wheel.name.clear();
  if (told.hide.contains("lugs")) campaign.wheel.lugs = {};
  campaign.soil = *scenario.soil.semi_empirical;
  if (!told.hide.contains("bin")) campaign.bin = scenario.bin;
  campaign.effects = told.effects;
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

std::vector<RecordedRun> joined_runs(const std::vector<NamedRecord>& records) {
  std::vector<RecordedRun> runs;
  for (const auto& [file, record] : records) {
    refuse_other_inputs(record, records.front().record.inputs, file);
    runs.insert(runs.end(), record.runs.begin(), record.runs.end());
  }
  return runs;
}

CampaignOfRecords campaign_from_runs(const Scenario& scenario, const std::vector<RecordedRun>& runs,
                                     const CampaignOptions& told) {
  check_words(told.hide);
  if (!scenario.soil.semi_empirical)
    throw InputError(
        fmt::format("soil '{}' has no semi-empirical values, which a campaign declares\n  hint: soilbin bevameter "
                    "gives them from the grains; --soil takes the file",
                    scenario.soil.name));
  CampaignOfRecords made;
  if (!runs.empty()) made.campaign = empty_campaign(scenario, told, runs.front().answer.at);
  const bool sideways = std::ranges::any_of(runs, has_side);
  std::vector<OperatingCondition> setpoints;
  for (const std::size_t index : drawn_order(runs.size(), told.seed)) {
    const RecordedRun& run = runs[index];
    if (!run.answer.result) {
      ++made.without_result;
      continue;
    }
    if (told.only_steady && !run.steady) {
      ++made.not_steady;
      continue;
    }
    Run row;
    row.at = run.answer.at;
    hide_conditions(told.hide, row);
    row.setpoint = fmt::format("S{:02}", setpoint_of(row.at, setpoints));
    row.at.run = static_cast<int>(made.runs.size()) + 1;
    for (const ChannelView& channel : channel_views)
      if (sideways || !channel.sideways) row.*channel.measured = ((*run.answer.result).*channel.predicted).value;
    made.campaign.runs.push_back(row);
    made.runs.push_back(run);
  }
  if (made.runs.empty()) throw InputError("no run is left");
  return made;
}

std::string hidden_in_words(const std::vector<std::string>& hide, const std::vector<std::string>& effects) {
  std::string text = hide.empty() ? "Nothing of the runs' conditions, wheel or bin was left out."
                                  : "Left out, as if it weren't there: " + listed(hide) + ".";
  if (!effects.empty()) text += " The declared model has " + listed(effects) + ".";
  return text;
}

std::string provenance_text(const std::vector<NamedRecord>& records, const CampaignOfRecords& made,
                            const std::string& hidden, const MadeBy& by) {
  std::string text = fmt::format(
      "# {}\n\nRuns of soilbin's virtual soil bin, told as a campaign. {}\n\nMade by soilbin {} ({}) with\n\n    "
      "{}\n\n",
      made.campaign.name, hidden, by.version, by.source, by.command);
  text += "| record | hash of its inputs | begun by |\n|---|---|---|\n";
  for (const auto& [file, record] : records)
    text +=
        fmt::format("| {} | {} | soilbin {} |\n", file.filename().string(), inputs_key(record.inputs), record.soilbin);
  text += "\nWhat the runs follow from beside condition and packing, in SI:\n\n```\n";
  for (const auto& [name, value] : records.front().record.inputs) text += name + " " + value + "\n";
  text +=
      "```\n\n| run | condition in the grains | packing (seed of the bed) | steady | drift | sources |\n"
      "|---|---|---|---|---|---|\n";
  for (std::size_t k = 0; k < made.runs.size(); ++k) {
    const RecordedRun& run = made.runs[k];
    text += fmt::format("| {} | {} | {} | {} | {:.3g} | {} |\n", k + 1, in_words(run.answer.at), run.packing,
                        run.steady ? "yes" : "no", run.drift, run.source);
  }
  return text;
}

}  // namespace soilbin::compare
