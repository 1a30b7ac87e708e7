// Records: what comes back is what was kept, nothing else is answered, and nobody mixes up two questions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "compare/recorded/recorded_model.hpp"
#include "compare/telling/answer_report.hpp"
#include "scenario/errors.hpp"
#include "scenario/file_bytes.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin::compare {
namespace {

using testing::HasSubstr;

OperatingCondition recorded_condition(double load, double slip) {
  OperatingCondition at;
  at.load = load, at.slip = slip, at.speed = 0.1, at.yaw = 0.1;
  return at;
}

/// A run with a different, awkward number in every member.
RecordedRun made_run(double load, double slip, std::uint64_t packing, double pull = 1.0 / 3) {
  TractionResult r;
  r.at = recorded_condition(load, slip);
  r.drawbar_pull = {pull, 0.1}, r.torque = {2.0 / 7, 0.2}, r.sinkage = {1e-300, 1e-3}, r.lateral_force = {-0.7, 0.4};
  r.tractive_efficiency = std::nan(""), r.entry_angle = 0.61, r.max_stress_angle = 0.3, r.exit_angle = -0.11;
  r.budget = {{"shear_thrust", 0.9}, {"slope", -0.2}};
  r.patch = {{-0.1, 10.0 / 3, -3, 0.5}, {0.2, 20, 4, -0.25}};
  RecordedRun run{.answer = {r.at, r, ""},
                  .packing = packing,
                  .source = "abc",
                  .seconds = 12.5,
                  .steady = true,
                  .drift = 1.25,
                  .power = {},
                  .rut = {},
                  .flow = {}};
  run.power.drive = 5, run.power.pull = 1.5, run.power.rest = 1e-17, run.power.losses.sliding = 2.5;
  run.rut.y = {-0.1, 0.1}, run.rut.across = {1e-3, -1.0 / 7}, run.rut.axle = 2.25;
  run.bed = {0.526, 1614, 5.5};
  run.flow.cell = 0.04, run.flow.nx = 2, run.flow.nz = 1, run.flow.vx = {std::nan(""), 1.0 / 9};
  return run;
}

RecordedRun failed_run(double load, std::uint64_t packing = 1) {
  const OperatingCondition at = recorded_condition(load, 0.6);
  return {.answer = {at, std::nullopt, "the wheel dug itself in"},
          .packing = packing,
          .source = "abc",
          .seconds = 1,
          .power = {},
          .rut = {},
          .flow = {}};
}

Record made_record() {
  Record record{"0.1.0", "dem", "name: made\nstudy: \"a, b\"\n", {{"bed.length", "2.5"}, {"tire.radius", "0.496"}}, {}};
  record.runs = {made_run(2000, 0.2, 1), made_run(2000, 0.2, 2, 1.0), failed_run(2000)};
  return record;
}

TEST(Record, TellsHowDenseItsBedsAre) {
  Record record = made_record();
  record.runs[1].bed.void_ratio = 0.531;
  EXPECT_EQ(parse_record({"r.json", record_text(record)}).runs[0].bed.bulk, 1614);
  EXPECT_THAT(notes_on(record.runs, ""), testing::Contains("bed: void ratio 0.526 to 0.531"));
  EXPECT_THAT(notes_on({record.runs[0]}, ""), testing::Contains("bed: void ratio 0.526"));
}

TEST(Record, FromBeforeBedsWereToldSaysNothingOfThem) {
  Record old = made_record();
  old.sealed = false;
  for (RecordedRun& run : old.runs) run.sealed = false;
  std::string text = record_text(old);
  const std::string key = R"("bed":{"void_ratio":0.526,"bulk_density":1614.0,"coordination":5.5},)";
  ASSERT_THAT(text, HasSubstr(key));
  for (std::size_t at; (at = text.find(key)) != std::string::npos;) text.erase(at, key.size());
  const Record back = parse_record({"old.json", text});
  EXPECT_TRUE(std::isnan(back.runs[0].bed.void_ratio));
  EXPECT_THAT(notes_on(back.runs, ""), testing::Not(testing::Contains(HasSubstr("void ratio"))));
}

TEST(Record, FromBeforeTheRestWasToldKeepsItWithoutABound) {
  Record old = made_record();
  old.runs[0].answer.result->budget.push_back({"between_samples", -0.125});
  old.sealed = false;  // nor were there seals
  for (RecordedRun& run : old.runs) run.sealed = false;
  std::string text = record_text(old);
  const std::string key = R"("budget_rest":{"force":null,"bound":null},)";
  ASSERT_THAT(text, HasSubstr(key));
  for (std::size_t at; (at = text.find(key)) != std::string::npos;) text.erase(at, key.size());
  const TractionResult told = *parse_record({"old.json", text}).runs[0].answer.result;
  EXPECT_EQ(told.budget.size(), 2U);
  EXPECT_EQ(told.budget_rest.force, -0.125);
  EXPECT_TRUE(std::isnan(told.budget_rest.bound));
}

TEST(Record, ComesBackToTheBit) {
  const Record record = made_record();
  const std::string text = record_text(record);
  const Record back = parse_record({"r.json", text});
  EXPECT_EQ(record_text(back), text);
  ASSERT_EQ(back.runs.size(), 3U);
  const TractionResult &a = *record.runs[0].answer.result, &b = *back.runs[0].answer.result;
  EXPECT_EQ(b.drawbar_pull.value, a.drawbar_pull.value);
  EXPECT_EQ(b.sinkage.value, 1e-300);
  EXPECT_EQ(b.lateral_force.std_error, 0.4);
  EXPECT_TRUE(std::isnan(b.tractive_efficiency));
  EXPECT_EQ(b.at.yaw, 0.1);
  EXPECT_EQ(b.patch.at(0).normal, 10.0 / 3);
  EXPECT_EQ(b.budget.at(1).name, "slope");
  EXPECT_EQ(back.runs[0].power.losses.sliding, 2.5);
  EXPECT_EQ(back.runs[0].power.rest, 1e-17);
  EXPECT_TRUE(back.runs[0].steady);
  EXPECT_EQ(back.runs[0].rut.across, (std::vector{1e-3, -1.0 / 7}));
  EXPECT_EQ(back.runs[0].flow.nx, 2);
  EXPECT_TRUE(std::isnan(back.runs[0].flow.vx.at(0)));
  EXPECT_EQ(back.runs[0].flow.vx.at(1), 1.0 / 9);
  EXPECT_EQ(back.runs[1].packing, 2U);
  EXPECT_FALSE(back.runs[2].answer.result);
  EXPECT_EQ(back.runs[2].answer.error, "the wheel dug itself in");
  EXPECT_EQ(back.question, record.question);
  EXPECT_EQ(back.inputs, record.inputs);
}

TEST(Record, SchemaNamesEveryKeyOfARow) {
  const auto row = nlohmann::ordered_json::parse(record_text(made_record()))["runs"][0];
  const auto properties = record_schema()["properties"]["runs"]["items"]["properties"];
  for (const auto& [key, value] : row.items()) EXPECT_TRUE(properties.contains(key)) << key;
}

/// What a record says, whatever vouches for it.
std::string said_by(Record record) {
  for (RecordedRun& run : record.runs) run.sealed = false;
  record.sealed = false;
  return record_text(record);
}

void expect_refused(const std::string& text, const std::string& words) {
  EXPECT_THAT(soilbin::test::refusal([&] { parse_record({"r.json", text}); }), HasSubstr(words));
}

TEST(Record, NamesThePlaceOfWhatIsWrong) {
  expect_refused("{\"format\":", "r.json:1");
  expect_refused("{}", "format is missing");
  expect_refused("{\"format\": \"soilbin-case/1\"}", "soilbin-recorded/1");
  const std::string text = said_by(made_record());
  const std::string key = "\"torque\":0.2857142857142857";
  ASSERT_NE(text.find(key), std::string::npos);
  expect_refused(std::string(text).replace(text.find(key), key.size(), "\"torque\":\"much\""), "runs[0].torque");
  expect_refused(std::string(text).replace(text.find(key), key.size(), "\"torsion\":1"), "runs[0].torque is missing");
}

TEST(Record, RefusesWhatIsTooDeepOrTooLargeAndSaysWhere) {
  const std::string deep(100000, '[');
  expect_refused("{\"runs\":\n" + deep, "r.json:2:32: nested deeper than 32 levels");
  expect_refused("{\"a\": 1,\n \"b\": 1e309}", "r.json:2:7: this number is too large");
  std::string text = record_text(made_record());
  const std::string key = "\"packing\":2";
  ASSERT_NE(text.find(key), std::string::npos);
  expect_refused(text.replace(text.find(key), key.size(), "\"packing\":-2"), "runs[1]: its seal doesn't fit");
}

// Damage of one bit, anywhere: refused with the file's name, or nothing that is read has changed.
TEST(Record, NoFlippedBitChangesAnAnswer) {
  const std::string text = record_text(made_record()), said = said_by(made_record());
  std::mt19937 random(26);
  int refused = 0;
  constexpr int flips = 1500;
  for (int k = 0; k < flips; ++k) {
    std::string damaged = text;
    const std::size_t at = random() % text.size();
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << random() % 8));
    try {
      EXPECT_EQ(said_by(parse_record(make_source_text(damaged, "r.json"))), said) << "byte " << at;
    } catch (const InputError& error) {
      ++refused;
      EXPECT_THAT(error.what(), HasSubstr("r.json")) << "byte " << at;
    }
  }
  EXPECT_GT(refused, flips * 8 / 10) << "all but what stands in the name of a seal, or in blanks";
}

