// soilbin reproduce, and the library's recorded runs.
#include <gmock/gmock.h>

#include <algorithm>

#include "cli/command.hpp"

namespace soilbin::cli::test {
namespace {

using testing::HasSubstr;

TEST(RecordedStudies, AnswerAsTheFileThatIsNamed) {
  const std::string file = SOILBIN_SOURCE_DIR "/cases/studies/recorded/paper-straight.json";
  const Outcome found = soilbin("run paper-straight --recorded --load 4kN --slip 20%");
  const Outcome named = soilbin("run paper-straight --load 4kN --slip 20% --recorded '" + file + "'");
  ASSERT_EQ(found.status, 0) << found.err;
  EXPECT_EQ(found.out, named.out);
  EXPECT_THAT(found.out, HasSubstr("dem: 3 runs"));
}

// An own case of the recorded wheel, at three of the recorded conditions.
TEST(RecordedStudies, AnswerAnOwnCaseByTheNameOfTheRecordedStudy) {
  const Scratch scratch;
  const std::string own = "'" +
                          scratch
                              .write("own.yaml", R"(format: soilbin-case/1
name: own
tire: paper-lugged
soil: paper-sand
study:
  models: [bekker_wong]
  conditions: {load: 4 kN, slip: [0 %, 20 %, 40 %], rotation: 10 rpm}
)")
                              .string() +
                          "' ";
  const Outcome r = soilbin("run " + own + "--recorded paper-straight --slip 20%");
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.out, HasSubstr("dem: 3 runs"));
  EXPECT_THAT(soilbin("run " + own + "--recorded paper-strait"), Refuses(HasSubstr("did you mean 'paper-straight'")));
}

TEST(RecordedStudies, AStudyWithoutRunsSaysHowToMakeThem) {
  EXPECT_THAT(
      soilbin("run rover-slip --recorded"),
      Refuses(AllOf(HasSubstr("there are no recorded runs of 'rover-slip'"), HasSubstr("--model dem --record"))));
}

TEST(ReproduceCommand, CallsFindingsOfThePaperByTheirNames) {
  const Outcome outcome = soilbin("reproduce --json");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const nlohmann::json told = outcome.json();
  EXPECT_GE(told.at("rows").size(), 40U);
  // By eye on the recorded runs: at 4 kN the pull rises from 0 to 20 % slip by 673 N and from there to 60 % by 259 N.
  const auto& all = told.at("rows");
  const auto steep = std::find_if(all.begin(), all.end(),
                                  [](const auto& finding) { return finding.at("id") == "straight-pull-steep-to-20"; });
  ASSERT_NE(steep, all.end());
  EXPECT_EQ(steep->at("answers").at("dem").at("verdict"), "shown");
  const std::string warnings = told.at("warnings").dump();
  EXPECT_THAT(warnings, HasSubstr("paper-efficiency, paper-efficiency-uphill, paper-horizontal, paper-longitudinal, "
                                  "paper-straight, paper-transverse: the grains are coarse for this wheel"));
  EXPECT_EQ(warnings.find("coarse"), warnings.rfind("coarse")) << "once for all studies of the one wheel";
  EXPECT_THAT(warnings, HasSubstr("+1053 ± 1345 N")) << "where it is worst: 8 kN, 10 % slip, of paper-efficiency";
  EXPECT_THAT(told.at("warning_kinds").dump(), Not(HasSubstr("rolling_depends_on_step")));
}

TEST(ReproduceCommand, RefusesAnUnknownPaperAndARecordOfAnotherStudy) {
  EXPECT_THAT(soilbin("reproduce papr"), Refuses(HasSubstr("did you mean 'paper'")));
  EXPECT_THAT(soilbin("reproduce --recorded nowhere.json"), Refuses(HasSubstr("nowhere.json")));
}

}  // namespace
}  // namespace soilbin::cli::test
