// soilbin campaign: recorded runs of the virtual soil bin as a measured campaign, with what the analyst is told of
// them.
#include <fmt/core.h>

#include <filesystem>
#include <memory>

#include "cli/commands.hpp"
#include "cli/flag_values.hpp"
#include "cli/outputs.hpp"
#include "cli/question.hpp"
#include "cli/soil_bin.hpp"
#include "cli/versions.hpp"
#include "compare/recorded/campaign_of_records.hpp"
#include "scenario/atomic_file.hpp"
#include "scenario/nearest_word.hpp"

namespace soilbin::cli {
namespace {

namespace fs = std::filesystem;

struct CampaignFlags {
  std::vector<std::string> records, hide, effects;
  std::string output, name, soil;
  bool only_steady = false;
  unsigned seed = 1;
};

/// The case of the first record, on the soil that is asked for.
Scenario scenario_of(const compare::NamedRecord& first, const std::string& soil, const Workplace& place) {
  const SourceText question{first.file.string() + " (its case)", first.record.question};
  Scenario scenario = parse_case(question, place.library, place.effects).scenario;
  if (!soil.empty()) scenario.soil = find_soil(soil, place.library);
  return scenario;
}

compare::CampaignOptions options_of(const CampaignFlags& asked, const Soil& soil, const Workplace& place) {
  compare::CampaignOptions told;
  told.name = asked.name.empty() ? fs::path(asked.output).filename().string() : asked.name;
  if (told.name.empty()) told.name = fs::path(asked.output).parent_path().filename().string();
  told.hide = {asked.hide.begin(), asked.hide.end()};
  told.only_steady = asked.only_steady, told.seed = asked.seed;
  for (const std::string& text : asked.effects) add_effect(told.effects, text, place.effects, soil);
  return told;
}

int campaign(const CampaignFlags& asked, const Session& session) {
  std::vector<std::string> files;
  for (const std::string& name : asked.records) files.push_back(find_record(session.place, name, name).string());
  const std::vector<compare::NamedRecord> records = read_records(files);
  const std::vector<compare::RecordedRun> runs = compare::joined_runs(records);
  const Scenario scenario = scenario_of(records.front(), asked.soil, session.place);
  const compare::CampaignOfRecords made =
      compare::campaign_from_runs(scenario, runs, options_of(asked, scenario.soil, session.place));
  const std::string hidden = compare::hidden_in_words(asked.hide, asked.effects);
  compare::write_campaign(asked.output, made.campaign, session.place.effects);
  write_file_atomically(
      fs::path(asked.output) / "README.md",
      compare::provenance_text(records, made, hidden, {SOILBIN_VERSION, source_state(), session.command}));
  compare::read_campaign(asked.output, session.place.library, session.place.effects,
                         compare::CampaignUse::fit);  // refuses what a loop would refuse, now
  const auto drifting = std::ranges::count_if(made.runs, [](const auto& run) { return !run.steady; });
  fmt::print("wrote {}: {} runs, {} not steady", asked.output, made.runs.size(), drifting);
  if (made.without_result > 0) fmt::print("; left out {} without a result", made.without_result);
  if (made.not_steady > 0) fmt::print("; left out {} not steady", made.not_steady);
  fmt::print("\n{}\n", hidden);
  return done;
}

}  // namespace

void add_campaign(CLI::App& app, Session& session) {
  CLI::App* command = app.add_subcommand("campaign", "make a measured campaign of recorded runs of grains");
  const auto asked = std::make_shared<CampaignFlags>();
  add_value(*command, "records", asked->records, "RECORD.json|STUDY",
            "made by soilbin run --model dem --record FILE, or a study of the library whose runs are recorded there")
      ->required();
  add_folder(*command, "--output", asked->output, "folder of the campaign")->required();
  add_repeatable(*command, "--hide", asked->hide, "WHAT",
                 "what the analyst is not told: " + listed(compare::things_to_hide()))
      ->delimiter(',');
  add_repeatable(*command, "--effect", asked->effects, "ID[:FORM][,PARAMETER=VALUE...]",
                 "effect that the analyst's model already has; repeatable");
  add_value(*command, "--soil", asked->soil, "NAME|FILE",
            "soil whose analytic values the analyst is told; by default those of the record's case");
  add_value(*command, "--name", asked->name, "NAME", "name of the campaign; by default the folder's");
  command->add_flag("--only-steady", asked->only_steady, "leave out runs that did not become steady");
  add_value(*command, "--seed", asked->seed, "N", "seed of the order of the rows; 1");
  command->footer("Example: soilbin campaign level.json tilted.json --hide longitudinal_incline --output told");
  command->callback([=, &session] { session.action = [=, &session] { return campaign(*asked, session); }; });
}

}  // namespace soilbin::cli
