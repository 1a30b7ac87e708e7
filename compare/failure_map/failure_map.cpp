#include "compare/failure_map/failure_map.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "scenario/errors.hpp"

namespace soilbin::compare {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double one_sided_95 = 1.645;

/// Rows that have one of their two shares of the load, on the unit cube.
Samples rows_with(std::optional<Estimate> FailureRow::*share, const FailureQuestion& question,
                  const std::vector<FailureRow>& rows) {
  std::vector<VectorXd> x;
  std::vector<Estimate> y;
  for (const FailureRow& row : rows)
    if (row.*share) x.emplace_back(to_unit(question.factors, row.values)), y.push_back(*(row.*share));
  const Index n = static_cast<Index>(x.size());
  Samples samples{MatrixXd(n, n > 0 ? x.front().size() : 0), VectorXd(n), VectorXd(n)};
  for (Index i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    samples.x.row(i) = x[k], samples.y[i] = y[k].value, samples.variance[i] = y[k].std_error * y[k].std_error;
  }
  return samples;
}

Samples samples_of(const FailureQuestion& question, const std::vector<FailureRow>& rows) {
  Samples samples = rows_with(&FailureRow::difference, question, rows);
  if (samples.y.size() < static_cast<Index>(question.factors.size()) + 2)
    throw NoSolution(fmt::format("{}: only {} of {} conditions have an answer of both models", question.name,
                                 samples.y.size(), rows.size()));
  return samples;
}

FailureRow row_at(const FailureQuestion& question, const VectorXd& values) {
  FailureRow row{values, question.difference(values)};
  if (question.resolution_error && (row.difference || question.waits()))
    row.resolution_error = question.resolution_error(values);
  return row;
}

void run(const FailureQuestion& question, const FailureMapOptions& options, const VectorXd& unit, FailureMap& map) {
  const std::size_t done = map.rows.size(), all = static_cast<std::size_t>(options.first + options.at_boundary);
  tell(options.watch, fmt::format("condition {} of {}", done + 1, all), done, all);
  map.rows.push_back(row_at(question, from_unit(question.factors, unit)));
}

void learn(const FailureQuestion& question, FailureMap& map) {
  const SurrogateOptions options{.seed = map.seed, .look = question.look};
  map.surrogate.emplace(samples_of(question, map.rows), options);
  map.held_out = map.surrogate->mode().leave_one_out();
  map.resolution_error.reset();
  const Samples errors = rows_with(&FailureRow::resolution_error, question, map.rows);
  if (errors.size() >= static_cast<Index>(question.factors.size()) + 2) map.resolution_error.emplace(errors, options);
}

/// The difference from the grains as they are, and from infinitely fine ones.
struct BothGrains {
  Estimate coarse, fine;
};

BothGrains both_at(const FailureQuestion& question, const FailureMap& map, const VectorXd& values) {
  const VectorXd unit = to_unit(question.factors, values);
  const Estimate coarse = map.surrogate.value().predict(unit);
  if (!map.resolution_error) return {coarse, coarse};
  const Estimate error = map.resolution_error->predict(unit);
  return {coarse, {coarse.value - error.value, std::hypot(coarse.std_error, error.std_error)}};
}

/// Whether a place was already asked: a condition without an answer is not asked again and again.
bool asked(const FailureQuestion& question, const FailureMap& map, const VectorXd& unit) {
  return std::ranges::any_of(
      map.rows, [&](const FailureRow& row) { return (to_unit(question.factors, row.values) - unit).norm() < 0.02; });
}

/// The cloud's points that were not asked yet.
MatrixXd fresh_points(const FailureQuestion& question, const FailureMap& map, const MatrixXd& cloud) {
  MatrixXd fresh(0, cloud.cols());
  for (Index i = 0; i < cloud.rows(); ++i)
    if (!asked(question, map, cloud.row(i))) {
      fresh.conservativeResize(fresh.rows() + 1, cloud.cols());
      fresh.row(fresh.rows() - 1) = cloud.row(i);
    }
  return fresh;
}

/// The process that takes its prediction at x for measured, with the mean error of what was.
GaussianProcess believing(const GaussianProcess& process, const VectorXd& x) {
  Samples samples = process.samples();
  const Index n = samples.size();
  const double value = process.predict(x).value, variance = samples.variance.mean();
  samples.x.conservativeResize(n + 1, Eigen::NoChange), samples.x.row(n) = x;
  samples.y.conservativeResize(n + 1), samples.y[n] = value;
  samples.variance.conservativeResize(n + 1), samples.variance[n] = variance;
  return GaussianProcess(std::move(samples), process.trend(), process.hyperparameters());
}

/// At most `count` points, each where the boundary may be once those before are believed.
std::vector<VectorXd> boundary_points(const FailureQuestion& question, const FailureMapOptions& options,
                                      const FailureMap& map, const MatrixXd& cloud, int count) {
  GaussianProcess process =
      fit_surrogate(samples_of(question, map.rows), {.starts = 3, .seed = options.seed, .look = question.look});
  FailureMap chosen = map;
  std::vector<VectorXd> points;
  for (int k = 0; k < count; ++k) {
    const MatrixXd fresh = fresh_points(question, chosen, cloud);
    if (fresh.rows() == 0) break;
    const Index next = next_point(process, fresh, [&](const Estimate& e) {
      question.look();
      return straddle(e, question.tolerance);
    });
    points.push_back(fresh.row(next));
    if (k + 1 == count) break;
    chosen.rows.push_back({from_unit(question.factors, points.back()), std::nullopt});
    process = believing(process, points.back());
  }
  return points;
}

}  // namespace

