// The loop's parts, each against what it must be: derivatives, fits, noise, signatures, p-values.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>

#include "bekker_wong/contact_stages.hpp"
#include "bekker_wong/effect_vocabulary.hpp"
#include "compare/loop/base_fit.hpp"
#include "compare/loop/detection.hpp"
#include "compare/loop/identify.hpp"
#include "compare/loop_fixture.hpp"
#include "compare/measured/condition_views.hpp"

namespace soilbin::compare {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

Term term_of(const Observations& observations, const std::string& id, const std::string& form) {
  return make_term(bekker_wong::find_form({id, form, {}}), observations, true);
}

// dF/dp by the implicit function theorem equals the slope of predictions that are balanced anew.
TEST(WheelPredictor, JacobianIsTheSlopeOfBalancedPredictions) {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {}, fine_noise, 3);
  const Observations observations = observe(campaign);
  const WheelPredictor predictor(campaign, observations, {term_of(observations, "slip_sinkage", "lyasko")});
  VectorXd theta = predictor.start();
  theta[predictor.amplitude_index(0)] = 0.4;
  VectorXd here, up, down;
  MatrixXd jacobian;
  BalanceMemory balanced;
  ASSERT_TRUE(predictor.predict(theta, here, balanced));
  ASSERT_TRUE(predictor.linearise(theta, jacobian, balanced));
  for (Eigen::Index p = 0; p < theta.size(); ++p) {
    const double step = 1e-3 * predictor.parameters()[static_cast<std::size_t>(p)].scale;
    VectorXd moved = theta;
    moved[p] += step;
    ASSERT_TRUE(predictor.predict(moved, up));
    moved[p] -= 2 * step;
    ASSERT_TRUE(predictor.predict(moved, down));
    const VectorXd slope = (up - down) / (2 * step);
    EXPECT_LT((jacobian.col(p) - slope).norm(), 2e-4 * slope.norm() + 1e-9)
        << predictor.parameters()[static_cast<std::size_t>(p)].name;
  }
}

/// A campaign of a wheel that, locked, is as heavy as the soil carries at 15 deg yaw.
Campaign braked_campaign() {
  return read_campaign(std::filesystem::path(SOILBIN_SOURCE_DIR) / "cases/measured/cmu-smooth/campaign.yaml",
                       bekker_wong::CatalogueVocabulary());
}

// The theorem of the envelope: what a row falls short of changes as its load does at fixed theta_1.
TEST(WheelPredictor, SlopesOfWhatTheSoilFallsShortOf) {
  const Campaign campaign = braked_campaign();
  const Observations observations = observe(campaign);
  const WheelPredictor predictor(campaign, observations);
  const VectorXd theta = predictor.start();
  VectorXd prediction;
  EXPECT_FALSE(predictor.predict(theta, prediction));
  BalanceMemory here = giving_way();
  ASSERT_TRUE(predictor.predict(theta, prediction, here));
  MatrixXd jacobian, short_of;
  ASSERT_TRUE(predictor.linearise(theta, jacobian, here, &short_of));
  int giving = 0;
  for (int row = 0; row < predictor.rows(); ++row) {
    const std::size_t r = static_cast<std::size_t>(row);
    if (!(here.shortfall[r] > 0.0)) {
      EXPECT_TRUE(short_of.row(row).isZero());
      continue;
    }
    ++giving;
    for (Eigen::Index p = 0; p < theta.size(); ++p) {
      const double step = 1e-3 * predictor.parameters()[static_cast<std::size_t>(p)].scale;
      VectorXd moved = theta;
      moved[p] += step;
      BalanceMemory up = here, down = here;
      ASSERT_TRUE(predictor.predict(moved, prediction, up));
      moved[p] -= 2 * step;
      ASSERT_TRUE(predictor.predict(moved, prediction, down));
      const double slope = (up.shortfall[r] - down.shortfall[r]) / (2 * step);
      EXPECT_NEAR(short_of(row, p), slope, 1e-3 * short_of.row(row).cwiseAbs().maxCoeff() + 5e-3 * std::abs(slope))
          << predictor.parameters()[static_cast<std::size_t>(p)].name;
    }
  }
  EXPECT_EQ(giving, 3);
}

