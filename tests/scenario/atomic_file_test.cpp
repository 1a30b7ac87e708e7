#include "scenario/atomic_file.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <fstream>
#include <sstream>
#include <stdexcept>

#include "tests/folder.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin {
namespace {

namespace fs = std::filesystem;

std::string content(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

class AtomicFile : public testing::Test {
 protected:
  long files() const { return std::distance(fs::directory_iterator(folder_), fs::directory_iterator()); }

  const test::Folder scratch_;
  const fs::path folder_ = scratch_.path();
};

TEST_F(AtomicFile, WritesAndReplaces) {
  write_file_atomically(folder_ / "a.txt", "first");
  write_file_atomically(folder_ / "a.txt", std::string("sec\0nd", 6));
  EXPECT_EQ(content(folder_ / "a.txt"), std::string("sec\0nd", 6));
  EXPECT_EQ(files(), 1) << "no temporary file is left";
}

TEST_F(AtomicFile, MakesTheFoldersThatAreMissing) {
  write_file_atomically(folder_ / "new" / "deep" / "a.txt", "x");
  EXPECT_EQ(content(folder_ / "new" / "deep" / "a.txt"), "x");
}

TEST_F(AtomicFile, TakesANameOfTheGreatestLength) {
  const fs::path longest = folder_ / std::string(255, 'n');
  write_file_atomically(longest, "x");
  EXPECT_EQ(content(longest), "x");
  EXPECT_THAT(why_not_writable(folder_ / std::string(256, 'n')), testing::HasSubstr("can't be written"));
}

TEST_F(AtomicFile, KeepsWhoMayReadAFile) {
  write_file_atomically(folder_ / "secret.txt", "first");
  fs::permissions(folder_ / "secret.txt", fs::perms::owner_read | fs::perms::owner_write);
  write_file_atomically(folder_ / "secret.txt", "second");
  EXPECT_EQ(content(folder_ / "secret.txt"), "second");
  EXPECT_EQ(fs::status(folder_ / "secret.txt").permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

// A person who names a link means the file behind it; a name that the program chose is never led astray.
TEST_F(AtomicFile, FollowsAPersonsLinksAndReplacesAStrangers) {
  fs::create_directories(folder_ / "there");
  write_file_atomically(folder_ / "there" / "a.txt", "first");
  fs::create_symlink("there/a.txt", folder_ / "link");
  write_file_atomically(folder_ / "link", "second");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
  EXPECT_EQ(content(folder_ / "there" / "a.txt"), "second");

  FreshFile file(folder_ / "link", Links::replaced);
  file.write("third");
  file.put_in_place();
  EXPECT_FALSE(fs::is_symlink(folder_ / "link"));
  EXPECT_EQ(content(folder_ / "link"), "third");
  EXPECT_EQ(content(folder_ / "there" / "a.txt"), "second");
}

TEST_F(AtomicFile, MakesTheFileThatALinkLeadsTo) {
  fs::create_symlink("later.txt", folder_ / "link");
  write_file_atomically(folder_ / "link", "x");
  EXPECT_EQ(content(folder_ / "later.txt"), "x");
}

TEST_F(AtomicFile, WritesToADeviceAndTellsThatItIsFull) {
  write_file_atomically("/dev/null", "x");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_EQ(test::refusal<std::runtime_error>([] { write_file_atomically("/dev/full", "x"); }),
            "/dev/full: can't write: No space left on device");
}

TEST_F(AtomicFile, WhatIsNeverPutInPlaceWasNeverThere) {
  {
    FreshFile file(folder_ / "a.txt");
    file.write("half of it");
    EXPECT_LE(files(), 1) << "one temporary file where the file system needs a name for it";
    EXPECT_FALSE(fs::exists(folder_ / "a.txt"));
  }
  EXPECT_EQ(files(), 0);
}

// As a kill between two system calls leaves it; a writer that is alive holds its lock.
TEST_F(AtomicFile, WhatAKilledWriterLeftIsRemovedAndWhatALivingOneHasStays) {
  write_file_atomically(folder_ / "a.txt", "old");
  std::ofstream(folder_ / ".a.txt.soilbin-77-1") << "abandoned";
  std::ofstream(folder_ / ".a.txt.soilbin-88-1") << "in the making";
  const int alive = ::open((folder_ / ".a.txt.soilbin-88-1").c_str(), O_RDONLY | O_CLOEXEC);
  ASSERT_EQ(::flock(alive, LOCK_EX), 0);
  write_file_atomically(folder_ / "a.txt", "new");
  EXPECT_FALSE(fs::exists(folder_ / ".a.txt.soilbin-77-1"));
  EXPECT_TRUE(fs::exists(folder_ / ".a.txt.soilbin-88-1"));
  ::close(alive);
}

TEST_F(AtomicFile, ATrialSaysWhyAndLeavesNothing) {
  EXPECT_EQ(why_not_writable(folder_ / "a.txt"), "");
  EXPECT_EQ(why_not_writable(folder_ / "new" / "a.txt"), "");
  EXPECT_EQ(why_no_folder(folder_ / "new" / "deep"), "");
  EXPECT_EQ(files(), 0);
  write_file_atomically(folder_ / "file", "x");
  EXPECT_THAT(why_not_writable(folder_ / "file" / "a.txt"), testing::HasSubstr("is a file, where a folder is to be"));
  EXPECT_THAT(why_no_folder(folder_ / "file" / "deep"), testing::HasSubstr("is a file, where a folder is to be"));
  EXPECT_THAT(why_not_writable(folder_), testing::HasSubstr("is a folder, where a file is to be written"));
  EXPECT_THAT(why_not_writable("/proc/a.txt"), testing::HasSubstr("no file can be made in '/proc'"));
}

TEST_F(AtomicFile, AFailureLeavesNothingBehind) {
  fs::create_directories(folder_ / "b.txt" / "inside");
  EXPECT_THAT(test::refusal<std::runtime_error>([&] { write_file_atomically(folder_ / "b.txt", "x"); }),
              testing::HasSubstr("b.txt: can't write: "));
  EXPECT_EQ(files(), 1) << "only the folder b.txt";
}

}  // namespace
}  // namespace soilbin
