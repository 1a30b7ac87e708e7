// multipass: the second pass in a rut against the first.
#include "bekker_wong/bed_fixture.hpp"
#include "bekker_wong/closed_forms.hpp"

namespace soilbin::bekker_wong::bed {
namespace {

OperatingCondition pass(int n, double slip = 0.2) {
  OperatingCondition at = driven(800, slip);
  at.pass = n;
  return at;
}

TEST(Multipass, IsSilentAtTheFirstPass) { expect_silent("multipass", pass(1)); }

// Stiffer soil carries the load at a smaller theta_1: less sinkage and less soil to compact. At large slip the shear is
// mobilised anyway, so that is a gain of pull; the shorter contact holds less cohesion, so less torque. The gain is
// largest on the second pass and fades.
TEST(Multipass, LaterPassesSinkLessAndPullMoreAtLargeSlip) {
  for (const char* form : {"stiffer", "reload"}) {
    SCOPED_TRACE(form);
    const Reading first = base(pass(1, 0.6)), second = with({"multipass", form, {}}, pass(2, 0.6)),
                  third = with({"multipass", form, {}}, pass(3, 0.6));
    EXPECT_LT(second.sinkage, first.sinkage);
    EXPECT_LT(third.sinkage, second.sinkage);
    EXPECT_GT(second.sinkage - third.sinkage, 0);
    EXPECT_LT(second.sinkage - third.sinkage, first.sinkage - second.sinkage);
    EXPECT_GT(second.drawbar_pull, first.drawbar_pull);
    EXPECT_GT(third.drawbar_pull, second.drawbar_pull);
    EXPECT_LT(second.torque, first.torque);
  }
}

// At no slip the shear displacement grows with the contact's length alone: the shorter contact of the stiffer rut
// mobilises less shear and loses more thrust than it saves in resistance, unless K shrinks with the compaction.
TEST(Multipass, AtNoSlipAStifferRutCostsPull) {
  const double first = base(pass(1, 0.0)).drawbar_pull;
  EXPECT_LT(with({"multipass", "stiffer", {}}, pass(2, 0.0)).drawbar_pull, first);
  EXPECT_LT(with({"multipass", "reload", {}}, pass(2, 0.0)).drawbar_pull, first);
  EXPECT_GT(with({"multipass", "slip_hardening", {}}, pass(2, 0.0)).drawbar_pull, first);
}

// pass 2, p0 = 1: k grows by 1 + 0.5 (1 - e^-1).
TEST(Multipass, StifferIsTheBaseModelOnScaledSoil) {
  SoilValues soil = sand();
  const double factor = 1 + 0.5 * (1 - std::exp(-1.0));
  soil.k_c *= factor, soil.k_phi *= factor;
  const Reading expected = roll(soil, {}, pass(2)), found = with({"multipass", "stiffer", {}}, pass(2));
  EXPECT_NEAR(found.sinkage, expected.sinkage, 1e-13);
  EXPECT_NEAR(found.drawbar_pull, expected.drawbar_pull, 1e-9);
}

// Counted from the undisturbed surface the rut is deeper by what the passes before have left, 0.6 (1 - e^-2) of the
// static sinkage on pass 3; forces don't ask where the depth is counted from.
TEST(Multipass, TotalRutDepthGrowsWhereTheForcesAreThoseOfTheReloadedSoil) {
  const Reading additional = with({"multipass", "reload", {}}, pass(3)),
                total = with({"multipass", "reload_from_surface", {}}, pass(3));
  const double left = 0.6 * (1 - std::exp(-2.0)) * bekker_static_sinkage(sand(), radius, width, 800);
  EXPECT_NEAR(total.sinkage, additional.sinkage + left, 1e-14);
  EXPECT_EQ(total.drawbar_pull, additional.drawbar_pull);
  EXPECT_EQ(total.torque, additional.torque);
  EXPECT_GT(total.sinkage, base(pass(1)).sinkage);
}

// What the wheel before carried makes the rut: a vehicle tells it. Its own load told is no news, no load leaves no rut.
TEST(Multipass, TheRutIsThatOfTheLoadBefore) {
  OperatingCondition at = pass(3);
  const EffectChoice reload{"multipass", "reload", {}}, total{"multipass", "reload_from_surface", {}};
  at.rut_load = 800;
  EXPECT_EQ(with(reload, at).drawbar_pull, with(reload, pass(3)).drawbar_pull);
  at.rut_load = 0;
  EXPECT_EQ(with(reload, at).drawbar_pull, base(pass(1)).drawbar_pull);
  at.rut_load = 1200;
  const double left = 0.6 * (1 - std::exp(-2.0)) * bekker_static_sinkage(sand(), radius, width, 1200);
  EXPECT_NEAR(with(total, at).sinkage, with(reload, at).sinkage + left, 1e-14);
  EXPECT_LT(with(reload, at).sinkage, with(reload, pass(3)).sinkage);
}

// Behind a towed wheel without slip only the pass has hardened the soil: f = 1 + a q.
TEST(Multipass, TheSoilIsHardenedByTheSlipBefore) {
  const EffectChoice choice{"multipass", "slip_hardening", {}};
  OperatingCondition at = pass(2, 0.4);
  at.rut_slip = 0.4;
  EXPECT_EQ(with(choice, at).drawbar_pull, with(choice, pass(2, 0.4)).drawbar_pull);
  at.rut_slip = 0.0;
  SoilValues soil = sand();
  const double f = 1 + 0.3 * 0.3;
  soil.k_c *= f, soil.k_phi *= f, soil.cohesion *= f, soil.density *= f, soil.shear_modulus /= f;
  EXPECT_NEAR(with(choice, at).drawbar_pull, roll(soil, {}, pass(2, 0.4)).drawbar_pull, 1e-9);
}

// The rut left before (h), the elastic share (e z_p) and the depth all scale with the static sinkage, so the sinkage of
// the second pass is about the same share of the first's at every load.
TEST(Multipass, ReloadGainIsAboutTheSameShareAtEveryLoad) {
  double ratio[2];
  for (int i = 0; i < 2; ++i) {
    OperatingCondition at = driven(i == 0 ? 200 : 800);
    at.pass = 2;
    ratio[i] = with({"multipass", "reload", {}}, at).sinkage / base(at).sinkage;
  }
  EXPECT_LT(ratio[0], 0.9);
  EXPECT_NEAR(ratio[0], ratio[1], 0.05);
}

// f = 1 + 0.3 [1 - e^(-0.2/0.2) + 0.3]: k, c, density up, K down. More slip in the earlier passes, more hardening.
TEST(Multipass, SlipHardeningScalesTheSoil) {
  const double f = 1 + 0.3 * (1 - std::exp(-1.0) + 0.3);
  SoilValues soil = sand();
  soil.k_c *= f, soil.k_phi *= f, soil.cohesion *= f, soil.shear_modulus /= f;
  const Reading expected = roll(soil, {}, pass(2)), found = with({"multipass", "slip_hardening", {}}, pass(2));
  EXPECT_NEAR(found.drawbar_pull, expected.drawbar_pull, 1e-9);
  EXPECT_NEAR(found.torque, expected.torque, 1e-9);
  const auto gain = [](double slip) {
    return base(pass(2, slip)).sinkage / with({"multipass", "slip_hardening", {}}, pass(2, slip)).sinkage;
  };
  EXPECT_GT(gain(0.4), gain(0.1));
}

// On the second pass it is the published line; later ones add ever less: m = 1, then [1 - e^(-1)]/[1 - e^(-1/2)]
// = 1.607, in the end 1/[1 - e^(-1/2)] = 2.541.
TEST(Multipass, HardeningEnds) {
  const auto hardened = [](double times) {
    const double f = 1 + 0.3 * (1 - std::exp(-1.0) + 0.3 * times);
    SoilValues soil = sand();
    soil.k_c *= f, soil.k_phi *= f, soil.cohesion *= f, soil.shear_modulus /= f;
    return roll(soil, {}, pass(1)).drawbar_pull;
  };
  const auto at = [](int n) { return with({"multipass", "slip_hardening", {}}, pass(n)).drawbar_pull; };
  EXPECT_NEAR(at(3), hardened(1.606531), 1e-4);
  EXPECT_NEAR(at(1000), hardened(2.541494), 1e-4);
  EXPECT_EQ(with({"multipass", "rut_power", {}}, pass(1000)).sinkage,
            with({"multipass", "rut_power", {}}, pass(20)).sinkage);
}

TEST(Multipass, RutPowerDeepensTheRutOnly) {
  const Reading first = base(pass(1)), fourth = with({"multipass", "rut_power", {{"e", 0.5}}}, pass(4));
  EXPECT_DOUBLE_EQ(fourth.sinkage, 2 * first.sinkage);  // 4^0.5
  EXPECT_EQ(fourth.drawbar_pull, first.drawbar_pull);
  EXPECT_EQ(fourth.torque, first.torque);
}

}  // namespace
}  // namespace soilbin::bekker_wong::bed
