// The one list of doubts, as each command tells it: on standard error, in JSON and on pages.
#include <gmock/gmock.h>

#include <algorithm>

#include "cli/command.hpp"

namespace soilbin::cli::test {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;
using testing::ResultOf;

/// Lugs and inflation without an effect that hears of them, and a wheel that sinks by more than half its radius.
constexpr const char* doubtful = R"(format: soilbin-case/1
name: doubtful
tire: {radius: 110 mm, width: 100 mm, inflation_pressure: 400 kPa, lugs: {height: 10 mm, count: 12, thickness: 3 mm}}
soil: dry-sand
study:
  conditions: {load: 600 N, slip: 20 %}
)";

const std::vector<std::string> expected = {"lugs_ignored", "inflation_ignored", "deep_sinkage"};

std::vector<std::string> kinds_of(const nlohmann::json& document) {
  return document.value("warning_kinds", std::vector<std::string>());
}

/// Those that answer for a tire take it as it declares itself: flexible, and with its lugs.
bool answers_for_the_tire(const std::string& command) { return command != "compare --no-loop"; }

TEST(DoubtsOfCommands, AreTheSameInAllOfThem) {
  const Scratch scratch;
  const std::string study = " '" + scratch.write("case.yaml", doubtful).string() + "' ";
  for (const char* command : {"estimate", "run", "explain", "limits", "compare --no-loop"}) {
    const Outcome r = soilbin(command + study + "--json");
    ASSERT_EQ(r.status, 0) << command << r.err;
    const nlohmann::json document = r.json();
    const std::vector<std::string> kinds = kinds_of(document);
    ASSERT_EQ(kinds.size(), document["warnings"].size()) << command;
    for (const auto& warning : document["warnings"])
      EXPECT_THAT(r.err, HasSubstr("warning: " + warning.get<std::string>() + "\n")) << command;
    for (const std::string& doubt : expected) {
      if (doubt == "deep_sinkage" && std::string(command) == "limits") continue;  // at other slips
      if (doubt.ends_with("_ignored") && answers_for_the_tire(command))
        EXPECT_THAT(kinds, Not(Contains(doubt))) << command;
      else
        EXPECT_THAT(kinds, Contains(doubt)) << command;
    }
  }
  const Outcome checked = soilbin("check" + study), json = soilbin("check --json" + study);
  const nlohmann::json document = json.json();
  for (const std::string& doubt : expected) EXPECT_THAT(kinds_of(document), Contains(doubt));
  for (const auto& warning : document["warnings"])
    EXPECT_THAT(checked.out, HasSubstr("warning: " + warning.get<std::string>() + "\n"));
  EXPECT_THAT(checked.out, HasSubstr("1 model at 1 condition"));
}

// What a doubt says of a heavy tire is what the flags that it names answer.
TEST(DoubtsOfCommands, TellTheAnswerOfTheFlagsThatTheyName) {
  const std::string command = "estimate --tire 600-65R28 --soil lete-sand --slip 20% --load 30kN";
  const nlohmann::json warned = soilbin(command + " --json").json(),
                       named = soilbin(command +
                                       " --json --rigid --effect lug_thrust:tips --effect shear_hump:carried"
                                       " --effect slip_sinkage:reece,h=100mm")
                                   .json();
  const double pull = named["rows"][0]["drawbar_pull"];
  EXPECT_THAT(warned["warnings"], Contains(HasSubstr("pulls " + std::to_string(pull / 1000).substr(0, 4))));
}

