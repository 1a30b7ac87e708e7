// sensor_offset: one channel off by a constant, the others untouched.
#include "bekker_wong/bed_fixture.hpp"

namespace soilbin::bekker_wong::bed {
namespace {

TEST(SensorOffset, ZeroAmplitudeIsTheBaseModel) {
  expect_base_at_zero("sensor_offset", driven());
  expect_heard("sensor_offset", driven());
}

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

}  // namespace
}  // namespace soilbin::bekker_wong::bed
