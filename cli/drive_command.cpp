// soilbin drive: the wheel of a case driven in time, from rest to where it arrives or gets stuck.
#include <fmt/core.h>

#include <memory>

#include "cli/commands.hpp"
#include "cli/flag_values.hpp"
#include "cli/outputs.hpp"
#include "cli/progress.hpp"
#include "cli/soil_bin.hpp"
#include "cli/versions.hpp"
#include "compare/drives/drive.hpp"
#include "compare/drives/drive_sides.hpp"
#include "compare/experiments/grain_drives.hpp"
#include "compare/telling/reports.hpp"
#include "scenario/errors.hpp"

namespace soilbin::cli {
namespace {

struct DriveOptions {
  std::string name, model = "bekker_wong";
  OutputFlags outputs;
  int samples = 400;
  bool ledger = false;
  SoilBinFlags soil_bin;
};

int threads_of(const DriveOptions& options) {
  return options.soil_bin.threads > 0 ? options.soil_bin.threads : all_cores();
}

int drive_analytically(const DriveOptions& options, const Case& question, const Session& session) {
  const compare::AnalyticDrive part =
      compare::run_drive(question, options.samples, shown_progress_in_time(), threads_of(options));
  return publish(compare::report_on(part), options.outputs, compare::doubts(part), session).status(done);
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

int drive_with_grains(const DriveOptions& options, const Case& question, const Session& session) {
  compare::GrainDrives grains(settings_for(options, *question.drive), question, options.samples,
                              options.soil_bin.packings, {options.soil_bin.replay, source_state()});
  std::vector<compare::DriveSide> sides;
  if (options.model == "both")
    sides.push_back(compare::analytic_side(
        compare::run_drive(question, options.samples, shown_progress_in_time(), threads_of(options))));
  grains.run();
  sides.insert(sides.end(), grains.sides().begin(), grains.sides().end());
  const compare::DriveSides drive = compare::side_by_side(question, std::move(sides), grains.notes());
  compare::Doubts doubts = compare::doubts(drive);
  append(doubts, bed_doubts(options.soil_bin, question));
  const Outputs outputs = publish(compare::report_on(drive), options.outputs, doubts, session);
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
  add_value(*command, "--samples", options->samples, "WHOLE", "intervals of time that are recorded; 400")
      ->check(whole_number(1, 1000000));
  options->outputs.add_to(*command, {.json = "soilbin-drive/1, with grains soilbin-drive-sides/1; in SI",
                                     .plot = "draw speed, slip, sinkage, torque, forces and energy against time",
                                     .csv = "save every sample"});
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
