// Predictions, their slopes, and the fits that follow these between walls and through soils that give way.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <random>

#include "bekker_wong/contact_stages.hpp"
#include "bekker_wong/effect_vocabulary.hpp"
#include "compare/attribution/base_fit.hpp"
#include "compare/fit/bounded_fit.hpp"
#include "compare/loop_fixture.hpp"
#include "scenario/case.hpp"
#include "scenario/traction_channels.hpp"

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
  BalanceMemory balanced;
  ASSERT_TRUE(predictor.predict(theta, here, balanced));
  const auto slopes = predictor.linearise(theta, balanced);
  ASSERT_TRUE(slopes);
  for (Eigen::Index p = 0; p < theta.size(); ++p) {
    const double step = 1e-3 * predictor.parameters()[static_cast<std::size_t>(p)].scale;
    VectorXd moved = theta;
    moved[p] += step;
    ASSERT_TRUE(predictor.predict(moved, up));
    moved[p] -= 2 * step;
    ASSERT_TRUE(predictor.predict(moved, down));
    const VectorXd slope = (up - down) / (2 * step);
    EXPECT_LT((slopes->jacobian.col(p) - slope).norm(), 2e-4 * slope.norm() + 1e-9)
        << predictor.parameters()[static_cast<std::size_t>(p)].name;
  }
}

/// A campaign of a wheel that, locked, is as heavy as the soil carries at 15 deg yaw.
Campaign braked_campaign() {
  return read_campaign(std::filesystem::path(SOILBIN_SOURCE_DIR) / "cases/measured/cmu-smooth/campaign.yaml", Library(),
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
  const auto slopes = predictor.linearise(theta, here);
  ASSERT_TRUE(slopes);
  const MatrixXd& shortfall_slopes = slopes->shortfall_slopes;
  int giving = 0;
  for (int row = 0; row < predictor.rows(); ++row) {
    const std::size_t r = static_cast<std::size_t>(row);
    if (!(here.shortfall[r] > 0.0)) {
      EXPECT_TRUE(shortfall_slopes.row(row).isZero());
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
      EXPECT_NEAR(shortfall_slopes(row, p), slope,
                  1e-3 * shortfall_slopes.row(row).cwiseAbs().maxCoeff() + 5e-3 * std::abs(slope))
          << predictor.parameters()[static_cast<std::size_t>(p)].name;
    }
  }
  EXPECT_EQ(giving, 3);
}

/// Fits from soils drawn about the declared one; the terms' parameters up to three times their scale.
std::vector<Fit> scattered_fits(const WheelPredictor& predictor, const Dataset& data, int starts) {
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
    if (auto found = fit(predictor, data.observations.values(), data.whitening, start))
      fits.push_back(std::move(*found));
  }
  return fits;
}

// A fit ends where its data put it, not where it came from: through soils that do not carry every row, along theta_m =
// 0.
TEST(SlowFit, EndsAtTheSameChi2FromAnySoilAboutTheDeclaredOne) {
  const Campaign campaign = braked_campaign();
  const FittedModel model = fit_base(campaign, observe(campaign), {});
  const Observations& observations = model.data().observations;
  const WheelPredictor& base = model.predictor();
  const std::vector<Fit> without_effects = scattered_fits(base, model.data(), 8);
  ASSERT_EQ(without_effects.size(), 8U);
  VectorXd prediction;
  for (const Fit& fit : without_effects) {
    EXPECT_NEAR(fit.chi2, model.fit().chi2, 1e-3 * model.fit().chi2);
    EXPECT_TRUE(base.predict(fit.theta, prediction)) << "a row that is not carried";
  }
  const WheelPredictor two = base.with({term_of(observations, "sidewall_bulldozing", "passive_wedge"),
                                        term_of(observations, "slip_sinkage", "sliding")});
  std::vector<double> ends;
  for (const Fit& fit : scattered_fits(two, model.data(), 6)) ends.push_back(fit.chi2);
  std::sort(ends.begin(), ends.end());
  ASSERT_GE(ends.size(), 5U);
  EXPECT_LT(ends[3], ends[0] * (1 + 5e-3));
  EXPECT_LT(ends[0], 0.3 * model.fit().chi2);
}

