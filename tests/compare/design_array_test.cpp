// Orthogonal arrays, range analysis and analysis of variance, against a published example and identities.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "bekker_wong/gsl.hpp"
#include "compare/design/factor.hpp"
#include "compare/design/orthogonal_array.hpp"
#include "scenario/errors.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin::compare {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// Smallest distance between two rows.
double smallest_distance(const Eigen::MatrixXd& points) {
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    for (Eigen::Index j = i + 1; j < points.rows(); ++j)
      least = std::min(least, (points.row(i) - points.row(j)).norm());
  return least;
}

class Field : public testing::TestWithParam<int> {};

TEST_P(Field, HoldsTheAxioms) {
  const int q = GetParam();
  const GaloisField f(q);
  for (int a = 0; a < q; ++a) {
    EXPECT_EQ(f.sum(a, 0), a);
    EXPECT_EQ(f.product(a, 1), a);
    EXPECT_EQ(f.product(a, 0), 0);
    int opposite = 0, inverse = 0;
    for (int b = 0; b < q; ++b) {
      opposite += f.sum(a, b) == 0;
      inverse += f.product(a, b) == 1;
      EXPECT_EQ(f.product(a, b), f.product(b, a));
      for (int c = 0; c < q; ++c) {
        EXPECT_EQ(f.product(a, f.sum(b, c)), f.sum(f.product(a, b), f.product(a, c)));
        EXPECT_EQ(f.product(a, f.product(b, c)), f.product(f.product(a, b), c));
      }
    }
    EXPECT_EQ(opposite, 1);
    EXPECT_EQ(inverse, a == 0 ? 0 : 1);
  }
}
INSTANTIATE_TEST_SUITE_P(OfEachArray, Field, testing::Values(2, 3, 4, 5, 7));

TEST(GaloisFields, ARingIsNotAField) {
  EXPECT_THROW(GaloisField(6), std::invalid_argument);
  EXPECT_THROW(GaloisField(1), std::invalid_argument);
}

TEST(OrthogonalArrays, HaveTheirRunsAndColumnsAndAreBalanced) {
  for (const auto& [name, levels] : {std::pair("L9", 3), {"L16", 4}, {"L25", 5}}) {
    const LevelTable array = named_array(name);
    EXPECT_EQ(array.runs(), levels * levels) << name;
    EXPECT_EQ(array.columns(), levels + 1) << name;
    EXPECT_TRUE(is_balanced(array)) << name;
  }
}

TEST(OrthogonalArrays, OneWrongLevelIsNoticed) {
  LevelTable array = orthogonal_array(4);
  array.rows[7][3] = (array.rows[7][3] + 1) % 4;
  EXPECT_FALSE(is_balanced(array));
}

TEST(OrthogonalArrays, L9IsTaguchisTable) {
  // Yang and El-Haik, Design for Six Sigma (2003), table 13.4, levels from 1.
  EXPECT_THAT(orthogonal_array(3).rows,
              ElementsAre(ElementsAre(0, 0, 0, 0), ElementsAre(0, 1, 1, 1), ElementsAre(0, 2, 2, 2),
                          ElementsAre(1, 0, 1, 2), ElementsAre(1, 1, 2, 0), ElementsAre(1, 2, 0, 1),
                          ElementsAre(2, 0, 2, 1), ElementsAre(2, 1, 0, 2), ElementsAre(2, 2, 1, 0)));
}

TEST(OrthogonalArrays, AWrongNameAndTooManyFactorsAreRefused) {
  EXPECT_THAT(soilbin::test::refusal([&] { named_array("L8"); }), HasSubstr("L9"));
  EXPECT_THROW(first_columns(named_array("L9"), 5), InputError);
}

/// Yang and El-Haik, Design for Six Sigma (2003), section 13.6, p. 486: L9, A B C in columns 1, 2 and 4.
struct Published {
  LevelTable design = orthogonal_array(3);
  std::vector<double> y{8, 12, 9, 11, 12, 15, 21, 18, 20};
  Published() {
    for (std::vector<int>& row : design.rows) row.erase(row.begin() + 2);
  }
};

