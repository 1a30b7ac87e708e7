// A small rover wheel on dry sand, driven in time: what the tests of bekker_wong/transient share.
#pragma once

#include <cmath>

#include "bekker_wong/model.hpp"
#include "bekker_wong/transient/driving.hpp"
#include "scenario/unit.hpp"
#include "tests/fixtures.hpp"

namespace soilbin::bekker_wong::rover {

inline constexpr double load = 64.68, mass = load / 9.80665;

/// The shared dry sand, all of it exact.
inline Soil dry_sand() {
  Soil soil;
  soil.name = "dry-sand";
  soil.semi_empirical = test::dry_sand();
  soil.semi_empirical->shear_modulus.std_error = 0;
  return soil;
}

inline Scenario scenario() {
  Scenario s;
  s.tire.radius = 0.09, s.tire.width = 0.11;
  s.soil = dry_sand();
  return s;
}

/// From rest to a rim speed of 5 cm/s, on a slope of one angle.
inline Drive drive(double slope = 0.0, double drawbar = 0.0, double duration = 15.0) {
  Drive d;
  d.load = load;
  d.duration = duration;
  d.controller.rim_speed = 0.05;
  Waypoint start;
  start.longitudinal_incline = slope, start.drawbar = drawbar;
  d.profile = {start};
  return d;
}

inline constexpr DriveNumerics fine{.nodes = 48, .relative_tolerance = 1e-9};

/// The static wheel at the slip and speed at which a drive ended.
inline RolledWheel steady(const Scenario& s, const Drive& d, const DriveSample& end) {
  const RollingWheel wheel(s.tire, values_of(*s.soil.semi_empirical), make_effects(d.effects), s.bin);
  OperatingCondition at;
  at.load = d.load;
  at.slip = end.slip.value();
  at.speed = end.speed;
  at.pass = d.pass;
  at.position = end.travelled;
  if (!d.profile.empty()) {
    at.longitudinal_incline = d.profile.back().longitudinal_incline;
    at.transverse_incline = d.profile.back().transverse_incline;
    at.yaw = d.profile.back().yaw;
  }
  return wheel.roll(at);
}

}  // namespace soilbin::bekker_wong::rover
