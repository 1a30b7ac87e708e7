#include "compare/fit/pooled_runs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <queue>

#include "compare/measured/condition_views.hpp"

namespace soilbin::compare {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Rows that lie together, and the variable in which they scatter most.
struct RunGroup {
  std::vector<int> rows;
  std::size_t variable = 0;
  double middle = 0.0;   ///< mean of that variable
  double scatter = 0.0;  ///< sum of squares about it [sd of the campaign squared]
};

RunGroup run_group(std::vector<int> rows, const std::vector<VectorXd>& variables) {
  RunGroup group{.rows = std::move(rows)};
  const double n = static_cast<double>(group.rows.size());
  for (std::size_t v = 0; v < variables.size(); ++v) {
    double mean = 0.0, scatter = 0.0;
    for (const int row : group.rows) mean += variables[v][row] / n;
    for (const int row : group.rows) scatter += std::pow(variables[v][row] - mean, 2);
    if (scatter > group.scatter) group.variable = v, group.middle = mean, group.scatter = scatter;
  }
  return group;
}

std::vector<VectorXd> standardised_covariates(const std::vector<Covariate>& covariates) {
  std::vector<VectorXd> all;
  for (const Covariate& c : covariates) {
    const VectorXd centred = c.values.array() - c.values.mean();
    all.push_back(centred / std::sqrt(centred.squaredNorm() / static_cast<double>(centred.size())));
  }
  return all;
}

/// The mean condition of some rows.
OperatingCondition mean_condition(const Observations& observations, const std::vector<int>& rows,
                                  const std::vector<Covariate>& varying) {
  OperatingCondition at = observations.rows[rows.front()];
  for (const Covariate& c : varying) {
    double mean = 0.0;
    for (const int row : rows) mean += c.values[row] / static_cast<double>(rows.size());
    condition_view(c.name).set(at, mean);
  }
  return at;
}

/// Which cells of all runs each cell of the pooled ones is the mean of.
using CellMembers = std::vector<std::vector<Index>>;

/// One row a group, in the order of the groups; its cells' values are still to be set.
Observations one_row_a_group(const Observations& all, const std::vector<std::vector<int>>& groups,
                             CellMembers& members) {
  const std::vector<Covariate> varying = covariates(all);
  std::vector<std::array<std::vector<Index>, channel_count>> cells(groups.size());
  std::vector<int> group_of_row(all.rows.size());
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (const int row : groups[g]) group_of_row[row] = static_cast<int>(g);
  for (std::size_t i = 0; i < all.cells.size(); ++i)
    cells[group_of_row[all.cells[i].row]][all.cells[i].channel].push_back(static_cast<Index>(i));
  Observations pooled;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const int row = static_cast<int>(g);
    pooled.rows.push_back(mean_condition(all, groups[g], varying));
    pooled.block.push_back(pooled.conditions);
    pooled.condition.push_back(pooled.conditions++);
    pooled.source_row.push_back(all.source_row[groups[g].front()]);
    for (int channel = 0; channel < channel_count; ++channel)
      if (!cells[g][channel].empty()) {
        pooled.cells.push_back({row, channel, 0.0});
        members.push_back(std::move(cells[g][channel]));
      }
  }
  return pooled;
}

/// The mean over each pooled cell's members, column by column.
MatrixXd means_of_members(const MatrixXd& of_cells, const CellMembers& members) {
  MatrixXd mean(members.size(), of_cells.cols());
  for (Index i = 0; i < mean.rows(); ++i) mean.row(i) = of_cells(members[i], Eigen::all).colwise().mean();
  return mean;
}

}  // namespace

std::vector<std::vector<int>> near_rows(const Observations& observations, int most_groups) {
  const std::vector<VectorXd> variables = standardised_covariates(covariates(observations));
  std::map<int, std::vector<int>> by_pass;
  for (std::size_t row = 0; row < observations.rows.size(); ++row)
    by_pass[observations.rows[row].pass].push_back(static_cast<int>(row));
  const auto narrower = [](const RunGroup& a, const RunGroup& b) { return a.scatter < b.scatter; };
  std::priority_queue<RunGroup, std::vector<RunGroup>, decltype(narrower)> open(narrower);
  for (auto& [pass, rows] : by_pass) open.push(run_group(std::move(rows), variables));
  while (static_cast<int>(open.size()) < most_groups && open.top().scatter > 0.0) {
    const RunGroup widest = open.top();
    open.pop();
    std::vector<int> below, above;
    for (const int row : widest.rows) (variables[widest.variable][row] < widest.middle ? below : above).push_back(row);
    if (below.empty() || above.empty()) break;  // alike to the last digit
    open.push(run_group(std::move(below), variables)), open.push(run_group(std::move(above), variables));
  }
  std::vector<std::vector<int>> groups;
  for (; !open.empty(); open.pop()) groups.push_back(open.top().rows);
  std::ranges::sort(groups);
  return groups;
}

std::optional<FittedModel> pooled(const FittedModel& base, int most_rows) {
  const Dataset& all = base.data();
  CellMembers members;
  Observations runs = one_row_a_group(all.observations, near_rows(all.observations, most_rows), members);
  VectorXd predicted;
  BalanceMemory memory = giving_way();
  if (!base.predictor().over(runs).predict(base.fit().theta, predicted, memory)) return std::nullopt;
  const VectorXd values = predicted + means_of_members(all.observations.values() - base.fit().prediction, members);
  VectorXd counts(values.size());
  for (Index i = 0; i < values.size(); ++i) {
    runs.cells[i].value = values[i];
    counts[i] = static_cast<double>(members[i].size());
    double squares = 0.0;
    for (const Index member : members[i]) squares += std::pow(all.observations.cells[member].spread, 2);
    runs.cells[i].spread = std::sqrt(squares / counts[i]);
  }
  Whitening whitening(runs, all.noise, predicted, counts);
  if (const MatrixXd term = all.whitening.term(); term.size() > 0)
    whitening = whitening.beside(whitening(means_of_members(term, members)));
  Dataset few{all.campaign, std::move(runs), {}, all.noise, std::move(whitening), {}};
  const VectorXd left = few.whitening(VectorXd(values - predicted));
  few.within_pools = {.cells = static_cast<double>(all.cells() - few.cells()),
                      .chi2 = std::max(0.0, base.fit().chi2_cells - left.squaredNorm())};
  const auto shared = std::make_shared<const Dataset>(std::move(few));
  return fitted(shared, base.predictor().over(shared->observations), base.fit().restart);
}

}  // namespace soilbin::compare