// The bounds, and theta_m's law up to the largest slip run: c1 + c2 between 0 and max_stress_share where a wheel is
// locked. The declared soil touches no wall from beyond.
TEST(WheelPredictor, WallsOfTheStressAnglesLaw) {
  const Campaign campaign = braked_campaign();
  const Observations observations = observe(campaign);
  const WheelPredictor predictor(campaign, observations);
  const auto inside = [&](double c1, double c2) {
    VectorXd theta = predictor.start();
    theta[6] = c1, theta[7] = c2;
    const std::vector<Wall> walls = predictor.walls();
    return std::all_of(walls.begin(), walls.end(),
                       [&](const Wall& w) { return w.normal.dot(theta) <= w.limit + 1e-12; });
  };
  EXPECT_TRUE(inside(campaign.soil.stress_angle_c1.value, campaign.soil.stress_angle_c2.value));
  EXPECT_TRUE(inside(0.4, -0.4) && inside(0.4, 0.58));
  EXPECT_FALSE(inside(0.4, -0.41) || inside(0.4, 0.59) || inside(-0.1, 0.3));
}

// theta_m = (c1 + c2 |s|) theta_1 is held at 0 for a locked wheel where c1 + c2 < 0: a kink that no fit may hang on.
TEST(SlowFit, KeepsTheStressAngleWhereItsLawPutsIt) {
  const Campaign campaign = braked_campaign();
  const FittedModel base = fit_base(campaign, observe(campaign), {});
  const bekker_wong::SoilValues soil = base.predictor().soil(base.fit().theta);
  EXPECT_GE(soil.c1 + soil.c2, -1e-9);
  EXPECT_LE(soil.c1 + soil.c2, bekker_wong::max_stress_share + 1e-9);
}

/// Noise of this sd in force and torque, and of a thousandth of it in sinkage.
Whitening even_noise(const Observations& observations, double sd) {
  NoiseFloor noise;
  for (ChannelNoise& c : noise.channels) c = {.measured = true, .floor = sd};
  noise.channels[sinkage].floor = 1e-3 * sd;
  return {observations, noise, observations.values()};
}

// A start beyond a wall is moved to it, and every step keeps inside.
TEST(Fit, StartsInsideItsWalls) {
  const Campaign campaign = braked_campaign();
  const Observations observations = observe(campaign);
  const WheelPredictor predictor(campaign, observations);
  const VectorXd values = observations.values();
  const Whitening whitening = even_noise(observations, 3.0);
  Descent descent(predictor, values, whitening);
  VectorXd start = predictor.start();
  start[6] = 0.4, start[7] = -0.9;
  ASSERT_TRUE(descent.move_to(start, true));
  const auto outside = [&] {
    double most = 0.0;
    for (const Wall& w : predictor.walls()) most = std::max(most, w.normal.dot(descent.theta()) - w.limit);
    return most;
  };
  EXPECT_LE(outside(), 1e-9);
  EXPECT_LT(descent.theta()[7], 0.0) << "moved farther than to the wall";
  const double before = descent.line().residual.squaredNorm();
  descent.minimise();
  EXPECT_LT(descent.line().residual.squaredNorm(), before);
  EXPECT_LE(outside(), 1e-9);
}