/// Fits from soils drawn about the declared one; the terms' parameters up to three times their scale.
std::vector<Fit> scattered_fits(const WheelPredictor& predictor, const Identification& id, int starts) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  std::vector<Fit> fits;
  for (int k = 0; k < starts; ++k) {
    VectorXd start = predictor.start();
    for (Eigen::Index i = 0; i < start.size(); ++i) {
      const FreeParameter& p = predictor.parameters()[static_cast<std::size_t>(i)];
      const double drawn =
          std::isfinite(p.prior_sd) ? p.prior + normal(random) * p.prior_sd : 3 * uniform(random) * p.scale;
      start[i] = std::clamp(drawn, p.lower, p.upper);
    }
    if (auto found = fit(predictor, id.observations.values(), *id.whitening, start)) fits.push_back(std::move(*found));
  }
  return fits;
}

// A fit ends where its data put it, not where it came from: through soils that do not carry every row, along theta_m =
// 0.
TEST(SlowFit, EndsAtTheSameChi2FromAnySoilAboutTheDeclaredOne) {
  const Campaign campaign = braked_campaign();
  Identification id;
  settle_base(campaign, observe(campaign), {}, id);
  const WheelPredictor base(campaign, id.observations);
  const std::vector<Fit> alone = scattered_fits(base, id, 8);
  ASSERT_EQ(alone.size(), 8U);
  VectorXd prediction;
  for (const Fit& fit : alone) {
    EXPECT_NEAR(fit.chi2, id.base.chi2, 1e-3 * id.base.chi2);
    EXPECT_TRUE(base.predict(fit.theta, prediction)) << "a row that is not carried";
  }
  const WheelPredictor two(campaign, id.observations,
                           {term_of(id.observations, "sidewall_bulldozing", "passive_wedge"),
                            term_of(id.observations, "slip_sinkage", "sliding")});
  std::vector<double> ends;
  for (const Fit& fit : scattered_fits(two, id, 6)) ends.push_back(fit.chi2);
  std::sort(ends.begin(), ends.end());
  ASSERT_GE(ends.size(), 5U);
  EXPECT_LT(ends[3], ends[0] * (1 + 5e-3));
  EXPECT_LT(ends[0], 0.3 * id.base.chi2);
}

// theta_m = (c1 + c2 |s|) theta_1 is held at 0 for a locked wheel where c1 + c2 < 0: a kink that no fit may hang on.
TEST(SlowFit, KeepsTheStressAngleWhereItsLawPutsIt) {
  const Campaign campaign = braked_campaign();
  Identification id;
  settle_base(campaign, observe(campaign), {}, id);
  const bekker_wong::SoilValues soil = WheelPredictor(campaign, id.observations).soil(id.base.theta);
  EXPECT_GE(soil.c1 + soil.c2, -1e-9);
  EXPECT_LE(soil.c1 + soil.c2, bekker_wong::max_stress_share + 1e-9);
}

// Without noise and with the declared soil true, the fit stays where it is: chi2 = 0.
TEST(Fit, ReturnsTheDeclaredSoilWhereItIsTrue) {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {}, {0, 0, 0, 0}, 1, 0.0);
  const Observations observations = observe(campaign);
  NoiseFloor noise;
  for (ChannelNoise& c : noise.channels) c = {.measured = true, .floor = 1.0};
  noise.channels[sinkage].floor = 1e-4;
  const WheelPredictor predictor(campaign, observations);
  const Whitening whitening(observations, noise, observations.values());
  VectorXd start = predictor.start();
  for (Eigen::Index i = 0; i < start.size(); ++i)
    start[i] += 0.5 * predictor.parameters()[static_cast<std::size_t>(i)].prior_sd;
  const auto found = fit(predictor, observations.values(), whitening, start);
  ASSERT_TRUE(found);
  EXPECT_LT(found->chi2, 1e-2);
  for (Eigen::Index i = 0; i < start.size(); ++i) {
    const FreeParameter& p = predictor.parameters()[static_cast<std::size_t>(i)];
    EXPECT_NEAR(found->theta[i], p.prior, 0.1 * p.prior_sd) << p.name;
  }
}

// Bounds hold: a truth without cohesion pulls c to 0, never below.
TEST(Fit, StopsAtBounds) {
  Campaign campaign = sand_campaign();
  campaign.soil.cohesion = {0.0, 300};
  measure(campaign, sweep(), {}, fine_noise, 5);
  campaign.soil.cohesion = {200.0, 300};
  const Identification id = identify(campaign, observe(campaign), {.simulations = 200});
  const WheelPredictor predictor(campaign, id.observations);
  EXPECT_GE(id.base.theta[3], 0.0);
}

