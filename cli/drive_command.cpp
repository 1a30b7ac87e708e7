// soilbin drive: the wheel of a case driven in time, from rest to where it arrives or gets stuck.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "cli/commands.hpp"
#include "cli/flag_values.hpp"
#include "cli/progress.hpp"
#include "cli/soil_bin.hpp"
#include "cli/text_output.hpp"
#include "cli/versions.hpp"
#include "compare/drives/drive.hpp"
#include "compare/drives/drive_sides.hpp"
#include "compare/experiments/grain_drives.hpp"
#include "compare/sweep/result_json.hpp"
#include "compare/sweep/varying.hpp"
#include "scenario/errors.hpp"
#include "scenario/unit.hpp"

namespace soilbin::cli {
namespace {

constexpr std::size_t shown_rows = 12;

struct DriveOptions {
  std::string name, model = "bekker_wong", plot, report;
  CsvOutput csv;
  int samples = 400;
  bool json = false, ledger = false;
  SoilBinFlags soil_bin;
};

bekker_wong::DriveProgress progress_in_time() {
  constexpr double parts = 1000.0;
  return [shown = shown_progress()](double time, double duration) {
    shown(static_cast<std::size_t>(std::max(1.0, std::floor(parts * time / duration))),
          static_cast<std::size_t>(parts));
  };
}

int threads_of(const DriveOptions& options) {
  return options.soil_bin.threads > 0 ? options.soil_bin.threads : all_cores();
}

/// Writes what is asked for as files.
template <class Answer>
Outputs save(const DriveOptions& options, const Answer& answer, const std::string& title,
             const std::vector<std::string>& doubts, const Session& session) {
  Outputs outputs;
  outputs.csv(options.csv, [&] { return compare::drive_csv(answer); });
  outputs.drawing(options.plot, [&] { return compare::drive_sheet(answer); });
  outputs.file(options.report, [&] {
    return compare::drive_page(answer, {title, session.command, versions(), doubts});
  });
  return outputs;
}

std::string drive_text(const compare::AnalyticDrive& part) {
  std::string text = fmt::format("{}: {} on {}\n\n{}\n", part.question.name, in_words(part.question.scenario.tire),
                                 compare::in_words(part.question.scenario.soil),
                                 as_text(compare::samples_table(part.record, shown_rows)));
  for (const DriveHappening& h : part.record.happenings)
    text += fmt::format("At {} s and {} m {}.\n", number(h.time), number(h.travelled), word_of(h.what));
  for (const std::string& sentence : compare::in_words(part)) text += sentence + "\n";
  return text + "\n" + as_text(compare::energy_table(part.record.samples.back().energy, compare::WorkTable::in_text));
}

int drive_analytically(const DriveOptions& options, const Case& question, const Session& session) {
  const compare::AnalyticDrive part =
      compare::run_drive(question, options.samples, progress_in_time(), threads_of(options));
  const std::vector<std::string> doubts = compare::doubts(part);
  print_warnings(doubts);
  const Outputs outputs = save(options, part, question.name, doubts, session);
  if (options.json)
    print_json(compare::to_json(part), doubts);
  else
    fmt::print("{}", drive_text(part));
  return outputs.status(done);
}

/// The bed is as long as the way needs, where no length is asked for.
dem::DemSettings settings_for(const DriveOptions& options, const Drive& drive) {
  dem::DemSettings settings = settings_of(options.soil_bin);
  settings.rig.ledger = options.ledger;
  if (const double length = dem::bed_length_for(drive, settings.rig);
      options.soil_bin.text("--bed-length").empty() && length > 0.0)
    settings.size.length = length;
  return settings;
}

std::string without_caption(compare::Table table) {
  table.caption.clear();
  return "\n" + as_text(table);
}

std::string sides_text(const compare::DriveSides& drive) {
  std::string text =
      fmt::format("{}: {} on {}\n\n{}\n", drive.question.name, in_words(drive.question.scenario.tire),
                  compare::in_words(drive.question.scenario.soil), as_text(compare::samples_table(drive, shown_rows)));
  for (const compare::DriveSide& side : drive.sides)
    for (const DriveHappening& h : side.happenings)
      text +=
          fmt::format("{}: at {} s and {} m {}.\n", side.label, number(h.time), number(h.travelled), word_of(h.what));
  for (const std::string& sentence : compare::in_words(drive)) text += sentence + "\n";
  if (drive.over_packings) text += without_caption(compare::packings_table(drive));
  if (!drive.differences.empty()) text += without_caption(compare::differences_table(drive));
  text += "\n" + as_text(compare::work_table(drive, compare::WorkTable::in_text)) + "\n";
  for (const std::string& note : drive.notes) text += note + "\n";
  return text;
}

int drive_with_grains(const DriveOptions& options, const Case& question, const Session& session) {
  compare::GrainDrives grains(settings_for(options, *question.drive), question, options.samples,
                              options.soil_bin.packings, {options.soil_bin.replay, source_state()});
  std::vector<compare::DriveSide> sides;
  if (options.model == "both")
    sides.push_back(
        compare::analytic_side(compare::run_drive(question, options.samples, progress_in_time(), threads_of(options))));
  grains.run();
  sides.insert(sides.end(), grains.sides().begin(), grains.sides().end());
  const compare::DriveSides drive = compare::side_by_side(question, std::move(sides), grains.notes());
  std::vector<std::string> doubts = compare::doubts(drive);
  for (std::string& doubt : bed_doubts(options.soil_bin, question)) doubts.push_back(std::move(doubt));
  print_warnings(doubts);
  const Outputs outputs = save(options, drive, question.name, doubts, session);
  if (options.json)
    print_json(compare::to_json(drive), doubts);
  else
    fmt::print("{}", sides_text(drive));
  if (std::fflush(stdout) == 0 && outputs.complete())
    grains.forget();
  else
    fmt::print(stderr, "soilbin: {}\n", finished_runs_stay);
  return outputs.status(done);
}

int drive(const DriveOptions& options, const CLI::App& command, const Session& session) {
  check_model(options.model, {"bekker_wong", "dem", "both"});
  const Case question = find_case(session.place, options.name);
  if (!question.drive)
    throw InputError(fmt::format("{}: the case has no section 'drive'\n  hint: soilbin run {} answers its study",
                                 options.name, options.name));
  check_flags_of_grains(
      options.soil_bin, command, question,
      {.asked = options.model != "bekker_wong", .hint = "--model dem or both", .read_without_them = {"--threads"}});
  return options.model == "bekker_wong" ? drive_analytically(options, question, session)
                                        : drive_with_grains(options, question, session);
}

}  // namespace

void add_drive(CLI::App& app, Session& session) {
  CLI::App* command = app.add_subcommand("drive", "a wheel driven in time: from rest, along a way, by a motor");
  const auto options = std::make_shared<DriveOptions>();
  add_value(*command, "case", options->name, "CASE", "a case with a section 'drive', of the library or a file")
      ->required();
  add_value(*command, "--model", options->model, "NAME",
            "bekker_wong; dem: on grains, in the virtual soil bin; or both")
      ->capture_default_str();
  add_plot(*command, options->plot, "draw speed, slip, sinkage, torque, forces and energy against time");
  add_csv(*command, options->csv, "save every sample");
  add_file(*command, "--report", options->report, "FILE.html", "save a page to open in a browser");
  add_value(*command, "--samples", options->samples, "WHOLE", "intervals of time that are recorded; 400")
      ->check(whole_number(1, 1000000));
  command->add_flag("--json", options->json, "soilbin-drive/1, with grains soilbin-drive-sides/1; in SI");
  options->soil_bin.add_rig_to(*command);
  add_value(*command, "--packings", options->soil_bin.packings, "N",
            "number of beds, from --packing on; answers are means over them; 1")
      ->check(whole_number(1, compare::most_packings))
      ->group(grains_heading);
  command
      ->add_flag("--ledger", options->ledger,
                 "report what became of the energy that the grains got; takes up to twice as long")
      ->group(grains_heading);
  add_file(*command, "--replay", options->soil_bin.replay, "FILE", "keep the motion, to look at it in 3D")
      ->group(grains_heading);
  command->footer(
      "Examples: soilbin drive rover-climb --report climb.html\n"
      "          soilbin drive drive-in-grains --model both --settling-friction 0 --report sides.html");
  command->callback([=, &session] { session.action = [=, &session] { return drive(*options, *command, session); }; });
}

}  // namespace soilbin::cli
