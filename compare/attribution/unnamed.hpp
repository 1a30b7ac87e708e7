// Effects that the catalogue does not have: families of functions that one could look like (smooth in the conditions,
// waves in slip, load, position or time, a misread slip or load), and the evidence that the residual holds one of
// them.
#pragma once

#include <Eigen/Dense>
#include <string_view>
#include <vector>

#include "compare/fit/evidence.hpp"

namespace soilbin::compare {

/// One kind of function that belongs to no effect: some families of whitened columns, each of about 1 sd a cell.
struct UnnamedKind {
  std::string_view name;
  std::vector<Eigen::MatrixXd> families;
};

/// Name of the kind in which a slip or load is not the one written.
inline constexpr std::string_view misread_kind = "a slip or load that is not the one written";

/// Functions of the conditions: smooth; waves in slip, in load, in position, in time, of every channel or of one alone;
/// what the run before left behind; each channel bent over its own range; a gain of all forces that waves. prediction:
/// of the cells, by the base model.
std::vector<UnnamedKind> unnamed_functions(const Dataset& data, const Eigen::VectorXd& prediction);

/// The same, and a slip or load that is not the one written: off by an amount, and by one in proportion to each
/// condition that varies.
std::vector<UnnamedKind> unnamed_kinds(const FittedModel& base);

/// Functions of the rows as whitened columns of the cells: each in every channel, of 1 sd of its noise a cell.
Eigen::MatrixXd in_every_channel(const Dataset& data, const Eigen::VectorXd& prediction,
                                 const Eigen::MatrixXd& functions);

/// What an unnamed term adds to a problem.
struct UnnamedEvidence {
  /// ln evidence: the mean over kinds, over the families of each and over sizes, so that it is a Bayes factor whose
  /// price is paid (reached by chance with probability at most its inverse).
  double gain = 0.0;
  std::string_view most_likely;  ///< the kind of most evidence
};
UnnamedEvidence unnamed_evidence(const LinearProblem& problem, const std::vector<UnnamedKind>& kinds);

}  // namespace soilbin::compare
