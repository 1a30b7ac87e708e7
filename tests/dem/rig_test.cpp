// The rig: conditions as vectors, stresses from contacts, and wheels on a small bed against what must hold of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dem/rig/dem_model.hpp"
#include "dem/rig/wheel_in_bin.hpp"
#include "scenario/errors.hpp"
#include "scenario/unit.hpp"
#include "tests/dem/small_bed.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin::dem {
namespace {

using std::numbers::pi;
using test::with_threads;
using ::testing::AllOf;
using ::testing::HasSubstr;

OperatingCondition condition(double load, double slip, double speed) {
  OperatingCondition at;
  at.load = load, at.slip = slip, at.speed = speed;
  return at;
}

TEST(WheelMotion, InclinesTurnTheLoad) {
  OperatingCondition at = condition(100, 0, 1);
  at.longitudinal_incline = 10 * degree, at.transverse_incline = 5 * degree;
  const Vec3 load = wheel_motion(at, 0.5).load;
  EXPECT_NEAR(load.x, -100 * std::sin(10 * degree), 1e-12);
  EXPECT_NEAR(load.y, -100 * std::cos(10 * degree) * std::sin(5 * degree), 1e-12);
  EXPECT_NEAR(load.z, -100 * std::cos(10 * degree) * std::cos(5 * degree), 1e-12);
  EXPECT_NEAR(length(load), 100, 1e-12);
}

TEST(WheelMotion, SlipGivesTheRotationAndBack) {
  for (const double slip : {-0.99, -0.3, 0.0, 0.2, 0.6}) {
    const WheelMotion motion = wheel_motion(condition(1, slip, 0.4), 0.5);
    EXPECT_NEAR(slip_of(motion.speed, motion.rotation, 0.5), slip, 1e-12);
  }
  EXPECT_EQ(wheel_motion(condition(1, -1, 0.4), 0.5).rotation, 0);
}

TEST(WheelMotion, YawTurnsTheWheelToTheLeft) {
  OperatingCondition at = condition(1, 0.2, 1);
  at.yaw = 15 * degree;
  const WheelMotion motion = wheel_motion(at, 0.5);
  EXPECT_GT(motion.heading.y, 0);
  EXPECT_NEAR(length(cross(motion.axle, motion.heading) - Vec3{0, 0, -1}), 0, 1e-15);
  EXPECT_NEAR(motion.rotation, std::cos(15 * degree) / (0.5 * 0.8), 1e-12);
  at.slip_by = SlipBy::travel_speed;
  EXPECT_NEAR(wheel_motion(at, 0.5).rotation, 1 / (0.5 * 0.8), 1e-12);
  // The axes of the wheel and those of travel tell the same force.
  const NetForce travel = net_force({30, 40, 0}, motion, ForceFrame::travel);
  const NetForce wheel = net_force({30, 40, 0}, motion, ForceFrame::wheel);
  EXPECT_NEAR(wheel.drawbar_pull, travel.drawbar_pull * std::cos(at.yaw) + travel.lateral * std::sin(at.yaw), 1e-12);
  EXPECT_NEAR(wheel.lateral, -travel.drawbar_pull * std::sin(at.yaw) + travel.lateral * std::cos(at.yaw), 1e-12);
}

// As CMU's wheels did: across its travel a wheel still turns, and its slip is that of the whole speed.
TEST(WheelMotion, StandsAcrossItsTravelWhereSlipIsByTravelSpeed) {
  OperatingCondition at = condition(1, 0.2, 1);
  at.yaw = 90 * degree;
  EXPECT_THROW(wheel_motion(at, 0.5), InputError);
  at.slip_by = SlipBy::travel_speed;
  const WheelMotion motion = wheel_motion(at, 0.5);
  EXPECT_NEAR(motion.rotation, 1 / (0.5 * 0.8), 1e-12);
  EXPECT_NEAR(motion.heading.y, 1, 1e-15);
  at.yaw = 91 * degree;
  EXPECT_THROW(wheel_motion(at, 0.5), InputError);
}

TEST(WheelMotion, RefusesWhatCannotBeRun) {
  EXPECT_THROW(wheel_motion(condition(0, 0, 1), 0.5), InputError);
  EXPECT_THROW(wheel_motion(condition(1, 1, 1), 0.5), InputError);
  EXPECT_THROW(wheel_motion(condition(1, 0, 0), 0.5), InputError);
}

TEST(TreadForces, AddUpToTheForceOnTheWheel) {
  const WheelMotion motion = wheel_motion(condition(100, 0.2, 1), 0.5);
  Contact contact{};
  contact.second = -1 - 1;
  contact.point = {0.5 * std::sin(0.3), 0.05, 1 - 0.5 * std::cos(0.3)};
  contact.force = {3, -2, -7};  // on the grain
  Contact of_another = contact;
  of_another.second = -1;
  const TreadForces forces = tread_forces({contact, of_another}, 1, {0, 0, 1}, motion, 360);
  EXPECT_NEAR(forces.thrust + forces.resistance, -3, 1e-12);
  EXPECT_NEAR(forces.side, 2, 1e-12);

  Tire tire;
  tire.radius = 0.5, tire.width = 0.2;
  const std::vector<StressSample> stress = tread_stress(forces, 1, tire);
  ASSERT_EQ(stress.size(), 1u);
  EXPECT_NEAR(stress[0].theta, 0.3, 2 * pi / 360);
  const double area = 0.5 * 0.2 * 2 * pi / 360;
  // Pressing is against the outward normal (sin, -cos), shear along (cos, sin); the force on the wheel is (-3, 7).
  EXPECT_NEAR(stress[0].normal * area, 3 * std::sin(0.3) + 7 * std::cos(0.3), 1e-9);
  EXPECT_NEAR(stress[0].shear * area, -3 * std::cos(0.3) + 7 * std::sin(0.3), 1e-9);
  EXPECT_NEAR(stress[0].lateral_shear * area, 2, 1e-9);
}

/// A smooth wheel of 0.2 m on the small bed's grains.
class SlowSmallWheel : public ::testing::Test {
 protected:
  static const SettledBed& bed() {
    static const SettledBed bed = settle_bed(test::small_recipe({0.5, 0.16, 0.08}), with_threads(1));
    return bed;
  }
  static Tire wheel() { return test::small_wheel(); }
  static Rig rig() {
    Rig rig;
    rig.behind = 0.1, rig.ahead = 0.12, rig.travel = 0.25;
    rig.lowering = 0.1, rig.resting = 0.02, rig.starting = 0.05;
    return rig;
  }
  static WheelRun run(const OperatingCondition& at, const ContactPair& contact, const Rig& with = rig()) {
    return run_wheel({bed(), wheel(), contact, with}, at, with_threads(1));
  }
  /// On level ground at 30 % slip; several tests look at it.
  static const WheelRun& level() {
    static const WheelRun told = run(condition(load, 0.3, 0.3), rough());
    return told;
  }
  static ContactPair rough() { return bed().recipe.soil.grain_tire; }
  static constexpr double load = 20;
};

TEST_F(SlowSmallWheel, WithoutFrictionTakesNoTorqueAndIsPushedBack) {
  const WheelRun told =
      run(condition(load, 0.3, 0.3), {.restitution = 0.4, .sliding_friction = 0, .rolling_friction = 0});
  // The tread is a polygon: forces on its faces pass the axle by at most half a face, 10 mm, and on average by nothing.
  EXPECT_NEAR(told.result.torque.value, 0, 0.02 * load * wheel().radius);
  EXPECT_LT(told.result.drawbar_pull.value, 0);
}

TEST_F(SlowSmallWheel, BearsItsLoadAndBalancesItsPower) {
  const WheelRun& told = level();
  double borne = 0;
  for (std::size_t k = told.steady_from; k < told.samples.size(); ++k) borne += told.samples[k].force.z;
  borne /= static_cast<double>(told.samples.size() - told.steady_from);
  EXPECT_NEAR(borne, load, 0.05 * load);
  EXPECT_GT(told.result.torque.value, 0);
  EXPECT_LT(told.result.torque.value, 0.5 * 1.05 * load * wheel().radius);
  EXPECT_LT(told.result.drawbar_pull.value, told.result.torque.value / wheel().radius);
  EXPECT_NEAR(told.power.rest, 0, 0.03 * told.power.drive);
  EXPECT_GT(told.power.into_soil, 0);
  // The parts are the forces at the samples' ends, the pull is a mean over all steps.
  double parts = 0;
  for (const Contribution& part : told.result.budget) parts += part.force;
  const BudgetRest& rest = told.result.budget_rest;
  EXPECT_NEAR(told.result.drawbar_pull.value - parts, rest.force, 1e-9);
  EXPECT_LE(std::abs(rest.force), rest.bound);
  EXPECT_LT(rest.bound, 0.2 * load);
}

TEST_F(SlowSmallWheel, RollsFreelyWithoutTorqueAtASmallNegativeSlip) {
  Rig free = rig();
  free.drive_torque = 0;
  const WheelRun told = run(condition(load, 0, 0.3), rough(), free);
  EXPECT_NEAR(told.result.torque.value, 0, 0.02 * load * wheel().radius);
  EXPECT_LT(told.result.at.slip, 0.02);
  EXPECT_GT(told.result.at.slip, -0.4);
  EXPECT_LT(told.result.drawbar_pull.value, 0);
}

TEST_F(SlowSmallWheel, YawedToTheLeftIsPushedToTheLeft) {
  OperatingCondition at = condition(load, 0.2, 0.3);
  at.yaw = 8 * degree;
  const double left = run(at, rough()).result.lateral_force.value;
  at.yaw = -8 * degree;
  const double right = run(at, rough()).result.lateral_force.value;
  EXPECT_GT(left, 0.05 * load);
  EXPECT_LT(right, -0.05 * load);
}

TEST_F(SlowSmallWheel, UphillLosesTheLoadsShare) {
  OperatingCondition at = condition(load, 0.3, 0.3);
  at.longitudinal_incline = 10 * degree;
  const WheelRun up = run(at, rough());
  EXPECT_NEAR(level().result.drawbar_pull.value - up.result.drawbar_pull.value, load * std::sin(10 * degree),
              0.07 * load);
  EXPECT_NEAR(up.power.climb, load * std::sin(10 * degree) * 0.3, 1e-9);
}

TEST_F(SlowSmallWheel, GoesTheSecondTimeInItsOwnRut) {
  OperatingCondition at = condition(load, 0.3, 0.3);
  at.pass = 2;
  const WheelRun second = run(at, rough());
  ASSERT_FALSE(second.samples.empty());
  // It is put down where the first pass began, and told of the second way alone.
  EXPECT_NEAR(second.samples.front().travel, level().samples.front().travel, 2e-3);
  EXPECT_EQ(second.samples.size(), level().samples.size());
  EXPECT_EQ(second.surface, level().surface);
  // From the undisturbed surface it lies deeper, but by less than a grain's radius: the rut is firm.
  const double first = level().result.sinkage.value;
  EXPECT_GT(second.result.sinkage.value, first);
  EXPECT_LT(second.result.sinkage.value, first + bed().recipe.soil.radius_min);
  EXPECT_GT(second.rut.dug, level().rut.dug);
  at.pass = 0;
  EXPECT_THROW(run(at, rough()), InputError);
}

TEST_F(SlowSmallWheel, GivesTheSameForAnyNumberOfThreadsAndStopsWhenAsked) {
  const OperatingCondition at = condition(load, 0.3, 0.3);
  Rig brief = rig();
  brief.travel = 0.03;
  brief.lowering = 0.05, brief.resting = 0;
  const WheelRun one = run(at, rough(), brief);
  WorkOptions two = with_threads(2);
  double last = -1;
  two.progress = [&](const Progress& progress) {
    EXPECT_GE(progress.done, last);
    last = progress.done;
  };
  const WheelRun other = run_wheel({bed(), wheel(), rough(), brief}, at, two);
  EXPECT_EQ(one.result.torque.value, other.result.torque.value);
  EXPECT_EQ(one.result.sinkage.value, other.result.sinkage.value);
  EXPECT_GT(last, 0.9);

  std::stop_source source;
  source.request_stop();
  two.stop = source.get_token();
  EXPECT_THROW(run_wheel({bed(), wheel(), rough(), brief}, at, two), Stopped);
}

/// What way_in_bin says against it; "" where it says nothing.
std::string against(const BedSize& size, const Tire& tire, const Rig& rig) {
  return soilbin::test::error_of([&] { way_in_bin(size, tire, rig); });
}

// A wheel of 120 mm with lugs of 10 mm: its outer radius is 130 mm. At 50 mm from a wall it hangs over that from a
// sinkage of 130 - sqrt(130^2 - 50^2) = 10 mm on; 65 mm are half the outer radius.
TEST(WayInBin, HasRoomForTheWheelBehindAheadAndBeside) {
  Tire tire;
  tire.radius = 0.12, tire.width = 0.1, tire.lugs = {.height = 0.01, .count = 12, .thickness = 0.003};
  const BedSize size{0.7, 0.3, 0.1};
  Rig rig;
  rig.behind = 0.13, rig.ahead = 0.2;
  EXPECT_NEAR(way_in_bin(size, tire, rig), 0.37, 1e-12);
  EXPECT_NEAR(reach_at(tire, 0), 0.05, 1e-12);
  EXPECT_NEAR(reach_at(tire, 0.12), 0.13, 1e-12);
  rig.behind = 0.05;
  EXPECT_THAT(against(size, tire, rig), AllOf(HasSubstr("--behind 0.05 m"), HasSubstr("of 0.13 m outer radius"),
                                              HasSubstr("sunk by 0.01 m"), HasSubstr("hint: --behind 0.13m")));
  rig.behind = 0.066, rig.ahead = 0.064;
  EXPECT_THAT(against(size, tire, rig), HasSubstr("--ahead 0.064 m"));
  rig.ahead = 0.066;
  EXPECT_EQ(against(size, tire, rig), "");
  rig.behind = 0.35, rig.ahead = 0.5;
  EXPECT_THAT(against(size, tire, rig), AllOf(HasSubstr("no way: --behind keeps 0.35 m and --ahead 0.5 m")));
  EXPECT_THAT(against({2.5, 0.14, 0.1}, tire, rig),
              AllOf(HasSubstr("too narrow"), HasSubstr("hint: --bed-width 0.15m")));
}

TEST(WayInBin, ATravelThatTheBedIsTooShortForIsRefused) {
  Tire tire;
  tire.radius = 0.1, tire.width = 0.1;
  const BedSize size{1, 0.3, 0.1};
  Rig rig;
  rig.behind = 0.2, rig.ahead = 0.5, rig.travel = 1 - 0.7 + 1e-12;  // that much is rounding
  EXPECT_NEAR(way_in_bin(size, tire, rig), 0.3, 1e-12);
  rig.travel = 2;
  EXPECT_THAT(against(size, tire, rig), AllOf(HasSubstr("--travel 2 m is more than the 0.3 m that a bed of 1 m leaves"),
                                              HasSubstr("--bed-length 2.7m")));
}

// Before a bed is settled: the longest step is a fifth of the Rayleigh time; the engine itself decides just above it.
TEST(DemModel, AStepOrABedThatMakesNoSenseIsRefusedAtOnce) {
  DemSettings settings;
  settings.size = {0.5, 0.16, 0.08};
  settings.rig.behind = settings.rig.ahead = 0.12;
  Scenario scenario;
  scenario.tire = test::small_wheel();
  scenario.soil.granular = test::soft_soil();
  const auto says = [&] { return soilbin::test::error_of([&] { DemModel(settings).check(scenario); }); };
  EXPECT_EQ(says(), "");
  settings.rig.dt = 1.05 * longest_step(*scenario.soil.granular);
  EXPECT_EQ(says(), "");
  settings.rig.dt = 5 * longest_step(*scenario.soil.granular);
  EXPECT_THAT(says(), AllOf(HasSubstr("it is 1 of the Rayleigh time"), HasSubstr("--time-step")));
  settings.rig.dt = 0, settings.size.depth = 0.001;
  EXPECT_THAT(says(), HasSubstr("less than two grains"));
}

TEST_F(SlowSmallWheel, RefusesABedTooShortOrNarrow) {
  Rig far = rig();
  far.ahead = 0.45;
  EXPECT_THROW(run(condition(load, 0.3, 0.3), rough(), far), InputError);
  Tire wide = wheel();
  wide.width = 0.15;
  EXPECT_THROW(run_wheel({bed(), wide, rough(), rig()}, condition(load, 0.3, 0.3)), InputError);
}

TEST_F(SlowSmallWheel, AnswersAsAModel) {
  DemSettings settings;
  settings.size = {0.3, 0.14, 0.06};
  settings.rig = rig(), settings.rig.travel = 0;
  settings.how = with_threads(1);
  std::size_t samples = 0;
  settings.on_run = [&](const WheelRun& told) { samples = told.samples.size(); };
  const DemModel model(settings);
  Scenario scenario;
  scenario.tire = wheel();
  EXPECT_THROW(model.evaluate(scenario, condition(load, 0.3, 0.3)), InputError);
  scenario.soil.granular = bed().recipe.soil;
  EXPECT_EQ(model.recipe(scenario).gravity, BedRecipe().gravity);
  Scenario moon = scenario;
  moon.soil.granular->gravity = 1.62;
  EXPECT_EQ(model.recipe(moon).gravity, 1.62);
  const TractionResult told = model.evaluate(scenario, condition(load, 0.3, 0.3));
  EXPECT_GT(told.torque.value, 0);
  EXPECT_LT(told.torque.value, load * wheel().radius);
  EXPECT_GT(told.torque.std_error, 0);
  EXPECT_GT(samples, 10u);
  EXPECT_EQ(model.name(), "dem");
  scenario.effects.push_back({.id = "bulldozing", .form = "", .parameters = {}});
  EXPECT_THROW(model.evaluate(scenario, condition(load, 0.3, 0.3)), InputError);
}

}  // namespace
}  // namespace soilbin::dem