bool FailureRow::beyond(double tolerance) const {
  return difference && std::abs(difference->value) > std::max(tolerance, 2 * difference->std_error);
}

Estimate FailureMap::at(const FailureQuestion& question, const VectorXd& values) const {
  return surrogate.value().predict(to_unit(question.factors, values));
}

Estimate FailureMap::at_fine(const FailureQuestion& question, const VectorXd& values) const {
  return both_at(question, *this, values).fine;
}

Judged FailureMap::judged(const FailureQuestion& question, const VectorXd& values) const {
  const auto [coarse, fine] = both_at(question, *this, values);
  const auto of = [&](const Estimate& there) {
    const double size = std::abs(there.value), reach = one_sided_95 * there.std_error;
    return size + reach <= question.tolerance  ? Judged::agree
           : size - reach > question.tolerance ? Judged::differ
                                               : Judged::undecided;
  };
  const bool one_side = coarse.value * fine.value > 0 || of(coarse) == Judged::agree;
  return of(coarse) == of(fine) && one_side ? of(coarse) : Judged::undecided;
}

double FailureMap::largest_at(const FailureQuestion& question, const VectorXd& values) const {
  const auto [coarse, fine] = both_at(question, *this, values);
  return std::max(std::abs(coarse.value) + one_sided_95 * coarse.std_error,
                  std::abs(fine.value) + one_sided_95 * fine.std_error);
}

FailureMap map_failures(const FailureQuestion& question, const FailureMapOptions& options) {
  const int d = static_cast<int>(question.factors.size());
  FailureMap map{.seed = options.seed};
  const MatrixXd start = maximin_latin_hypercube(options.first, d, options.seed);
  std::vector<VectorXd> points;
  for (Index i = 0; i < start.rows(); ++i) points.push_back(start.row(i));
  const auto run_together = [&] {
    for (const VectorXd& unit : points) run(question, options, unit, map);
    return !question.waits();
  };
  if (!run_together()) return map;
  const MatrixXd cloud = latin_hypercube(options.cloud, d, options.seed + 1);
  for (int k = 0; k < options.at_boundary; k += options.at_once) {
    points = boundary_points(question, options, map, cloud, std::min(options.at_once, options.at_boundary - k));
    if (points.empty()) break;
    if (!run_together()) return map;
  }
  learn(question, map);
  return map;
}

