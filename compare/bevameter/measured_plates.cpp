#include "compare/bevameter/measured_plates.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bekker_wong/gsl.hpp"
#include "compare/report/number_text.hpp"
#include "compare/report/table.hpp"
#include "scenario/errors.hpp"
#include "scenario/quantity.hpp"
#include "scenario/soil_parameters.hpp"

namespace soilbin::compare {
namespace {

using bekker_wong::PlateCurve;

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
    const auto [least, most] = std::ranges::minmax(curve.pressure);
    const double middle = 0.5 * (least + most);
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

/// A variance and the degrees of freedom that tell it (Satterthwaite's, of a sum of variances).
struct KnownVariance {
  double sum = 0.0, of_squares = 0.0;
  void add(double part, double freedom) { sum += part, of_squares += part * part / freedom; }
  double freedom() const { return of_squares > 0.0 ? sum * sum / of_squares : 1.0; }
};
using Variances = std::array<KnownVariance, 3>;  // of plate_numbers

/// Variances by leaving out one test after the other: for each size of plate with m > 1 tests, (m - 1)/m times the
/// squares about the mean of what is then found.
Variances jackknife(const std::vector<PlateCurve>& curves, const MeasuredPlatesFit& fit, double common) {
  Variances variances;
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
    for (std::size_t v = 0; v < plate_numbers.size(); ++v) {
      double PlateNumbers::*value = plate_numbers[v];
      double mean = 0.0, squares = 0.0;
      for (const PlateNumbers& one : without) mean += one.*value / m;
      for (const PlateNumbers& one : without) squares += (one.*value - mean) * (one.*value - mean);
      variances[v].add((m - 1) / m * squares, m - 1);
    }
  }
  return variances;
}

PlateValue value_of(double value, const KnownVariance& variance, double lower, double upper) {
  const double tests = std::sqrt(variance.sum) * gsl::student_factor(variance.freedom()),
               pressures = std::abs(upper - lower) / 2;
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

MeasuredPlatesFit fit_measured_plates(std::span<const MeasuredPlate> plates, const PressureWindow& window) {
  constexpr std::size_t fewest = 6;
  std::vector<PlateCurve> curves;
  for (const MeasuredPlate& plate : plates) {
    curves.push_back(within(plate.curve, window));
    const bool enough = plate.curve.pressure.size() >= fewest;
    if (curves.back().pressure.size() < fewest)
      throw InputError(fmt::format(
          "{} of the plate of b = {:g} mm has {} with a pressure and a sinkage above 0{}; {} are needed\n  "
          "hint: {}",
          plate.test.empty() ? "the test" : fmt::format("test '{}'", plate.test), 1000 * plate.curve.radius,
          counted(curves.back().pressure.size(), "reading"), enough ? " in the window" : "", fewest,
          enough ? "widen --pressure" : "more readings of this test, or leave it out; a negative one is not counted"));
  }
  if (curves.empty()) throw InputError("no plate tests to fit");
  MeasuredPlatesFit fit;
  fit.radii = radii_of(curves);
  const double n = bekker_wong::fit_plates(curves, bekker_wong::PlateExponent::common).exponent;
  add_plates(curves, n, fit);
  const PlateNumbers all = numbers_of(curves, n), lower = numbers_of(half_of(curves, true), n),
                     upper = numbers_of(half_of(curves, false), n);
  const auto [exponent, k_c, k_phi] = jackknife(curves, fit, n);
  fit.exponent = value_of(all.exponent, exponent, lower.exponent, upper.exponent);
  fit.k_c = value_of(all.k_c, k_c, lower.k_c, upper.k_c);
  fit.k_phi = value_of(all.k_phi, k_phi, lower.k_phi, upper.k_phi);
  add_misfit(curves, fit);
  return fit;
}

Sheet plates_sheet(std::span<const MeasuredPlate> plates, const MeasuredPlatesFit& fit, const std::string& title) {
  Plot plot{"Pressure [kPa]", {"sinkage [mm]", 0.0}, {"", 0.0}};
  for (std::size_t k = 0; k < fit.radii.size(); ++k) {
    const std::string plate = fmt::format("b = {:g} mm", 1000 * fit.radii[k]);
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
    const std::string unit = unit_behind(p.unit);
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
  Table plates{"", {"b [mm]", "tests", "n of its own", "k at the common n [kN/m^(n+2)]"}};
  for (std::size_t k = 0; k < fit.radii.size(); ++k)
    plates.add({fmt::format("{:g}", 1000 * fit.radii[k]), std::to_string(fit.tests[k]), number(fit.plate_exponents[k]),
                number(fit.plate_moduli[k] / 1e3)});
  return fmt::format(
      "{} with plates of {} sizes, {:.2g} to {:.3g} kPa\n\n{}\n± is one standard error: the two columns beside it, "
      "squared and added. Those of k_c and k_phi hold at this n.\nA file takes the three as independent, which makes "
      "pressures less sure than these tests are.\n\n{}\nb is a round plate's radius, a strip's width. Bekker's form "
      "misses the pressures by {} (root mean square, of "
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
