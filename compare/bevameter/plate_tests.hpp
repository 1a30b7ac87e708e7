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
#include "scenario/unit.hpp"

namespace soilbin::compare {

// Rows of a CSV with one row a reading, where labels tell one test from another: which rows are wanted, and whether a
// column can be such a label.

/// A column's name and its unit, behind the last '_' or in brackets at the end.
struct NamedUnit {
  std::string name, unit;
  Unit parsed;
};
/// "sinkage_mm" and "Sinkage [mm]" as "sinkage" in mm, "Plate diameter (mm)" as "plate_diameter"; none for a name that
/// does not end in a unit.
std::optional<NamedUnit> name_and_unit(const std::string& column);

/// The number of a cell in SI; 0 in an empty one: nothing was measured, and no reading counts there. Throws InputError.
double reading_in(const CsvCell& cell, const std::string& column, const std::string& unit, const SourceText& csv);

/// The rows whose columns have the values that `only` names, all rows without any. Throws InputError for a column or a
/// value that the file does not have, with the nearest one.
std::vector<const CsvRow*> rows_of(const CsvTable& table, const SourceText& csv,
                                   const std::vector<std::pair<std::string, std::string>>& only);

/// What a column holds, each value once, in the order of the file. Throws InputError that names the flag.
std::vector<std::string> values_of_column(const CsvTable& table, const SourceText& csv, const std::string& flag,
                                          const std::string& column);

/// Throws InputError where the column, which has no unit and so tells tests apart, changes from row to row: a note, or
/// a number without its unit, would make a test of each reading.
void need_label_of_tests(const std::vector<const CsvRow*>& rows, std::size_t column, const CsvTable& table,
                         const SourceText& csv);

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
