// The box of conditions in which two models agree, as a clause.
#include <algorithm>
#include <bit>
#include <cmath>

#include "compare/failure_map/failure_map.hpp"

namespace soilbin::compare {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

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
    add_row(question, box->most_doubtful, map);
    if (question.waits()) return std::nullopt;
    box = largest_box(question, map, roles, grid);
  }
  if (!box) return std::nullopt;
  AgreementClause clause{.roles = roles, .lower = box->lower, .upper = box->upper};
  back_up(question, map, roles, clause);
  if (clause.rows == 0) return std::nullopt;
  return clause;
}

}  // namespace soilbin::compare
