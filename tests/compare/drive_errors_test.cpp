// What the standard deviations of the soil's values do to a drive.

#include <gmock/gmock.h>

#include <cmath>

#include "bekker_wong/drive_fixture.hpp"
#include "bekker_wong/limits.hpp"
#include "compare/drives/drive.hpp"
#include "compare/telling/reports.hpp"
#include "scenario/soil_parameters.hpp"

namespace soilbin::compare {
namespace {

namespace rover = bekker_wong::rover;

Estimate& value_of(Soil& soil, const char* name) { return (*soil.semi_empirical).*soil_parameter(name).value; }

/// The rover wheel on level ground or a slope, with the friction angle known to `sd`.
Case question(double slope, double duration, double sd) {
  Case asked;
  asked.name = "rover";
  asked.scenario = rover::scenario();
  value_of(asked.scenario.soil, "friction_angle").std_error = sd;
  asked.drive = rover::drive(slope, 0.0, duration);
  return asked;
}

double slip_with(const Soil& soil, double slope) {
  OperatingCondition at;
  at.load = rover::load, at.longitudinal_incline = slope, at.speed = 0.05;
  return slip_for_pull(
             bekker_wong::RollingWheel(rover::scenario().tire, bekker_wong::values_of(*soil.semi_empirical), {}), at)
      .value();
}

// Once the drive is steady, what a degree of friction adds to the way of a second is the rim's speed times what it
// takes from the static wheel's slip.
TEST(DriveErrors, GrowAsTheStaticWheelsSlipHasThem) {
  const double slope = 2 * degree, sd = 1 * degree;
  const AnalyticDrive early = run_drive(question(slope, 10, sd), 20), late = run_drive(question(slope, 16, sd), 20);
  ASSERT_EQ(early.errors.moved.size(), 1U);
  Soil lower = rover::scenario().soil, higher = lower;
  value_of(lower, "friction_angle").value -= sd, value_of(higher, "friction_angle").value += sd;
  const double expected = 0.05 * (slip_with(lower, slope) - slip_with(higher, slope)) / 2;
  EXPECT_NEAR((*late.errors.travelled - *early.errors.travelled) / 6 / expected, 1, 5e-3);
  EXPECT_EQ(late.errors.end_time, 0.0) << "time is up whatever the soil";
}

TEST(DriveErrors, SayWhichValueEndsTheDriveInAnotherWay) {
  Case asked = question(0, 40, 2 * degree);
  const double steepest = *run_drive(asked, 10).steepest;
  asked.drive->profile.front().longitudinal_incline = steepest - 0.5 * degree;  // climbs it, not with 2 deg less
  const AnalyticDrive part = run_drive(asked, 40);
  ASSERT_EQ(part.record.end, DriveEnd::time_is_up);
  ASSERT_EQ(part.errors.moved.size(), 1U);
  EXPECT_NE(part.errors.moved.front().lower.record.value().end, DriveEnd::time_is_up);
  EXPECT_EQ(part.errors.moved.front().higher.record.value().end, DriveEnd::time_is_up);
  EXPECT_FALSE(part.errors.end_time.has_value());
  EXPECT_FALSE(part.errors.travelled.has_value()) << "what a stuck wheel is short of is no standard error";
  EXPECT_THAT(text_of(report_on(part)),
              testing::HasSubstr("With the friction angle of dry-sand a standard deviation lower"));
}

TEST(DriveErrors, OfExactValuesThereAreNone) {
  const AnalyticDrive part = run_drive(question(0, 3, 0), 10);
  EXPECT_TRUE(part.errors.moved.empty());
  EXPECT_FALSE(part.errors.travelled.has_value());
  EXPECT_THAT(text_of(report_on(part)), testing::Not(testing::HasSubstr("±")));
}

TEST(DriveErrors, AreTheSameForAnyNumberOfThreads) {
  Case asked = question(0, 4, 1 * degree);
  value_of(asked.scenario.soil, "cohesion").std_error = 1e5;  // down to its bound, 0
  const DriveErrors one = run_drive(asked, 10, {}, 1).errors, two = run_drive(asked, 10, {}, 2).errors;
  EXPECT_EQ(one.travelled, two.travelled);
  ASSERT_EQ(one.moved.size(), 2U);
  EXPECT_EQ(one.moved.front().lower.value, 0.0);
}

// Two values of one fit, and a soil that comes back: what errs together adds up, or takes away, before it is squared.
TEST(DriveErrors, OfAFitAddUpAsItsCorrelationsHaveThem) {
  Case asked = question(2 * degree, 6, 1 * degree);
  value_of(asked.scenario.soil, "shear_modulus").std_error = 0.003;
  const auto with = [&](double correlation) {
    asked.drive->errors = {{"friction_angle", std::nullopt, {}}, {"shear_modulus", std::nullopt, {correlation}}};
    return run_drive(asked, 20);
  };
  const AnalyticDrive alone = with(0.0);
  ASSERT_EQ(alone.errors.moved.size(), 2U);
  const double way = alone.record.samples.back().travelled;
  const auto travelled = [](const bekker_wong::DriveRecord& r) { return std::optional(r.samples.back().travelled); };
  const double a = change(alone.errors.moved[0], way, travelled).value(),
               b = change(alone.errors.moved[1], way, travelled).value();
  EXPECT_NEAR(*alone.errors.travelled, std::hypot(a, b), 1e-12);
  EXPECT_FALSE(alone.errors.correlated());
  EXPECT_NEAR(*with(1.0).errors.travelled, std::abs(a + b), 1e-9);
  EXPECT_NEAR(*with(-1.0).errors.travelled, std::abs(a - b), 1e-9);
  EXPECT_NEAR(*with(0.5).errors.travelled, std::sqrt(a * a + b * b + a * b), 1e-9);
  const AnalyticDrive half = with(0.5);
  EXPECT_THAT(text_of(report_on(half)),
              testing::AllOf(testing::HasSubstr("err together"), testing::Not(testing::HasSubstr("Most of the ±"))));
}

TEST(DriveErrors, AnEffectsValueErrsWhereItsFitSaysSo) {
  Case asked = question(2 * degree, 6, 0);
  asked.drive->effects = {{"slip_sinkage", "ding", {{"n1", 0.4}}}};
  asked.drive->errors = {{"slip_sinkage.n1", 0.1, {}}};
  const AnalyticDrive part = run_drive(asked, 20);
  ASSERT_EQ(part.errors.moved.size(), 1U);
  EXPECT_EQ(part.errors.moved.front().parameter, "slip_sinkage.n1");
  EXPECT_GT(*part.errors.travelled, 0.0);
  EXPECT_GT(part.errors.moved.front().higher.record.value().samples.back().sinkage,
            part.errors.moved.front().lower.record.value().samples.back().sinkage);
}

TEST(DriveErrors, OfASoilThatComesBackAreThoseOfOneSoil) {
  Case asked = question(0, 6, 1 * degree), back = asked;
  for (const double at : {0.05, 0.1}) back.drive->profile.push_back({.at = at, .soil = asked.scenario.soil});
  const AnalyticDrive one = run_drive(asked, 20), returned = run_drive(back, 20);
  EXPECT_EQ(returned.errors.moved.size(), 1U);
  EXPECT_NEAR(*returned.errors.travelled / *one.errors.travelled, 1, 1e-3);
  back.drive->profile.back().soil->name = "another";
  EXPECT_EQ(run_drive(back, 20).errors.moved.size(), 2U) << "a soil of another name errs by itself";
}

TEST(DriveErrors, ChangeTakesTheSideThereIs) {
  bekker_wong::DriveRecord far;
  far.end_time = 12;
  MovedDrive drive{"sand", "cohesion", "cohesion c", "kPa", 1e-3, {1.0, 2.0}, {0.0, {}}, {3.0, far}};
  const auto time = [](const bekker_wong::DriveRecord& r) { return std::optional(r.end_time); };
  EXPECT_DOUBLE_EQ(*change(drive, 10.0, time), 2.0) << "all of it to the one side";
  bekker_wong::DriveRecord near;
  near.end_time = 9;
  drive.lower.record = near;
  EXPECT_DOUBLE_EQ(*change(drive, 10.0, time), 2.0) << "2 sd/3 of the 3 s between sides that are 1.5 sd apart";
  drive.lower.record.reset(), drive.higher.record.reset();
  EXPECT_FALSE(change(drive, 10.0, time).has_value());
}

}  // namespace
}  // namespace soilbin::compare
