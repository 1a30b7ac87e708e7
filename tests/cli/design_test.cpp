// soilbin design, run as a person runs it before any run is made.
#include <gmock/gmock.h>

#include "cli/command.hpp"

namespace soilbin::cli::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr const char* planned_campaign = R"(format: soilbin-campaign/1
name: planned
wheel: {radius: 125 mm, width: 100 mm}
soil: dry-sand
)";

TEST(DesignCommand, WritesRowsThatTheCampaignTakesOnceTheyAreFilledIn) {
  const Scratch scratch;
  scratch.write("campaign.yaml", planned_campaign);
  const std::string folder = (scratch / "").string(), rows = (scratch / "runs.csv").string();
  const Outcome outcome = soilbin("design '" + folder + "' --runs 12 --limit load=60N..140N --csv '" + rows + "'");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("12 runs to separate"));
  std::string text = text_of(rows);
  EXPECT_THAT(text, StartsWith("run,setpoint,load_N,slip,drawbar_pull_N,torque_Nm,sinkage_m\n"));
  // As yet nothing is measured: a design may be asked again, and the loop says what is missing.
  EXPECT_EQ(soilbin("design '" + folder + "' --runs 4 --limit load=60N..140N").status, 0);
  EXPECT_THAT(soilbin("loop '" + folder + "'").err, HasSubstr("no row holds a measured value"));
  for (std::size_t at; (at = text.find(",,,")) != std::string::npos;) text.replace(at, 3, ",5,3,0.02");
  scratch.write("runs.csv", text);
  const Outcome checked = soilbin("check '" + folder + "'");
  EXPECT_EQ(checked.status, 0) << checked.err;
  EXPECT_THAT(checked.out, HasSubstr("12 runs"));
}

// The same plan may be written again; rows that somebody has filled in, and any other file, stay.
TEST(DesignCommand, NeverWritesOverRowsThatAreFilledIn) {
  const Scratch scratch;
  scratch.write("campaign.yaml", planned_campaign);
  const std::string rows = (scratch / "runs.csv").string(), asked = "design '" + (scratch / "").string() +
                                                                    "' --runs 12 --limit load=60N..140N --csv '" +
                                                                    rows + "'";
  ASSERT_EQ(soilbin(asked).status, 0);
  EXPECT_EQ(soilbin(asked).status, 0);
  std::string filled_in = text_of(rows);
  filled_in.replace(filled_in.find(",,,"), 3, ",5,3,0.02");
  scratch.write("runs.csv", filled_in);
  const Outcome again = soilbin(asked);
  EXPECT_EQ(again.status, 2);
  EXPECT_EQ(again.out, "");
  EXPECT_THAT(again.err, testing::EndsWith("soilbin: " + rows +  // on a slow machine progress stands before it
                                           ": holds other rows than this plan, and stays as it is\n"
                                           "  hint: give --csv another name, or delete the file\n"));
  EXPECT_EQ(text_of(rows), filled_in);
}

TEST(DesignCommand, IsAPageAsWell) {
  const Scratch scratch;
  scratch.write("campaign.yaml", planned_campaign);
  const std::string page = (scratch / "plan.html").string();
  const Outcome outcome =
      soilbin("design '" + (scratch / "").string() + "' --runs 8 --limit load=60N..140N --report '" + page + "'");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(text_of(page), HasSubstr("8 runs to separate"));
}

// The rows stand in the campaign's own columns and units, so that they are read as they are once filled in.
TEST(DesignCommand, SpeaksInTheCampaignsUnits) {
  const Scratch scratch;
  scratch.write("campaign.yaml", std::string(planned_campaign) +
                                     "columns:\n  Weight kN: {quantity: load, unit: kN}\n  Slip: {quantity: slip, "
                                     "unit: '%'}\n  Pull lbf: {quantity: drawbar_pull, unit: lbf}\n");
  const std::string folder = (scratch / "").string(), rows = (scratch / "runs.csv").string();
  const Outcome outcome = soilbin("design '" + folder + "' --runs 12 --limit load=60N..140N --csv '" + rows + "'");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("load [kN]"));
  std::string text = text_of(rows);
  EXPECT_THAT(text, StartsWith("run,setpoint,Weight kN,Slip,Pull lbf,torque_Nm,sinkage_m\n1,"));
  for (std::size_t at; (at = text.find(",,,")) != std::string::npos;) text.replace(at, 3, ",5,3,0.02");
  scratch.write("runs.csv", text);
  const nlohmann::json runs = soilbin("predict '" + folder + "' --json").json()["rows"];
  ASSERT_EQ(runs.size(), 12U);
  for (const nlohmann::json& run : runs) {
    EXPECT_GE(run["at"]["load"].get<double>(), 60.0 - 1e-9);
    EXPECT_LE(run["at"]["load"].get<double>(), 140.0 + 1e-9);
  }
}

TEST(DesignCommand, AnswersAsJson) {
  const Scratch scratch;
  scratch.write("campaign.yaml", planned_campaign);
  const Outcome outcome = soilbin("design '" + (scratch / "campaign.yaml").string() +
                                  "' --runs 8 --limit load=60N..140N --limit speed=0.02m/s..0.2m/s --effect "
                                  "rate_dependence --effect slip_sinkage --noise drawbar_pull=1N --json");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const nlohmann::json answer = outcome.json();
  EXPECT_EQ(answer.at("format"), "soilbin-design/1");
  EXPECT_EQ(answer.at("runs").size(), 8U);
  EXPECT_TRUE(answer.at("runs").at(0).contains("speed_m_s"));
  EXPECT_EQ(answer.at("effects").size(), 2U);
  EXPECT_EQ(answer.at("pairs").size(), 4U);
  EXPECT_EQ(answer.at("noise").size(), 1U);
  EXPECT_GE(answer.at("named_right").get<double>(), answer.at("sweep").at("named_right").get<double>());
}

TEST(DesignCommand, RefusesWithAHint) {
  const Scratch scratch;
  scratch.write("campaign.yaml", planned_campaign);
  const std::string folder = "design '" + (scratch / "").string() + "' ";
  EXPECT_THAT(soilbin(folder), Refuses(HasSubstr("--limit load=60N..140N")));
  EXPECT_THAT(soilbin(folder + "--noise pull=1N").err, HasSubstr("channels are drawbar_pull"));
  EXPECT_THAT(soilbin(folder + "--noise torque=1N").err, HasSubstr("'N' is a force"));
  EXPECT_EQ(soilbin(folder + "--runs 3 --limit load=60N..140N").status, 2);
}

}  // namespace
}  // namespace soilbin::cli::test
