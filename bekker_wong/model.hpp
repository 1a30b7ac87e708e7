// The analytic wheel (Bekker 1969; Wong and Reece 1967) as a Model: results with standard errors, budget and stresses.
// The wheel itself: rolling_wheel.hpp.
//
//   const Scenario scenario{.tire = find_tire("rover-wheel", library), .soil = find_soil("dry-sand", library)};
//   const TractionResult result = BekkerWong().evaluate(scenario, {.load = 100, .slip = 0.2});  // [N], [-]
//   result.drawbar_pull.value, result.drawbar_pull.std_error                                    // [N]
#pragma once

#include "bekker_wong/contact_patch.hpp"
#include "bekker_wong/rolling_wheel.hpp"
#include "scenario/scenario.hpp"

namespace soilbin::bekker_wong {

/// The declared values of a soil, without their standard deviations.
SoilValues values_of(const SemiEmpiricalSoil& soil);

/// How much a result is to hold beside the four numbers.
struct Detail {
  bool errors = true;  ///< standard errors from what the soil's values leave open, to first order, and a fit's misfit
  bool patch = true;   ///< stresses under the wheel
};

/// The Bekker / Wong-Reece model behind the common interface.
class BekkerWong final : public Model {
 public:
  explicit BekkerWong(Detail detail = {}) : detail_(detail) {}
  std::string name() const override { return "bekker_wong"; }
  /// Throws InputError where the scenario has no semi-empirical soil or an impossible condition, NoSolution where the
  /// wheel would bury itself.
  TractionResult evaluate(const Scenario& scenario, const OperatingCondition& at) const override;

 private:
  Detail detail_;
};

/// The result of a balanced wheel: forces, budget (adds up to the drawbar pull to rounding), angles and, if asked for,
/// stresses.
TractionResult traction_result(const RolledWheel& wheel, const Tire& tire, bool with_patch);

}  // namespace soilbin::bekker_wong
