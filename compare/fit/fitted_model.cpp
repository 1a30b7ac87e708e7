#include "compare/fit/fitted_model.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <queue>

#include "compare/fit/evidence.hpp"
#include "compare/measured/condition_views.hpp"
#include "scenario/soil_parameters.hpp"

namespace soilbin::compare {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// Added to the Gram matrix of a fit's columns (each in units of its scale), for a column that the data do not see at
// all. A forecast is the bolder of the two: there such a parameter may move what the fit has never seen.
constexpr double ridge_of_errors = 1e-12, ridge_of_forecasts = 1e-9;

}  // namespace

FittedModel::FittedModel(std::shared_ptr<const Dataset> data, WheelPredictor predictor, Fit fit)
    : data_(std::move(data)), predictor_(std::move(predictor)), fit_(std::move(fit)) {}

Ldlt FittedModel::information(double ridge) const { return Ldlt(gram_matrix(fit_.columns, ridge)); }

MatrixXd FittedModel::covariance() const {
  const Index free = fit_.columns.cols();
  return information(ridge_of_errors).solve(MatrixXd(MatrixXd::Identity(free, free)));
}

VectorXd FittedModel::standard_errors() const {
  VectorXd errors = VectorXd::Zero(fit_.theta.size());
  const MatrixXd covariance = this->covariance();
  for (Index i = 0; i < covariance.cols(); ++i) {
    const int p = fit_.column_parameter[i];
    errors[p] = std::sqrt(std::max(0.0, covariance(i, i))) * predictor_.parameters()[p].scale;
  }
  return errors;
}

double FittedModel::held_error(Index parameter) const {
  VectorXd column = VectorXd::Zero(fit_.columns.rows());
  column.head(fit_.jacobian.rows()) = data_->whitening(VectorXd(fit_.jacobian.col(parameter)));
  const double prior_sd = predictor_.parameters()[parameter].prior_sd;
  const double known = Projector(fit_.columns).vector(column).squaredNorm() + 1 / (prior_sd * prior_sd);
  return known > 0 ? 1 / std::sqrt(known) : std::numeric_limits<double>::infinity();
}

VectorXd FittedModel::errors_held_or_free() const {
  VectorXd errors = standard_errors();
  for (Index i = 0; i < errors.size(); ++i)
    if (errors[i] == 0.0) errors[i] = held_error(i);
  return errors;
}

double FittedModel::absorbed_freedom() const {
  const MatrixXd seen = fit_.columns.topRows(data_->cells());
  return information(ridge_of_errors).solve(MatrixXd(seen.transpose() * seen)).trace();
}

VectorXd FittedModel::contribution(int term) const {
  VectorXd theta = fit_.theta, without;
  theta[predictor_.amplitude_index(term)] = 0.0;
  BalanceMemory memory = fit_.balance;
  if (!predictor_.predict(theta, without, memory)) return VectorXd::Zero(fit_.prediction.size());
  return fit_.prediction - without;
}

SemiEmpiricalSoil FittedModel::soil() const {
  SemiEmpiricalSoil soil = data_->campaign->soil;
  const VectorXd errors = errors_held_or_free();
  for (int i = 0; i < predictor_.soil_parameters(); ++i)
    if (const std::string& name = predictor_.parameters()[i].name; name != carcass_pressure_key)
      soil.*soil_parameter(name).value = {fit_.theta[i], errors[i]};
  const double follows = modulus_factor(soil, data_->campaign->soil.exponent.value, soil.exponent.value);
  for (Estimate* modulus : {&soil.k_c, &soil.k_phi}) modulus->value *= follows, modulus->std_error *= follows;
  return soil;
}

Tire FittedModel::wheel() const {
  Tire wheel = predictor_.wheel(fit_.theta);
  const VectorXd errors = errors_held_or_free();
  for (int i = 0; i < predictor_.soil_parameters(); ++i)
    if (predictor_.parameters()[i].name == carcass_pressure_key) wheel.carcass_pressure->std_error = errors[i];
  return wheel;
}

std::vector<FittedError> FittedModel::errors() const {
  const MatrixXd covariance = this->covariance();
  const VectorXd sd = covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  const std::vector<EffectChoice> effects = predictor_.choices(fit_.theta);
  std::vector<FittedError> errors;
  for (Index i = 0; i < covariance.cols(); ++i) {
    const int p = fit_.column_parameter[i];
    FittedError error;
    error.parameter = predictor_.name_among(effects, p);
    if (p >= predictor_.soil_parameters()) error.std_error = sd[i] * predictor_.parameters()[p].scale;
    for (Index k = 0; k < i; ++k)
      error.correlations.push_back(sd[i] > 0 && sd[k] > 0 ? covariance(i, k) / (sd[i] * sd[k]) : 0.0);
    errors.push_back(std::move(error));
  }
  return errors;
}

std::optional<Forecast> FittedModel::forecast(const Observations& runs, BalanceMemory memory) const {
  const WheelPredictor predictor = predictor_.over(runs);
  Forecast forecast;
  if (!predictor.predict(fit_.theta, forecast.prediction, memory)) return std::nullopt;
  const auto slopes = predictor.linearise(fit_.theta, memory);
  if (!slopes) return std::nullopt;
  forecast.slopes.resize(slopes->jacobian.rows(), fit_.columns.cols());
  for (Index c = 0; c < forecast.slopes.cols(); ++c) {
    const int p = fit_.column_parameter[c];
    forecast.slopes.col(c) = slopes->jacobian.col(p) * predictor_.parameters()[p].scale;
  }
  forecast.solved = information(ridge_of_forecasts).solve(MatrixXd(forecast.slopes.transpose()));
  return forecast;
}

std::optional<FittedModel> fitted(const std::shared_ptr<const Dataset>& data, const WheelPredictor& predictor,
                                  const VectorXd& start, BalanceMemory near) {
  auto found = fit(predictor, data->observations.values(), data->whitening, start, std::move(near));
  if (!found) return std::nullopt;
  return FittedModel(data, predictor, std::move(*found));
}

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
