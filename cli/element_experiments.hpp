// Element tests of the grain engine as virtual tests of a calibration.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "compare/calibrate/calibration_words.hpp"
#include "dem/element_tests/direct_shear.hpp"
#include "dem/element_tests/tilting_board.hpp"
#include "scenario/soil.hpp"

namespace soilbin::cli {

/// Which strength of the shear box counts.
enum class Strength { peak, residual };

/// What both tests need to know.
struct ElementExperiment {
  GranularSoil soil;                     ///< what isn't varied
  std::vector<compare::Factor> factors;  ///< named as a contact's numbers
  std::vector<compare::Target> targets;
  dem::WorkOptions how;
};

/// Sand on sand: direct shear under several stresses; knows the targets friction_angle and cohesion. A seed gives
/// packings of its own.
compare::VirtualTest shear_box_test(const ElementExperiment& experiment, const dem::DirectShearSettings& settings,
                                    Strength strength);

/// Tire on sand: the tilting board; knows the target board_angle. Mean and standard error over `packings` boards, at
/// least two.
compare::VirtualTest tilting_board_test(const ElementExperiment& experiment, const dem::TiltingBoardSettings& settings,
                                        int packings);

/// Names of the targets that a contact's test knows, their units, and usual bounds of what is varied.
std::vector<std::string> target_names(compare::ContactKind kind);
std::string unit_of_target(const std::string& name);
std::vector<compare::Factor> usual_factors(compare::ContactKind kind);

}  // namespace soilbin::cli
