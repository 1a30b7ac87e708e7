#include "compare/bevameter/measured_shear.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "compare/bevameter/plate_tests.hpp"
#include "compare/report/number_text.hpp"
#include "scenario/errors.hpp"
#include "scenario/estimate.hpp"

namespace soilbin::compare {
namespace {

constexpr std::size_t fewest_shear_readings = 6;  // of a test

enum class ShearHolds { displacement, shear_stress, normal_stress, label, nothing };

struct ShearColumn {
  ShearHolds holds = ShearHolds::nothing;
  std::string unit{}, name{};
};

/// What a shear test can be, far beyond what any was: numbers outside stand under a wrong unit [SI].
struct ShearLimits {
  ShearHolds holds;
  const char* what;
  const char* dimension;
  double least, most;  ///< of the largest number in the file
};
constexpr std::array<ShearLimits, 3> shear_limits = {{
    {ShearHolds::displacement, "displacement", "m", 0.2e-3, 2.0},
    {ShearHolds::shear_stress, "shear_stress", "Pa", 50.0, 5e6},
    {ShearHolds::normal_stress, "normal_stress", "Pa", 50.0, 5e6},
}};

constexpr const char* shear_columns_hint =
    "columns: displacement_mm or Displacement [mm], shear_stress_kPa, normal_stress_kPa, in any unit, and those "
    "without a unit that identify the tests, such as test";

ShearColumn shear_column(const std::string& header) {
  const std::optional<NamedUnit> named = name_and_unit(header);
  if (!named) return {ShearHolds::label, "", header};
  ShearColumn column{ShearHolds::nothing, named->unit, header};
  for (const ShearLimits& one : shear_limits)
    if (named->name == one.what && same_dimension(named->parsed.dimension, parse_unit(one.dimension).dimension))
      column.holds = one.holds;
  return column;
}

/// The place of the column that holds this; none where there is no such column. Refuses two.
std::optional<std::size_t> place_of(ShearHolds what, const std::vector<ShearColumn>& columns, const CsvTable& table,
                                    const SourceText& csv) {
  std::optional<std::size_t> place;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i].holds != what) continue;
    if (place)
      csv.refuse(table.header.cells[i].offset,
                 fmt::format("a second column holds what '{}' does", columns[*place].name), shear_columns_hint);
    place = i;
  }
  return place;
}

void need_possible_sizes(const std::vector<const CsvRow*>& rows, const std::vector<ShearColumn>& columns,
                         const CsvTable& table, const SourceText& csv) {
  for (const ShearLimits& limits : shear_limits)
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (columns[i].holds != limits.holds) continue;
      double largest = 0.0;
      for (const CsvRow* row : rows)
        largest = std::max(largest, reading_in(row->cells[i], columns[i].name, columns[i].unit, csv));
      if (largest >= limits.least && largest <= limits.most) continue;
      const double per = per_unit(columns[i].unit);
      csv.refuse(
          table.header.cells[i].offset,
          fmt::format("column '{}': the largest number is {:.4g} {}; shear tests have {:g} to {:g} {}", columns[i].name,
                      largest * per, columns[i].unit, limits.least * per, limits.most * per, columns[i].unit),
          "the end of a column's name is the unit of its numbers; stresses and displacements are above 0");
    }
}

struct ShearReading {
  std::string test{};
  double normal_stress = 0.0, displacement = 0.0, shear_stress = 0.0;  ///< [SI]
};

/// Labels of tests whose normal stress was logged, not set: few readings share one.
std::set<std::string> labels_of_logged_stress(const std::vector<ShearReading>& readings) {
  std::map<std::string, std::pair<std::size_t, std::set<double>>> seen;
  for (const ShearReading& one : readings) ++seen[one.test].first, seen[one.test].second.insert(one.normal_stress);
  std::set<std::string> logged;
  for (const auto& [label, counted] : seen)
    if (counted.second.size() > 1 && counted.first < fewest_shear_readings * counted.second.size())
      logged.insert(label);
  return logged;
}

