// The one list of doubts: what is told, the words of each kind of place, and that ordinary questions raise none.
#include "compare/doubts/doubts.hpp"

#include <fmt/core.h>
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <set>

#include "compare/doubt_matchers.hpp"
#include "compare/doubts/grain_doubts.hpp"
#include "compare/doubts/grain_resolution.hpp"
#include "compare/modelled_campaign.hpp"
#include "tests/fixtures.hpp"

namespace soilbin::compare {
namespace {

using test::condition;
using test::tells;
using test::wheel_on_sand;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// Every kind, in the order of the table.
std::vector<DoubtKind> all_kinds() {
  std::vector<DoubtKind> all;
  for (int k = 0; k <= static_cast<int>(DoubtKind::grains_left_out); ++k) all.push_back(static_cast<DoubtKind>(k));
  return all;
}

// A sentence that is no format, or takes a format that its numbers do not have, throws.
TEST(DoubtSentences, EachKindHasAWordAndASentenceThatTakesNumbersAndTexts) {
  std::set<std::string_view> words;
  for (const DoubtKind kind : all_kinds()) {
    const Doubt numbers{kind, std::vector<Said>(9, 3)}, texts{kind, std::vector<Said>(9, "text")};
    for (const std::string& told : {in_words(numbers), in_words(texts)})
      EXPECT_THAT(told, AllOf(Not(IsEmpty()), Not(HasSubstr("{:")), Not(HasSubstr(":?")))) << kind_word(kind);
    EXPECT_TRUE(words.insert(kind_word(kind)).second) << kind_word(kind);
    EXPECT_EQ(kind_word(kind).find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_"), std::string_view::npos);
  }
}

TEST(DoubtSentences, NameTheirPlaceAndLeaveOutClausesThatSayNothing) {
  Doubt slides{DoubtKind::slides_across, {36.25, 14.4, 1037.9}, condition(80, 0.2)};
  EXPECT_EQ(in_words(slides),
            "the wheel slides down the cross slope at load 80 N, slip 20 %: 36.2 N of the load act down it, with a "
            "thrust of 14.4 N, and the soil shears at 1.04 kN (c, phi)");
  slides.says[1] = "", slides.others = 1;
  EXPECT_THAT(in_words(slides),
              HasSubstr("act down it, and the soil shears at 1.04 kN (c, phi) (and at 1 other condit"));
  slides.at.reset(), slides.line = 7, slides.of = "study";
  EXPECT_THAT(in_words(slides), testing::StartsWith("study: line 7: the wheel slides down the cross slope: 36.2 N"));
  const Doubt flat{
      .kind = DoubtKind::flattens, .says = {100, 20, "", ""}, .at = condition(80, 0.2), .error = "too soft"};
  EXPECT_EQ(in_words(flat),
            "the tire flattens at load 80 N, slip 20 % (inflation 100 kPa and carcass 20 kPa), and carries no more "
            "there: too soft");
  EXPECT_EQ(as_remark({slides, {DoubtKind::unsteady_runs, {1, 1, 3.71}}}).find("line"), std::string::npos);
  EXPECT_EQ(as_remark({{DoubtKind::unsteady_runs, {1, 1, 3.71}}, {DoubtKind::unsteady_runs, {2, 3, 4}}}),
            "1 of 1 run not steady (drift up to 3.7 standard errors): lengthen the run; 2 of 3 runs not steady (drift "
            "up to 4.0 standard errors): lengthen the run");
}

// The subject is text: numbers, places and a model's errors may differ.
TEST(DoubtSentences, AreAlikeByTheirKindAndTheirSubject) {
  const Doubts once = once_each({{DoubtKind::beyond_learned, {"form", "load"}, condition(80, 0.2)},
                                 {DoubtKind::beyond_learned, {"form", "slip"}, condition(80, 0.2)},
                                 {DoubtKind::beyond_learned, {"form", "load"}, condition(90, 0.2)},
                                 {.kind = DoubtKind::no_solution, .at = condition(1, 0), .error = "soft"},
                                 {.kind = DoubtKind::no_solution, .at = condition(2, 0), .error = "deep"}});
  EXPECT_THAT(once, ElementsAre(Field(&Doubt::others, 1U), Field(&Doubt::others, 0U), Field(&Doubt::others, 1U)));
}

TEST(Doubts, EachKindOfWarningIsSaidOnce) {
  Case question;
  question.scenario = wheel_on_sand();
  question.study.models = {ModelChoice{}};
  for (const double load : {1e6, 2e6, 3e6}) question.study.conditions.push_back(condition(load, 0.2));
  const Doubts told = doubts(question);
  ASSERT_THAT(told, ElementsAre(tells(DoubtKind::no_solution)));
  EXPECT_EQ(told[0].at, question.study.conditions[0]);
  EXPECT_EQ(told[0].others, 2U);
}

// The wedge in front of a bulldozing wheel weighs what its soil does; a wheel without effects asks no density.
TEST(Doubts, APresumedDensityIsToldWhereAnAnswerHangsOnIt) {
  Case question;
  question.scenario = wheel_on_sand();
  question.scenario.soil.semi_empirical->density.reset();
  question.study.models = {ModelChoice{}};
  question.study.conditions = {condition(80, 0.2)};
  EXPECT_TRUE(doubts(question).empty());
  const EffectChoice bulldozing{"bulldozing", "hegedus", {{"a", 1.0}}};
  question.study.models[0].effects = {bulldozing};
  EXPECT_THAT(doubts(question), ElementsAre(tells(DoubtKind::density_assumed, {1500})));
  question.scenario.soil.semi_empirical->density = 1600;
  EXPECT_TRUE(doubts(question).empty());
}

TEST(Doubts, AHardLayersDepthIsTheBinsWhereThatIsDeclared) {
  Case question;
  question.scenario = wheel_on_sand();
  question.scenario.bin = Bin{.depth = 0.09};
  question.study.models = {ModelChoice{}};
  question.study.models[0].effects = {{"hard_layer", "hyperbolic", {{"a", 1.0}, {"depth", 0.2}}}};
  question.study.conditions = {condition(80, 0.2)};
  EXPECT_THAT(doubts(question), Contains(tells(DoubtKind::bin_depth_taken, {"hard_layer", 90, "depth", 200})));
  question.scenario.bin.reset();
  EXPECT_TRUE(doubts(question).empty());
}

std::vector<std::string> keys_of_unused(const Case& question) {
  std::vector<std::string> keys;
  for (const Doubt& one : unused_inputs(question)) keys.push_back(std::get<std::string>(one.says.at(0)));
  return keys;
}

TEST(Doubts, WhatNoModelHearsOfIsTold) {
  Case question;
  question.scenario = wheel_on_sand();
  question.study.models = {ModelChoice{}};
  question.study.conditions = {condition(80, 0.2)};
  EXPECT_THAT(keys_of_unused(question), IsEmpty());
  question.study.conditions[0].speed = 2;
  EXPECT_THAT(keys_of_unused(question), ElementsAre("speed"));
  question.study.rotations = {10.0};
  EXPECT_THAT(keys_of_unused(question), IsEmpty()) << "it follows from the rotation";
  question.study.rotations.clear(), question.study.conditions[0].speed = OperatingCondition{}.speed;
  question.scenario.tire.lugs.height = 0.01;
  question.study.conditions[0].pass = 2;
  question.study.conditions[0].moisture = 0.05;
  EXPECT_THAT(keys_of_unused(question), ElementsAre("lugs", "pass", "moisture"));
  question.study.models.push_back({ModelKind::dem, {}, ""});
  EXPECT_THAT(keys_of_unused(question), ElementsAre("lugs", "pass", "moisture")) << "the wheel beside them doesn't";
  question.study.models.push_back({ModelKind::bekker_wong, {{"moisture", "", {}}, {"drift", "", {}}}, ""});
  EXPECT_THAT(keys_of_unused(question), ElementsAre("lugs", "pass", "moisture", "run"))
      << "grains don't hear of moisture; drift without a run";
  question.study.models = {{ModelKind::dem, {}, ""}};
  EXPECT_THAT(keys_of_unused(question), ElementsAre("moisture")) << "grains alone hear of lugs and passes";
}

TEST(Doubts, ACampaignsRepeatedRowsAndFlippedPullAreTold) {
  const Campaign good = modelled_campaign();
  EXPECT_THAT(doubts(good), IsEmpty());
  Campaign flipped = good;
  for (auto& run : flipped.runs) *run.drawbar_pull *= -1;
  EXPECT_THAT(doubts(flipped), ElementsAre(tells(DoubtKind::flipped_sign, {"", "drawbar_pull"})));
  Campaign copied = good;
  copied.runs.push_back(copied.runs[1]);
  copied.runs.back().csv_line = 10;
  copied.runs.push_back(copied.runs[2]);
  copied.runs.back().csv_line = 11;
  EXPECT_THAT(in_words(doubts(copied)),
              ElementsAre("line 10: all its values are those of line 3: counted twice (and at 1 other line)"));
  Campaign renumbered = good;
  const auto copy_renumbered = [&](std::size_t i) {
    renumbered.runs.push_back(good.runs[i]);
    renumbered.runs.back().at.run = 100 + static_cast<int>(i);
  };
  copy_renumbered(0);
  EXPECT_THAT(doubts(renumbered), IsEmpty()) << "one re-run may read the same, rounded as it is";
  for (std::size_t i = 1; i < 8; ++i) copy_renumbered(i);
  EXPECT_THAT(doubts(renumbered), ElementsAre(tells(DoubtKind::renumbered_rows, {8, 16})));
  copied.runs.resize(9);
  copied.runs.back().at.run = 2, *copied.runs.back().torque += 1;
  EXPECT_THAT(doubts(copied), ElementsAre(tells(DoubtKind::repeated_number, {2, 3})));
}

TEST(Doubts, WarningsOfOneKindOfManyRowsAreOneLine) {
  Campaign campaign = modelled_campaign();
  for (auto& run : campaign.runs) *run.sinkage += 1.0;
  EXPECT_THAT(doubts(campaign), Contains(AllOf(tells(DoubtKind::sinkage_beyond_wheel), Field(&Doubt::others, 7U))));
}

// Point by point: a flattening tire needs its effect; grains meet a rigid one.
TEST(Doubts, InflationIsHeardByAFlexibleTireAlone) {
  Case question;
  question.scenario = wheel_on_sand();
  question.scenario.tire.inflation_pressure = 1e5;
  question.study.models = {ModelChoice{}};
  question.study.conditions = {condition(80, 0.2)};
  EXPECT_THAT(doubts(question, {}), ElementsAre(tells(DoubtKind::inflation_ignored)));
  question.study.models[0].effects = {{"tire_flexibility", "", {}}};
  EXPECT_THAT(keys_of_unused(question), IsEmpty());
  question.study.models = {{ModelKind::dem, {}, ""}};
  EXPECT_THAT(keys_of_unused(question), ElementsAre("inflation_pressure"));
}

TEST(Doubts, WhatAnEffectPresumesOfTheTireIsToldUntilItIsDeclared) {
  Case question;
  question.scenario = wheel_on_sand();
  question.scenario.tire.radius = 0.25;
  question.scenario.tire.width = 0.1;
  question.study.models = {{ModelKind::bekker_wong, {{.id = "lug_thrust", .form = "", .parameters = {}}}, ""}};
  OperatingCondition& at = question.study.conditions.emplace_back();
  at.load = 1000, at.slip = 0.2;
  const auto presumes = [&] { return tell_of(doubts(question), DoubtKind::presumed); };
  EXPECT_TRUE(presumes());
  question.scenario.tire.lugs.height = 0.0125;
  question.scenario.tire.lugs.count = 24;
  EXPECT_FALSE(presumes());
}

// Before the answer and with it: the same words, each kind once.
TEST(Doubts, ADeepWheelIsDoubtedWithItsAnswerAsWithoutIt) {
  Case question;
  question.scenario = wheel_on_sand();
  question.study.models = {ModelChoice{}};
  for (const double load : {80.0, 600.0, 800.0}) question.study.conditions.push_back(condition(load, 0.2));
  const std::vector<ModelAnswers> study = run_study(question);
  ASSERT_LT(study[0].answers[0].result->sinkage.value, 0.5 * 0.11);
  ASSERT_GT(study[0].answers[1].result->sinkage.value, 0.5 * 0.11);
  const Doubts answered = doubts(question, study);
  EXPECT_EQ(answered, doubts(question));
  EXPECT_THAT(in_words(answered), Contains(AllOf(HasSubstr("% of its radius at load 600 N"),
                                                 HasSubstr(": unreliable above 50 % (and at 1 other condition)"))));
  EXPECT_EQ(remark_on(question.scenario, question.study.models[0], study[0].answers[1]),
            fmt::format("the wheel sinks {:.0f} % of its radius: unreliable above 50 %",
                        100 * study[0].answers[1].result->sinkage.value / 0.11))
      << "its row names the condition";
}

// Without cohesion a soil of phi = 28 deg holds a wheel without thrust on cross slopes up to phi; 1 kPa on a contact of
// 0.1 m by 5 cm adds some 5 N to the 38 N that friction gives, which hold it with its thrust too.
TEST(Doubts, ACrossSlopeSteeperThanTheSoilHoldsIsTold) {
  Case question;
  question.scenario = wheel_on_sand();
  SemiEmpiricalSoil& soil = *question.scenario.soil.semi_empirical;
  soil.friction_angle.value = 28 * degree;
  question.study.models = {ModelChoice{}};
  const auto told_at = [&](double cross_slope, double cohesion) {
    soil.cohesion.value = cohesion;
    question.study.conditions = {condition(80, 0.2)};
    question.study.conditions[0].transverse_incline = cross_slope * degree;
    return doubts(question);
  };
  EXPECT_THAT(told_at(24, 0), IsEmpty());
  EXPECT_THAT(told_at(27, 0), ElementsAre(tells(DoubtKind::slides_across, {36.3, 14.4, 37.9})))
      << "both together are more than 80 N cos 27 deg tan 28 deg = 37.9 N";
  EXPECT_THAT(told_at(29, 0),
              ElementsAre(tells(DoubtKind::slides_across, {38.8, ""}), tells(DoubtKind::slope_slides, {28})));
  EXPECT_THAT(told_at(-29, 0), ElementsAre(tells(DoubtKind::slides_across, {38.8}),
                                           tells(DoubtKind::slope_slides, {28})));  // 80 N sin 29 deg
  EXPECT_THAT(told_at(28, 1000), IsEmpty());
  EXPECT_THAT(told_at(60, 1000), ElementsAre(tells(DoubtKind::slides_across)));
}

TEST(Doubts, MorePowerOutThanInIsTold) {
  Case question;
  question.scenario = wheel_on_sand();
  question.study.models = {ModelChoice{}};
  question.study.conditions = {condition(80, 0.2)};
  std::vector<ModelAnswers> study = run_study(question);
  EXPECT_THAT(doubts(question, study), IsEmpty());
  study[0].answers[0].result->tractive_efficiency = 1.01;
  EXPECT_THAT(doubts(question, study), ElementsAre(tells(DoubtKind::power_from_nothing)));
}

TEST(Doubts, ACampaignWithoutASinkageOverlooksEffects) {
  Campaign campaign = modelled_campaign();
  campaign.runs.front().sinkage.reset();
  EXPECT_FALSE(tell_of(doubts(campaign), DoubtKind::no_sinkage)) << "some have one";
  for (auto& run : campaign.runs) run.sinkage.reset();
  EXPECT_TRUE(tell_of(doubts(campaign), DoubtKind::no_sinkage));
  EXPECT_THAT(of_mistaken_columns(doubts_before_fit(campaign)), IsEmpty()) << "a verdict holds all the same";
}

TEST(Doubts, MostSinkagesNegativeMeansAFlippedSign) {
  Campaign campaign = modelled_campaign();
  for (auto& run : campaign.runs) *run.sinkage *= -1;
  EXPECT_THAT(doubts(campaign), ElementsAre(tells(DoubtKind::sinkage_flipped, {8, 8})));
  for (std::size_t i = 0; i < 4; ++i) *campaign.runs[i].sinkage *= -1;
  EXPECT_THAT(doubts(campaign), IsEmpty()) << "half of them may stand above the surface";
  for (auto& run : campaign.runs) run.sinkage.reset();
  EXPECT_THAT(doubts(campaign), ElementsAre(tells(DoubtKind::no_sinkage))) << "what was not measured has no sign";
}

TEST(Doubts, OfACampaignAreThoseOfTheModelThatAnswers) {
  Campaign campaign = modelled_campaign();
  campaign.wheel.lugs.height = 0.01;
  campaign.soil.density = 9000;  // as declared
  const Scenario declared = scenario_of(campaign);
  Scenario fitted = declared;
  fitted.soil.semi_empirical->density = 1600;
  fitted.effects = {{"lug_thrust", "", {}}};
  const auto model = make_model(ModelKind::bekker_wong);
  EXPECT_THAT(doubts(campaign, declared, predict(*model, declared, campaign)),
              ElementsAre(tells(DoubtKind::unusual_density), tells(DoubtKind::lugs_ignored)));
  EXPECT_THAT(doubts(campaign, fitted, predict(*model, fitted, campaign)), IsEmpty());
  EXPECT_THAT(doubts_before_fit(campaign), ElementsAre(tells(DoubtKind::unusual_density))) << "a fit tries lugs";
}

/// The paper's tire on its grains of 30 to 50 mm, 0.25 mm deep at 4 kN.
Case papers_case() {
  Case question;
  question.scenario = wheel_on_sand();
  Tire& tire = question.scenario.tire;
  tire.radius = 0.496, tire.width = 0.305, tire.lugs.height = 0.011;
  GranularSoil grains;
  grains.radius_min = 0.015, grains.radius_max = 0.025;
  question.scenario.soil.granular = grains;
  question.study.models = {{ModelKind::dem, {}, ""}};
  question.study.conditions = {condition(4000, 0.2)};
  return question;
}

std::vector<ModelAnswers> answer_of_grains(double sinkage) {
  TractionResult result;
  result.sinkage.value = sinkage;
  return {{{ModelKind::dem, {}, ""}, {{condition(4000, 0.2), result, ""}}}};
}

// 305 mm and 11 mm over 40 mm; the contact is 496 mm acos(1 - 0.25/496) = 15.75 mm long.
TEST(Doubts, ThePapersStraightCaseHasCoarseGrains) {
  const Case question = papers_case();
  const GrainCounts counts = count_grains(question.scenario, answer_of_grains(0.25e-3));
  EXPECT_NEAR(counts.width, 305 / 40.0, 1e-12);
  EXPECT_NEAR(*counts.lug, 11 / 40.0, 1e-12);
  EXPECT_NEAR(*counts.contact, 496 * std::acos(1 - 0.25 / 496) / 40, 1e-12);
  EXPECT_THAT(in_words(doubts(question, answer_of_grains(0.25e-3))),
              Contains(HasSubstr("Mean diameter 40 mm: 7.6 across its width (10 wanted), 0.39 along its contact (10), "
                                 "0.27 in a lug's height (1). See docs/lab/grain-size.md")));
}

// The study of grain sizes speaks of this wheel at 20 % slip, 11 mm deep; of no wheel at all at 90 %.
TEST(Doubts, CoarseGrainsAreToldWithWhatTheyDoToTheAnswer) {
  const Case question = papers_case();
  std::vector<ModelAnswers> answers = answer_of_grains(0.011);
  const ResolutionError error = resolution_error(question.scenario, answers[0].answers[0].at, 0.011);
  EXPECT_THAT(doubts(question, answers), Contains(tells(DoubtKind::coarse_grains, {in_words(error), ""})));
  answers[0].answers[0].at.slip = 0.9;
  EXPECT_THAT(in_words(doubts(question, answers)), Contains(HasSubstr("the error is unknown, since slip 90 %")));
}

TEST(Doubts, GrainsAreCoarseByEachOfTheirLengths) {
  Case question = papers_case();
  question.scenario.soil.granular->rolling_resistance = RollingResistance::elastic_plastic;
  const auto told = [&](double radius, double width, double lugs) {
    question.scenario.soil.granular->radius_min = question.scenario.soil.granular->radius_max = radius;
    question.scenario.tire.width = width, question.scenario.tire.lugs.height = lugs;
    return in_words(doubts(question, answer_of_grains(0.01)));  // 99.8 mm of contact
  };
  EXPECT_THAT(told(0.004, 0.1, 0.0), IsEmpty()) << "12.5 grains each way under a smooth wheel";
  EXPECT_THAT(told(0.004, 0.07, 0.0), ElementsAre(HasSubstr("8.8 across its width")));
  EXPECT_THAT(told(0.006, 0.2, 0.0), ElementsAre(HasSubstr("8.3 along its contact")));
  EXPECT_THAT(told(0.004, 0.1, 0.007), ElementsAre(HasSubstr("0.88 in a lug's height (1)")));
  EXPECT_THAT(told(0.02, 0.16, 0.0), ElementsAre(HasSubstr("Mean diameter 40 mm: 4 across its width")));
}

// Ordinary grains under a wheel of 100 mm width: none of the values is odd.
Case sand_and_wheel() {
  Case question = papers_case();
  question.scenario.tire.radius = 0.12, question.scenario.tire.width = 0.1, question.scenario.tire.lugs.height = 0;
  question.scenario.soil.semi_empirical.reset();
  question.study.conditions = {condition(80, 0.1)};
  GranularSoil& grains = *question.scenario.soil.granular;
  grains.radius_min = 0.002, grains.radius_max = 0.003, grains.grain_density = 2650, grains.youngs_modulus = 5e6;
  grains.poisson_ratio = 0, grains.rolling_resistance = RollingResistance::elastic_plastic;
  grains.grain_grain = {}, grains.grain_tire = {};
  return question;
}

TEST(Doubts, ValuesThatNoGrainHasAreTold) {
  const Case ordinary = sand_and_wheel();
  EXPECT_THAT(doubts(ordinary, {}), IsEmpty());
  const auto told = [&](const auto& change) {
    Case question = ordinary;
    change(*question.scenario.soil.granular);
    return doubts(question, {});
  };
  using G = GranularSoil;
  EXPECT_THAT(told([](G& g) { g.grain_density = 2.65; }),
              ElementsAre(tells(DoubtKind::grain_density_in_g_cm3, {2.65})));
  EXPECT_THAT(told([](G& g) { g.grain_density = 20000; }), ElementsAre(tells(DoubtKind::unusual_grain_density)));
  EXPECT_THAT(told([](G& g) { g.grain_grain.sliding_friction = 5; }),
              ElementsAre(tells(DoubtKind::unusual_sliding_friction, {"grain_grain", 5})));
  EXPECT_THAT(told([](G& g) { g.grain_tire.sliding_friction = 5; }),
              ElementsAre(tells(DoubtKind::unusual_sliding_friction, {"grain_tire", 5})));
  EXPECT_THAT(told([](G& g) { g.radius_min = 0.0003, g.radius_max = 0.004; }),
              ElementsAre(tells(DoubtKind::wide_grain_radii, {0.004 / 0.0003})));
}

// 80 N over 100 mm and half of 120 mm: 13.3 kPa, and 2.39 (13.3/(E/2))^(2/3) of a radius. For E = 5 MPa that is 0.073;
// it is 0.2 for 1.1 MPa and 1.57 for 50 kPa.
TEST(Doubts, GrainsTooSoftForTheWheelAreTold) {
  Case question = sand_and_wheel();
  double& young = question.scenario.soil.granular->youngs_modulus;
  young = 1.15e6;
  EXPECT_THAT(doubts(question, {}), IsEmpty());
  young = 1.09e6;
  EXPECT_THAT(doubts(question, {}), ElementsAre(tells(DoubtKind::soft_grains, {1.09e6, 0.2011})));
  young = 50e3;
  EXPECT_THAT(
      in_words(doubts(question, {})),
      ElementsAre(AllOf(HasSubstr("50 kPa, are pressed into each other by more than their radius"),
                        HasSubstr("wheel's 13 kPa (load 80 N"), HasSubstr("youngs_modulus of 1.1 MPa or more"))));
}

// Hertz's 4/3 E* sqrt(R*) delta^1.5 holds pi k R* delta at delta/R* = (3 pi k/(4 E*))^2: for E* = 2.5 MPa and 0.2 of a
// radius, 0.4 R*, at k = 671 kJ/m^3.
TEST(Doubts, CohesionThatPressesGrainsTogetherIsTold) {
  Case question = sand_and_wheel();
  double& cohesion = question.scenario.soil.granular->grain_grain.cohesion;
  cohesion = 660e3;
  EXPECT_THAT(doubts(question, {}), IsEmpty());
  cohesion = 99999e3;
  EXPECT_THAT(doubts(question, {}),
              ElementsAre(tells(DoubtKind::cohesion_presses_grains,
                                {"cohesion", 99999, "kJ/m^3", std::pow(0.75 * std::numbers::pi * 99999 / 2500, 2) / 2,
                                 671, "kJ/m^3"})));
}

// Two grains of 2.5 mm radius, R* = 1.25 mm, E* = 2.5 MPa: jkr holds them without load at delta = a^2/(3 R*), a^3 =
// (9/2) pi w R*^2/E*. 0.2 of a radius is a = 1.369 mm, so w = 290.6 J/m^2.
TEST(Doubts, AdhesionThatPressesGrainsTogetherIsTold) {
  Case question = sand_and_wheel();
  GranularSoil& grains = *question.scenario.soil.granular;
  grains.cohesion_law = GrainCohesion::jkr;
  grains.grain_grain.work_of_adhesion = 290;
  EXPECT_THAT(doubts(question, {}), IsEmpty());
  grains.grain_grain.work_of_adhesion = 400;
  const double r_star = 1.25e-3, a = std::cbrt(4.5 * std::numbers::pi * 400 * r_star * r_star / 2.5e6);
  EXPECT_THAT(doubts(question, {}),
              ElementsAre(tells(DoubtKind::cohesion_presses_grains,
                                {"work_of_adhesion", 400, "J/m^2", a * a / (3 * r_star) / 2.5e-3, 290.58, "J/m^2"})));
}

TEST(Doubts, ARollingLawThatHangsOnTheStepIsToldWhereGrainsAnswer) {
  Case question = papers_case();
  const auto told = [&] { return doubts(question, answer_of_grains(0.25e-3)); };
  question.scenario.soil.granular->rolling_resistance = RollingResistance::directional;
  EXPECT_THAT(told(), Contains(tells(DoubtKind::rolling_depends_on_step, {"directional"})));
  question.scenario.soil.granular->rolling_resistance = RollingResistance::elastic_plastic;
  EXPECT_THAT(told(), Not(Contains(tells(DoubtKind::rolling_depends_on_step))));
  question.scenario.soil.granular->rolling_resistance = RollingResistance::directional;
  question.scenario.soil.granular->grain_grain.rolling_friction = 0.0;
  question.scenario.soil.granular->grain_tire.rolling_friction = 0.0;
  EXPECT_THAT(told(), Not(Contains(tells(DoubtKind::rolling_depends_on_step)))) << "nothing resists rolling";
  question = papers_case();
  question.study.models = {ModelChoice{}};
  EXPECT_THAT(doubts(question, run_study(question)), Not(Contains(tells(DoubtKind::coarse_grains)))) << "not asked";
  EXPECT_THAT(doubts(question), Contains(tells(DoubtKind::coarse_grains))) << "--model dem would ask them";
}

}  // namespace
}  // namespace soilbin::compare