TEST(SlowDoubtsOfCommands, KnowWhatAnAnswerDoesNotTell) {
  const struct {
    const char* command;
    const char* kind;
    bool doubted;
  } cases[] = {
      {"estimate --tire 600-65R28 --soil lete-sand --slip 20% --load 30kN", "heavy_and_lugged", true},
      {"estimate --tire 600-65R28 --soil lete-sand --slip 20% --load 30kN --no-lugs --rigid", "heavy_and_smooth", true},
      {"estimate --tire 600-65R28 --soil lete-sand --slip 20% --load 5kN --no-lugs --rigid", "heavy_and_smooth", false},
      {"estimate --tire 600-65R28 --soil lete-sand --slip 20% --load 30kN --effect shear_hump:carried",
       "heavy_and_lugged", false},
      {"estimate --tire 600-65R28 --soil lete-sand --slip 20% --load 30kN --effect shear_hump:carried",
       "carried_beyond_grains", false},
      {"estimate --radius 600mm --width 100mm --soil dry-sand --slip 20% --load 5kN --effect shear_hump:carried",
       "carried_beyond_grains", true},
      {"estimate --tire hmmwv --soil dry-sand --slip 20% --load 6kN --effect multipass --pass 2", "sinkage_in_rut",
       true},
      {"estimate --tire hmmwv --soil dry-sand --slip 20% --load 6kN --effect multipass --pass 1", "sinkage_in_rut",
       false},
      {"estimate --tire hmmwv --soil dry-sand --slip 20% --load 6kN --effect multipass:rut_power --pass 2",
       "sinkage_in_rut", false},
      {"estimate --tire 14.00R20 --soil sandy-loam --slip 20% --load 30kN --effect rate_dependence:grahn",
       "no_pressure_at_rest", true},
      {"estimate --tire 14.00R20 --soil sandy-loam --slip 20% --load 30kN --effect rate_dependence:grahn --rigid",
       "no_pressure_at_rest", false},
      {"estimate --tire 14.00R20 --soil sandy-loam --slip 20% --load 30kN --effect rate_dependence:quasi_static",
       "no_pressure_at_rest", false},
      {"limits --tire 600-65R28 --soil lete-sand --load 30kN", "heavy_climb", true},
      {"limits --tire 600-65R28 --soil lete-sand --load 5kN", "heavy_climb", false},
      {"vehicle truck --soil dry-sand", "heavy_climb", true},
      {"vehicle rover --soil dry-sand", "heavy_climb", false},
      {"vehicle truck --soil clayey-soil", "travel_not_decided", true},
      {"vehicle truck --soil sandy-loam", "travel_not_decided", false},
      {"vehicle truck --soil heavy-clay", "deep_sinkage", true},
      {"vehicle tractor", "slips_little", true},
      {"vehicle tractor --slope 10deg --pull 20kN", "slips_little", false},
      {"vehicle rover --soil dry-sand --gravity 1.62m/s^2", "soil_weight_ignored", false},
  };
  for (const auto& [command, kind, doubted] : cases) {
    const Outcome outcome = soilbin(std::string(command) + " --json");
    ASSERT_LE(outcome.status, 1) << command << outcome.err;
    EXPECT_EQ(std::ranges::count(kinds_of(outcome.json()), kind) > 0, doubted) << command;
  }
}

// Before core-hours are spent: who only plans them hears of the grains too.
TEST(SlowDoubtsOfCommands, AreToldBeforeGrainsAreRun) {
  const Outcome plan = soilbin("run paper-straight --load 4kN --model dem --dry-run --json");
  ASSERT_EQ(plan.status, 0) << plan.err;
  EXPECT_THAT(plan.err, HasSubstr("warning: the grains are coarse for this wheel"));
  EXPECT_THAT(kinds_of(plan.json()), Contains("coarse_grains"));
  const Scratch scratch;
  const Outcome sweep =
      soilbin("sweep paper-straight --load 4kN --on local --output '" + (scratch / "sweep").string() + "'");
  ASSERT_EQ(sweep.status, 0) << sweep.err;
  EXPECT_THAT(sweep.err, HasSubstr("warning: the grains are coarse for this wheel"));
}

// Which standard deviations are declared and which assumed stands wherever there is a "±".
TEST(ErrorsOfCommands, SayWhatIsAssumedInTextAndOnPages) {
  const std::string said = "(declared) and k_c, k_phi, c, phi (assumed: 10";
  const Scratch scratch;
  const std::string page = (scratch / "page.html").string();
  for (const std::string& command :
       {std::string("estimate --tire rover-wheel --soil dry-sand --load 80N --slip 20%"), std::string("run rover-slip"),
        std::string("limits --tire rover-wheel --soil dry-sand --load 80N")})
    EXPECT_THAT(soilbin(command).out, HasSubstr(said)) << command;
  ASSERT_EQ(soilbin("report rover-slip --output '" + page + "'").status, 0);
  EXPECT_THAT(text_of(page), HasSubstr(said));
  for (const std::string command :
       {"compare rover-slip --effect slip_sinkage --no-loop", "drive rover-climb --samples 20"}) {
    const Outcome told = soilbin(command + " --report '" + page + "'");
    ASSERT_EQ(told.status, 0) << command << told.err;
    EXPECT_THAT(told.out, HasSubstr(said)) << command;
    EXPECT_THAT(text_of(page), HasSubstr(said)) << command;
  }
}

