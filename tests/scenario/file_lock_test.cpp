#include "scenario/file_lock.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <stdexcept>

#include "tests/folder.hpp"

namespace soilbin {
namespace {

namespace fs = std::filesystem;

class FileLocks : public testing::Test {
 protected:
  void TearDown() override { set_while_waiting({}); }

  const test::Folder scratch_;
  const fs::path folder_ = scratch_.path();
};

TEST_F(FileLocks, OnlyOneHoldsIt) {
  const FileLock one(folder_ / "a.lock", FileLock::Wait::no);
  EXPECT_TRUE(one.is_held());
  EXPECT_FALSE(FileLock(folder_ / "a.lock", FileLock::Wait::no).is_held());
  EXPECT_TRUE(FileLock(folder_ / "b.lock", FileLock::Wait::no).is_held());
}

TEST_F(FileLocks, AWaitIsLookedAfterAndEndsWhereTheLookThrows) {
  const FileLock one(folder_, FileLock::Wait::no);
  struct GaveUp {};
  int looks = 0;
  set_while_waiting([&](const fs::path& place) {
    EXPECT_EQ(place, folder_);
    if (++looks == 3) throw GaveUp();
  });
  EXPECT_THROW(FileLock(folder_, FileLock::Wait::until_free), GaveUp);
  EXPECT_EQ(looks, 3);
}

TEST_F(FileLocks, ALinkIsNotFollowed) {
  fs::create_symlink(folder_ / "victim", folder_ / "a.lock");
  EXPECT_THROW(FileLock(folder_ / "a.lock", FileLock::Wait::no), std::runtime_error);
  EXPECT_FALSE(fs::exists(folder_ / "victim"));
}

}  // namespace
}  // namespace soilbin
