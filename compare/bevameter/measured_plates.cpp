#include "compare/bevameter/measured_plates.hpp"

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bekker_wong/gsl.hpp"
#include "compare/bevameter/bevameter.hpp"
#include "compare/measured/outliers.hpp"
#include "compare/report/number_text.hpp"
#include "resistive_force/response.hpp"
#include "scenario/errors.hpp"
#include "scenario/soil_parameters.hpp"

namespace soilbin::compare {
namespace {

/// What ln k of re-tests scatters [-], and as how many degrees of freedom that counts; the slope of ln k over ln b [-].
/// Chosen: five and three re-tests of GRC-1 and of the CMU sand scatter by 2 to 25 %; k grows with b there by b^1.2.
constexpr double usual_scatter = 0.15, usual_freedom = 4.0, usual_slope = 1.0;

/// Sums over tests, to leave one out without summing anew. x = ln b about its mean, y = ln k.
struct LevelSums {
  double count = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
  void add(double at, double value, double sign) {
    count += sign, x += sign * at, y += sign * value;
    xx += sign * at * at, xy += sign * at * value, yy += sign * value * value;
  }
};

struct ExpectedLevel {
  double residual = 0.0;  ///< ln of the factor
  double chance = 1.0;    ///< that noise puts it as far off
};

/// A test against the others: a mean and a slope that is 0 +- usual_slope.
ExpectedLevel held_against(const LevelSums& others, double at, double value) {
  constexpr double ridge = usual_scatter * usual_scatter / (usual_slope * usual_slope);
  const double mean_x = others.x / others.count, mean_y = others.y / others.count,
               xx = others.xx - others.count * mean_x * mean_x + ridge, xy = others.xy - others.count * mean_x * mean_y,
               yy = others.yy - others.count * mean_y * mean_y;
  const double slope = xy / xx, left = std::max(0.0, yy - slope * xy), freedom = usual_freedom + others.count - 1;
  const double variance = (usual_freedom * usual_scatter * usual_scatter + left) / freedom;
  const double residual = value - mean_y - slope * (at - mean_x),
               off = variance * (1 + 1 / others.count + (at - mean_x) * (at - mean_x) / xx);
  return {residual, gsl::f_tail(residual * residual / off, 1, freedom)};
}

/// A unit in place of another that makes this factor of the pressures at one sinkage; sinkages count to the power n.
std::string mistaken_unit(double factor, double n) {
  struct Mistake {
    double ratio;  ///< of what the number should be to what it is
    const char* words;
  };
  constexpr double near = 0.2;  // of the logarithm
  constexpr Mistake sinkages[] = {{10, "its sinkage in cm for mm, or m for dm"},
                                  {25.4, "its sinkage in inches for mm"},
                                  {100, "its sinkage in m for cm"},
                                  {1000, "its sinkage in m for mm"},
                                  {0.1, "its sinkage in mm for cm"},
                                  {0.01, "its sinkage in cm for m"},
                                  {0.001, "its sinkage in mm for m"},
                                  {1 / 25.4, "its sinkage in mm for inches"}};
  constexpr Mistake pressures[] = {
      {1000, "its pressure in MPa for kPa"},     {0.001, "its pressure in kPa for MPa"},
      {100, "its pressure in bar for kPa"},      {0.01, "its pressure in kPa for bar"},
      {6.894757, "its pressure in psi for kPa"}, {1 / 6.894757, "its pressure in kPa for psi"}};
  std::string words;
  const auto add = [&](const char* more) { words += (words.empty() ? "" : "; or ") + std::string(more); };
  for (const Mistake& m : sinkages)  // a sinkage told too small by this ratio bears more at what is told
    if (std::abs(std::log(factor) / n - std::log(m.ratio)) < near) add(m.words);
  for (const Mistake& m : pressures)  // and a pressure told too small by it, less
    if (std::abs(std::log(factor) + std::log(m.ratio)) < near) add(m.words);
  return words;
}

}  // namespace

std::vector<TestApart> tests_apart(std::span<const TestLevel> tests, double n) {
  std::vector<TestApart> apart;
  if (tests.size() < 2) return apart;
  const double middle = std::log(tests.front().radius);
  LevelSums sums;
  std::vector<std::size_t> left;
  for (std::size_t i = 0; i < tests.size(); ++i) {
    sums.add(std::log(tests[i].radius) - middle, tests[i].ln_modulus, 1.0);
    left.push_back(i);
  }
  const std::size_t most_aside = tests.size() == 3 ? 1 : tests.size() / 4;
  for (std::size_t aside = 0; left.size() > 1;) {
    std::vector<double> chances;
    std::vector<ExpectedLevel> expected;
    for (const std::size_t i : left) {
      const double at = std::log(tests[i].radius) - middle;
      LevelSums others = sums;
      others.add(at, tests[i].ln_modulus, -1.0);
      expected.push_back(held_against(others, at, tests[i].ln_modulus));
      chances.push_back(expected.back().chance);
    }
    const auto least = static_cast<std::size_t>(std::ranges::min_element(chances) - chances.begin());
    const bool told = chances[least] < thresholds::outlier_level, out = outliers(chances)[least] && aside < most_aside;
    if (!told) break;
    const double factor = std::exp(expected[least].residual);
    apart.push_back({left[least], factor, out, mistaken_unit(factor, n)});
    if (!out) break;
    sums.add(std::log(tests[left[least]].radius) - middle, tests[left[least]].ln_modulus, -1.0);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(least));
    ++aside;
  }
  return apart;
}

