// Factors of matrices: what they solve is put back into the matrix.
#include "compare/fit/factorizations.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace soilbin::compare {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Columns that do not depend on each other, from a fixed recipe.
MatrixXd columns(Eigen::Index rows, Eigen::Index cols) {
  MatrixXd a(rows, cols);
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < cols; ++j) a(i, j) = std::sin(1.7 * i + 2.3 * j * j + 0.4 * i * j);
  return a;
}

MatrixXd positive_definite(Eigen::Index n) {
  const MatrixXd a = columns(2 * n, n);
  return a.transpose() * a + MatrixXd::Identity(n, n);
}

TEST(Factorizations, CholeskySolvesAndHalvesMakeTheWhole) {
  const MatrixXd a = positive_definite(7);
  const VectorXd b = columns(7, 1);
  const Cholesky factor(a);
  ASSERT_TRUE(factor.exists());
  EXPECT_NEAR((a * factor.solve(b) - b).norm(), 0, 1e-12);
  EXPECT_NEAR(factor.half_solve(b).squaredNorm(), b.dot(factor.solve(b)), 1e-12);
  EXPECT_NEAR((factor.half_times(factor.half_solve(b)) - b).norm(), 0, 1e-12);
  EXPECT_NEAR(2 * factor.half_log_determinant(), std::log(a.determinant()), 1e-12);
  EXPECT_FALSE(Cholesky(-a).exists());
}

TEST(Factorizations, LdltTakesASingularMatrix) {
  const MatrixXd a = columns(9, 4), together = a * a.transpose();  // of rank 4
  const MatrixXd root = Ldlt(together).square_root();
  EXPECT_NEAR((root * root.transpose() - together).norm(), 0, 1e-11);
  const MatrixXd whole = positive_definite(5), b = columns(5, 3);
  EXPECT_NEAR((whole * Ldlt(whole).solve(b) - b).norm(), 0, 1e-12);
}

TEST(Factorizations, BasesSpanTheColumnsAndWhatIsAtRightAngles) {
  MatrixXd a = columns(8, 3);
  a.col(2) = 2 * a.col(0) - a.col(1);  // a combination: two are left
  const MatrixXd basis = orthonormal(a), rest = orthogonal_complement(a);
  ASSERT_EQ(basis.cols(), 2);
  ASSERT_EQ(rest.cols(), 6);
  EXPECT_NEAR((basis * (basis.transpose() * a) - a).norm(), 0, 1e-12);
  EXPECT_NEAR((rest.transpose() * a).norm(), 0, 1e-12);
  EXPECT_NEAR((rest.transpose() * rest - MatrixXd::Identity(6, 6)).norm(), 0, 1e-12);
  EXPECT_EQ(orthonormal(MatrixXd(8, 0)).cols(), 0);
  const MatrixXd first = leading_orthonormal(columns(8, 3), 3);
  EXPECT_NEAR((first.transpose() * first - MatrixXd::Identity(3, 3)).norm(), 0, 1e-12);
}

TEST(Factorizations, LeastSquaresLeavesWhatNoColumnCanMake) {
  const MatrixXd a = columns(8, 3);
  const VectorXd y = columns(8, 5).col(4);
  EXPECT_NEAR((a.transpose() * (y - a * least_squares(a, y))).norm(), 0, 1e-12);
}

}  // namespace
}  // namespace soilbin::compare
