// soilbin runs: a time log of a rig made a table of runs, as a campaign wants it.
#include <fmt/core.h>

#include <memory>

#include "cli/commands.hpp"
#include "cli/flag_values.hpp"
#include "cli/outputs.hpp"
#include "compare/measured/campaign.hpp"
#include "compare/measured/time_log.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/sweep/result_json.hpp"

namespace soilbin::cli {
namespace {

struct RunsOptions {
  std::string file, campaign, by;
  std::vector<std::string> only;
  CsvOutput csv;
  bool json = false;
};

std::string lines_in_words(int first, int last) { return fmt::format("{}-{}", first, last); }

Table runs_table(const compare::LogRuns& made) {
  Table table{"", {"run", "setpoint", "lines", "samples", "load [N]", "slip [%]"}, {}};
  std::vector<std::size_t> measured;
  for (std::size_t c = 0; c < compare::channel_views.size(); ++c)
    if (std::ranges::any_of(made.runs, [&](const auto& one) { return one.channels[c].has_value(); })) {
      measured.push_back(c);
      table.header.push_back(compare::heading(compare::channel_views[c]));
    }
  for (const compare::LoggedRun& one : made.runs) {
    std::vector<TableCell> row = {std::to_string(*one.run.at.run),
                                  one.run.setpoint.value_or("-"),
                                  lines_in_words(one.first_line, one.last_line),
                                  fmt::format("{} of {}", one.samples - one.cut_before - one.cut_after, one.samples),
                                  number(one.run.at.load),
                                  number(100 * one.run.at.slip)};
    for (const std::size_t c : measured) {
      const double per_si = compare::channel_views[c].per_si;
      if (const auto& mean = one.channels[c])
        row.push_back({number(mean->mean, per_si),
                       fmt::format("sd {}, {:.0f} effective", number(mean->sd * per_si, 2), mean->effective)});
      else
        row.push_back("-");
    }
    table.add(std::move(row));
  }
  return table;
}

compare::Doubts doubts_of(const compare::LoggedRun& one) {
  constexpr double many = 1e4;
  compare::Doubts doubts;
  for (const auto& [title, errors] : one.unsteady)
    doubts.push_back({compare::DoubtKind::unsteady_samples,
                      {title, errors < many ? compare::Said(errors) : compare::Said("very many")}});
  return doubts;
}

compare::Doubts doubts_of(const compare::LogRuns& made) {
  compare::Doubts doubts;
  for (const compare::LoggedRun& one : made.runs)
    for (compare::Doubt& doubt : doubts_of(one)) {
      doubt.of = fmt::format("run {}, lines {}", *one.run.at.run, lines_in_words(one.first_line, one.last_line));
      doubts.push_back(std::move(doubt));
    }
  return doubts;
}

nlohmann::ordered_json to_json(const compare::LogRuns& made) {
  nlohmann::ordered_json document = {{"format", "soilbin-runs/1"}, {"parted", made.parted}, {"notes", made.notes}};
  document["method"] = compare::reduction_in_words();
  for (auto& rows = document["runs"] = nlohmann::ordered_json::array(); const compare::LoggedRun& one : made.runs) {
    nlohmann::ordered_json row = {{"run", *one.run.at.run}};
    if (one.run.setpoint) row["setpoint"] = *one.run.setpoint;
    row["lines"] = {one.first_line, one.last_line};
    row["samples"] = one.samples, row["cut_before"] = one.cut_before, row["cut_after"] = one.cut_after;
    row["at"] = compare::to_json(one.run.at);
    for (std::size_t c = 0; c < compare::channel_views.size(); ++c)
      if (const auto& mean = one.channels[c]) {
        nlohmann::ordered_json& channel = row[std::string(compare::channel_views[c].name)];
        channel = compare::estimate_json(mean->mean);
        channel["sd"] = mean->sd, channel["effective_samples"] = mean->effective;
      }
    row["doubts"] = in_words(doubts_of(one));
    rows.push_back(std::move(row));
  }
  for (auto& rows = document["left_out"] = nlohmann::ordered_json::array(); const compare::LeftOut& one : made.left_out)
    rows.push_back({{"lines", {one.first_line, one.last_line}}, {"samples", one.samples}, {"why", one.why}});
  return document;
}

/// Samples that make no run: each ramp and the like by itself, short ones together.
void print_left_out(const std::vector<compare::LeftOut>& all) {
  constexpr std::size_t most = 12;
  if (all.empty()) return;
  std::size_t samples = 0;
  for (const compare::LeftOut& one : all) samples += one.samples;
  fmt::print("\nLeft out: {} in {}.\n", compare::counted(samples, "sample"), compare::counted(all.size(), "part"));
  for (std::size_t i = 0; i < std::min(most, all.size()); ++i)
    fmt::print("  lines {}: {}\n", lines_in_words(all[i].first_line, all[i].last_line), all[i].why);
  if (all.size() > most) fmt::print("  and {} more (--json has all)\n", all.size() - most);
}

int runs(const RunsOptions& asked, const Session& session) {
  compare::LogReading how;
  if (!asked.campaign.empty()) how.columns = declared_columns(session.place, asked.campaign);
  how.only = column_values("--only", asked.only);
  how.by = asked.by;
  const compare::LogRuns made =
      compare::runs_of_log(compare::read_time_log(read_source_text(asked.file, compare::largest_log), how));
  const compare::Doubts doubts = doubts_of(made);
  print_warnings(doubts);
  Outputs outputs;
  outputs.csv(asked.csv, [&] { return compare::runs_csv(made, how.columns); });
  if (asked.json) {
    print_json(to_json(made), doubts);
    return outputs.status(done);
  }
  fmt::print("{} of {}. {}\n\n{}", compare::counted(made.runs.size(), "run"), asked.file, made.parted,
             as_text(runs_table(made)));
  print_left_out(made.left_out);
  fmt::print("\n{}\n", compare::reduction_in_words());
  for (const std::string& note : made.notes) fmt::print("{}\n", note);
  if (asked.csv.file.empty())
    fmt::print("\nnext: --csv runs.csv writes these rows for a campaign (soilbin init --campaign DIR)\n");
  return outputs.status(done);
}

}  // namespace

void add_runs(CLI::App& app, Session& session) {
  CLI::App* command =
      app.add_subcommand("runs", "a rig's time log made a campaign's table: one row a run, with errors");
  const auto asked = std::make_shared<RunsOptions>();
  add_value(
      *command, "file", asked->file, "LOG.csv",
      "one row a sample: slip, load and channels as in a campaign's runs.csv (any units: load_kN), a clock, names "
      "of runs")
      ->required();
  add_value(*command, "--campaign", asked->campaign, "CAMPAIGN",
            "a campaign whose campaign.yaml says what the log's columns hold; the rows are written under their names");
  add_value(*command, "--by", asked->by, "COLUMN",
            "column that names the runs: they change where it does and nowhere else");
  add_value(*command, "--only", asked->only, "COLUMN=VALUE",
            "samples that have this value alone, such as wheel=A; may be given again")
      ->allow_extra_args(false);
  add_csv(*command, asked->csv, "save the rows, as a campaign's runs.csv");
  command->add_flag("--json", asked->json, "soilbin-runs/1, in SI");
  command->footer("Example: soilbin runs log.csv --csv runs.csv");
  command->callback([=, &session] { session.action = [=, &session] { return runs(*asked, session); }; });
}

}  // namespace soilbin::cli