namespace {

using bekker_wong::PlateCurve;
using bekker_wong::PlateSums;

/// Sums over each curve's lower or upper half of pressures, where that half has an exponent.
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

/// What ln k of one plate's re-tests scatters [-], and their n [-], and as how many degrees of freedom that counts
/// beside their own. Chosen: on five beds of GRC-1, the CMU sand and the Cullinan sand ln k scatters by 0.03, 0.04,
/// 0.07, 0.07 and 0.15, n mostly by 0.07 to 0.13 (docs/lab/plates.md).
constexpr double usual_modulus_scatter = 0.08, usual_exponent_scatter = 0.1, usual_scatter_freedom = 2.0;

/// What each of plate_numbers changes where a test's n changes by 1, or its ln k: the test's share in the common n, and
/// in the line of moduli over 1/b (fit_plates_at).
std::array<std::vector<double>, 3> shares_of_tests(const std::vector<PlateSums>& curves, double n) {
  double zz = 0.0, sum_u = 0.0, sum_uu = 0.0;
  for (const PlateSums& m : curves) zz += m.zz, sum_u += 1 / m.radius, sum_uu += 1 / (m.radius * m.radius);
  const auto tests = static_cast<double>(curves.size());
  const double spread = tests * sum_uu - sum_u * sum_u;
  std::array<std::vector<double>, 3> shares;
  for (const PlateSums& m : curves) {
    const double in_k_c = spread > 1e-9 * sum_uu ? (tests / m.radius - sum_u) / spread : 0.0;
    shares[0].push_back(m.zz / zz);
    shares[1].push_back(in_k_c * m.modulus(n));
    shares[2].push_back((1 - in_k_c * sum_u) / tests * m.modulus(n));
  }
  return shares;
}

/// Standard errors by what re-tests scatter: n, and k at the n of all by one share whatever the size of the plate,
/// about the means of their sizes. Few tests tell their scatter badly, and one not at all: beside it stands, as much as
/// a few more tests would tell, what re-tests scatter elsewhere (a moderated t: Smyth 2004, Stat. Appl. Genet. Mol.
/// Biol. 3:3). One more test of each of the sizes scatters by it, and so do the means of m tests about the truth by 1/m
/// of its square; both are wrong.
std::array<double, 3> errors_between_tests(const std::vector<PlateSums>& curves, const MeasuredPlatesFit& fit,
                                           double n) {
  const auto of_own = static_cast<double>(curves.size() - fit.radii.size()), freedom = of_own + usual_scatter_freedom;
  const auto moderated = [&](double scatter, double usual) {
    return (of_own * scatter * scatter + usual_scatter_freedom * usual * usual) / freedom;
  };
  const double of_modulus = moderated(fit.test_scatter, usual_modulus_scatter);
  const std::array<double, 3> of_a_test = {moderated(fit.exponent_scatter, usual_exponent_scatter), of_modulus,
                                           of_modulus};
  const std::array<std::vector<double>, 3> shares = shares_of_tests(curves, n);
  std::array<double, 3> errors{};
  for (std::size_t v = 0; v < errors.size(); ++v) {
    for (std::size_t i = 0; i < curves.size(); ++i) {
      const auto size = std::ranges::find(fit.radii, curves[i].radius) - fit.radii.begin();
      const double m = fit.tests[static_cast<std::size_t>(size)];
      errors[v] += (1 + m) * shares[v][i] * shares[v][i] * of_a_test[v];
    }
    errors[v] = std::sqrt(errors[v]) * gsl::student_factor(freedom);
  }
  return errors;
}

/// Standard errors of plate_numbers by least squares, n and the moduli fitted together: what readings scatter about the
/// curves of n and each test's k. Of the moduli where the pressure at the reference sinkage doesn't change with n.
std::array<double, 3> errors_of_readings(const std::vector<PlateSums>& curves, std::size_t readings, double n) {
  double squares = 0.0, zz = 0.0;
  for (const PlateSums& m : curves) squares += std::max(0.0, m.pp - 2 * n * m.zp + n * n * m.zz), zz += m.zz;
  const double variance = squares / std::max(1.0, static_cast<double>(readings - curves.size()) - 1);
  const std::array<std::vector<double>, 3> shares = shares_of_tests(curves, n);
  const double ln_reference = std::log(bekker_wong::reference_sinkage(curves));
  double k_c = 0.0, k_phi = 0.0, k_c_by_n = 0.0, k_phi_by_n = 0.0;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const double of_ln_k = variance / curves[i].weight, by_n = ln_reference - curves[i].ln_z;
    k_c += shares[1][i] * shares[1][i] * of_ln_k, k_phi += shares[2][i] * shares[2][i] * of_ln_k;
    k_c_by_n += shares[1][i] * by_n, k_phi_by_n += shares[2][i] * by_n;
  }
  const double of_n = std::sqrt(variance / zz);
  return {of_n, std::hypot(std::sqrt(k_c), k_c_by_n * of_n), std::hypot(std::sqrt(k_phi), k_phi_by_n * of_n)};
}

