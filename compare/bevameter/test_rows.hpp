// Rows of a CSV with one row a reading, where labels tell one test from another: which rows are wanted, and whether a
// column can be such a label.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scenario/csv.hpp"
#include "scenario/unit.hpp"

namespace soilbin::compare {

/// A column's name and, behind its last '_', a unit.
struct NamedUnit {
  std::string name, unit;
  Unit parsed;
};
/// "sinkage_mm" as "sinkage" in mm; none for a name that does not end in a unit.
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

}  // namespace soilbin::compare
