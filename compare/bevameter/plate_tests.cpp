#include "compare/bevameter/plate_tests.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string_view>

#include "compare/report/number_text.hpp"
#include "scenario/errors.hpp"
#include "scenario/nearest_word.hpp"
#include "scenario/quantity.hpp"

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
  const bool in_brackets = column.ends_with(']') || column.ends_with(')');
  const std::size_t cut = in_brackets ? column.find_last_of("[(") : column.rfind('_');
  if (cut == std::string::npos || cut + 1 == column.size()) return std::nullopt;
  NamedUnit named{column.substr(0, cut), column.substr(cut + 1), {}};
  if (in_brackets) {
    named.unit.pop_back();
    named.name.erase(named.name.find_last_not_of(" _") + 1);
    for (char& c : named.name) c = c == ' ' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
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

namespace {

/// What a column of a plate file holds.
enum class Holds {
  diameter,
  radius,
  width,
  plate_label,
  density,
  sinkage,
  pressure,
  force,
  force_beside_pressure,
  label,
  nothing
};

struct PlateColumn {
  Holds holds = Holds::nothing;
  std::string unit{}, name{};
};

constexpr const char* columns_hint =
    "columns: sinkage_m or Sinkage [m], pressure_kPa (or force_N), plate_diameter_m (or plate_radius_m, "
    "plate_width_m), in any unit, and those without a unit that identify the tests, such as test";

/// A name and, behind its last '_', a unit of the dimension that it must have; no value where it isn't one.
std::optional<PlateColumn> measured_column(const std::string& name) {
  const std::optional<NamedUnit> named = name_and_unit(name);
  if (!named) return std::nullopt;
  const std::string& unit = named->unit;
  const auto is = [&](std::initializer_list<const char*> words, const char* dimension) {
    return std::ranges::find(words, named->name) != words.end() &&
           same_dimension(named->parsed.dimension, parse_unit(dimension).dimension);
  };
  if (is({"plate_diameter", "diameter"}, "m")) return PlateColumn{Holds::diameter, unit};
  if (is({"plate_radius", "radius"}, "m")) return PlateColumn{Holds::radius, unit};
  if (is({"plate_width", "width"}, "m")) return PlateColumn{Holds::width, unit};
  if (is({"sinkage", "depth"}, "m")) return PlateColumn{Holds::sinkage, unit};
  if (is({"dry_density", "density"}, "kg/m^3")) return PlateColumn{Holds::density, unit};
  if (is({"pressure"}, "Pa")) return PlateColumn{Holds::pressure, unit};
  if (is({"force"}, "N")) return PlateColumn{Holds::force, unit};
  return PlateColumn{Holds::nothing, unit};
}

std::vector<PlateColumn> columns_of(const CsvTable& table) {
  std::vector<PlateColumn> columns;
  for (const CsvCell& header : table.header.cells) {
    if (const auto measured = measured_column(header.text))
      columns.push_back(*measured);
    else
      columns.push_back({header.text == "plate" || header.text == "tool" ? Holds::plate_label : Holds::label});
    columns.back().name = header.text;
  }
  const auto has = [&](Holds what) {
    return std::ranges::any_of(columns, [&](const PlateColumn& c) { return c.holds == what; });
  };
  for (PlateColumn& column : columns) {
    if (column.holds == Holds::force && has(Holds::pressure)) column.holds = Holds::force_beside_pressure;
    const bool sized = has(Holds::diameter) || has(Holds::radius) || has(Holds::width);
    if (column.holds == Holds::plate_label && sized) column.holds = Holds::label;
  }
  return columns;
}

void need_columns(const std::vector<PlateColumn>& columns, const CsvTable& table, const SourceText& csv,
                  bool size_is_told) {
  const auto count = [&](std::initializer_list<Holds> kinds) {
    return std::ranges::count_if(
        columns, [&](const PlateColumn& c) { return std::ranges::find(kinds, c.holds) != kinds.end(); });
  };
  const std::size_t at = table.header.cells.front().offset;
  const auto one = [&](std::initializer_list<Holds> kinds, const char* what) {
    if (count(kinds) == 0) csv.refuse(at, fmt::format("no column holds {}", what), columns_hint);
    if (count(kinds) > 1) csv.refuse(at, fmt::format("more than one column holds {}", what), columns_hint);
  };
  one({Holds::sinkage}, "the sinkage");
  one({Holds::pressure, Holds::force}, "the pressure");
  const std::initializer_list<Holds> sizes = {Holds::diameter, Holds::radius, Holds::width, Holds::plate_label};
  if (size_is_told && count(sizes) > 0)
    throw InputError(fmt::format("--plate: {} gives the size of its plates itself", csv.file));
  if (!size_is_told && count(sizes) == 0)
    csv.refuse(at, "no column holds the size of the plate",
               std::string(columns_hint) + "; or --plate DIAMETER where every test was with one round plate");
  if (!size_is_told) one(sizes, "the size of the plate");
  if (count({Holds::force}) > 0 && count({Holds::width}) > 0)
    csv.refuse(at, "a force on a strip gives no pressure: its length is not given", columns_hint);
}

/// 0 in an empty cell: nothing was measured, and no reading counts there.
double value_in(const CsvCell& cell, const PlateColumn& column, const SourceText& csv) {
  return reading_in(cell, column.name, column.unit, csv);
}

/// "plate_d60mm": the diameter behind the last 'd' that a length follows.
double diameter_in(const CsvCell& cell, const SourceText& csv) {
  const std::string& text = cell.text;
  for (std::size_t i = text.size(); i-- > 0;) {
    if (text[i] != 'd' || i + 1 == text.size() || std::isdigit(static_cast<unsigned char>(text[i + 1])) == 0) continue;
    const std::size_t end = std::min(text.find_first_of("_ ,;", i), text.size());
    try {
      return read_quantity(text.substr(i + 1, end - i - 1), {"m", above_zero});
    } catch (const InputError&) {
      continue;
    }
  }
  csv.refuse(cell.offset, fmt::format("'{}' gives no size of a plate", clipped(text)),
             "a label such as 'plate_d60mm' does, or a column plate_diameter_mm");
}

/// Bekker's b: a round plate's radius, a strip's whole width.
double radius_in(const CsvCell& cell, const PlateColumn& column, const SourceText& csv) {
  if (cell.text.empty())
    csv.refuse(cell.offset, fmt::format("column '{}': empty; every reading needs the size of its plate", column.name));
  const double size = column.holds == Holds::plate_label ? diameter_in(cell, csv) : value_in(cell, column, csv);
  if (!(size > 0.0)) csv.refuse(cell.offset, "a plate's size must be above 0");
  return column.holds == Holds::diameter || column.holds == Holds::plate_label ? size / 2 : size;
}

struct PlateReading {
  double radius = 0.0, sinkage = 0.0, pressure = 0.0, density = 0.0;
  std::string test;
};

PlateReading reading_of(const CsvRow& row, const std::vector<PlateColumn>& columns, const SourceText& csv,
                        std::optional<double> diameter) {
  PlateReading reading;
  reading.radius = diameter.value_or(0.0) / 2;
  bool by_force = false;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const CsvCell& cell = row.cells[i];
    switch (columns[i].holds) {
      case Holds::diameter:
      case Holds::radius:
      case Holds::width:
      case Holds::plate_label:
        reading.radius = radius_in(cell, columns[i], csv);
        break;
      case Holds::density:
        reading.density = value_in(cell, columns[i], csv);
        break;
      case Holds::sinkage:
        reading.sinkage = value_in(cell, columns[i], csv);
        break;
      case Holds::force:
        by_force = true;
        [[fallthrough]];
      case Holds::pressure:
        reading.pressure = value_in(cell, columns[i], csv);
        break;
      case Holds::label:
        reading.test += (reading.test.empty() ? "" : ", ") + cell.text;
        break;
      case Holds::force_beside_pressure:
      case Holds::nothing:
        break;
    }
  }
  if (by_force) reading.pressure /= std::numbers::pi * reading.radius * reading.radius;
  return reading;
}

/// What a plate test can be, far beyond what any was: numbers outside stand under a wrong unit.
struct PlateLimits {
  std::initializer_list<Holds> columns;
  double least, most;  ///< of the largest number in the file [SI]
  const char* most_of;
  std::initializer_list<const char*> units;
};
const std::array<PlateLimits, 4> plate_limits = {{
    {{Holds::sinkage}, 0.5e-3, 2.0, "plates sink in by", {"m", "mm", "cm"}},
    {{Holds::pressure}, 200.0, 5e6, "plates press on soil with", {"Pa", "kPa", "MPa"}},
    {{Holds::diameter, Holds::width}, 4e-3, 2.0, "plates measure", {"m", "mm", "cm"}},
    {{Holds::radius}, 2e-3, 1.0, "plates have a radius of", {"m", "mm", "cm"}},
}};

void need_possible_numbers(const std::vector<const CsvRow*>& rows, const std::vector<PlateColumn>& columns,
                           const CsvTable& table, const SourceText& csv) {
  for (const PlateLimits& limits : plate_limits)
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (std::ranges::find(limits.columns, columns[i].holds) == limits.columns.end()) continue;
      double largest = 0.0, smallest = 0.0;
      for (const CsvRow* row : rows) {
        const double value = value_in(row->cells[i], columns[i], csv);
        largest = std::max(largest, value), smallest = std::min(smallest, value);
      }
      if (largest == 0.0 && smallest < 0.0)
        csv.refuse(table.header.cells[i].offset,
                   fmt::format("column '{}': every number is below 0", clipped(columns[i].name)),
                   "change their sign: down into the soil is positive");
      if (largest == 0.0 || (largest >= limits.least && largest <= limits.most)) continue;
      const double written = largest * per_unit(columns[i].unit);
      std::string hint = "the end of a column's name is the unit of its numbers";
      for (const char* unit : limits.units)
        if (const double so = written / per_unit(unit); so >= limits.least && so <= limits.most) {
          hint += fmt::format(": if they are in {}, call it {}_{}", unit,
                              columns[i].name.substr(0, columns[i].name.rfind('_')), unit);
          break;
        }
      csv.refuse(
          table.header.cells[i].offset,
          fmt::format("column '{}': the largest number is {:.4g} {}; {} {:g} to {:g} {}", clipped(columns[i].name),
                      written, columns[i].unit, limits.most_of, limits.least * per_unit(columns[i].unit),
                      limits.most * per_unit(columns[i].unit), columns[i].unit),
          hint);
    }
}

