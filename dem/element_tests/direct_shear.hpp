// The shear box: a specimen in two halves, one slid over the other under a pressed lid.
//
//   const DirectShearResult box = direct_shear(grains, {.packings = 2, .stresses = {10e3, 20e3, 40e3}});  // [Pa]
//   box.peak.friction_angle.value, box.peak.cohesion.value  // [rad], [Pa]
//
// Weightless, so that the normal stress is one number. Walls and flanges of the halves are smooth (no friction), floor
// and lid grip: no grain slides or rolls on them. With smooth walls the vertical balance of the upper half is exact: N,
// what crosses the plane of shear, is the lid's force less what the upper grains rest on the lower half's flange; T is
// what lid and upper half push. Both are divided by the plane's area A that is left, and the lid is pressed so that N/A
// stays what was asked for while A shrinks.
//
// A short box overstates strength, since its ends do most of the work; plates on which grains slide understate that of
// a long one; a gap between the halves only tilts the plane, by the angle whose tangent is gap over length, so there is
// none (docs/lab/element-tests.md).
#pragma once

#include <vector>

#include "dem/bed/bed_store.hpp"
#include "dem/element_tests/mobilised.hpp"
#include "dem/element_tests/specimen.hpp"
#include "dem/element_tests/strength_line.hpp"

namespace soilbin::dem {

struct DirectShearSettings {
  SpecimenSettings specimen;
  int packings = 1;  ///< specimens, of seeds specimen.packing, +1, ...: each is sheared under each stress
  double length = 40, width = 12, height = 10;     ///< of the box, in mean diameters; length along the shear
  std::vector<double> stresses{10e3, 20e3, 40e3};  ///< normal stresses [Pa], at least two for c and phi
  double travel = 5;                               ///< of the upper half, in mean diameters
  double inertial = 1e-3;                          ///< inertial number of the shear over the height; sets the speed
  double residual_share = 0.4;  ///< of the travel, at its end, over which the residual strength is a mean
  double peak_window = 0.2;     ///< in mean diameters: the peak is the highest mean over so much travel
  int samples = 120;            ///< of a curve
  bool ledger = false;          ///< checks the balance of work; a step takes about twice as long
};

/// Means over one sample's steps.
struct ShearSample {
  double displacement = 0;   ///< of the upper half, in the sample's middle [m]
  double shear_stress = 0;   ///< [Pa]
  double normal_stress = 0;  ///< N/A on what is left of the plane of shear [Pa]
  double dilation = 0;       ///< rise of the lid since the shear began, in the sample's middle [m]
};

/// One specimen under one stress.
struct DirectShearRun {
  double stress = 0;          ///< asked for on the plane of shear [Pa]
  HeldStress normal;          ///< N/A as it was measured at the peak and in the residual part [Pa]
  std::uint64_t packing = 0;  ///< seed
  double void_ratio = 0;      ///< in the box, under the lid, before the shear
  double speed = 0;           ///< of the upper half [m/s]
  std::vector<ShearSample> curve;
  Estimate peak, residual;    ///< ratio shear stress over normal stress [-]
  double peak_at = 0;         ///< displacement [m]
  double imbalance = 0;       ///< |horizontal forces on all bodies, added| over T, means of the residual part
  double work = 0;            ///< done on the grains by lid and box during the shear [J]
  double work_of_stress = 0;  ///< sum of T dx - N dz, of the curve's forces: the same by the lab's reckoning [J]
  double energy_error = 0;    ///< change of the energy balance's total over work, with the ledger; else 0
};

struct DirectShearResult {
  std::vector<DirectShearRun> runs;
  StrengthLine peak, residual;  ///< fitted to all runs; empty (points 0) with a single stress
  double mean_diameter = 0;     ///< [m]
};

/// Throws InputError for settings that make no sense, RunStopped, Stopped. Same settings, same bits, for any number of
/// threads. `beds` keeps the specimens; by default they are settled anew.
DirectShearResult direct_shear(const GranularSoil& soil, const DirectShearSettings& settings = {},
                               const WorkOptions& how = {}, BedStore* beds = nullptr);

}  // namespace soilbin::dem
