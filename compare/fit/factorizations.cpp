#include "compare/fit/factorizations.hpp"

namespace soilbin::compare {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

Cholesky::Cholesky(const MatrixXd& a) : llt_(a) {}

bool Cholesky::exists() const { return llt_.info() == Eigen::Success; }

double Cholesky::half_log_determinant() const { return llt_.matrixLLT().diagonal().array().log().sum(); }

VectorXd Cholesky::solve(const VectorXd& b) const { return llt_.solve(b); }

MatrixXd Cholesky::solve(const MatrixXd& b) const { return llt_.solve(b); }

VectorXd Cholesky::half_solve(const VectorXd& b) const { return llt_.matrixL().solve(b); }

MatrixXd Cholesky::half_solve(const MatrixXd& b) const { return llt_.matrixL().solve(b); }

VectorXd Cholesky::half_times(const VectorXd& b) const { return llt_.matrixL() * b; }

Ldlt::Ldlt(const MatrixXd& a) : ldlt_(a) {}

VectorXd Ldlt::solve(const VectorXd& b) const { return ldlt_.solve(b); }

MatrixXd Ldlt::solve(const MatrixXd& b) const { return ldlt_.solve(b); }

MatrixXd Ldlt::square_root() const {
  const VectorXd sizes = ldlt_.vectorD().cwiseMax(0.0).cwiseSqrt();
  return ldlt_.transpositionsP().transpose() * MatrixXd(MatrixXd(ldlt_.matrixL()) * sizes.asDiagonal());
}

MatrixXd solve_lower(const MatrixXd& l, const MatrixXd& b) { return l.triangularView<Eigen::Lower>().solve(b); }

MatrixXd orthonormal(const MatrixXd& columns) {
  if (columns.cols() == 0) return MatrixXd(columns.rows(), 0);
  const Eigen::ColPivHouseholderQR<MatrixXd> qr(columns);
  return qr.householderQ() * MatrixXd::Identity(columns.rows(), qr.rank());
}

MatrixXd leading_orthonormal(const MatrixXd& columns, Index count) {
  return Eigen::HouseholderQR<MatrixXd>(columns).householderQ() * MatrixXd::Identity(columns.rows(), count);
}

MatrixXd orthogonal_complement(const MatrixXd& columns) {
  const Eigen::ColPivHouseholderQR<MatrixXd> qr(columns);
  return MatrixXd(qr.householderQ()).rightCols(columns.rows() - qr.rank());
}

VectorXd least_squares(const MatrixXd& columns, const VectorXd& values) {
  return columns.colPivHouseholderQr().solve(values);
}

}  // namespace soilbin::compare
