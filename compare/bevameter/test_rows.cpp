#include "compare/bevameter/test_rows.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <set>
#include <string_view>

#include "compare/report/number_text.hpp"
#include "scenario/errors.hpp"
#include "scenario/nearest_word.hpp"

namespace soilbin::compare {
namespace {

std::size_t place_of_column(const std::string& flag, const std::string& name, const CsvTable& table,
                            const SourceText& csv) {
  std::vector<std::string> names;
  for (const CsvCell& cell : table.header.cells) names.push_back(cell.text);
  const auto found = std::ranges::find(names, name);
  if (found == names.end())
    throw InputError(fmt::format("{}: {} has no column '{}'{}\n  hint: its columns are {}", flag, csv.file,
                                 clipped(name), did_you_mean(name, names), listed(names)));
  return static_cast<std::size_t>(found - names.begin());
}

std::vector<std::string> different_values(const CsvTable& table, std::size_t column) {
  std::vector<std::string> values;
  std::set<std::string_view> known;
  for (const CsvRow& row : table.rows)
    if (known.insert(row.cells[column].text).second) values.push_back(row.cells[column].text);
  return values;
}

/// The place of a column that --only names, where the file has it with this value.
std::size_t place_of_wanted(const std::string& name, const std::string& value, const CsvTable& table,
                            const SourceText& csv) {
  const std::size_t column = place_of_column("--only", name, table, csv);
  if (std::ranges::none_of(table.rows, [&](const CsvRow& row) { return row.cells[column].text == value; }))
    throw InputError(fmt::format("--only: no row of {} has {} '{}'{}", csv.file, name, clipped(value),
                                 did_you_mean(value, different_values(table, column))));
  return column;
}

}  // namespace

std::optional<NamedUnit> name_and_unit(const std::string& column) {
  const std::size_t bar = column.rfind('_');
  if (bar == std::string::npos || bar + 1 == column.size()) return std::nullopt;
  NamedUnit named{column.substr(0, bar), column.substr(bar + 1), {}};
  try {
    named.parsed = parse_unit(named.unit);
  } catch (const InputError&) {
    return std::nullopt;
  }
  return named;
}

double reading_in(const CsvCell& cell, const std::string& column, const std::string& unit, const SourceText& csv) {
  if (cell.text.empty()) return 0.0;
  return number_in(cell, column, unit, csv) / per_unit(unit);
}

std::vector<const CsvRow*> rows_of(const CsvTable& table, const SourceText& csv,
                                   const std::vector<std::pair<std::string, std::string>>& only) {
  std::vector<std::pair<std::size_t, std::string>> wanted;
  for (const auto& [name, value] : only) wanted.emplace_back(place_of_wanted(name, value, table, csv), value);
  std::vector<const CsvRow*> rows;
  for (const CsvRow& row : table.rows)
    if (std::ranges::all_of(wanted, [&](const auto& want) { return row.cells[want.first].text == want.second; }))
      rows.push_back(&row);
  return rows;
}

std::vector<std::string> values_of_column(const CsvTable& table, const SourceText& csv, const std::string& flag,
                                          const std::string& column) {
  return different_values(table, place_of_column(flag, column, table, csv));
}

void need_label_of_tests(const std::vector<const CsvRow*>& rows, std::size_t column, const CsvTable& table,
                         const SourceText& csv) {
  std::set<std::string> values;
  for (const CsvRow* row : rows) values.insert(row->cells[column].text);
  if (2 * values.size() <= std::max<std::size_t>(rows.size(), 6)) return;
  csv.refuse(table.header.cells[column].offset,
             fmt::format("column '{}' has no unit, so it identifies tests, and it has {} values in {} rows",
                         clipped(table.header.cells[column].text), values.size(), rows.size()),
             "take it out of the file, or let its name end in its unit (time_s): then it is left aside");
}

}  // namespace soilbin::compare
