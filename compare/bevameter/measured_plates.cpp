#include "compare/bevameter/measured_plates.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numbers>
#include <optional>

#include "compare/measured/csv.hpp"
#include "compare/report/number_text.hpp"
#include "compare/report/table.hpp"
#include "scenario/errors.hpp"
#include "scenario/nearest_word.hpp"
#include "scenario/quantity.hpp"
#include "scenario/soil_parameters.hpp"

namespace soilbin::compare {
namespace {

using bekker_wong::PlateCurve;

/// What a column of a plate file holds.
enum class Holds { diameter, radius, width, plate_label, sinkage, pressure, force, label, nothing };

struct PlateColumn {
  Holds holds = Holds::nothing;
  std::string unit;
};

constexpr const char* columns_hint =
    "columns: sinkage_m, pressure_kPa (or force_N), plate_diameter_m (or plate_radius_m, plate_width_m), in any unit, "
    "and those without a unit that tell tests apart, such as test";

/// A name and, behind its last '_', a unit of the dimension that it must have; no value where it isn't one.
std::optional<PlateColumn> measured_column(const std::string& name) {
  const std::size_t bar = name.rfind('_');
  if (bar == std::string::npos || bar + 1 == name.size()) return std::nullopt;
  const std::string unit = name.substr(bar + 1);
  Unit parsed;
  try {
    parsed = parse_unit(unit);
  } catch (const InputError&) {
    return std::nullopt;
  }
  const std::string what = name.substr(0, bar);
  const auto is = [&](std::initializer_list<const char*> words, const char* dimension) {
    return std::ranges::find(words, what) != words.end() &&
           same_dimension(parsed.dimension, parse_unit(dimension).dimension);
  };
  if (is({"plate_diameter", "diameter"}, "m")) return PlateColumn{Holds::diameter, unit};
  if (is({"plate_radius", "radius"}, "m")) return PlateColumn{Holds::radius, unit};
  if (is({"plate_width", "width"}, "m")) return PlateColumn{Holds::width, unit};
  if (is({"sinkage", "depth"}, "m")) return PlateColumn{Holds::sinkage, unit};
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
      columns.push_back({header.text == "plate" || header.text == "tool" ? Holds::plate_label : Holds::label, ""});
  }
  const auto has = [&](Holds what) {
    return std::ranges::any_of(columns, [&](const PlateColumn& c) { return c.holds == what; });
  };
  for (PlateColumn& column : columns) {
    if (column.holds == Holds::force && has(Holds::pressure)) column.holds = Holds::nothing;
    const bool sized = has(Holds::diameter) || has(Holds::radius) || has(Holds::width);
    if (column.holds == Holds::plate_label && sized) column.holds = Holds::label;
  }
  return columns;
}

void need_columns(const std::vector<PlateColumn>& columns, const CsvTable& table, const SourceText& csv) {
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
  one({Holds::diameter, Holds::radius, Holds::width, Holds::plate_label}, "the size of the plate");
  if (count({Holds::force}) > 0 && count({Holds::width}) > 0)
    csv.refuse(at, "a force on a strip gives no pressure: its length is not told", columns_hint);
}

double value_in(const CsvCell& cell, const std::string& unit, const SourceText& csv) {
  const std::optional<double> value = read_number(cell.text);
  if (!value) csv.refuse(cell.offset, fmt::format("expected a number, not '{}'", clipped(cell.text)));
  return *value / per_unit(unit);
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
  csv.refuse(cell.offset, fmt::format("'{}' tells no size of a plate", clipped(text)),
             "a label such as 'plate_d60mm' does, or a column plate_diameter_mm");
}

double radius_in(const CsvCell& cell, const PlateColumn& column, const SourceText& csv) {
  const double size = column.holds == Holds::plate_label ? diameter_in(cell, csv) : value_in(cell, column.unit, csv);
  if (!(size > 0.0)) csv.refuse(cell.offset, "a plate's size must be above 0");
  return column.holds == Holds::radius ? size : size / 2;
}

struct PlateReading {
  double radius = 0.0, sinkage = 0.0, pressure = 0.0;
  std::string test;
};

PlateReading reading_of(const CsvRow& row, const std::vector<PlateColumn>& columns, const SourceText& csv) {
  PlateReading reading;
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
      case Holds::sinkage:
        reading.sinkage = value_in(cell, columns[i].unit, csv);
        break;
      case Holds::force:
        by_force = true;
        [[fallthrough]];
      case Holds::pressure:
        reading.pressure = value_in(cell, columns[i].unit, csv);
        break;
      case Holds::label:
        reading.test += (reading.test.empty() ? "" : ", ") + cell.text;
        break;
      case Holds::nothing:
        break;
    }
  }
  if (by_force) reading.pressure /= std::numbers::pi * reading.radius * reading.radius;
  return reading;
}