// The box of conditions in which two models agree, as a clause.

namespace {

/// A grid over the box: every combination of node numbers, the last factor fastest.
class FactorGrid {
 public:
  FactorGrid(const FailureQuestion& question, const std::vector<Role>& roles, int nodes) : question_(question) {
    for (const Role role : roles) counts_.push_back(role == Role::held ? 1 : nodes);
  }

  std::size_t size() const {
    std::size_t product = 1;
    for (const int count : counts_) product *= static_cast<std::size_t>(count);
    return product;
  }
  int count(std::size_t factor) const { return counts_[factor]; }
  std::vector<int> node(std::size_t index) const {
    std::vector<int> node(counts_.size());
    for (std::size_t j = counts_.size(); j-- > 0;) {
      node[j] = static_cast<int>(index % static_cast<std::size_t>(counts_[j]));
      index /= static_cast<std::size_t>(counts_[j]);
    }
    return node;
  }
  double value(std::size_t factor, int node) const {
    return counts_[factor] == 1 ? question_.factors[factor].lower
                                : level_value(question_.factors[factor], node, counts_[factor]);
  }
  VectorXd values(const std::vector<int>& node) const {
    VectorXd values(static_cast<Index>(node.size()));
    for (std::size_t j = 0; j < node.size(); ++j) values[j] = value(j, node[j]);
    return values;
  }

 private:
  const FailureQuestion& question_;
  std::vector<int> counts_;
};

/// Nodes from lower to upper, both within.
struct NodeBox {
  std::vector<int> lower, upper;
};

bool inside(const std::vector<int>& node, const NodeBox& box) {
  for (std::size_t j = 0; j < node.size(); ++j)
    if (node[j] < box.lower[j] || node[j] > box.upper[j]) return false;
  return true;
}

/// How many nodes of a box are doubtful, in one look-up a corner.
class DoubtfulCount {
 public:
  DoubtfulCount(const FactorGrid& grid, const std::vector<bool>& doubtful) : strides_(1, 1) {
    const std::size_t factors = grid.node(0).size();
    for (std::size_t j = factors; j-- > 1;)
      strides_.insert(strides_.begin(), strides_.front() * static_cast<std::size_t>(grid.count(j)));
    below_.assign(doubtful.begin(), doubtful.end());
    for (std::size_t j = 0; j < factors; ++j)  // summed along one factor after the other
      for (std::size_t i = 0; i < below_.size(); ++i)
        if (i / strides_[j] % static_cast<std::size_t>(grid.count(j)) > 0) below_[i] += below_[i - strides_[j]];
  }

  int in(const NodeBox& box) const {
    int count = 0;
    for (unsigned corner = 0; corner < 1U << strides_.size(); ++corner) {
      std::size_t index = 0;
      bool empty = false;
      for (std::size_t j = 0; j < strides_.size(); ++j) {
        const int node = corner >> j & 1U ? box.lower[j] - 1 : box.upper[j];
        empty = empty || node < 0;
        index += static_cast<std::size_t>(std::max(node, 0)) * strides_[j];
      }
      if (!empty) count += std::popcount(corner) % 2 == 0 ? below_[index] : -below_[index];
    }
    return count;
  }

 private:
  std::vector<std::size_t> strides_;
  std::vector<int> below_;  // doubtful nodes at or below a node in every factor
};

/// Tries every box that the roles allow, one factor after the other.
struct BoxSearch {
  const FactorGrid& grid;
  const std::vector<Role>& roles;
  const DoubtfulCount& doubtful;
  NodeBox box = {};
  std::optional<NodeBox> best = {};
  double most = -1.0;

