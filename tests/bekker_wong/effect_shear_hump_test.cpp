// shear_hump: strength that falls again.
#include <algorithm>

#include "bekker_wong/bed_fixture.hpp"

namespace soilbin::bekker_wong::bed {
namespace {

RollingWheel wheel(const EffectChoice& choice) { return wheel_on(sand(), make_effects({choice})); }

// The published curve at every node (a = 1): K_r {1 + [1/(K_r (1 - 1/e)) - 1] exp(1 - j/K_w)} (1 - exp(-j/K_w)),
// 1 at j = K_w = 2 K = 40 mm, K_r far beyond.
TEST(ShearHump, WongsCurve) {
  const double kr = 0.6, kw = 0.04, e = std::numbers::e;
  const RollingWheel w = wheel({"shear_hump", "wong", {{"a", 1.0}, {"K_r", kr}, {"kappa", 2.0}}});
  const ContactPatch p = w.roll(driven(1000, 0.6)).patch;
  double most = 0.0;
  for (int i = 0; i < p.count; ++i) {
    const double j = std::abs(p.j_x[i]);
    const double curve = kr * (1 + (1 / (kr * (1 - 1 / e)) - 1) * std::exp(1 - j / kw)) * (1 - std::exp(-j / kw));
    EXPECT_NEAR(p.mobilised[i], curve, 1e-12);
    most = std::max(most, p.mobilised[i]);
  }
  EXPECT_NEAR(most, 1.0, 5e-3);
  EXPECT_LE(most, 1.0 + 1e-3);
}

// The other two at every node: Janosi's rise less what softening takes, and (j/K_w) exp(1 - j/K_w).
TEST(ShearHump, SofteningAndDecayCurves) {
  const OperatingCondition at = driven(1000, 0.6);
  const ContactPatch soft = wheel({"shear_hump", "softening", {{"a", 0.4}, {"lambda", 3.0}}}).roll(at).patch;
  for (int i = 0; i < soft.count; ++i) {
    const double x = std::abs(soft.j_x[i]) / 0.02;
    EXPECT_NEAR(soft.mobilised[i], (1 - std::exp(-x)) * (1 - 0.4 * (1 - std::exp(-x / 3))), 1e-12);
  }
  const ContactPatch gone = wheel({"shear_hump", "decay", {{"a", 1.0}, {"kappa", 2.0}}}).roll(at).patch;
  for (int i = 0; i < gone.count; ++i) {
    const double y = std::abs(gone.j_x[i]) / 0.04;
    EXPECT_NEAR(gone.mobilised[i], y * std::exp(1 - y), 1e-12);
  }
}

// Torque rises to a peak and falls: at full slip it is below its best where the base model's is at its best. The longer
// the contact (the heavier the wheel), the more of it has slid past the peak, so the peak comes at less slip.
TEST(ShearHump, TorquePeaksAtAModerateSlip) {
  const auto best_slip = [](const EffectList& effects, double load) {
    double best = 0.0, most = -1e300;
    for (int i = 1; i <= 20; ++i) {
      const double torque = roll(sand(), effects, driven(load, 0.05 * i)).torque;
      if (torque > most) most = torque, best = 0.05 * i;
    }
    return best;
  };
  for (const char* form : {"wong", "softening", "decay"}) {
    SCOPED_TRACE(form);
    const EffectList hump = make_effects({{"shear_hump", form, {}}});
    EXPECT_LT(best_slip(hump, 1500), 0.75);
    EXPECT_LE(best_slip(hump, 1500), best_slip(hump, 300));
    EXPECT_LT(roll(sand(), hump, driven(1500, 1.0)).drawbar_pull, base(driven(1500, 1.0)).drawbar_pull);
  }
  EXPECT_DOUBLE_EQ(best_slip({}, 1500), 1.0);
}

// A locked wheel has slid without end: the residual is left of the saturated shear, at the same theta_1.
TEST(ShearHump, LockedWheelKeepsTheResidual) {
  const OperatingCondition locked = driven(100, -1.0);
  const double whole = wheel({"shear_hump", "wong", {{"a", 0.0}}}).at_entry_angle(locked, 0.5).forces.torque;
  const auto left = [&](const EffectChoice& c) { return wheel(c).at_entry_angle(locked, 0.5).forces.torque / whole; };
  EXPECT_NEAR(left({"shear_hump", "wong", {{"a", 1.0}, {"K_r", 0.6}}}), 0.6, 1e-14);
  EXPECT_NEAR(left({"shear_hump", "softening", {{"a", 0.4}}}), 0.6, 1e-14);
  EXPECT_NEAR(left({"shear_hump", "decay", {{"a", 0.5}}}), 0.5, 1e-14);
}

}  // namespace
}  // namespace soilbin::bekker_wong::bed