/// The places of the columns that `only` names, with the values that they must have.
std::vector<std::pair<std::size_t, std::string>> wanted(const CsvTable& table, const SourceText& csv,
                                                        const std::vector<std::pair<std::string, std::string>>& only) {
  std::vector<std::string> names;
  for (const CsvCell& cell : table.header.cells) names.push_back(cell.text);
  std::vector<std::pair<std::size_t, std::string>> all;
  for (const auto& [name, value] : only) {
    const auto found = std::ranges::find(names, name);
    if (found == names.end())
      throw InputError(fmt::format("--only: {} has no column '{}'{}\n  hint: its columns are {}", csv.file,
                                   clipped(name), did_you_mean(name, names), listed(names)));
    const auto column = static_cast<std::size_t>(found - names.begin());
    std::vector<std::string> values;
    for (const CsvRow& row : table.rows)
      if (std::ranges::find(values, row.cells[column].text) == values.end()) values.push_back(row.cells[column].text);
    if (std::ranges::find(values, value) == values.end())
      throw InputError(fmt::format("--only: no row of {} has {} '{}'{}", csv.file, name, clipped(value),
                                   did_you_mean(value, values)));
    all.emplace_back(column, value);
  }
  return all;
}

/// The readings of a curve in a window, or in the half of it below or above its middle.
PlateCurve within(const PlateCurve& curve, const PressureWindow& window) {
  PlateCurve kept{.radius = curve.radius, .pressure = {}, .sinkage = {}};
  for (std::size_t i = 0; i < curve.pressure.size(); ++i)
    if (curve.pressure[i] >= window.first && curve.pressure[i] <= window.last)
      kept.pressure.push_back(curve.pressure[i]), kept.sinkage.push_back(curve.sinkage[i]);
  return kept;
}

std::vector<PlateCurve> half_of(const std::vector<PlateCurve>& curves, bool lower) {
  std::vector<PlateCurve> halves;
  for (const PlateCurve& curve : curves) {
    const double middle = 0.5 * *std::ranges::max_element(curve.pressure);
    PlateCurve half = within(
        curve, lower ? PressureWindow{0.0, middle} : PressureWindow{middle, std::numeric_limits<double>::infinity()});
    if (half.pressure.size() >= 2) halves.push_back(std::move(half));
  }
  return halves;
}

/// n of these curves, and k_c and k_phi of them at the n of all.
struct PlateNumbers {
  double exponent = 0.0, k_c = 0.0, k_phi = 0.0;
};

PlateNumbers numbers_of(const std::vector<PlateCurve>& curves, double common) {
  const double n = bekker_wong::fit_plates(curves, bekker_wong::PlateExponent::common).exponent;
  const bekker_wong::PlateFit at = bekker_wong::fit_plates_at(curves, common);
  return {n, at.k_c, at.k_phi};
}

constexpr std::array<double PlateNumbers::*, 3> plate_numbers = {&PlateNumbers::exponent, &PlateNumbers::k_c,
                                                                 &PlateNumbers::k_phi};