std::vector<MeasuredShear> tests_of(const std::vector<ShearReading>& readings, const SourceText& csv) {
  const std::set<std::string> logged = labels_of_logged_stress(readings);
  std::vector<MeasuredShear> tests;
  std::map<std::pair<std::string, double>, std::size_t> places;
  std::vector<std::vector<double>> stresses;  // of each test
  for (const ShearReading& one : readings) {
    const double set_stress = logged.contains(one.test) ? 0.0 : one.normal_stress;
    const auto [place, is_new] = places.try_emplace({one.test, set_stress}, tests.size());
    if (is_new) tests.push_back({one.test, {one.normal_stress, {}, {}}}), stresses.emplace_back();
    if (!(one.displacement > 0.0 && one.shear_stress > 0.0)) continue;
    stresses[place->second].push_back(one.normal_stress);
    tests[place->second].curve.displacement.push_back(one.displacement);
    tests[place->second].curve.shear_stress.push_back(one.shear_stress);
  }
  for (std::size_t k = 0; k < tests.size(); ++k) {
    if (!logged.contains(tests[k].test) || stresses[k].empty()) continue;
    const auto [least, most] = std::ranges::minmax(stresses[k]);
    constexpr double of_one_test = 1.5;
    if (most > of_one_test * least)
      throw InputError({csv.file},
                       fmt::format("the normal stress of test '{}' goes from {:.4g} to {:.4g} kPa", tests[k].test,
                                   least / 1e3, most / 1e3),
                       "", "name each test in a column without a unit, such as test");
    tests[k].curve.normal_stress = mean_of(stresses[k]).value;
    tests[k].normal_stress_spread = spread_of(stresses[k]);
  }
  return tests;
}

}  // namespace

std::vector<MeasuredShear> read_shear(const SourceText& csv,
                                      const std::vector<std::pair<std::string, std::string>>& only,
                                      std::optional<double> normal_stress) {
  constexpr std::size_t most_rows = 1'000'000;
  const CsvTable table = parse_csv(csv, most_rows);
  std::vector<ShearColumn> columns;
  for (const CsvCell& header : table.header.cells) columns.push_back(shear_column(header.text));
  const auto displacement = place_of(ShearHolds::displacement, columns, table, csv),
             shear = place_of(ShearHolds::shear_stress, columns, table, csv),
             normal = place_of(ShearHolds::normal_stress, columns, table, csv);
  const std::size_t at = table.header.cells.front().offset;
  if (!displacement) csv.refuse(at, "no column holds the displacement", shear_columns_hint);
  if (!shear) csv.refuse(at, "no column holds the shear stress", shear_columns_hint);
  if (!normal && !normal_stress)
    csv.refuse(at, "no column holds the normal stress",
               std::string(shear_columns_hint) + "; or --normal-stress 93kPa where every test was under one");
  if (normal && normal_stress)
    throw InputError(fmt::format("--normal-stress: {} gives the normal stress of its tests itself", csv.file));

  const std::vector<const CsvRow*> rows = rows_of(table, csv, only);
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (columns[i].holds == ShearHolds::label) need_label_of_tests(rows, i, table, csv);
  need_possible_sizes(rows, columns, table, csv);

  std::vector<ShearReading> readings;
  for (const CsvRow* row : rows) {
    ShearReading reading;
    for (std::size_t i = 0; i < columns.size(); ++i)
      if (columns[i].holds == ShearHolds::label)
        reading.test += (reading.test.empty() ? "" : ", ") + row->cells[i].text;
    const auto read = [&](std::size_t i) { return reading_in(row->cells[i], columns[i].name, columns[i].unit, csv); };
    reading.normal_stress = normal ? read(*normal) : *normal_stress;
    if (normal && !(reading.normal_stress > 0.0))
      csv.refuse(row->cells[*normal].offset, "a normal stress must be above 0");
    reading.displacement = read(*displacement), reading.shear_stress = read(*shear);
    readings.push_back(std::move(reading));
  }
  return tests_of(readings, csv);
}

