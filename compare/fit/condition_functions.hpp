// Smooth functions and waves of a campaign's conditions: what the noise is estimated beside, and how the
// loop looks for an effect that has no name.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "compare/fit/noise_floor.hpp"
#include "compare/fit/observations.hpp"

namespace soilbin::compare {

/// Smooth functions of the covariates over the rows, each of mean 0 and mean square 1, the plainest first: linear
/// terms, powers of slip, products with slip and load, squares. At most max_columns.
Eigen::MatrixXd smooth_basis(const Observations& observations, int max_columns);

/// How many of them a term without a name is made of.
int unnamed_columns(const Observations& observations);

/// A covariate's values, which differ, taken to -1 .. 1.
Eigen::VectorXd to_unit_interval(const Eigen::VectorXd& values);

/// A column of ones, then the columns given.
Eigen::MatrixXd with_constant(const Eigen::MatrixXd& functions);

/// Waves of one to a tenth as many periods as there are values (five at most) over the range of a covariate's values;
/// sine and cosine of each, mean square about 1.
Eigen::MatrixXd waves(const Eigen::VectorXd& values);

// A smooth term without a name: what any function of the conditions would do for the residual. A yardstick beside the
// named effects, not a candidate of theirs.

/// A smooth function of the conditions, channel by channel, fitted to the residual of the rows that are kept and
/// evaluated at all cells. Ridge regression; how stiff is chosen by evidence. all: observations; kept: by row;
/// prediction: the base model's, of every cell (not finite: left out).
Eigen::VectorXd smooth_term(const Observations& all, const std::vector<bool>& kept, const Eigen::VectorXd& prediction,
                            const NoiseFloor& noise);

}  // namespace soilbin::compare
