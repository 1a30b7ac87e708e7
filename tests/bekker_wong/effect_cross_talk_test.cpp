// cross_talk: what one channel takes from another, by hand.
#include "bekker_wong/bed_fixture.hpp"
#include "scenario/unit.hpp"

namespace soilbin::bekker_wong::bed {
namespace {

OperatingCondition yawed() {
  OperatingCondition at = driven(800, 0.3);
  at.yaw = 15 * degree;
  return at;
}

TEST(CrossTalk, LeaksByArithmetic) {
  const Reading b = base(yawed());
  struct Case {
    const char* form;
    double Reading::*into;
    double at_full_share;
  };
  const Case cases[] = {{"drawbar_pull_from_lateral_force", &Reading::drawbar_pull, b.lateral_force},
                        {"drawbar_pull_from_torque", &Reading::drawbar_pull, b.torque / radius},
                        {"lateral_force_from_drawbar_pull", &Reading::lateral_force, b.drawbar_pull},
                        {"lateral_force_from_torque", &Reading::lateral_force, b.torque / radius},
                        {"torque_from_drawbar_pull", &Reading::torque, b.drawbar_pull * radius},
                        {"torque_from_lateral_force", &Reading::torque, b.lateral_force * radius}};
  for (const Case& c : cases)
    for (const double share : {0.04, -0.04}) {
      SCOPED_TRACE(c.form);
      Reading expected = b;
      expected.*c.into += share * c.at_full_share;
      expect_same_bits(with({"cross_talk", c.form, {{"a", share}}}, yawed()), expected);
    }
}

// Straight ahead on level ground there is no side force to leak: the trace is in the yawed runs alone.
TEST(CrossTalk, SideForceLeaksOnlyWhereThereIsOne) {
  expect_same_bits(with({"cross_talk", "drawbar_pull_from_lateral_force", {}}, driven()), base(driven()));
}

// A turned cell keeps the length of the horizontal force.
TEST(CrossTalk, TurnedCellKeepsTheForce) {
  const Reading b = base(yawed()), e = with({"cross_talk", "turned_cell", {{"a", 10 * degree}}}, yawed());
  EXPECT_NEAR(std::hypot(e.drawbar_pull, e.lateral_force), std::hypot(b.drawbar_pull, b.lateral_force), 1e-10);
  const double before = std::atan2(b.lateral_force, b.drawbar_pull);
  const double after = std::atan2(e.lateral_force, e.drawbar_pull);
  EXPECT_NEAR(std::remainder(before - after, 360 * degree), 10 * degree, 1e-12);
}

// 2 mm at 1 kN: 1.6 mm at 800 N.
TEST(CrossTalk, TheFrameYieldsUnderTheLoad) {
  const Reading e = with({"cross_talk", "sinkage_from_load", {{"a", 0.002}}}, driven(800));
  EXPECT_NEAR(e.sinkage - base(driven(800)).sinkage, 0.0016, 1e-15);
}

}  // namespace
}  // namespace soilbin::bekker_wong::bed
