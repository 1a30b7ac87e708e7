// soilbin drive: the wheel of a case driven in time, from rest to where it arrives or gets stuck.
#include <fmt/core.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "cli/commands.hpp"
#include "cli/progress.hpp"
#include "cli/text_output.hpp"
#include "cli/versions.hpp"
#include "compare/report/drive_report.hpp"
#include "compare/report/result_json.hpp"
#include "scenario/atomic_file.hpp"
#include "scenario/errors.hpp"

namespace soilbin::cli {
namespace {

constexpr std::size_t shown_rows = 12;

struct DriveOptions {
  std::string name, plot, csv, report;
  int samples = 400;
  bool json = false;
};

bekker_wong::DriveProgress progress_in_time() {
  constexpr double parts = 1000.0;
  return [shown = shown_progress()](double time, double duration) {
    shown(static_cast<std::size_t>(std::max(1.0, std::floor(parts * time / duration))),
          static_cast<std::size_t>(parts));
  };
}

std::string slip_text(const bekker_wong::DriveSample& s) { return s.slip ? number(100 * *s.slip) : "-"; }

/// A dozen of the samples, the last among them.
std::string samples_text(const bekker_wong::DriveRecord& record) {
  TextTable table({"time [s]", "travelled [m]", "slope [deg]", "speed [cm/s]", "rim [cm/s]", "slip [%]", "sinkage [mm]",
                   "torque [N m]", "soil force [N]"});
  const std::size_t count = record.samples.size(), rows = std::min(count, shown_rows);
  for (std::size_t row = 0; row < rows; ++row) {
    const bekker_wong::DriveSample& s = record.samples[rows == 1 ? 0 : row * (count - 1) / (rows - 1)];
    table.add({number(s.time), number(s.travelled), number(s.longitudinal_incline * 180 / std::numbers::pi),
               number(100 * s.speed), number(100 * s.rim_speed), slip_text(s), number(1000 * s.sinkage),
               number(s.torque), number(s.forward)});
  }
  return table.text();
}

std::string energy_text(const bekker_wong::EnergyLedger& energy) {
  TextTable table({"of the motor's work", "J", "%"});
  for (const auto& [name, joules] : compare::energy_rows(energy))
    table.add({name, number(joules), energy.motor != 0.0 ? number(100 * joules / energy.motor) : "-"});
  table.add({"in all", number(energy.motor), "100"});
  return table.text();
}

std::string drive_text(const compare::DrivePart& part) {
  std::string text = fmt::format("{}: {} on {}\n\n{}\n", part.question.name, in_words(part.question.scenario.tire),
                                 part.question.scenario.soil.name, samples_text(part.record));
  for (const DriveHappening& h : part.record.happenings)
    text += fmt::format("At {} s and {} m {}.\n", number(h.time), number(h.travelled), word_of(h.what));
  for (const std::string& sentence : compare::in_words(part)) text += sentence + "\n";
  return text + "\n" + energy_text(part.record.samples.back().energy);
}

int drive(const DriveOptions& options, const Session& session) {
  const Case question = find_case(session.place, options.name);
  if (!question.drive)
    throw InputError(fmt::format("{}: the case has no section 'drive'\n  hint: soilbin run {} answers its study",
                                 options.name, options.name));
  const compare::DrivePart part = compare::run_drive(question, options.samples, progress_in_time());
  if (!options.csv.empty()) write_file_atomically(options.csv, compare::drive_csv(part));
  if (!options.plot.empty()) write_file_atomically(options.plot, compare::svg(compare::drive_sheet(part)));
  if (!options.report.empty())
    write_file_atomically(options.report,
                          compare::drive_page(part, {question.name, "soilbin drive " + options.name, versions()}));
  fmt::print("{}", options.json ? compare::json_text(compare::to_json(part)) : drive_text(part));
  return done;
}

}  // namespace

void add_drive(CLI::App& app, Session& session) {
  CLI::App* command = app.add_subcommand("drive", "a wheel driven in time: from rest, along a way, by a motor");
  const auto options = std::make_shared<DriveOptions>();
  command->add_option("case", options->name, "a case with a section 'drive', of the library or a file")
      ->type_name("CASE")
      ->required();
  command->add_option("--plot", options->plot, "draw speed, slip, sinkage, torque, forces and energy against time")
      ->type_name("FILE.svg");
  command->add_option("--csv", options->csv, "save every sample")->type_name("FILE.csv");
  command->add_option("--report", options->report, "save a page to open in a browser")->type_name("FILE.html");
  command->add_option("--samples", options->samples, "intervals of time that are recorded; 400")
      ->type_name("WHOLE")
      ->check(CLI::Range(1, 1000000));
  command->add_flag("--json", options->json, "soilbin-drive/1, in SI");
  command->footer("Example: soilbin drive rover-climb --report climb.html");
  command->callback([=, &session] { session.action = [=, &session] { return drive(*options, session); }; });
}

}  // namespace soilbin::cli
