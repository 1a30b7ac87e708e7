// Tables of contents: the library's own lists what is there, and a user's says what is wrong with it.
#include "scenario/contents.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/scenario/refusal.hpp"

namespace soilbin {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::vector<std::string> names_in(const std::vector<ContentsSection>& sections) {
  std::vector<std::string> names;
  for (const ContentsSection& section : sections)
    for (const ContentsLine& line : section.lines) names.push_back(line.name);
  return names;
}

TEST(Contents, OfTheLibraryListEveryNameInASectionWithALine) {
  const fs::path cases = SOILBIN_SOURCE_DIR "/cases";
  for (const Shelf shelf : all_shelves)
    for (const ContentsSection& section : contents_of({cases}, shelf)) {
      EXPECT_NE(section.title, "Others") << folder_of(shelf) << ": " << section.lines.front().name << " is not listed";
      if (shelf == Shelf::studies) continue;  // a study says itself what it asks
      for (const ContentsLine& line : section.lines) EXPECT_NE(line.meaning, "") << line.name;
    }
}

class UsersContents : public testing::Test {
 protected:
  fs::path folder = fs::temp_directory_path() / ("soilbin-contents-" + std::to_string(::getpid()));
  UsersContents() {
    fs::create_directories(folder / "tires");
    for (const char* name : {"mine", "other"})
      std::ofstream(folder / "tires" / (std::string(name) + ".yaml")) << "x: 1\n";
  }
  ~UsersContents() override { fs::remove_all(folder); }
  void write(const std::string& text) const { std::ofstream(folder / "contents.yaml") << text; }
};

TEST_F(UsersContents, GoBeforeTheLibrarysAndWhatTheyLeaveOutComesLast) {
  write("format: soilbin-contents/1\ntires:\n  My tires:\n    mine: what I drive\n    gone: not there\n");
  const std::vector<ContentsSection> sections = contents_of({folder, SOILBIN_SOURCE_DIR "/cases"}, Shelf::tires);
  EXPECT_EQ(sections.front().title, "My tires");
  ASSERT_EQ(sections.front().lines.size(), 1U) << "a name without a file is left out";
  EXPECT_EQ(sections.front().lines[0].meaning, "what I drive");
  EXPECT_EQ(sections.back().title, "Others");
  EXPECT_EQ(sections.back().lines[0].name, "other");
  EXPECT_EQ(names_in(sections).size(), Library({SOILBIN_SOURCE_DIR "/cases"}).names(Shelf::tires).size() + 2);
}

TEST_F(UsersContents, AreRefusedWithTheirPlace) {
  write("format: soilbin-contents/1\ntyres:\n  My tires:\n    mine: x\n");
  EXPECT_THAT(test::refusal([&] { contents_of({folder}, Shelf::tires); }),
              testing::AllOf(HasSubstr("contents.yaml:2:1"), HasSubstr("did you mean 'tires'?")));
  write("format: soilbin-contents/1\ntires: [mine]\n");
  EXPECT_THAT(test::refusal([&] { contents_of({folder}, Shelf::tires); }), HasSubstr("expected a mapping of sections"));
}

}  // namespace
}  // namespace soilbin
