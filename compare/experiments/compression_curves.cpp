#include "compare/experiments/compression_curves.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>

#include "compare/bevameter/plate_tests.hpp"
#include "compare/report/number_text.hpp"
#include "scenario/csv.hpp"
#include "scenario/errors.hpp"
#include "scenario/nearest_word.hpp"
#include "scenario/unit.hpp"

namespace soilbin::compare {
namespace {

struct FeatureTraits {
  const char* name;
  const char* unit;
  double error, relative_error;  ///< of one careful test [SI], and as a share of the value
};
constexpr std::array<FeatureTraits, curve_features> traits = {{
    {"peak_angle", "deg", 0.5 * degree, 0.0},
    {"end_angle", "deg", 0.5 * degree, 0.0},
    {"half_strain", "%", 0.0, 0.25},
    {"volume", "%", 0.005, 0.0},
    {"void_ratio", "-", 0.02, 0.0},
}};

const FeatureTraits& traits_of(CurveFeature feature) { return traits[static_cast<std::size_t>(feature)]; }

constexpr const char* columns_hint =
    "columns: test, cell_pressure_kPa, axial_strain_percent, q_kPa, and void_ratio or volumetric_strain_percent where "
    "the volume was measured";

/// y at evenly spaced x from 0 to `until`, by lines between the readings; 0 before the first one.
std::vector<double> resampled(const std::vector<double>& x, const std::vector<double>& y, double until) {
  constexpr int points = 500;
  std::vector<double> even;
  std::size_t k = 0;
  for (int i = 1; i <= points; ++i) {
    const double at = until * i / points;
    while (k < x.size() && x[k] < at) ++k;
    if (k == x.size()) {
      even.push_back(y.back());
      continue;
    }
    const double before = k == 0 ? 0.0 : x[k - 1], from = k == 0 ? 0.0 : y[k - 1];
    even.push_back(from + (y[k] - from) * (at - before) / (x[k] - before));
  }
  return even;
}

double mean_of_last_tenth(const std::vector<double>& values) {
  const auto tenth = static_cast<std::ptrdiff_t>(values.size() / 10);
  return std::accumulate(values.end() - tenth, values.end(), 0.0) / static_cast<double>(tenth);
}

double highest_mean(const std::vector<double>& values) {
  const std::size_t wide = values.size() / 50;
  double sum = std::accumulate(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(wide), 0.0), most = sum;
  for (std::size_t k = wide; k < values.size(); ++k) most = std::max(most, sum += values[k] - values[k - wide]);
  return most / static_cast<double>(wide);
}

/// The columns of a file of triaxial tests.
struct CompressionColumns {
  std::size_t test, confining, strain, deviator;
  std::optional<std::size_t> void_ratio, volumetric, drainage;
};

class CompressionFile {
 public:
  explicit CompressionFile(const SourceText& csv) : csv_(csv), table_(parse_csv(csv)) {
    columns_ = {needed("test"),
                needed_stress("cell_pressure"),
                needed("axial_strain_percent"),
                needed_stress("q"),
                place("void_ratio"),
                place("volumetric_strain_percent"),
                place("drainage")};
  }

  std::vector<CompressionCurve> read(const std::vector<std::string>& names) const {
    std::vector<CompressionCurve> curves;
    std::map<std::string, std::size_t> places;  // of the tests among the curves
    for (const CsvRow& row : table_.rows) {
      if (columns_.drainage && row.cells[*columns_.drainage].text != "drained") continue;
      const std::string& name = row.cells[columns_.test].text;
      if (!names.empty() && std::ranges::find(names, name) == names.end()) continue;
      const auto [place, is_new] = places.try_emplace(name, curves.size());
      if (is_new) curves.push_back({.test = name, .confining = pressure_of(row)});
      add(row, curves[place->second]);
    }
    refuse_unusable(curves, names);
    return curves;
  }

