#include "cli/vehicle_question.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "cli/flag_values.hpp"
#include "scenario/nearest_word.hpp"
#include "scenario/source_text.hpp"

namespace soilbin::cli {
namespace {

/// Drives these axles, "front,rear", and lets the others roll freely: what their motors give goes with it.
void drive_axles(const std::string& names, std::vector<compare::VehicleAxle>& axles) {
  std::vector<std::string> known;
  for (const compare::VehicleAxle& axle : axles) known.push_back(axle.name);
  const std::vector<std::string> driven = split(names, ",");
  for (const std::string& name : driven)
    if (std::ranges::find(known, name) == known.end())
      throw InputError(fmt::format("--driven: no axle is called '{}'{}\n  hint: there are {}", clipped(name),
                                   did_you_mean(name, known), listed(known)));
  for (compare::VehicleAxle& axle : axles) {
    axle.driven = std::ranges::find(driven, axle.name) != driven.end() ? YesNo::yes : YesNo::no;
    if (axle.driven == YesNo::no)
      axle.largest_torque.reset(), axle.motor.reset(), axle.differential.reset(), axle.torque_share.reset();
  }
}

void inflate(double pressure, std::vector<compare::VehicleAxle>& axles) {
  for (compare::VehicleAxle& axle : axles) {
    axle.tire.inflation_pressure = pressure;
    axle.tire.sources["inflation_pressure"] = command_line_source;
  }
}

}  // namespace

VehicleQuestion::VehicleQuestion(CLI::App& app) {
  add_value(app, "vehicle", name_, "VEHICLE", "a vehicle of the library, or a file (soilbin-vehicle-case/1)")
      ->required();
  condition_.add_to(app, "Condition");
  machine_.add_to(app, "Vehicle, in place of the file's");
  centre_of_gravity_.add_to(app, "Vehicle, in place of the file's", "centre-of-gravity-");
  add_value(app, "--driven", driven_, "AXLE,...", "the axles that are driven, by their names; the others roll freely")
      ->group("Vehicle, in place of the file's");
  add_value(app, "--inflation-pressure", pressure_, "kPa", "of all its tires")
      ->group("Vehicle, in place of the file's");
  add_value(app, "--soil", soil_, "NAME|FILE", "in place of the file's soil");
  soil_values_.add_to(app, "Values of the soil, in place of its own");
  add_repeatable(
      app, "--effect", effects_, "ID[:FORM][,PARAMETER=VALUE...]",
      "in place of the file's effects; may be given again; none: all off; declared: the file's off, what the "
      "tires declare on")
      ->group("Model");
  app.add_flag("--rigid", left_out_.pressure, "rigid wheels, whatever pressure the tires declare")->group("Model");
  app.add_flag("--no-lugs", left_out_.lugs, "smooth wheels, whatever lugs the tires declare")->group("Model");
}

void VehicleQuestion::change(compare::VehicleCase& vehicle) const {
  if (left_out_.pressure && !pressure_.empty())
    throw InputError("--rigid: a rigid wheel has no inflation pressure\n  hint: leave one of the two out");
  machine_.apply(vehicle);
  centre_of_gravity_.apply(vehicle.centre_of_gravity);
  if (!driven_.empty()) drive_axles(driven_, vehicle.axles);
  if (!pressure_.empty()) inflate(read_flag("--inflation-pressure", pressure_, {"kPa", zero_or_more}), vehicle.axles);
  if (!machine_.any_given() && !centre_of_gravity_.any_given() && driven_.empty() && pressure_.empty()) return;
  vehicle.name += ", changed";
  if (const std::string wrong = contradiction(vehicle); !wrong.empty())
    throw InputError(wrong + "\n  hint: these flags do not go with that; a file of your own says all of it");
}

compare::TireLeftOut VehicleQuestion::left_out() const {
  compare::TireLeftOut left_out = left_out_;
  left_out.effects = switch_effects_off(effects_);
  return left_out;
}

void VehicleQuestion::refuse_what_its_drive_says(const compare::VehicleDrive& drive) const {
  for (const char* key : {"slope", "pull"})
    if (condition_.given(key) && !drive.profile.empty())
      throw InputError(fmt::format("--{} has no effect: the file's drive has a profile of its own", key));
  if (condition_.given("speed") && drive.controller)
    throw InputError("--speed has no effect: the file's drive has a controller of its own");
}

void VehicleQuestion::refuse_what_is_measured(const compare::MeasuredVehicle& measured) const {
  const bool pulls = measured.channel != compare::VehicleChannel::slope;
  if (condition_.given("slope") && measured.tells_slopes)
    throw InputError("--slope has no effect: the measured file has the slopes");
  if (condition_.given("pull") && pulls) throw InputError("--pull has no effect: the measured file has the pulls");
}

compare::VehicleCase VehicleQuestion::ask(const Workplace& place) const {
  compare::VehicleCase vehicle = compare::find_vehicle_case(name_, place.library, place.effects);
  condition_.apply(vehicle.condition);
  change(vehicle);
  if (!soil_.empty()) vehicle.soil = find_soil(soil_, place.library);
  if (const std::string& density = soil_values_.text("density"); !density.empty()) pick_bed(vehicle.soil, density);
  soil_values_.apply(vehicle.soil);
  if (!effects_.empty()) vehicle.effects = effects_named(effects_, place.effects, vehicle.soil);
  return vehicle;
}

}  // namespace soilbin::cli
