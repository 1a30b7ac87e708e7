// What a tire declares, in the questions of commands that answer for a tire.
#include "compare/doubts/declared_tire.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenario/tire_size.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin::compare {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A tire of 200 kPa with lugs, at 4 kN.
Case heavy_question() {
  Case question;
  Tire& tire = question.scenario.tire;
  tire.name = "heavy", tire.radius = 0.6, tire.width = 0.4, tire.inflation_pressure = 200e3;
  tire.lugs = {.height = 0.03, .count = 30, .thickness = {}};
  question.scenario.soil.semi_empirical.emplace();
  question.study.conditions.push_back({.load = 4e3, .slip = 0.2});
  question.study.models.push_back({ModelKind::bekker_wong, {}, "bekker_wong"});
  return question;
}

std::vector<std::string> effects_of(const Case& question) {
  std::vector<std::string> all;
  for (const EffectChoice& effect : question.study.models.front().effects) all.push_back(effect.id + ":" + effect.form);
  return all;
}

std::string why_refused(Case question, const TireLeftOut& left_out) {
  return soilbin::test::error_of([&] { as_declared(question, left_out); });
}

TEST(DeclaredTire, IsFlexibleAndHasItsLugs) {
  Case question = heavy_question();
  EXPECT_THAT(in_words(as_declared(question, {})),
              ElementsAre(HasSubstr("flexible where the soil presses with more than its 200 kPa"),
                          HasSubstr("taken with its lugs (effect lug_thrust, form passive_blade); --no-lugs")));
  EXPECT_THAT(effects_of(question), ElementsAre("tire_flexibility:flat_section", "lug_thrust:passive_blade"));
  EXPECT_EQ(question.study.models.front().label, "bekker_wong + tire_flexibility + lug_thrust");
  EXPECT_EQ(question.study.models.front().effects.back().parameters.at("a"), 0.3);
}

TEST(DeclaredTire, KeepsToWhatIsNamed) {
  Case named = heavy_question(), fitted = heavy_question(), grains = heavy_question(), off = heavy_question();
  named.study.models.front().effects.push_back({"lug_thrust", "side_factors", {{"a", 1.0}}});
  EXPECT_THAT(in_words(as_declared(named, {})), ElementsAre(HasSubstr("flexible")));
  EXPECT_THAT(effects_of(named), ElementsAre("lug_thrust:side_factors", "tire_flexibility:flat_section"));
  fitted.study.models.front().misfit[0] = 10.0;
  EXPECT_THAT(as_declared(fitted, {}), IsEmpty());
  grains.study.models.front().model = ModelKind::dem;
  EXPECT_THAT(as_declared(grains, {}), IsEmpty());
  EXPECT_THAT(as_declared(off, {.effects = true}), IsEmpty());
  Case compared = heavy_question();
  compared.study.models.push_back({ModelKind::bekker_wong, {{"slip_sinkage", "linear", {{"S", 1.0}}}}, "deeper"});
  EXPECT_THAT(in_words(as_declared(compared, {})), ElementsAre(HasSubstr("flexible")))
      << "models side by side keep their lugs";
  EXPECT_THAT(effects_of(off), IsEmpty());
}

TEST(DeclaredTire, IsRigidAndSmoothWhereThatIsAsked) {
  Case question = heavy_question();
  EXPECT_THAT(as_declared(question, {.pressure = true, .lugs = true}), IsEmpty());
  EXPECT_THAT(effects_of(question), IsEmpty());
  EXPECT_FALSE(is_lugged(question.scenario.tire));
  EXPECT_FALSE(question.scenario.tire.inflation_pressure);
  EXPECT_THAT(in_words(as_declared(question, {.pressure = true, .lugs = true})),
              ElementsAre(HasSubstr("--rigid is ignored"), HasSubstr("--no-lugs is ignored")));

  Case named = heavy_question(), grains = heavy_question();
  named.study.models.front().effects.push_back({"lug_thrust", "side_factors", {{"a", 1.0}}});
  EXPECT_THAT(why_refused(named, {.lugs = true}), HasSubstr("--no-lugs: a model of the question has the effect"));
  grains.study.models.push_back({ModelKind::dem, {}, "dem"});
  EXPECT_THAT(why_refused(grains, {.lugs = true}), HasSubstr("grains meet the tire with its lugs"));
}

TEST(DeclaredTire, TellsWhatASizeDoesNot) {
  Case question = heavy_question();
  question.scenario.tire = *tire_of_size("540/65R30");
  EXPECT_THAT(in_words(as_declared(question, {})),
              ElementsAre(HasSubstr("tire 540/65R30 is known by its size alone: 540 mm")));
  question.scenario.tire.sources["radius"] = "measured";
  EXPECT_THAT(in_words(as_declared(question, {})), IsEmpty());
}

}  // namespace
}  // namespace soilbin::compare
