// The loop's parts, each against what it must be: noise, signatures, p-values.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "compare/loop/base_fit.hpp"
#include "compare/loop/detection.hpp"
#include "compare/loop/identify.hpp"
#include "compare/loop_fixture.hpp"
#include "compare/measured/condition_views.hpp"

namespace soilbin::compare {
namespace {

using Eigen::VectorXd;

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
        << channel_views[static_cast<std::size_t>(c)].name;
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
    // The prior's rows of d are 0, and P is a symmetric projector: (P d/|P d|)'d = |P d|.
    const double kept = s.direction.head(s.white.size()).dot(s.white);
    EXPECT_NEAR(kept, s.projected_norm, 1e-6 * s.white.norm());
    EXPECT_NEAR(s.share_kept, kept / s.white.norm(), 1e-6);
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
  int others = 0;
  std::optional<double> on_the_run;
  for (const Dependence& d : dependences(observations, r, 499, 1)) {
    if (d.channel == torque && d.variable == "run") {
      on_the_run = d.p_value;
    } else {
      ++others;
      EXPECT_GT(d.p_value, 0.002) << d.variable;
    }
  }
  ASSERT_TRUE(on_the_run);
  EXPECT_LE(*on_the_run, 0.01);
  EXPECT_GE(others, 5) << "load, slip and run, each in four channels or three";
}

}  // namespace
}  // namespace soilbin::compare
