// The soils, wheels and conditions that tests of several folders share. A test says itself only what is special about
// its own.
#pragma once

#include "scenario/scenario.hpp"
#include "scenario/unit.hpp"

namespace soilbin::test {

/// Wong's dry sand (cases/soils/dry-sand.yaml), taken as exact but for K.
inline SemiEmpiricalSoil dry_sand() {
  return {.exponent = {1.1, 0},
          .k_c = {990, 0},
          .k_phi = {1528.43e3, 0},
          .cohesion = {1040, 0},
          .friction_angle = {28 * degree, 0},
          .shear_modulus = {0.02, 0.006},
          .stress_angle_c1 = {0.18, 0},
          .stress_angle_c2 = {0.32, 0},
          .density = 1600};
}

/// Snow of Wong's table (cases/soils/snow.yaml), with K, c1 and c2 of its own.
inline SemiEmpiricalSoil snow() {
  return {.exponent = {1.6, 0},
          .k_c = {4370, 0},
          .k_phi = {196720, 0},
          .cohesion = {1030, 0},
          .friction_angle = {19.7 * degree, 0},
          .shear_modulus = {0.04, 0},
          .stress_angle_c1 = {0.2, 0},
          .stress_angle_c2 = {0.3, 0},
          .density = 400};
}

inline Tire smooth_wheel(double radius, double width) {
  Tire tire;
  tire.radius = radius, tire.width = width;
  return tire;
}

/// A small rover's wheel, 110 mm by 100 mm, on dry sand.
inline Scenario wheel_on_sand() {
  Scenario scenario;
  scenario.tire = smooth_wheel(0.11, 0.1);
  scenario.soil.semi_empirical = dry_sand();
  return scenario;
}

inline OperatingCondition condition(double load, double slip, double yaw = 0.0) {
  OperatingCondition at;
  at.load = load, at.slip = slip, at.yaw = yaw;
  return at;
}

}  // namespace soilbin::test
