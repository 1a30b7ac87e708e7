// sensor_offset: one channel off by a constant or in scale, the others untouched; the load's and the slip's zero.
#include <set>
#include <string>

#include "bekker_wong/bed_fixture.hpp"
#include "bekker_wong/effects/instrument_channels.hpp"

namespace soilbin::bekker_wong::bed {
namespace {

TEST(SensorOffset, AddsToItsOwnChannelOnly) {
  struct Case {
    const char* form;
    double Reading::*channel;
    double offset;
  };
  const Case cases[] = {{"drawbar_pull", &Reading::drawbar_pull, 7.0},
                        {"torque", &Reading::torque, -3.0},
                        {"sinkage", &Reading::sinkage, 0.004},
                        {"lateral_force", &Reading::lateral_force, -2.5}};
  for (const Case& c : cases)
    for (const OperatingCondition& at : {driven(800, 0.2), driven(300, -0.5)}) {
      SCOPED_TRACE(c.form);
      Reading expected = base(at);
      expected.*c.channel += c.offset;
      expect_same_bits(with({"sensor_offset", c.form, {{"a", c.offset}}}, at), expected);
    }
}

// A load cell that is off by a: the wheel behaves as one that carries W + a, on a slope and at yaw too.
TEST(SensorOffset, OfTheLoadIsTheWheelThatCarriesMore) {
  for (const double off : {150.0, -150.0})
    for (const ForceFrame frame : {ForceFrame::travel, ForceFrame::wheel}) {
      OperatingCondition at = driven(800, 0.2);
      at.longitudinal_incline = 8 * degree, at.transverse_incline = -6 * degree, at.yaw = 12 * degree;
      at.force_frame = frame;
      OperatingCondition carried = at;
      carried.load += off;
      const Reading expected = base(carried), found = with({"sensor_offset", "load", {{"a", off}}}, at);
      EXPECT_NEAR(found.drawbar_pull, expected.drawbar_pull, 1e-7 * at.load);
      EXPECT_NEAR(found.torque, expected.torque, 1e-7 * at.load);
      EXPECT_NEAR(found.sinkage, expected.sinkage, 1e-9);
      EXPECT_NEAR(found.lateral_force, expected.lateral_force, 1e-7 * at.load);
    }
}

// Ten instruments under one title: each form tells people which one is off.
TEST(SensorOffset, EachFormHasAMeaningOfItsOwn) {
  std::set<std::string> meanings;
  int forms = 0;
  for (const EffectForm& form : effect_catalogue()) {
    if (form.id != "sensor_offset") continue;
    ++forms;
    EXPECT_FALSE(form.meaning.empty()) << form.form;
    meanings.insert(form.meaning);
  }
  EXPECT_EQ(std::ssize(meanings), forms);
}

TEST(SensorOffset, GainScalesItsOwnChannelOnly) {
  for (const Channel& channel : measured_channels)
    for (const OperatingCondition& at : {driven(800, 0.2), driven(300, -0.5)}) {
      SCOPED_TRACE(channel.name);
      Reading expected = base(at);
      expected.*channel.value *= 1 - 0.12;
      expect_same_bits(with({"sensor_offset", std::string(channel.name) + "_gain", {{"a", -0.12}}}, at), expected);
    }
}

// A slip told by a rolling radius of (1 + a) r: told 0.2 with a = -0.05, v/(r w) is 0.76 and the wheel slips by 0.24.
TEST(SensorOffset, OfTheSlipIsTheWheelAtTheSlipThatItHas) {
  const auto told_by = [](double a, OperatingCondition at, double truly) {
    SCOPED_TRACE(at.slip);
    const Reading found = with({"sensor_offset", "slip", {{"a", a}}}, at);
    at.slip = truly;
    const Reading expected = base(at);
    EXPECT_NEAR(found.drawbar_pull, expected.drawbar_pull, 1e-9 * at.load);
    EXPECT_NEAR(found.torque, expected.torque, 1e-9 * at.load);
    EXPECT_NEAR(found.sinkage, expected.sinkage, 1e-12);
    EXPECT_NEAR(found.lateral_force, expected.lateral_force, 1e-9 * at.load);
  };
  OperatingCondition yawed = driven(800, 0.2);
  yawed.yaw = 15 * degree;
  for (const OperatingCondition& at : {driven(800, 0.2), yawed}) told_by(-0.05, at, 0.24);
  told_by(0.05, driven(800, 0.0), 1 / 1.05 - 1);  // drives no more: v/(r w) = 1.05
  told_by(0.05, driven(800, 1.0), 1.0);
  told_by(0.05, driven(800, -1.0), -1.0);
}

}  // namespace
}  // namespace soilbin::bekker_wong::bed