// What a bound holds has the error that it would have if it could move: that of the inverse Gram matrix with its
// column.
TEST(Fit, TellsTheErrorOfWhatABoundHolds) {
  constexpr int cohesion = 3;
  Campaign campaign = sand_campaign();
  Identification id;
  for (std::uint64_t seed = 1; seed < 10 && (id.base.theta.size() == 0 || id.base.theta[cohesion] > 0.0); ++seed) {
    campaign.soil.cohesion = {0.0, 300};
    measure(campaign, sweep(), {}, fine_noise, seed, 0.0);  // noise pulls half of them below 0
    campaign.soil.cohesion = {10.0, 300};
    id = Identification();
    settle_base(campaign, observe(campaign), {}, id);
  }
  const WheelPredictor predictor(campaign, id.observations);
  ASSERT_EQ(standard_errors(id.base, predictor)[cohesion], 0.0);
  VectorXd column = VectorXd::Zero(id.base.columns.rows());
  column.head(id.base.jacobian.rows()) = (*id.whitening)(VectorXd(id.base.jacobian.col(cohesion)));
  MatrixXd all(column.size() + 1, id.base.columns.cols() + 1);  // and the row of its own prior
  all << id.base.columns, column, Eigen::RowVectorXd::Zero(id.base.columns.cols()), 1.0 / 300;
  const double variance = (all.transpose() * all).inverse().diagonal().tail(1)[0];
  EXPECT_NEAR(held_error(id.base, predictor, *id.whitening, cohesion), std::sqrt(variance), 1e-6 * std::sqrt(variance));
}

// Every condition reads what was set, and nothing else moved.
TEST(ConditionViews, ReadWhatTheySet) {
  for (const ConditionView& view : condition_views) {
    OperatingCondition at;
    view.set(at, 3.0);
    EXPECT_EQ(view.get(at), 3.0) << view.name;
    EXPECT_EQ(&condition_view(view.name), &view);
    for (const ConditionView& other : condition_views)
      if (&other != &view) {
        const double untouched = other.get(OperatingCondition{}), now = other.get(at);
        EXPECT_TRUE(now == untouched || (std::isnan(now) && std::isnan(untouched))) << view.name << ", " << other.name;
      }
  }
  EXPECT_THROW(condition_view("weather"), std::out_of_range);
}

// The floor that is found is the floor that was put in, to the precision that 40 freedoms give (11 %; 3 sd allowed).
TEST(NoiseFloor, IsTheNoisePutIn) {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {}, fine_noise, 7);
  const Identification id = identify(campaign, observe(campaign), {.simulations = 200});
  EXPECT_EQ(id.noise.rerun_freedom, 21);
  for (int c = 0; c < 3; ++c) {
    const ChannelNoise& n = id.noise.channels[static_cast<std::size_t>(c)];
    const double typical = n.sd(id.base.prediction.head(3)[c]);
    EXPECT_NEAR(std::log(typical / fine_noise[static_cast<std::size_t>(c)]), 0.0, 0.35)
        << channel_names[static_cast<std::size_t>(c)];
  }
}

Identification settled(const Campaign& campaign) {
  Identification id;
  settle_base(campaign, observe(campaign), {}, id);
  return id;
}

RerunTest against_reruns(const Identification& id) { return rerun_test(id.observations, id.noise, id.base); }

// Without anything missing it is reached by chance as seldom as it says (or seldomer: the setpoint farthest off is left
// out, and the channels' least counts times their number). 3 standard errors of 120 campaigns allowed.
TEST(SlowRerunTest, KeepsItsLevel) {
  constexpr int campaigns = 120;
  int under_five = 0;
  for (int k = 0; k < campaigns; ++k) {
    Campaign campaign = sand_campaign();
    measure(campaign, sweep(), {}, fine_noise, static_cast<std::uint64_t>(100 + k));
    if (against_reruns(settled(campaign)).p_value < 0.05) ++under_five;
  }
  EXPECT_LE(under_five, 0.05 * campaigns + 3 * std::sqrt(0.05 * 0.95 * campaigns));
}

// Setpoints that are off by chance, but alike in both of their runs, pass for noise beside any smooth function: the
// lack of fit against that noise says nothing, the re-runs do. A single setpoint that is off is not enough: an outlier.
TEST(RerunTest, SeesWhatNoSmoothFunctionFollows) {
  const auto made = [](auto moved) {
    Campaign campaign = sand_campaign();
    measure(campaign, sweep(), {}, fine_noise, 8);
    for (compare::Run& run : campaign.runs) *run.torque += moved(std::stoi(run.setpoint->substr(1)));
    return settled(campaign);
  };
  const Identification scattered = made([](int s) { return 4 * fine_noise[1] * ((s * s + s / 3) % 3 - 1.0); });
  const Identification one_off = made([](int s) { return s == 9 ? 4 * fine_noise[1] : 0.0; });
  const Eigen::Index cells = static_cast<Eigen::Index>(scattered.observations.cells.size());
  EXPECT_LT(against_reruns(scattered).p_value, 1e-4);
  EXPECT_GT(lack_of_fit(scattered.base, scattered.noise, cells).p_value, 10 * against_reruns(scattered).p_value);
  EXPECT_GT(against_reruns(one_off).p_value, 0.05);
}

