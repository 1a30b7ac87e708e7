// drift: early runs against late ones.
#include "bekker_wong/bed_fixture.hpp"

namespace soilbin::bekker_wong::bed {
namespace {

OperatingCondition run(int n) {
  OperatingCondition at = driven();
  at.run = n;
  return at;
}

TEST(Drift, IsSilentAtTheReferenceAndAtAnUnknownRun) {
  expect_silent("drift", run(1));  // the default run_ref
  expect_silent("drift", driven());
}

// Soil that settles stiffens: later runs sink less and pull more. Strength that grows takes more torque.
TEST(Drift, SoilChangesFromRunToRun) {
  for (const char* form : {"stiffness", "stiffness_log"}) {
    SCOPED_TRACE(form);
    const Reading early = with({"drift", form, {{"run_ref", 10.0}}}, run(2)),
                  late = with({"drift", form, {{"run_ref", 10.0}}}, run(18));
    EXPECT_GT(early.sinkage, base(driven()).sinkage);
    EXPECT_LT(late.sinkage, base(driven()).sinkage);
    EXPECT_GT(late.drawbar_pull, early.drawbar_pull);
  }
  for (const char* form : {"strength", "strength_log"}) {
    SCOPED_TRACE(form);
    EXPECT_GT(with({"drift", form, {}}, run(18)).torque, with({"drift", form, {}}, run(2)).torque);
  }
}

// 10 runs past the reference at 0.01 a run: k times 1.1.
TEST(Drift, SoilByArithmetic) {
  SoilValues soil = sand();
  soil.k_c *= 1.1, soil.k_phi *= 1.1;
  const Reading found = with({"drift", "stiffness", {{"a", 0.01}, {"run_ref", 5.0}}}, run(15));
  EXPECT_NEAR(found.sinkage, roll(soil, {}, driven()).sinkage, 1e-13);
}

// A zero that creeps by 0.3 N a run from run 5 reads 3 N more in run 15; ln(16/8) of 0.3 N where it slows down and is
// counted from run 7. The other channels stay.
TEST(Drift, ZerosByArithmetic) {
  struct Case {
    const char* name;
    double Reading::*channel;
  };
  for (const Case& c : {Case{"drawbar_pull", &Reading::drawbar_pull}, Case{"torque", &Reading::torque},
                        Case{"sinkage", &Reading::sinkage}, Case{"lateral_force", &Reading::lateral_force}}) {
    SCOPED_TRACE(c.name);
    const double a = c.channel == &Reading::sinkage ? 0.0003 : 0.3;
    const Reading b = base(driven());
    Reading linear = with({"drift", c.name, {{"a", a}, {"run_ref", 5.0}}}, run(15));
    Reading slowing = with({"drift", std::string(c.name) + "_log", {{"a", a}, {"run_ref", 7.0}}}, run(15));
    EXPECT_NEAR(linear.*c.channel - b.*c.channel, 10 * a, 1e-12);
    EXPECT_NEAR(slowing.*c.channel - b.*c.channel, a * std::numbers::ln2, 1e-12);
    linear.*c.channel = slowing.*c.channel = b.*c.channel;
    expect_same_bits(linear, b);
    expect_same_bits(slowing, b);
  }
}

// Drift that slows down: the first ten runs move the zero further than the next ten.
TEST(Drift, LogarithmicDriftSlowsDown) {
  const auto pull = [](int n) { return with({"drift", "drawbar_pull_log", {}}, run(n)).drawbar_pull; };
  EXPECT_GT(pull(11) - pull(1), pull(21) - pull(11));
  EXPECT_GT(pull(21), pull(11));
}

}  // namespace
}  // namespace soilbin::bekker_wong::bed
