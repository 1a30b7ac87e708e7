#include "scenario/csv_columns.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <string_view>

#include "scenario/csv.hpp"
#include "scenario/errors.hpp"
#include "scenario/estimate.hpp"
#include "scenario/nearest_word.hpp"

namespace soilbin {
namespace {

bool is_plain(const CsvColumn& column) { return column.measure.unit == "-"; }

/// "load_kN": how a column may be called.
std::string usual_head(const CsvColumn& column) {
  return is_plain(column) ? column.key : column.key + "_" + column.measure.unit;
}

/// The unit behind a column's key: of "load_kN", "load [kN]" and "load (kN)" kN; "" of the key alone; nothing where the
/// head is of another quantity.
std::optional<std::string> unit_behind(const std::string& head, const std::string& key) {
  if (!head.starts_with(key)) return std::nullopt;
  std::string unit = head.substr(key.size());
  if (unit.empty()) return "";
  if (std::string_view("_ [(").find(unit.front()) == std::string_view::npos) return std::nullopt;
  std::erase_if(unit, [](char c) { return std::string_view("_ []()").find(c) != std::string_view::npos; });
  return unit == "percent" ? "%" : unit;
}

/// The place of a column among the head's cells, and its unit.
struct PlacedColumn {
  std::size_t place = 0;
  std::string unit;
};

std::optional<PlacedColumn> place_of(const CsvColumn& column, const CsvTable& table, const SourceText& source) {
  std::optional<PlacedColumn> placed;
  for (std::size_t i = 0; i < table.header.cells.size(); ++i) {
    const CsvCell& cell = table.header.cells[i];
    const std::optional<std::string> unit = unit_behind(cell.text, column.key);
    if (!unit) continue;
    if (placed) source.refuse(cell.offset, fmt::format("a second column holds '{}'", column.key));
    try {
      const Unit expected = parse_unit(column.measure.unit);
      if ((is_plain(column) || !unit->empty()) && same_dimension(parse_unit(*unit).dimension, expected.dimension))
        placed = {i, unit->empty() ? "-" : *unit};
    } catch (const InputError&) {  // no unit at all
    }
    if (!placed)
      source.refuse(cell.offset,
                    fmt::format("column '{}': expected {} behind the name", clipped(cell.text),
                                dimension_name(parse_unit(column.measure.unit))),
                    fmt::format("such as '{}'", usual_head(column)));
  }
  if (!placed && column.need == Need::required)
    source.refuse(table.header.cells.front().offset, fmt::format("no column '{}'", column.key),
                  fmt::format("such as '{}'", usual_head(column)));
  return placed;
}

double number_of(const CsvCell& cell, const CsvColumn& column, const std::string& unit, const SourceText& source) {
  const auto about = [&](const std::string& wrong) { return fmt::format("column '{}': {}", column.key, wrong); };
  if (cell.text.empty()) source.refuse(cell.offset, about("empty; every row needs it"), "take the row out");
  const double written = number_in(cell, column.key, unit, source);
  if (const Range& range = column.measure.range; unit == "-" && !range.holds(written) && range.holds(written / 100))
    source.refuse(
        cell.offset,
        about(fmt::format("'{}' is out of range: must be {}", clipped(cell.text), describe_range(column.measure))),
        fmt::format("a column in per cent is called '{}_percent'", column.key));
  try {
    return read_quantity(cell.text + " " + unit, column.measure);
  } catch (const InputError& error) {
    source.refuse(cell.offset, about(error.what()));
  }
}

}  // namespace

std::vector<std::vector<double>> read_csv_columns(const SourceText& csv, const std::vector<CsvColumn>& columns) {
  const CsvTable table = parse_csv(csv);
  std::vector<std::optional<PlacedColumn>> placed;
  for (const CsvColumn& column : columns) placed.push_back(place_of(column, table, csv));
  for (std::size_t i = 0; i < table.header.cells.size(); ++i) {
    const auto is_here = [i](const std::optional<PlacedColumn>& one) { return one && one->place == i; };
    if (std::ranges::any_of(placed, is_here)) continue;
    std::vector<std::string> heads;
    for (const CsvColumn& column : columns) heads.push_back(usual_head(column));
    const CsvCell& cell = table.header.cells[i];
    csv.refuse(cell.offset, fmt::format("column '{}' is not read here", clipped(cell.text)),
               "columns here: " + listed(heads));
  }
  std::vector<std::vector<double>> rows;
  for (const CsvRow& row : table.rows) {
    std::vector<double>& numbers = rows.emplace_back();
    for (std::size_t c = 0; c < columns.size(); ++c)
      numbers.push_back(placed[c] ? number_of(row.cells[placed[c]->place], columns[c], placed[c]->unit, csv)
                                  : not_a_number);
  }
  return rows;
}

}  // namespace soilbin