TEST(RangeAnalysis, OfThePublishedExample) {
  const Published example;
  const RangeAnalysis analysis = range_analysis(example.design, example.y);
  EXPECT_THAT(analysis.factors[0].sums, ElementsAre(8 + 12 + 9, 11 + 12 + 15, 21 + 18 + 20));
  EXPECT_THAT(analysis.factors[1].sums, ElementsAre(8 + 11 + 21, 12 + 12 + 18, 9 + 15 + 20));
  EXPECT_NEAR(analysis.factors[0].range, (59 - 29) / 3.0, 1e-12);
  EXPECT_NEAR(analysis.factors[1].range, (44 - 40) / 3.0, 1e-12);
  EXPECT_THAT(analysis.order, ElementsAre(0, 2, 1));  // 'A is by far the most important and C is a distant second'
}

TEST(AnalysisOfVariance, OfThePublishedExample) {
  const Published example;
  const AnalysisOfVariance analysis = analysis_of_variance(example.design, {"A", "B", "C"}, example.y);
  EXPECT_NEAR(analysis.factors[0].sum_of_squares, 158.000, 5e-4);
  EXPECT_NEAR(analysis.factors[1].sum_of_squares, 2.667, 5e-4);
  EXPECT_NEAR(analysis.factors[2].sum_of_squares, 18.667, 5e-4);
  EXPECT_NEAR(analysis.left.sum_of_squares, 0.667, 5e-4);
  EXPECT_NEAR(analysis.left.mean_square, 0.333, 5e-4);
  EXPECT_NEAR(analysis.total, 180.000, 5e-4);
  EXPECT_NEAR(analysis.factors[0].f, 79.0 / (1 / 3.0), 1e-9);
  // With 2 and 2 degrees of freedom the F distribution's tail is 1/(1 + F).
  for (const VarianceRow& row : analysis.factors) EXPECT_NEAR(row.p_value, 1 / (1 + row.f), 1e-12);
  EXPECT_EQ(analysis.error_from, ErrorFrom::free_columns);
}

TEST(AnalysisOfVariance, SumsOfSquaresAddUpToTheTotal) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal(20, 4);
  for (const int levels : {3, 4, 5})
    for (int columns = 1; columns <= levels + 1; ++columns) {
      const LevelTable design = first_columns(orthogonal_array(levels), columns);
      std::vector<double> y;
      for (int i = 0; i < design.runs(); ++i) y.push_back(normal(random));
      const AnalysisOfVariance a =
          analysis_of_variance(design, std::vector<std::string>(static_cast<std::size_t>(columns), "x"), y);
      double sum = a.left.sum_of_squares;
      int freedom = a.left.freedom;
      for (const VarianceRow& row : a.factors) sum += row.sum_of_squares, freedom += row.freedom;
      EXPECT_NEAR(sum, a.total, 1e-10 * a.total);
      EXPECT_EQ(freedom, design.runs() - 1);
      // A factor's sum of squares from its sums alone: sum K_i^2/runs a level - T^2/runs.
      const RangeAnalysis ranges = range_analysis(design, y);
      const double total = std::accumulate(y.begin(), y.end(), 0.0);
      double from_sums = -total * total / design.runs();
      for (const double k : ranges.factors[0].sums) from_sums += k * k / levels;
      EXPECT_NEAR(a.factors[0].sum_of_squares, from_sums, 1e-8);
    }
}

TEST(AnalysisOfVariance, PoolsTheWeakerHalfWhereNoColumnIsFree) {
  const LevelTable design = orthogonal_array(3);
  std::vector<double> y;
  for (const std::vector<int>& row : design.rows)
    y.push_back(10.0 * row[0] + 5.0 * row[1] + 0.2 * row[2] + 0.1 * row[3]);
  const AnalysisOfVariance a = analysis_of_variance(design, {"a", "b", "c", "d"}, y);
  EXPECT_EQ(a.error_from, ErrorFrom::pooled_factors);
  EXPECT_EQ(a.error_freedom, 4);
  EXPECT_TRUE(a.factors[2].pooled && a.factors[3].pooled && !a.factors[0].pooled && !a.factors[1].pooled);
  // Levels -1, 0, 1 with slope g: SS = 3 (g^2 + 0 + g^2) = 6 g^2.
  EXPECT_NEAR(a.factors[0].f, (6 * 100.0 / 2) / (6 * (0.04 + 0.01) / 4), 1e-6);
}

