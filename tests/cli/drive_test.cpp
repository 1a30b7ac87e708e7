// soilbin drive and soilbin limits, as a person types them.
#include <gmock/gmock.h>

#include <algorithm>

#include "cli/command.hpp"

namespace soilbin::cli::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr const char* short_drive = R"(format: soilbin-case/1
name: start
tire: rover-wheel
soil: dry-sand
drive:
  load: 64.68 N
  duration: 3 s
  controller: {rim_speed: 5 cm/s}
)";

TEST(Drive, TheRoverClimbsUntilItIsStuckNearTheSteepestSlope) {
  const Outcome r = soilbin("drive rover-climb --json --samples 50");
  ASSERT_EQ(r.status, 0) << r.err;
  const nlohmann::json drive = r.json();
  EXPECT_EQ(drive["format"], "soilbin-drive/1");
  EXPECT_EQ(drive["end"], "stuck");
  const nlohmann::json& slope = drive["samples"]["longitudinal_incline_deg"];
  const double steepest = drive["steepest_steady_slope"].get<double>() * 180 / 3.14159265358979;
  EXPECT_NEAR(slope.back().get<double>(), steepest, 0.7);
  const nlohmann::json& energy = drive["energy"];
  EXPECT_LT(std::abs(energy["unaccounted"].get<double>()), 1e-5 * energy["motor"].get<double>());
  for (const auto& [name, values] : drive["samples"].items())
    EXPECT_EQ(values.size(), drive["samples"]["time_s"].size()) << name;
}

TEST(Drive, SpeaksWritesTableAndPage) {
  const Scratch scratch;
  const std::string file = scratch.write("start.yaml", short_drive).string(), csv = (scratch / "t.csv").string(),
                    page = (scratch / "p.html").string(), plot = (scratch / "p.svg").string();
  const Outcome r = soilbin("drive '" + file + "' --csv '" + csv + "' --report '" + page + "' --plot '" + plot + "'");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.out, AllOf(HasSubstr("Time is up after 3 s"), HasSubstr("shears the soil")));
  const std::string table = text_of(csv);
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 402) << "a heading and 401 samples";
  EXPECT_THAT(table, testing::StartsWith("time_s,travelled_m,speed_m_s"));
  EXPECT_THAT(text_of(page), AllOf(HasSubstr("Against time"), HasSubstr("<svg")));
  EXPECT_THAT(text_of(plot), HasSubstr("Sinkage [mm]"));
}

TEST(Drive, ACaseHasADriveOrAStudyAndEachCommandSaysWhich) {
  const Outcome drive = soilbin("drive rover-slip");
  EXPECT_EQ(drive.status, 2);
  EXPECT_THAT(drive.err, AllOf(HasSubstr("no section 'drive'"), HasSubstr("soilbin run rover-slip")));
  const Outcome run = soilbin("run rover-climb");
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("hint: soilbin drive rover-climb"));
  EXPECT_THAT(soilbin("drive rover-clim").err, HasSubstr("did you mean 'rover-climb'"));
  EXPECT_THAT(soilbin("check rover-climb").out, HasSubstr("a drive"));
}

TEST(Drive, AnEffectThatHoldsInASteadyStateOnlyIsRefused) {
  const Scratch scratch;
  const std::string file =
      scratch.write("start.yaml", std::string(short_drive) + "  effects: [slip_sinkage]\n").string();
  const Outcome r = soilbin("drive '" + file + "'");
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err, HasSubstr("a wheel driven in time can't take the effect slip_sinkage"));
}

TEST(LimitsCommand, TheSlipOnASlopeIsTheSlipOfNoPullThere) {
  const Outcome r = soilbin("limits --tire rover-wheel --soil dry-sand --load 64.68N --json");
  ASSERT_EQ(r.status, 0) << r.err;
  const nlohmann::json row = r.json()["rows"].at(0);
  ASSERT_GE(row["slopes"].size(), 3U);
  const nlohmann::json& second = row["slopes"].at(1);
  const Outcome there =
      soilbin("estimate --tire rover-wheel --soil dry-sand --load 64.68N --json --slip " +
              std::to_string(second["slip"].get<double>()) + " --longitudinal-incline " +
              std::to_string(second["longitudinal_incline"].get<double>() * 180 / 3.14159265358979) + "deg");
  EXPECT_NEAR(there.json()["rows"].at(0)["drawbar_pull"].get<double>(), 0.0, 1e-3);
  EXPECT_NEAR(row["slopes"].back()["largest_pull"].get<double>(), 0.0, 1e-5);
}

TEST(LimitsCommand, AsksForTheLoadAndNoMore) {
  const Outcome r = soilbin("limits --tire rover-wheel --soil dry-sand");
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err, HasSubstr("--load is missing"));
  EXPECT_THAT(soilbin("limits rover-slip").out, HasSubstr("slip_sinkage"));
}

}  // namespace
}  // namespace soilbin::cli::test
