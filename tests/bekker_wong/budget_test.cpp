// The parts of the drawbar pull: what instruments add is a part of its own, and what no part names is seen.
#include <gtest/gtest.h>

#include "bekker_wong/bed_fixture.hpp"
#include "bekker_wong/model.hpp"
#include "scenario/unit.hpp"

namespace soilbin::bekker_wong::bed {
namespace {

OperatingCondition yawed_uphill() {
  OperatingCondition at = driven(800, 0.3);
  at.yaw = 15 * degree, at.longitudinal_incline = 4 * degree;
  return at;
}

TractionResult told(const EffectList& effects, const OperatingCondition& at) {
  return traction_result(wheel_on(sand(), effects).roll(at), smooth_tire(), false);
}

double part(const TractionResult& result, const std::string& name) {
  for (const Contribution& c : result.budget)
    if (c.name == name) return c.force;
  return 0.0;
}

/// The parts but the instruments'.
std::vector<double> parts_of_the_wheel(const TractionResult& result) {
  std::vector<double> forces;
  for (const Contribution& c : result.budget)
    if (c.name != "measurement") forces.push_back(c.force);
  return forces;
}

TEST(Budget, InstrumentsAddTheirOwnPartAndChangeNoOther) {
  const OperatingCondition at = yawed_uphill();
  const TractionResult plain = told({}, at);
  const double pull = plain.drawbar_pull.value, side = plain.lateral_force.value;
  EXPECT_EQ(part(plain, "measurement"), 0.0);
  struct Case {
    EffectList effects;
    double adds;
  };
  const EffectChoice offset{"sensor_offset", "drawbar_pull", {{"a", 7.0}}};
  const EffectChoice turned{"cross_talk", "turned_cell", {{"a", 10 * degree}}};
  const EffectChoice leak{"cross_talk", "drawbar_pull_from_torque", {{"a", 0.04}}};
  const EffectChoice torque_alone{"rig_friction", "coulomb", {{"a", 3.0}}};
  const double by_turning = pull * std::cos(10 * degree) + side * std::sin(10 * degree) - pull;
  for (const Case& c :
       {Case{make_effects({offset}), 7.0}, Case{make_effects({turned}), by_turning},
        Case{make_effects({leak}), 0.04 * plain.torque.value / radius},
        Case{make_effects({turned, offset}), by_turning + 7.0}, Case{make_effects({torque_alone}), 0.0}}) {
    SCOPED_TRACE(c.adds);
    const TractionResult result = told(c.effects, at);
    EXPECT_NEAR(part(result, "measurement"), c.adds, 1e-12 * at.load);
    EXPECT_EQ(parts_of_the_wheel(result), parts_of_the_wheel(plain));
    EXPECT_LE(std::abs(result.budget_rest.force), result.budget_rest.bound);
  }
}

// At amplitude 0 an effect adds no part, not even one of 0 N; a row of an effect that does nothing would be a riddle.
TEST(Budget, AnEffectAtAmplitudeZeroHasNoPart) {
  const std::vector<double> plain = parts_of_the_wheel(told({}, yawed_uphill()));
  for (const EffectForm& form : effect_catalogue()) {
    const EffectChoice off{form.id, form.form, {{form.parameters.front().name, 0.0}}};
    EXPECT_EQ(parts_of_the_wheel(told(make_effects({off}), yawed_uphill())), plain) << form.id << " " << form.form;
  }
}

// A newton that the soil gave, though no part says so; and one that an instrument added.
TEST(Budget, AForceThatNoPartNamesIsTheRest) {
  RolledWheel wheel = wheel_on(sand()).roll(yawed_uphill());
  wheel.unmeasured.drawbar_pull += 1.0, wheel.reading.drawbar_pull += 1.0;
  const BudgetRest of_soil = traction_result(wheel, smooth_tire(), false).budget_rest;
  EXPECT_NEAR(of_soil.force, 1.0, 1e-9);
  EXPECT_LT(of_soil.bound, 1e-9);
  wheel.unmeasured.drawbar_pull -= 1.0;
  const TractionResult of_rig = traction_result(wheel, smooth_tire(), false);
  EXPECT_NEAR(part(of_rig, "measurement"), 1.0, 1e-9);
  EXPECT_LE(std::abs(of_rig.budget_rest.force), of_rig.budget_rest.bound);
}

}  // namespace
}  // namespace soilbin::bekker_wong::bed
