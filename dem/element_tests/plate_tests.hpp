// The bevameter's two tests on a bed of grains: round plates pressed in, and an annulus with grousers turned under
// load.
#pragma once

#include <vector>

#include "dem/element_tests/specimen.hpp"

namespace soilbin::dem {

/// The bed both tests stand on: as wide as the widest tool times this, and so deep, in diameters of the tool.
struct TestBed {
  SpecimenSettings specimen;
  double width = 3.5;
  double depth = 1.5;
  double gravity = 9.81;  ///< [m/s^2]
};

struct PlateSettings {
  TestBed bed;
  std::vector<double> diameters{5, 7, 9};  ///< of the plates, in mean diameters of the grains; at least 5
  double sinkage = 2;                      ///< to which each is pressed, in mean diameters
  double inertial =
      1e-3;  ///< of speed over the plate's radius, under its own largest pressure so far or 5 kPa; sets speed
  int samples = 80;
};

struct PlateSample {
  double sinkage = 0, pressure = 0;  ///< [m], [Pa]
};

struct PlateRun {
  double diameter = 0;  ///< [m]
  std::vector<PlateSample> curve;
  double speed = 0;                     ///< [m/s]
  double bed_width = 0, bed_depth = 0;  ///< [m]
  double void_ratio = 0;
  std::uint64_t packing = 0;
};

/// Presses each plate into a fresh copy of the same bed. Throws InputError for plates less than five grains wide,
/// RunStopped, Stopped.
std::vector<PlateRun> plate_sinkage(const GranularSoil& soil, const PlateSettings& settings = {},
                                    const WorkOptions& how = {}, BedStore* beds = nullptr);

struct AnnulusSettings {
  TestBed bed;
  double inner = 4, outer = 9;  ///< radii of the ring, in mean diameters; the ring is at least five grains wide
  int grousers = 12;
  double grouser_height = 1;                      ///< in mean diameters
  std::vector<double> stresses{5e3, 10e3, 20e3};  ///< [Pa]
  double travel = 5;                              ///< at the ring's mean radius, in mean diameters
  double inertial = 1e-3;
  int samples = 100;
};

struct AnnulusSample {
  double displacement = 0;   ///< j, at the mean radius [m]
  double shear_stress = 0;   ///< 3 M/(2 pi (r_o^3 - r_i^3)) [Pa]
  double normal_stress = 0;  ///< [Pa]
  double sinkage = 0;        ///< since the turning began [m]
};

struct AnnulusRun {
  double stress = 0;
  std::vector<AnnulusSample> curve;
  double speed = 0;
  std::uint64_t packing = 0;
};

std::vector<AnnulusRun> annular_shear(const GranularSoil& soil, const AnnulusSettings& settings = {},
                                      const WorkOptions& how = {}, BedStore* beds = nullptr);

}  // namespace soilbin::dem
