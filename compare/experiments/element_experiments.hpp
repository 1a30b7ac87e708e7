// Element tests of the grain engine as virtual tests of a calibration.
#pragma once

#include <string>
#include <vector>

#include "compare/bevameter/bevameter.hpp"
#include "compare/calibrate/calibration.hpp"
#include "compare/calibrate/contact_values.hpp"
#include "dem/element_tests/bevameter_tests.hpp"
#include "dem/element_tests/direct_shear.hpp"
#include "dem/element_tests/tilting_board.hpp"
#include "scenario/soil.hpp"

namespace soilbin::compare {

/// Which strength of the shear box counts.
enum class Strength { peak, residual };

/// What both tests need to know.
struct ElementExperiment {
  GranularSoil soil;            ///< what isn't varied
  std::vector<Factor> factors;  ///< named as a contact's numbers
  std::vector<Target> targets;
  dem::WorkOptions how;
};

/// What a person asks when he calibrates a contact.
struct ContactQuestion {
  ContactKind kind = ContactKind::grain_grain;
  std::vector<Factor> factors;
  std::vector<Target> targets;
  int packings = 0;                                ///< samples an experiment; 0: shear box 1, board 4
  Strength strength = Strength::peak;              ///< of the shear box
  std::vector<double> stresses{10e3, 20e3, 40e3};  ///< of the shear box [Pa]
  double settling_friction = 1;                    ///< of the shear box, 0 .. 1
  int across = 16;                                 ///< grains along a side of the board
  dem::WorkOptions how;
};

/// Sand on sand by the shear box, sand on tire by the tilting board, with the soil's own rolling resistance. Throws
/// InputError for a soil without grains and for settings that make no sense.
VirtualTest contact_test(const Soil& soil, const ContactQuestion& question);

/// The targets that a soil itself tells of a contact: phi and c for sand on sand. Throws InputError where it tells
/// none.
std::vector<Target> targets_of(const Soil& soil, ContactKind kind);

/// Names of the targets that a contact's test knows, their units, and usual bounds of what is varied.
std::vector<std::string> target_names(ContactKind kind);
std::string unit_of_target(const std::string& name);
std::vector<Factor> usual_factors(ContactKind kind);

// A bevameter in the computer: round plates pressed into beds of a soil's grains, rings with grousers turned on them.
//
//   const BevameterReadings read = virtual_bevameter(grains, {.packings = 3}, beds);
//   const BevameterFit fit = fit_bevameter(read.plates, read.shear);

struct VirtualBevameter {
  dem::SpecimenSettings specimen{};  ///< its packing is the first bed's seed
  double size = 1;                   ///< of the beds, as a multiple of the default; tools keep theirs
  int packings = 2;                  ///< beds; at least one
  dem::WorkOptions how{};
};

struct BevameterReadings {
  std::vector<PlateSet> plates;  ///< a set a packing
  std::vector<ShearCurve> shear;
  double density = 0;  ///< of the last bed [kg/m^3]
};

/// Throws what dem::plate_sinkage and dem::annular_shear throw.
BevameterReadings virtual_bevameter(const GranularSoil& grains, const VirtualBevameter& asked, dem::BedStore& beds);

}  // namespace soilbin::compare
