// The command where its surroundings are odd: a small stack, folders of beds and caches that can't be used.
#include <gmock/gmock.h>

#include "cli/command.hpp"

namespace soilbin::cli::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::string wheel_asked = "estimate --radius 110mm --width 100mm --soil dry-sand --load 80N --slip 20%";

// Beyond the end of a stack a program ends by a signal, without a word.
TEST(SlowSurroundings, ASmallStackIsToldOf) {
  const Outcome small = soilbin(wheel_asked, "ulimit -S -s 64; ");
  EXPECT_EQ(small.status, 1);
  EXPECT_THAT(small.err, AllOf(HasSubstr("the stack is limited to 64 kB"), HasSubstr("hint: ulimit -s 8192")));
  EXPECT_EQ(soilbin(wheel_asked, "ulimit -S -s 1024; ").status, 0);
}

std::string stones() { return text_of(SOILBIN_SOURCE_DIR "/tests/fixtures/pebbles.yaml"); }

const char* const case_of_grains = R"(format: soilbin-case/1
name: pebbles
tire: {radius: 150 mm, width: 100 mm}
soil: pebbles.yaml
study:
  models: [dem]
  conditions: {load: 60 N, slip: 20 %, speed: 0.6 m/s}
)";

// Its links lead in a circle: whoever asks for a file in it gets an error, as in a folder that may not be searched.
TEST(SlowSurroundings, AFolderOfBedsThatCantBeSearchedIsDoneWithout) {
  const Scratch scratch;
  fs::create_directory_symlink(scratch / "loop", scratch / "loop");
  scratch.write("pebbles.yaml", stones());
  const fs::path file = scratch.write("case.yaml", case_of_grains);
  const std::string beds = "SOILBIN_BEDS='" + (scratch / "loop").string() + "' ";
  const std::string bed = " --bed-length 1.2m --bed-width 0.25m --bed-depth 0.09m ";
  const Outcome plan = soilbin("run '" + file.string() + "' --dry-run" + bed, beds);
  EXPECT_EQ(plan.status, 0) << plan.err;
  EXPECT_THAT(plan.out, HasSubstr("beds      1 to settle"));
  const Outcome settled = soilbin("bed '" + file.string() + "'" + bed, beds);
  EXPECT_EQ(settled.status, 1);
  EXPECT_THAT(settled.err, AllOf(HasSubstr("the bed isn't kept"), Not(HasSubstr("filesystem error"))));
}

// An empty name of a cache counts as none, as the XDG Base Directory Specification has it; beds went into ./soilbin.
TEST(SlowSurroundings, AnEmptyCacheNameIsNone) {
  const Scratch scratch;
  scratch.write("pebbles.yaml", stones());
  const fs::path file = scratch.write("case.yaml", case_of_grains);
  fs::create_directory(scratch / "home");
  const std::string before = "cd '" + (scratch / "home").string() + "'; unset SOILBIN_BEDS; XDG_CACHE_HOME= HOME='" +
                             (scratch / "home").string() + "' ";
  const Outcome settled =
      soilbin("bed '" + file.string() + "' --bed-length 1.2m --bed-width 0.25m --bed-depth 0.09m", before);
  EXPECT_EQ(settled.status, 0) << settled.err;
  EXPECT_FALSE(fs::exists(scratch / "home/soilbin"));
  EXPECT_TRUE(fs::exists(scratch / "home/.cache/soilbin/beds"));
}

// 'record merge shard-*.json', its OUT forgotten, took the first shard for it, and its runs were gone.
TEST(Surroundings, AMergeOverwritesNothingThatItDoesNotHold) {
  const Scratch scratch;
  const std::string records = SOILBIN_SOURCE_DIR "/cases/studies/recorded/";
  const fs::path whole = scratch / "whole.json", notes = scratch.write("notes.txt", "mine\n"),
                 first = scratch.write("shard-1.json", text_of(records + "paper-straight.json")),
                 second = scratch.write("shard-2.json", text_of(records + "paper-horizontal.json"));
  const auto merge = [](const fs::path& out, const fs::path& shard) {
    return soilbin("record merge '" + out.string() + "' '" + shard.string() + "'");
  };
  const std::string before = text_of(first);
  const Outcome lost = merge(first, second), text = merge(notes, second);
  EXPECT_EQ(lost.status, 2);
  EXPECT_THAT(lost.err, AllOf(HasSubstr("shard-1.json: holds a run that none of the others does"),
                              HasSubstr("hint: name the record to write first")));
  EXPECT_EQ(text_of(first), before);
  EXPECT_EQ(text.status, 2);
  EXPECT_THAT(text.err, HasSubstr("notes.txt: is there already, is no record"));
  EXPECT_EQ(text_of(notes), "mine\n");
  EXPECT_EQ(merge(whole, first).status, 0);
  const std::string merged = text_of(whole);
  EXPECT_EQ(merge(whole, first).status, 0) << "all its runs are there again";
  EXPECT_EQ(text_of(whole), merged);
}

TEST(Surroundings, AWholeNumberThatIsTooLargeIsToldItsRange) {
  EXPECT_THAT(soilbin(wheel_asked + " --pass 2147483647"),
              Refuses(HasSubstr("--pass: expected a whole number from 1 to 1000000000, not '2147483647'")));
}

}  // namespace
}  // namespace soilbin::cli::test
