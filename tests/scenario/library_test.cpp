// The cases that come with soilbin can be read, and say where their numbers come from.
#include "scenario/library.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>

#include "scenario/case.hpp"
#include "scenario/yaml_node.hpp"
#include "tests/scenario/fake_vocabulary.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

const Library& library() {
  static const Library cases({SOILBIN_SOURCE_DIR "/cases"});
  return cases;
}

/// The library, that of the bench in which grains are nature, and that of the paper's sand under the default rolling
/// law.
std::array<Library, 3> libraries() {
  return {library(), Library({SOILBIN_SOURCE_DIR "/bench/dem_nature"}),
          Library({SOILBIN_SOURCE_DIR "/bench/elastic_plastic", SOILBIN_SOURCE_DIR "/cases"})};
}

TEST(Library, ListsNames) {
  EXPECT_THAT(library().names(Shelf::tires), Contains("paper-lugged"));
  EXPECT_THAT(library().names(Shelf::soils), Contains("dry-sand"));
  EXPECT_THAT(library().names(Shelf::studies), Contains("paper-straight"));
  EXPECT_THAT(library().names(Shelf::measured), Contains("cmu-smooth"));
  EXPECT_THAT(library().names(Shelf::vehicles), Contains("truck"));
  EXPECT_TRUE(Library({"no/such/folder"}).names(Shelf::tires).empty());
}

TEST(Library, TheFirstFolderWins) {
  const std::filesystem::path found = *library().beside("elsewhere/case.yaml").find(Shelf::tires, "paper-lugged");
  EXPECT_EQ(found, std::filesystem::path(SOILBIN_SOURCE_DIR) / "cases/tires/paper-lugged.yaml");
  EXPECT_FALSE(library().find(Shelf::tires, "../tires/paper-lugged")) << "a name is no path";
  EXPECT_FALSE(library().find(Shelf::tires, ""));
}

TEST(Library, FindsTheFileBehindANameOrAPath) {
  const std::filesystem::path cases = std::filesystem::path(SOILBIN_SOURCE_DIR) / "cases";
  EXPECT_EQ(find_file(library(), Shelf::measured, "cmu-smooth"), cases / "measured/cmu-smooth/campaign.yaml");
  EXPECT_EQ(find_file(library(), Shelf::studies, "mine/case.yaml"), "mine/case.yaml") << "a path is taken as it is";
  EXPECT_THAT(test::refusal([] { find_file(library(), Shelf::measured, "cmu-smoth"); }),
              HasSubstr("no campaign 'cmu-smoth' in the library, and no such file, did you mean 'cmu-smooth'?"));
  EXPECT_THAT(test::refusal([] { find_file(library(), Shelf::studies, "rover-wheel"); }),
              HasSubstr("no study 'rover-wheel' in the library: that is a tire\n  hint: --tire rover-wheel takes it"));
  EXPECT_THAT(test::refusal([] { find_file(library(), Shelf::measured, "rover-wheel"); }),
              HasSubstr("that is a tire\n  hint: there are cmu-grousered, "))
      << "who asks for a campaign has no flag --tire";
  EXPECT_THAT(
      test::refusal([] { find_file(library(), Shelf::measured, "rover-climb"); }),
      HasSubstr("no campaign 'rover-climb' in the library: that is a study\n  hint: there are cmu-grousered, "));
}

TEST(Library, SaysWhatTakesAVehicleAndWhatAVehicleIsNot) {
  EXPECT_THAT(test::refusal([] { find_file(library(), Shelf::studies, "truck"); }),
              HasSubstr("no study 'truck' in the library: that is a vehicle\n  hint: soilbin vehicle truck takes it"));
  EXPECT_THAT(test::refusal([] { find_file(library(), Shelf::vehicles, "trukc"); }),
              HasSubstr("no vehicle 'trukc' in the library, and no such file, did you mean 'truck'?"));
}

TEST(Library, CountsItsNamesWhereALineDoesNotHoldThem) {
  const Library many = libraries()[1];
  EXPECT_THAT(test::refusal([&] { find_file(many, Shelf::studies, "dem-nul"); }),
              testing::AllOf(HasSubstr("did you mean 'dem-null'?"), HasSubstr("soilbin list studies shows the 24 "),
                             testing::Not(HasSubstr("dem-deep-incline"))))
      << "names of three lines tell nobody anything";
}

TEST(Library, SearchesTheUsersFoldersFirst) {
  const std::filesystem::path source = SOILBIN_SOURCE_DIR, cases = source / "cases";
  setenv("SOILBIN_CASES", ("no/such/folder:" + (source / "docs").string()).c_str(), 1);
  EXPECT_THAT(case_folders(source / "bench", cases), ElementsAre(source / "docs", source / "bench", cases));
  unsetenv("SOILBIN_CASES");
  EXPECT_THAT(case_folders("", cases), ElementsAre(cases)) << "nothing installed";
}

TEST(Library, EveryTireAndSoilIsReadAndNamesItsSource) {
  for (const Library& cases : libraries()) {
    for (const std::string& name : cases.names(Shelf::tires)) {
      const Tire tire = find_tire(name, cases);
      EXPECT_EQ(tire.name, name);
      EXPECT_NE(tire.source, "") << name;
    }
    for (const std::string& name : cases.names(Shelf::soils)) {
      const Soil soil = find_soil(name, cases);
      EXPECT_EQ(soil.name, name);
      EXPECT_NE(soil.source, "") << name;
    }
  }
}

TEST(Library, EveryStudyIsRead) {
  for (const Library& cases : libraries())
    for (const std::string& name : cases.names(Shelf::studies)) {
      const Case c = read_case(*cases.find(Shelf::studies, name), cases, test::FakeVocabulary());
      EXPECT_EQ(c.name, name);
      EXPECT_NE(c.source, "") << name;
      EXPECT_TRUE(!c.study.conditions.empty() || c.drive) << name << " asks something: conditions, or a drive";
    }
}

TEST(Library, ThePapersStraightStudyIsItsTwentyEightPoints) {
  const Case c = read_case(*library().find(Shelf::studies, "paper-straight"), library(), test::FakeVocabulary());
  ASSERT_EQ(c.study.conditions.size(), 28u) << "four loads, seven slips";
  EXPECT_EQ(c.study.conditions.front().load, 2000.0);
  EXPECT_EQ(c.study.conditions.back().slip, 0.6);
  EXPECT_EQ(c.scenario.tire.lugs.height, 0.011);
  EXPECT_EQ(c.scenario.soil.granular->grain_tire.sliding_friction, 0.52);
}

TEST(Library, TheExampleOfTheDocumentationIsACase) {
  const std::string page = read_source_text(SOILBIN_SOURCE_DIR "/docs/reference/case-files.md", largest_yaml).text;
  const std::string fence = "```yaml\n";
  const std::size_t begin = page.find(fence) + fence.size();
  const std::string example = page.substr(begin, page.find("```", begin) - begin);
  const Case c =
      parse_case(make_source_text(example, "docs/reference/case-files.md"), Library(), test::FakeVocabulary());
  EXPECT_EQ(c.study.models.size(), 4u);
  EXPECT_EQ(c.study.conditions.size(), 14u);
}

}  // namespace
}  // namespace soilbin
