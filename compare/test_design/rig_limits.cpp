#include "compare/test_design/rig_limits.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>

#include "compare/fit/thresholds.hpp"
#include "compare/report/number_text.hpp"

namespace soilbin::compare {
namespace {

/// Standard deviation of a condition among re-runs of one setpoint; 0 where there are none, or where it was set to the
/// digit.
double rerun_scatter(const ConditionView& view, const Observations& observations) {
  std::map<int, std::vector<double>> by_setpoint;
  for (std::size_t i = 0; i < observations.rows.size(); ++i)
    by_setpoint[observations.condition[i]].push_back(view.get(observations.rows[i]));
  double squares = 0.0;
  std::size_t freedom = 0;
  for (const auto& [setpoint, values] : by_setpoint) {
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    for (const double x : values) squares += (x - mean) * (x - mean);
    freedom += values.size() - 1;
  }
  return freedom > 0 && std::isfinite(squares) ? std::sqrt(squares / static_cast<double>(freedom)) : 0.0;
}

/// The number from low to high with the fewest digits in a unit; the one nearest to the middle where there are more;
/// nothing where they are so near that none of a few digits lies between.
std::optional<double> roundest(double low, double high, double per_si) {
  const double middle = per_si * (low + high) / 2, room = per_si * (high - low) / 2;
  const double slack = 1e-9 * std::max(std::abs(middle), room);
  if (std::abs(middle) <= room + slack) return 0.0;
  constexpr int digits = 4;  // of a number that was set exactly
  const int power = static_cast<int>(std::floor(std::log10(std::abs(middle)))) + 1;
  for (int p = power; p > power - digits; --p)
    for (const double share : {1.0, 0.5, 0.2}) {
      const double step = share * std::pow(10.0, p), number = step * std::round(middle / step);
      if (number != 0.0 && std::abs(number - middle) <= room + slack) return number / per_si;
    }
  return std::nullopt;
}

}  // namespace

Limits ranges_of(const Observations& observations) {
  Limits ranges;
  for (const Covariate& c : covariates(observations))
    if (c.name != "run") ranges[c.name] = {c.values.minCoeff(), c.values.maxCoeff()};
  return ranges;
}

Limits limits_of(const Observations& observations) {
  Limits limits = ranges_of(observations);
  auto& slip = limits.try_emplace("slip", 0.0, 0.0).first->second;
  slip = {std::min(slip.first, thresholds::lowest_slip), std::max(slip.second, thresholds::highest_slip)};
  if (observations.rows.empty()) return limits;
  const double load = observations.rows.front().load;
  auto& loads = limits.try_emplace("load", load, load).first->second;
  loads = {thresholds::lowest_load_share * loads.first, thresholds::highest_load_share * loads.second};
  return limits;
}

Limits limits_of(const Observations& observations, const Tire& wheel) {
  Limits limits = limits_of(observations);
  if (const double declared = wheel.inflation_pressure.value_or(0.0); declared > 0.0)
    limits.try_emplace("inflation_pressure", thresholds::lowest_pressure_share * declared,
                       thresholds::highest_pressure_share * declared);
  return limits;
}

double three_digits(double value) {
  if (value == 0.0) return 0.0;
  const double step = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 2);
  return step * std::round(value / step);
}

std::pair<std::string, double> own_unit(const std::map<std::string, DataColumn>& columns, const ConditionView& view) {
  const auto own = columns.find(std::string(view.name));
  if (own == columns.end() || own->second.unit == view.column_unit) return {std::string(view.unit), view.per_si};
  return {own->second.unit, per_unit(own->second.unit)};
}

double rig_setting(const ConditionView& view, double value, const Observations& observations,
                   const std::pair<double, double>& within, double per_si) {
  constexpr double run_share = 0.01, most_of_one_setting = 8, set_exactly = 1e-9;
  constexpr double value_share = 0.02, most_scatter_share = 0.1;  // of a quantity that is positive in every run
  std::vector<double> made;
  for (const OperatingCondition& at : observations.rows)
    if (const double x = view.get(at); std::isfinite(x)) made.push_back(x);
  if (view.whole) return value;
  if (made.empty()) {
    const double room = value_share * std::abs(value);
    const auto round = roundest(std::max(value - room, within.first), std::min(value + room, within.second), per_si);
    return round ? *round : value;
  }
  std::ranges::sort(made);
  double scatter = rerun_scatter(view, observations), spread = run_share * (made.back() - made.front());
  if (scatter <= set_exactly * std::max(std::abs(made.front()), std::abs(made.back()))) scatter = 0.0;
  if (made.front() > 0.0) {
    scatter = std::min(scatter, most_scatter_share * std::abs(value));
    spread = std::min(spread, value_share * std::abs(value));
  }
  std::pair<double, double> near = {value, value};
  const auto nearest =
      std::ranges::min_element(made, [&](double a, double b) { return std::abs(a - value) < std::abs(b - value); });
  const bool as_made = std::abs(*nearest - value) <= std::max(2 * scatter, set_exactly * std::abs(value));
  if (as_made) {
    auto low = nearest, high = nearest;
    while (low != made.begin() && *low - *std::prev(low) <= 2 * scatter) --low;
    while (std::next(high) != made.end() && *std::next(high) - *high <= 2 * scatter) ++high;
    near = *high - *low <= most_of_one_setting * scatter ? std::pair(*low, *high) : std::pair(*nearest, *nearest);
  }
  const bool alone = near.first == near.second;
  const double room = as_made && scatter == 0.0 ? 0.0
                      : alone                   ? std::max(scatter, spread)
                                                : std::min(scatter, (near.second - near.first) / 3);
  const auto reachable = [&](double x) { return std::clamp(x, within.first, within.second); };
  const auto round = roundest(reachable(near.first - room), reachable(near.second + room), per_si);
  return round ? *round : reachable(three_digits(per_si * (near.first + near.second) / 2) / per_si);
}

std::vector<double> evenly(const std::pair<double, double>& range, int levels) {
  std::vector<double> values;
  for (int k = 0; k < levels; ++k) {
    const double share = levels > 1 ? static_cast<double>(k) / (levels - 1) : 0.5;
    values.push_back(range.first + share * (range.second - range.first));
  }
  return values;
}

std::vector<OperatingCondition> combinations(const OperatingCondition& centre, const std::vector<Levels>& levels) {
  std::vector<OperatingCondition> points = {centre};
  for (const auto& [name, values] : levels) {
    std::vector<OperatingCondition> more;
    for (const OperatingCondition& p : points)
      for (const double value : values) {
        more.push_back(p);
        condition_view(name).set(more.back(), value);
      }
    points = std::move(more);
  }
  return points;
}

}  // namespace soilbin::compare
