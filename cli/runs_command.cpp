// soilbin runs: a time log of a rig made a table of runs, as a campaign wants it.
#include <fmt/core.h>

#include <memory>

#include "cli/commands.hpp"
#include "cli/flag_values.hpp"
#include "cli/outputs.hpp"
#include "compare/doubts/doubts.hpp"
#include "compare/measured/campaign.hpp"
#include "compare/measured/time_log.hpp"
#include "compare/telling/reports.hpp"

namespace soilbin::cli {
namespace {

struct RunsOptions {
  std::string file, campaign, by;
  std::vector<std::string> only;
  OutputFlags outputs;
};

int runs(const RunsOptions& asked, const Session& session) {
  compare::LogReading how;
  if (!asked.campaign.empty()) how.columns = declared_columns(session.place, asked.campaign);
  how.only = column_values("--only", asked.only);
  how.by = asked.by;
  const compare::LogRuns made =
      compare::runs_of_log(compare::read_time_log(read_source_text(asked.file, compare::largest_log), how));
  const Outputs outputs =
      publish(compare::report_on(made, asked.file, how.columns), asked.outputs, compare::doubts(made), session);
  if (!asked.outputs.json && asked.outputs.csv.file.empty())
    fmt::print(
        "\nnext: --csv runs.csv writes these rows for a campaign (soilbin init --campaign DIR --from runs.csv)\n");
  return outputs.status(done);
}

}  // namespace

void add_runs(CLI::App& app, Session& session) {
  CLI::App* command =
      app.add_subcommand("runs", "a rig's time log made a campaign's table: one row a run, with errors");
  const auto asked = std::make_shared<RunsOptions>();
  add_value(*command, "file", asked->file, "LOG.csv",
            "one row a sample: slip, load and channels as in a campaign's runs.csv (any units: load_kN), a clock, "
            "names of runs")
      ->required();
  add_value(*command, "--campaign", asked->campaign, "CAMPAIGN",
            "a campaign whose campaign.yaml says what the log's columns hold; the rows are written under their names");
  add_value(*command, "--by", asked->by, "COLUMN",
            "column that names the runs: they change where it does and nowhere else");
  add_repeatable(*command, "--only", asked->only, "COLUMN=VALUE",
                 "samples that have this value alone, such as wheel=A; may be given again");
  asked->outputs.add_to(*command, {.json = "soilbin-runs/1, in SI", .csv = "save the rows, as a campaign's runs.csv"});
  command->footer("Example: soilbin runs log.csv --csv runs.csv");
  command->callback([=, &session] { session.action = [=, &session] { return runs(*asked, session); }; });
}

}  // namespace soilbin::cli
