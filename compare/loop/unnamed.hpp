// What an effect without a name could look like, and the evidence for any of it.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "compare/loop/evidence.hpp"

namespace soilbin::compare {

/// Families of functions of the conditions that belong to no effect: smooth; waves in slip, in load, in position, in
/// time; what the run before left behind; each channel bent over its own range; a gain of all forces that waves. Each
/// in every channel, whitened to about 1 sd a cell. prediction: of the cells, by the base model.
std::vector<Eigen::MatrixXd> unnamed_families(const Dataset& data, const Eigen::VectorXd& prediction);

/// Functions of the rows as whitened columns of the cells: each in every channel, of 1 sd of its noise a cell.
Eigen::MatrixXd in_every_channel(const Dataset& data, const Eigen::VectorXd& prediction,
                                 const Eigen::MatrixXd& functions);

/// ln evidence that an unnamed term adds to the problem: the mean over families and sizes, so that it is a Bayes factor
/// whose price is paid (reached by chance with probability at most its inverse).
double unnamed_gain(const LinearProblem& problem, const std::vector<Eigen::MatrixXd>& families);

}  // namespace soilbin::compare
