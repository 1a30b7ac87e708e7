// True triaxial compression of grains between six smooth walls, each kept at a stress or moved at a rate. Compression
// counts positive.
//
//   const TriaxialResult test = triaxial(grains, {.stresses = {10e3, 20e3, 40e3}, .strain = 0.25});  // confining [Pa]
//   test.peak.friction_angle.value, test.residual.friction_angle.value                               // [rad]
#pragma once

#include <vector>

#include "dem/element_tests/mobilised.hpp"
#include "dem/element_tests/specimen.hpp"
#include "dem/element_tests/strength_line.hpp"

namespace soilbin::dem {

struct TriaxialSettings {
  SpecimenSettings specimen;
  int packings = 1;
  double side = 9, height = 14;                    ///< of the specimen, in mean diameters
  std::vector<double> stresses{10e3, 20e3, 40e3};  ///< confining stresses [Pa]
  double strain = 0.25;                            ///< axial, at the end [-]
  double inertial = 1e-3;                          ///< inertial number of the axial strain rate
  double residual_share = 0.25;                    ///< of the strain, at its end, for the residual strength
  double peak_window = 0.01;                       ///< strain over which the peak is a mean
  int samples = 120;
  bool ledger = false;
};

/// Stresses are means over a sample's steps; strains are those in its middle.
struct TriaxialSample {
  double strain = 0;                               ///< axial, logarithmic, compression positive
  double volumetric = 0;                           ///< -ln(V/V_0): negative where it dilates
  double axial = 0, lateral_x = 0, lateral_y = 0;  ///< stresses [Pa]

  double lateral() const { return (lateral_x + lateral_y) / 2; }  ///< their mean [Pa]
  /// (s1 - s3)/(s1 + s3): sine of the mobilised angle [-].
  double sine() const { return (axial - lateral()) / (axial + lateral()); }
};

struct TriaxialRun {
  double stress = 0;  ///< confining [Pa]
  std::uint64_t packing = 0;
  double void_ratio = 0;       ///< after isotropic consolidation
  double isotropic_error = 0;  ///< after consolidation, largest |stress/asked - 1| of the three axes
  HeldStress confining;        ///< mean of both lateral stresses at the peak and in the residual part [Pa]
  /// Largest |mean lateral stress/asked - 1|: of either side over the compression, of both at the peak and in the
  /// residual part.
  double confining_error = 0;
  std::vector<TriaxialSample> curve;
  Estimate peak, residual;    ///< (s1 - s3)/(s1 + s3) = sin of the mobilised angle [-]
  double peak_at = 0;         ///< strain
  double dilation_angle = 0;  ///< at the peak: sin psi = -(de_v/de_1)/(2 - de_v/de_1) [rad]
  double work = 0;            ///< of the walls on the grains during compression [J]
  double work_of_stress = 0;  ///< sum over samples of sigma_i de_i V: the same from stresses and strains [J]
  double energy_error = 0;
};

struct TriaxialResult {
  std::vector<TriaxialRun> runs;
  StrengthLine peak, residual;
  double mean_diameter = 0;
};

/// Throws InputError, RunStopped, Stopped.
TriaxialResult triaxial(const GranularSoil& soil, const TriaxialSettings& settings = {}, const WorkOptions& how = {},
                        BedStore* beds = nullptr);

}  // namespace soilbin::dem
