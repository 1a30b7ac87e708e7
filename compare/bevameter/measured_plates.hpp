// The n, k_c and k_phi of Bekker's form p = (k_c/b + k_phi) z^n that measured plate tests give, with errors. b is a
// round plate's radius, or the width of a strip. What is not on a test's loading curve (loading_curve.hpp), and a test
// that the others disown (tests_apart), is set aside and told.
//
//   const std::vector<MeasuredPlate> plates = read_plates(read_source_text("plates.csv", largest_plate_csv));
//   const MeasuredPlatesFit fit = fit_measured_plates(plates);   // fit.k_phi.value +- fit.k_phi.std_error [N/m^(n+2)]
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compare/bevameter/loading_curve.hpp"
#include "compare/bevameter/plate_tests.hpp"
#include "scenario/estimate.hpp"

namespace soilbin::compare {

// Whether plate tests on one soil agree with each other: which of them bears so much more or less than the others do
// that it was made on another soil, or is written in another unit.
//
//   const std::vector<TestLevel> levels = {{0.05, std::log(9e5)}, {0.05, std::log(9.2e5)}, {0.05, std::log(9e6)}};
//   for (const TestApart& one : tests_apart(levels, 1.0)) one.test, one.factor;  // the third: 10
//
// Each test's ln k (at the n of all) is held against those of the others: their mean, and a slope over ln b that
// Bekker's form makes -1 to 0. What remains scatters by a standard deviation that is known from the tests and, as much
// as four more tests would tell, from what re-tests scatter (a moderated t: Smyth 2004, Stat. Appl. Genet. Mol. Biol.
// 3:3).

struct TestLevel {
  double radius = 0.0;      ///< b [m]
  double ln_modulus = 0.0;  ///< ln k at the n of all tests [ln N/m^(n+2)]
};

/// A test that bears other pressures than the others let expect.
struct TestApart {
  std::size_t test = 0;    ///< its place among those given
  double factor = 1.0;     ///< its pressures over those that the others let expect at the same sinkage [-]
  bool set_aside = false;  ///< noise does not put it there: chance below thresholds::outlier_level over their number
  std::string unit{};  ///< what its numbers would be in, if a unit explains it: "its sinkage in cm for mm"; else empty
};

/// Tests whose level differs from the others', the farthest first; n: their common exponent. No more than a quarter of
/// the tests (one of three) is set aside, and never the only two.
std::vector<TestApart> tests_apart(std::span<const TestLevel> tests, double n);

/// Readings that are used: those of a pressure from `first` to `last` [Pa].
struct PressureWindow {
  double first = 0.0, last = std::numeric_limits<double>::infinity();
};

/// A value and the three parts of its standard error, which is the root of the sum of their squares.
struct PlateValue {
  Estimate estimate;
  /// What one more test of each plate scatters about these, and these about the truth: by the scatter of these tests
  /// and, as much as two more would tell, by what re-tests scatter elsewhere; with Student's t.
  double between_tests = 0.0;
  double between_pressures = 0.0;  ///< half of what the lower and the upper half of each plate's pressures differ
  double between_readings = 0.0;   ///< by least squares, of readings that scatter about their curves; n and k together
};

/// Readings that were left out of a fit.
struct PlateReadingsAside {
  std::string test;
  double radius = 0.0;     ///< b of its plate [m]
  AsideReadings readings;  ///< places in its curve
  std::vector<int> lines;  ///< of the file; empty where the test came from none
};

/// A test that the others disown.
struct PlateTestApart {
  TestApart apart;
  std::string test;
  double radius = 0.0;                ///< b of its plate [m]
  int first_line = 0, last_line = 0;  ///< of the file; 0 where the test came from none
};

struct MeasuredPlatesFit {
  PlateValue exponent, k_c, k_phi;  ///< [-], [N/m^(n+1)], [N/m^(n+2)]; errors of the k at this n
  double reference_sinkage = 0.0;   ///< where an error of n leaves the pressure as it is, k following n [m]
  double pressure_error = 0.0;      ///< root mean square of what Bekker's form misses, over the mean pressure
  /// xi_n [N/m^3] of resistive force theory, whose plate bears plate_response() xi_n z whatever its size: mean over the
  /// tests of the one that each is fitted best by, in least squares; and what it misses, as pressure_error.
  PlateValue xi_n;
  double xi_n_pressure_error = 0.0;
  double lowest = 0.0, highest = 0.0;  ///< pressures that were used [Pa]
  double deepest = 0.0,
         deepest_radius = 0.0;          ///< sinkage that was used, the largest over its plate's b, and that b [m]
  std::vector<double> radii;            ///< b of the plates, from the smallest [m]
  std::vector<double> plate_exponents;  ///< of each of these by itself
  std::vector<double> plate_moduli;     ///< of each at the common n [N/m^(n+2)]
  std::vector<int> tests;               ///< of each, those that were used
  double test_scatter = 0.0;            ///< standard deviation of ln k among tests of one size [-]; 0 without repeats
  double exponent_scatter = 0.0;        ///< and of their own n [-]
  double low_exponent = 0.0, high_exponent = 0.0;  ///< n of the lower and of the upper half of the pressures

  /// Plates of one size do not part k_c from k_phi: k_c is 0 then and k_phi stands for k_c/b + k_phi, good for this b.
  bool one_size() const { return radii.size() == 1; }
  /// Whether lower and upper halves of the pressures could be compared: else between_pressures are 0.
  bool halves_compared = true;
  std::size_t readings = 0;               ///< that were used
  std::vector<PlateReadingsAside> aside;  ///< readings that were not
  std::vector<PlateTestApart> apart;      ///< tests that disagree
  std::optional<std::array<double, 3>>
      kept;  ///< n, k_c and k_phi [SI] with all of these kept; none: there is no such fit
  std::size_t readings_aside() const;
};

/// One n for all tests and each plate's modulus at it (bekker_wong/plate_fit.hpp). Throws InputError for a test with
/// fewer than six readings on its loading curve in the window.
MeasuredPlatesFit fit_measured_plates(std::span<const MeasuredPlate> plates, const PressureWindow& window = {});

bekker_wong::PlateCurve readings_of(const bekker_wong::PlateCurve& curve, const std::vector<std::size_t>& places);
bekker_wong::PlateCurve within(const bekker_wong::PlateCurve& curve, const PressureWindow& window);
/// The pressure [Pa] that the fit gives a plate of this b [m] at this sinkage [m].
double bekkers_form(const MeasuredPlatesFit& fit, double radius, double sinkage);

/// "test '3' of the plate of b = 50 mm bears 10 times what the other tests let expect ..."
std::string in_words(const PlateTestApart& one);

}  // namespace soilbin::compare
