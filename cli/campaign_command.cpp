// soilbin campaign: recorded runs of the virtual soil bin as a measured campaign, with what the analyst is told of
// them.
#include <fmt/core.h>

#include <filesystem>
#include <memory>

#include "cli/commands.hpp"
#include "cli/flag_values.hpp"
#include "cli/question.hpp"
#include "cli/soil_bin.hpp"
#include "cli/text_output.hpp"
#include "cli/versions.hpp"
#include "compare/recorded/campaign_of_records.hpp"
#include "compare/sweep/varying.hpp"
#include "scenario/atomic_file.hpp"
#include "scenario/errors.hpp"
#include "scenario/nearest_word.hpp"

namespace soilbin::cli {
namespace {

namespace fs = std::filesystem;

struct CampaignOptions {
  std::vector<std::string> records, hide, effects;
  std::string output, name, soil;
  bool only_steady = false;
  unsigned seed = 1;
};

/// The records as one: wheel, grains, bed and rig must be the first one's.
struct Runs {
  Scenario scenario;
  std::vector<compare::Record> records;
  std::vector<compare::RecordedRun> all;
};

Runs read_runs(const CampaignOptions& asked, const Workplace& place) {
  Runs runs;
  for (const std::string& file : asked.records) {
    runs.records.push_back(read_record_with_notes(file));
    const compare::Record& record = runs.records.back();
    compare::refuse_other_inputs(record, runs.records.front().inputs, file);
    for (const compare::RecordedRun& run : record.runs) runs.all.push_back(run);
  }
  const SourceText question{asked.records.front() + " (its case)", runs.records.front().question};
  runs.scenario = parse_case(question, place.library, place.effects).scenario;
  if (!asked.soil.empty()) runs.scenario.soil = find_soil(asked.soil, place.library);
  return runs;
}

std::string hidden_in_words(const CampaignOptions& asked) {
  std::string text = asked.hide.empty() ? "Nothing of the runs' conditions, wheel or bin was left out."
                                        : "Left out, as if it weren't there: " + listed(asked.hide) + ".";
  if (!asked.effects.empty()) text += " The declared model has " + listed(asked.effects) + ".";
  return text;
}

/// README.md of the campaign: how it was made, and the run behind each row.
std::string provenance(const CampaignOptions& asked, const std::string& command, const Runs& runs,
                       const compare::CampaignOfRecords& made) {
  std::string text = fmt::format(
      "# {}\n\nRuns of soilbin's virtual soil bin, told as a campaign. {}\n\nMade by soilbin {} ({}) with\n\n    "
      "{}\n\n",
      made.campaign.name, hidden_in_words(asked), SOILBIN_VERSION, source_state(), command);
  text += "| record | hash of its inputs | begun by |\n|---|---|---|\n";
  for (std::size_t k = 0; k < runs.records.size(); ++k)
    text += fmt::format("| {} | {} | soilbin {} |\n", fs::path(asked.records[k]).filename().string(),
                        compare::inputs_key(runs.records[k].inputs), runs.records[k].soilbin);
  text += "\nWhat the runs follow from beside condition and packing, in SI:\n\n```\n";
  for (const auto& [name, value] : runs.records.front().inputs) text += name + " " + value + "\n";
  text +=
      "```\n\n| run | condition in the grains | packing (seed of the bed) | steady | drift | sources |\n"
      "|---|---|---|---|---|---|\n";
  for (std::size_t k = 0; k < made.runs.size(); ++k) {
    const compare::RecordedRun& run = made.runs[k];
    text += fmt::format("| {} | {} | {} | {} | {:.3g} | {} |\n", k + 1, compare::in_words(run.answer.at), run.packing,
                        run.steady ? "yes" : "no", run.drift, run.source);
  }
  return text;
}

compare::Disclosure disclosure_of(const CampaignOptions& asked, const Runs& runs, const Workplace& place) {
  compare::Disclosure disclosed;
  disclosed.name = asked.name.empty() ? fs::path(asked.output).filename().string() : asked.name;
  if (disclosed.name.empty()) disclosed.name = fs::path(asked.output).parent_path().filename().string();
  disclosed.hide = {asked.hide.begin(), asked.hide.end()};
  disclosed.only_steady = asked.only_steady, disclosed.seed = asked.seed;
  for (const std::string& text : asked.effects) add_effect(disclosed.effects, text, place.effects, runs.scenario.soil);
  return disclosed;
}

int campaign(const CampaignOptions& asked, const Session& session) {
  const Runs runs = read_runs(asked, session.place);
  const compare::CampaignOfRecords made =
      compare::tell_campaign(runs.scenario, runs.all, disclosure_of(asked, runs, session.place));
  compare::write_campaign(asked.output, made.campaign, session.place.effects);
  write_file_atomically(fs::path(asked.output) / "README.md", provenance(asked, session.command, runs, made));
  compare::read_campaign(asked.output, session.place.library, session.place.effects,
                         compare::CampaignUse::fit);  // refuses what a loop would refuse, now
  const auto drifting = std::ranges::count_if(made.runs, [](const auto& run) { return !run.steady; });
  fmt::print("wrote {}: {} runs, {} not steady", asked.output, made.runs.size(), drifting);
  if (made.without_result > 0) fmt::print("; left out {} without a result", made.without_result);
  if (made.not_steady > 0) fmt::print("; left out {} not steady", made.not_steady);
  fmt::print("\n{}\n", hidden_in_words(asked));
  return done;
}

}  // namespace

void add_campaign(CLI::App& app, Session& session) {
  CLI::App* command = app.add_subcommand("campaign", "make a measured campaign of recorded runs of grains");
  const auto asked = std::make_shared<CampaignOptions>();
  add_value(*command, "records", asked->records, "RECORD.json", "made by soilbin run --model dem --record FILE")
      ->required();
  add_folder(*command, "--output", asked->output, "folder of the campaign")->required();
  add_value(*command, "--hide", asked->hide, "WHAT",
            "what the analyst is not told: " + listed(compare::things_to_hide()))
      ->delimiter(',')
      ->allow_extra_args(false);
  add_value(*command, "--effect", asked->effects, "ID[:FORM][,PARAMETER=VALUE...]",
            "effect that the analyst's model already has; repeatable")
      ->allow_extra_args(false);
  add_value(*command, "--soil", asked->soil, "NAME|FILE",
            "soil whose analytic values the analyst is told; by default those of the record's case");
  add_value(*command, "--name", asked->name, "NAME", "name of the campaign; by default the folder's");
  command->add_flag("--only-steady", asked->only_steady, "leave out runs that did not become steady");
  add_value(*command, "--seed", asked->seed, "N", "seed of the order of the rows; 1");
  command->footer("Example: soilbin campaign level.json tilted.json --hide longitudinal_incline --output told");
  command->callback([=, &session] { session.action = [=, &session] { return campaign(*asked, session); }; });
}

}  // namespace soilbin::cli
