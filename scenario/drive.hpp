// A wheel driven in time: its motor, the way with its slopes and soils, and when the drive ends. The section `drive` of
// a case (docs/guide/drive.md).
//
//   Drive drive{.load = 4000, .duration = 20};                                   // [N], [s]
//   drive.controller.rim_speed = 0.5;                                            // [m/s], held by the motor
//   drive.profile = {{.at = 2}, {.at = 4, .longitudinal_incline = 0.17}};        // [m], [rad]; level up to 2 m
//   mass_of(drive, 9.80665)                                                      // 408 kg
#pragma once

#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "scenario/description.hpp"
#include "scenario/scenario.hpp"
#include "scenario/unit.hpp"

namespace soilbin {

/// What turns the wheel: a motor that holds a rim speed or one that gives a torque. Exactly one of the two is asked
/// for.
struct Controller {
  std::optional<double> rim_speed{};          ///< r w that it holds [m/s]
  std::optional<double> torque{};             ///< M that it gives [N m]
  std::optional<double> highest_torque{};     ///< of a motor that holds a rim speed [N m]
  std::optional<double> highest_rim_speed{};  ///< of a motor that gives a torque [m/s]
  double ramp = 1.0;                          ///< time over which the setpoint grows from rest [s]
  double response = 0.02;                     ///< time in which an error of speed is made good [s]
};

/// A place along the way. Angles and drawbar load go linearly from one to the next and stay as they are before the
/// first and behind the last; a soil holds from its place on.
struct Waypoint {
  double at = 0.0;                    ///< distance along the ground from the start [m]
  double longitudinal_incline = 0.0;  ///< [rad]
  double transverse_incline = 0.0;    ///< [rad]
  double yaw = 0.0;                   ///< [rad]
  double drawbar = 0.0;               ///< load pulled against travel [N]
  std::optional<Soil> soil{};         ///< absent: as before
};

/// A drive: a wheel with mass and inertia from rest.
struct Drive {
  double load = 0.0;                ///< W [N]
  std::optional<double> mass{};     ///< that travels with the wheel [kg]; absent: W over the gravity on the case's soil
  std::optional<double> inertia{};  ///< of what spins, about the axle [kg m^2]; absent: a tenth of mass r^2
  int pass = 1;
  double duration = 0.0;             ///< [s]
  std::optional<double> distance{};  ///< the drive has arrived there [m]
  double damping = 0.2;              ///< share of critical damping, of the soil under heave and of shear at rest [-]
  double stuck_speed = 0.5e-3;       ///< mean speed of travel below which the wheel is stuck [m/s]
  Controller controller{};
  std::vector<Waypoint> profile{};      ///< rising in `at`
  std::vector<EffectChoice> effects{};  ///< forms and parameters resolved
  std::vector<FittedError> errors{};    ///< how values of the case's soil and of `effects` err, where they were fitted
};

/// The mass that travels with the wheel under this gravity [m/s^2], in kg.
inline double mass_of(const Drive& drive, double gravity) { return drive.mass.value_or(drive.load / gravity); }

/// The inertia of what spins on a wheel of this radius under this gravity, about the axle [kg m^2].
inline double inertia_of(const Drive& drive, double radius, double gravity) {
  constexpr double spinning_share = 0.1;  // of m r^2
  return drive.inertia.value_or(spinning_share * mass_of(drive, gravity) * radius * radius);
}

void describe(auto& v, std::type_identity<Controller>) {
  using C = Controller;
  v.number("rim_speed", &C::rim_speed, Measure{"m/s", above_zero}, Need::optional, "r w that the motor holds");
  v.number("torque", &C::torque, Measure{"N m", above_zero}, Need::optional, "that the motor gives");
  v.number("highest_torque", &C::highest_torque, Measure{"N m", above_zero}, Need::optional,
           "of a motor that holds a rim speed");
  v.number("highest_rim_speed", &C::highest_rim_speed, Measure{"m/s", above_zero}, Need::optional,
           "of a motor that gives a torque");
  v.number("ramp", &C::ramp, Measure{"s", above_zero}, Need::optional, "over which the setpoint grows from rest");
  v.number("response", &C::response, Measure{"s", above_zero}, Need::optional,
           "time in which an error of speed is made good");
}

inline std::string contradiction(const Controller& c) {
  if (c.rim_speed.has_value() == c.torque.has_value()) return "a controller has either 'rim_speed' or 'torque'";
  if (c.torque && c.highest_torque) return "'highest_torque' belongs to a controller with 'rim_speed'";
  if (c.rim_speed && c.highest_rim_speed) return "'highest_rim_speed' belongs to a controller with 'torque'";
  return "";
}

void describe(auto& v, std::type_identity<Waypoint>) {
  using W = Waypoint;
  v.number("at", &W::at, Measure{"m", zero_or_more}, Need::required, "distance along the ground from the start");
  v.number("longitudinal_incline", &W::longitudinal_incline, Measure{"deg", inclines}, Need::optional,
           "slope along the way, uphill positive");
  v.number("transverse_incline", &W::transverse_incline, Measure{"deg", inclines}, Need::optional,
           "cross slope, left side up positive");
  v.number("yaw", &W::yaw,
           Measure{"deg", {.lower = -right_angle, .upper = right_angle, .lower_open = true, .upper_open = true}},
           Need::optional, "positive: the wheel points to the left of its travel");
  v.number("drawbar", &W::drawbar, Measure{"N", zero_or_more}, Need::optional, "load pulled against travel");
  v.part("soil", &W::soil, Need::optional, "from here on: a mapping, a name of the library, or a path");
}

void describe(auto& v, std::type_identity<Drive>) {
  using D = Drive;
  v.number("load", &D::load, Measure{"N", above_zero}, Need::required,
           "vertical load on the axle, weight of the wheel included");
  v.number("mass", &D::mass, Measure{"kg", above_zero}, Need::optional,
           "that travels with the wheel; absent: load over the gravity on the case's soil");
  v.number("inertia", &D::inertia, Measure{"kg m^2", above_zero}, Need::optional,
           "of what spins, about the axle; absent: a tenth of mass times radius squared");
  v.integer("pass", &D::pass, 1, Need::optional, "1: undisturbed soil");
  v.number("duration", &D::duration, Measure{"s", above_zero}, Need::required, "the drive ends then at the latest");
  v.number("distance", &D::distance, Measure{"m", above_zero}, Need::optional, "the drive has arrived there");
  v.number("damping", &D::damping, Measure{"-", fractions}, Need::optional,
           "share of critical damping, of the soil under heave and of shear at rest");
  v.number("stuck_speed", &D::stuck_speed, Measure{"m/s", above_zero}, Need::optional,
           "mean speed of travel below which the wheel is stuck");
  v.group("controller", &D::controller, Need::required, "what turns the wheel");
  v.list("profile", &D::profile, Need::optional, "places along the way; absent: level ground");
}

inline std::string contradiction(const Drive& drive) {
  for (std::size_t i = 0; i + 1 < drive.profile.size(); ++i)
    if (!(drive.profile[i].at < drive.profile[i + 1].at)) return "the places of the profile don't rise";
  return "";
}

}  // namespace soilbin
