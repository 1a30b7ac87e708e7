// The box of conditions in which two models agree, as a clause.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "compare/failure_map/failure_map.hpp"
#include "compare/report/number_text.hpp"

namespace soilbin::compare {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double one_sided_95 = 1.645;

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
    for (std::size_t j = 0; j < node.size(); ++j) values[static_cast<Index>(j)] = value(j, node[j]);
    return values;
  }

 private:
  const FailureQuestion& question_;
  std::vector<int> counts_;
};

bool inside(const std::vector<int>& node, const std::vector<int>& corner) {
  for (std::size_t j = 0; j < node.size(); ++j)
    if (node[j] > corner[j]) return false;
  return true;
}

/// The corner of the largest box without a node where the models may disagree; nothing where the lower corner is one.
std::optional<std::vector<int>> largest_corner(const FactorGrid& grid, const std::vector<Role>& roles,
                                               const std::vector<std::vector<int>>& doubtful) {
  std::optional<std::vector<int>> best;
  double most = -1.0;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const std::vector<int> corner = grid.node(i);
    double share = 1.0;
    bool candidate = true;
    for (std::size_t j = 0; j < roles.size(); ++j) {
      if (roles[j] == Role::whole) candidate = candidate && corner[j] == grid.count(j) - 1;
      if (roles[j] == Role::limited) share *= (corner[j] + 0.5) / grid.count(j);
    }
    if (!candidate || share <= most) continue;
    const bool agrees = std::none_of(doubtful.begin(), doubtful.end(),
                                     [&](const std::vector<int>& node) { return inside(node, corner); });
    if (agrees) best = corner, most = share;
  }
  return best;
}

std::string text_of(const FailureQuestion& question, const std::vector<Role>& roles, const AgreementClause& clause) {
  std::string limits, held;
  for (std::size_t j = 0; j < roles.size(); ++j) {
    const Factor& factor = question.factors[j];
    const auto words = [&](double value) {
      return number(value * per_unit(factor.unit)) + (factor.unit == "-" ? "" : " " + factor.unit);
    };
    if (roles[j] == Role::limited)
      limits += fmt::format("{}{} {}", limits.empty() ? "" : " and ", factor.name, words(clause.upper[j]));
    if (roles[j] == Role::held) held += fmt::format(", at {} {}", factor.name, words(factor.lower));
  }
  return fmt::format(
      "{}: within {:.3g} % of the load up to {}{}; of {} conditions run there, the farthest is {:.1f} % off",
      question.name, 100 * question.tolerance, limits, held, clause.rows, 100 * clause.largest);
}

/// Counts the rows in the box and finds the one farthest off. A held factor counts up to a tenth of its range.
void back_up(const FailureQuestion& question, const FailureMap& map, const std::vector<Role>& roles,
             AgreementClause& clause) {
  for (const FailureRow& row : map.rows) {
    bool in_box = row.difference.has_value();
    for (std::size_t j = 0; j < roles.size(); ++j) {
      const Factor& factor = question.factors[j];
      const double slack = roles[j] == Role::held ? 0.1 * (factor.upper - factor.lower) : 0.0;
      in_box = in_box && row.values[static_cast<Index>(j)] <= clause.upper[j] + slack;
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
  std::vector<double> upper;
  VectorXd most_doubtful;
};

std::optional<Box> largest_box(const FailureQuestion& question, const FailureMap& map, const std::vector<Role>& roles,
                               const FactorGrid& grid) {
  std::vector<std::vector<int>> doubtful;
  std::vector<double> bounds;  // on |difference|, a node each
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const Estimate there = map.at(question, grid.values(grid.node(i)));
    bounds.push_back(std::abs(there.value) + one_sided_95 * there.std_error);
    if (bounds.back() > question.tolerance) doubtful.push_back(grid.node(i));
  }
  const std::optional<std::vector<int>> corner = largest_corner(grid, roles, doubtful);
  if (!corner) return std::nullopt;
  Box box;
  for (std::size_t j = 0; j < roles.size(); ++j) box.upper.push_back(grid.value(j, (*corner)[j]));
  double most = -1.0;
  for (std::size_t i = 0; i < grid.size(); ++i)
    if (inside(grid.node(i), *corner) && bounds[i] > most)
      most = bounds[i], box.most_doubtful = grid.values(grid.node(i));
  return box;
}

bool was_run(const FailureMap& map, const VectorXd& values) {
  return std::any_of(map.rows.begin(), map.rows.end(), [&](const FailureRow& row) { return row.values == values; });
}

}  // namespace

std::optional<AgreementClause> agreement(const FailureQuestion& question, FailureMap& map,
                                         const std::vector<Role>& roles, int nodes, int rounds) {
  const FactorGrid grid(question, roles, nodes);
  std::optional<Box> box = largest_box(question, map, roles, grid);
  for (int round = 0; round < rounds && box && !was_run(map, box->most_doubtful); ++round) {
    add_row(question, box->most_doubtful, map);
    box = largest_box(question, map, roles, grid);
  }
  if (!box) return std::nullopt;
  AgreementClause clause;
  clause.upper = box->upper;
  back_up(question, map, roles, clause);
  if (clause.rows == 0) return std::nullopt;
  clause.text = text_of(question, roles, clause);
  return clause;
}

}  // namespace soilbin::compare
