// A learned effect: found where the residual follows a smooth function of the conditions, and not where it is noise.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "bekker_wong/learned.hpp"
#include "compare/loop_fixture.hpp"
#include "compare/telling/loop_report.hpp"

namespace soilbin::compare {
namespace {

/// Pull less by a share of the load that bends with slip: 3 % of the load times cos(2 pi s/0.8), as no form does.
Campaign with_bent_pull(std::uint64_t seed, double share) {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {}, fine_noise, seed);
  for (Run& run : campaign.runs)
    *run.drawbar_pull += share * run.at.load * std::cos(2 * std::numbers::pi * run.at.slip / 0.8);
  return campaign;
}

// The weights act through one number of the condition: differenced one by one they give the same slopes.
TEST(LearnedEffect, WeightsHaveOneSlope) {
  const Campaign campaign = with_bent_pull(3, 0.03);
  const Observations observations = observe(campaign);
  for (const char* name : {"drawbar_pull_by_slip", "strength_by_slip"}) {
    const bekker_wong::EffectForm& form = bekker_wong::find_form({"learned", name, {}});
    const bekker_wong::LearnedFunction& function = bekker_wong::learned_function(form);
    Term term = make_term(form, observations, false);
    term.free.clear();
    for (std::size_t k = 0; k < function.degrees.size(); ++k)
      term.free.push_back(static_cast<int>(function.first_weight() + k));
    term.defaults[0] = 1.0, term.defaults[1] = 0.0, term.defaults[2] = 0.8;
    const WheelPredictor one_by_one(campaign, observations, {term});
    term.basis_values = [&](const OperatingCondition& at) {
      return bekker_wong::weighed_products(function, term.defaults, at);
    };
    const WheelPredictor at_once(campaign, observations, {term});
    Eigen::VectorXd theta = at_once.start(), prediction;
    theta.tail(std::ssize(function.degrees)) << 0.01, 0.02, -0.01, 0.0, 0.005;
    BalanceMemory balanced = giving_way();
    ASSERT_TRUE(at_once.predict(theta, prediction, balanced));
    const auto each = one_by_one.linearise(theta, balanced), all = at_once.linearise(theta, balanced);
    ASSERT_TRUE(each && all);
    EXPECT_LT((each->jacobian - all->jacobian).norm(), 1e-5 * each->jacobian.norm()) << name;
    EXPECT_LT((each->entry_angle_slopes - all->entry_angle_slopes).norm(), 1e-5 * each->entry_angle_slopes.norm())
        << name;
  }
}

// The pull's own joint is chosen, over the slips that were run, and the function is the one that was put in: to within
// 1 % of the load at each slip, up to what a change of the soil's values makes as well.
TEST(SlowLearnedEffect, FindsTheFunctionAndItsJoint) {
  const Campaign campaign = with_bent_pull(3, 0.03);
  const FittedModel base = fit_base(campaign, observe(campaign), {});
  const std::vector<LearnedEffect> all = learn_effects(base, {});
  ASSERT_FALSE(all.empty());
  const LearnedEffect& learned = all.front();
  const Term& term = learned.candidate.terms().back();
  EXPECT_TRUE(term.form->form.starts_with("drawbar_pull_by_slip")) << term.form->form;
  EXPECT_EQ(term.defaults[bekker_wong::LearnedFunction::from(0)], 0.05);
  EXPECT_EQ(term.defaults[bekker_wong::LearnedFunction::to(0)], 0.7);
  EXPECT_LT(learned.candidate.fit().chi2, base.fit().chi2 - 30);
  const FittedModel& model = learned.candidate.model;
  const auto pull = [&](double slip) {
    OperatingCondition at;
    at.load = 1000, at.slip = slip, at.position = 1.5, at.run = 20;
    return model.predictor().reading(model.fit().theta, at).drawbar_pull;
  };
  const Campaign bare = with_bent_pull(3, 0.0);
  const FittedModel truth = fit_base(bare, observe(bare), {});
  for (const double slip : {0.12, 0.2, 0.3, 0.42, 0.55}) {
    OperatingCondition at;
    at.load = 1000, at.slip = slip, at.position = 1.5, at.run = 20;
    const double there = truth.predictor().reading(truth.fit().theta, at).drawbar_pull;
    EXPECT_NEAR(pull(slip) - there, 30 * std::cos(2 * std::numbers::pi * slip / 0.8), 10) << slip;
  }
}

// A bent pull, and a sinkage that is read 30 % deeper or less deep along the slip: two functions at two joints, each
// form once.
TEST(SlowLearnedEffect, ASecondFunctionIsLearnedBesideTheFirst) {
  Campaign campaign = with_bent_pull(3, 0.03);
  for (compare::Run& run : campaign.runs)
    *run.sinkage *= std::exp(0.3 * std::sin(2 * std::numbers::pi * run.at.slip / 0.8));
  const FittedModel base = fit_base(campaign, observe(campaign), {});
  const std::vector<LearnedEffect> learned = learn_effects(base, {});
  ASSERT_GE(learned.size(), 2U);
  std::set<std::string> forms, joints;
  for (const Term& term : learned.back().candidate.terms()) {
    EXPECT_TRUE(forms.insert(term.form->form).second) << term.form->form;
    joints.insert(term.form->form.substr(0, term.form->form.find("_by_")));
  }
  EXPECT_TRUE(joints.contains("sinkage")) << *forms.begin();
  EXPECT_TRUE(joints.contains("drawbar_pull")) << *forms.begin();
  EXPECT_LT(learned[1].candidate.fit().chi2, learned[0].candidate.fit().chi2);
}

// Noise alone: whatever is learned does not earn its place in four campaigns of five or more.
TEST(SlowLearnedEffect, NoiseTeachesNothing) {
  int stands = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Campaign campaign = sand_campaign();
    measure(campaign, sweep(), {}, fine_noise, 100 + seed);
    if (!learn_effects(fit_base(campaign, observe(campaign), {}), {}).empty()) ++stands;
  }
  EXPECT_LE(stands, 1);
}

