// Whether a record's answers hang on its time step: which condition is tested, what counts as alike, what is told.
#include "compare/recorded/step_pair.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "compare/recorded/recorded_model.hpp"
#include "scenario/errors.hpp"

namespace soilbin::compare {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double degree = 0.017453292519943295;

RecordedRun pulling(double pull, double error, double load = 4000) {
  TractionResult result;
  result.at.load = load, result.at.slip = 0.2, result.at.speed = 0.4;
  result.drawbar_pull = {pull, error}, result.torque = {600, 10}, result.sinkage = {0.004, 0.001};
  return {.answer = {result.at, result, ""}, .source = "abc", .power = {}, .rut = {}, .flow = {}};
}

Record recorded(std::vector<RecordedRun> runs, std::vector<RecordedRun> half_step) {
  return {.soilbin = "0.1.0",
          .model = "dem",
          .question = "name: made\n",
          .inputs = {},
          .runs = std::move(runs),
          .half_step = std::move(half_step)};
}

TEST(StepPair, DifferencesCountInStandardErrorsOfTheDifference) {
  const Record record = recorded({pulling(1000, 30)}, {pulling(1100, 40)});
  const std::vector<StepPair> pairs = step_pairs(record);
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_EQ((*pairs[0].difference)[0].value, 100.0);
  EXPECT_DOUBLE_EQ((*pairs[0].difference)[0].std_error, 50.0);
  EXPECT_EQ((*pairs[0].difference)[1].value, 0.0);
  EXPECT_FALSE(pairs[0].widened);
  EXPECT_TRUE(agrees(pairs[0]));
  EXPECT_THAT(step_doubts(record), IsEmpty());
}

TEST(StepPair, BeyondTwoAndAHalfErrorsAnswersDependOnTheStep) {
  const Record record = recorded({pulling(1000, 30)}, {pulling(1125, 40)});
  EXPECT_FALSE(agrees(step_pairs(record).at(0)));
  EXPECT_THAT(in_words(step_doubts(record).at(0)),
              AllOf(HasSubstr("depend on the time step"), HasSubstr("125 ± 50 N (2.5 errors)")));
}

// Five packings at 970, 970, 1000, 1030, 1030 N scatter by 30 N where their runs' own errors are 10: errors count
// threefold, and what differs by 3.5 of a pair's own differs by 1.2.
TEST(StepPair, ErrorsHoldWhatPackingsScatterMoreThanTheirRunsTell) {
  std::vector<RecordedRun> runs;
  for (const double pull : {970.0, 970.0, 1000.0, 1030.0, 1030.0}) {
    runs.push_back(pulling(pull, 10));
    runs.back().packing = runs.size();
  }
  RecordedRun half = pulling(970 + 3.5 * std::hypot(10, 10), 10);
  half.packing = 1;
  const Record record = recorded(runs, {half});
  const StepPair pair = step_pairs(record).at(0);
  EXPECT_NEAR((*pair.difference)[0].std_error, 3 * std::hypot(10, 10), 1e-9);
  EXPECT_DOUBLE_EQ((*pair.difference)[1].std_error, std::hypot(10, 10)) << "torques agree: nothing to widen";
  EXPECT_TRUE(pair.widened);
  EXPECT_TRUE(agrees(pair));
  EXPECT_THAT(in_words(pair), HasSubstr("(1.2 errors)"));
  EXPECT_THAT(in_words(pair), HasSubstr("the errors include the scatter between bed samples"));
  EXPECT_FALSE(agrees(step_pairs(recorded({runs[0]}, {half})).at(0)));
}

// Sinkages of 4 mm that tell 1 mm each and differ by 3 mm: 2.1 of the pair's own errors, 1.1 where these are early
// ones.
TEST(StepPair, EarlyErrorsOfTheSinkageCountTwice) {
  RecordedRun whole = pulling(1000, 30), half = pulling(1000, 30);
  half.answer.result->sinkage.value += 0.003;
  EXPECT_NEAR((*step_pairs(recorded({whole}, {half})).at(0).difference)[2].std_error, 0.001 * std::sqrt(2.0), 1e-12);
  whole.early_errors = half.early_errors = true;
  const StepPair pair = step_pairs(recorded({whole}, {half})).at(0);
  EXPECT_NEAR((*pair.difference)[2].std_error, 0.002 * std::sqrt(2.0), 1e-12);
  EXPECT_TRUE(pair.widened);
}

TEST(StepPair, OneThatDiffersIsToldThoughOthersAgree) {
  const Record record =
      recorded({pulling(1000, 30), pulling(2000, 30, 8000)}, {pulling(1000, 30), pulling(2600, 30, 8000)});
  EXPECT_THAT(in_words(step_doubts(record).at(0)), HasSubstr("8 kN"));
}

TEST(StepPair, WithoutARunAtHalfTheStepNobodyKnows) {
  EXPECT_EQ(step_doubts(recorded({pulling(1000, 30)}, {})).at(0).kind, DoubtKind::step_untested);
}

TEST(StepPair, ARunWithoutAnswerAtHalfTheStepIsADifference) {
  RecordedRun stopped = pulling(1000, 30);
  stopped.answer.result.reset(), stopped.answer.error = "the wheel dug itself in";
  const Record record = recorded({pulling(1000, 30)}, {stopped});
  EXPECT_FALSE(agrees(step_pairs(record).at(0)));
  EXPECT_THAT(in_words(step_doubts(record).at(0)), HasSubstr("dug itself in"));
}

TEST(StepPair, ComesBackFromTheFileAndIsTold) {
  const Record record = recorded({pulling(1000, 30)}, {pulling(1400, 40)});
  const std::string text = record_text(record);
  const Record back = parse_record({"r.json", text});
  EXPECT_EQ(record_text(back), text);
  ASSERT_EQ(back.half_step.size(), 1U);
  EXPECT_EQ(back.half_step[0].answer.result->drawbar_pull.value, 1400.0);
  EXPECT_THAT(step_doubts(back), step_doubts(record));
  EXPECT_THAT(step_doubts(recorded({pulling(1, 1)}, {pulling(1, 1)})), IsEmpty());
}

TEST(StepPair, ARunAtHalfTheStepIsNoAnswer) {
  const Record record = recorded({}, {pulling(1400, 40)});
  EXPECT_THROW(RecordedModel(record).evaluate({}, record.half_step[0].answer.at), NoSolution);
}

TEST(StepPair, AChangedRunAtHalfTheStepIsRefused) {
  std::string text = record_text(recorded({pulling(1000, 30)}, {pulling(1400, 40)}));
  const std::size_t at = text.find("1400");
  ASSERT_NE(at, std::string::npos);
  text.replace(at, 4, "1000");
  EXPECT_THROW(parse_record({"r.json", text}), InputError);
}

TEST(StepPair, TheHardestConditionHasTheMostLoadThenInclineYawSlip) {
  const auto with = [](double load, double slip, double uphill = 0, double across = 0, double yaw = 0) {
    OperatingCondition at;
    at.load = load, at.slip = slip, at.yaw = yaw;
    at.longitudinal_incline = uphill, at.transverse_incline = across;
    return at;
  };
  const OperatingCondition light = with(2000, 0.6), heavy = with(8000, 0), slipping = with(8000, 0.6),
                           steep = with(8000, 0, -20 * degree), cross = with(8000, 0.1, 10 * degree, 15 * degree),
                           yawed = with(8000, 0, 0, 0, 10 * degree);
  EXPECT_EQ(hardest({light, heavy}).load, 8000);
  EXPECT_EQ(hardest({light, heavy, slipping}).slip, 0.6);
  EXPECT_EQ(hardest({slipping, yawed, heavy}).yaw, yawed.yaw);
  EXPECT_EQ(hardest({slipping, steep, yawed}).longitudinal_incline, steep.longitudinal_incline);
  EXPECT_EQ(hardest({steep, cross}).slip, 0.1);
  EXPECT_THROW(hardest({}), InputError);
}

}  // namespace
}  // namespace soilbin::compare