// As from before there were seals.
TEST(Record, WithoutSealsItIsReadAndSaysThatItHasNone) {
  const Record old = parse_record({"r.json", said_by(made_record())});
  EXPECT_FALSE(old.sealed);
  EXPECT_EQ(unsealed_note(old, "r.json").find("r.json: 3 of its 3 runs carry no seal"), 0U);
  EXPECT_EQ(unsealed_note(made_record(), "r.json"), "");
  EXPECT_EQ(record_text(old).find("seal"), std::string::npos) << "writing it again vouches for nothing";
  std::string other = said_by(made_record());
  const std::string key = "\"bed.length\": \"2.5\"";
  ASSERT_NE(other.find(key), std::string::npos);
  expect_refused(other.replace(other.find(key), key.size(), "\"bed.length\": \"3.5\""), "inputs don't fit their key");
}

TEST(Record, RefusesOtherInputsAndNamesThem) {
  const Record record = made_record();
  EXPECT_NO_THROW(refuse_other_inputs(record, record.inputs, "r.json"));
  const Inputs other = {{"bed.length", "4"}, {"tire.radius", "0.496"}, {"rig.skin", "0.2"}};
  const std::string why = soilbin::test::refusal([&] { refuse_other_inputs(record, other, "r.json"); });
  for (const char* words :
       {"r.json", "bed.length: 2.5 in the file, 4 asked for", "rig.skin: nothing in the file, 0.2 asked for", "hint"})
    EXPECT_THAT(why, HasSubstr(words));
  EXPECT_NO_THROW(refuse_other_inputs(record, other, "r.json", {"tire."}));
}

