#include "compare/fit/observations.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

#include "compare/measured/condition_views.hpp"
#include "compare/measured/within_run_scatter.hpp"
#include "scenario/unit.hpp"

namespace soilbin::compare {

Eigen::VectorXd Observations::values() const {
  Eigen::VectorXd y(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) y[i] = cells[i].value;
  return y;
}

int Observations::rerun_freedom() const { return static_cast<int>(rows.size()) - conditions; }

namespace {

/// What makes two unlabelled runs re-runs of one setpoint: every stated condition, to the digit.
auto fingerprint(const OperatingCondition& at) {
  return std::make_tuple(at.load, at.slip, at.speed, at.longitudinal_incline, at.transverse_incline, at.yaw, at.pass,
                         at.moisture.value_or(0.0), at.position.value_or(0.0), at.inflation_pressure.value_or(-1.0));
}

constexpr double widest_slip = 0.015;  // of a block

/// Whether two conditions may be one setpoint, read twice by instruments.
bool may_be_one(const OperatingCondition& a, const OperatingCondition& b) {
  constexpr double load_share = 0.05, slip = widest_slip, speed_share = 0.1, angle = 0.5 * degree, moisture = 0.005,
                   pressure_share = 0.05;
  const auto near = [](double x, double y, double within) { return std::abs(x - y) <= within; };
  return near(a.load, b.load, load_share * a.load) && near(a.slip, b.slip, slip) &&
         near(a.speed, b.speed, speed_share * std::abs(a.speed)) && a.pass == b.pass &&
         near(a.longitudinal_incline, b.longitudinal_incline, angle) &&
         near(a.transverse_incline, b.transverse_incline, angle) && near(a.yaw, b.yaw, angle) &&
         near(a.moisture.value_or(0.0), b.moisture.value_or(0.0), moisture) &&
         near(a.inflation_pressure.value_or(0.0), b.inflation_pressure.value_or(0.0),
              pressure_share * a.inflation_pressure.value_or(0.0));
}

/// Blocks begin with the condition of least slip that has none and take what is near that one. No chain of neighbours
/// makes a block, for a dense sweep would be a single one.
std::vector<int> blocks_of(const std::vector<OperatingCondition>& conditions, const std::vector<bool>& labelled) {
  std::vector<std::size_t> order(conditions.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t c) { return conditions[c].slip; });
  std::vector<int> block(conditions.size(), -1);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::size_t first = order[i];
    if (block[first] >= 0) continue;
    block[first] = static_cast<int>(first);
    if (labelled[first]) continue;
    for (std::size_t k = i + 1; k < order.size(); ++k) {
      const std::size_t other = order[k];
      if (conditions[other].slip - conditions[first].slip > widest_slip) break;
      if (block[other] < 0 && !labelled[other] && may_be_one(conditions[first], conditions[other]))
        block[other] = static_cast<int>(first);
    }
  }
  return block;
}

}  // namespace

int Observations::blocks() const { return static_cast<int>(std::set(block.begin(), block.end()).size()); }

int Observations::conditions_in_blocks() const {
  std::set<int> several, seen;
  for (const int b : block)
    if (!seen.insert(b).second) several.insert(b);
  return static_cast<int>(std::ranges::count_if(block, [&](int b) { return several.contains(b); }));
}

Observations observe(const Campaign& campaign) {
  std::array<double, channel_count> usual{};
  std::array<ToldBeside, channel_count> told{};
  for (int c = 0; c < channel_count; ++c) {
    told[c] = best_told(campaign.runs, c);
    usual[c] = usual_scatter(campaign.runs, c, told[c]).value_or(0.0);
  }
  Observations all;
  std::vector<OperatingCondition> conditions;
  std::vector<bool> labelled;
  std::map<std::string, int> by_label;
  std::map<decltype(fingerprint(std::declval<const OperatingCondition&>())), int> by_values;
  for (std::size_t i = 0; i < campaign.runs.size(); ++i) {
    const Run& run = campaign.runs[i];
    const int next = all.conditions;
    const int condition = run.setpoint ? by_label.emplace(*run.setpoint, next).first->second
                                       : by_values.emplace(fingerprint(run.at), next).first->second;
    if (condition == next) ++all.conditions, conditions.push_back(run.at), labelled.push_back(run.setpoint.has_value());
    const int row = static_cast<int>(all.rows.size());
    all.rows.push_back(run.at);
    all.condition.push_back(condition);
    all.source_row.push_back(static_cast<int>(i));
    for (int c = 0; c < channel_count; ++c)
      if (const auto& value = run.*channel_views[c].measured)
        all.cells.push_back({row, c, *value, (run.*told[c])[c].value_or(usual[c])});
  }
  all.block = blocks_of(conditions, labelled);
  return all;
}

Observations of_conditions(const Observations& all, const std::vector<bool>& keep) {
  Observations part;
  std::vector<int> renumbered(keep.size(), -1), new_row(all.rows.size(), -1);
  for (std::size_t c = 0; c < keep.size(); ++c)
    if (keep[c]) renumbered[c] = part.conditions++, part.block.push_back(all.block[c]);
  for (std::size_t i = 0; i < all.rows.size(); ++i) {
    const int condition = renumbered[all.condition[i]];
    if (condition < 0) continue;
    new_row[i] = static_cast<int>(part.rows.size());
    part.rows.push_back(all.rows[i]);
    part.condition.push_back(condition);
    part.source_row.push_back(all.source_row[i]);
  }
  for (const Cell& cell : all.cells)
    if (const int row = new_row[cell.row]; row >= 0) part.cells.push_back({row, cell.channel, cell.value, cell.spread});
  return part;
}

Observations without_cells(const Observations& all, const std::vector<bool>& drop) {
  Observations part = all;
  part.cells.clear();
  for (std::size_t i = 0; i < all.cells.size(); ++i)
    if (!drop[i]) part.cells.push_back(all.cells[i]);
  return part;
}

std::vector<Covariate> covariates(const Observations& observations) {
  std::vector<Covariate> varying;
  for (const ConditionView& view : condition_views) {
    Eigen::VectorXd values(observations.rows.size());
    for (Eigen::Index i = 0; i < values.size(); ++i) values[i] = view.get(observations.rows[i]);
    if (values.size() == 0 || !values.allFinite()) continue;
    const double spread = values.maxCoeff() - values.minCoeff();
    const bool counted = view.name == "run" || view.name == "position";  // from an origin that says nothing
    const double scale = counted ? 0.0 : values.cwiseAbs().maxCoeff();
    if (spread > 1e-3 * scale) varying.push_back({std::string(view.name), std::move(values)});
  }
  return varying;
}

std::vector<Eigen::Index> cells_in_order_of_runs(const Observations& observations) {
  std::vector<Eigen::Index> order(observations.cells.size());
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  if (std::ranges::all_of(observations.rows, [](const OperatingCondition& at) { return at.run.has_value(); }))
    std::ranges::stable_sort(order, {},
                             [&](Eigen::Index i) { return *observations.rows[observations.cells[i].row].run; });
  return order;
}

}  // namespace soilbin::compare
