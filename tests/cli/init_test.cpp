// soilbin init --campaign, also from rows that are there, and soilbin plates: from nothing, or a sheet of plate tests,
// to a campaign that commands take.
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

// The rows of a spreadsheet with headings of its own become a campaign; what only its author knows is left to fill in.
TEST(Init, MakesACampaignOfRowsThatAreThere) {
  const Scratch scratch;
  const std::string rows = (scratch / "tests.csv").string(), folder = (scratch / "mine").string();
  std::ofstream(rows) << "Weight kN,Slip %,Pull N,Operator\n1,5,-20,Eva\n1,20,90,Eva\n";
  const Outcome made = soilbin("init --campaign '" + folder + "' --from '" + rows + "'");
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_THAT(made.out, AllOf(HasSubstr("Weight kN  load          kN"), HasSubstr("Operator   left aside")));
  EXPECT_EQ(text_of(scratch / "mine/tests.csv"), text_of(rows));
  const fs::path file = scratch / "mine/campaign.yaml";
  EXPECT_THAT(soilbin("check '" + folder + "'"), Refuses(HasSubstr("nothing stands behind 'radius'")));
  std::string text = text_of(file);
  const auto fill_in = [&](const std::string& from, const std::string& upto, const std::string& with) {
    const std::size_t begin = text.find(from);
    text.replace(begin, text.find(upto, begin) - begin, with);
  };
  fill_in("\nwheel:", "\n\n", "\nwheel: {radius: 300 mm, width: 200 mm}");
  fill_in("\nsoil:", "\n\n", "\nsoil: dry-sand");
  std::ofstream(file) << text;
  const fs::path answers = scratch / "answers.csv";
  ASSERT_EQ(soilbin("predict '" + folder + "' --csv '" + answers.string() + "'").status, 0);
  EXPECT_THAT(text_of(answers),
              AllOf(HasSubstr(",1000,0.05,"), HasSubstr(",1000,0.2,"), HasSubstr(",-20,"), HasSubstr(",90,")));
  EXPECT_THAT(soilbin("init --campaign '" + folder + "' --from '" + rows + "'"),
              Refuses(HasSubstr("campaign.yaml is there already and stays as it is")));
}

// Whoever has rows and no campaign.yaml meets the command that writes it, wherever they begin.
TEST(Init, IsNamedByWhatLacksACampaign) {
  const Scratch scratch;
  const fs::path folder = scratch / "c1", rows = folder / "runs.csv";
  fs::create_directory(folder);
  std::ofstream(rows) << "load_N,slip,torque_Nm\n80,0.1,2\n";
  const std::string quoted = "'" + folder.string() + "'";
  const auto writes_it = AllOf(HasSubstr("soilbin init --campaign "), HasSubstr("--from "), HasSubstr("runs.csv"));
  EXPECT_THAT(soilbin("loop '" + rows.string() + "'"), Refuses(writes_it));
  EXPECT_THAT(soilbin("loop " + quoted), Refuses(writes_it));
  EXPECT_THAT(soilbin("check " + quoted), Refuses(writes_it));
  EXPECT_THAT(soilbin("init --campaign " + quoted), Refuses(writes_it));
  const Outcome made = soilbin("init --campaign " + quoted + " --from '" + rows.string() + "'");
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_THAT(text_of(folder / "campaign.yaml"), AllOf(HasSubstr("\nname: c1\n"), HasSubstr("\ndata: \"runs.csv\"\n")));
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
