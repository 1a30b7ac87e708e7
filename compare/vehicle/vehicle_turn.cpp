#include "compare/vehicle/vehicle_turn.hpp"

#include <algorithm>
#include <cmath>

#include "compare/vehicle/vehicle_errors.hpp"
#include "compare/vehicle/vehicle_speed.hpp"

namespace soilbin::compare {
namespace {

void require_turning(const VehicleCase& question) {
  if (question.condition.slope != 0.0 || question.condition.cross_slope != 0.0)
    throw InputError("a turn is asked on level ground: on a slope no turn is steady");
  const double first = question.axles.front().x;
  if (std::ranges::all_of(question.axles, [&](const VehicleAxle& axle) { return axle.x == first; }))
    throw InputError("one axle alone does not stand in a turn: give the vehicle two or more");
  const bool sides = question.drive_line == DriveLine::sides || question.drive_line == DriveLine::motors;
  if (sides || std::ranges::any_of(question.axles, is_steered)) return;
  throw InputError(
      "no axle is steered, and its drive line turns both sides alike\n  hint: 'steered: yes' of an axle, or "
      "'drive_line: sides'");
}

/// Angle of the middle of an axle [rad]: its two wheels stand square to one centre, so that their cotangents' mean is
/// its own.
double steer_of_axle(const SteadyVehicle& vehicle, const std::vector<VehicleWheel>& wheels, std::size_t axle) {
  double cotangents = 0.0, count = 0.0;
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    if (wheels[i].axle != axle) continue;
    if (vehicle.wheels[i].steer == 0.0) return 0.0;
    cotangents += 1.0 / std::tan(vehicle.wheels[i].steer), count += 1.0;
  }
  return std::atan(count / cotangents);
}

double fastest_wheel(const SteadyVehicle& vehicle) {
  double fastest = 0.0;
  for (const SteadyWheel& wheel : vehicle.wheels) fastest = std::max(fastest, wheel.result.at.speed);
  return fastest;
}

/// The turns of one vehicle to one side.
class Turns {
 public:
  Turns(const VehicleCase& question, const std::vector<VehicleWheel>& wheels, const Model& model)
      : question_(question), wheels_(wheels), vehicles_(question, wheels, model) {}

  /// What kept it from the last turn that it did not have.
  TurnEnd end{};
  /// On the way to the tightest.
  std::vector<VehicleTurn> passed{};

  /// The steady turn of a curvature [1/m], where steering and motors allow it; `stop`: of the steering, in place of
  /// what the axles declare [rad].
  std::optional<VehicleTurn> of(double curvature, const std::optional<double>& stop = {}) {
    VehicleCondition at = question_.condition;
    at.curvature = curvature;
    std::optional<VehicleTurn> turn = in(at, stop);
    if (turn) turn->radius = 1.0 / curvature, turn->rate = at.speed * curvature;
    if (turn) turn->widest = fastest_wheel(turn->vehicle) / std::abs(turn->rate);
    return turn;
  }

  /// On the spot, to the left.
  std::optional<VehicleTurn> on_the_spot() {
    VehicleCondition at = question_.condition;
    at.on_the_spot = true;
    std::optional<VehicleTurn> turn = in(at, {});
    if (turn) turn->rate = at.speed / vehicles_.half_track();
    if (turn) turn->widest = fastest_wheel(turn->vehicle) / turn->rate;
    return turn;
  }

  /// In a condition that turns it.
  std::optional<VehicleTurn> in(const VehicleCondition& at, const std::optional<double>& stop) {
    VehicleTurn turn;
    try {
      turn.vehicle = vehicles_.pulling(at);
    } catch (const VehicleGaveOut& error) {
      end = {TurnLimit::balance, {}, as_failure(error)};
      return {};
    }
    if (beyond_stop(turn.vehicle, stop)) {
      end = {TurnLimit::steering, {}, {}};
      return {};
    }
    if (const std::optional<TravelLimit> limit = not_held_by(question_, turn.vehicle)) {
      end = {TurnLimit::motors, *limit, {}};
      return {};
    }
    return turn;
  }

