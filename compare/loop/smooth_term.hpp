// A smooth term without a name: what any function of the conditions would do for the residual. A yardstick beside the
// named effects, not a candidate of theirs.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "compare/loop/noise_floor.hpp"

namespace soilbin::compare {

/// A smooth function of the conditions, channel by channel, fitted to the residual of the rows that are kept and
/// evaluated at all cells. Ridge regression; how stiff is chosen by evidence. all: observations; kept: by row;
/// prediction: the base model's, of every cell (not finite: left out).
Eigen::VectorXd smooth_term(const Observations& all, const std::vector<bool>& kept, const Eigen::VectorXd& prediction,
                            const NoiseFloor& noise);

}  // namespace soilbin::compare