// A signature's direction has nothing left that the soil could do, and unit length.
TEST(Trace, DirectionsAreOffTheSoilsColumns) {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {}, fine_noise, 9);
  const Identification id = identify(campaign, observe(campaign), {.simulations = 200});
  const WheelPredictor base(campaign, id.observations);
  int seen = 0;
  for (const Signature& s : id.signatures) {
    if (s.projected_norm == 0.0) continue;
    ++seen;
    EXPECT_NEAR(s.direction.norm(), 1.0, 1e-9);
    EXPECT_LT((id.base.columns.transpose() * s.direction).cwiseAbs().maxCoeff(), 1e-6 * id.base.columns.norm());
    EXPECT_LE(s.share_kept, 1.0 + 1e-9);
  }
  EXPECT_GT(seen, 40);
}

// A torque cell zeroed before the first run that warms up as the root of time. About the mean run, a drift's trace is
// far from that and an offset's nearer; counted from the first run the drift's is the nearest of all.
TEST(Trace, SeesADriftFromTheFirstRun) {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {}, fine_noise, 9);
  const double runs = static_cast<double>(campaign.runs.size());
  for (compare::Run& run : campaign.runs) *run.torque -= 25 * std::sqrt(*run.at.run / runs);
  const Identification id = identify(campaign, observe(campaign), {.simulations = 200});
  const auto strongest = [&](const std::string& effect, auto&& counts) {
    double most = 0.0;
    for (const Signature& s : id.signatures)
      if (s.term.form->id == effect && s.projected_norm > 0 && counts(s)) most = std::max(most, s.strength());
    return most;
  };
  const auto any = [](const Signature&) { return true; };
  const auto about_the_mean = [&](const Signature& s) { return s.term.defaults[1] == 0.5 * (runs + 1); };
  const auto from_the_first = [](const Signature& s) { return s.term.defaults[1] == 1.0; };
  EXPECT_LT(strongest("drift", about_the_mean), strongest("sensor_offset", any));
  EXPECT_GT(strongest("drift", from_the_first), strongest("sensor_offset", any));
}

// Under no effect the family-wise p is uniform: of 200 simulated residuals about 5 % fall below 0.05.
TEST(FamilyWiseP, IsUniformWithoutEffects) {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {}, fine_noise, 9);
  const Identification id = identify(campaign, observe(campaign), {.simulations = 200});
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  int small = 0;
  constexpr int trials = 200;
  for (int k = 0; k < trials; ++k) {
    VectorXd e(id.signatures.front().direction.size());
    for (Eigen::Index i = 0; i < e.size(); ++i) e[i] = normal(random);
    double most = 0.0;
    for (const Signature& s : id.signatures) {
      if (s.projected_norm == 0.0) continue;
      const double t = s.direction.dot(e);
      most = std::max(most, s.one_sided ? t : std::abs(t));
    }
    if (family_wise_p(id.signatures, most, 1e6, 300, 1000 + static_cast<std::uint64_t>(k)) < 0.05) ++small;
  }
  EXPECT_GE(small, 2);   // P(X <= 1) = 4e-4 for binomial(200, .05)
  EXPECT_LE(small, 20);  // P(X >= 21) = 1e-3
}

// A residual made of the run number is seen against the run number and nothing else.
TEST(Dependences, FindTheVariable) {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {}, fine_noise, 13);
  const Observations observations = observe(campaign);
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal;
  VectorXd r(static_cast<Eigen::Index>(observations.cells.size()));
  for (std::size_t i = 0; i < observations.cells.size(); ++i) {
    const OperatingCondition& at = observations.rows[static_cast<std::size_t>(observations.cells[i].row)];
    r[static_cast<Eigen::Index>(i)] = normal(random) + (observations.cells[i].channel == torque ? 0.08 * *at.run : 0.0);
  }
  for (const Dependence& d : dependences(observations, r, 499, 1)) {
    if (d.channel == torque && d.variable == "run")
      EXPECT_LE(d.p_value, 0.01);
    else
      EXPECT_GT(d.p_value, 0.002) << d.variable;
  }
}

}  // namespace
}  // namespace soilbin::compare
