#include "compare/vehicle/vehicle_doubts.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>
#include <variant>

#include "bekker_wong/model.hpp"
#include "compare/doubts/doubts.hpp"
#include "compare/vehicle/steady_vehicle.hpp"
#include "scenario/unit.hpp"

namespace soilbin::compare {
namespace {

/// By how far [m] a place lies outside of the wheels along an axis: below them negative, above them positive; 0 within,
/// and where all wheels are in one place.
double outside(const std::vector<VehicleWheel>& wheels, double VehiclePoint::*axis, double place) {
  const auto [least, most] =
      std::ranges::minmax(wheels, {}, [&](const VehicleWheel& wheel) { return wheel.place.*axis; });
  const double low = least.place.*axis, high = most.place.*axis;
  if (!(high > low)) return 0.0;
  return place < low ? place - low : std::max(0.0, place - high);
}

void add_place_doubts(const VehicleCase& vehicle, const std::vector<VehicleWheel>& wheels, Doubts& all) {
  const VehiclePoint& centre = vehicle.centre_of_gravity;
  const double along = outside(wheels, &VehiclePoint::x, centre.x),
               across = outside(wheels, &VehiclePoint::y, centre.y);
  if (along != 0.0) all.push_back({DoubtKind::beyond_wheels, {std::abs(along), along > 0 ? "ahead" : "behind"}});
  if (across != 0.0)
    all.push_back({DoubtKind::beyond_wheels, {std::abs(across), across > 0 ? "to the left" : "to the right"}});
  const auto [least, most] = std::ranges::minmax(wheels, {}, [](const VehicleWheel& wheel) { return wheel.place.y; });
  const double beside = std::min(centre.y - least.place.y, most.place.y - centre.y);
  constexpr double usual = 15 * degree;  // chosen: high loads on lorries make some 20 deg
  if (const double tips = std::atan2(beside, centre.z); beside > 0.0 && tips < usual)
    all.push_back({DoubtKind::tips_easily, {centre.z, beside, tips / degree, usual / degree}});
}

/// The load of a wheel over its radius times its width, of the axle that is farthest out. Chosen: rovers and toys press
/// with 1 kPa and more, dump trucks with 300. A tire of p_g presses so with 1.2 p_g where it flattens by a fifth of its
/// radius, as large_deflection has it: its contact is then 1.2 radii long.
void add_load_doubts(const VehicleCase& vehicle, Doubts& all) {
  constexpr double lightest = 500.0, heaviest = 5e5, flat = 1.2;  // [Pa], [Pa], [-]
  std::vector<CarryingAxle> axles;
  for (const VehicleAxle& axle : vehicle.axles) axles.push_back({.spring = axle.x, .place = axle.x});
  const double weight = vehicle.mass * gravity_of(vehicle.soil);
  const std::vector<double> loads = axle_loads(axles, weight, weight * vehicle.centre_of_gravity.x);
  std::optional<Doubt> worst;
  double farthest = 1.0;
  for (std::size_t i = 0; i < loads.size(); ++i) {
    const VehicleAxle& axle = vehicle.axles[i];
    const double load = loads[i] / (axle.track ? 2 : 1), pressure = load / (axle.tire.radius * axle.tire.width);
    const std::optional<double> tire = declared_ground_pressure(axle.tire);
    const double most = tire ? std::min(flat * *tire, heaviest) : heaviest;
    const double off = std::max(lightest / pressure, pressure / most);
    if (!(off > farthest)) continue;
    farthest = off;
    worst = {DoubtKind::unusual_wheel_load,
             {axle.name, load, pressure / 1000, lightest / 1000, most / 1000,
              tire && most < heaviest ? axle.tire.name : ""}};
  }
  if (worst) all.push_back(*worst);
}

/// A vehicle that is driven, pulls or climbs, and hardly slips: estimate warns of it where the slip was asked for.
Doubts slips_little(const VehicleAnswers& answers, const Doubts& told) {
  constexpr double little = 0.05;
  const auto tells = [](const Doubt& doubt) { return doubt.kind == DoubtKind::drives_without_slip; };
  if (!answers.steady || std::ranges::any_of(told, tells)) return {};
  double most = -1.0;
  for (const SteadyWheel& wheel : answers.steady->wheels)
    if (!wheel.lifted && wheel.power_in > 0.0) most = std::max(most, wheel.result.at.slip);
  if (most == -1.0 || most >= little) return {};
  return {Doubt{DoubtKind::slips_little, {100 * most}}};
}

std::optional<double> steepness(const VehicleLimit& limit) {
  return limit.angle ? std::optional(limit.angle->value) : std::nullopt;
}

/// A slope so near the steepest one that the soil's errors decide whether the vehicle travels.
Doubts hardly_decided(const VehicleAnswers& answers) {
  const VehicleCondition& at = answers.question.condition;
  if (!answers.up.angle || at.cross_slope != 0.0) return {};
  const auto [steepest, error] = *answers.up.angle;
  if (!(std::abs(steepest - at.slope) < error)) return {};
  return {Doubt{DoubtKind::travel_not_decided, {steepest / degree, error / degree, at.slope / degree}}};
}

/// The vehicle in its condition; where it has no balance there, at the slip that pulls most; nullptr without any.
const SteadyVehicle* state_to_doubt(const VehicleAnswers& answers) {
  if (answers.steady) return &*answers.steady;
  const VehiclePullRow* most = nullptr;
  for (const VehiclePullRow& row : answers.pulls)
    if (row.vehicle && (most == nullptr || row.vehicle->pull > most->vehicle->pull)) most = &row;
  return most != nullptr ? &*most->vehicle : nullptr;
}

/// The steepest slope straight up [rad] on wheels that are as_in_grains.
std::optional<double> climb_as_in_grains(const VehicleAnswers& answers) {
  std::vector<VehicleWheel> wheels = answers.wheels;
  for (VehicleWheel& wheel : wheels) wheel.scenario = as_in_grains(wheel.scenario);
  return steepness(
      steepest_climb(answers.question, wheels, bekker_wong::BekkerWong({.errors = false, .patch = false})));
}

}  // namespace

Doubts doubts(const VehicleCase& vehicle) {
  Doubts all;
  const std::vector<VehicleWheel> wheels = wheels_of(vehicle);
  add_place_doubts(vehicle, wheels, all);
  if (all.empty() || all.front().kind != DoubtKind::beyond_wheels) add_load_doubts(vehicle, all);
  return all;
}

Doubts doubts_about(const VehicleAnswers& answers, Doubts notes) {
  append(notes, doubts(answers.question));
  std::set<std::size_t> axles;
  const SteadyVehicle* state = state_to_doubt(answers);
  for (std::size_t i = 0; state != nullptr && i < answers.wheels.size(); ++i) {
    const VehicleWheel& wheel = answers.wheels[i];
    if (state->wheels[i].lifted || !axles.insert(wheel.axle).second) continue;
    const TractionResult& result = state->wheels[i].result;
    Case question = question_of(wheel.scenario);
    question.name = wheel.name;
    question.study.conditions = {result.at};
    append(notes, doubts(question, {{question.study.models.front(), {{result.at, result, ""}}}}));
  }
  append(notes, slips_little(answers, notes));
  append(notes, hardly_decided(answers));
  append(notes,
         doubts_of_climb(notes, "the vehicle", steepness(answers.up), [&] { return climb_as_in_grains(answers); }));
  std::erase_if(notes, [](const Doubt& doubt) {
    // Wheels in front have no rut, the speed makes the power, gravity the loads; axles tell the pass.
    return doubt.kind == DoubtKind::effect_without_pass || doubt.kind == DoubtKind::speed_ignored ||
           (doubt.kind == DoubtKind::soil_weight_ignored && doubt.says[0] == Said("gravity")) ||
           (doubt.kind == DoubtKind::condition_ignored && doubt.says[0] == Said("pass"));
  });
  return once_each(notes);
}

std::optional<NotDecided> not_decided(const VehicleAnswers& answers, const Doubts& told) {
  if (answers.steady && !answers.holds_speed()) return {};  // whatever the soil
  NotDecided open;
  if (tell_of(told, DoubtKind::travel_not_decided)) open.steepest = answers.up.angle;
  const VehicleCondition& at = answers.question.condition;
  if (tell_of(told, DoubtKind::heavy_climb) && answers.up.angle && at.cross_slope == 0.0) {
    const double other = climb_as_in_grains(answers).value_or(0.0);
    const auto [low, high] = std::minmax(other, answers.up.angle->value);
    if (at.slope > low && at.slope <= high) open.as_in_grains = other;
  }
  return open.steepest || open.as_in_grains ? std::optional(open) : std::nullopt;
}

Doubts doubts_about(const TurnAnswers& answers, Doubts notes) {
  VehicleAnswers steady{answers.question, answers.wheels};
  if (answers.turn) steady.steady = answers.turn->vehicle;
  return doubts_about(steady, std::move(notes));
}

Doubts doubts_about(const MeasuredAnswers& answers, Doubts notes) {
  VehicleAnswers steady{answers.question, answers.wheels};
  for (const ModelledState& state : answers.modelled)
    if (state.vehicle && (!steady.steady || state.slip > steady.steady->slip)) steady.steady = state.vehicle;
  return doubts_about(steady, std::move(notes));
}

Doubts doubts_about(const DrivenAnswers& answers, Doubts notes) {
  append(notes, doubts(answers.question));
  append(notes, doubts(answers.question.soil));
  return once_each(notes);
}

}  // namespace soilbin::compare
