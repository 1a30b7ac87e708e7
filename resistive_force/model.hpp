// Three-dimensional granular resistive force theory as a Model: it sees the tread as drawn (lugs, chevrons, sides) and
// knows a soil by one number and a friction coefficient, in milliseconds.
//
//   const ResistiveForce model;
//   const TractionResult result = model.evaluate(scenario, {.load = 20e3, .slip = 0.2});  // [N], [-]
//
// For dry, rate-independent, not too dense media at low speed. It has no cohesion, no rut, no digging with slip and no
// shear displacement (pull is there at once, as with K = 0), and what one element moves changes nothing for the next.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "resistive_force/tread_elements.hpp"
#include "resistive_force/wheel.hpp"
#include "scenario/scenario.hpp"

namespace soilbin::resistive_force {

/// The model's name in files, commands and tables.
inline constexpr const char* model_name = "rft";

/// The soil's resistive_force values or, where it declares none, what its density and friction angle let expect:
/// estimated_xi_n, +- 30 %, and the tangent of two thirds of the friction angle, +- 0.1 (usual between soil and a
/// structure). The standard deviations are chosen: on the CMU sand the estimate is 1.08 MN/m^3, and its smooth wheel's
/// sinkages ask for 0.9. Throws InputError for a soil that has neither.
ResistiveForceSoil resistive_force_of(const Soil& soil);

class ResistiveForce final : public Model {
 public:
  /// The model of the wheel as soilbin draws it.
  ResistiveForce() = default;
  /// The model of a wheel as it was drawn (drawn_elements), whatever lugs the tire declares.
  explicit ResistiveForce(TreadElements drawn) : drawn_(std::make_shared<const TreadElements>(std::move(drawn))) {}
  std::string name() const override { return model_name; }
  /// Standard errors from those of xi_n and surface friction, to first order. Throws what
  /// resistive_force_of does, InputError for a tire whose lugs can't be drawn and an impossible condition, NoSolution
  /// where the soil does not carry the load.
  TractionResult evaluate(const Scenario& scenario, const OperatingCondition& at) const override;

 private:
  std::shared_ptr<const TreadElements> elements_of(const Tire& tire) const;

  std::shared_ptr<const TreadElements> drawn_;
  // The last tire's elements: a study asks one tire hundreds of times.
  mutable std::mutex mutex_;
  mutable Tire last_;
  mutable std::shared_ptr<const TreadElements> elements_;
};

}  // namespace soilbin::resistive_force
