// The loop's second reading: a base model whose form isn't the soil's, and an effect beside that.
#include "compare/loop/inadequacy.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "compare/loop/answer_words.hpp"
#include "compare/loop_fixture.hpp"

namespace soilbin::compare {
namespace {

/// Runs of a soil that no pressure-sinkage curve describes: pull and sinkage are off by what bends over the loads and
/// slips and belongs to no effect.
Campaign odd_soil(const std::vector<EffectChoice>& effects) {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), effects, fine_noise, 41);
  for (Run& run : campaign.runs) {
    const double load = (run.at.load - 600) / 900, slip = run.at.slip / 0.7;
    *run.drawbar_pull += 40.0 * std::sin(4.0 * slip) * (1 - 1.6 * load);
    *run.sinkage += 2e-3 * std::cos(4.0 * slip) * (1 - 1.6 * load);
  }
  return campaign;
}

LoopAnswer asked(const Campaign& campaign) {
  LoopOptions options;
  options.identify.simulations = 1000;
  options.validate = false;
  return run_loop(campaign, options);
}

/// Small data with a few cells a row, for identities.
Identification settled() {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {}, fine_noise, 43);
  return identify(campaign, observe(campaign), {.simulations = 200});
}

// |W v|^2 = v' (C + U U')^-1 v, where U's columns had been whitened by C alone.
TEST(Whitening, BesideATermIsThatOfTheirJointCovariance) {
  const Identification id = settled();
  const Eigen::Index cells = id.base.prediction.size();
  const Eigen::MatrixXd term = 0.5 * inadequacy_columns(id);
  const Eigen::VectorXd v = Eigen::VectorXd::LinSpaced(cells, -1.0, 2.0), white = (*id.whitening)(v);
  const Eigen::MatrixXd joint = Eigen::MatrixXd::Identity(cells, cells) + term * term.transpose();
  EXPECT_NEAR(id.whitening->beside(term)(v).squaredNorm(), white.dot(joint.ldlt().solve(white)),
              1e-9 * white.squaredNorm());
}

// ln N(r; 0, 1 + s^2 U U') - ln N(r; 0, 1), by the joint covariance itself.
TEST(JoinedColumns, GainTheRatioOfNormalDensities) {
  const Identification id = settled();
  const Eigen::Index cells = id.base.prediction.size();
  const Eigen::MatrixXd columns = inadequacy_columns(id);
  LinearProblem problem;
  problem.cells = cells;
  problem.residual = 2 * columns.col(1) + Eigen::VectorXd::LinSpaced(cells, -1.0, 1.0);
  problem.nuisance = Eigen::MatrixXd(cells, 0);
  for (const double size : term_sizes) {
    const Eigen::MatrixXd joint = Eigen::MatrixXd::Identity(cells, cells) + size * size * columns * columns.transpose();
    const Eigen::LLT<Eigen::MatrixXd> factor(joint);
    const double quadratic = problem.residual.dot(factor.solve(problem.residual));
    const double log_determinant = 2 * factor.matrixLLT().diagonal().array().log().sum();
    EXPECT_NEAR(JoinedColumns(problem, columns).gain(size),
                0.5 * (problem.residual.squaredNorm() - quadratic - log_determinant),
                1e-8 * problem.residual.squaredNorm())
        << size;
  }
}

// Beside the odd soil a second pass bears more. Read by the base model alone, named effects are bent to make up for the
// soil; read beside its inadequacy, what is left is the rut that was compacted.
TEST(SlowInadequacy, ShowsTheEffectBesideAnOddSoil) {
  const LoopAnswer answer = asked(odd_soil({{"multipass", "", {{"a", 0.3}}}}));
  ASSERT_EQ(answer.verdict, Verdict::unknown_effect) << answer.reason;
  ASSERT_TRUE(answer.inadequate);
  const Identification& beside = answer.inadequate->identification;
  ASSERT_TRUE(beside.best);
  EXPECT_EQ(beside.rivals[*beside.best].ids, std::set<std::string>{"multipass"});
  EXPECT_LT(beside.p_value, 0.01);
  EXPECT_EQ(answer.ambiguity_set.front().ids, std::set<std::string>{"multipass"});
  double sum = 0.0;
  for (const Weighted& w : answer.ambiguity_set) sum += w.weight;
  EXPECT_NEAR(sum, 1.0, 1e-12);
  const std::vector<std::string> words = explanation(answer);
  EXPECT_TRUE(std::any_of(words.begin(), words.end(), [](const std::string& sentence) {
    return sentence.find("smooth function of load and slip, multipass stands out most") != std::string::npos;
  }));
}

// Where there is nothing but the odd soil, the second reading names nothing, and the verdict says that it is unknown.
TEST(SlowInadequacy, NamesNothingBesideAnOddSoilAlone) {
  const LoopAnswer answer = asked(odd_soil({}));
  ASSERT_EQ(answer.verdict, Verdict::unknown_effect) << answer.reason;
  ASSERT_TRUE(answer.inadequate);
  EXPECT_FALSE(answer.inadequate->identification.best);
  EXPECT_GT(answer.inadequate->identification.p_value, 0.05);
  EXPECT_EQ(to_json(answer).at("beside_inadequacy").at("effects").size(), 0u);
}

}  // namespace
}  // namespace soilbin::compare
