// Element tests of the grain engine as virtual tests of a calibration.
//
//   const auto factors = usual_factors(ContactKind::grain_tire);  // what is varied, between which bounds
//   const auto names = target_names(ContactKind::grain_tire);     // what is to be met: "board_angle"
#pragma once

#include <string>
#include <vector>

#include "compare/calibrate/calibration.hpp"
#include "compare/calibrate/contact_values.hpp"
#include "compare/experiments/compression_curves.hpp"
#include "compare/experiments/plate_curves.hpp"
#include "dem/element_tests/direct_shear.hpp"
#include "dem/element_tests/tilting_board.hpp"
#include "dem/element_tests/triaxial.hpp"
#include "scenario/soil.hpp"

namespace soilbin::compare {

/// Which strength of the shear box or the cell counts.
enum class Strength { peak, residual };

/// The test of sand on sand; it should be the one that measured the targets.
enum class SandTest { triaxial, direct_shear, plate };

/// The settings that both tests share.
struct ElementExperiment {
  GranularSoil soil;            ///< what isn't varied
  std::vector<Factor> factors;  ///< named as a contact's numbers
  std::vector<Target> targets;
  dem::WorkOptions how;
};

/// A calibration of a contact, as a person asks for it.
struct ContactQuestion {
  ContactKind kind = ContactKind::grain_grain;
  std::vector<Factor> factors;
  std::vector<Target> targets;
  SandTest test = SandTest::triaxial;              ///< of sand on sand
  int packings = 0;                                ///< samples an experiment; 0: cell and shear box 1, board 4
  Strength strength = Strength::peak;              ///< of cell and shear box
  std::vector<double> stresses{10e3, 20e3, 40e3};  ///< confining in the cell, normal in the shear box [Pa]
  double settling_friction = 1;                    ///< of cell and shear box, 0 .. 1, where it is no factor
  /// Measured tests that the targets are features of: the cell then presses at their pressures, as far as they go, in
  /// place of `stresses`. Triaxial, sand on sand.
  std::vector<CompressionCurve> curves{};
  std::vector<MeasuredPlate> plates{};  ///< of SandTest::plate: pressures at points_of these are the targets
  int across = 16;                      ///< grains along a side of the board
  dem::WorkOptions how;
};

/// Sand on sand by the triaxial cell or the shear box, sand on tire by the tilting board, with the soil's own rolling
/// resistance. With curves the factors may also be youngs_modulus and settling_friction, with plates settling_friction.
/// Throws InputError for a soil without grains and for settings that make no sense.
VirtualTest contact_test(const Soil& soil, const ContactQuestion& question);

/// The targets that a soil itself tells of a contact: phi and c for sand on sand. Throws InputError where it tells
/// none.
std::vector<Target> targets_of(const Soil& soil, ContactKind kind);

/// Names of the targets that a contact's test knows, their units, and usual bounds of what is varied.
std::vector<std::string> target_names(ContactKind kind);
std::string unit_of_target(const std::string& name);
std::vector<Factor> usual_factors(ContactKind kind);
/// With a soil's own law of cohesion: under jkr the work of adhesion in place of the energy density.
std::vector<Factor> usual_factors(ContactKind kind, const GranularSoil& soil);
/// What is varied against measured curves: sliding and rolling friction, youngs_modulus, and how the specimens settle:
/// settling_friction or, of tests of several densities (by_density), settling_friction.TX13 of each, by its first test.
std::vector<Factor> usual_factors_of_curves(const std::vector<CompressionCurve>& tests);

/// What is varied against measured plates: a contact's numbers, and how the bed settles.
std::vector<Factor> usual_factors_of_plates(const GranularSoil& soil);

}  // namespace soilbin::compare
