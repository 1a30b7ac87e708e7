#include "compare/vehicle/vehicle_speed.hpp"

#include <algorithm>
#include <cmath>

#include "bekker_wong/gsl.hpp"
#include "compare/vehicle/vehicle_errors.hpp"
#include "scenario/unit.hpp"
#include "scenario/yawed_frames.hpp"

namespace soilbin::compare {
namespace {

bool has_wheel_motors(const VehicleCase& question) {
  return std::ranges::any_of(question.axles, [](const VehicleAxle& axle) { return axle.motor.has_value(); });
}

/// Spin of the drive line [rad/s].
double line_spin(const VehicleCase& question, const SteadyVehicle& steady) {
  return steady.at.speed / speed_ratio(steady.slip) / question.line_radius();
}

/// Rim speed beyond which no wheel's motor turns [m/s]; HUGE_VAL where one has no curve.
double top_rim_speed(const VehicleCase& question) {
  double top = 0.0;
  for (const VehicleAxle& axle : question.axles)
    if (axle.driven == YesNo::yes)
      top = std::max(top, axle.motor ? top_spin(*axle.motor) * axle.tire.radius : HUGE_VAL);
  return top;
}

/// Whether a wheel of a steady state turns as fast as its motor does.
bool turns_fastest(const VehicleCase& question, const std::vector<VehicleWheel>& wheels, const SteadyVehicle& steady) {
  constexpr double close = 0.999;
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    const VehicleAxle& axle = question.axles[wheels[i].axle];
    if (axle.motor && steady.wheels[i].rim_speed >= close * top_spin(*axle.motor) * axle.tire.radius) return true;
  }
  return false;
}

/// By bisection between a speed at which it travels and one at which it does not.
FastestTravel fastest_of_wheel_motors(const VehicleCase& question, const std::vector<VehicleWheel>& wheels,
                                      const Model& model, VehicleCondition at) {
  const SteadyVehicles vehicles(question, wheels, model);
  FastestTravel fastest{at.slope, {}, {}};
  std::optional<TravelLimit> beyond;
  const auto travels = [&](double speed) {
    at.speed = speed;
    try {
      const SteadyVehicle steady = vehicles.pulling(at);
      if (not_held_by(question, steady)) {
        beyond = TravelLimit::power;
        return false;
      }
      if (turns_fastest(question, wheels, steady)) beyond = TravelLimit::speed;
      return true;
    } catch (const VehicleGaveOut& error) {
      if (beyond != TravelLimit::speed)
        beyond = error.why() == GaveOut::torque ? TravelLimit::torque : TravelLimit::soil;
      return false;
    }
  };
  constexpr double slowest = 1e-3, close = 1e-5;  // share of the fastest rim; of the speed
  const double top = top_rim_speed(question);
  double slow = std::isfinite(top) ? slowest * top : at.speed, fast = std::isfinite(top) ? top : 2.0 * at.speed;
  if (!travels(slow)) {
    fastest.limit = beyond;
    if (beyond != TravelLimit::soil) fastest.speed = Estimate{0.0, 0.0};
    return fastest;
  }
  constexpr int most_doublings = 10;
  for (int i = 0; travels(fast); ++i) {
    if (i == most_doublings) return fastest;
    slow = fast, fast *= 2;
  }
  while (fast - slow > close * fast) {
    const double middle = 0.5 * (slow + fast);
    (travels(middle) ? slow : fast) = middle;
  }
  fastest.speed = Estimate{slow, not_a_number}, fastest.limit = beyond;
  return fastest;
}

}  // namespace

bool is_limited(const VehicleCase& question) { return question.power || question.motor || has_wheel_motors(question); }

double speed_at_power(double power, const SteadyVehicle& steady) {
  return power * steady.at.speed / steady.power.into_wheels;
}

std::optional<SpareDrive> spare_of(const VehicleCase& question, const SteadyVehicle& steady) {
  std::optional<SpareDrive> least;
  const auto note = [&](double given, double taken, TravelLimit limit) {
    const double share = given / taken - 1.0;
    if (!least || share < least->share) least = SpareDrive{share, limit};
  };
  const double into_wheels = steady.power.into_wheels;
  if (question.power && into_wheels > 0.0) note(*question.power, into_wheels, TravelLimit::power);
  if (!question.motor) return least;
  const double spin = line_spin(question, steady);
  note(top_spin(*question.motor), spin, TravelLimit::speed);
  if (into_wheels > 0.0 && std::isfinite(spin))
    note(torque_at_wheels(*question.motor, spin) * spin, into_wheels, TravelLimit::torque);
  return least;
}

std::optional<TravelLimit> not_held_by(const VehicleCase& question, const SteadyVehicle& steady) {
  const std::optional<SpareDrive> spare = spare_of(question, steady);
  return spare && spare->share < 0.0 ? std::optional(spare->limit) : std::nullopt;
}

