// soilbin loop, run as a person runs it.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include "cli/command.hpp"

namespace soilbin::cli::test {
namespace {

using testing::AllOf;
using testing::Ge;
using testing::HasSubstr;
using testing::Le;

TEST(SlowLoopCommand, NamesTheLessonsEffectInWordsAndLeavesItsFiles) {
  const Scratch scratch;
  const std::string page = (scratch / "loop.html").string(), model = (scratch / "fitted.yaml").string();
  const Outcome outcome = soilbin("loop made-lesson --folds 4 --limit load=0.3kN..400N --report '" + page +
                                  "' --save-model '" + model + "'");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("The model lacks multipass"));
  EXPECT_THAT(outcome.out, HasSubstr("To confirm, measure"));
  EXPECT_THAT(text_of(page), HasSubstr("<svg"));
  EXPECT_THAT(text_of(page), HasSubstr("soilbin loop made-lesson --folds 4 --limit load=0.3kN..400N --report"));
  const Outcome predicted = soilbin("predict made-lesson --model '" + model + "'");
  EXPECT_THAT(predicted.out, HasSubstr("which was fitted to these runs"));
  EXPECT_EQ(predicted.status, 0) << predicted.err;
}

// What the loop saves may hold several learned effects, each form once.
TEST(LearnedEffects, OfSeveralFormsStandSideBySideInACase) {
  const Scratch scratch;
  const auto pull = [&](const std::string& name, const std::string& second) {
    const fs::path file = scratch.write(name, R"(format: soilbin-case/1
name: learned
tire: {radius: 110 mm, width: 100 mm}
soil: dry-sand
study:
  models:
    - model: bekker_wong
      effects:
        - {id: learned, form: drawbar_pull_by_slip, parameters: {slip_from: 0 %, slip_to: 50 %, c0: 0.01}}
        - )" + second + R"(
  conditions: {load: [80 N], slip: [20 %]}
)");
    return soilbin("run '" + file.string() + "' --json");
  };
  const Outcome two = pull("two.yaml",
                           "{id: learned, form: drawbar_pull_by_load, parameters: "
                           "{load_from: 50 N, load_to: 100 N, c0: 0.02}}");
  ASSERT_EQ(two.status, 0) << two.err;
  const Outcome none = pull("none.yaml",
                            "{id: learned, form: drawbar_pull_by_load, parameters: "
                            "{load_from: 50 N, load_to: 100 N, c0: 0}}");
  ASSERT_EQ(none.status, 0) << none.err;
  const auto value = [](const Outcome& outcome) {
    return outcome.json().at("rows").at(0).at("drawbar_pull").get<double>();
  };
  EXPECT_NEAR(value(two) - value(none), 0.02 * 80, 1e-9) << "g adds W g to the pull";
  const Outcome twice = pull(
      "twice.yaml", "{id: learned, form: drawbar_pull_by_slip, parameters: {slip_from: 0 %, slip_to: 50 %, c0: 0.01}}");
  EXPECT_EQ(twice.status, 2);
  EXPECT_THAT(twice.err, HasSubstr("effect 'learned' is listed twice"));
}

// Rows that repeat each other, in a campaign too small to fit: told beside the verdict, in JSON and on the page.
TEST(LoopCommand, TellsItsDoubtsInJsonAndOnThePage) {
  const Scratch scratch;
  const fs::path folder = scratch / "small", page = scratch / "loop.html";
  fs::create_directory(folder);
  scratch.write("small/campaign.yaml", R"(format: soilbin-campaign/1
name: small
wheel: {radius: 110 mm, width: 100 mm}
soil:
  exponent: {value: 1.1, sd: 0.1}
  k_c: 1 kN/m^(n+1)
  k_phi: 1500 kN/m^(n+2)
  cohesion: 1 kPa
  friction_angle: 28 deg
  shear_modulus: 20 mm
  stress_angle_c1: 0.2
  stress_angle_c2: 0.3
model: {effects: []}
data: runs.csv
)");
  scratch.write("small/runs.csv", "load_N,slip,speed_m_s,drawbar_pull_N\n80,0.1,0.1,5\n80,0.1,0.1,5\n90,0.2,0.1,6\n");
  const Outcome outcome = soilbin("loop '" + folder.string() + "' --json --report '" + page.string() + "'");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.json().at("verdict"), "not_enough_data");
  EXPECT_THAT(outcome.json().at("warning_kinds").dump(), HasSubstr("repeated_row"));
  EXPECT_THAT(text_of(page), AllOf(HasSubstr("Warnings"), HasSubstr("counted twice")));
}

