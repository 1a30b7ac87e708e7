// Every form of every effect either ends, driven in time, in its own static wheel, or is refused with a reason.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bekker_wong/drive_fixture.hpp"
#include "bekker_wong/limits.hpp"
#include "bekker_wong/transient/driven_wheel.hpp"
#include "scenario/errors.hpp"
#include "scenario/unit.hpp"

namespace soilbin::bekker_wong {
namespace {

using namespace rover;

class SlowTransientEffects : public testing::TestWithParam<std::size_t> {};

TEST_P(SlowTransientEffects, EndInTheirStaticWheelOrAreRefused) {
  const EffectForm& form = effect_catalogue()[GetParam()];
  SCOPED_TRACE(form.id + " " + form.form);
  Scenario s = scenario();
  s.bin = Bin{.depth = 0.3, .width = 1.0};
  Drive d = drive(-9 * degree, 0.0, 20.0);  // downhill, so that forms that cost much pull still get along
  d.profile[0].yaw = 3 * degree;
  d.pass = 2;
  d.effects = {{form.id, form.form, {}}};
  if (!form.steady_only.empty()) {
    EXPECT_THROW(drive_wheel(s, d), InputError);
    return;
  }
  const DriveRecord record = drive_wheel(s, d, 20, {.nodes = 32, .relative_tolerance = 1e-7});
  if (record.end == DriveEnd::stuck) {  // a form that resists so much that the static wheel gets along at no slip
    const RollingWheel wheel(s.tire, values_of(*s.soil.semi_empirical), make_effects(d.effects), s.bin);
    OperatingCondition at;
    at.load = load, at.longitudinal_incline = -9 * degree, at.yaw = 3 * degree, at.pass = 2;
    EXPECT_LT(largest_pull(wheel, at).drawbar_pull, 0.0);
    return;
  }
  ASSERT_EQ(record.end, DriveEnd::time_is_up);
  const DriveSample& end = record.samples.back();
  const RolledWheel wheel = steady(s, d, end);
  EXPECT_NEAR(wheel.reading.drawbar_pull, 0.0, 1e-3 * load);
  EXPECT_NEAR(end.torque, wheel.reading.torque, 1e-3 * load * 0.09);
  EXPECT_NEAR(end.sinkage, wheel.sinkage, 1e-3 * 0.09);
  EXPECT_LT(std::abs(end.energy.unaccounted()), 1e-5 * end.energy.shear);
}

// Nothing has moved: no shear is called up, and nothing resists. One form alone is called up by the slip that the
// contact has seen: shear of 0 all along is that of a wheel braked by a few per cent.
TEST(TransientEffects, AWheelAtRestOnLevelGroundIsNotPushed) {
  const Scenario on_level_ground = scenario();
  for (const EffectForm& form : effect_catalogue()) {
    if (!form.steady_only.empty() || form.form == "level_blade") continue;
    Drive d = drive();
    d.effects = {{form.id, form.form, {}}};
    const DrivenWheel wheel(on_level_ground, d);
    const Held held = wheel.hold();
    EXPECT_NEAR(wheel.look(0.0, held.state, wheel.motor(held.torque)).forward, 0.0, 1e-9 * load)
        << form.id << " " << form.form;
  }
}

INSTANTIATE_TEST_SUITE_P(Catalogue, SlowTransientEffects, testing::Range(std::size_t{0}, effect_catalogue().size()),
                         [](const auto& about) {
                           const EffectForm& form = effect_catalogue()[about.param];
                           return form.id + "_" + form.form;
                         });

}  // namespace
}  // namespace soilbin::bekker_wong
