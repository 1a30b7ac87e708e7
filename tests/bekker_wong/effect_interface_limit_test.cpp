// interface_limit: a wheel smoother than the soil.
#include "bekker_wong/bed_fixture.hpp"

namespace soilbin::bekker_wong::bed {
namespace {

double torque_lost(const char* form, const OperatingCondition& at) {
  return 1 - with({"interface_limit", form, {{"a", 0.3}}}, at).torque / base(at).torque;
}

// Less grip at working slip: less pull and less torque; shear carries less of the load, so the wheel sinks a little.
TEST(InterfaceLimit, LosesPullAndTorque) {
  for (const char* form : {"cap", "reduced_strength", "series", "wall", "film"}) {
    SCOPED_TRACE(form);
    for (const double load : {200.0, 800.0, 2000.0}) {
      const Reading r = with({"interface_limit", form, {}}, driven(load, 0.5)), b = base(driven(load, 0.5));
      EXPECT_LT(r.drawbar_pull, b.drawbar_pull);
      EXPECT_LT(r.torque, b.torque);
      EXPECT_GT(r.sinkage, b.sinkage);
    }
  }
}

// An interface with its own Janosi law is a weaker soil, c (1 - a) and tan(phi) (1 - a).
TEST(InterfaceLimit, ReducedStrengthIsAWeakerSoil) {
  SoilValues weak = sand();
  weak.cohesion *= 0.7;
  weak.friction_angle = std::atan(0.7 * std::tan(weak.friction_angle));
  const Reading a = with({"interface_limit", "reduced_strength", {{"a", 0.3}}}, driven()), b = roll(weak, {}, driven());
  EXPECT_NEAR(a.drawbar_pull, b.drawbar_pull, 1e-9);
  EXPECT_NEAR(a.torque, b.torque, 1e-9);
}

// Where all strength is called up (a locked wheel) every form leaves the same 1 - a of it.
TEST(InterfaceLimit, FormsAgreeWhereShearIsSaturated) {
  const OperatingCondition locked = driven(100, -1.0);
  const Reading weak = with({"interface_limit", "reduced_strength", {{"a", 0.3}}}, locked);
  for (const char* form : {"cap", "series"}) {
    const Reading r = with({"interface_limit", form, {{"a", 0.3}}}, locked);
    EXPECT_NEAR(r.torque, weak.torque, 1e-10);
    EXPECT_NEAR(r.drawbar_pull, weak.drawbar_pull, 1e-10);
  }
}

// At little slip (a light wheel, s = 0.02) little strength is called up: the cap is silent, the series nearly, the
// reduced strength loses its 30 % at once. At much slip under load all but the entry is saturated: each loses near
// 30 %.
TEST(InterfaceLimit, FormsDifferAtLowSlip) {
  const OperatingCondition low = driven(50, 0.02), high = driven(800, 0.8);
  EXPECT_EQ(torque_lost("cap", low), 0.0);
  EXPECT_LT(torque_lost("series", low), 0.4 * torque_lost("reduced_strength", low));
  EXPECT_NEAR(torque_lost("reduced_strength", low), 0.3, 0.02);
  for (const char* form : {"cap", "series", "reduced_strength"}) {
    EXPECT_GT(torque_lost(form, high), 0.2) << form;
    EXPECT_LT(torque_lost(form, high), 0.31) << form;
  }
}

EffectChoice wall(double a, double q, double h) { return {"interface_limit", "wall", {{"a", a}, {"q", q}, {"h", h}}}; }

// The wall with the adhesion of its friction is the series at h = 1 and near the cap at a large h.
TEST(InterfaceLimit, WallHoldsSeriesAndCap) {
  for (const double slip : {0.05, 0.3, 0.9}) {
    const Reading series = with({"interface_limit", "series", {{"a", 0.4}}}, driven(800, slip)),
                  one = with(wall(0.4, 1, 1), driven(800, slip));
    EXPECT_NEAR(one.torque, series.torque, 1e-9);
    EXPECT_NEAR(one.drawbar_pull, series.drawbar_pull, 1e-9);
    EXPECT_NEAR(one.sinkage, series.sinkage, 1e-12);
    const Reading cap = with({"interface_limit", "cap", {{"a", 0.4}}}, driven(800, slip));
    EXPECT_NEAR(with(wall(0.4, 1, 12), driven(800, slip)).torque / cap.torque, 1, 0.03);
  }
}

// Adhesion and friction fall apart: on clay (phi = 0) only q a counts, on clean sand (c = 0) only a.
TEST(InterfaceLimit, WallTakesAdhesionAndFrictionApart) {
  SoilValues clay = sand(), clean = sand();
  clay.friction_angle = 0, clay.cohesion = 10e3;
  clean.cohesion = 0;
  const OperatingCondition at = driven(800, 0.4);
  const auto torque = [&](const SoilValues& soil, const EffectChoice& choice) {
    return roll(soil, make_effects({choice}), at).torque;
  };
  EXPECT_NEAR(torque(clay, wall(0.5, 0, 2)), roll(clay, {}, at).torque, 1e-9);
  EXPECT_NEAR(torque(clay, wall(0.25, 2, 2)), torque(clay, wall(0.5, 1, 2)), 1e-9);
  EXPECT_NEAR(torque(clean, wall(0.4, 0, 2)), torque(clean, wall(0.4, 3, 2)), 1e-9);
  EXPECT_LT(torque(clean, wall(0.4, 0, 2)), 0.8 * roll(clean, {}, at).torque);
}

// Where shear is saturated on clay a film in series is a clay of cohesion c/(1 + a c).
TEST(InterfaceLimit, FilmInSeriesWithSaturatedClay) {
  SoilValues clay = sand(), weaker = sand();
  clay.friction_angle = weaker.friction_angle = 0;
  clay.cohesion = 10e3, weaker.cohesion = 10e3 / (1 + 2e-4 * 10e3);
  const OperatingCondition locked = driven(300, -1.0);
  const Reading film = roll(clay, make_effects({{"interface_limit", "film", {{"a", 2e-4}}}}), locked);
  EXPECT_NEAR(film.torque, roll(weaker, {}, locked).torque, 1e-9);
  EXPECT_NEAR(film.drawbar_pull, roll(weaker, {}, locked).drawbar_pull, 1e-9);
}

// Heavier wheels press no more out of a film: it takes the larger share of their torque.
TEST(InterfaceLimit, FilmDoesNotGrowWithPressure) {
  const auto lost = [](double load) {
    return 1 - with({"interface_limit", "film", {}}, driven(load, 0.5)).torque / base(driven(load, 0.5)).torque;
  };
  EXPECT_GT(lost(2000), 1.3 * lost(200));
}

}  // namespace
}  // namespace soilbin::bekker_wong::bed
