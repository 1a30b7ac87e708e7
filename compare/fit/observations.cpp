#include "compare/fit/observations.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>

#include "compare/measured/condition_views.hpp"
#include "compare/measured/within_run_scatter.hpp"

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
                         at.moisture.value_or(0.0), at.position.value_or(0.0));
}

}  // namespace

Observations observe(const Campaign& campaign) {
  std::array<double, channel_count> usual{};
  for (int c = 0; c < channel_count; ++c) usual[c] = usual_scatter(campaign.runs, c).value_or(0.0);
  Observations all;
  std::map<std::string, int> by_label;
  std::map<decltype(fingerprint(std::declval<const OperatingCondition&>())), int> by_values;
  for (std::size_t i = 0; i < campaign.runs.size(); ++i) {
    const Run& run = campaign.runs[i];
    const int next = all.conditions;
    const int condition = run.setpoint ? by_label.emplace(*run.setpoint, next).first->second
                                       : by_values.emplace(fingerprint(run.at), next).first->second;
    if (condition == next) ++all.conditions;
    const int row = static_cast<int>(all.rows.size());
    all.rows.push_back(run.at);
    all.condition.push_back(condition);
    all.source_row.push_back(static_cast<int>(i));
    for (int c = 0; c < channel_count; ++c)
      if (const auto& value = run.*channel_views[c].measured)
        all.cells.push_back({row, c, *value, run.within_run_sd[c].value_or(usual[c])});
  }
  return all;
}

Observations of_conditions(const Observations& all, const std::vector<bool>& keep) {
  Observations part;
  std::vector<int> renumbered(keep.size(), -1), new_row(all.rows.size(), -1);
  for (std::size_t c = 0; c < keep.size(); ++c)
    if (keep[c]) renumbered[c] = part.conditions++;
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