TEST(DoubtsOfCommands, StandOnPages) {
  const Scratch scratch;
  const std::string study = " '" + scratch.write("case.yaml", doubtful).string() + "' ";
  const fs::path report = scratch / "report.html", page = scratch / "compare.html", folder = scratch / "md";
  ASSERT_EQ(soilbin("report" + study + "--output '" + report.string() + "'").status, 0);
  ASSERT_EQ(
      soilbin("compare --no-loop" + study + "--report '" + page.string() + "' --markdown '" + folder.string() + "'")
          .status,
      0);
  for (const fs::path& file : {report, page, folder / "report.md"})
    EXPECT_THAT(text_of(file), AllOf(HasSubstr("Warnings"), HasSubstr("lugs are ignored"))) << file;
}

// The page holds what the analytic models answer of a study that asks for grains too, and says where those stand.
TEST(DoubtsOfCommands, AReportLeavesOutTheGrainsOfAStudy) {
  const Scratch scratch;
  const std::string study = R"(format: soilbin-case/1
name: both
tire: rover-wheel
soil: paper-sand
study:
  models: [dem, bekker_wong]
  conditions: {load: 65 N, slip: [0 %, 20 %]}
)";
  const fs::path file = scratch.write("both.yaml", study), page = scratch / "page.html";
  const Outcome r = soilbin("report '" + file.string() + "' --output '" + page.string() + "'");
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.err, AllOf(HasSubstr("the study asks for grains too, which are not on this page"),
                           HasSubstr("--model dem --report FILE.html shows them")));
  EXPECT_THAT(text_of(page), HasSubstr("the study asks for grains too"));
  const fs::path grains =
      scratch.write("grains.yaml", std::string(study).replace(study.find("[dem, bekker_wong]"), 18, "[dem]"));
  EXPECT_THAT(soilbin("report '" + grains.string() + "' --output '" + page.string() + "'"),
              Refuses(HasSubstr("asks grains alone, which this page does not run")));
}

// The first line of an answer names the lugs; where no effect hears of them it says that they are left out.
TEST(DoubtsOfCommands, TheFirstLineSaysThatLugsAreLeftOut) {
  const std::string lugged =
      "estimate --soil dry-sand --radius 110mm --width 100mm --lug-height 8mm --lug-count 24 --load 80N --slip 20% ";
  EXPECT_THAT(soilbin(lugged + "--effect none").out,
              HasSubstr("24 lugs of 8 mm; this model ignores the lugs) on dry-sand"));
  EXPECT_THAT(soilbin("run paper-straight --recorded --load 4kN --slip 20%").out,
              HasSubstr("40 lugs of 11 mm; the analytic wheel ignores them)"))
      << "the grains have them";
  for (const char* with : {"", "--effect lug_thrust"})
    EXPECT_THAT(soilbin(lugged + with).out, HasSubstr("24 lugs of 8 mm) on dry-sand")) << with;
}

TEST(DoubtsOfCommands, ADriveHasThemToo) {
  const Scratch scratch;
  const std::string drive = " '" +
                            scratch
                                .write("drive.yaml", R"(format: soilbin-case/1
name: lugged-drive
tire: {radius: 110 mm, width: 100 mm, lugs: {height: 10 mm, count: 12, thickness: 3 mm}}
soil: dry-sand
drive:
  load: 80 N
  duration: 2 s
  controller: {rim_speed: 0.1 m/s}
)")
                                .string() +
                            "' ";
  const fs::path page = scratch / "drive.html";
  const Outcome r = soilbin("drive" + drive + "--json --report '" + page.string() + "'");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.err, HasSubstr("warning: lugs are ignored: add lug_thrust to the drive's effects"));
  EXPECT_THAT(kinds_of(r.json()), Contains("lugs_ignored"));
  EXPECT_THAT(text_of(page), HasSubstr("lugs are ignored"));
  EXPECT_THAT(soilbin("check" + drive).out, HasSubstr("lugs are ignored"));
}

