// One operating point of a wheel: load, slip, speed, slopes, yaw, pass, inflation pressure. A model is asked for it,
// and a measured run was made at it.
//
//   const OperatingCondition uphill{.load = 4000, .slip = 0.2, .longitudinal_incline = 0.17};  // [N], [-], [rad]
#pragma once

#include <compare>
#include <optional>

namespace soilbin {

/// The speed from which slip was computed, where the wheel is yawed (docs/reference/conventions.md).
enum class SlipBy {
  wheel_plane_speed,  ///< s = 1 - v cos(yaw)/(r w): the speed's component in the wheel's plane
  travel_speed,       ///< s = 1 - v/(r w): the whole speed of travel
};

/// In which axes drawbar pull and lateral force are given.
enum class ForceFrame {
  travel,  ///< along the direction of travel, and to its left
  wheel,   ///< in the wheel's plane, and across it to the left
};

/// What the wheel is asked to do. Signs and symbols: docs/reference/conventions.md.
struct OperatingCondition {
  double load = 0.0;                  ///< W [N], vertical, weight of the wheel included, > 0
  double slip = 0.0;                  ///< s [-], -1 .. 1; > 0 drives
  double speed = 0.1;                 ///< v [m/s], forward speed of the axle along its travel, >= 0
  double longitudinal_incline = 0.0;  ///< alpha [rad], uphill positive
  double transverse_incline = 0.0;    ///< beta_t [rad], left side up positive
  double yaw = 0.0;                   ///< psi [rad], wheel points to the left of its travel: positive
  int pass = 1;                       ///< 1: undisturbed soil, 2: second pass in the same rut, ...
  SlipBy slip_by = SlipBy::wheel_plane_speed;
  ForceFrame force_frame = ForceFrame::travel;  ///< axes of drawbar pull and lateral force in the answer
  // Where and when in a campaign; only some effects ask for these.
  std::optional<double> moisture{};  ///< water content by mass [-]
  std::optional<double> position{};  ///< mean distance along the bin [m]
  std::optional<int> run{};          ///< order in which the runs were made
  /// Inflation pressure in this run, in place of the tire's own [Pa]; absent: as declared (tire_at).
  std::optional<double> inflation_pressure{};
  /// What the wheel that made the rut carried there [N] and at which slip [-]; absent: as this one. A vehicle tells
  /// them to the wheels behind its first axle; files and flags do not.
  std::optional<double> rut_load{}, rut_slip{};

  /// Member by member: equal where every number is the same, sorted as a tuple.
  auto operator<=>(const OperatingCondition&) const = default;
};

}  // namespace soilbin
