// The n, k_c and k_phi of Bekker's form p = (k_c/b + k_phi) z^n that measured plate tests give, with errors. b is a
// round plate's radius, or the width of a strip.
//
//   const std::vector<MeasuredPlate> plates = read_plates(read_source_text("plates.csv", largest_csv));
//   const MeasuredPlatesFit fit = fit_measured_plates(plates);   // fit.k_phi.value +- fit.k_phi.std_error [N/m^(n+2)]
#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "compare/bevameter/plate_tests.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/report/plot.hpp"
#include "scenario/estimate.hpp"

namespace soilbin::compare {

/// Readings that are used: those of a pressure from `first` to `last` [Pa].
struct PressureWindow {
  double first = 0.0, last = std::numeric_limits<double>::infinity();
};

/// A value and the two parts of its standard error, which is the root of the sum of their squares.
struct PlateValue {
  Estimate estimate;
  double between_tests = 0.0;  ///< by leaving out each test in turn (jackknife), with Student's t; 0 without repeats
  double between_pressures = 0.0;  ///< half of what the lower and the upper half of each plate's pressures differ
};

struct MeasuredPlatesFit {
  PlateValue exponent, k_c, k_phi;      ///< [-], [N/m^(n+1)], [N/m^(n+2)]; errors of the k at this n
  double pressure_error = 0.0;          ///< root mean square of what Bekker's form misses, over the mean pressure
  double lowest = 0.0, highest = 0.0;   ///< pressures that were used [Pa]
  std::vector<double> radii;            ///< b of the plates, from the smallest [m]
  std::vector<double> plate_exponents;  ///< of each of these by itself
  std::vector<double> plate_moduli;     ///< of each at the common n [N/m^(n+2)]
  std::vector<int> tests;               ///< of each
};

/// One n for all tests and each plate's modulus at it (bekker_wong/plate_fit.hpp). Throws InputError for plates of one
/// size, and for a test with fewer than six readings in the window.
MeasuredPlatesFit fit_measured_plates(std::span<const MeasuredPlate> plates, const PressureWindow& window = {});

/// Pressure over sinkage: every reading in the window, and Bekker's form for each plate.
Sheet plates_sheet(std::span<const MeasuredPlate> plates, const MeasuredPlatesFit& fit, const std::string& title);

/// The values with the parts of their errors, each plate by itself, and the lines that a campaign or a soil file takes,
/// with `source` beside each number. tests: how many the fit is of.
std::string in_words(const MeasuredPlatesFit& fit, std::size_t tests, const std::string& source);
/// soilbin-plates/1.
Json to_json(const MeasuredPlatesFit& fit, std::size_t tests);

}  // namespace soilbin::compare