/// Forces that stand beside the pressures of round plates and, over their area, say otherwise; which is right is not
/// known.
void need_forces_that_agree(const std::vector<const CsvRow*>& rows, const std::vector<PlateColumn>& columns,
                            const CsvTable& table, const SourceText& csv, std::optional<double> diameter) {
  constexpr double rounding = 0.05;  // of the largest pressure
  const auto force = std::ranges::find(columns, Holds::force_beside_pressure, &PlateColumn::holds);
  if (force == columns.end() || std::ranges::find(columns, Holds::width, &PlateColumn::holds) != columns.end()) return;
  const auto place = static_cast<std::size_t>(force - columns.begin());
  double largest = 0.0, apart = 0.0, by_force = 0.0, told = 0.0;
  for (const CsvRow* row : rows) {
    if (row->cells[place].text.empty()) continue;
    const PlateReading reading = reading_of(*row, columns, csv, diameter);
    if (reading.pressure == 0.0) continue;  // no reading
    const double pressure =
        value_in(row->cells[place], *force, csv) / (std::numbers::pi * reading.radius * reading.radius);
    largest = std::max(largest, reading.pressure);
    if (std::abs(pressure - reading.pressure) > apart)
      apart = std::abs(pressure - reading.pressure), by_force = pressure, told = reading.pressure;
  }
  if (apart > rounding * largest)
    csv.refuse(table.header.cells[place].offset,
               fmt::format("column '{}' over the plate's area gives {:.3g} kPa where the pressure is {:.3g} kPa",
                           clipped(force->name), by_force / 1e3, told / 1e3),
               "take the column out that is not to be used");
}

}  // namespace