PlateValue value_of(double value, double tests, double pressures, double readings) {
  return {.estimate = {value, std::hypot(tests, pressures, readings)},
          .between_tests = tests,
          .between_pressures = pressures,
          .between_readings = readings};
}

void add_misfit(const std::vector<PlateCurve>& curves, MeasuredPlatesFit& fit) {
  double squares = 0.0, sum = 0.0, count = 0.0;
  fit.lowest = std::numeric_limits<double>::infinity();
  for (const PlateCurve& curve : curves)
    for (std::size_t i = 0; i < curve.pressure.size(); ++i) {
      const double p = curve.pressure[i], miss = p - bekkers_form(fit, curve.radius, curve.sinkage[i]);
      squares += miss * miss, sum += p, count += 1.0;
      fit.lowest = std::min(fit.lowest, p), fit.highest = std::max(fit.highest, p);
    }
  fit.pressure_error = std::sqrt(squares / count) / (sum / count);
}

/// Number of tests, own exponent and modulus of each size of plate, and how its tests scatter.
void add_plates(const std::vector<PlateSums>& curves, double n, MeasuredPlatesFit& fit) {
  double squares = 0.0, squares_of_n = 0.0;
  for (const double radius : fit.radii) {
    double exponent = 0.0, modulus = 0.0, sum = 0.0, sum_of_squares = 0.0, sum_of_n_squares = 0.0;
    int count = 0;
    for (const PlateSums& curve : curves) {
      if (curve.radius != radius) continue;
      const double ln = std::log(curve.modulus(n));
      exponent += curve.exponent(), modulus += curve.modulus(n), sum += ln, sum_of_squares += ln * ln, ++count;
      sum_of_n_squares += curve.exponent() * curve.exponent();
    }
    squares += std::max(0.0, sum_of_squares - sum * sum / count);
    squares_of_n += std::max(0.0, sum_of_n_squares - exponent * exponent / count);
    fit.plate_exponents.push_back(exponent / count);
    fit.plate_moduli.push_back(modulus / count);
    fit.tests.push_back(count);
  }
  const std::size_t freedom = curves.size() - fit.radii.size();
  fit.test_scatter = freedom > 0 ? std::sqrt(squares / static_cast<double>(freedom)) : 0.0;
  fit.exponent_scatter = freedom > 0 ? std::sqrt(squares_of_n / static_cast<double>(freedom)) : 0.0;
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
      "{} of the plate of b = {:g} mm has {} with a pressure and a sinkage above 0{}{}; {} are needed\n  hint: {}",
      test_in_words(plate.test), 1000 * plate.curve.radius, counted(used.pressure.size(), "reading"),
      enough && !on_curve ? " on its loading curve" : "", on_curve ? " in the window" : "", fewest_readings,
      on_curve ? "widen --pressure"
      : enough ? "the others are spikes, unloading, or constant sinkage under rising pressure: is a sensor "
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

PlateCurve readings_of(const PlateCurve& curve, const std::vector<std::size_t>& places) {
  PlateCurve kept{.radius = curve.radius, .pressure = {}, .sinkage = {}};
  for (const std::size_t i : places)
    kept.pressure.push_back(curve.pressure[i]), kept.sinkage.push_back(curve.sinkage[i]);
  return kept;
}

PlateCurve within(const PlateCurve& curve, const PressureWindow& window) {
  PlateCurve kept{.radius = curve.radius, .pressure = {}, .sinkage = {}};
  for (std::size_t i = 0; i < curve.pressure.size(); ++i)
    if (curve.pressure[i] >= window.first && curve.pressure[i] <= window.last)
      kept.pressure.push_back(curve.pressure[i]), kept.sinkage.push_back(curve.sinkage[i]);
  return kept;
}

double bekkers_form(const MeasuredPlatesFit& fit, double radius, double sinkage) {
  return (fit.k_c.estimate.value / radius + fit.k_phi.estimate.value) * std::pow(sinkage, fit.exponent.estimate.value);
}

std::size_t MeasuredPlatesFit::readings_aside() const {
  std::size_t count = 0;
  for (const PlateReadingsAside& one : aside) count += one.readings.readings.size();
  return count;
}

namespace {

/// Fills xi_n: its scatter is that between tests of all sizes, since the theory makes no difference between them.
void add_xi_n(const std::vector<PlateCurve>& curves, MeasuredPlatesFit& fit) {
  const double n = static_cast<double>(curves.size()), response = resistive_force::plate_response();
  double lower = 0.0, upper = 0.0, missed = 0.0, pressure = 0.0;
  std::vector<double> of_tests;
  for (const PlateCurve& curve : curves) {
    of_tests.push_back(xi_n_of(curve));
    PlateCurve low{curve.radius, {}, {}}, high = low;
    const double half = *std::ranges::max_element(curve.pressure) / 2;
    for (std::size_t i = 0; i < curve.pressure.size(); ++i) {
      PlateCurve& to = curve.pressure[i] < half ? low : high;
      to.sinkage.push_back(curve.sinkage[i]), to.pressure.push_back(curve.pressure[i]);
    }
    lower += xi_n_of(low.pressure.empty() ? curve : low) / n;
    upper += xi_n_of(high) / n;
  }
  const double mean = mean_of(of_tests).value;
  for (const PlateCurve& curve : curves)
    for (std::size_t i = 0; i < curve.pressure.size(); ++i) {
      const double off = curve.pressure[i] - response * mean * curve.sinkage[i];
      missed += off * off, pressure += curve.pressure[i];
    }
  const double readings = static_cast<double>(fit.readings);
  fit.xi_n_pressure_error = std::sqrt(missed / readings) / (pressure / readings);
  fit.xi_n.between_tests = spread_of(of_tests);
  fit.xi_n.between_pressures = std::abs(upper - lower) / 2;
  fit.xi_n.estimate = {mean, std::hypot(fit.xi_n.between_tests, fit.xi_n.between_pressures)};
}

}  // namespace

MeasuredPlatesFit fit_measured_plates(std::span<const MeasuredPlate> plates, const PressureWindow& window) {
  if (plates.empty()) throw InputError("no plate tests to fit");
  MeasuredPlatesFit fit;
  std::vector<PlateCurve> curves;
  for (const MeasuredPlate& plate : plates) curves.push_back(used_of(plate, window, fit));
  std::vector<PlateSums> sums = all_sums(curves);
  take_tests_apart(plates, curves, sums, fit);
  fit.radii = radii_of(sums);
  fit.reference_sinkage = bekker_wong::reference_sinkage(sums);
  const double n = bekker_wong::exponent_of(sums, bekker_wong::PlateExponent::common);
  add_plates(sums, n, fit);
  const std::vector<PlateSums> low = half_of(curves, true), high = half_of(curves, false);
  fit.halves_compared = radii_of(low) == fit.radii && radii_of(high) == fit.radii;
  const PlateNumbers all = numbers_of(sums, n), lower = fit.halves_compared ? numbers_of(low, n) : all,
                     upper = fit.halves_compared ? numbers_of(high, n) : all;
  fit.low_exponent = lower.exponent, fit.high_exponent = upper.exponent;
  for (const PlateCurve& curve : curves) {
    fit.readings += curve.pressure.size();
    const double deepest = *std::ranges::max_element(curve.sinkage);
    if (deepest * fit.deepest_radius >= fit.deepest * curve.radius)
      fit.deepest = deepest, fit.deepest_radius = curve.radius;
  }
  const std::array<double, 3> tests = errors_between_tests(sums, fit, n);
  const std::array<double, 3> readings = errors_of_readings(sums, fit.readings, n);
  const std::array<PlateValue*, 3> values = {&fit.exponent, &fit.k_c, &fit.k_phi};
  for (std::size_t v = 0; v < values.size(); ++v) {
    double PlateNumbers::*value = plate_numbers[v];
    *values[v] = value_of(all.*value, tests[v], std::abs(upper.*value - lower.*value) / 2, readings[v]);
  }
  add_misfit(curves, fit);
  add_xi_n(curves, fit);
  for (const PlateValue* value : values)
    if (!std::isfinite(value->estimate.value) || !std::isfinite(value->estimate.std_error))
      throw InputError(
          "these readings give no finite n, k_c and k_phi\n  hint: look at them with --plot; do pressures and sinkages "
          "grow together?");
  if (!fit.aside.empty() || std::ranges::any_of(fit.apart, [](const auto& one) { return one.apart.set_aside; }))
    fit.kept = with_all_kept(plates, window);
  return fit;
}

std::string in_words(const PlateTestApart& one) {
  const double factor = one.apart.factor;
  std::string text = fmt::format(
      "{} of the plate of b = {:g} mm{} {} what the other tests predict at the same sinkage", test_in_words(one.test),
      1000 * one.radius, one.first_line > 0 ? fmt::format(" (lines {} to {})", one.first_line, one.last_line) : "",
      factor >= 1 ? fmt::format("bears {} times", number(factor, 3))
                  : fmt::format("bears 1/{} of", number(1 / factor, 3)));
  if (!one.apart.unit.empty()) text += fmt::format(", as if it had {}", one.apart.unit);
  return text + (one.apart.set_aside ? "; it was set aside." : "; it was kept.");
}

}  // namespace soilbin::compare
