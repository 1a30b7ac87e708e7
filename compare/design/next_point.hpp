// Which point to look at next, where runs are dear and a surrogate knows how sure it is (gaussian_process.hpp).
#pragma once

#include <Eigen/Dense>
#include <stdexcept>

#include "compare/design/gaussian_process.hpp"

namespace soilbin::compare {

/// What each rule likes best; all are largest at the point to choose, for a function that the surrogate predicts as
/// value +- std_error there.

/// How likely the function lies within `half_width` of `target`.
double chance_within(const Estimate& predicted, double target, double half_width);

/// Where the boundary |function| = limit of an excess set may be: 1.96 std_error - distance of the value to the
/// nearer of +-limit (the straddle of Bryan et al. 2005, Active learning for identifying function threshold
/// boundaries).
double straddle(const Estimate& predicted, double limit);

/// The candidate (a row each) of which `score` likes the prediction best; the first of equals. Throws
/// std::invalid_argument for no candidates.
template <class Score>
Eigen::Index next_point(const GaussianProcess& surrogate, const Eigen::MatrixXd& candidates, const Score& score) {
  if (candidates.rows() == 0) throw std::invalid_argument("no candidates to choose from");
  Eigen::Index best = 0;
  double most = score(surrogate.predict(candidates.row(0)));
  for (Eigen::Index i = 1; i < candidates.rows(); ++i)
    if (const double s = score(surrogate.predict(candidates.row(i))); s > most) most = s, best = i;
  return best;
}

}  // namespace soilbin::compare