std::vector<MeasuredPlate> read_plates(const SourceText& csv,
                                       const std::vector<std::pair<std::string, std::string>>& only,
                                       std::optional<double> diameter) {
  return read_plates(csv, parse_csv(csv, most_plate_rows), only, diameter);
}

std::vector<MeasuredPlate> read_plates(const SourceText& csv, const CsvTable& table,
                                       const std::vector<std::pair<std::string, std::string>>& only,
                                       std::optional<double> diameter) {
  const std::vector<PlateColumn> columns = columns_of(table);
  need_columns(columns, table, csv, diameter.has_value());
  const std::vector<const CsvRow*> rows = rows_of(table, csv, only);
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (columns[i].holds == Holds::label) need_label_of_tests(rows, i, table, csv);
  need_possible_numbers(rows, columns, table, csv);
  need_forces_that_agree(rows, columns, table, csv, diameter);
  std::vector<MeasuredPlate> plates;
  std::map<std::pair<std::string, double>, std::size_t> places;
  for (const CsvRow* row : rows) {
    const PlateReading reading = reading_of(*row, columns, csv, diameter);
    const auto [place, is_new] = places.try_emplace({reading.test, reading.radius}, plates.size());
    if (is_new) plates.push_back({reading.test, {.radius = reading.radius, .pressure = {}, .sinkage = {}}});
    MeasuredPlate& plate = plates[place->second];
    if (reading.density > 0.0) plate.density = reading.density;
    if (!(reading.pressure > 0.0 && reading.sinkage > 0.0)) continue;
    plate.curve.pressure.push_back(reading.pressure);
    plate.curve.sinkage.push_back(reading.sinkage);
    plate.lines.push_back(row->line);
  }
  return plates;
}

}  // namespace soilbin::compare
