// soilbin runs: a time log that passes for a campaign, made one; and CSVs with decimal commas.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include <random>

#include "cli/command.hpp"

namespace soilbin::cli::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr const char* logged_campaign = R"(format: soilbin-campaign/1
name: logged
wheel: {radius: 110 mm, width: 100 mm}
soil:
  exponent:       {value: 1.10, sd: 0.05}
  k_c:            {value: 0.99 kN/m^(n+1), sd: 0.30 kN/m^(n+1)}
  k_phi:          {value: 1528 kN/m^(n+2), sd: 150 kN/m^(n+2)}
  cohesion:       {value: 1.04 kPa, sd: 0.30 kPa}
  friction_angle: {value: 28 deg, sd: 1.5 deg}
  shear_modulus:  {value: 20 mm, sd: 6 mm}
  stress_angle_c1: {value: 0.18, sd: 0.08}
  stress_angle_c2: {value: 0.32, sd: 0.08}
)";

/// Twelve runs of thirty samples as the model has them, each with an offset of its own bed.
std::string log_of_twelve_runs(unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::string csv = "load_N,slip,drawbar_pull_N,torque_Nm,sinkage_m\n";
  const Outcome told =
      soilbin("estimate --soil dry-sand --radius 110mm --width 100mm --load 60,80,100N --slip 5,15,30,50% --json");
  const nlohmann::json document = told.json();
  for (const auto& row : document.at("rows")) {
    const double load = row.at("load"), bed = 0.02 * load * normal(random), deeper = 0.0007 * normal(random);
    for (int i = 0; i < 30; ++i)
      csv += fmt::format("{},{},{:.5f},{:.5f},{:.7f}\n", load, row.at("slip").get<double>(),
                         row.at("drawbar_pull").get<double>() + bed + 0.4 * normal(random),
                         row.at("torque").get<double>() + 0.1 * bed + 0.03 * normal(random),
                         row.at("sinkage").get<double>() + deeper + 1e-4 * normal(random));
  }
  return csv;
}

// As 360 runs the loop took the beds' offsets for an effect, and check found nothing doubtful.
TEST(SlowRunsCommand, MakesACampaignOfALog) {
  for (const unsigned seed : {1U, 2U}) {
    const Scratch scratch;
    const std::string folder = "'" + (scratch / "").string() + "'", log = "'" + (scratch / "log.csv").string() + "'";
    scratch.write("campaign.yaml", logged_campaign);
    scratch.write("runs.csv", log_of_twelve_runs(seed)), scratch.write("log.csv", log_of_twelve_runs(seed));
    EXPECT_THAT(soilbin("check " + folder).out, HasSubstr("the rows look like samples of a time log"));
    EXPECT_THAT(soilbin("predict " + folder).err, HasSubstr("the rows look like samples of a time log"));
    fs::remove(scratch / "runs.csv");
    const Outcome made = soilbin("runs " + log + " --csv '" + (scratch / "runs.csv").string() + "'");
    ASSERT_EQ(made.status, 0) << made.err;
    EXPECT_THAT(made.out, AllOf(HasSubstr("12 runs of "), HasSubstr("effective"), HasSubstr("MSER-5")));
    EXPECT_THAT(soilbin("check " + folder).out,
                HasSubstr("12 runs of a wheel (r 110 mm, b 100 mm, smooth)\nno warnings"));
    const Outcome answer = soilbin("loop " + folder + " --json");
    ASSERT_EQ(answer.status, 0) << answer.err;
    EXPECT_EQ(answer.json().at("verdict"), "nothing_missing");
  }
}

TEST(RunsCommand, AnswersInJson) {
  const Scratch scratch;
  std::string csv = "run,load_N,slip,drawbar_pull_N\n";
  for (int i = 0; i < 40; ++i) csv += fmt::format("{},80,{},{}\n", 7 + i / 20, i < 20 ? 0.1 : 0.2, 10 + i % 2);
  const Outcome made = soilbin("runs '" + scratch.write("log.csv", csv).string() + "' --json");
  ASSERT_EQ(made.status, 0) << made.err;
  const auto document = made.json();
  EXPECT_EQ(document.at("format"), "soilbin-runs/1");
  ASSERT_EQ(document.at("runs").size(), 2U);
  EXPECT_EQ(document.at("runs")[1].at("lines"), (std::vector<int>{22, 41}));
  EXPECT_EQ(document.at("runs")[1].at("drawbar_pull").at("value"), 10.5);
  EXPECT_EQ(document.at("parted"), "Runs were separated by the changes of 'run'.");
  EXPECT_THAT(soilbin("runs '" + (scratch / "no.csv").string() + "'"), Refuses(HasSubstr("no.csv: no such file")));
}

TEST(RunsCommand, SaysWhatItFoundOnAPageAndInMarkdownToo) {
  const Scratch scratch;
  std::string csv = "t,load_N,slip,drawbar_pull_N\n";
  for (int i = 0; i < 40; ++i) csv += fmt::format("{},80,{},{}\n", i, i < 20 ? 0.1 : 0.2, 10 + i % 2);
  const std::string page = (scratch / "page.html").string(), folder = (scratch / "md").string();
  const Outcome made = soilbin("runs '" + scratch.write("log.csv", csv).string() + "' --report '" + page +
                               "' --markdown '" + folder + "'");
  ASSERT_EQ(made.status, 0) << made.err;
  for (const std::string& told : {made.out, text_of(page), text_of(folder + "/report.md")})
    EXPECT_THAT(told, AllOf(HasSubstr("and by breaks of the clock"), HasSubstr("2 runs form 1 unbroken period of time"),
                            HasSubstr("MSER-5")));
  EXPECT_THAT(text_of(folder + "/runs.csv"), StartsWith("run,setpoint,load_N,slip,drawbar_pull_N"));
}

TEST(DecimalCommaFlag, WritesWhatTheCommandsReadBack) {
  const Scratch scratch;
  const std::string file = (scratch / "a.csv").string();
  const std::string ask = "estimate --soil dry-sand --radius 110mm --width 100mm --load 80N --slip 0%..20%:5% ";
  ASSERT_EQ(soilbin(ask + "--csv '" + file + "' --decimal-comma").status, 0);
  EXPECT_THAT(text_of(file), AllOf(StartsWith("\xEF\xBB\xBFmodel;load_N;slip;"), HasSubstr(";80;0,05;0,1;0;")));
  EXPECT_THAT(soilbin(ask + "--decimal-comma").err, HasSubstr("--decimal-comma needs --csv"));
  EXPECT_THAT(soilbin("run paper-straight --decimal-comma"),
              Refuses(HasSubstr("--decimal-comma needs --csv or --output")));

  scratch.write("campaign.yaml", logged_campaign);
  scratch.write("runs.csv", "load_N;slip;drawbar_pull_N\n80;0,1;5,5\n80;0,2;6,25\n");
  const Outcome predicted = soilbin("predict '" + (scratch / "").string() + "' --json");
  ASSERT_EQ(predicted.status, 0) << predicted.err;
  EXPECT_EQ(predicted.json().at("rows")[1].at("measured").at("drawbar_pull"), 6.25);
}

}  // namespace
}  // namespace soilbin::cli::test
