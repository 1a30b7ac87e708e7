#include "compare/loop/rig_limits.hpp"

#include <algorithm>

#include "compare/loop/thresholds.hpp"
#include "compare/measured/condition_views.hpp"

namespace soilbin::compare {

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
