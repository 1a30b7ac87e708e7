// Comma-separated text as a table whose cells know their places (RFC 4180: quotes, CRLF; blank lines and rows of
// empty cells are skipped).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scenario/source_text.hpp"

namespace soilbin::compare {

struct CsvCell {
  std::string text;        ///< without quotes and the blanks around it
  std::size_t offset = 0;  ///< of its first byte in the source
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

/// Throws InputError with line and column for a quote that is never closed, text behind a closing quote, a row with
/// more or fewer cells than the header, an empty or repeated name in the header, no header at all, more rows than
/// most_rows, and too many columns.
CsvTable parse_csv(const SourceText& source, std::size_t most_rows = most_csv_rows);

/// The finite number that a cell of a column must hold; `unit`: that of the column ("-": none), for the hint. Throws
/// InputError at the cell, with what to write in its place.
double number_in(const CsvCell& cell, const std::string& column, const std::string& unit, const SourceText& source);

/// A text as a cell: quoted where it must be; behind a single quote where a spreadsheet would take it for a formula.
std::string csv_cell(const std::string& text);

}  // namespace soilbin::compare
