#include "scenario/atomic_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

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
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "soilbin-atomic-XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { fs::remove_all(folder_); }

  long files() const { return std::distance(fs::directory_iterator(folder_), fs::directory_iterator()); }

  fs::path folder_;
};

TEST_F(AtomicFile, WritesAndReplaces) {
  write_file_atomically(folder_ / "a.txt", "first");
  write_file_atomically(folder_ / "a.txt", std::string("sec\0nd", 6));
  EXPECT_EQ(content(folder_ / "a.txt"), std::string("sec\0nd", 6));
  EXPECT_EQ(files(), 1) << "no temporary file is left";
}

TEST_F(AtomicFile, AFailureLeavesNothingBehind) {
  EXPECT_THROW(write_file_atomically(folder_ / "missing" / "a.txt", "x"), std::runtime_error);
  fs::create_directories(folder_ / "b.txt" / "inside");
  try {
    write_file_atomically(folder_ / "b.txt", "x");
    ADD_FAILURE() << "a folder was replaced";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("b.txt: can't rename into place: "));
  }
  EXPECT_EQ(files(), 1) << "only the folder b.txt";
}

}  // namespace
}  // namespace soilbin
