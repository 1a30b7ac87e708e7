// soilbin verify, run as a person runs it.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "cli/command.hpp"

namespace soilbin::cli::test {
namespace {

using testing::EndsWith;
using testing::HasSubstr;

TEST(VerifyCommand, TellsTheCasesAskedForAsTextJsonAndPage) {
  const Scratch scratch;
  const std::string page = (scratch / "verify.html").string(), asked = "verify --case 'steel starts to slide'";
  const Outcome text = soilbin(asked + " --report '" + page + "'");
  ASSERT_EQ(text.status, 0) << text.err;
  EXPECT_THAT(text.out, EndsWith("\n2 of 2 cases within their tolerance\n"));
  EXPECT_THAT(text_of(page), HasSubstr("steel starts to slide"));
  const nlohmann::json told = soilbin(asked + " --json").json();
  EXPECT_EQ(told["format"], "soilbin-verify/1");
  ASSERT_EQ(told["rows"].size(), 2U);
  for (const auto& row : told["rows"]) EXPECT_TRUE(row["pass"].get<bool>()) << row;
}

}  // namespace
}  // namespace soilbin::cli::test