// A pull that grows by 1 % of the load times the square of the place in m is learned as a curve over the place; a
// formula of a term or two does as well, and is the one that was put in: between 0.6 and 2.5 m it rises by 0.01 (6.25 -
// 0.36).
TEST(SlowLearnedEffect, AFormulaOfFewTermsTakesThePlaceOfTheCurve) {
  Campaign campaign = sand_campaign();
  std::vector<OperatingCondition> rows = sweep();  // where a place goes with a slip: here it does not
  for (std::size_t i = 0; i < rows.size(); ++i)
    rows[i].position = 0.5 + 0.37 * static_cast<double>((i / 2 * 3 + i / 14 * 2) % 7);
  measure(campaign, rows, {}, fine_noise, 5);
  for (compare::Run& run : campaign.runs) *run.drawbar_pull += 0.01 * run.at.load * std::pow(*run.at.position, 2);
  const FittedModel base = fit_base(campaign, observe(campaign), {});
  const std::vector<LearnedEffect> learned = learn_effects(base, {});
  ASSERT_FALSE(learned.empty());
  ASSERT_TRUE(learned.front().candidate.terms().back().form->form.starts_with("drawbar_pull_by_"));
  const auto formula = find_formula(base, learned.front(), {});
  ASSERT_TRUE(formula);
  EXPECT_LE(formula->terms.size(), 2U) << formula_text(*formula);
  EXPECT_EQ(formula->joint, "force W_n g along the wheel's plane");
  const auto g = [&](double position) {
    OperatingCondition at;
    at.load = 1000, at.slip = 0.3, at.position = position;
    double sum = 0.0;
    for (std::size_t k = 0; k < formula->terms.size(); ++k)
      sum += formula->weights[k].value * formula->terms[k].value(at);
    return sum;
  };
  EXPECT_NEAR(g(2.5) - g(0.6), 0.01 * (6.25 - 0.36), 0.006) << formula_text(*formula);
}

}  // namespace
}  // namespace soilbin::compare
