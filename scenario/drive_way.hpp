// The way of a drive: slope, yaw, drawbar load and soil at each place along it, from the waypoints of a case.
#pragma once

#include <vector>

#include "scenario/drive.hpp"

namespace soilbin {

/// What a wheel meets at a place along its way.
struct Place {
  double longitudinal_incline = 0.0;  ///< [rad]
  double transverse_incline = 0.0;    ///< [rad]
  double yaw = 0.0;                   ///< [rad]
  double drawbar = 0.0;               ///< [N]
  double curvature = 0.0;             ///< of the way, hollow positive: d(incline)/dx [rad/m]
  std::size_t soil = 0;               ///< 0: the case's own, i: the i-th that the waypoints bring
  std::size_t last_soil = 0;          ///< the farthest that the contact touches; `soil` where that is the only one
};

/// The way of a drive: angles and drawbar load linear between the waypoints, soils from theirs on.
class Way {
 public:
  /// `blend`: distance over which the contact passes from one soil to the next [m]. A soil that begins at 0 is under
  /// the whole contact from the start.
  Way(const std::vector<Waypoint>& points, double blend);
  Place at(double x) const;
  /// Share of the contact around x that the waypoints' i-th soil takes from those before it, 0 .. 1; i from 1.
  double share(std::size_t i, double x) const;
  /// The soils that the waypoints bring, in their order.
  const std::vector<Soil>& soils() const { return soils_; }
  /// Whether the wheel is yawed anywhere.
  bool turns() const;

 private:
  std::vector<Waypoint> points_;
  std::vector<Soil> soils_;
  std::vector<double> soil_from_;  ///< where each of them begins
  double blend_;
};

/// A way of angles alone, where no soil is asked for.
inline Way angles_along(const std::vector<Waypoint>& points) { return {points, 1.0}; }

}  // namespace soilbin
