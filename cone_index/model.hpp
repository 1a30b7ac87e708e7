// The cone-index relations as a Model: pull and torque of a driven pneumatic tire, for who has a cone penetrometer and
// no bevameter. Brixius's of fine-grained soil, Turnage's of sand, whichever the soil declares.
//
//   const ConeIndex model;
//   const TractionResult result = model.evaluate(scenario, {.load = 20e3, .slip = 0.15});  // [N], [-]
//
// It has no sinkage, no stresses and no angles of contact (NaN), no side force, no yaw and no cross slope, no braked
// wheel; of the tread it knows the outer diameter alone.
#pragma once

#include <string>

#include "cone_index/relations.hpp"
#include "scenario/scenario.hpp"

namespace soilbin::cone_index {

/// The model's name in files, commands and tables.
inline constexpr const char* model_name = "cone_index";

/// Where the deflection on firm ground comes from.
enum class DeflectionFrom {
  table,     ///< the maker's, at this load and inflation pressure
  pressure,  ///< the load over inflation and carcass pressure is the area of contact, that of a torus on a plane
  assumed,   ///< usual_deflection of the section height: the tire declares no inflation pressure
};

/// What the relations take of a tire under a load, and what of it is not declared.
struct TireTaken {
  TireMeasures measures;
  DeflectionFrom deflection = DeflectionFrom::assumed;
  bool section_height_assumed = false;
};

/// Deflection over section height that tires are made for.
inline constexpr double usual_deflection = 0.2;

/// A section height that isn't declared is 85 % of the width, as of a tire size that tells none, and at most half of
/// the outer radius. `load` [N] presses on the ground. Throws InputError for a tire that deflects by its section height
/// or more.
TireTaken tire_taken(const Tire& tire, double load);

/// Number of the relation that the soil asks for, at a load [N] that presses on it; slope: by the soil's value. Throws
/// InputError for a soil that has neither value.
struct MobilityNumber {
  double value = 0.0;
  double std_error = 0.0;  ///< from the soil's value
  bool sand = false;       ///< Turnage's number, else Brixius's
};
MobilityNumber mobility_number(const Soil& soil, const TireMeasures& tire, double load);

class ConeIndex final : public Model {
 public:
  std::string name() const override { return model_name; }
  /// Up a slope, gravity's part square to it loads the wheel. Standard errors are those of the soil's value, to first
  /// order; how far wheels scatter about the relations is not in them. Throws InputError as tire_taken and
  /// mobility_number do, for an impossible condition and for yaw, a cross slope and a slip below 0; NoSolution where
  /// the motion resistance would be the load or more.
  TractionResult evaluate(const Scenario& scenario, const OperatingCondition& at) const override;
};

}  // namespace soilbin::cone_index
