// The chance that a vehicle goes, over slope and heading: on how many soils, drawn by their standard deviations, it has
// a steady state.
//
//   const GoMap map = go_map(question, wheels, model, {.samples = 100});
//   map.cells[2][0].chance   // on the third slope, straight up
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "compare/vehicle/steady_vehicle.hpp"

namespace soilbin::compare {

struct GoMapPlan {
  std::vector<double> slopes{};    ///< of the ground [rad], rising; empty: 0, 5 .. 35 deg
  std::vector<double> headings{};  ///< from straight up to the right [rad]; empty: 0, 30 .. 180 deg
  int samples = 50;
  std::uint64_t seed = 1;
  std::function<void(std::size_t done, std::size_t total)> progress{};
};

struct GoCell {
  double chance = 0.0;
  double std_error = 0.0;  ///< of so many samples
};

struct GoMap {
  std::vector<double> slopes{}, headings{};
  std::vector<std::vector<GoCell>> cells{};  ///< a row a slope
  int samples = 0;
};

/// The condition of a heading on a slope: the slope along its travel and across it, sin(a) = sin(S) cos(h), cos(a)
/// sin(b) = sin(S) sin(h).
VehicleCondition heading_on(const VehicleCondition& asked, double slope, double heading);

/// Monte Carlo over a Latin hypercube of the soil's values and the carcass pressures, normal and independent, held
/// within their ranges. A soil on which the vehicle fails on one slope counts as failed on every steeper one with that
/// heading. Slope and cross slope of the question's condition are not read.
GoMap go_map(const VehicleCase& question, const std::vector<VehicleWheel>& wheels, const Model& model,
             GoMapPlan plan = {});

}  // namespace soilbin::compare
