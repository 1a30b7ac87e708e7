// slip_sinkage: what slip digs away.
#include "bekker_wong/bed_fixture.hpp"
#include "scenario/unit.hpp"

namespace soilbin::bekker_wong::bed {
namespace {

const char* const digging_forms[] = {"lyasko", "ding", "linear", "loosening", "reece", "sliding"};

// Nothing digs at zero slip, and a braked wheel pushes soil ahead rather than back (Ding's exponent takes |s|).
TEST(SlipSinkage, SilentWithoutDrivingSlip) {
  expect_silent("slip_sinkage", driven(800, 0.0));
  for (const char* form : {"lyasko", "linear", "loosening", "reece"})
    expect_same_bits(with({"slip_sinkage", form, {}}, driven(400, -0.4)), base(driven(400, -0.4)));
}

// Closed forms at s = 0.6: Lyasko (1 + 0.6)/(1 - 0.3) = 16/7, linear 1 + 0.6, Reece z + h 0.6/0.4.
TEST(SlipSinkage, DepthsOfThePublishedFactors) {
  const OperatingCondition at = driven(300, 0.6);
  const double z = base(at).sinkage;
  EXPECT_NEAR(with({"slip_sinkage", "lyasko", {}}, at).sinkage, 16.0 / 7.0 * z, 1e-14);
  EXPECT_NEAR(with({"slip_sinkage", "linear", {{"S", 1.0}}}, at).sinkage, 1.6 * z, 1e-14);
  EXPECT_NEAR(with({"slip_sinkage", "reece", {{"h", 0.01}}}, at).sinkage, z + 0.015, 1e-14);
}

// Ding's law is the base model on soil of exponent n0 + n1 s; loosened soil is soil of modulus k/f^n.
TEST(SlipSinkage, WeakenedSoilIsTheBaseModelOnWeakerSoil) {
  const OperatingCondition at = driven(300, 0.5);
  SoilValues grown = sand();
  grown.exponent += 0.4 * 0.5;
  expect_same_bits(with({"slip_sinkage", "ding", {{"n1", 0.4}}}, at), roll(grown, {}, at));
  SoilValues loose = sand();
  const double f = (1 + 0.5) / (1 - 0.25), share = std::pow(f, -loose.exponent);
  loose.k_c *= share, loose.k_phi *= share;
  const Reading a = with({"slip_sinkage", "loosening", {}}, at), b = roll(loose, {}, at);
  EXPECT_NEAR(a.sinkage, b.sinkage, 1e-12);
  EXPECT_NEAR(a.drawbar_pull, b.drawbar_pull, 1e-9);
}

// A deeper rut faces more soil: sinkage grows with slip, and at high slip drawbar pull bends down, so that its best
// slip moves lower than the base model's.
TEST(SlipSinkage, DigsAndBendsTheDrawbarPullDown) {
  for (const char* form : digging_forms) {
    SCOPED_TRACE(form);
    const EffectChoice choice{"slip_sinkage", form, {}};
    double before = base(driven(500, 0.0)).sinkage, loss_before = -1e300;
    for (const double slip : {0.1, 0.2, 0.4, 0.6, 0.8}) {
      const Reading r = with(choice, driven(500, slip)), b = base(driven(500, slip));
      EXPECT_GT(r.sinkage, before);
      before = r.sinkage;
      const double loss = b.drawbar_pull - r.drawbar_pull;
      EXPECT_GT(loss, loss_before);
      loss_before = loss;
    }
    EXPECT_GT(loss_before, 0.0);
  }
}

/// What `sliding` digs with h = 20 mm, d = 0.3, d_b = 0.4 [m].
double dug(OperatingCondition at) {
  at.slip_by = SlipBy::travel_speed;
  const EffectChoice choice{"slip_sinkage", "sliding", {{"h", 0.02}, {"d", 0.3}, {"d_b", 0.4}}};
  return with(choice, at).sinkage - base(at).sinkage;
}

OperatingCondition slipping_at_yaw(double yaw_deg, double slip) {
  OperatingCondition at = driven(200, slip);
  at.yaw = yaw_deg * degree;
  return at;
}

/// h x/(1 + h x/end), h = 20 mm.
double toward(double x, double end) { return 0.02 * x / (1 + 0.02 * x / end); }

// Straight ahead x is s/(1 - s) driven and -s/(1 + s) braked, so equal for s and -s; little of it is Reece's h x.
TEST(SlipSinkage, SlidingIsReecesLawInBothDirectionsWithAnEnd) {
  EXPECT_NEAR(dug(driven(200, 0.5)), toward(1.0, 0.3 * radius), 1e-14);
  EXPECT_NEAR(dug(driven(200, -0.5)), toward(1.0, 0.4 * radius), 1e-14);
  EXPECT_NEAR(dug(driven(200, 0.01)) / (0.02 * 0.01 / 0.99), 1.0, 0.01);
  EXPECT_LT(dug(driven(200, 1.0)), 0.3 * radius);
}

// A wheel whose rim turns as fast as it rolls in its plane, s = 1 - 1/cos(psi) by the speed of travel, slides across by
// tan(psi) and not along. The mirrored yaw digs as deep.
TEST(SlipSinkage, SlidesSidewaysByTheTangentOfYaw) {
  const double slip = -(1 - std::cos(40 * degree));
  EXPECT_NEAR(dug(slipping_at_yaw(40, slip)), toward(std::tan(40 * degree), 0.9 * radius), 1e-12);
  EXPECT_NEAR(dug(slipping_at_yaw(-40, slip)), dug(slipping_at_yaw(40, slip)), 1e-14);
  // Both at once add as the sides of a right angle do.
  const double along = toward(1 / (0.5 * std::cos(40 * degree)) - 1, 0.3 * radius);
  const double across = toward(std::tan(40 * degree), 0.9 * radius);
  EXPECT_NEAR(dug(slipping_at_yaw(40, 0.5)), std::hypot(along, across), 1e-12);
}

// A wheel that hardly turns digs as deep as one that is locked, straight ahead and at yaw.
TEST(SlipSinkage, SlidingHasNoCliffAtTheLockedWheel) {
  for (const double yaw : {0.0, 17.0, 75.0, 90.0})
    EXPECT_NEAR(dug(slipping_at_yaw(yaw, -0.999999)), dug(slipping_at_yaw(yaw, -1.0)), 1e-6) << yaw;
}

// Sideways it digs deeper the more yaw, and never past the end.
TEST(SlipSinkage, DeeperWithYaw) {
  double before = dug(slipping_at_yaw(0, 0.2));
  for (const double yaw : {10.0, 30.0, 60.0, 85.0}) {
    EXPECT_GT(dug(slipping_at_yaw(yaw, 0.2)), before);
    before = dug(slipping_at_yaw(yaw, 0.2));
  }
  EXPECT_LT(before, std::hypot(0.3, 0.9) * radius);
}

}  // namespace
}  // namespace soilbin::bekker_wong::bed
