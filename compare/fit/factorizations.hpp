// Factors of matrices, and what is solved by them: Cholesky's, its square-root-free sibling LDL', and QR.
//
//   const Cholesky factor(covariance);                    // A = L L'
//   if (!factor.exists()) return no_answer();
//   const double fit = factor.half_solve(residual).squaredNorm();  // r' A^-1 r
//
// Compiled once, in factorizations.cpp: each file that factorises by Eigen itself takes seconds more to compile.
#pragma once

#include <Eigen/Dense>

namespace soilbin::compare {

/// The lower triangle L of a symmetric positive definite matrix A = L L'.
class Cholesky {
 public:
  explicit Cholesky(const Eigen::MatrixXd& a);
  /// Whether A is positive definite; without that no other answer holds.
  bool exists() const;
  /// ln det L, half of ln det A.
  double half_log_determinant() const;
  /// A^-1 b.
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const;
  /// L^-1 b.
  Eigen::VectorXd half_solve(const Eigen::VectorXd& b) const;
  Eigen::MatrixXd half_solve(const Eigen::MatrixXd& b) const;
  /// L b.
  Eigen::VectorXd half_times(const Eigen::VectorXd& b) const;

 private:
  Eigen::LLT<Eigen::MatrixXd> llt_;
};

/// L D L' of a symmetric matrix A that may be singular to rounding.
class Ldlt {
 public:
  explicit Ldlt(const Eigen::MatrixXd& a);
  /// A^-1 b.
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const;
  /// F with F F' = A, where A is positive semidefinite.
  Eigen::MatrixXd square_root() const;

 private:
  Eigen::LDLT<Eigen::MatrixXd> ldlt_;
};

/// L^-1 b of the lower triangle L of a matrix.
Eigen::MatrixXd solve_lower(const Eigen::MatrixXd& l, const Eigen::MatrixXd& b);

/// An orthonormal basis of what these columns span; fewer columns where some are combinations of others.
Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& columns);

/// The first `count` columns of Q of QR without exchanging columns.
Eigen::MatrixXd leading_orthonormal(const Eigen::MatrixXd& columns, Eigen::Index count);

/// An orthonormal basis of what is at right angles to all of these columns.
Eigen::MatrixXd orthogonal_complement(const Eigen::MatrixXd& columns);

/// The weights of the columns that make their sum nearest to the values, by least squares.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& columns, const Eigen::VectorXd& values);

}  // namespace soilbin::compare