/// Variances by leaving out one test after the other: for each size of plate with m > 1 tests, (m - 1)/m times the
/// squares about the mean of what is then found.
PlateNumbers jackknife(const std::vector<PlateCurve>& curves, const MeasuredPlatesFit& fit, double common) {
  PlateNumbers variance;
  for (std::size_t k = 0; k < fit.radii.size(); ++k) {
    if (fit.tests[k] < 2) continue;
    std::vector<PlateNumbers> without;
    for (std::size_t i = 0; i < curves.size(); ++i) {
      if (curves[i].radius != fit.radii[k]) continue;
      std::vector<PlateCurve> rest = curves;
      rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i));
      without.push_back(numbers_of(rest, common));
    }
    const auto m = static_cast<double>(without.size());
    for (double PlateNumbers::*value : plate_numbers) {
      double mean = 0.0, squares = 0.0;
      for (const PlateNumbers& one : without) mean += one.*value / m;
      for (const PlateNumbers& one : without) squares += (one.*value - mean) * (one.*value - mean);
      variance.*value += (m - 1) / m * squares;
    }
  }
  return variance;
}

PlateValue value_of(double value, double variance, double lower, double upper) {
  const double tests = std::sqrt(variance), pressures = std::abs(upper - lower) / 2;
  return {.estimate = {value, std::hypot(tests, pressures)}, .between_tests = tests, .between_pressures = pressures};
}

double form(const MeasuredPlatesFit& fit, double radius, double sinkage) {
  return (fit.k_c.estimate.value / radius + fit.k_phi.estimate.value) * std::pow(sinkage, fit.exponent.estimate.value);
}

void add_misfit(const std::vector<PlateCurve>& curves, MeasuredPlatesFit& fit) {
  double squares = 0.0, sum = 0.0, count = 0.0;
  fit.lowest = std::numeric_limits<double>::infinity();
  for (const PlateCurve& curve : curves)
    for (std::size_t i = 0; i < curve.pressure.size(); ++i) {
      const double p = curve.pressure[i], miss = p - form(fit, curve.radius, curve.sinkage[i]);
      squares += miss * miss, sum += p, count += 1.0;
      fit.lowest = std::min(fit.lowest, p), fit.highest = std::max(fit.highest, p);
    }
  fit.pressure_error = std::sqrt(squares / count) / (sum / count);
}

/// b of the plates, from the smallest. Throws InputError where there is one alone.
std::vector<double> radii_of(const std::vector<PlateCurve>& curves) {
  std::vector<double> radii;
  for (const PlateCurve& curve : curves) radii.push_back(curve.radius);
  std::ranges::sort(radii);
  radii.erase(std::unique(radii.begin(), radii.end()), radii.end());
  if (radii.size() < 2)
    throw InputError(
        "k_c and k_phi need plates of at least two sizes\n  hint: with one, take k_c = 0 and a wide sd of k_phi");
  return radii;
}

/// Number of tests, own exponent and modulus of each size of plate.
void add_plates(const std::vector<PlateCurve>& curves, double n, MeasuredPlatesFit& fit) {
  const bekker_wong::PlateFit at = bekker_wong::fit_plates_at(curves, n);
  for (const double radius : fit.radii) {
    double exponent = 0.0, modulus = 0.0;
    int count = 0;
    for (std::size_t i = 0; i < curves.size(); ++i)
      if (curves[i].radius == radius) exponent += at.plate_exponents[i], modulus += at.plate_moduli[i], ++count;
    fit.plate_exponents.push_back(exponent / count);
    fit.plate_moduli.push_back(modulus / count);
    fit.tests.push_back(count);
  }
}

}  // namespace

std::vector<MeasuredPlate> read_plates(const SourceText& csv,
                                       const std::vector<std::pair<std::string, std::string>>& only) {
  const CsvTable table = parse_csv(csv);
  const std::vector<PlateColumn> columns = columns_of(table);
  need_columns(columns, table, csv);
  const auto kept = wanted(table, csv, only);
  std::vector<MeasuredPlate> plates;
  for (const CsvRow& row : table.rows) {
    if (std::ranges::any_of(kept, [&](const auto& want) { return row.cells[want.first].text != want.second; }))
      continue;
    const PlateReading reading = reading_of(row, columns, csv);
    auto plate = std::ranges::find_if(plates, [&](const MeasuredPlate& known) {
      return known.test == reading.test && known.curve.radius == reading.radius;
    });
    if (plate == plates.end())
      plate = plates.insert(plates.end(), {reading.test, {.radius = reading.radius, .pressure = {}, .sinkage = {}}});
    if (!(reading.pressure > 0.0 && reading.sinkage > 0.0)) continue;
    plate->curve.pressure.push_back(reading.pressure);
    plate->curve.sinkage.push_back(reading.sinkage);
  }
  return plates;
}