  /// The tightest one: the curvature grows from all but straight until it has none; then by halves.
  std::optional<VehicleTurn> tightest(double side, const std::optional<double>& stop = {}) {
    constexpr double nearly_straight = 1e-3, grows = 1.4, close = 1e-6;
    double width = 0.0, length = 0.0;
    for (const VehicleWheel& wheel : wheels_) {
      width = std::max(width, std::abs(wheel.place.y - question_.centre_of_gravity.y));
      length = std::max(length, std::abs(wheel.place.x - question_.centre_of_gravity.x));
    }
    const double last = 1.0 / std::max(width, 0.1 * length);  // its centre under the wheels
    double low = nearly_straight / length, high = low;
    std::optional<VehicleTurn> found = of(side * low, stop);
    if (!found) return {};
    passed = {*found};
    while (high < last) {
      high = std::min(high * grows, last);
      std::optional<VehicleTurn> next = of(side * high, stop);
      if (!next) break;
      found = std::move(next), low = high;
      passed.push_back(*found);
    }
    if (low == high) end = {TurnLimit::balance, {}, {GaveOut::backward, {}, ""}};
    while (high - low > close * high) {
      const double middle = 0.5 * (low + high);
      if (std::optional<VehicleTurn> next = of(side * middle, stop))
        found = std::move(next), low = middle;
      else
        high = middle;
    }
    passed.push_back(*found);
    return found;
  }

 private:
  bool beyond_stop(const SteadyVehicle& vehicle, const std::optional<double>& stop) const {
    if (stop && std::abs(vehicle.steering) > *stop) return true;
    for (std::size_t axle = 0; axle < question_.axles.size(); ++axle)
      if (const auto& most = question_.axles[axle].largest_steer;
          most && std::abs(steer_of_axle(vehicle, wheels_, axle)) > *most)
        return true;
    return false;
  }

  const VehicleCase& question_;
  const std::vector<VehicleWheel>& wheels_;
  SteadyVehicles vehicles_;
};

/// Standard error of the radius at which the steering is what it is [m], by how it changes with radius and soil.
double error_of_radius(const VehicleTurn& turn, double steering_error, const SteadyVehicles& vehicles) {
  constexpr double share = 1e-4;
  VehicleCondition at = turn.vehicle.at;
  const auto steering = [&](double radius) {
    at.curvature = 1.0 / radius;
    return vehicles.pulling(at).steering;
  };
  try {
    const double step = share * turn.radius;
    return std::abs(steering_error * 2 * step / (steering(turn.radius + step) - steering(turn.radius - step)));
  } catch (const VehicleGaveOut&) {
    return not_a_number;
  }
}

}  // namespace

std::size_t slips_most(const SteadyVehicle& vehicle) {
  const auto slips = [](const SteadyWheel& wheel) {
    const OperatingCondition& at = wheel.result.at;
    return wheel.lifted ? -1.0 : std::hypot(at.slip, std::sin(at.yaw));
  };
  return static_cast<std::size_t>(std::ranges::max_element(vehicle.wheels, {}, slips) - vehicle.wheels.begin());
}

TurnAnswers turn_of(const VehicleCase& question, const std::vector<VehicleWheel>& wheels, const Model& model,
                    const TurnAsked& asked) {
  require_turning(question);
  const bool on_the_spot = asked.radius == 0.0;
  if (on_the_spot && std::ranges::any_of(question.axles, is_steered))
    throw InputError(
        "a steered axle does not turn it on the spot\n  hint: 'steered: no' for all axles, which turns it by "
        "its sides; or a radius other than 0");
  if (on_the_spot && question.condition.pull != 0.0)
    throw InputError("on the spot it pulls nothing\n  hint: --pull 0N");
  if (asked.steer && std::ranges::none_of(question.axles, is_steered))
    throw InputError("no axle is steered: ask for a radius");
  const double side = asked.radius.value_or(asked.steer.value_or(1.0)) < 0.0 ? -1.0 : 1.0;
  TurnAnswers answers{question, wheels, asked};
  Turns turns(question, wheels, model);
  answers.tightest = turns.tightest(side);
  answers.end = turns.end, answers.ever_tighter = std::move(turns.passed);
  if (asked.radius) {
    answers.turn = on_the_spot ? turns.on_the_spot() : turns.of(1.0 / *asked.radius);
    if (!answers.turn) answers.why_not = turns.end;
  } else if (asked.steer) {
    answers.turn = turns.tightest(side, std::abs(*asked.steer));
    if (turns.end.limit != TurnLimit::steering) answers.turn.reset(), answers.why_not = turns.end;
  } else {
    answers.turn = answers.tightest;
    if (!answers.turn) answers.why_not = answers.end;
  }
  if (answers.turn) answers.errors = errors_of_steady(question, wheels, model, answers.turn->vehicle.at);
  answers.tightest_error = not_a_number;
  if (!answers.tightest || answers.end.limit != TurnLimit::steering) return answers;
  const bool is_asked = !asked.radius && !asked.steer;
  const SteadyErrors errors =
      is_asked ? answers.errors : errors_of_steady(question, wheels, model, answers.tightest->vehicle.at);
  answers.tightest_error = error_of_radius(*answers.tightest, errors.steering, SteadyVehicles(question, wheels, model));
  return answers;
}

}  // namespace soilbin::compare
