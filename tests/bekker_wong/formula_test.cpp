// Learned effects as formulas: their terms, and what they do at their joints.
#include "bekker_wong/formula.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "bekker_wong/bed_fixture.hpp"

namespace soilbin::bekker_wong {
namespace {

using testing::Contains;
using testing::Field;

const EffectForm& learned(const std::string& name) {
  return *std::find_if(learned_forms().begin(), learned_forms().end(),
                       [&](const EffectForm& form) { return form.form == name; });
}

std::vector<FormulaTerm> terms_of(const EffectForm& form, const std::vector<double>& ranges) {
  std::vector<double> parameters = {1.0};
  parameters.insert(parameters.end(), ranges.begin(), ranges.end());
  return formula_terms(learned_function(form), parameters);
}

std::vector<FormulaTerm> picked(const std::vector<FormulaTerm>& all, const std::vector<std::string>& texts) {
  std::vector<FormulaTerm> some;
  for (const std::string& text : texts)
    some.push_back(*std::find_if(all.begin(), all.end(), [&](const FormulaTerm& t) { return t.text == text; }));
  return some;
}

Reading reading(const EffectForm* form, const std::vector<double>& parameters, const OperatingCondition& at) {
  EffectList effects;
  if (form != nullptr) effects.push_back(form->make(parameters));
  return bed::roll(bed::sand(), effects, at);
}

OperatingCondition at(double load, double slip) { return bed::driven(load, slip); }

// Loads from 600 to 1500 N: middle 1050, to one digit 1000.
TEST(Formula, TermsCarryTheirUnitsAndAreWhatTheySay) {
  const auto terms = terms_of(learned("drawbar_pull_by_slip_and_load"), {0.0, 0.6, 600, 1500});
  EXPECT_THAT(terms, Contains(Field(&FormulaTerm::text, "slip^2 (load/1000 N)")));
  for (const FormulaTerm& term : picked(terms, {"slip^2 (load/1000 N)"}))
    EXPECT_DOUBLE_EQ(term.value(at(1200, 0.5)), 0.25 * 1.2);
  for (const FormulaTerm& term : picked(terms, {"max(0, slip) ln(load/1000 N)"})) {
    EXPECT_DOUBLE_EQ(term.value(at(1200, 0.5)), 0.5 * std::log(1.2));
    EXPECT_EQ(term.value(at(1200, -0.5)), 0.0);
  }
}

// A force along the plane on level ground carries no load: the pull grows by W g, and sinkage and torque stay.
TEST(Formula, AddsTheForceThatItSays) {
  const EffectForm& curve = learned("drawbar_pull_by_slip_and_load");
  const EffectForm form = formula_form(curve, picked(terms_of(curve, {0.0, 0.6, 600, 1500}), {"slip^2", "1"}));
  const Reading with = reading(&form, {1.0, 0.2, -0.01}, at(1000, 0.5)), without = reading(nullptr, {}, at(1000, 0.5));
  EXPECT_NEAR(with.drawbar_pull - without.drawbar_pull, 1000 * (0.2 * 0.25 - 0.01), 1e-9);
  EXPECT_EQ(with.sinkage, without.sinkage);
  EXPECT_EQ(with.torque, without.torque);
}

TEST(Formula, AmplitudeZeroIsTheBaseModelToTheBit) {
  for (const char* name : {"stiffness_by_slip", "strength_by_slip", "torque_by_slip", "sinkage_by_slip"}) {
    const EffectForm form = formula_form(learned(name), picked(terms_of(learned(name), {0.0, 0.6}), {"slip"}));
    const Reading with = reading(&form, {0.0, 0.5}, at(1000, 0.3)), without = reading(nullptr, {}, at(1000, 0.3));
    EXPECT_EQ(with.drawbar_pull, without.drawbar_pull) << name;
    EXPECT_EQ(with.sinkage, without.sinkage) << name;
    EXPECT_NE(reading(&form, {1.0, 0.5}, at(1000, 0.3)).drawbar_pull +
                  reading(&form, {1.0, 0.5}, at(1000, 0.3)).torque + reading(&form, {1.0, 0.5}, at(1000, 0.3)).sinkage,
              without.drawbar_pull + without.torque + without.sinkage)
        << name;
  }
}

}  // namespace
}  // namespace soilbin::bekker_wong