MeasuredPlatesFit fit_measured_plates(std::span<const MeasuredPlate> plates, const PressureWindow& window) {
  constexpr std::size_t fewest = 6;
  std::vector<PlateCurve> curves;
  for (const MeasuredPlate& plate : plates) {
    curves.push_back(within(plate.curve, window));
    if (curves.back().pressure.size() < fewest)
      throw InputError(fmt::format(
          "test '{}' of the plate of {:g} mm has {} with a pressure and a sinkage above 0; {} are needed\n  hint: "
          "widen --pressure; a column without a unit in its name tells tests apart: call a time time_s",
          plate.test, 2000 * plate.curve.radius, counted(curves.back().pressure.size(), "reading"), fewest));
  }
  if (curves.empty()) throw InputError("no plate tests to fit");
  MeasuredPlatesFit fit;
  fit.radii = radii_of(curves);
  const double n = bekker_wong::fit_plates(curves, bekker_wong::PlateExponent::common).exponent;
  add_plates(curves, n, fit);
  const PlateNumbers all = numbers_of(curves, n), variance = jackknife(curves, fit, n),
                     lower = numbers_of(half_of(curves, true), n), upper = numbers_of(half_of(curves, false), n);
  fit.exponent = value_of(all.exponent, variance.exponent, lower.exponent, upper.exponent);
  fit.k_c = value_of(all.k_c, variance.k_c, lower.k_c, upper.k_c);
  fit.k_phi = value_of(all.k_phi, variance.k_phi, lower.k_phi, upper.k_phi);
  add_misfit(curves, fit);
  return fit;
}

std::vector<std::string> doubts(const MeasuredPlatesFit& fit) {
  std::vector<std::string> words;
  const std::string widths = fmt::format("{:g} to {:g} mm", 2000 * fit.radii.front(), 2000 * fit.radii.back());
  for (const auto& [name, value] : {std::pair{"k_phi", &fit.k_phi}, {"k_c", &fit.k_c}})
    if (value->estimate.value < 0.0 && -value->estimate.value > value->estimate.std_error)
      words.push_back(
          fmt::format("{} is negative: Bekker's form doesn't hold over these plates; the values are good for widths of "
                      "{}, and for no other",
                      name, widths));
  if (std::ranges::all_of(fit.tests, [](int count) { return count < 2; }))
    words.emplace_back("no plate was pressed in twice: the errors hold no scatter between tests");
  if (fit.pressure_error > 0.25)
    words.push_back(fmt::format(
        "Bekker's form misses the pressures by {}: fit over the pressures that your wheel makes (--pressure)",
        percent(fit.pressure_error)));
  return words;
}

Sheet plates_sheet(std::span<const MeasuredPlate> plates, const MeasuredPlatesFit& fit, const std::string& title) {
  Plot plot{"Pressure [kPa]", {"sinkage [mm]", 0.0}, {"", 0.0}};
  for (std::size_t k = 0; k < fit.radii.size(); ++k) {
    const std::string plate = fmt::format("{:g} mm", 2000 * fit.radii[k]);
    double deepest = 0.0;
    for (const MeasuredPlate& measured : plates) {
      if (measured.curve.radius != fit.radii[k]) continue;
      Series points{.label = plate + ", measured", .mark = Mark::points};
      points.color = static_cast<int>(k);
      const PlateCurve used = within(measured.curve, {fit.lowest, fit.highest});
      const std::size_t every = used.pressure.size() / 40 + 1;  // more points than these hide each other
      for (std::size_t i = 0; i < used.pressure.size(); i += every)
        points.x.push_back(1e3 * used.sinkage[i]), points.y.push_back(1e-3 * used.pressure[i]);
      deepest = std::max(deepest, *std::ranges::max_element(used.sinkage));
      plot.series.push_back(std::move(points));
    }
    Series line{.label = plate + ", Bekker's form"};
    line.color = static_cast<int>(k);
    for (int i = 0; i <= 100; ++i) {
      const double z = deepest * i / 100;
      line.x.push_back(1e3 * z), line.y.push_back(1e-3 * form(fit, fit.radii[k], z));
    }
    plot.series.push_back(std::move(line));
  }
  return {title, {plot}, Palette::named};
}