  void extend(std::size_t factor, double share) {
    if (share <= most) return;  // it can only shrink
    if (factor == roles.size()) {
      if (doubtful.in(box) == 0) best = box, most = share;
      return;
    }
    const int last = grid.count(factor) - 1;
    const Role role = roles[factor];
    for (int lower = 0; lower <= (role == Role::bounded ? last : 0); ++lower)
      for (int upper = role == Role::whole ? last : lower; upper <= last; ++upper) {
        box.lower.push_back(lower), box.upper.push_back(upper);
        const bool sought = role == Role::limited || role == Role::bounded;
        extend(factor + 1, sought ? share * (upper - lower + 0.5) / grid.count(factor) : share);
        box.lower.pop_back(), box.upper.pop_back();
      }
  }
};

/// Counts the rows in the box and finds the one farthest off. A held factor counts up to a tenth of its range.
void back_up(const FailureQuestion& question, const FailureMap& map, const std::vector<Role>& roles,
             AgreementClause& clause) {
  for (const FailureRow& row : map.rows) {
    bool in_box = row.difference.has_value();
    for (std::size_t j = 0; j < roles.size(); ++j) {
      const Factor& factor = question.factors[j];
      const double slack = roles[j] == Role::held ? 0.1 * (factor.upper - factor.lower) : 0.0;
      const double value = row.values[j];
      in_box = in_box && value >= clause.lower[j] && value <= clause.upper[j] + slack;
    }
    if (!in_box) continue;
    ++clause.rows;
    if (!clause.witness || std::abs(row.difference->value) > clause.largest) {
      clause.largest = std::abs(row.difference->value);
      clause.witness = row.values;
    }
  }
}

/// A box and the node in it that is likeliest to overturn it.
struct Box {
  std::vector<double> lower, upper;
  VectorXd most_doubtful;
};

std::optional<Box> largest_box(const FailureQuestion& question, const FailureMap& map, const std::vector<Role>& roles,
                               const FactorGrid& grid) {
  std::vector<bool> doubtful;
  std::vector<double> bounds;  // on |difference|, a node each
  for (std::size_t i = 0; i < grid.size(); ++i) {
    question.look();
    bounds.push_back(map.largest_at(question, grid.values(grid.node(i))));
    doubtful.push_back(bounds.back() > question.tolerance);
  }
  const DoubtfulCount count(grid, doubtful);
  BoxSearch search{grid, roles, count};
  search.extend(0, 1.0);
  if (!search.best) return std::nullopt;
  Box box;
  for (std::size_t j = 0; j < roles.size(); ++j) {
    box.lower.push_back(grid.value(j, search.best->lower[j]));
    box.upper.push_back(grid.value(j, search.best->upper[j]));
  }
  double most = -1.0;
  for (std::size_t i = 0; i < grid.size(); ++i)
    if (inside(grid.node(i), *search.best) && bounds[i] > most)
      most = bounds[i], box.most_doubtful = grid.values(grid.node(i));
  return box;
}

bool was_run(const FailureMap& map, const VectorXd& values) {
  return std::ranges::any_of(map.rows, [&](const FailureRow& row) { return row.values == values; });
}

}  // namespace

std::optional<AgreementClause> agreement(const FailureQuestion& question, FailureMap& map,
                                         const std::vector<Role>& roles, int nodes, int rounds) {
  const FactorGrid grid(question, roles, nodes);
  std::optional<Box> box = largest_box(question, map, roles, grid);
  for (int round = 0; round < rounds && box && !was_run(map, box->most_doubtful); ++round) {
    map.rows.push_back(row_at(question, box->most_doubtful));
    if (question.waits()) return std::nullopt;
    learn(question, map);
    box = largest_box(question, map, roles, grid);
  }
  if (!box) return std::nullopt;
  AgreementClause clause{.roles = roles, .lower = box->lower, .upper = box->upper};
  back_up(question, map, roles, clause);
  if (clause.rows == 0) return std::nullopt;
  return clause;
}

}  // namespace soilbin::compare