// But for two of before beds were told, which get that key.
TEST(SlowRecord, ThoseOfTheLibraryAreWrittenBackAsTheyAre) {
  int as_they_are = 0;
  for (const auto& entry : std::filesystem::directory_iterator(SOILBIN_SOURCE_DIR "/cases/studies/recorded")) {
    if (entry.path().extension() != ".json") continue;
    const Record record = read_record(entry);
    const std::string text = record_text(record);
    EXPECT_TRUE(record_text(parse_record({"again", text})) == text) << entry.path();
    const bool told =
        std::ranges::any_of(record.runs, [](const auto& run) { return std::isfinite(run.bed.void_ratio); });
    EXPECT_EQ(text == read_bytes(entry, 1 << 26), told) << entry.path();
    as_they_are += told;
  }
  EXPECT_EQ(as_they_are, 17);
}

TEST(RecordedModel, AnswersWhatIsThereAndSaysWhatIsNot) {
  const RecordedModel model(made_record());
  EXPECT_EQ(model.name(), "dem");
  const TractionResult mean = model.evaluate({}, recorded_condition(2000, 0.2));
  EXPECT_NEAR(mean.drawbar_pull.value, 2.0 / 3, 1e-15);
  EXPECT_EQ(mean.torque.value, 2.0 / 7);
  EXPECT_EQ(ask(model, {}, recorded_condition(2000, 0.6)).error, "the wheel dug itself in");
  EXPECT_THAT(ask(model, {}, recorded_condition(2000, 0.3)).error,
              HasSubstr("not in the record: no run at load 2 kN, slip 30 %"));
}