FastestTravel fastest_of(const VehicleCase& question, const SteadyVehicle& steady) {
  FastestTravel fastest{steady.at.slope, {}, {}};
  const double into_wheels = steady.power.into_wheels;
  if (question.power && into_wheels > 0.0) {
    fastest.speed = Estimate{speed_at_power(*question.power, steady), 0.0};
    fastest.limit = TravelLimit::power;
  }
  if (!question.motor) return fastest;
  const double spin = line_spin(question, steady);
  if (!std::isfinite(spin)) return {steady.at.slope, Estimate{0.0, 0.0}, TravelLimit::speed};
  const double below = fastest.speed ? spin * fastest.speed->value / steady.at.speed : HUGE_VAL;
  const std::optional<double> most = fastest_spin(*question.motor, into_wheels / spin, below);
  if (!most) return {steady.at.slope, Estimate{0.0, 0.0}, TravelLimit::torque};
  if (*most == below) return fastest;
  fastest.speed = Estimate{*most / spin * steady.at.speed, 0.0};
  fastest.limit = *most == top_spin(*question.motor) ? TravelLimit::speed : TravelLimit::torque;
  return fastest;
}

FastestTravel fastest_travel(const VehicleCase& question, const std::vector<VehicleWheel>& wheels, const Model& model,
                             const VehicleCondition& at) {
  if (has_wheel_motors(question)) return fastest_of_wheel_motors(question, wheels, model, at);
  try {
    return fastest_of(question, SteadyVehicles(question, wheels, model).pulling(at));
  } catch (const VehicleGaveOut&) {
    return {at.slope, {}, TravelLimit::soil};
  }
}

namespace {

/// On a slope straight up.
VehicleCondition climbing(VehicleCondition at, double slope) {
  at.slope = slope, at.cross_slope = 0.0;
  return at;
}

/// Standard error of the fastest speed of a drive line [m/s].
double speed_error(const VehicleCase& question, const std::vector<VehicleWheel>& wheels, const Model& model,
                   const VehicleCondition& at) {
  return errors_of(wheels, 1, [&](const std::vector<VehicleWheel>& changed) {
    const FastestTravel fastest = fastest_of(question, SteadyVehicles(question, changed, model).pulling(at));
    return VehicleNumbers{fastest.speed ? fastest.speed->value : not_a_number};
  })[0];
}

Gradeability gradeability_of(const VehicleAnswers& answers, const Model& model) {
  const VehicleCase& question = answers.question;
  const SteadyVehicles vehicles(question, answers.wheels, model);
  const bool wheel_motors = has_wheel_motors(question);
  /// What motors and power give more than the travel takes on a slope, as a share; below 0 where it does not travel.
  const auto spare_on = [&](double slope) {
    constexpr double unlimited = 1.0, stands = -1.0;
    try {
      const auto spare = spare_of(question, vehicles.pulling(climbing(question.condition, slope)));
      return spare ? std::min(spare->share, unlimited) : unlimited;
    } catch (const VehicleGaveOut&) {
      return stands;
    }
  };
  const auto limit_on = [&](double slope) {
    const VehicleCondition at = climbing(question.condition, slope);
    if (wheel_motors) return fastest_travel(question, answers.wheels, model, at).limit.value_or(TravelLimit::soil);
    try {
      return not_held_by(question, vehicles.pulling(at)).value_or(TravelLimit::soil);
    } catch (const VehicleGaveOut& error) {
      return error.why() == GaveOut::torque ? TravelLimit::torque : TravelLimit::soil;
    }
  };
  const double on_level = spare_on(0.0);
  if (!answers.up.angle || on_level < 0.0) return {{}, limit_on(0.0)};
  constexpr double close = 1e-6;
  const double steepest = answers.up.angle->value, just_below = steepest - 10 * close;
  const double spare_below = just_below > 0.0 ? spare_on(just_below) : 0.0;
  if (spare_below >= 0.0)
    return {answers.up.angle,
            answers.up.beyond.why == GaveOut::torque ? limit_on(steepest + 10 * close) : TravelLimit::soil};
  const double end = gsl::bracketed_root(spare_on, {0.0, on_level}, {just_below, spare_below}, 0.01 * close,
                                         0.01 * close, "the steepest slope at a speed");
  const double low = end - 0.5 * close;
  Gradeability found{Estimate{low, not_a_number}, limit_on(end + 0.5 * close)};
  if (wheel_motors) return found;
  // What is spare changes with soil and slope: by its share of what is taken, which has no jump.
  constexpr double step = 1e-4;
  const auto spare = [&](const std::vector<VehicleWheel>& wheels, double slope) {
    const VehicleCondition at = climbing(question.condition, slope);
    return spare_of(question, SteadyVehicles(question, wheels, model).pulling(at))->share;
  };
  try {
    const double fall = (spare(answers.wheels, low + step) - spare(answers.wheels, low - step)) / (2 * step);
    const VehicleNumbers error = errors_of(answers.wheels, 1, [&](const std::vector<VehicleWheel>& changed) {
      return VehicleNumbers{spare(changed, low)};
    });
    found.angle->std_error = error[0] / std::abs(fall);
  } catch (const VehicleGaveOut&) {  // it ends beside: no error
  }
  return found;
}

}  // namespace

void add_speeds(VehicleAnswers& answers, const Model& model) {
  const VehicleCase& question = answers.question;
  answers.fastest = fastest_travel(question, answers.wheels, model, question.condition);
  if (answers.fastest->speed && !has_wheel_motors(question))
    answers.fastest->speed->std_error = speed_error(question, answers.wheels, model, question.condition);
  answers.gradeability = gradeability_of(answers, model);
  constexpr double step = 5 * degree, steepest = 1.2;
  for (int i = 0; i * step < std::min(steepest, answers.up.angle ? answers.up.angle->value : 0.0); ++i)
    answers.climbs.push_back(fastest_travel(question, answers.wheels, model, climbing(question.condition, i * step)));
}

}  // namespace soilbin::compare
