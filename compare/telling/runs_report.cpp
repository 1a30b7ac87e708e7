// The runs of a time log as they are told; soilbin-runs/1.
#include <fmt/core.h>

#include <algorithm>

#include "compare/doubts/doubts.hpp"
#include "compare/measured/condition_views.hpp"
#include "compare/measured/time_log.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/report/number_text.hpp"
#include "compare/sweep/result_json.hpp"
#include "compare/telling/reports.hpp"

namespace soilbin::compare {
namespace {

constexpr const char* how_means_are_made =
    "A mean is that of the steady part: transients are cut off at both ends by MSER-5 (White, Cobb and Spratt 2000). "
    "Its standard error is by blocks of four autocorrelation times (Sokal 1997), so samples that follow each other do "
    "not count as independent; the effective number of samples is (sd/error)^2. This error is within the run: only "
    "re-runs show how much another bed differs.";

std::string lines_in_words(int first, int last) { return fmt::format("{}-{}", first, last); }

std::string parting_sentence(const LogRuns& made) {
  return fmt::format("Runs were separated by the changes of {}{}.",
                     made.parted_by.empty() ? "slip, load and other conditions" : made.parted_by,
                     made.has_clock ? ", and by breaks of the clock" : "");
}

std::vector<std::string> notes_and_periods(const LogRuns& made) {
  std::vector<std::string> notes = made.notes;
  if (made.has_clock && made.periods < made.runs.size())
    notes.push_back(
        fmt::format("{} runs form {} unbroken period{} of time. Runs that follow each other on one bed share its "
                    "differences, and a campaign takes each run for one on a freshly prepared bed.",
                    made.runs.size(), made.periods, made.periods == 1 ? "" : "s"));
  return notes;
}

Table logged_runs_table(const LogRuns& made) {
  Table table{"", {"run", "setpoint", "lines", "samples", "load [N]", "slip [%]"}, {}};
  std::vector<std::size_t> measured;
  for (std::size_t c = 0; c < channel_views.size(); ++c)
    if (std::ranges::any_of(made.runs, [&](const auto& one) { return one.channels[c].has_value(); })) {
      measured.push_back(c);
      table.header.push_back(heading(channel_views[c]));
    }
  for (const LoggedRun& one : made.runs) {
    std::vector<TableCell> row = {std::to_string(*one.run.at.run),
                                  one.run.setpoint.value_or("-"),
                                  lines_in_words(one.first_line, one.last_line),
                                  fmt::format("{} of {}", one.samples - one.cut_before - one.cut_after, one.samples),
                                  number(one.run.at.load),
                                  number(100 * one.run.at.slip)};
    for (const std::size_t c : measured) {
      const double per_si = channel_views[c].per_si;
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

/// Samples that make no run: each ramp and the like by itself, short ones together.
std::vector<std::string> lines_left_out(const std::vector<LeftOut>& all) {
  constexpr std::size_t most = 12;
  if (all.empty()) return {};
  std::size_t samples = 0;
  for (const LeftOut& one : all) samples += one.samples;
  std::vector<std::string> lines = {
      fmt::format("Left out: {} in {}.", counted(samples, "sample"), counted(all.size(), "part"))};
  for (std::size_t i = 0; i < std::min(most, all.size()); ++i)
    lines.push_back(fmt::format("  lines {}: {}", lines_in_words(all[i].first_line, all[i].last_line), all[i].why));
  if (all.size() > most) lines.push_back(fmt::format("  and {} more (--json has all)", all.size() - most));
  return lines;
}

Json logged_runs_json(const LogRuns& made) {
  Json document = {{"format", "soilbin-runs/1"},
                   {"parted", parting_sentence(made)},
                   {"notes", notes_and_periods(made)},
                   {"method", how_means_are_made}};
  document["runs"] = list_of(made.runs, [](const LoggedRun& one) {
    Json row = {{"run", *one.run.at.run}};
    if (one.run.setpoint) row["setpoint"] = *one.run.setpoint;
    row["lines"] = {one.first_line, one.last_line};
    row["samples"] = one.samples, row["cut_before"] = one.cut_before, row["cut_after"] = one.cut_after;
    row["at"] = to_json(one.run.at);
    for (std::size_t c = 0; c < channel_views.size(); ++c)
      if (const auto& mean = one.channels[c]) {
        Json& channel = row[std::string(channel_views[c].name)];
        channel = estimate_json(mean->mean);
        channel["sd"] = mean->sd, channel["effective_samples"] = mean->effective;
      }
    row["doubts"] = in_words(doubts(one));
    return row;
  });
  document["left_out"] = list_of(made.left_out, [](const LeftOut& one) {
    return Json{{"lines", {one.first_line, one.last_line}}, {"samples", one.samples}, {"why", one.why}};
  });
  return document;
}

}  // namespace

Report report_on(const LogRuns& made, const std::string& file, const std::map<std::string, DataColumn>& named) {
  const std::string what = fmt::format("{} of {}", counted(made.runs.size(), "run"), file);
  Report report{what, "A rig's time log made a campaign's table: one row a run.", what + ". " + parting_sentence(made)};
  report.add(Prose{{parting_sentence(made)}}, Told::to_look_at);
  report.add("Runs", logged_runs_table(made));
  if (const std::vector<std::string> left_out = lines_left_out(made.left_out); !left_out.empty())
    report.add("Samples of no run", Items{left_out});
  report.notes = {how_means_are_made};
  for (std::string& note : notes_and_periods(made)) report.notes.push_back(std::move(note));
  report.data = [&made] { return logged_runs_json(made); };
  report.csv = [&made, named] { return runs_csv(made, named); };
  report.csv_name = "runs";
  return report;
}

}  // namespace soilbin::compare
