#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/command.hpp"

namespace soilbin::cli::test {
namespace {

using testing::AllOf;
using testing::DoubleNear;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

TEST(Run, AConditionWithoutSolutionCarriesItsErrorAndTheOthersStillCome) {
  const Scratch scratch;
  const fs::path file = scratch.write("case.yaml", R"(format: soilbin-case/1
name: heavy
tire: rover-wheel
soil: dry-sand
study:
  conditions: {load: [60 N, 60 kN], slip: [0 %, 20 %]}
)");
  const Outcome r = soilbin("run '" + file.string() + "' --json");
  ASSERT_EQ(r.status, 0) << r.err;
  const nlohmann::json rows = r.json()["rows"];
  ASSERT_EQ(rows.size(), 4U);
  for (const auto& row : rows) {
    EXPECT_EQ(row.contains("error"), row["load"] == 60000.0);
    EXPECT_EQ(row.contains("drawbar_pull"), row["load"] == 60.0);
  }
  const Outcome none = soilbin("run '" + file.string() + "' --load 60kN");
  EXPECT_EQ(none.status, 1);
  EXPECT_THAT(none.out, HasSubstr("no solution at load 60 kN"));
}

TEST(Run, WritesPlotTableAndResolvedCase) {
  const Scratch scratch;
  const std::string folder = (scratch / "out").string(), plot = (scratch / "p.svg").string(),
                    csv = (scratch / "t.csv").string();
  const Outcome r = soilbin("run rover-slip --plot '" + plot + "' --csv '" + csv + "' --output '" + folder + "'");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(text_of(plot), HasSubstr("<svg"));
  EXPECT_THAT(text_of(plot), HasSubstr("Drawbar pull [N]"));
  EXPECT_THAT(text_of(csv), HasSubstr("drawbar_pull_N"));
  EXPECT_EQ(text_of(csv), text_of(fs::path(folder) / "results.csv"));
  EXPECT_THAT(text_of(csv), HasSubstr(",error,remark\n"));
  EXPECT_THAT(text_of(csv), HasSubstr("% of its radius: unreliable above 50 %\n"));
  const Outcome again = soilbin("run '" + folder + "/case.yaml' --json");
  EXPECT_EQ(again.out, text_of(fs::path(folder) / "results.json")) << "the resolved case gives the same results";
}

TEST(Run, ConditionFlagsPickOrOverride) {
  EXPECT_EQ(soilbin("run paper-straight --load 4kN --json").json()["rows"].size(), 2U * 7U);
  const nlohmann::json overridden = soilbin("run paper-straight --load 3kN --json").json()["rows"];
  ASSERT_EQ(overridden.size(), 2U * 28U - 2U * 21U);
  EXPECT_EQ(overridden.at(0)["load"], 3000.0);
}

/// Slip and speed of a study's rows of its first model, as pairs.
std::vector<std::pair<double, double>> slips_and_speeds(const std::string& arguments) {
  std::vector<std::pair<double, double>> all;
  const nlohmann::json document = soilbin(arguments + " --json").json();
  for (const auto& row : document["rows"])
    if (row["label"] == "bekker_wong") all.emplace_back(row["slip"].get<double>(), row["speed"].get<double>());
  return all;
}

// The study: 2, 4, 6, 8 kN, 0 .. 60 % slip in steps of 10 %, a rim of 0.496 m at 10 rpm.
TEST(Run, EachFlagPicksOrOverridesByItselfAndTheRotationStays) {
  const double rim = 0.496 * 10 * 2 * std::acos(-1.0) / 60;
  const auto here = [](double slip, double speed) { return Pair(DoubleNear(slip, 1e-12), DoubleNear(speed, 1e-12)); };
  EXPECT_THAT(slips_and_speeds("run paper-straight --load 5kN --slip 20%"), ElementsAre(here(0.2, 0.8 * rim)))
      << "no load of 5 kN: overridden; a slip of 20 %: picked";
  const auto at_13 = slips_and_speeds("run paper-straight --slip 13%");
  ASSERT_EQ(at_13.size(), 4U) << "one row a load";
  EXPECT_THAT(at_13, Each(here(0.13, 0.87 * rim)));
  EXPECT_THAT(slips_and_speeds("run paper-straight --load 4kN --slip=-20%"), ElementsAre(here(-0.2, rim / 0.8)));
  EXPECT_THAT(slips_and_speeds("run paper-straight --load 4kN --slip 13% --speed 0.3m/s"), ElementsAre(here(0.13, 0.3)))
      << "a speed that is given stays";
  EXPECT_THAT(slips_and_speeds("estimate paper-straight --load 4kN --slip 20% --radius 992mm"),
              ElementsAre(here(0.2, 2 * 0.8 * rim)))
      << "a wheel of twice the radius goes twice as fast";
  EXPECT_THAT(soilbin("run paper-straight --load 4kN --slip=-1"),
              Refuses(AllOf(HasSubstr("is locked"), HasSubstr("give --speed too"))));
}

TEST(Run, OutputNeedsAFolder) {
  const Scratch scratch;
  const fs::path file = scratch.write("there", "");
  for (const std::string& at : {file.string(), file.string() + "/deeper"})
    EXPECT_THAT(soilbin("run rover-slip --output '" + at + "'"),
                Refuses(AllOf(HasSubstr("is a file, where a folder is to be"), HasSubstr("hint"))));
}

TEST(Run, TwoFormsOfOneEffectAreToldApart) {
  const Scratch scratch;
  const fs::path file = scratch.write("case.yaml", R"(format: soilbin-case/1
name: forms
tire: rover-wheel
soil: dry-sand
study:
  models:
    - {model: bekker_wong, effects: [slip_sinkage, exit_angle]}
    - {model: bekker_wong, effects: [{id: slip_sinkage, form: ding}]}
  conditions: {load: 60 N, slip: 20 %}
)");
  std::vector<std::string> labels;
  const nlohmann::json document = soilbin("run '" + file.string() + "' --json").json();
  for (const auto& row : document["rows"]) labels.push_back(row["label"]);
  EXPECT_THAT(labels, ElementsAre("bekker_wong + slip_sinkage:lyasko + exit_angle", "bekker_wong + slip_sinkage:ding"));
}

/// A case of a light wheel on pebbles, coarse soft grains, in `folder`, for a study of one condition or several.
fs::path pebble_case(const Scratch& folder, const std::string& slip) {
  folder.write("pebbles.yaml", text_of(SOILBIN_SOURCE_DIR "/tests/fixtures/pebbles.yaml"));
  return folder.write("case.yaml",
                      "format: soilbin-case/1\nname: pebbles\ntire: {radius: 150 mm, width: 100 mm}\n"
                      "soil: pebbles.yaml\nstudy:\n  models: [dem]\n  conditions: {load: 60 N, slip: " +
                          slip + ", speed: 0.6 m/s}\n");
}

// Minutes of grains in seconds: a light wheel on a shallow bed of pebbles. It drives, carries its load at some depth
// between the tops and the floor, and a bed that is there already is taken again: same numbers, kept for ParaView or
// not.
TEST(SlowRun, DrivesAWheelOverGrains) {
  const Scratch scratch;
  const fs::path file = pebble_case(scratch, "20 %");
  const std::string run = "run '" + file.string() + "' --bed-length 1.2m --bed-width 0.25m --bed-depth 0.09m --json";
  const fs::path beds = scratch / "beds";
  setenv("SOILBIN_BEDS", beds.c_str(), 1);
  const fs::path views = scratch / "views";
  const Outcome first = soilbin(run), again = soilbin(run + " --paraview '" + views.string() + "'");
  unsetenv("SOILBIN_BEDS");
  ASSERT_EQ(first.status, 0) << first.err;
  EXPECT_EQ(first.out, again.out);
  const nlohmann::json row = first.json()["rows"].at(0);
  EXPECT_EQ(row["model"], "dem");
  EXPECT_GT(row["torque"], 0);
  EXPECT_LT(row["torque"], 60 * 0.15 * 0.5 * 1.3);  // sliding on all its load would take W r mu
  EXPECT_LT(row["sinkage"], 0.09);
  EXPECT_FALSE(fs::is_empty(beds));
  const std::string name = "load-60-N-slip-20-0.6-m-s-packing-1";
  EXPECT_THAT(again.err, HasSubstr(name + ".pvd: ParaView opens it"));
  const std::string frames = text_of(views / (name + ".pvd"));
  EXPECT_THAT(frames, HasSubstr("name=\"grains\" file=\"" + name + "-grains-"));
  EXPECT_THAT(frames, HasSubstr("name=\"wheel\" file=\"" + name + "-body-1-"));
}

// What is recorded is shown again without running, and a file for another question is refused.
TEST(SlowRun, KeepsItsRunsInARecord) {
  const Scratch scratch;
  const fs::path file = pebble_case(scratch, "[0 %, 20 %]");
  const std::string bed = " --bed-length 1.2m --bed-width 0.25m --bed-depth 0.09m --threads 1",
                    run = "run '" + file.string() + "' --json",
                    record = " --record '" + (scratch / "r.json").string() + "'",
                    recorded = " --recorded '" + (scratch / "r.json").string() + "'";
  setenv("SOILBIN_BEDS", (scratch / "beds").c_str(), 1);
  const Outcome one = soilbin(run + bed + record + " --slip 20%"), all = soilbin(run + bed + record);
  unsetenv("SOILBIN_BEDS");
  ASSERT_EQ(all.status, 0) << all.err;
  EXPECT_EQ(all.json()["rows"][1], one.json()["rows"][0]);
  const auto untested = HasSubstr("not verified that the grains' answers are independent of the time step");
  EXPECT_THAT(all.err, untested);
  const Outcome shown = soilbin(run + recorded);
  EXPECT_EQ(shown.json()["rows"], all.json()["rows"]);
  EXPECT_THAT(soilbin("run '" + file.string() + "'" + recorded).out, HasSubstr("dem: 2 runs"));
  EXPECT_THAT(soilbin(run + record), Refuses(HasSubstr("bed.length: 1.2 in the file, 2.5 asked for")));
  EXPECT_THAT(soilbin(run + recorded + " --slip 50%").json()["rows"][0]["error"].get<std::string>(),
              HasSubstr("not in the record"));
  EXPECT_EQ(soilbin(run + recorded + record).status, 2);
  EXPECT_THAT(shown.err, untested);
  setenv("SOILBIN_BEDS", (scratch / "beds").c_str(), 1);
  const Outcome tested = soilbin(run + bed + record + " --half-step yes");
  unsetenv("SOILBIN_BEDS");
  EXPECT_EQ(tested.status, 0) << tested.err;
  EXPECT_EQ(tested.json()["rows"], all.json()["rows"]);
  EXPECT_THAT(tested.err, testing::Not(untested));
}

// The run at the soil's grains and the one with coarser ones give the error of resolution of this very answer; the
// record keeps both, and answers with them.
TEST(SlowRun, ACoarserTwinTellsTheErrorOfResolution) {
  const Scratch scratch;
  const std::string study = "'" + pebble_case(scratch, "20 %").string() + "' --json",
                    bed =
                        " --bed-length 0.6m --bed-width 0.25m --bed-depth 0.12m --threads 1 --patch --behind 0.15m "
                        "--ahead 0.2m --travel 0.3m",
                    file = "'" + (scratch / "r.json").string() + "'";
  std::string shallow = bed;
  shallow.replace(shallow.find("0.12m"), 5, "0.09m");
  setenv("SOILBIN_BEDS", (scratch / "beds").c_str(), 1);
  const Outcome plan = soilbin("run " + study + bed + " --coarser-twin --dry-run");
  const Outcome plain = soilbin("run " + study + bed + " --record " + file);
  const Outcome twins = soilbin("run " + study + bed + " --coarser-twin --record " + file);
  unsetenv("SOILBIN_BEDS");
  ASSERT_EQ(twins.status, 0) << twins.err;
  const nlohmann::json runs = plan.json()["runs"];
  ASSERT_EQ(runs.size(), 2U) << plan.err;
  EXPECT_FALSE(runs[0]["coarser"].get<bool>());
  EXPECT_TRUE(runs[1]["coarser"].get<bool>());
  EXPECT_THAT(soilbin("run " + study + shallow + " --coarser-twin --dry-run").err,
              HasSubstr("a twin with grains 1.4 times as large: a bed of"));
  EXPECT_LT(runs[1]["seconds"].get<double>(), 0.5 * runs[0]["seconds"].get<double>());
  nlohmann::json before = plain.json()["rows"][0], row = twins.json()["rows"][0];
  const nlohmann::json record = nlohmann::json::parse(text_of(scratch / "r.json"));
  ASSERT_EQ(record["coarser"].size(), 1U);
  EXPECT_EQ(row["resolution_error"]["from"], "twin");
  EXPECT_NEAR(row["resolution_error"]["drawbar_pull"]["value"].get<double>(),
              (record["coarser"][0]["drawbar_pull"].get<double>() - row["drawbar_pull"].get<double>()) / 0.4, 1e-9);
  EXPECT_NE(before["resolution_error"]["from"], "twin");
  before.erase("resolution_error"), row.erase("resolution_error");
  EXPECT_EQ(before, row) << "the answer itself is the same";
  EXPECT_EQ(soilbin("run " + study + " --recorded " + file).json()["rows"], twins.json()["rows"]);
  const nlohmann::json side = soilbin("compare --no-loop " + study + " --recorded " + file).json()["sides"][0];
  EXPECT_EQ(side["points"][0]["resolution_error"]["from"], "twin");
}

// A plan is refused for what would refuse its runs, and warns of what they would be warned of.
TEST(SlowRun, ADryRunJudgesWhatTheRunsWouldMeet) {
  const Scratch scratch;
  const std::string run = "run '" + pebble_case(scratch, "20 %").string() + "' --bed-length 1.2m --bed-depth 0.09m ";
  for (const char* bad : {"--bed-width 0.1m", "--bed-width 0.3m --behind 0.05m", "--bed-width 0.3m --time-step 100ms",
                          "--bed-width 0.3m --travel 2m", "--bed-width 0.3m --wheel-mesh no-such.stl"}) {
    const Outcome plan = soilbin(run + "--dry-run " + bad), made = soilbin(run + bad);
    EXPECT_EQ(plan.status, 2) << bad;
    EXPECT_EQ(plan.err.substr(plan.err.find("soilbin: ")), made.err.substr(made.err.find("soilbin: "))) << bad;
  }
  const auto narrow = HasSubstr("the bed is 1.9 tire widths wide, so its walls support the soil");
  const Outcome plan = soilbin(run + "--bed-width 0.19m --dry-run --json");
  EXPECT_EQ(plan.status, 0) << plan.err;
  EXPECT_THAT(plan.err, narrow);
  EXPECT_THAT(plan.json()["warning_kinds"].dump(), HasSubstr("narrow_bed"));
  EXPECT_THAT(soilbin(run + "--bed-width 0.25m --dry-run").err, testing::Not(HasSubstr("its walls support the soil")));
}

// It lists what it would make, and makes nothing: no record is begun.
TEST(SlowRun, ADryRunOfConvergeListsTheRepetitions) {
  const Scratch scratch;
  const fs::path record = scratch / "r.json";
  const Outcome dry =
      soilbin("run '" + pebble_case(scratch, "20 %").string() +
              "' --converge --dry-run --bed-length 1.2m --bed-width 0.25m --bed-depth 0.09m --record '" +
              record.string() + "'");
  EXPECT_EQ(dry.status, 0) << dry.err;
  EXPECT_THAT(dry.out, AllOf(HasSubstr("as it is"), HasSubstr("time step halved"), HasSubstr("skin halved"),
                             HasSubstr("to settle"), HasSubstr("runs to make, about")));
  EXPECT_FALSE(fs::exists(record));
}

TEST(Run, ConvergeRefusesWhatMeansNothingBesideIt) {
  const Scratch scratch;
  const std::string run = "run '" + pebble_case(scratch, "[0 %, 20 %]").string() + "' --converge";
  for (const char* flag : {"--shard 1/2", "--packings 3", "--half-step no", "--paraview views", "--replay r.replay",
                           "--csv r.csv", "--plot r.svg", "--known r.json", "--recorded r.json"}) {
    const Outcome refused = soilbin(run + " --slip 20% " + flag);
    EXPECT_EQ(refused.status, 2) << flag;
    const std::string name = std::string(flag).substr(0, std::string(flag).find(' '));
    EXPECT_THAT(refused.err, HasSubstr(name)) << flag;
    EXPECT_EQ(refused.out, "") << flag;
  }
  EXPECT_THAT(soilbin(run + " --slip 20% --shard 1/2").err, HasSubstr("--shard has no effect with --converge"));
  EXPECT_THAT(soilbin(run + " --dry-run").err, HasSubstr("--converge takes one condition, not 2"));
  EXPECT_THAT(soilbin("run rover-slip --model bekker_wong --slip 20% --converge").err, HasSubstr("hint: --model dem"));
}

// What keeps every condition from being run is bad input, not a study without a solution.
TEST(Run, ABinWithoutRoomForTheWheelIsBadInput) {
  const Scratch scratch;
  const std::string run = "run '" + pebble_case(scratch, "20 %").string() + "'";
  const std::pair<const char*, const char*> wrong[] = {
      {"--bed-length 0.4m", "no way: --behind keeps 0.35 m and --ahead 0.5 m"},
      {"--bed-length 0.7m --behind 0.05m --ahead 0.2m", "hint: --behind 0.15m"},
      {"--travel 2m", "--travel 2 m is more than the 1.65 m that a bed of 2.5 m leaves"},
      {"--bed-width 0.1m", "hint: --bed-width 0.15m"},
      {"--bed-depth 1mm", "less than two grains"},
      {"--time-step 100ms", "hint: --time-step"}};
  for (const auto& [flags, says] : wrong) EXPECT_THAT(soilbin(run + " " + flags), Refuses(HasSubstr(says))) << flags;
}

TEST(Run, NamesTheFlagOrModelThatIsWrong) {
  EXPECT_THAT(soilbin("run paper-straight --model dem --bed-length 4"), Refuses(HasSubstr("--bed-length")));
  EXPECT_THAT(soilbin("run paper-straight --model bekker_wrong").err, HasSubstr("did you mean 'bekker_wong'?"));
}

TEST(Run, ASoilWithoutANameIsSaidToHaveNone) {
  const Scratch scratch;
  const fs::path file = scratch.write("case.yaml", R"(format: soilbin-case/1
name: own
tire: {radius: 150 mm, width: 120 mm}
soil:
  semi_empirical: {exponent: 1.05, k_c: 1.5 kN/m^(n+1), k_phi: 1350 kN/m^(n+2), cohesion: 0.7 kPa, friction_angle: 29 deg,
                   shear_modulus: 18 mm, stress_angle_c1: 0.18, stress_angle_c2: 0.32}
study:
  conditions: {load: 60 N, slip: 20 %}
)");
  for (const char* command : {"estimate", "explain", "limits", "run", "check", "compare --no-loop"})
    EXPECT_THAT(soilbin(command + (" '" + file.string() + "'")).out, HasSubstr("on a soil of its own (unnamed)"))
        << command;
}

TEST(Run, NamesTheNearestStudy) {
  EXPECT_THAT(soilbin("run paper-strait"),
              Refuses(AllOf(HasSubstr("did you mean 'paper-straight'?"), HasSubstr("soilbin list studies shows"))));
}

TEST(Run, AFileThatCannotBeWrittenIsRefusedBeforeAnyWork) {
  const Scratch scratch;  // a name that no file system takes
  const Outcome r = soilbin("run rover-slip --plot '" + (scratch / (std::string(300, 'p') + ".svg")).string() + "'");
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err, HasSubstr("File name too long"));
  EXPECT_EQ(r.out, "");
}

// As the demo does it: the page's folder is made where there is none.
TEST(Report, IsOnePageThatLoadsNothing) {
  const Scratch scratch;
  const std::string file = (scratch / "made" / "page.html").string();
  const Outcome r = soilbin("report paper-straight rover-slip --measured cmu-smooth --output '" + file + "'");
  ASSERT_EQ(r.status, 0) << r.err;
  const std::string page = text_of(file);
  for (const char* word : {"<svg", "prefers-color-scheme", "paper-straight", "cmu-smooth", "soilbin report",
                           "Where the numbers come from"})
    EXPECT_THAT(page, HasSubstr(word));
  for (const char* word : {"http://", "https://", "src=", "<img", "<link", "url(", "nan"})
    EXPECT_THAT(page.substr(0, page.find("<script")), testing::Not(HasSubstr(word))) << word;
  EXPECT_EQ(soilbin("report").status, 2);
}

// A campaign is one by its name too, of the library or a folder.
TEST(Report, TakesCampaignsBesideStudies) {
  const Scratch scratch;
  const std::string page = (scratch / "page.html").string();
  const Outcome r =
      soilbin("report rover-slip " SOILBIN_SOURCE_DIR "/cases/measured/cmu-smooth --output '" + page + "'");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(text_of(page),
              AllOf(HasSubstr("rover-slip"), HasSubstr("Prediction error without fitting (RMS over 90 runs")));
  EXPECT_EQ(soilbin("report cmu-smooth --output '" + page + "'").status, 0);
}

// On a terminal the sentences that the page opens with; as JSON what run and predict answer; as Markdown all of it.
TEST(Report, IsToldInEveryForm) {
  const Scratch scratch;
  const std::string folder = (scratch / "told").string();
  const Outcome told = soilbin("report rover-slip cmu-smooth --title 'Two wheels' --markdown '" + folder + "'");
  ASSERT_EQ(told.status, 0) << told.err;
  EXPECT_THAT(told.out, AllOf(HasSubstr("rover-slip: "), HasSubstr("cmu-smooth: Prediction error"),
                              testing::Not(HasSubstr("soilbin serve"))));
  EXPECT_THAT(text_of(folder + "/report.md"),
              AllOf(HasSubstr("# Two wheels"), HasSubstr("Where the numbers come from")));
  EXPECT_FALSE(fs::exists("report.html")) << "the page is written where nothing else is asked for";
  const Outcome json = soilbin("report rover-slip cmu-smooth --json");
  ASSERT_EQ(json.status, 0) << json.err;
  const nlohmann::json document = nlohmann::json::parse(json.out);
  EXPECT_EQ(document.at("format"), "soilbin-report/1");
  EXPECT_EQ(document.at("studies").at(0).at("rows"),
            nlohmann::json::parse(soilbin("run rover-slip --json").out).at("rows"));
  EXPECT_EQ(document.at("campaigns").at(0).at("rows"),
            nlohmann::json::parse(soilbin("predict cmu-smooth --json").out).at("rows"));
}

TEST(RunCommand, NamesTheSoilsThatHaveGrains) {
  EXPECT_THAT(soilbin("run rover-slip --model dem --slip 20%"),
              Refuses(AllOf(HasSubstr("soil 'dry-sand' has no values of grains"), HasSubstr("these have: "),
                            HasSubstr("paper-sand-fine"))));
}

}  // namespace
}  // namespace soilbin::cli::test
