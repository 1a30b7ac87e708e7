// The answer of a model or of a measurement at one operating point: drawbar pull, torque, sinkage and lateral force,
// each with its standard error, the parts of the pull and the stresses under the wheel.
//
//   const TractionResult result = model.evaluate(scenario, {.load = 4000, .slip = 0.2});
//   result.drawbar_pull.value, result.drawbar_pull.std_error  // [N]
//   for (const Contribution& part : result.budget) fmt::print("{}: {:.1f} N\n", part.name, part.force);
#pragma once

#include <string>
#include <vector>

#include "scenario/estimate.hpp"
#include "scenario/operating_condition.hpp"

namespace soilbin {

/// One named part of the drawbar pull [N]; positive pulls forward.
struct Contribution {
  std::string name;
  double force = 0.0;
};

/// What the parts of a drawbar pull leave unexplained. It is no part itself, so that a part that is wrong or missing
/// shows.
struct BudgetRest {
  double force = not_a_number;  ///< drawbar pull less the sum of the parts [N]; NaN where nobody counted
  /// Largest |force| that is no sign of a fault [N]; NaN where it isn't known. Equations: rounding. Grains: four
  /// standard errors of the difference between the pull, a mean over all steps, and the parts, which are sampled.
  double bound = not_a_number;
};

/// Stresses on the wheel's surface at one angle from the vertical (entry side positive).
struct StressSample {
  double theta = 0.0;          ///< [rad]
  double normal = 0.0;         ///< sigma [Pa]
  double shear = 0.0;          ///< tau [Pa] in the wheel's plane; positive pushes the wheel forward
  double lateral_shear = 0.0;  ///< tau_y [Pa]; positive pushes to the left of the wheel's plane
};

/// The answer of a model or of a measurement at one operating condition.
struct TractionResult {
  OperatingCondition at;
  Estimate drawbar_pull;             ///< F_DP [N] along travel, less the slope's share of the load
  Estimate torque;                   ///< M [N m]; positive drives
  Estimate sinkage;                  ///< z [m]
  Estimate lateral_force;            ///< F_y [N] to the left of travel
  double tractive_efficiency = 0.0;  ///< [-]; scenario/tractive_efficiency.hpp; NaN where nothing is driven
  double entry_angle = 0.0;          ///< theta_1 [rad]
  double max_stress_angle = 0.0;     ///< theta_m [rad]
  double exit_angle = 0.0;           ///< theta_2 [rad]; negative behind the axle
  std::vector<Contribution> budget;  ///< parts that add up to the drawbar pull, but for budget_rest
  BudgetRest budget_rest;
  std::vector<StressSample> patch;  ///< ordered from exit to entry
  /// Parameters of the soil, by name, whose standard deviation the standard errors lack: their derivative does not
  /// exist.
  std::vector<std::string> without_error_of{};
  /// Contact of the analytic wheel [m^2]: its width times the length as seen from above, from entry to exit. The
  /// load over it is the mean vertical stress under the wheel. NaN where nobody counted.
  double contact_area = not_a_number;
};

}  // namespace soilbin
