// Comma-separated text as a table whose cells know their places (RFC 4180: quotes, CRLF; blank lines and rows of
// empty cells are skipped). Spreadsheets of countries with a decimal comma part the cells by semicolons: both are read,
// and either can be written.
//
//   const CsvTable table = parse_csv(read_source_text("runs.csv", largest_csv));
//   with_decimal_commas("slip,load_N\n0.1,80\n");   // "slip;load_N\n0,1;80\n"
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "scenario/source_text.hpp"

namespace soilbin {

struct CsvCell {
  std::string text;        ///< without quotes and the blanks around it; a number with a decimal point
  std::size_t offset = 0;  ///< of its first byte in the source
  bool quoted = false;     ///< stood in quotes: never taken for a number with a decimal comma
};

struct CsvRow {
  std::vector<CsvCell> cells;
  int line = 0;  ///< from 1
};

struct CsvTable {
  CsvRow header;
  std::vector<CsvRow> rows;  ///< each with as many cells as the header
};

inline constexpr std::size_t largest_csv = 1U << 24U;  ///< [bytes]
inline constexpr std::size_t most_csv_rows = 100'000;
inline constexpr std::size_t most_csv_columns = 200;

/// Cells are parted by commas, or by semicolons where the first line holds more of these: there a cell's number may
/// have a decimal comma, "4,4". Throws InputError with line and column for a quote that is never closed, text behind a
/// closing quote, a row with more or fewer cells than the header, an empty or repeated name in the header, no header at
/// all, more rows than most_rows, and too many columns.
CsvTable parse_csv(const SourceText& source, std::size_t most_rows = most_csv_rows);

/// Parses row by row, for files too long to keep: gives the header, and hands on each row that isn't empty.
/// `too_long` is the hint where there are more than `most_rows`.
CsvRow read_csv_rows(const SourceText& source, std::size_t most_rows, const std::string& too_long,
                     const std::function<void(const CsvRow& header)>& begin,
                     const std::function<void(CsvRow&& row)>& take);

/// A CSV as spreadsheets with a decimal comma read it: semicolons between cells, numbers with a decimal comma, a byte
/// order mark that tells them UTF-8. parse_csv reads it back to the same cells.
std::string with_decimal_commas(const std::string& csv);

/// The finite number that a cell of a column must hold; `unit`: that of the column ("-": none), for the hint. Throws
/// InputError at the cell, with what to write in its place.
double number_in(const CsvCell& cell, const std::string& column, const std::string& unit, const SourceText& source);

/// A text as a cell: quoted where it must be; behind a single quote where a spreadsheet would take it for a formula.
std::string csv_cell(const std::string& text);

}  // namespace soilbin
