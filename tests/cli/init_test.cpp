// soilbin init --campaign and soilbin plates: from nothing, or a sheet of plate tests, to a campaign that commands
// take.
#include <gmock/gmock.h>

#include "cli/command.hpp"

namespace soilbin::cli::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(SlowInit, ACampaignIsTakenAsItStands) {
  const Scratch scratch;
  const std::string folder = (scratch / "mine").string();
  const Outcome made = soilbin("init --campaign '" + folder + "'");
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_THAT(made.out, AllOf(HasSubstr("campaign.yaml"), HasSubstr("runs.csv"), HasSubstr("next: soilbin check")));
  const Outcome checked = soilbin("check '" + folder + "'");
  EXPECT_EQ(checked.status, 0) << checked.err;
  EXPECT_THAT(checked.out, HasSubstr("no warnings"));
  EXPECT_EQ(soilbin("predict '" + folder + "' --json").json()["rows"].size(), 24u);
  EXPECT_EQ(soilbin("loop '" + folder + "' --json").json()["verdict"], "effect_found");
  EXPECT_THAT(soilbin("init '" + folder + "' --campaign"),
              Refuses(HasSubstr("campaign.yaml is there already and stays as it is")));
}

TEST(Plates, GiveLinesForACampaign) {
  const Scratch scratch;
  const std::string file = SOILBIN_SOURCE_DIR "/cases/measured/plates/cmu-plates.csv",
                    plot = (scratch / "plates.svg").string();
  const Outcome r = soilbin("plates '" + file + "' --only box=large-box --plot '" + plot + "'");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.out, AllOf(HasSubstr("9 tests with plates of 3 sizes"), HasSubstr("  exponent: {value: "),
                           HasSubstr(", source: \"soilbin plates cmu-plates.csv\"}")));
  EXPECT_THAT(text_of(plot), HasSubstr("Pressure [kPa]"));
  const nlohmann::json fit = soilbin("plates '" + file + "' --only box=large-box --json").json();
  EXPECT_EQ(fit["format"], "soilbin-plates/1");
  EXPECT_GT(fit["exponent"]["std_error"], 0.0);
  EXPECT_EQ(fit["plates"].size(), 3u);
  EXPECT_THAT(soilbin("plates '" + file + "' --only box=large-bx"), Refuses(HasSubstr("did you mean 'large-box'?")));
}

}  // namespace
}  // namespace soilbin::cli::test
