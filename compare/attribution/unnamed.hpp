// Effects that the catalogue does not have: families of functions that one could look like (smooth in the conditions,
// waves in slip, load, position or time, a misread slip or load), and the evidence that the residual holds one of
// them.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "compare/fit/evidence.hpp"

namespace soilbin::compare {

/// What an effect that the catalogue does not have could look like.
enum class Unnamed { smooth, wave, wave_of_one_channel, gain_of_forces, run_before, bent_channel, misread_condition };

/// One kind of function that belongs to no effect: some families of whitened columns, each of about 1 sd a cell.
struct UnnamedKind {
  Unnamed kind;
  std::vector<Eigen::MatrixXd> families;
};

/// Functions of the conditions: smooth; waves in slip, in load, in position, in time, of every channel or of one alone;
/// what the run before left behind; each channel bent over its own range; a gain of all forces that waves. prediction:
/// of the cells, by the base model.
std::vector<UnnamedKind> unnamed_functions(const Dataset& data, const Eigen::VectorXd& prediction);

/// Functions of the conditions (unnamed_functions), and a slip or load that is not the one written: off by an amount,
/// and by one in proportion to each condition that varies.
std::vector<UnnamedKind> unnamed_kinds(const FittedModel& base);

/// Functions of the rows as whitened columns of the cells: each in every channel, of 1 sd of its noise a cell.
Eigen::MatrixXd in_every_channel(const Dataset& data, const Eigen::VectorXd& prediction,
                                 const Eigen::MatrixXd& functions);

/// What an unnamed term adds to a problem.
struct UnnamedEvidence {
  /// ln evidence: the mean over kinds, over the families of each and over sizes, so that it is a Bayes factor whose
  /// price is paid (reached by chance with probability at most its inverse).
  double gain = 0.0;
  Unnamed most_likely = Unnamed::smooth;  ///< the kind of most evidence
};
UnnamedEvidence unnamed_evidence(const LinearProblem& problem, const std::vector<UnnamedKind>& kinds);

}  // namespace soilbin::compare
