#include "compare/bevameter/test_agreement.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "bekker_wong/gsl.hpp"
#include "compare/measured/outliers.hpp"

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

}  // namespace soilbin::compare