namespace {

constexpr double hump_share = 0.9;  // of the peak, below which the end of a test is a residual strength

ShearTestFit fit_of(const MeasuredShear& test) {
  const ShearCurve& curve = test.curve;
  if (curve.displacement.size() < fewest_shear_readings)
    throw InputError(
        fmt::format("test '{}' has {} readings with a displacement and a shear stress above 0: six are needed",
                    test.test, curve.displacement.size()));
  ShearTestFit fit;
  const auto top = std::ranges::max_element(curve.shear_stress) - curve.shear_stress.begin();
  fit.peak = curve.shear_stress[static_cast<std::size_t>(top)];
  fit.peak_at = curve.displacement[static_cast<std::size_t>(top)];
  const double farthest = *std::ranges::max_element(curve.displacement);
  std::vector<double> last;
  for (std::size_t i = 0; i < curve.displacement.size(); ++i)
    if (curve.displacement[i] > 0.9 * farthest) last.push_back(curve.shear_stress[i]);
  const double end = std::reduce(last.begin(), last.end()) / static_cast<double>(last.size());
  if (end < hump_share * fit.peak) fit.residual = end;

  ShearCurve fitted = curve;
  if (fit.residual) {
    fitted.displacement.clear(), fitted.shear_stress.clear();
    for (std::size_t i = 0; i < curve.displacement.size(); ++i)
      if (curve.displacement[i] <= fit.peak_at)
        fitted.displacement.push_back(curve.displacement[i]), fitted.shear_stress.push_back(curve.shear_stress[i]);
  }
  if (fitted.displacement.size() < 4)
    throw InputError(
        fmt::format("test '{}' has its peak at its first readings: there is no curve up to it", test.test));
  fit.janosi = fit_janosi(fitted);
  return fit;
}

/// Mean and standard deviation of one more test; 0 for a single one.
Estimate mean_of_tests(const std::vector<double>& values) { return {mean_of(values).value, spread_of(values)}; }

Estimate angle_through_zero(const std::vector<ShearTop>& tops) {
  std::vector<double> angles;
  for (const ShearTop& top : tops) angles.push_back(std::atan(top.shear_max / top.normal_stress));
  return mean_of_tests(angles);
}

}  // namespace

MeasuredShearFit fit_measured_shear(std::span<const MeasuredShear> tests) {
  if (tests.empty()) throw InputError("no shear tests to fit");
  MeasuredShearFit fit;
  std::vector<ShearTop> tops, residuals;
  std::vector<double> moduli;
  for (const MeasuredShear& test : tests) {
    fit.tests.push_back(fit_of(test));
    const ShearTestFit& one = fit.tests.back();
    tops.push_back({test.curve.normal_stress, one.janosi.shear_max});
    if (one.residual) residuals.push_back({test.curve.normal_stress, *one.residual});
    moduli.push_back(one.janosi.modulus);
  }
  fit.shear_modulus = mean_of_tests(moduli);
  if (!residuals.empty()) fit.residual_angle = angle_through_zero(residuals);
  const auto [least, most] = std::ranges::minmax(tops, {}, &ShearTop::normal_stress);
  fit.one_stress = most.normal_stress < 1.05 * least.normal_stress;
  if (fit.one_stress) {
    fit.friction_angle = angle_through_zero(tops);
    return fit;
  }
  const ShearStrength strength = strength_of(tops);
  fit.cohesion = strength.cohesion, fit.friction_angle = strength.friction_angle;
  fit.cohesion_as_fitted = strength.cohesion.value;
  if (strength.cohesion.value < 0.0) fit.cohesion.value = 0.0, fit.friction_angle = angle_through_zero(tops);
  return fit;
}

}  // namespace soilbin::compare
