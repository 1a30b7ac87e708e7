// learned: a smooth function at a joint of the model.
#include "bekker_wong/bed_fixture.hpp"
#include "bekker_wong/learned.hpp"

namespace soilbin::bekker_wong::bed {
namespace {

/// A function of slip from 0 to 80 %.
EffectChoice of_slip(const std::string& joint, std::map<std::string, double> weights) {
  weights.merge(std::map<std::string, double>{{"slip_from", 0.0}, {"slip_to", 0.8}});
  return {"learned", joint + "_by_slip", std::move(weights)};
}

OperatingCondition at_slip(double slip, double yaw = 0.0) {
  OperatingCondition at = driven();
  at.slip = slip, at.yaw = yaw;
  return at;
}

// Amplitude 0, and weights of 0, are the base model to the bit, at every joint and of every variable.
TEST(Learned, NothingIsTheBaseModel) {
  OperatingCondition at = at_slip(0.3, 0.2);
  at.moisture = 0.1, at.position = 1.0;
  const Reading bare = base(at);
  for (const EffectForm& form : learned_forms()) {
    SCOPED_TRACE(form.form);
    std::map<std::string, double> some{{"a", 0.0}};
    for (const EffectParameter& p : form.parameters)
      if (p.name.front() == 'c') some[p.name] = 0.1;
    expect_same_bits(with({"learned", form.form, some}, at), bare);
    const Reading none = with({"learned", form.form, {}}, at);
    for (auto member : reading_members) EXPECT_NEAR(none.*member, bare.*member, 1e-12 * std::abs(bare.*member));
  }
}

// A share of the load along the wheel, a share of load times radius on its axle, a factor on the sinkage.
TEST(Learned, JointsByArithmetic) {
  const OperatingCondition at = at_slip(0.4);
  const Reading b = base(at);
  EXPECT_NEAR(with(of_slip("drawbar_pull", {{"c0", 0.05}}), at).drawbar_pull, b.drawbar_pull + 0.05 * at.load,
              1e-9 * at.load);
  EXPECT_NEAR(with(of_slip("torque", {{"c0", 0.05}}), at).torque, b.torque + 0.05 * at.load * radius, 1e-9 * at.load);
  EXPECT_NEAR(with(of_slip("sinkage", {{"c0", 0.2}}), at).sinkage, b.sinkage * std::exp(0.2), 1e-12);
  SoilValues stiffer = sand(), stronger = sand();
  stiffer.k_c *= std::exp(0.2), stiffer.k_phi *= std::exp(0.2);
  stronger.cohesion *= std::exp(0.2);
  stronger.friction_angle = std::atan(std::exp(0.2) * std::tan(stronger.friction_angle));
  EXPECT_NEAR(with(of_slip("stiffness", {{"c0", 0.2}}), at).sinkage, roll(stiffer, {}, at).sinkage, 1e-12);
  EXPECT_NEAR(with(of_slip("strength", {{"c0", 0.2}}), at).drawbar_pull, roll(stronger, {}, at).drawbar_pull, 1e-9);
}

// P2 is -1/2 in the middle of the range and 1 at its ends; beyond them the function stays as it is there.
TEST(Learned, LegendreOverTheRangeAndTheEdgeBeyondIt) {
  const EffectChoice bent = of_slip("drawbar_pull", {{"c2", 0.1}});
  const auto share = [&](double slip) {
    const OperatingCondition at = at_slip(slip);
    return (with(bent, at).drawbar_pull - base(at).drawbar_pull) / at.load;
  };
  EXPECT_NEAR(share(0.4), -0.05, 1e-9);
  EXPECT_NEAR(share(0.8), 0.1, 1e-9);
  EXPECT_NEAR(share(0.9), 0.1, 1e-9);
  EXPECT_NEAR(share(-0.2), 0.1, 1e-9);
  EXPECT_TRUE(outside_learned(bent, at_slip(0.4)).empty());
  EXPECT_EQ(outside_learned(bent, at_slip(0.9)), std::vector<std::string>{"slip"});
}

// A side force follows the sign of the yaw, and there is none without it; a pull does not ask for the sign.
TEST(Learned, SideForceIsOddInYaw) {
  const EffectChoice side{
      "learned", "lateral_force_by_yaw", {{"yaw_from", 0.0}, {"yaw_to", 0.5}, {"c0", 0.1}, {"c1", 0.05}}};
  const EffectChoice pull{"learned", "drawbar_pull_by_yaw", {{"yaw_from", 0.0}, {"yaw_to", 0.5}, {"c1", 0.05}}};
  const auto added = [&](const EffectChoice& effect, double yaw) {
    OperatingCondition at = at_slip(0.3, yaw);
    at.force_frame = ForceFrame::wheel;
    const Reading w = with(effect, at), b = base(at);
    return effect.form.starts_with("lateral") ? w.lateral_force - b.lateral_force : w.drawbar_pull - b.drawbar_pull;
  };
  EXPECT_NEAR(added(side, 0.25), 0.1 * driven().load * std::sin(0.25), 1e-6);
  EXPECT_NEAR(added(side, -0.25), -added(side, 0.25), 1e-9);
  EXPECT_EQ(added(side, 0.0), 0.0);
  EXPECT_NEAR(added(pull, -0.4), added(pull, 0.4), 1e-9);
}

}  // namespace
}  // namespace soilbin::bekker_wong::bed