 private:
  std::optional<std::size_t> place(const std::string& name) const {
    const auto& cells = table_.header.cells;
    const auto found = std::ranges::find(cells, name, &CsvCell::text);
    return found == cells.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - cells.begin()));
  }
  std::size_t needed(const std::string& name) const {
    if (const auto found = place(name)) return *found;
    csv_.refuse(table_.header.cells.front().offset, fmt::format("no column '{}'", name), columns_hint);
  }
  /// The column of a stress, whose name ends in its unit.
  std::size_t needed_stress(const std::string& what) const {
    for (std::size_t k = 0; k < table_.header.cells.size(); ++k)
      if (const auto named = name_and_unit(table_.header.cells[k].text);
          named && named->name == what && same_dimension(named->parsed.dimension, parse_unit("Pa").dimension))
        return k;
    csv_.refuse(table_.header.cells.front().offset, fmt::format("no column '{}_kPa' (or another unit of stress)", what),
                columns_hint);
  }
  double number(const CsvRow& row, std::size_t column) const {
    return number_in(row.cells[column], table_.header.cells[column].text, "-", csv_);
  }
  double stress(const CsvRow& row, std::size_t column) const {
    const std::string& header = table_.header.cells[column].text;
    return number(row, column) / per_unit(name_and_unit(header)->unit);
  }
  double pressure_of(const CsvRow& row) const {
    const double pressure = stress(row, columns_.confining);
    if (!(pressure > 0.0)) csv_.refuse(row.cells[columns_.confining].offset, "a cell pressure must be above 0");
    return pressure;
  }
  /// -ln(1 - share) of a strain in percent.
  double logarithmic(const CsvRow& row, std::size_t column) const {
    const double share = number(row, column) / 100.0;
    if (!(share < 1.0)) csv_.refuse(row.cells[column].offset, "a compression must stay below 100 %");
    return -std::log(1.0 - share);
  }

  void add(const CsvRow& row, CompressionCurve& curve) const {
    if (pressure_of(row) != curve.confining)
      csv_.refuse(row.cells[columns_.confining].offset, fmt::format("test '{}' has a second cell pressure", curve.test),
                  "give each specimen its own name");
    const double strain = logarithmic(row, columns_.strain), q = stress(row, columns_.deviator);
    if (columns_.void_ratio && !curve.void_ratio) {
      curve.void_ratio = number(row, *columns_.void_ratio);
      if (!(*curve.void_ratio > 0.0)) csv_.refuse(row.cells[*columns_.void_ratio].offset, "a void ratio is above 0");
    }
    if (strain <= (curve.strain.empty() ? 0.0 : curve.strain.back())) return;  // held, or unloaded
    curve.strain.push_back(strain);
    curve.sine.push_back(q / (q + 2.0 * curve.confining));
    if (columns_.volumetric)
      curve.volumetric.push_back(logarithmic(row, *columns_.volumetric));
    else if (columns_.void_ratio)
      curve.volumetric.push_back(std::log((1.0 + *curve.void_ratio) / (1.0 + number(row, *columns_.void_ratio))));
  }

  void refuse_unusable(const std::vector<CompressionCurve>& curves, const std::vector<std::string>& names) const {
    const std::size_t at = table_.header.cells.front().offset;
    std::vector<std::string> known;
    for (const CompressionCurve& curve : curves) known.push_back(curve.test);
    for (const std::string& name : names)
      if (std::ranges::find(known, name) == known.end()) {
        std::vector<std::string> all;
        for (const CompressionCurve& curve : read({})) all.push_back(curve.test);
        throw InputError(fmt::format("--tests: {}: {}", csv_.file, none_of(name, all)));
      }
    if (curves.empty()) csv_.refuse(at, "no drained test", columns_hint);
    for (const CompressionCurve& curve : curves)
      if (curve.strain.size() < 20 || curve.strain.back() < 0.01)
        throw InputError(fmt::format("{}: test '{}' has {} readings up to a strain of {:.2g} %: 20 and 1 % are needed",
                                     csv_.file, curve.test, curve.strain.size(),
                                     curve.strain.empty() ? 0.0 : 100 * curve.strain.back()));
  }

  const SourceText& csv_;
  CsvTable table_;
  CompressionColumns columns_{};
};

}  // namespace

const char* name_of(CurveFeature feature) { return traits_of(feature).name; }

std::string target_name(CurveFeature feature, const CompressionCurve& curve) {
  return fmt::format("{}.{}", name_of(feature), curve.test);
}

std::optional<double> feature_of(const CompressionCurve& curve, CurveFeature feature, double until) {
  const double end = std::min(until, curve.strain.back());
  if (feature == CurveFeature::void_ratio) return curve.void_ratio;
  if (feature == CurveFeature::volume) {
    if (curve.volumetric.empty()) return std::nullopt;
    return mean_of_last_tenth(resampled(curve.strain, curve.volumetric, end));
  }
  const std::vector<double> sine = resampled(curve.strain, curve.sine, end);
  if (feature == CurveFeature::end_angle) return std::asin(mean_of_last_tenth(sine));
  const double peak = highest_mean(sine);
  return feature == CurveFeature::peak_angle ? std::asin(peak) : first_at(curve.strain, curve.sine, peak / 2.0);
}

