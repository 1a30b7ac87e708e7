// The model cone_index in the commands: run, compare, predict; what it takes, leaves out and refuses.
#include <gmock/gmock.h>

#include <string>

#include "tests/cli/command.hpp"

namespace soilbin::cli::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// A study of a pneumatic tire by the cone index alone or beside the analytic wheel.
std::string coned_study(const std::string& soil, const std::string& models, const std::string& more = "") {
  return "format: soilbin-case/1\nname: coned\n"
         "tire: {name: tire, radius: 352 mm, width: 226 mm, section_height: 150 mm, inflation_pressure: 100 kPa}\n"
         "soil: " +
         soil + "\nstudy:\n  models: [" + models + "]\n  conditions: {load: 4 kN, slip: [10 %, 30 %]" + more + "}\n";
}

const std::string loam = "{name: loam, cone_index: {value: 310 kPa, sd: 30 kPa}}";

Outcome run_on(const std::string& text, const std::string& flags = "") {
  const Scratch scratch;
  return soilbin("run '" + scratch.write("case.yaml", text).string() + "'" + flags);
}

TEST(ConeIndexCommand, AnswersWithoutASinkage) {
  const Outcome run = run_on(coned_study(loam, "cone_index"), " --json");
  ASSERT_EQ(run.status, 0) << run.err;
  const auto rows = run.json().at("rows");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].at("model"), "cone_index");
  EXPECT_GT(rows[0].at("drawbar_pull").get<double>(), 0.0);
  EXPECT_GT(rows[0].at("std_error").at("drawbar_pull").get<double>(), 0.0);
  EXPECT_TRUE(rows[0].at("sinkage").is_null());
  EXPECT_GT(rows[0].at("tractive_efficiency").get<double>(), 0.0);
}

TEST(ConeIndexCommand, SaysWhatItTakesAndLeavesOut) {
  const Outcome run = run_on(coned_study(loam, "cone_index", ", pass: 2"));
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.err, AllOf(HasSubstr("declares no load-deflection table"), HasSubstr("no sinkage, no stresses"),
                             HasSubstr("cone_index ignores the pass")));
  EXPECT_THAT(run.out, HasSubstr("standard deviation of the cone index"));
  EXPECT_THAT(run.out, Not(HasSubstr("nan")));
}

TEST(ConeIndexCommand, TakesTheConstructionOfTheTireAndSaysWhereThereIsNone) {
  const std::string unknown = coned_study(loam, "cone_index");
  std::string radial = unknown;
  radial.insert(radial.find(", inflation_pressure"), ", construction: radial");
  const Outcome without = run_on(unknown, " --slip 10% --json"), with = run_on(radial, " --slip 10% --json");
  EXPECT_THAT(without.err, HasSubstr("the tire declares no construction"));
  EXPECT_THAT(with.err, Not(HasSubstr("construction")));
  const auto pull = [](const Outcome& run) { return run.json().at("rows").at(0).at("drawbar_pull").get<double>(); };
  EXPECT_GT(pull(with), pull(without));
}

TEST(ConeIndexCommand, AnswersOneConditionWithoutAnglesOfContact) {
  const Outcome run = run_on(coned_study(loam, "cone_index"), " --slip 10%");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("efficiency"), Not(HasSubstr("nan")), Not(HasSubstr("entry"))));
}

TEST(ConeIndexCommand, TakesOneOfTheTwoValues) {
  EXPECT_THAT(run_on(coned_study("{cone_index: 300 kPa, cone_index_gradient: 4 MPa/m}", "cone_index")),
              Refuses(HasSubstr("give one of them")));
}

TEST(ConeIndexCommand, StandsBesideTheAnalyticWheelAndSaysThatTheirValuesAreLooselyRelated) {
  const Scratch scratch;
  const Outcome run = soilbin(
      "compare '" + scratch.write("case.yaml", coned_study("lean-clay", "bekker_wong, cone_index")).string() + "'");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("of cone index is"));
  EXPECT_THAT(run.out + run.err, HasSubstr("what relates their values is loose"));
  EXPECT_THAT(run.out, Not(HasSubstr("nan")));
}

TEST(ConeIndexCommand, PredictsACampaignThatDeclaresItsConeIndex) {
  const Scratch scratch;
  const std::string campaign =
      "format: soilbin-campaign/1\nname: coned\n"
      "wheel: {radius: 352 mm, width: 226 mm, section_height: 150 mm, inflation_pressure: 100 kPa}\n"
      "soil: lean-clay\ncone_index: {value: 310 kPa, sd: 30 kPa}\n";
  const std::string folder = scratch.write("campaign.yaml", campaign).parent_path().string();
  scratch.write("runs.csv", "load_N,slip,drawbar_pull_N,sinkage_m\n4000,0.1,800,0.03\n4000,0.3,1500,0.04\n");
  const Outcome run = soilbin("predict '" + folder + "' --model cone_index --json");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.json().at("error").at("drawbar_pull").at("runs"), 2);
  EXPECT_EQ(run.json().at("error").at("sinkage").at("runs"), 0);
  EXPECT_EQ(soilbin("predict cmu-smooth --model cone_index").status, 2) << "it declares none";
}

}  // namespace
}  // namespace soilbin::cli::test
