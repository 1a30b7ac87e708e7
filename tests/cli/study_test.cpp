#include <gmock/gmock.h>

#include "cli/command.hpp"

namespace soilbin::cli::test {
namespace {

using testing::HasSubstr;

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
  const Outcome again = soilbin("run '" + folder + "/case.yaml' --json");
  EXPECT_EQ(again.out, text_of(fs::path(folder) / "results.json")) << "the resolved case gives the same results";
}

TEST(Run, ConditionFlagsPickOrOverride) {
  EXPECT_EQ(soilbin("run paper-straight --load 4kN --json").json()["rows"].size(), 2U * 7U);
  const nlohmann::json overridden = soilbin("run paper-straight --load 3kN --json").json()["rows"];
  ASSERT_EQ(overridden.size(), 2U * 28U - 2U * 21U);
  EXPECT_EQ(overridden.at(0)["load"], 3000.0);
}

TEST(Run, DemSaysThatItIsNotHere) {
  const Outcome r = soilbin("run paper-straight --model dem");
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err, HasSubstr("not in this version"));
  EXPECT_THAT(soilbin("run paper-straight --model bekker_wrong").err, HasSubstr("did you mean 'bekker_wong'?"));
}

TEST(Run, NamesTheNearestStudy) {
  const Outcome r = soilbin("run paper-strait");
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err, HasSubstr("did you mean 'paper-straight'?"));
}

TEST(Run, AFileThatCannotBeWrittenIsAFailure) {
  const Outcome r = soilbin("run rover-slip --plot /no/such/folder/p.svg");
  EXPECT_EQ(r.status, 1);
  EXPECT_THAT(r.err, HasSubstr("p.svg"));
}

TEST(Report, IsOnePageThatLoadsNothing) {
  const Scratch scratch;
  const std::string file = (scratch / "page.html").string();
  const Outcome r = soilbin("report paper-straight rover-slip --measured cmu-smooth --output '" + file + "'");
  ASSERT_EQ(r.status, 0) << r.err;
  const std::string page = text_of(file);
  for (const char* word : {"<svg", "prefers-color-scheme", "paper-straight", "cmu-smooth", "soilbin report",
                           "Where the numbers come from"})
    EXPECT_THAT(page, HasSubstr(word));
  for (const char* word : {"http://", "https://", "<script", "<img", "<link", "url(", "nan"})
    EXPECT_THAT(page, testing::Not(HasSubstr(word))) << word;
  EXPECT_EQ(soilbin("report").status, 2);
}

}  // namespace
}  // namespace soilbin::cli::test