TEST(AnalysisOfVariance, WithKnownNoiseFIsAChiSquare) {
  const Published example;
  const AnalysisOfVariance a = analysis_of_variance(example.design, {"A", "B", "C"}, example.y, 2.0);
  EXPECT_EQ(a.error_from, ErrorFrom::known_noise);
  // chi^2 = SS/variance with 2 degrees of freedom: its tail is exp(-chi^2/2).
  EXPECT_NEAR(a.factors[2].p_value, std::exp(-(56.0 / 3) / 2.0 / 2), 1e-12);
  EXPECT_NEAR(a.left.p_value, std::exp(-(2.0 / 3) / 2.0 / 2), 1e-12);
}

TEST(AnalysisOfVariance, AnInteractionOfTwoFactorsShowsInTheColumnsOfTheOthers) {
  // y = a b with levels -1, 0, 1: columns a and b see nothing, the other two share all of it.
  const LevelTable design = orthogonal_array(3);
  std::vector<double> y;
  for (const std::vector<int>& row : design.rows) y.push_back((row[0] - 1) * (row[1] - 1));
  const AnalysisOfVariance a = analysis_of_variance(design, {"a", "b", "c", "d"}, y, 1.0);
  EXPECT_NEAR(a.factors[0].sum_of_squares, 0, 1e-12);
  EXPECT_NEAR(a.factors[1].sum_of_squares, 0, 1e-12);
  EXPECT_NEAR(a.factors[2].sum_of_squares + a.factors[3].sum_of_squares, a.total, 1e-12);
  EXPECT_GT(a.factors[2].sum_of_squares, 0.4 * a.total);
}

TEST(AnalysisOfVariance, PValuesOfNoiseAreUniform) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  const LevelTable design = first_columns(orthogonal_array(4), 3);
  int below = 0;
  constexpr int trials = 4000;
  for (int t = 0; t < trials; ++t) {
    std::vector<double> y;
    for (int i = 0; i < design.runs(); ++i) y.push_back(normal(random));
    below += analysis_of_variance(design, {"a", "b", "c"}, y).factors[0].p_value < 0.1;
  }
  EXPECT_NEAR(below, 0.1 * trials, 3 * std::sqrt(0.09 * trials));
}

TEST(Factors, LevelsReachBothBounds) {
  const Factor friction{"sliding_friction", 0.2, 0.8, "-"};
  EXPECT_DOUBLE_EQ(level_value(friction, 0, 4), 0.2);
  EXPECT_DOUBLE_EQ(level_value(friction, 3, 4), 0.8);
  EXPECT_DOUBLE_EQ(level_value(friction, 1, 4), 0.4);
  const Eigen::VectorXd values = Eigen::VectorXd::Constant(1, 0.35);
  EXPECT_NEAR(from_unit({friction}, to_unit({friction}, values))[0], 0.35, 1e-15);
}

TEST(LatinHypercube, HasOnePointInEachSlice) {
  for (const Eigen::MatrixXd& cube : {latin_hypercube(17, 3, 5), maximin_latin_hypercube(17, 3, 5)})
    for (Eigen::Index j = 0; j < cube.cols(); ++j) {
      std::vector<int> slices;
      for (Eigen::Index i = 0; i < cube.rows(); ++i) slices.push_back(static_cast<int>(std::floor(cube(i, j) * 17)));
      std::sort(slices.begin(), slices.end());
      for (int k = 0; k < 17; ++k) EXPECT_EQ(slices[static_cast<std::size_t>(k)], k);
    }
}

TEST(LatinHypercube, MaximinKeepsPointsApartAndSeedsRepeat) {
  double plain = 0, apart = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    plain += smallest_distance(latin_hypercube(20, 3, seed)) / 20;
    apart += smallest_distance(maximin_latin_hypercube(20, 3, seed)) / 20;
  }
  EXPECT_GT(apart, 1.8 * plain);
  EXPECT_EQ(maximin_latin_hypercube(12, 4, 7), maximin_latin_hypercube(12, 4, 7));
  EXPECT_NE(maximin_latin_hypercube(12, 4, 7), maximin_latin_hypercube(12, 4, 8));
}

TEST(Distributions, TailsAgreeWithTables) {
  EXPECT_NEAR(gsl::f_tail(3.354, 2, 27), 0.05, 5e-5);  // tables: F(0.05; 2, 27) = 3.354
  EXPECT_NEAR(gsl::chi_square_tail(7.815, 3), 0.05, 5e-5);
  EXPECT_NEAR(gsl::normal_tail(1.959964), 0.025, 1e-8);
}

}  // namespace
}  // namespace soilbin::compare
