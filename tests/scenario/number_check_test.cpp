// Numbers of structs made in code are held to the ranges that files are held to.
#include "scenario/number_check.hpp"

#include <gmock/gmock.h>

#include <limits>

#include "scenario/drive.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin::test {
namespace {

using testing::HasSubstr;

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();

Drive drive() {
  Drive d{.load = 100, .duration = 2};
  d.controller.rim_speed = 0.1;
  return d;
}

TEST(NumberCheck, TakesWhatAFileMayHold) {
  check_numbers(OperatingCondition{.load = 80, .slip = -1.0, .speed = 0.0, .yaw = right_angle});
  check_numbers(drive());
}

TEST(NumberCheck, NamesTheFirstNumberThatIsNoneOrOutOfRange) {
  const auto refused = [](const OperatingCondition& at, const char* says) {
    EXPECT_THAT(refusal([&] { check_numbers(at); }), HasSubstr(says));
  };
  refused({.load = 80, .slip = 1.2}, "slip: 1.2 is out of range, which is -1 .. 1");
  refused({.load = 80, .speed = nan}, "speed: nan is no number to work with");
  refused({.load = 80, .slip = 20}, "did you mean 0.2 (20 %)?");
  refused({.load = infinity}, "load: inf is no number to work with");
  refused({.load = 80, .pass = 0}, "pass: 0 is out of range, which is at least 1");
  refused({.load = 80, .moisture = -5.0}, "moisture: -5 is out of range");
}

TEST(NumberCheck, LooksIntoWhatAStructHolds) {
  Drive slow = drive();
  slow.controller.ramp = -1;
  EXPECT_THAT(refusal([&] { check_numbers(slow); }), HasSubstr("ramp: -1 is out of range"));
  Drive two = drive();
  two.controller.torque = 1.0;
  EXPECT_THAT(refusal([&] { check_numbers(two); }), HasSubstr("either 'rim_speed' or 'torque'"));
  Drive back = drive();
  back.profile = {{.at = 2}, {.at = 1}};
  EXPECT_THAT(refusal([&] { check_numbers(back); }), HasSubstr("the places of the profile don't rise"));
  Drive pulled = drive();
  pulled.profile = {{.at = 1, .drawbar = nan}};
  EXPECT_THAT(refusal([&] { check_numbers(pulled); }), HasSubstr("drawbar: nan"));
}

}  // namespace
}  // namespace soilbin::test
