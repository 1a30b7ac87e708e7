// The section `drive` of a case: what it may say, and what each mistake in it is answered with.
#include "scenario/drive.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenario/case.hpp"
#include "scenario/unit.hpp"
#include "tests/scenario/fake_vocabulary.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin {
namespace {

using test::FakeVocabulary;
using test::refusal;
using testing::AllOf;
using testing::HasSubstr;

const std::string good_drive = R"(format: soilbin-case/1
name: climb
tire: rover-wheel
soil: dry-sand
drive:
  load: 64.68 N
  duration: 30 s
  distance: 2 m
  controller: {rim_speed: 5 cm/s, highest_torque: 4 N m, ramp: 1 s}
  profile:
    - {at: 0 m, drawbar: 2 N}
    - {at: 50 cm, longitudinal_incline: 4 deg, yaw: 2 deg}
    - {at: 1 m, longitudinal_incline: 4 deg, soil: snow}
  effects:
    - {id: lug_thrust, form: blade, parameters: {angle: 20 deg}}
)";

Case parse_drive(const std::string& text) {
  return parse_case(make_source_text(text, "climb.yaml"), Library({SOILBIN_SOURCE_DIR "/cases"}), FakeVocabulary());
}

std::string drive_with(const std::string& from, const std::string& to) {
  std::string text = good_drive;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string refused_drive(const std::string& from, const std::string& to) {
  return refusal([&] { parse_drive(drive_with(from, to)); });
}

TEST(DriveSection, IsReadWithItsUnitsAndDefaults) {
  const Case c = parse_drive(good_drive);
  ASSERT_TRUE(c.drive);
  const Drive& d = *c.drive;
  EXPECT_TRUE(c.study.conditions.empty()) << "a drive needs no study";
  EXPECT_EQ(d.controller.rim_speed, 0.05);
  EXPECT_EQ(d.controller.highest_torque, 4.0);
  EXPECT_EQ(d.distance, 2.0);
  EXPECT_FALSE(d.mass);
  ASSERT_EQ(d.profile.size(), 3U);
  EXPECT_EQ(d.profile[0].drawbar, 2.0);
  EXPECT_EQ(d.profile[1].at, 0.5);
  EXPECT_DOUBLE_EQ(d.profile[1].longitudinal_incline, 4 * degree);
  EXPECT_FALSE(d.profile[1].soil);
  EXPECT_EQ(d.profile[2].soil.value().name, "snow");
  EXPECT_EQ(d.effects.at(0).form, "blade");
}

TEST(DriveSection, ResolvedItReadsBackToTheSameBytes) {
  const std::string resolved = write_case(parse_drive(good_drive), FakeVocabulary());
  EXPECT_THAT(resolved, AllOf(HasSubstr("rim_speed: 0.05 m/s"), HasSubstr("longitudinal_incline: 4 deg"),
                              HasSubstr("stuck_speed:"), testing::Not(HasSubstr("study:"))));
  const Case again = parse_case(make_source_text(resolved, "resolved.yaml"), Library(), FakeVocabulary());
  EXPECT_EQ(write_case(again, FakeVocabulary()), resolved);
  EXPECT_EQ(again.drive->profile[2].soil->semi_empirical->k_phi.value, 196720.0) << "the soil is written out";
}

TEST(DriveSection, MistakesAreNamedWithTheirPlace) {
  EXPECT_THAT(refused_drive("distance: 2 m", "distnace: 2 m"),
              AllOf(HasSubstr("climb.yaml:8:3"), HasSubstr("did you mean 'distance'")));
  EXPECT_THAT(refused_drive("duration: 30 s", "duration: 30"), HasSubstr("climb.yaml:7:13"));
  EXPECT_THAT(refused_drive("  duration: 30 s\n", ""), HasSubstr("key 'duration' is missing"));
  EXPECT_THAT(refused_drive("at: 50 cm, longitudinal_incline", "at: 50 cm, longitudnal_incline"),
              AllOf(HasSubstr("climb.yaml:12:"), HasSubstr("did you mean 'longitudinal_incline'")));
  EXPECT_THAT(refused_drive("soil: snow", "soil: snwo"), AllOf(HasSubstr("climb.yaml:13:"), HasSubstr("'snow'")));
  EXPECT_THAT(refused_drive("at: 50 cm", "at: 2 m"), HasSubstr("the places of the profile don't rise"));
  EXPECT_THAT(refused_drive("rim_speed: 5 cm/s,", "rim_speed: 5 cm/s, torque: 2 N m,"),
              HasSubstr("either 'rim_speed' or 'torque'"));
  EXPECT_THAT(refused_drive("rim_speed: 5 cm/s,", "torque: 2 N m,"), HasSubstr("'highest_torque' belongs to"));
  EXPECT_THAT(refused_drive("drive:", "driev:"), HasSubstr("did you mean 'drive'"));
  EXPECT_THAT(refusal([] { parse_drive(good_drive.substr(0, good_drive.find("drive:"))); }),
              HasSubstr("key 'study' is missing"));
}

}  // namespace
}  // namespace soilbin
