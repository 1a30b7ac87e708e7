#include <gmock/gmock.h>

#include <cmath>

#include "cli/command.hpp"

namespace soilbin::cli::test {
namespace {

using testing::HasSubstr;

const std::string wheel = "--soil dry-sand --radius 110mm --width 100mm --load 80N ";

TEST(Estimate, FlagsAloneAnswerWithUnitsAndErrors) {
  const Outcome r = soilbin("estimate " + wheel + "--slip 0.2");
  EXPECT_EQ(r.status, 0) << r.err;
  for (const char* word :
       {"Drawbar pull", "Torque", "Sinkage", "N m", "mm", "±", "shear thrust", "load 80 N", "slip 20 %"})
    EXPECT_THAT(r.out, HasSubstr(word));
  EXPECT_EQ(r.err, "");
}

TEST(Estimate, JsonHasTheContractsNamesAndABudgetThatAddsUp) {
  const Outcome r = soilbin("estimate " + wheel + "--slip 20% --yaw 5deg --longitudinal-incline 3deg --json");
  ASSERT_EQ(r.status, 0) << r.err;
  const nlohmann::json row = r.json()["rows"].at(0);
  for (const char* key : {"drawbar_pull", "torque", "sinkage", "lateral_force", "theta_1"})
    EXPECT_TRUE(row.at(key).is_number()) << key;
  double sum = 0.0;
  for (const auto& part : row["budget"]) sum += part["force"].get<double>();
  EXPECT_NEAR(sum, row["drawbar_pull"].get<double>(), 1e-9);
  EXPECT_GT(row["std_error"]["drawbar_pull"].get<double>(), 0.0);
  EXPECT_NEAR(row["yaw"].get<double>(), 5 * std::acos(-1.0) / 180, 1e-12);
}

TEST(Estimate, NotANumberIsNull) {  // a locked wheel has no tractive efficiency
  const Outcome r = soilbin("estimate " + wheel + "--slip -1 --json");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_TRUE(r.json()["rows"].at(0).at("tractive_efficiency").is_null());
}

TEST(Estimate, AnEffectOfAmplitudeZeroChangesNothing) {
  const auto pull = [](const std::string& more) {
    return soilbin("estimate " + wheel + "--slip 0.2 --json " + more)
        .json()["rows"]
        .at(0)["drawbar_pull"]
        .get<double>();
  };
  EXPECT_EQ(pull("--effect slip_sinkage:lyasko,a=0"), pull(""));
  EXPECT_NE(pull("--effect slip_sinkage:lyasko,a=1"), pull(""));
}

TEST(Estimate, ABuriedWheelIsAnErrorWithStatusOne) {
  const Outcome text = soilbin("estimate " + wheel + "--load 80kN --slip 0.2");
  EXPECT_EQ(text.status, 2) << "a flag given twice is bad input";
  const Outcome r = soilbin("estimate --soil dry-sand --radius 110mm --width 100mm --load 80kN --slip 0.2 --json");
  EXPECT_EQ(r.status, 1);
  EXPECT_THAT(r.json()["rows"].at(0)["error"].get<std::string>(), HasSubstr("sink deeper"));
  EXPECT_THAT(r.err, HasSubstr("no solution"));
}

TEST(Estimate, BadInputNamesTheFlagAndTheNearestWord) {
  const struct {
    const char* arguments;
    const char* expected;
  } cases[] = {
      {"estimte", "did you mean 'estimate'?"},
      {"estimate --soill dry-sand", "did you mean '--soil'?"},
      {"estimate --soil dry-snad --radius 1m --width 1m --load 1N --slip 0", "did you mean 'dry-sand'?"},
      {"estimate --soil dry-sand --radius 110 --width 100mm --load 80N --slip 0.2", "--radius"},
      {"estimate --soil dry-sand --radius 110mm --width 100kPa --load 80N --slip 0.2", "--width"},
      {"estimate --soil dry-sand --radius 110mm --width 100mm --load 80N --slip 1.2", "--slip"},
      {"estimate --soil dry-sand --radius 110mm --width 100mm --slip 0.2", "--load"},
      {"estimate --soil dry-sand --load 80N --slip 0.2", "--radius"},
      {"estimate --radius 110mm --width 100mm --load 80N --slip 0.2", "which soil?"},
      {"estimate --soil dry-sand --tire rover-whel --load 80N --slip 0.2", "did you mean 'rover-wheel'?"},
      {"estimate --soil dry-sand --tire rover-wheel --load 80N --slip 0.2 --pass 1.5", "whole number"},
      {"estimate --soil dry-sand --tire rover-wheel --load 80N --slip 0.2 --slip-by travel", "travel_speed"},
      {"estimate --soil dry-sand --tire rover-wheel --load 80N --slip 0.2 --effect slip_sinkge", "slip_sinkage"},
      {"estimate --soil dry-sand --tire rover-wheel --load 80N --slip 0.2 --effect slip_sinkage:lyasco", "'lyasko'"},
      {"estimate --soil dry-sand --tire rover-wheel --load 80N --slip 0.2 --effect slip_sinkage,b=1",
       "no parameter 'b'"},
      {"estimate --soil dry-sand --tire rover-wheel --load 80N --slip 0.2 --effect slip_sinkage,a=99", "a:"},
      {"estimate no-such-case.yaml", "no such file"},
  };
  for (const auto& c : cases) {
    const Outcome r = soilbin(c.arguments);
    EXPECT_EQ(r.status, 2) << c.arguments;
    EXPECT_THAT(r.err, HasSubstr(c.expected)) << c.arguments;
    EXPECT_EQ(r.out, "") << c.arguments;
  }
}

TEST(Estimate, ACaseAnswersAllOrOneOfItsConditions) {
  EXPECT_EQ(soilbin("estimate paper-straight --json").json()["rows"].size(), 2U * 28U);
  const nlohmann::json one = soilbin("estimate paper-straight --load 4kN --slip 20% --json").json()["rows"];
  ASSERT_EQ(one.size(), 2U);
  EXPECT_EQ(one.at(0)["load"], 4000.0);
  EXPECT_NEAR(one.at(0)["speed"].get<double>(), 0.496 * 10 * 2 * std::acos(-1.0) / 60 * 0.8, 1e-9)
      << "the study's rotation stays";
}

TEST(Estimate, NoneSwitchesTheCasesEffectsOff) {
  const std::string point = "estimate rover-slip --slip 20% --json ";  // its models: the base, and with slip sinkage
  const auto both = soilbin(point).json()["rows"], base = soilbin(point + "--effect none").json()["rows"];
  ASSERT_EQ(both.size(), 2U);
  ASSERT_EQ(base.size(), 1U);
  EXPECT_EQ(base[0], both[0]);
  const Outcome mixed = soilbin(point + "--effect none --effect slip_sinkage");
  EXPECT_EQ(mixed.status, 2);
  EXPECT_NE(mixed.err.find("--effect none stands alone"), std::string::npos) << mixed.err;
}

TEST(Explain, TheBudgetAddsUpAndTheFaultOfEquationFiveIsNamed) {
  const std::string question = "explain " + wheel + "--slip 0.2 --effect bulldozing ";
  const Outcome text = soilbin(question);
  EXPECT_EQ(text.status, 0) << text.err;
  for (const char* word :
       {"Budget", "sum", "theta_1", "Bekker's static sinkage", "critical ground pressure", "Eq. 5", "faulty"})
    EXPECT_THAT(text.out, HasSubstr(word));
  const nlohmann::json row = soilbin(question + "--json").json()["rows"].at(0);
  double sum = 0.0;
  for (const auto& part : row["budget"]) sum += part["force"].get<double>();
  EXPECT_NEAR(sum, row["drawbar_pull"].get<double>(), 1e-9);
  EXPECT_EQ(row["effects"].size(), 1U);
}

}  // namespace
}  // namespace soilbin::cli::test