// A soil whose k_phi is known is made firmer by its other values.
TEST(Fit, CarriesEveryRowWithoutAFreeModulus) {
  Campaign campaign = braked_campaign();
  campaign.soil.k_phi.std_error = campaign.soil.k_c.std_error = 0.0;
  const Observations observations = observe(campaign);
  const WheelPredictor predictor(campaign, observations);
  VectorXd prediction;
  ASSERT_FALSE(predictor.predict(predictor.start(), prediction)) << "the declared soil carries all: nothing to show";
  const auto found = fit(predictor, observations.values(), even_noise(observations, 3.0), predictor.start());
  ASSERT_TRUE(found);
  EXPECT_TRUE(predictor.predict(found->theta, prediction));
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

// Bounds hold: a truth without cohesion, with less friction than is known for sure, pulls c below 0; it stops there.
TEST(Fit, StopsAtBounds) {
  Campaign campaign = sand_campaign();
  campaign.soil.cohesion.value = 0.0, campaign.soil.friction_angle.value = 25 * degree;
  measure(campaign, sweep(), {}, fine_noise, 5, 0.0);
  campaign.soil.cohesion = {200.0, 300}, campaign.soil.friction_angle = {28 * degree, 0.01 * degree};
  const FittedModel base = fit_base(campaign, observe(campaign), {});
  ASSERT_EQ(base.predictor().parameters()[3].name, "cohesion");
  EXPECT_EQ(base.fit().theta[3], 0.0);
}

// What a bound holds has the error that it would have if it could move: that of the inverse Gram matrix with its
// column.
TEST(Fit, TellsTheErrorOfWhatABoundHolds) {
  constexpr int cohesion = 3;
  Campaign campaign = sand_campaign();
  std::optional<FittedModel> base;
  for (std::uint64_t seed = 1; seed < 10 && (!base || base->fit().theta[cohesion] > 0.0); ++seed) {
    campaign.soil.cohesion = {0.0, 300};
    measure(campaign, sweep(), {}, fine_noise, seed, 0.0);  // noise pulls half of them below 0
    campaign.soil.cohesion = {10.0, 300};
    base = fit_base(campaign, observe(campaign), {});
  }
  ASSERT_EQ(base->standard_errors()[cohesion], 0.0);
  const Fit& fit = base->fit();
  VectorXd column = VectorXd::Zero(fit.columns.rows());
  column.head(fit.jacobian.rows()) = base->data().whitening(VectorXd(fit.jacobian.col(cohesion)));
  MatrixXd all(column.size() + 1, fit.columns.cols() + 1);  // and the row of its own prior
  all << fit.columns, column, Eigen::RowVectorXd::Zero(fit.columns.cols()), 1.0 / 300;
  const double variance = (all.transpose() * all).inverse().diagonal().tail(1)[0];
  EXPECT_NEAR(base->held_error(cohesion), std::sqrt(variance), 1e-6 * std::sqrt(variance));
}

// var(f) = J C J': what the fit says of its prediction, the file that it writes says too. Taken one by one the values'
// standard deviations would say far more, for n, k_c and k_phi err together.
TEST(FittedErrors, AreThoseOfTheFitWhenReadFromItsFile) {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {{"slip_sinkage", "lyasko", {{"a", 0.8}}}}, fine_noise, 11);
  const FittedModel base = fit_base(campaign, observe(campaign), {});
  const Term term = make_term(bekker_wong::find_form({"slip_sinkage", "lyasko", {}}), base.data().observations, false);
  const WheelPredictor wider = base.predictor().with({term});
  VectorXd start = wider.start();
  start.head(base.fit().theta.size()) = base.fit().theta;
  const auto model = fitted(base.shared_data(), wider, start);
  ASSERT_TRUE(model);
  Case written;
  written.name = "fitted";
  written.scenario = scenario_of(campaign);
  written.scenario.effects.clear();
  written.scenario.soil.semi_empirical = model->soil();
  written.study.models = {
      {ModelKind::bekker_wong, model->predictor().choices(model->fit().theta), "fitted", model->errors()}};
  written.study.conditions = {campaign.runs[3].at, campaign.runs.back().at};
  const bekker_wong::CatalogueVocabulary words;
  const Case read = parse_case(make_source_text(write_case(written, words), "fitted.yaml"), Library(), words);
  const Scenario scenario = seen_by(read.study.models.front(), read.scenario);
  ASSERT_EQ(scenario.errors.back().parameter, "slip_sinkage.a");
  const Observations& runs = base.data().observations;
  const auto forecast = model->forecast(runs);
  ASSERT_TRUE(forecast);
  double largest = 0.0;
  for (std::size_t i = 0; i < runs.cells.size(); ++i) {
    const Cell& cell = runs.cells[i];
    const OperatingCondition& at = runs.rows[static_cast<std::size_t>(cell.row)];
    const TractionResult result = bekker_wong::BekkerWong().evaluate(scenario, at);
    const double error = (result.*traction_channels[static_cast<std::size_t>(cell.channel)].predicted).std_error;
    const double expected = std::sqrt(forecast->variance(static_cast<Eigen::Index>(i)));
    EXPECT_NEAR(error, expected, 0.01 * expected) << "slip " << at.slip << ", channel " << cell.channel;
    Scenario apart = scenario;
    apart.errors.clear();
    const TractionResult independent = bekker_wong::BekkerWong().evaluate(apart, at);
    if (cell.channel == sinkage) largest = std::max(largest, independent.sinkage.std_error / error);
  }
  EXPECT_GT(largest, 3.0);
}

