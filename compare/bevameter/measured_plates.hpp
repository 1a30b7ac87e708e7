// Plates that somebody pressed into a soil: a CSV of the readings, and the n, k_c and k_phi of Bekker's form
// p = (k_c/b + k_phi) z^n that they give, with errors. b is a round plate's radius, or half the width of a strip.
//
//   const std::vector<MeasuredPlate> plates = read_plates(read_source_text("plates.csv", largest_csv));
//   const MeasuredPlatesFit fit = fit_measured_plates(plates);   // fit.k_phi.value +- fit.k_phi.std_error [N/m^(n+2)]
#pragma once

#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bekker_wong/plate_fit.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/report/plot.hpp"
#include "scenario/estimate.hpp"
#include "scenario/source_text.hpp"

namespace soilbin::compare {

/// One plate pressed in once.
struct MeasuredPlate {
  std::string test;               ///< what tells it from its repeats: "large-box, force-displacement_1"
  bekker_wong::PlateCurve curve;  ///< b [m]; its readings of a pressure and a sinkage above 0 [Pa, m]
};

/// Readings that are used: those of a pressure from `first` to `last` [Pa].
struct PressureWindow {
  double first = 0.0, last = std::numeric_limits<double>::infinity();
};

/// Reads a CSV with one row a reading. A column's name ends in its unit: sinkage_m or sinkage_mm; pressure_kPa, or
/// force_N; plate_diameter_mm, plate_radius_mm or plate_width_mm (of a strip), or a label such as 'plate_d60mm' under
/// 'plate' or 'tool'. Columns without a unit (box, test_id) tell one test from another; others are left aside.
/// `only`: column and value; rows in which they differ are left out. Throws InputError with file, line and hint.
std::vector<MeasuredPlate> read_plates(const SourceText& csv,
                                       const std::vector<std::pair<std::string, std::string>>& only = {});

/// A value and the two parts of its standard error, which is the root of the sum of their squares.
struct PlateValue {
  Estimate estimate;
  double between_tests = 0.0;      ///< from leaving out each test in turn (jackknife); 0 without repeats
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

/// What is doubtful in the fit: a modulus below 0, plates that disagree, a form that misses the pressures.
std::vector<std::string> doubts(const MeasuredPlatesFit& fit);

/// Pressure over sinkage: every reading in the window, and Bekker's form for each plate.
Sheet plates_sheet(std::span<const MeasuredPlate> plates, const MeasuredPlatesFit& fit, const std::string& title);

/// The values with the parts of their errors, each plate by itself, and the lines that a campaign or a soil file takes,
/// with `source` beside each number. tests: how many the fit is of.
std::string in_words(const MeasuredPlatesFit& fit, std::size_t tests, const std::string& source);
/// soilbin-plates/1.
Json to_json(const MeasuredPlatesFit& fit, std::size_t tests);

}  // namespace soilbin::compare