// The paper's tire on grains of 30 to 50 mm.
TEST(DoubtsOfCommands, RecordsOfCoarseGrainsSaySo) {
  const Scratch scratch;
  const fs::path page = scratch / "page.html";
  const std::string at = "paper-straight --recorded --load 4kN --slip 20% --json ";
  const auto coarse = AllOf(HasSubstr("the grains are coarse for this wheel: estimated error"),
                            HasSubstr("Mean diameter 40 mm: 7.6 across its width"));
  for (const Outcome& r :
       {soilbin("run " + at), soilbin("compare --no-loop " + at + "--report '" + page.string() + "'")}) {
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_THAT(r.err, coarse);
    EXPECT_THAT(r.json()["warnings"], Contains(ResultOf([](const auto& doubt) { return std::string(doubt); }, coarse)));
  }
  EXPECT_THAT(text_of(page), coarse);
  EXPECT_THAT(soilbin("check paper-straight").out, coarse);
  EXPECT_THAT(soilbin("estimate paper-straight --load 4kN --slip 20%").err, Not(HasSubstr("grains")));
}

// The wheel, load and slip of the study of grain sizes (docs/lab/grain-size.md): 0.040 m of its slopes, with the
// recorded sinkage of 11.6 mm in place of its 11.1. The words and both documents tell the same.
TEST(DoubtsOfCommands, TellTheErrorOfResolutionOfGrains) {
  const std::string at = "paper-straight --recorded --load 4kN --slip 20% --json ";
  const Outcome run = soilbin("run " + at), compared = soilbin("compare --no-loop " + at);
  const nlohmann::json ran = run.json(), sides = compared.json();
  nlohmann::json of_run, of_side;
  for (const auto& row : ran.at("rows"))
    if (row.at("model") == "dem") of_run = row.at("resolution_error");
  for (const auto& side : sides.at("sides"))
    if (side.at("kind") == "grains") of_side = side.at("points").at(0).at("resolution_error");
  EXPECT_EQ(of_run.dump(), of_side.dump());
  EXPECT_NEAR(of_run.at("drawbar_pull").at("value").get<double>(), 40 * 16.2, 20);
  EXPECT_NEAR(of_run.at("torque").at("value").get<double>(), 40 * 7.5, 10);
  EXPECT_NEAR(of_run.at("sinkage").at("value").get<double>(), -0.0239, 2e-4);
  EXPECT_THAT(run.err, HasSubstr("estimated error drawbar pull +64"));
  EXPECT_THAT(sides.at("summary").dump(), HasSubstr("too large by about 16.0 ± 1.8 % of the load")) << "+641 N of 4 kN";
  EXPECT_THAT(soilbin("check paper-straight").out, HasSubstr("estimated error drawbar pull +"));
}

TEST(DoubtsOfCommands, ALawOfRollingThatHangsOnTheStepSaysSo) {
  const Scratch scratch;
  const auto changed = [](std::string text, const std::string& from, const std::string& to) {
    EXPECT_NE(text.find(from), std::string::npos) << from;
    return text.replace(text.find(from), from.size(), to);
  };
  scratch.write("sand.yaml", changed(text_of(SOILBIN_SOURCE_DIR "/cases/soils/paper-sand.yaml"), "elastic_plastic\n",
                                     "directional_with_twist\n"));
  scratch.write("case.yaml", changed(text_of(SOILBIN_SOURCE_DIR "/cases/studies/paper-straight.yaml"),
                                     "soil: paper-sand\n", "soil: sand.yaml\n"));
  const auto step = HasSubstr("1183 ± 43 N in place of 773 ± 19 N");
  EXPECT_THAT(soilbin("check '" + (scratch / "case.yaml").string() + "'").out, step);
  EXPECT_THAT(soilbin("check paper-straight").out, Not(step));
}