std::optional<double> feature_of(const CompressionCurve& curve, CurveFeature feature) {
  return feature_of(curve, feature, curve.strain.back());
}

std::vector<CompressionCurve> read_compression(const SourceText& csv, const std::vector<std::string>& names) {
  return CompressionFile(csv).read(names);
}

CompressionCurve curve_of(const dem::TriaxialRun& run) {
  CompressionCurve curve{.test = fmt::format("packing {}", run.packing), .confining = run.stress};
  curve.void_ratio = run.void_ratio;
  for (const dem::TriaxialSample& sample : run.curve) {
    curve.strain.push_back(sample.strain);
    curve.sine.push_back(sample.sine());
    curve.volumetric.push_back(sample.volumetric);
  }
  return curve;
}

std::vector<Target> targets_of(std::span<const CompressionCurve> tests, const std::vector<CurveFeature>& features) {
  std::vector<Target> targets;
  for (const CompressionCurve& test : tests)
    for (int k = 0; k < curve_features; ++k) {
      const auto feature = static_cast<CurveFeature>(k);
      const FeatureTraits& of = traits_of(feature);
      const std::optional<double> value = feature_of(test, feature);
      if (!features.empty() && std::ranges::find(features, feature) == features.end()) continue;
      if (!value) continue;
      const double error = of.error + of.relative_error * std::abs(*value);
      targets.push_back({target_name(feature, test), {*value, error}, of.unit, met_within * error});
    }
  return targets;
}

std::vector<std::vector<CompressionCurve>> by_density(std::span<const CompressionCurve> tests) {
  constexpr double alike = 0.03;  // in void ratio
  const auto looseness = [](const CompressionCurve& test) { return test.void_ratio.value_or(HUGE_VAL); };
  std::vector<double> sorted;
  for (const CompressionCurve& test : tests) sorted.push_back(looseness(test));
  std::ranges::sort(sorted, std::greater{});
  std::vector<double> densest;  // of each density
  for (const double void_ratio : sorted) {
    if (densest.empty() || (std::isfinite(densest.back()) && densest.back() - void_ratio >= alike))
      densest.push_back(void_ratio);
    densest.back() = void_ratio;
  }
  std::vector<std::vector<CompressionCurve>> densities(densest.size());
  for (const CompressionCurve& test : tests) {
    const auto of = std::ranges::find_if(densest, [&](double end) { return looseness(test) >= end; });
    densities[of - densest.begin()].push_back(test);
  }
  return densities;
}

dem::TriaxialSettings pressed_as(std::span<const CompressionCurve> tests, dem::TriaxialSettings settings) {
  settings.samples = 1000;
  settings.stresses.clear(), settings.strain = 0;
  for (const CompressionCurve& test : tests) {
    settings.strain = std::max(settings.strain, test.strain.back());
    if (std::ranges::find(settings.stresses, test.confining) == settings.stresses.end())
      settings.stresses.push_back(test.confining);
  }
  return settings;
}

Estimate simulated(CurveFeature feature, const CompressionCurve& test, const std::vector<dem::TriaxialRun>& runs) {
  std::vector<double> values;
  for (const dem::TriaxialRun& run : runs)
    if (run.stress == test.confining) values.push_back(*feature_of(curve_of(run), feature, test.strain.back()));
  return values.size() > 1 ? mean_of(values) : Estimate{values.front(), 0.0};
}

MeasuredBeside<CompressionCurve> beside_measured(std::vector<CompressionCurve> tests,
                                                 const std::vector<dem::TriaxialRun>& runs) {
  MeasuredBeside<CompressionCurve> beside{std::move(tests), {}};
  for (const CompressionCurve& test : beside.tests)
    for (int k = 0; k < curve_features; ++k) {
      const auto feature = static_cast<CurveFeature>(k);
      for (const Target& target : targets_of(std::span(&test, 1), {feature}))
        beside.features.push_back({target, simulated(feature, test, runs)});
    }
  return beside;
}

}  // namespace soilbin::compare
