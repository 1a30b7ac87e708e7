#include "compare/bevameter/measured_plates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "bekker_wong/gsl.hpp"
#include "compare/report/number_text.hpp"
#include "compare/report/table.hpp"
#include "scenario/errors.hpp"
#include "scenario/mapping_writer.hpp"
#include "scenario/quantity.hpp"
#include "scenario/soil_parameters.hpp"

namespace soilbin::compare {
namespace {

using bekker_wong::PlateCurve;
using bekker_wong::PlateSums;

/// The readings of a curve in a window, or in the half of it below or above its middle.
PlateCurve within(const PlateCurve& curve, const PressureWindow& window) {
  PlateCurve kept{.radius = curve.radius, .pressure = {}, .sinkage = {}};
  for (std::size_t i = 0; i < curve.pressure.size(); ++i)
    if (curve.pressure[i] >= window.first && curve.pressure[i] <= window.last)
      kept.pressure.push_back(curve.pressure[i]), kept.sinkage.push_back(curve.sinkage[i]);
  return kept;
}

PlateCurve readings_of(const PlateCurve& curve, const std::vector<std::size_t>& places) {
  PlateCurve kept{.radius = curve.radius, .pressure = {}, .sinkage = {}};
  for (const std::size_t i : places)
    kept.pressure.push_back(curve.pressure[i]), kept.sinkage.push_back(curve.sinkage[i]);
  return kept;
}

/// Of each curve's lower or upper half of pressures, where that half tells an exponent.
std::vector<PlateSums> half_of(const std::vector<PlateCurve>& curves, bool lower) {
  std::vector<PlateSums> halves;
  for (const PlateCurve& curve : curves) {
    const auto [least, most] = std::ranges::minmax(curve.pressure);
    const double middle = 0.5 * (least + most);
    const PlateCurve half = within(
        curve, lower ? PressureWindow{0.0, middle} : PressureWindow{middle, std::numeric_limits<double>::infinity()});
    if (half.pressure.size() < 2) continue;
    const auto [shallow, deep] = std::ranges::minmax(half.sinkage);
    if (deep > shallow * (1 + 1e-6)) halves.push_back(sums_of(half));
  }
  return halves;
}

std::vector<PlateSums> all_sums(const std::vector<PlateCurve>& curves) {
  std::vector<PlateSums> sums;
  for (const PlateCurve& curve : curves) sums.push_back(sums_of(curve));
  return sums;
}

/// b of the plates, from the smallest.
std::vector<double> radii_of(const std::vector<PlateSums>& curves) {
  std::vector<double> radii;
  for (const PlateSums& curve : curves) radii.push_back(curve.radius);
  std::ranges::sort(radii);
  radii.erase(std::unique(radii.begin(), radii.end()), radii.end());
  return radii;
}

/// n of these curves, and k_c and k_phi of them at the n of all; of one size of plate k_phi is the modulus.
struct PlateNumbers {
  double exponent = 0.0, k_c = 0.0, k_phi = 0.0;
};

PlateNumbers numbers_of(const std::vector<PlateSums>& curves, double common) {
  PlateNumbers numbers{.exponent = bekker_wong::exponent_of(curves, bekker_wong::PlateExponent::common)};
  const double first = curves.front().radius;
  if (std::ranges::all_of(curves, [&](const PlateSums& curve) { return curve.radius == first; })) {
    for (const PlateSums& curve : curves) numbers.k_phi += curve.modulus(common) / static_cast<double>(curves.size());
  } else {
    const bekker_wong::PlateFit at = bekker_wong::fit_plates_at(curves, common);
    numbers.k_c = at.k_c, numbers.k_phi = at.k_phi;
  }
  return numbers;
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

/// Variances of one more test of each size of plate about these, by leaving out one test after the other: that of the
/// mean of m > 1 tests is (m - 1)/m times the squares about the mean of what is then found, and that of one more m
/// times as large; both are wrong.
Variances jackknife(const std::vector<PlateSums>& curves, const MeasuredPlatesFit& fit, double common) {
  Variances variances;
  for (std::size_t k = 0; k < fit.radii.size(); ++k) {
    if (fit.tests[k] < 2) continue;
    std::vector<PlateNumbers> without;
    for (std::size_t i = 0; i < curves.size(); ++i) {
      if (curves[i].radius != fit.radii[k]) continue;
      std::vector<PlateSums> rest = curves;
      rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i));
      without.push_back(numbers_of(rest, common));
    }
    const auto m = static_cast<double>(without.size());
    for (std::size_t v = 0; v < plate_numbers.size(); ++v) {
      double PlateNumbers::*value = plate_numbers[v];
      double mean = 0.0, squares = 0.0;
      for (const PlateNumbers& one : without) mean += one.*value / m;
      for (const PlateNumbers& one : without) squares += (one.*value - mean) * (one.*value - mean);
      variances[v].add((1 + m) * (m - 1) / m * squares, m - 1);
    }
  }
  return variances;
}

/// Standard errors of plate_numbers by least squares, n and the moduli fitted together: what readings scatter about the
/// curves of n and each test's k.
std::array<double, 3> errors_of_readings(const std::vector<PlateSums>& curves, std::size_t readings, double n) {
  double squares = 0.0, zz = 0.0, sum_u = 0.0, sum_uu = 0.0;
  for (const PlateSums& m : curves) {
    squares += std::max(0.0, m.pp - 2 * n * m.zp + n * n * m.zz), zz += m.zz;
    sum_u += 1 / m.radius, sum_uu += 1 / (m.radius * m.radius);
  }
  const auto tests = static_cast<double>(curves.size());
  const double variance = squares / std::max(1.0, static_cast<double>(readings) - tests - 1),
               spread = tests * sum_uu - sum_u * sum_u;
  double k_c = 0.0, k_phi = 0.0, k_c_by_n = 0.0, k_phi_by_n = 0.0;
  for (const PlateSums& m : curves) {  // of k, and the share that it has in k_c and in k_phi (fit_plates_at)
    const double of_k = std::pow(m.modulus(n), 2) * variance / m.weight, by_n = -m.modulus(n) * m.ln_z,
                 in_k_c = spread > 1e-9 * sum_uu ? (tests / m.radius - sum_u) / spread : 0.0,
                 in_k_phi = (1 - in_k_c * sum_u) / tests;
    k_c += in_k_c * in_k_c * of_k, k_phi += in_k_phi * in_k_phi * of_k;
    k_c_by_n += in_k_c * by_n, k_phi_by_n += in_k_phi * by_n;
  }
  const double of_n = std::sqrt(variance / zz);
  return {of_n, std::hypot(std::sqrt(k_c), k_c_by_n * of_n), std::hypot(std::sqrt(k_phi), k_phi_by_n * of_n)};
}

PlateValue value_of(double value, const KnownVariance& variance, double pressures, double readings) {
  const double tests = std::sqrt(variance.sum) * gsl::student_factor(variance.freedom());
  return {.estimate = {value, std::hypot(tests, pressures, readings)},
          .between_tests = tests,
          .between_pressures = pressures,
          .between_readings = readings};
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

/// Number of tests, own exponent and modulus of each size of plate, and how its tests scatter.
void add_plates(const std::vector<PlateSums>& curves, double n, MeasuredPlatesFit& fit) {
  double squares = 0.0;
  for (const double radius : fit.radii) {
    double exponent = 0.0, modulus = 0.0, sum = 0.0, sum_of_squares = 0.0;
    int count = 0;
    for (const PlateSums& curve : curves) {
      if (curve.radius != radius) continue;
      const double ln = std::log(curve.modulus(n));
      exponent += curve.exponent(), modulus += curve.modulus(n), sum += ln, sum_of_squares += ln * ln, ++count;
    }
    squares += std::max(0.0, sum_of_squares - sum * sum / count);
    fit.plate_exponents.push_back(exponent / count);
    fit.plate_moduli.push_back(modulus / count);
    fit.tests.push_back(count);
  }
  const std::size_t freedom = curves.size() - fit.radii.size();
  fit.test_scatter = freedom > 0 ? std::sqrt(squares / static_cast<double>(freedom)) : 0.0;
}

std::vector<int> lines_of(const MeasuredPlate& plate, const std::vector<std::size_t>& readings) {
  std::vector<int> lines;
  if (plate.lines.size() == plate.curve.pressure.size())
    for (const std::size_t i : readings) lines.push_back(plate.lines[i]);
  return lines;
}

std::string test_in_words(const std::string& test) {
  return test.empty() ? "the test" : fmt::format("test '{}'", clipped(test));
}

constexpr std::size_t fewest_readings = 6;

/// The loading curve of a test in the window; what is not on it is noted. Throws InputError where too little is left.
PlateCurve used_of(const MeasuredPlate& plate, const PressureWindow& window, MeasuredPlatesFit& fit) {
  const LoadingCurve loading = loading_curve(plate.curve);
  for (const AsideReadings& aside : loading.aside) {
    AsideReadings in{aside};
    std::erase_if(in.readings, [&](std::size_t i) {
      return plate.curve.pressure[i] < window.first || plate.curve.pressure[i] > window.last;
    });
    if (in.readings.empty()) continue;
    std::vector<int> lines = lines_of(plate, in.readings);
    fit.aside.push_back({plate.test, plate.curve.radius, std::move(in), std::move(lines)});
  }
  PlateCurve used = within(readings_of(plate.curve, loading.readings), window);
  if (used.pressure.size() >= fewest_readings) return used;
  const bool on_curve = loading.readings.size() >= fewest_readings,
             enough = plate.curve.pressure.size() >= fewest_readings;
  throw InputError(fmt::format(
      "{} of the plate of b = {:g} mm has {} with a pressure and a sinkage above 0{}{}; {} are needed\n  "
      "hint: {}",
      test_in_words(plate.test), 1000 * plate.curve.radius, counted(used.pressure.size(), "reading"),
      enough && !on_curve ? " on its loading curve" : "", on_curve ? " in the window" : "", fewest_readings,
      on_curve ? "widen --pressure"
      : enough ? "the others are spikes, unloading, or a sinkage that stands still under rising pressure: is a sensor "
                 "stuck? Leave this test out"
               : "more readings of this test, or leave it out; a negative one is not counted"));
}

/// Takes the tests out that the others disown, and notes them.
void take_tests_apart(std::span<const MeasuredPlate> plates, std::vector<PlateCurve>& curves,
                      std::vector<PlateSums>& sums, MeasuredPlatesFit& fit) {
  const double n = bekker_wong::exponent_of(sums, bekker_wong::PlateExponent::common);
  std::vector<TestLevel> levels;
  for (const PlateSums& curve : sums) levels.push_back({curve.radius, std::log(curve.modulus(n))});
  std::vector<bool> aside(sums.size());
  for (const TestApart& one : tests_apart(levels, n)) {
    const MeasuredPlate& plate = plates[one.test];
    fit.apart.push_back({one, plate.test, plate.curve.radius, plate.lines.empty() ? 0 : plate.lines.front(),
                         plate.lines.empty() ? 0 : plate.lines.back()});
    aside[one.test] = one.set_aside;
  }
  for (std::size_t i = aside.size(); i-- > 0;) {
    if (!aside[i]) continue;
    curves.erase(curves.begin() + static_cast<std::ptrdiff_t>(i));
    sums.erase(sums.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

/// n, k_c and k_phi of all readings in the window, whatever they are; nothing where that is no fit.
std::optional<std::array<double, 3>> with_all_kept(std::span<const MeasuredPlate> plates,
                                                   const PressureWindow& window) {
  std::vector<PlateCurve> curves;
  for (const MeasuredPlate& plate : plates) curves.push_back(within(plate.curve, window));
  try {
    const std::vector<PlateSums> sums = all_sums(curves);
    const double n = bekker_wong::exponent_of(sums, bekker_wong::PlateExponent::common);
    const PlateNumbers numbers = numbers_of(sums, n);
    return std::array{numbers.exponent, numbers.k_c, numbers.k_phi};
  } catch (const InputError&) {
    return std::nullopt;
  }
}

}  // namespace

std::size_t MeasuredPlatesFit::readings_aside() const {
  std::size_t count = 0;
  for (const PlateReadingsAside& one : aside) count += one.readings.readings.size();
  return count;
}

MeasuredPlatesFit fit_measured_plates(std::span<const MeasuredPlate> plates, const PressureWindow& window) {
  if (plates.empty()) throw InputError("no plate tests to fit");
  MeasuredPlatesFit fit;
  std::vector<PlateCurve> curves;
  for (const MeasuredPlate& plate : plates) curves.push_back(used_of(plate, window, fit));
  std::vector<PlateSums> sums = all_sums(curves);
  take_tests_apart(plates, curves, sums, fit);
  fit.radii = radii_of(sums);
  const double n = bekker_wong::exponent_of(sums, bekker_wong::PlateExponent::common);
  add_plates(sums, n, fit);
  const std::vector<PlateSums> low = half_of(curves, true), high = half_of(curves, false);
  fit.halves_compared = radii_of(low) == fit.radii && radii_of(high) == fit.radii;
  const PlateNumbers all = numbers_of(sums, n), lower = fit.halves_compared ? numbers_of(low, n) : all,
                     upper = fit.halves_compared ? numbers_of(high, n) : all;
  for (const PlateCurve& curve : curves) fit.readings += curve.pressure.size();
  const Variances tests = jackknife(sums, fit, n);
  const std::array<double, 3> readings = errors_of_readings(sums, fit.readings, n);
  const std::array<PlateValue*, 3> values = {&fit.exponent, &fit.k_c, &fit.k_phi};
  for (std::size_t v = 0; v < values.size(); ++v) {
    double PlateNumbers::*value = plate_numbers[v];
    *values[v] = value_of(all.*value, tests[v], std::abs(upper.*value - lower.*value) / 2, readings[v]);
  }
  add_misfit(curves, fit);
  for (const PlateValue* value : values)
    if (!std::isfinite(value->estimate.value) || !std::isfinite(value->estimate.std_error))
      throw InputError(
          "these readings give no finite n, k_c and k_phi\n  hint: look at them with --plot; do pressures and sinkages "
          "grow together?");
  if (!fit.aside.empty() || std::ranges::any_of(fit.apart, [](const auto& one) { return one.apart.set_aside; }))
    fit.kept = with_all_kept(plates, window);
  return fit;
}

Sheet plates_sheet(std::span<const MeasuredPlate> plates, const MeasuredPlatesFit& fit, const std::string& title) {
  Plot plot{"Pressure [kPa]", {"sinkage [mm]", 0.0}, {"", 0.0}};
  const auto is_aside = [&](const MeasuredPlate& plate) {
    return std::ranges::any_of(fit.apart, [&](const PlateTestApart& one) {
      return one.apart.set_aside && one.test == plate.test && one.radius == plate.curve.radius;
    });
  };
  const auto add = [](Series& points, const PlateCurve& curve, double deepest, double highest) {
    const std::size_t every = curve.pressure.size() / 40 + 1;  // more points than these hide each other
    for (std::size_t i = 0; i < curve.pressure.size(); i += every)
      if (curve.sinkage[i] <= deepest && curve.pressure[i] <= highest)
        points.x.push_back(1e3 * curve.sinkage[i]), points.y.push_back(1e-3 * curve.pressure[i]);
  };
  constexpr double everywhere = std::numeric_limits<double>::infinity();
  double most = 0.0;  // sinkage on a loading curve
  for (std::size_t k = 0; k < fit.radii.size(); ++k) {
    const std::string plate = fmt::format("b = {:g} mm", 1000 * fit.radii[k]);
    double deepest = 0.0;
    for (const MeasuredPlate& measured : plates) {
      if (measured.curve.radius != fit.radii[k] || is_aside(measured)) continue;
      Series points{.label = plate + ", measured", .mark = Mark::points};
      points.color = static_cast<int>(k);
      const PlateCurve used =
          within(readings_of(measured.curve, loading_curve(measured.curve).readings), {fit.lowest, fit.highest});
      add(points, used, everywhere, everywhere);
      deepest = std::max(deepest, *std::ranges::max_element(used.sinkage));
      plot.series.push_back(std::move(points));
    }
    Series line{.label = plate + ", Bekker's form"};
    line.color = static_cast<int>(k);
    for (int i = 0; i <= 100; ++i) {
      const double z = deepest * i / 100;
      line.x.push_back(1e3 * z), line.y.push_back(1e-3 * form(fit, fit.radii[k], z));
    }
    most = std::max(most, deepest);
    plot.series.push_back(std::move(line));
  }
  Series aside{.label = "set aside", .mark = Mark::points};
  aside.color = static_cast<int>(fit.radii.size());
  for (const MeasuredPlate& measured : plates) {
    std::vector<std::size_t> places;
    for (const PlateReadingsAside& one : fit.aside)
      if (one.test == measured.test && one.radius == measured.curve.radius)
        places.insert(places.end(), one.readings.readings.begin(), one.readings.readings.end());
    add(aside, is_aside(measured) ? measured.curve : readings_of(measured.curve, places), 1.5 * most,
        1.5 * fit.highest);
  }
  if (!aside.x.empty()) plot.series.push_back(std::move(aside));
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
  const SoilParameter& exponent = soil_parameter("exponent");
  if (!exponent.range.holds(fit.exponent.estimate.value))
    return fmt::format("None for a file: a soil file takes n from {:g} to {:g}.\n", exponent.range.lower,
                       exponent.range.upper);
  std::string text = "For campaign.yaml or a soil file:\n\n";
  for (const auto& [p, value] : plate_values(fit)) {
    const std::string unit = unit_behind(p.unit);
    const double sd = value.estimate.std_error * p.per_si, shown = value.estimate.value * p.per_si;
    const bool presumed = fit.one_size() && std::string_view(p.name) == "k_c";
    const int places = sd > 0.0 ? std::clamp(1 - static_cast<int>(std::floor(std::log10(sd))), 0, 9) : 0;
    text += fmt::format("  {}: {{value: {}{}, sd: {:.{}f}{}, source: {}}}\n", p.name,
                        sd > 0.0 ? fmt::format("{:.{}f}", shown, places) : write_number(shown), unit, sd, places, unit,
                        yaml_scalar(presumed ? source + "; presumed: one size of plate" : source));
  }
  return text;
}

/// "lines 3, 7 to 9, 12, ..."
std::string line_list(const std::vector<int>& lines) {
  constexpr std::size_t most = 6;
  if (lines.empty()) return "";
  std::vector<std::string> runs;
  for (std::size_t i = 0; i < lines.size();) {
    std::size_t last = i;
    while (last + 1 < lines.size() && lines[last + 1] == lines[last] + 1) ++last;
    if (runs.size() == most) {
      runs.emplace_back("...");
      break;
    }
    runs.push_back(last == i ? std::to_string(lines[i])
                             : fmt::format("{}{}{}", lines[i], last == i + 1 ? ", " : " to ", lines[last]));
    i = last + 1;
  }
  return fmt::format("line{} {}", lines.size() == 1 ? "" : "s", fmt::join(runs, ", "));
}

/// A sentence for each kind of readings that were set aside.
std::string aside_in_words(const MeasuredPlatesFit& fit) {
  struct Kind {
    std::vector<AsideWhy> whys;
    const char* what;
  };
  const std::array<Kind, 3> kinds = {{
      {{AsideWhy::sinkage_spike, AsideWhy::pressure_spike, AsideWhy::end_spike},
       "spikes, off the readings around them"},
      {{AsideWhy::unloading}, "unloading, reloading or holding"},
      {{AsideWhy::stuck},
       "a sinkage that stands still under rising pressure (a depth sensor that sticks or is at its end, or hard "
       "ground)"},
  }};
  std::string text;
  for (const Kind& kind : kinds) {
    std::vector<int> lines;
    std::set<std::pair<std::string, double>> tests;
    std::vector<double> stiffness;
    std::size_t count = 0;
    for (const PlateReadingsAside& one : fit.aside) {
      if (std::ranges::find(kind.whys, one.readings.why) == kind.whys.end()) continue;
      count += one.readings.readings.size();
      lines.insert(lines.end(), one.lines.begin(), one.lines.end());
      tests.emplace(one.test, one.radius);
      if (one.readings.unloading_stiffness) stiffness.push_back(*one.readings.unloading_stiffness);
    }
    if (count == 0) continue;
    std::ranges::sort(lines), std::ranges::sort(stiffness);
    const std::string where = line_list(lines);
    text += fmt::format("Set aside as {}: {} of {}{}.\n", kind.what, counted(count, "reading"),
                        counted(tests.size(), "test"), where.empty() ? "" : fmt::format(" ({})", where));
    if (stiffness.size() == 1)
      text += fmt::format("There the slope of pressure over sinkage k_u is {} MN/m^3.\n",
                          number(stiffness.front() / 1e6, 3));
    else if (stiffness.size() > 1)
      text += fmt::format("There the slope of pressure over sinkage k_u is {} to {} MN/m^3.\n",
                          number(stiffness.front() / 1e6, 3), number(stiffness.back() / 1e6, 3));
  }
  return text;
}

/// A sentence for each test that the others disown.
std::string apart_in_words(const MeasuredPlatesFit& fit) {
  std::string text;
  for (const PlateTestApart& one : fit.apart) text += capital(in_words(one)) + "\n";
  return text;
}

}  // namespace

std::string in_words(const PlateTestApart& one) {
  const double factor = one.apart.factor;
  std::string text =
      fmt::format("{} of the plate of b = {:g} mm{} {} what the other tests let expect at the same sinkage",
                  test_in_words(one.test), 1000 * one.radius,
                  one.first_line > 0 ? fmt::format(" (lines {} to {})", one.first_line, one.last_line) : "",
                  factor >= 1 ? fmt::format("bears {} times", number(factor, 3))
                              : fmt::format("bears 1/{} of", number(1 / factor, 3)));
  if (!one.apart.unit.empty()) text += fmt::format(", as if it had {}", one.apart.unit);
  return text + (one.apart.set_aside ? "; it was set aside." : "; it was kept.");
}

std::string in_words(const MeasuredPlatesFit& fit, std::size_t tests, const std::string& source) {
  Table values{"", {"value", "fit", "between tests", "between low and high pressures", "of readings"}};
  for (const auto& [p, value] : plate_values(fit)) {
    if (fit.one_size() && std::string_view(p.name) == "k_c") continue;
    const std::string symbol = fit.one_size() && std::string_view(p.name) == "k_phi" ? "k" : p.symbol;
    values.add({heading(symbol, p.unit), number(value.estimate, p.per_si), number(value.between_tests * p.per_si),
                number(value.between_pressures * p.per_si), number(value.between_readings * p.per_si)});
  }
  Table plates{"", {"b [mm]", "tests", "n of its own", "k at the common n [kN/m^(n+2)]"}};
  for (std::size_t k = 0; k < fit.radii.size(); ++k)
    plates.add({fmt::format("{:g}", 1000 * fit.radii[k]), std::to_string(fit.tests[k]), number(fit.plate_exponents[k]),
                number(fit.plate_moduli[k] / 1e3)});
  std::string aside = apart_in_words(fit) + aside_in_words(fit);
  if (fit.kept && !aside.empty())
    aside += fmt::format("With everything kept: n = {}, k_c = {} kN/m^(n+1), k_phi = {} kN/m^(n+2).\n",
                         number((*fit.kept)[0]), number((*fit.kept)[1] / 1e3), number((*fit.kept)[2] / 1e3));
  const std::string sizes = fit.one_size() ? "plates of one size" : fmt::format("plates of {} sizes", fit.radii.size());
  const std::string errors =
      fit.one_size()
          ? fmt::format(
                "k stands for k_c/b + k_phi at b = {:g} mm: one size of plate does not part the two. It is good "
                "for a wheel or plate of about this b.\n",
                1000 * fit.radii.front())
          : std::string("Those of k_c and k_phi hold at this n.\n");
  return fmt::format(
      "{} with {}, {:.2g} to {:.3g} kPa\n\n{}\n± is one standard error: the three columns beside it, squared and "
      "added.\n"
      "{}A file takes the values as independent, which makes pressures less sure than these tests are.\n\n{}\nb is a "
      "round plate's radius, a strip's width. Bekker's form misses the pressures by {} (root mean square, of the mean "
      "pressure).\n{}{}\n{}",
      counted(tests, "test"), sizes, fit.lowest / 1e3, fit.highest / 1e3, as_text(values), errors, as_text(plates),
      percent(fit.pressure_error), aside.empty() ? "" : "\n", aside, yaml_lines(fit, source));
}

Json to_json(const MeasuredPlatesFit& fit, std::size_t tests) {
  Json document = {{"format", "soilbin-plates/1"}, {"tests", tests}};
  for (const auto& [p, value] : plate_values(fit)) {
    document[p.name] = estimate_json(value.estimate);
    document[p.name]["between_tests"] = value.between_tests;
    document[p.name]["between_pressures"] = value.between_pressures;
    document[p.name]["between_readings"] = value.between_readings;
  }
  document["pressure_error"] = fit.pressure_error;
  document["test_scatter"] = fit.test_scatter;
  document["lowest_pressure"] = fit.lowest, document["highest_pressure"] = fit.highest;
  document["plates"] = Json::array();
  for (std::size_t k = 0; k < fit.radii.size(); ++k)
    document["plates"].push_back({{"radius", fit.radii[k]},
                                  {"tests", fit.tests[k]},
                                  {"exponent", fit.plate_exponents[k]},
                                  {"modulus", fit.plate_moduli[k]}});
  document["plate_sizes"] = fit.radii.size();
  if (fit.one_size()) {  // k_c and k_phi are not known by themselves
    document["modulus"] = document["k_phi"];
    document["modulus"]["radius"] = fit.radii.front();
    document["k_c"] = nullptr, document["k_phi"] = nullptr;
  }
  document["readings"] = fit.readings;
  document["set_aside"] = Json::array();
  for (const PlateReadingsAside& one : fit.aside) {
    Json aside = {{"test", one.test},
                  {"radius", one.radius},
                  {"why", word(one.readings.why)},
                  {"readings", one.readings.readings.size()},
                  {"lines", one.lines}};
    if (one.readings.unloading_stiffness) aside["unloading_stiffness"] = finite(*one.readings.unloading_stiffness);
    document["set_aside"].push_back(std::move(aside));
  }
  document["disagreeing_tests"] = Json::array();
  for (const PlateTestApart& one : fit.apart)
    document["disagreeing_tests"].push_back({{"test", one.test},
                                             {"radius", one.radius},
                                             {"first_line", one.first_line},
                                             {"last_line", one.last_line},
                                             {"factor", finite(one.apart.factor)},
                                             {"as_if", one.apart.unit},
                                             {"set_aside", one.apart.set_aside}});
  document["with_all_kept"] = nullptr;
  if (fit.kept)
    document["with_all_kept"] = {
        {"exponent", finite((*fit.kept)[0])}, {"k_c", finite((*fit.kept)[1])}, {"k_phi", finite((*fit.kept)[2])}};
  return document;
}

}  // namespace soilbin::compare