// 24 lugs round a radius of 110 mm stand every 28.8 mm: none of them is 600 mm thick, from whichever side it comes.
TEST(DoubtsOfCommands, LugsThatLeaveNoGapAreRefused) {
  const Scratch scratch;
  const auto told =
      HasSubstr("24 lugs of 600 mm leave no gap round a radius of 110 mm: from one lug to the next are 28.8 mm\n");
  const std::string lugs = "{height: 10 mm, count: 24, thickness: 600 mm}";
  scratch.write("case.yaml", R"(format: soilbin-case/1
name: lugs
tire: {radius: 110 mm, width: 100 mm, lugs: )" +
                                 lugs + R"(}
soil: dry-sand
study: {conditions: {load: 80 N, slip: 20 %}}
)");
  EXPECT_THAT(soilbin("check '" + (scratch / "case.yaml").string() + "'"),
              Refuses(AllOf(HasSubstr("case.yaml:3:7: 24 lugs"), HasSubstr("hint: fewer or thinner lugs"))));
  const std::string flags =
      "estimate --soil dry-sand --radius 110mm --width 100mm --load 80N --slip 20% "
      "--lug-height 10mm --lug-count 24 --lug-thickness ";
  EXPECT_THAT(soilbin(flags + "600mm"), Refuses(told));
  EXPECT_EQ(soilbin(flags + "20mm").status, 0);
}

// s = 1 - v/(r w): at v = 0 a turning wheel slips by 100 %, and one that does not turn has no slip.
TEST(DoubtsOfCommands, ASlipAtASpeedOfZeroIsDoubted) {
  const std::string at = "estimate --soil dry-sand --radius 110mm --width 100mm --load 80N --speed 0m/s --slip ";
  const auto told = HasSubstr("at a speed of 0 a wheel is at rest or slips by 100 %");
  EXPECT_THAT(soilbin(at + "20%").err, told);
  EXPECT_THAT(soilbin(at + "100%").err, Not(told));
  EXPECT_THAT(soilbin("drive rover-climb").err, Not(told)) << "a drive begins at rest";
}

/// n of 1.9 is out of the usual, with a standard deviation that a fit would free.
constexpr const char* odd_campaign = R"(format: soilbin-campaign/1
name: odd
wheel: {radius: 0.11 m, width: 0.1 m}
soil:
  exponent: {value: 1.9, sd: 0.05}
  k_c: {value: 0.99 kN/m^(n+1), sd: 0.1 kN/m^(n+1)}
  k_phi: {value: 30000 kN/m^(n+2), sd: 10 kN/m^(n+2)}
  cohesion: 1.04 kPa
  friction_angle: 28 deg
  shear_modulus: 20 mm
  stress_angle_c1: 0.18
  stress_angle_c2: 0.32
  density: 1600 kg/m^3
)";

TEST(DoubtsOfCommands, APredictionIsOfTheModelThatAnswersAndNeedsNoRowsToFit) {
  const Scratch scratch;
  scratch.write("c/campaign.yaml", odd_campaign);
  scratch.write("c/runs.csv", "load_N,slip,drawbar_pull_N,sinkage_m\n80,0.2,1.0,-0.01\n80,0.4,3.0,-0.02\n");
  const fs::path model = scratch.write("model.yaml", R"(format: soilbin-case/1
name: fitted
tire: {radius: 110 mm, width: 100 mm}
soil: dry-sand
study:
  conditions: {load: 80 N, slip: 20 %}
)");
  const std::string folder = " '" + (scratch / "c").string() + "' ";
  const Outcome declared = soilbin("predict" + folder + "--json");
  ASSERT_EQ(declared.status, 0) << "2 rows, 3 free values: nothing is fitted: " << declared.err;
  EXPECT_THAT(declared.err, HasSubstr("2 of 2 measured sinkages are negative"));
  EXPECT_THAT(kinds_of(declared.json()), AllOf(Contains("unusual_exponent"), Contains("sinkage_flipped")));
  const Outcome fitted = soilbin("predict" + folder + "--json --model '" + model.string() + "'");
  EXPECT_THAT(kinds_of(fitted.json()), AllOf(Not(Contains("unusual_exponent")), Contains("sinkage_flipped")));
  EXPECT_THAT(soilbin("check" + folder).out, HasSubstr("valid: campaign 'odd': 2 runs"));
  EXPECT_THAT(soilbin("loop" + folder),
              Refuses(HasSubstr("2 rows with a measured value are fewer than the 3 free parameters of the soil")));
}

}  // namespace
}  // namespace soilbin::cli::test
