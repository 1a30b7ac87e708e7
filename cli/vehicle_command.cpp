// soilbin vehicle: a vehicle's wheels on soil: does it go, how steep, and which wheel gives out.
#include <fmt/format.h>

#include <memory>
#include <utility>

#include "bekker_wong/model.hpp"
#include "cli/commands.hpp"
#include "cli/flag_values.hpp"
#include "cli/outputs.hpp"
#include "cli/progress.hpp"
#include "cli/vehicle_question.hpp"
#include "compare/telling/reports.hpp"
#include "compare/vehicle/vehicle_answers.hpp"
#include "compare/vehicle/vehicle_doubts.hpp"
#include "scenario/csv.hpp"

namespace soilbin::cli {
namespace {

struct VehicleOptions {
  explicit VehicleOptions(CLI::App& app) : asked(app) {}

  VehicleQuestion asked;
  std::string map, measured;
  unsigned samples = 50;
  bool drive = false, turn = false;
  std::string radius, steer;
  OutputFlags outputs;
};

/// The wheel until somebody presses Ctrl-C: a vehicle asks it many thousand times.
class StoppableWheel : public Model {
 public:
  std::string name() const override { return wheel_.name(); }
  TractionResult evaluate(const Scenario& scenario, const OperatingCondition& at) const override {
    if (interrupt_asked()) throw Interrupted();
    return wheel_.evaluate(scenario, at);
  }

 private:
  bekker_wong::BekkerWong wheel_{{.errors = false, .patch = false}};
};

compare::TurnAsked turn_asked(const VehicleOptions& options) {
  compare::TurnAsked asked;
  set_where_given("--radius", options.radius, {"m", any_value}, asked.radius);
  set_where_given("--steer", options.steer, {"deg", inclines}, asked.steer);
  return asked;
}

int vehicle(const VehicleOptions& options, const Session& session) {
  const compare::VehicleCase question = options.asked.ask(session.place);
  std::vector<compare::VehicleWheel> wheels = wheels_of(question);
  compare::Doubts notes = declare_tires(wheels, options.asked.left_out());
  const StoppableWheel model;
  const auto publish_about = [&](const auto& answers) {
    return publish(compare::report_on(answers), options.outputs, doubts_about(answers, std::move(notes)), session);
  };
  if (options.drive) {
    options.asked.refuse_what_its_drive_says(question.drive);
    return publish_about(compare::driven_answers(question, wheels, model, drive_intervals, shown_progress_in_time()))
        .status(done);
  }
  if (!options.measured.empty()) {
    const auto measured = compare::read_measured_vehicle(read_source_text(options.measured, largest_csv));
    options.asked.refuse_what_is_measured(measured);
    return publish_about(compare::beside_measured(question, wheels, model, measured)).status(done);
  }
  if (options.turn) return publish_about(compare::turn_of(question, wheels, model, turn_asked(options))).status(done);
  compare::VehicleAnswers answers = compare::answers_of(question, wheels, model);
  if (!options.map.empty())
    answers.map = compare::go_map(question, wheels, model,
                                  {.samples = static_cast<int>(options.samples), .progress = shown_progress()});
  const compare::Doubts doubts = compare::doubts_about(answers, std::move(notes));
  Outputs outputs =
      publish(compare::report_on(answers, not_decided(answers, doubts)), options.outputs, doubts, session);
  outputs.table_or_drawing(
      options.map, [&] { return compare::csv_of(*answers.map); }, [&] { return compare::svg_of(*answers.map); });
  return outputs.status(done);
}

}  // namespace

void add_vehicle(CLI::App& app, Session& session) {
  CLI::App* command = app.add_subcommand(
      "vehicle", "a vehicle on soil: does it go, how steep up, down and across, which wheel gives out");
  const auto options = std::make_shared<VehicleOptions>(*command);
  CLI::Option* map = add_file(*command, "--map", options->map, "FILE.csv|svg|png|pdf",
                              "the chance to go over slope and heading, by the soil's standard deviations");
  add_value(*command, "--samples", options->samples, "WHOLE", "soils that the map draws (50)")->needs(map);
  CLI::Option* measured =
      add_value(*command, "--measured", options->measured, "FILE.csv",
                "the model beside slopes or pulls that were measured of the whole vehicle at a slip")
          ->excludes(map);
  CLI::Option* turn =
      command->add_flag("--turn", options->turn, "the tightest steady turn on level ground, and what ends it")
          ->excludes(map)
          ->excludes(measured);
  CLI::Option* radius = add_value(*command, "--radius", options->radius, "m",
                                  "of the turn that is asked, to the left positive; 0: on the spot")
                            ->needs(turn);
  add_value(*command, "--steer", options->steer, "deg",
            "steering angle of the turn that is asked, to the left positive")
      ->needs(turn)
      ->excludes(radius);
  command
      ->add_flag("--drive", options->drive,
                 "in time, from rest: as the file's section 'drive' says, else for 30 s at the condition's speed")
      ->excludes(map)
      ->excludes(measured)
      ->excludes(turn);
  options->outputs.add_to(*command, {.json = "soilbin-vehicle-answer/1, in a turn soilbin-vehicle-turn/1, in time "
                                             "soilbin-vehicle-drive/1, beside measurements "
                                             "soilbin-vehicle-measured/1; in SI",
                                     .plot = "draw pull and sinkages against slip, turns against their radius, the "
                                             "drive against time, or the measured points and the model",
                                     .csv = "save pull and wheels against slip, the wheels in the turn, every sample "
                                            "of the drive, or the measured points and the model"});
  command->footer(
      "Exit status 1 where the vehicle does not travel in the condition that is asked, in time where it does not stand "
      "at its start.\n"
      "Examples: soilbin vehicle truck --slope 5deg --pull 2kN\n"
      "          soilbin vehicle tractor --driven rear --mass 7t --friction-angle 28+-2deg\n"
      "          soilbin vehicle truck --turn --radius 12m\n"
      "          soilbin vehicle mine.yaml --measured climbs.csv --plot climbs.svg\n"
      "          soilbin vehicle rover --drive --slope 10deg --report climb.html");
  command->callback([=, &session] { session.action = [=, &session] { return vehicle(*options, session); }; });
}

}  // namespace soilbin::cli