TEST(LoopCommand, RefusesALimitThatIsNone) {
  EXPECT_THAT(soilbin("loop made-lesson --limit lod=1..2"), Refuses(HasSubstr("did you mean 'load'")));
  EXPECT_THAT(soilbin("loop made-lesson --limit load=2m..3m").err, HasSubstr("'m' is a length"));
  EXPECT_THAT(soilbin("loop made-lesson --limit load=3kN..2kN").err, HasSubstr("the lower end is above the upper"));
  EXPECT_THAT(soilbin("loop made-lesson --limit speed=0m/s..1m/s").err, HasSubstr("must be above 0 m/s"));
  EXPECT_THAT(soilbin("loop made-lesson --limit load=10..30").err,
              HasSubstr("expected a force, such as '4 kN', not '10'"));
}

// What has no limit keeps to the campaign's range.
TEST(SlowLoopCommand, AsksForARunWithinTheLimits) {
  const Outcome outcome = soilbin(
      "loop made-lesson --folds 2 --json --limit slip=0.1..0.2 --limit yaw=-2deg..3deg --limit load=0.3kN..400N");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const nlohmann::json condition = outcome.json().at("next_test").at("condition");
  EXPECT_THAT(condition.at("slip").get<double>(), AllOf(Ge(0.1), Le(0.2)));
  EXPECT_THAT(condition.at("yaw_deg").get<double>(), AllOf(Ge(-2.0), Le(3.0)));
  EXPECT_THAT(condition.at("load_N").get<double>(), AllOf(Ge(300.0), Le(400.0)));
  EXPECT_TRUE(condition.contains("speed_m_s"));
  // The numbers are those of the text.
  const std::string said =
      soilbin(
          "loop made-lesson --folds 2 --next --limit slip=0.1..0.2 --limit yaw=-2deg..3deg --limit load=0.3kN..400N")
          .out;
  EXPECT_THAT(said, HasSubstr(fmt::format("load {:g} N", condition.at("load_N").get<double>())));
  EXPECT_THAT(said, HasSubstr(fmt::format("slip {:g} %", 100 * condition.at("slip").get<double>())));
}

// What can't be written is refused before minutes of work, not after them.
TEST(LoopCommand, RefusesAFileThatCannotBeWrittenBeforeItWorks) {
  const Scratch scratch;
  scratch.write("file", "in the way");
  EXPECT_THAT(soilbin("loop made-lesson --save-model '" + (scratch / "file" / "model.yaml").string() + "'"),
              Refuses(HasSubstr("is a file, where a folder is to be")));
  EXPECT_THAT(soilbin("run paper-straight --csv '" + (scratch / "").string() + "'").err, HasSubstr("is a folder"));
}

// A folder that is there and takes no file is found by trying, before the work.
TEST(LoopCommand, TriesThePlacesOfItsFilesBeforeItWorks) {
  for (const std::string flag : {"--report", "--save-model"})
    EXPECT_THAT(soilbin("loop made-lesson " + flag + " /proc/left.file"),
                Refuses(AllOf(HasSubstr(flag), HasSubstr("no file can be made in '/proc'"))));
}

// No file may grow beyond 32 KiB: the page does not fit, found only once it is made. The answer is printed all the
// same, and the model, which is small, is there.
TEST(SlowLoopCommand, PrintsTheAnswerWhereTheReportCannotBeWritten) {
  const Scratch scratch;
  const fs::path page = scratch / "loop.html", model = scratch / "fitted.yaml";
  const Outcome outcome =
      soilbin("loop made-lesson --folds 2 --report '" + page.string() + "' --save-model '" + model.string() + "'",
              "trap '' XFSZ; ulimit -f 64; ");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.err, HasSubstr("loop.html: can't write"));
  EXPECT_THAT(outcome.out, HasSubstr("The model lacks multipass"));
  EXPECT_FALSE(fs::exists(page));
  EXPECT_THAT(text_of(model), HasSubstr("multipass"));
}

}  // namespace
}  // namespace soilbin::cli::test