namespace {

/// A value of the fit, as soils name it.
struct NamedValue {
  const SoilParameter& parameter;
  const PlateValue& value;
};

std::vector<NamedValue> plate_values(const MeasuredPlatesFit& fit) {
  return {{soil_parameter("exponent"), fit.exponent},
          {soil_parameter("k_c"), fit.k_c},
          {soil_parameter("k_phi"), fit.k_phi}};
}

/// The lines that a campaign or a soil file takes: the sd to two digits, the value to the sd's place.
std::string yaml_lines(const MeasuredPlatesFit& fit, const std::string& source) {
  std::string text;
  for (const auto& [p, value] : plate_values(fit)) {
    const std::string unit = std::string_view(p.unit) == "-" ? "" : std::string(" ") + p.unit;
    const double sd = value.estimate.std_error * p.per_si;
    const int places = sd > 0.0 ? std::clamp(1 - static_cast<int>(std::floor(std::log10(sd))), 0, 9) : 4;
    text += fmt::format("  {}: {{value: {:.{}f}{}, sd: {:.{}f}{}, source: \"{}\"}}\n", p.name,
                        value.estimate.value * p.per_si, places, unit, sd, places, unit, source);
  }
  return text;
}

}  // namespace

std::string in_words(const MeasuredPlatesFit& fit, std::size_t tests, const std::string& source) {
  Table values{"", {"value", "fit", "between tests", "between low and high pressures"}};
  for (const auto& [p, value] : plate_values(fit))
    values.add({heading(p.symbol, p.unit), number(value.estimate, p.per_si), number(value.between_tests * p.per_si),
                number(value.between_pressures * p.per_si)});
  Table plates{"", {"plate [mm]", "tests", "n of its own", "k at the common n [kN/m^(n+2)]"}};
  for (std::size_t k = 0; k < fit.radii.size(); ++k)
    plates.add({fmt::format("{:g}", 2000 * fit.radii[k]), std::to_string(fit.tests[k]), number(fit.plate_exponents[k]),
                number(fit.plate_moduli[k] / 1e3)});
  return fmt::format(
      "{} with plates of {} sizes, {:.2g} to {:.3g} kPa\n\n{}\n± is one standard error: the two columns beside it, "
      "squared and added. Those of k_c and k_phi hold at this n.\nA file takes the three as independent, which makes "
      "pressures less sure than these tests are.\n\n{}\nBekker's form misses the pressures by {} (root mean square, of "
      "the mean pressure).\n\nFor campaign.yaml or a soil file:\n\n{}",
      counted(tests, "test"), fit.radii.size(), fit.lowest / 1e3, fit.highest / 1e3, as_text(values), as_text(plates),
      percent(fit.pressure_error), yaml_lines(fit, source));
}

Json to_json(const MeasuredPlatesFit& fit, std::size_t tests) {
  Json document = {{"format", "soilbin-plates/1"}, {"tests", tests}};
  for (const auto& [p, value] : plate_values(fit)) {
    document[p.name] = estimate_json(value.estimate);
    document[p.name]["between_tests"] = value.between_tests;
    document[p.name]["between_pressures"] = value.between_pressures;
  }
  document["pressure_error"] = fit.pressure_error;
  document["lowest_pressure"] = fit.lowest, document["highest_pressure"] = fit.highest;
  document["plates"] = Json::array();
  for (std::size_t k = 0; k < fit.radii.size(); ++k)
    document["plates"].push_back({{"radius", fit.radii[k]},
                                  {"tests", fit.tests[k]},
                                  {"exponent", fit.plate_exponents[k]},
                                  {"modulus", fit.plate_moduli[k]}});
  return document;
}

}  // namespace soilbin::compare