TEST(Packings, ScatterBetweenThemIsTheError) {
  RecordedRun one = made_run(1, 0, 1, 10), two = made_run(1, 0, 2, 13), three = made_run(1, 0, 3, 16);
  one.answer.result->budget_rest = {1, 3}, two.answer.result->budget_rest = {2, 4};
  three.answer.result->budget_rest = {3, 12};
  const TractionResult mean = mean_of_packings({&one, &two, &three});
  EXPECT_NEAR(mean.drawbar_pull.value, 13, 1e-12);
  EXPECT_NEAR(mean.drawbar_pull.std_error, 3 / std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(scatter_between({&one, &two, &three}, &TractionResult::drawbar_pull), 3, 1e-12);
  // Torques agree: what is left is the runs' own error, 0.2 each.
  EXPECT_NEAR(mean.torque.std_error, 0.2 / std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(mean.patch.at(1).normal, 20, 1e-12);
  EXPECT_NEAR(mean.budget.at(0).force, 0.9, 1e-12);
  EXPECT_NEAR(mean.budget_rest.force, 2, 1e-12);
  EXPECT_NEAR(mean.budget_rest.bound, 13.0 / 3, 1e-12) << "independent bounds: sqrt(9 + 16 + 144)/3";
  const RecordedRun failed = failed_run(1);
  EXPECT_EQ(mean_of_packings({&one, &failed}).drawbar_pull.value, one.answer.result->drawbar_pull.value)
      << "one that was stopped leaves the others' answer";
  EXPECT_THROW(mean_of_packings({&failed}), NoSolution);
  EXPECT_THROW(mean_of_packings({&failed, &failed}), NoSolution);
  EXPECT_THROW(mean_of_packings({}), InputError);
}

/// Five packings at 2 kN whose sinkages scatter by 3 mm where each run tells 1 mm, and one run at 4 kN.
Record record_of_scatter() {
  Record record;
  std::uint64_t packing = 0;
  for (const double millimetres : {-3, -3, 0, 3, 3}) {
    record.runs.push_back(made_run(2000, 0.2, ++packing));
    record.runs.back().answer.result->sinkage = {0.02 + 1e-3 * millimetres, 1e-3};
  }
  record.runs.push_back(made_run(4000, 0.2, 1));
  record.runs.back().answer.result->sinkage = {0.05, 1.5e-3};
  return record;
}

// A record that answers by itself, and a run alone beside others, tell the same.
TEST(Packings, WhatOthersScatterByIsInTheErrorOfARunAlone) {
  const Record record = record_of_scatter();
  const RecordedModel model(record);
  EXPECT_NEAR(model.evaluate({}, recorded_condition(4000, 0.2)).sinkage.std_error, 3 * 1.5e-3, 1e-15);
  EXPECT_NEAR(model.evaluate({}, recorded_condition(2000, 0.2)).sinkage.std_error, 3e-3 / std::sqrt(5.0), 1e-15);
  const TractionResult alone = told_answer({&record.runs.back()}, told_scatter(record.runs));
  EXPECT_NEAR(alone.sinkage.std_error, 3 * 1.5e-3, 1e-15);
  EXPECT_EQ(alone.torque.std_error, 0.2) << "torques agree: their own errors stand";
  EXPECT_EQ(alone.sinkage.value, 0.05);
}

TEST(Packings, EarlyErrorsOfTheSinkageCountTwice) {
  Record record = made_record();
  record.runs = {made_run(2000, 0.2, 1)};
  const auto at = recorded_condition(2000, 0.2);
  EXPECT_EQ(RecordedModel(record).evaluate({}, at).sinkage.std_error, 1e-3);
  record.runs[0].early_errors = true;
  const Record back = parse_record({"r.json", record_text(record)});
  EXPECT_TRUE(back.runs[0].early_errors);
  EXPECT_FALSE(parse_record({"r.json", record_text(made_record())}).runs[0].early_errors);
  EXPECT_EQ(RecordedModel(back).evaluate({}, at).sinkage.std_error, 2e-3);
  EXPECT_EQ(RecordedModel(back).evaluate({}, at).drawbar_pull.std_error, 0.1);
  // Two that agree by chance say little: three degrees of freedom or less leave the usual factor.
  record.runs.push_back(made_run(2000, 0.2, 2));
  EXPECT_NEAR(RecordedModel(record).evaluate({}, at).sinkage.std_error, 2e-3 / std::sqrt(2.0), 1e-15);
}

TEST(Record, AnOlderEfficiencyInTheWheelsAxesIsMended) {
  Record record = made_record();  // a yaw of 0.1, a wheel of 0.496 m
  TractionResult& told = *record.runs[0].answer.result;
  told.at.force_frame = ForceFrame::wheel;
  record.runs[0].answer.at = told.at;
  told.tractive_efficiency = told.drawbar_pull.value * 0.496 * 0.8 / std::cos(0.1) / told.torque.value;
  const double along_travel = told.drawbar_pull.value * std::cos(0.1) - told.lateral_force.value * std::sin(0.1);
  const Record back = parse_record({"r.json", record_text(record)});
  EXPECT_NEAR(back.runs[0].answer.result->tractive_efficiency,
              along_travel * 0.496 * 0.8 / std::cos(0.1) / told.torque.value, 1e-14);
}

}  // namespace
}  // namespace soilbin::compare
