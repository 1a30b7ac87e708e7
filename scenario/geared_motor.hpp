// What a motor or an engine gives at most: its torque against its speed, brought to the wheels by a gear.
//
//   const GearedMotor diesel{{{84, 700}, {147, 900}, {251, 760}}, 30.0, 0.9};   // [rad/s], [N m]
//   torque_at_wheels(diesel, 5.0), top_spin(diesel)   // [N m] and [rad/s] of the wheels
#pragma once

#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "scenario/description.hpp"

namespace soilbin {

/// A point of a torque curve.
struct TorquePoint {
  double speed = 0.0;   ///< of the motor [rad/s], >= 0
  double torque = 0.0;  ///< that it gives at most [N m], >= 0
};

/// A motor with the gear that is engaged. At a spin w of the wheels it turns at i w and gives them at most
///
///   M(w) = eta i T(i w),
///
/// i gear ratio, eta efficiency, T the curve: linear between its points, and below the first one as there (a clutch
/// slips). The last one is the fastest that the motor turns.
struct GearedMotor {
  std::vector<TorquePoint> torque_curve{};  ///< rising in speed, two or more
  double gear_ratio = 1.0;                  ///< i, > 0
  double efficiency = 1.0;                  ///< eta of gear and axles, 0 < eta <= 1
};

/// M at a spin of the wheels [rad/s], >= 0; beyond the fastest as there.
double torque_at_wheels(const GearedMotor& motor, double spin);
/// Fastest spin of the wheels [rad/s].
double top_spin(const GearedMotor& motor);
/// Largest spin of the wheels, at most `below`, at which it gives a torque; none where it gives so much at no spin.
std::optional<double> fastest_spin(const GearedMotor& motor, double torque, double below);

void describe(auto& v, std::type_identity<TorquePoint>) {
  v.number("speed", &TorquePoint::speed, Measure{"rpm", zero_or_more}, Need::required, "of the motor");
  v.number("torque", &TorquePoint::torque, Measure{"N m", zero_or_more}, Need::required,
           "that the motor gives at most at this speed");
}

void describe(auto& v, std::type_identity<GearedMotor>) {
  using M = GearedMotor;
  v.list("torque_curve", &M::torque_curve, Need::required,
         "points of largest torque, rising in speed; linear between them; the last is the fastest that it turns");
  v.number("gear_ratio", &M::gear_ratio, Measure{"-", above_zero}, Need::optional,
           "revolutions of the motor over those of the wheel");
  v.number("efficiency", &M::efficiency, Measure{"-", {.lower = 0.0, .upper = 1.0, .lower_open = true}}, Need::optional,
           "share of its power that reaches the wheels");
}

std::string contradiction(const GearedMotor& motor);

}  // namespace soilbin
