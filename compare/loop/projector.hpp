// Orthogonal projection off what some columns span.
#pragma once

#include <Eigen/Dense>

namespace soilbin::compare {

/// An orthonormal basis of what these columns span; fewer columns where some are combinations of others.
inline Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& columns) {
  if (columns.cols() == 0) return Eigen::MatrixXd(columns.rows(), 0);
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns);
  return qr.householderQ() * Eigen::MatrixXd::Identity(columns.rows(), qr.rank());
}

/// P = I - Q Q', Q an orthonormal basis of the columns: what is left of a vector that they cannot make.
class Projector {
 public:
  explicit Projector(const Eigen::MatrixXd& columns) : q_(orthonormal(columns)) {}
  Eigen::MatrixXd operator()(const Eigen::MatrixXd& v) const { return v - q_ * (q_.transpose() * v); }
  Eigen::VectorXd vector(const Eigen::VectorXd& v) const { return v - q_ * (q_.transpose() * v); }

 private:
  Eigen::MatrixXd q_;
};

}  // namespace soilbin::compare
