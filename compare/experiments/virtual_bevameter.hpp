// A bevameter in the computer: round plates pressed into beds of a soil's grains, rings with grousers turned on them.
//
//   const BevameterReadings read = virtual_bevameter(grains, {.packings = 3}, beds);
//   const BevameterFit fit = fit_bevameter(read.plates, read.shear);
#pragma once

#include <vector>

#include "compare/bevameter/bevameter.hpp"
#include "dem/element_tests/bevameter_tests.hpp"
#include "scenario/soil.hpp"

namespace soilbin::compare {

struct VirtualBevameter {
  dem::SpecimenSettings specimen{};  ///< its packing is the first bed's seed
  dem::PlateSettings plates{};       ///< their specimen is the above
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
