// Drained triaxial compression as a curve of stress, volume and strain, measured or simulated, and the numbers by which
// a calibration compares two such curves.
//
//   const auto tests = read_compression(read_source_text("triaxial.csv", largest_csv));
//   const double half = *feature_of(tests[0], CurveFeature::half_strain);  // strain at half of the peak [-]
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compare/experiments/measured_beside.hpp"
#include "dem/element_tests/triaxial.hpp"
#include "scenario/source_text.hpp"

namespace soilbin::compare {

/// One specimen under one cell pressure. Compression counts positive; strains are logarithmic.
struct CompressionCurve {
  std::string test;                    ///< "TX15"
  double confining = 0.0;              ///< cell pressure [Pa]
  std::optional<double> void_ratio{};  ///< when compression begins; none: not measured
  std::vector<double> strain{};        ///< axial, rising [-]
  std::vector<double> sine{};          ///< (s1 - s3)/(s1 + s3): sine of the mobilised angle [-]
  std::vector<double> volumetric{};    ///< -ln(V/V_0) [-]; empty: not measured
};

/// What a curve says of a sand.
enum class CurveFeature {
  peak_angle,   ///< largest mobilised angle, of the mean over a fiftieth of the strain [rad]
  end_angle,    ///< mobilised angle, mean over the last tenth of the strain [rad]
  half_strain,  ///< axial strain at which half of the peak's sine is first mobilised: the sand's stiffness [-]
  volume,       ///< volumetric strain, mean over the last tenth of the strain [-]
  void_ratio,   ///< when compression begins [-]
};
constexpr int curve_features = 5;

/// "peak_angle"
const char* name_of(CurveFeature feature);
/// "peak_angle.TX15"
std::string target_name(CurveFeature feature, const CompressionCurve& curve);
/// The feature over the curve's first part, up to an axial strain of `until`; none where the curve has no volume or
/// void ratio.
std::optional<double> feature_of(const CompressionCurve& curve, CurveFeature feature, double until);
std::optional<double> feature_of(const CompressionCurve& curve, CurveFeature feature);

/// Reads a CSV with one row a reading: test, cell_pressure_kPa (or another unit), axial_strain_percent and q_kPa (the
/// deviator stress), and with them void_ratio or volumetric_strain_percent, where they were measured. Strains are those
/// of the laboratory, shares of the first length or volume. Where a column `drainage` says other than "drained", the
/// row is left aside: the simulated cell holds its pressure and lets the volume change. `names`: the tests that are
/// wanted; empty: all. Throws InputError with file, line and hint.
std::vector<CompressionCurve> read_compression(const SourceText& csv, const std::vector<std::string>& names = {});

/// Tests of one density after the other, the loosest first: of specimens whose void ratios differ by less than 0.03
/// from the next one's (chosen). Tests without a void ratio go with the loosest.
std::vector<std::vector<CompressionCurve>> by_density(std::span<const CompressionCurve> tests);

/// The curve of a simulated run.
CompressionCurve curve_of(const dem::TriaxialRun& run);

/// The settings with the tests' pressures, as far as they go, and samples enough for half_strain.
dem::TriaxialSettings pressed_as(std::span<const CompressionCurve> tests, dem::TriaxialSettings settings);

/// The feature in the runs at the test's pressure, as far as it goes: mean over packings and its error, none of one.
Estimate simulated(CurveFeature feature, const CompressionCurve& test, const std::vector<dem::TriaxialRun>& runs);

/// Each test's features as targets, "peak_angle.TX15", with an error that one careful test of the laboratory has
/// (chosen): 0.5 deg, a quarter of the strain at half of the peak, 0.5 % of volume, 0.02 of void ratio. A target counts
/// as met within two of these errors. `features`: those that are wanted; empty: all that are measured.
std::vector<Target> targets_of(std::span<const CompressionCurve> tests, const std::vector<CurveFeature>& features = {});

/// Each test's features beside those of the runs, one of which at least is at its pressure.
MeasuredBeside<CompressionCurve> beside_measured(std::vector<CompressionCurve> tests,
                                                 const std::vector<dem::TriaxialRun>& runs);

}  // namespace soilbin::compare
