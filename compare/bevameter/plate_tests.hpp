// Plate tests that somebody made: plates pressed into a soil, as a CSV of the readings holds them.
//
//   for (const MeasuredPlate& plate : read_plates(read_source_text("plates.csv", largest_plate_csv)))
//   plate.curve.radius;
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bekker_wong/plate_fit.hpp"
#include "scenario/csv.hpp"
#include "scenario/source_text.hpp"

namespace soilbin::compare {

/// One plate pressed in once.
struct MeasuredPlate {
  std::string test;  ///< what tells it from its repeats: "large-box, force-displacement_1"
  bekker_wong::PlateCurve
      curve;                 ///< b [m]; its readings of a pressure and a sinkage above 0 [Pa, m], as they were made
  std::vector<int> lines{};  ///< of the file, of each reading; empty where it came from none
  std::optional<double> density{};  ///< of its bed [kg/m^3], where a column tells it
};

/// Plates may be logged at a high rate.
inline constexpr std::size_t largest_plate_csv = 1U << 26U;  ///< [bytes]
inline constexpr std::size_t most_plate_rows = 1'000'000;

/// Reads a CSV with one row a reading. A column's name ends in its unit: sinkage_m or sinkage_mm; pressure_kPa, or
/// force_N; plate_diameter_mm, plate_radius_mm or plate_width_mm (of a strip), or a label such as 'plate_d60mm' under
/// 'plate' or 'tool'. dry_density_kg/m^3 of the bed may be empty. Columns without a unit (box, test_id) tell one test
/// from another; others are left aside. The largest sinkage, pressure and size must be such as plates can have: others
/// stand under a wrong unit. `only`: column and value; rows in which they differ are left out. `diameter`: of the round
/// plate [m], where no column tells its size. Throws InputError with file, line and hint.
std::vector<MeasuredPlate> read_plates(const SourceText& csv,
                                       const std::vector<std::pair<std::string, std::string>>& only = {},
                                       std::optional<double> diameter = std::nullopt);
/// Reads the rows of a file that is parsed already; `table`: its cells.
std::vector<MeasuredPlate> read_plates(const SourceText& csv, const CsvTable& table,
                                       const std::vector<std::pair<std::string, std::string>>& only,
                                       std::optional<double> diameter);

}  // namespace soilbin::compare
