// Tests with a tool on a bed of grains: a bevameter's round plates pressed in and its ring with grousers turned under
// load, and a cone penetrometer.
// Sinkage counts from the mean height of what one sees from above, as that of a wheel does (docs/theory/soil-bin.md).
//
//   const std::vector<PlateRun> plates = plate_sinkage(grains, {.diameters = {5, 7, 9}, .sinkage = 2});  // diameters
//   plates[0].curve.back().sinkage, plates[0].curve.back().pressure                                      // [m], [Pa]
//   const std::vector<AnnulusRun> rings = annular_shear(grains, {.stresses = {5e3, 10e3, 20e3}});        // [Pa]
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "dem/element_tests/specimen.hpp"

namespace soilbin::dem {

/// The square bed that a tool stands on, in diameters of the widest tool.
struct TestBed {
  SpecimenSettings specimen;
  double width = 3;
  double depth = 1.2;
};

/// The narrowest a tool may be, in mean diameters of the grains: below, single grains carry it.
inline constexpr double narrowest_tool = 5;

struct PlateSettings {
  TestBed bed;
  std::vector<double> diameters{5, 7, 9};  ///< of the plates, in mean diameters of the grains
  double sinkage = 2;                      ///< to which each is pressed, in mean diameters
  double speed = 0.05;                     ///< of the plates over sqrt(g d)
  int samples = 60;
};

/// Means over one sample's steps.
struct PlateSample {
  double sinkage = 0;   ///< [m]
  double pressure = 0;  ///< [Pa]
};

struct PlateRun {
  double diameter = 0;  ///< [m]
  double speed = 0;     ///< [m/s]
  std::vector<PlateSample> curve;
  std::size_t grains = 0;  ///< in the bed
  double void_ratio = 0;   ///< of the bed
  double density = 0;      ///< bulk density of the bed [kg/m^3]
  std::uint64_t packing = 0;

  /// The sinkage [m] at which the plate seats itself, as in the field: where it first bears 1 kPa, or the last of the
  /// curve. The surface of grains is rough, and its mean as seen from above, from which a run counts, lies below the
  /// tops that the plate comes to rest on.
  double seat() const {
    constexpr double seated = 1e3;  // [Pa]
    const auto bears = [](const PlateSample& at) { return at.pressure > seated; };
    const auto first = std::ranges::find_if(curve, bears);
    return first == curve.end() ? curve.back().sinkage : first->sinkage;
  }
};

/// Presses each plate into a fresh copy of one bed. Throws InputError for plates narrower than narrowest_tool,
/// RunStopped, Stopped.
std::vector<PlateRun> plate_sinkage(const GranularSoil& soil, const PlateSettings& settings = {},
                                    const WorkOptions& how = {}, BedStore* beds = nullptr);

/// A cone whose sides meet at 30 degrees, on a shaft half as thick as its base, as a cone penetrometer's. The field's
/// has a base of 20.3 or 12.8 mm (after ASABE S313), that is some hundred grains of sand; this one is as wide as the
/// grains allow.
struct ConeSettings {
  TestBed bed{.specimen = {}, .width = 5, .depth = 5.5};
  double diameter = 6;    ///< of the cone's base, in mean diameters of the grains
  double depth = 3;       ///< to which its base is pressed, in diameters of the base
  double friction = 0.5;  ///< of the cone, share of the grains' own
  double speed = 0.1;     ///< over sqrt(g d)
  int samples = 100;      ///< from where its tip meets the grains
};

struct ConeRun {
  PlateRun pressed;     ///< from where its base is level with the surface; the pressure is over the base's area
  double index = 0;     ///< mean cone index from the surface to the depth [Pa]
  double gradient = 0;  ///< of the straight line through these resistances, by least squares [Pa/m]
};

/// Throws InputError for a cone narrower than narrowest_tool and for one whose tip would come closer to the bed's floor
/// than half of its base, RunStopped, Stopped.
ConeRun cone_penetration(const GranularSoil& soil, const ConeSettings& settings = {}, const WorkOptions& how = {},
                         BedStore* beds = nullptr);

struct AnnulusSettings {
  TestBed bed{.specimen = {}, .width = 1.6, .depth = 0.55};
  double inner = 4, outer = 9;  ///< radii of the ring, in mean diameters; at least narrowest_tool apart
  int grousers = 12;            ///< radial bars under it
  double grouser_height = 1;    ///< in mean diameters
  double grouser_width = 0.5;   ///< in mean diameters
  std::vector<double> stresses{5e3, 10e3, 20e3};  ///< [Pa]
  double travel = 5;                              ///< at the ring's mean radius, in mean diameters
  double speed = 0.05;                            ///< there, over sqrt(g d)
  int samples = 100;
};

/// Means over one sample's steps.
struct AnnulusSample {
  double displacement = 0;   ///< j, at the mean radius, in the sample's middle [m]
  double shear_stress = 0;   ///< 3 M/(2 pi (r_o^3 - r_i^3)) [Pa]
  double normal_stress = 0;  ///< [Pa]
  double sinkage = 0;        ///< since the turning began, in the sample's middle [m]
};

struct AnnulusRun {
  double stress = 0;  ///< asked for [Pa]
  double speed = 0;   ///< at the mean radius [m/s]
  std::vector<AnnulusSample> curve;
  std::uint64_t packing = 0;
};

/// Sets the ring down under each stress on a fresh copy of one bed, and turns it. Throws InputError for a ring narrower
/// than narrowest_tool, RunStopped, Stopped.
std::vector<AnnulusRun> annular_shear(const GranularSoil& soil, const AnnulusSettings& settings = {},
                                      const WorkOptions& how = {}, BedStore* beds = nullptr);

}  // namespace soilbin::dem
