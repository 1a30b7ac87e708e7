// The part of a drive in which nothing changes any more: drives whose every sample is written by hand.
#include "dem/rig/steady_drive.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace soilbin::dem {
namespace {

/// A ramp of 1 s; the way changes for the last time at 0.5 m.
Drive made_drive() {
  Drive drive;
  drive.load = 100, drive.duration = 10, drive.controller.ramp = 1;
  Waypoint last;
  last.at = 0.5;
  drive.profile = {Waypoint{}, last};
  return drive;
}

/// A sample each eighth of a second; the wheel goes 1 m/s from the start, and everything else is the same throughout.
GrainDriveRecord made_record(std::size_t samples) {
  GrainDriveRecord record;
  for (std::size_t k = 0; k < samples; ++k) {
    GrainDriveSample sample;
    sample.time = sample.travelled = 0.125 * static_cast<double>(k);
    sample.speed = 1, sample.rim_speed = 1.25, sample.slip = 0.2, sample.sinkage = 0.01;
    sample.torque = 3, sample.forward = 25;
    record.samples.push_back(sample);
  }
  return record;
}

// The ramp ends with sample 8; sample 9 is the first that lies wholly behind it. The sixteenth from there is 24.
TEST(SteadyDrive, NeedsSixteenSamplesBehindTheRamp) {
  GrainDriveRecord enough = made_record(25), too_few = made_record(24);
  find_steady_part(enough, made_drive(), 3);
  find_steady_part(too_few, made_drive(), 3);
  ASSERT_TRUE(enough.steady);
  EXPECT_TRUE(enough.steady->steady);
  EXPECT_EQ(enough.steady->from, 9 * 0.125);
  EXPECT_EQ(enough.steady->to, 24 * 0.125);
  EXPECT_EQ(enough.not_steady, "");
  EXPECT_FALSE(too_few.steady);
  EXPECT_THAT(too_few.not_steady, testing::HasSubstr("ended before"));
}

TEST(SteadyDrive, TellsTheMeansOfWhatDoesNotChange) {
  GrainDriveRecord record = made_record(40);
  record.samples[0].torque = record.samples[8].speed = 1e6;  // of the ramp, which doesn't count
  find_steady_part(record, made_drive(), 3);
  ASSERT_TRUE(record.steady);
  const SteadyDrive& s = *record.steady;
  EXPECT_EQ(s.speed.value, 1);
  EXPECT_EQ(s.rim_speed.value, 1.25);
  EXPECT_NEAR(s.slip.value, 0.2, 1e-15);
  EXPECT_NEAR(s.sinkage.value, 0.01, 1e-15);
  EXPECT_EQ(s.torque.value, 3);
  EXPECT_EQ(s.forward.value, 25);
  EXPECT_EQ(s.drift, 0);
}

// The place where the way changes for the last time counts as the ramp does: at 2 m it is behind sample 16.
TEST(SteadyDrive, BeginsBehindTheLastChangeOfTheWay) {
  Drive drive = made_drive();
  drive.profile.back().at = 2;
  GrainDriveRecord record = made_record(40);
  find_steady_part(record, drive, 3);
  ASSERT_TRUE(record.steady);
  EXPECT_EQ(record.steady->from, 17 * 0.125);
}

// Halves that differ by far more than their errors drift.
TEST(SteadyDrive, ADriftIsTold) {
  GrainDriveRecord record = made_record(49);  // forty behind the ramp
  for (std::size_t k = 0; k < 49; ++k)
    record.samples[k].sinkage = 1e-3 * static_cast<double>(k) + (k % 2 == 0 ? 1e-5 : -1e-5);
  find_steady_part(record, made_drive(), 3);
  ASSERT_TRUE(record.steady);
  EXPECT_GT(record.steady->drift, 3);
  EXPECT_FALSE(record.steady->steady);
}

TEST(SteadyDrive, AWheelThatGoesNowhereHasNone) {
  for (const DriveEnd end : {DriveEnd::stuck, DriveEnd::buried, DriveEnd::rolled_back}) {
    GrainDriveRecord record = made_record(40);
    record.end = end;
    find_steady_part(record, made_drive(), 3);
    EXPECT_FALSE(record.steady);
    EXPECT_EQ(record.not_steady, "the wheel is " + std::string(word_of(end)));
  }
}

}  // namespace
}  // namespace soilbin::dem
