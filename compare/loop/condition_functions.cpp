#include "compare/loop/condition_functions.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace soilbin::compare {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Adds a column scaled to mean 0 and mean square 1, unless it is (nearly) a combination of those there.
class BasisBuilder {
 public:
  BasisBuilder(Index rows, int most) : rows_(rows), most_(most) {}
  void add(VectorXd column) {
    if (static_cast<int>(columns_.size()) >= most_) return;
    column.array() -= column.mean();
    const double size = std::sqrt(column.squaredNorm() / static_cast<double>(rows_));
    if (!(size > 1e-9)) return;
    column /= size;
    VectorXd rest = column;
    for (const VectorXd& q : orthonormal_) rest -= q.dot(rest) * q;
    if (rest.squaredNorm() < 1e-4 * static_cast<double>(rows_)) return;
    orthonormal_.push_back(rest.normalized());
    columns_.push_back(std::move(column));
  }
  MatrixXd build() const {
    MatrixXd basis(rows_, columns_.size());
    for (std::size_t i = 0; i < columns_.size(); ++i) basis.col(i) = columns_[i];
    return basis;
  }

 private:
  Index rows_;
  int most_;
  std::vector<VectorXd> columns_, orthonormal_;
};

}  // namespace

VectorXd to_unit_interval(const VectorXd& values) {
  const double low = values.minCoeff(), high = values.maxCoeff();
  return ((values.array() - low) * (2 / (high - low)) - 1).matrix();
}

MatrixXd with_constant(const MatrixXd& functions) {
  MatrixXd all(functions.rows(), functions.cols() + 1);
  all << VectorXd::Ones(functions.rows()), functions;
  return all;
}

MatrixXd smooth_basis(const Observations& observations, int max_columns) {
  BasisBuilder basis(observations.rows.size(), max_columns);
  std::vector<VectorXd> u;
  for (const Covariate& c : covariates(observations)) u.push_back(to_unit_interval(c.values));
  for (const VectorXd& x : u) basis.add(x);
  if (!u.empty()) basis.add(u[0].array().square());
  if (!u.empty()) basis.add(u[0].array().cube());
  for (std::size_t i = 1; i < u.size(); ++i) basis.add(u[0].array() * u[i].array());
  for (std::size_t i = 1; i < u.size(); ++i) basis.add(u[i].array().square());
  for (std::size_t i = 2; i < u.size(); ++i) basis.add(u[1].array() * u[i].array());
  for (std::size_t i = 1; i < u.size(); ++i) basis.add(u[0].array().square() * u[i].array());
  return basis.build();
}

MatrixXd waves(const VectorXd& values) {
  const int most = std::clamp(static_cast<int>(values.size()) / 10, 1, 5);
  const double low = values.minCoeff(), high = values.maxCoeff();
  MatrixXd columns(values.size(), 2 * most);
  for (int k = 1; k <= most; ++k)
    for (Index i = 0; i < values.size(); ++i) {
      const double phase = 2 * std::numbers::pi * k * (values[i] - low) / (1.05 * (high - low));
      columns(i, 2 * k - 2) = std::sqrt(2.0) * std::sin(phase);
      columns(i, 2 * k - 1) = std::sqrt(2.0) * std::cos(phase);
    }
  return columns;
}

}  // namespace soilbin::compare
