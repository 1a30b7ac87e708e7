// soilbin design: the runs that are expected to tell effects apart best, before any is made.
#include <filesystem>
#include <memory>

#include "cli/commands.hpp"
#include "cli/flag_values.hpp"
#include "cli/outputs.hpp"
#include "cli/progress.hpp"
#include "cli/rig_flags.hpp"
#include "compare/telling/reports.hpp"
#include "compare/test_design/planned_runs.hpp"
#include "scenario/csv.hpp"
#include "scenario/errors.hpp"
#include "scenario/file_bytes.hpp"

namespace soilbin::cli {
namespace {

struct DesignFlags {
  std::string campaign;
  CsvOutput csv;
  std::vector<std::string> limits, effects, noise;
  int runs = 24;
  unsigned seed = 1;
  OutputFlags outputs;
};

/// Throws InputError for a file that holds anything but these rows: somebody has filled them in.
void refuse_other_rows(const std::string& file, const std::string& rows) {
  if (!std::filesystem::is_regular_file(file) || read_bytes(file, largest_csv) == rows) return;
  throw InputError({file}, "holds other rows than this plan, and stays as it is", "",
                   "give --csv another name, or delete the file");
}

int design(const DesignFlags& asked, const Session& session) {
  const compare::Campaign campaign = find_campaign(session.place, asked.campaign, compare::CampaignUse::design);
  compare::DesignOptions options;
  options.runs = asked.runs;
  options.limits = read_limits(asked.limits);
  options.effects = asked.effects;
  options.noise = read_noise(asked.noise);
  options.seed = asked.seed;
  options.threads = all_cores();
  options.progress = shown_progress();
  const compare::TestDesign design = compare::design_test(campaign, options);
  clear_progress_line();
  const std::string rows = asked.csv.in_dialect(compare::rows_to_fill_in(design));
  refuse_other_rows(asked.csv.file, rows);
  Outputs outputs = publish(compare::report_on(design), asked.outputs, {}, session);
  outputs.file(asked.csv.file, [&] { return rows; });
  return outputs.status(done);
}

}  // namespace

void add_design(CLI::App& app, Session& session) {
  CLI::App* command = app.add_subcommand("design", "the runs that separate effects best, before any is made");
  const auto asked = std::make_shared<DesignFlags>();
  add_value(*command, "campaign", asked->campaign, "CAMPAIGN",
            "a campaign of the library, or its folder; it needs no runs yet")
      ->required();
  add_value(*command, "--runs", asked->runs, "N", "number of runs to make; 24")->check(whole_number(4, 400));
  add_limits_of_the_rig(*command, asked->limits,
                        "range that the rig can reach, where it is not that of the runs made; repeatable");
  add_repeatable(*command, "--effect", asked->effects, "ID",
                 "effect to separate; repeatable; all that these ranges can show");
  add_repeatable(*command, "--noise", asked->noise, "CHANNEL=SD",
                 "standard deviation of one run, for each channel that is measured; repeatable; 2 % of its range");
  CLI::Option* const rows =
      add_kept_file(*command, "--csv", asked->csv.file, "FILE.csv", "save the rows, to fill in as the campaign's runs")
          ->check(why_no_csv);
  add_decimal_comma(*command, asked->csv)->needs(rows);
  add_value(*command, "--seed", asked->seed, "N", "seed of the order of the runs; 1");
  asked->outputs.add_to(*command, {.json = "the answer as JSON, soilbin-design/1"});
  command->footer(
      "Example: soilbin design FOLDER --runs 24 --limit load=60N..140N --limit slip=-20%..60% --csv runs.csv");
  command->callback([=, &session] { session.action = [=, &session] { return design(*asked, session); }; });
}

}  // namespace soilbin::cli
