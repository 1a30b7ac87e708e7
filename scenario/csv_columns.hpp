// Columns of numbers in a CSV whose heads hold their units: load_kN, load [kN], slip_percent.
//
//   const SourceText csv = read_source_text("points.csv", largest_csv);
//   for (const std::vector<double>& row : read_csv_columns(csv, {{"slip", {"-"}}, {"slope", {"deg"}}}))
//     climbed(row[0], row[1]);   // [-], [rad]
#pragma once

#include <string>
#include <vector>

#include "scenario/description.hpp"
#include "scenario/quantity.hpp"
#include "scenario/source_text.hpp"

namespace soilbin {

/// A column of numbers.
struct CsvColumn {
  std::string key;  ///< "load"; the head is the key with its unit: load_kN, load [kN]; of a plain number the key alone,
                    ///< or with a percentage: slip, slip_percent
  Measure measure;
  Need need = Need::required;
};

/// The numbers of each row [SI], in the order of the columns; not a number in one that the file does not have. Throws
/// InputError with the place in the CSV for a column that is missing, unknown, given twice or without its unit, and for
/// a cell without a number or with one out of its range.
std::vector<std::vector<double>> read_csv_columns(const SourceText& csv, const std::vector<CsvColumn>& columns);

}  // namespace soilbin