/// A pneumatic tire at three pressures, its carcass declared at 20 +- 30 kPa, where it carries 58.
Campaign pneumatic_campaign(const std::vector<EffectChoice>& more, std::uint64_t seed) {
  Campaign campaign = sand_campaign();
  campaign.effects = {{"tire_flexibility", "flat_section", {}}};
  std::vector<OperatingCondition> rows = sweep();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].inflation_pressure = std::array{10e3, 25e3, 60e3}[i / 2 % 3];
    rows[i].pass = 1;
  }
  std::vector<EffectChoice> truth = campaign.effects;
  truth.insert(truth.end(), more.begin(), more.end());
  campaign.wheel.inflation_pressure = 25e3;
  campaign.wheel.carcass_pressure = Estimate{58e3, 0.0};
  measure(campaign, rows, truth, fine_noise, seed);
  campaign.wheel.carcass_pressure = Estimate{20e3, 30e3};
  return campaign;
}

// The carcass pressure is fitted beside the soil, told with it, and saved with the wheel.
TEST(BaseFit, FindsTheCarcassPressure) {
  const Campaign campaign = pneumatic_campaign({}, 5);
  const FittedModel base = fit_base(campaign, observe(campaign), {});
  const int last = base.predictor().soil_parameters() - 1;
  EXPECT_EQ(base.predictor().parameters()[static_cast<std::size_t>(last)].name, "carcass_pressure");
  const Estimate found = *base.wheel().carcass_pressure;
  EXPECT_GT(found.std_error, 0.0);
  EXPECT_LT(found.std_error, 10e3);
  EXPECT_NEAR(found.value, 58e3, 3 * found.std_error);
  const auto& errors = base.errors();
  EXPECT_TRUE(std::ranges::any_of(errors, [](const FittedError& e) { return e.parameter == "carcass_pressure"; }));
  EXPECT_EQ(base.soil().exponent.value, base.fit().theta[0]);
}

// Where n is fitted about a reference sinkage, the pressure there is k's alone, and the fitted soil says what the wheel
// was given.
TEST(BaseFit, MovesAnExponentAboutItsReferenceSinkage) {
  Campaign campaign = pneumatic_campaign({}, 5);
  campaign.soil.reference_sinkage = 0.04;
  const Observations runs = observe(campaign);
  const WheelPredictor predictor(campaign, runs);
  Eigen::VectorXd theta = predictor.start();
  const auto pressure = [&] {
    const bekker_wong::SoilValues soil = predictor.soil(theta);
    return soil.pressure_modulus(0.1) * std::pow(0.04, soil.exponent);
  };
  const double declared = pressure();
  theta[0] += 0.2;
  EXPECT_NEAR(pressure(), declared, 1e-12 * declared);
}

// Nothing hears of a carcass without the effect; nor is it free where it counts as exact.
TEST(BaseFit, LeavesTheCarcassPressureWhereNothingReadsIt) {
  Campaign campaign = pneumatic_campaign({}, 5);
  const Observations runs = observe(campaign);
  EXPECT_EQ(WheelPredictor(campaign, runs).soil_parameters(), 9);
  campaign.effects.clear();
  EXPECT_EQ(WheelPredictor(campaign, runs).soil_parameters(), 8);
}

}  // namespace
}  // namespace soilbin::compare
