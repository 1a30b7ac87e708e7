// What the command says to words that it can't take: ours, never those of the library that reads them.
#include <gmock/gmock.h>

#include <utility>

#include "cli/command.hpp"

namespace soilbin::cli::test {
namespace {

using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

TEST(CommandWords, AreRefusedInOurs) {
  const std::pair<const char*, const char*> refused[] = {
      {"estimate --soil dry-sand --load 1N --load 2N", "--load is given more than once"},
      {"estimate --slip", "--slip needs a value (NUMBER|%)"},
      {"estimate a.yaml b.yaml", "'b.yaml' is one word too many"},
      {"estimate a b c", "these words are too many: "},
      {"run", "'study' is missing"},
      {"loop made-lesson --seed -1", "--seed: expected a whole number, such as 1, not '-1'"},
      {"loop made-lesson --folds abc", "--folds: expected a whole number from 2 to 50, not 'abc'"},
      {"loop made-lesson --folds 51", "--folds: expected a whole number from 2 to 50, not '51'"},
      {"calibrate paper-sand --ask 0", "--ask: expected a whole number from 1 to 10000, not '0'"},
      {"calibrate paper-sand --seed 1.5", "--seed: expected a whole number of at least 1, not '1.5'"},
      {"calibrate paper-sand --decide-at load=1N..2N", "--decide-at needs --decide"},
      {"run rover-slip --record a.json --recorded b.json", " exclude each other"},
      {"explain --soil dry-sand --plot a.svg", "soilbin estimate --slip 0%..60% --plot slip.svg"},
      {"loop made-lesson --csv a.csv", "soilbin"},
      {"run --soil dry-sand", "soilbin init mine writes one to change"},
      {"--nope", "'--nope' is where a command is expected"},
      {"estimate --soil dry-sand --radius 1m --width 1m --load 1kN --slip 0.1 --density 1600kg/m^3+-100kg/m^3",
       "--density: a density has no standard deviation here"},
  };
  for (const auto& [words, said] : refused) {
    const Outcome r = soilbin(words);
    EXPECT_EQ(r.status, 2) << words;
    EXPECT_THAT(r.err, StartsWith("soilbin: ")) << words;
    EXPECT_THAT(r.err, HasSubstr(said)) << words;
    EXPECT_THAT(r.err, HasSubstr("\n  hint: ")) << words;
    EXPECT_THAT(r.err, Not(AnyOf(HasSubstr("At Most"), HasSubstr("Could not convert"), HasSubstr("not in range"),
                                 HasSubstr("required"), HasSubstr("expected: "))))
        << words;
    EXPECT_LT(r.err.size(), 300U) << words;
  }
}

TEST(CommandWords, WhatIsMissingIsShownByAnExample) {
  const std::pair<const char*, const char*> shown[] = {
      {"sweep", "'study' is missing\n  hint: such as soilbin sweep paper-straight "},
      {"design", "'campaign' is missing\n  hint: such as soilbin design FOLDER "},
      {"drive", "'case' is missing\n  hint: such as soilbin drive rover-climb "},
      {"export scm", "hint: such as soilbin export scm dry-sand "},
  };
  for (const auto& [words, said] : shown) EXPECT_THAT(soilbin(words), Refuses(HasSubstr(said))) << words;
}

TEST(CommandWords, NamesThatNothingHasAreLookedUpOnTheRightShelves) {
  EXPECT_THAT(soilbin("reproduce nosuch"), Refuses(HasSubstr("hint: there are paper\n")));
  EXPECT_THAT(soilbin("report nosuch"),
              Refuses(AllOf(HasSubstr("no study or campaign 'nosuch'"), HasSubstr("cmu-smooth"))));
  EXPECT_THAT(soilbin("report cmu-smoth"), Refuses(HasSubstr("did you mean 'cmu-smooth'?")));
}

// By its keys, or by its name; a file that tells neither hears of every format.
TEST(CommandWords, AFileWithoutItsFormatIsToldWhichOneItIs) {
  const Scratch scratch;
  const std::pair<const char*, const char*> told[] = {
      {"radius: 1 m\nwidth: 1 m\n", "hint: format: soilbin-tire/1"},
      {"name: a\ndata: runs.csv\n", "hint: format: soilbin-campaign/1"},
      {"tire: rover-wheel\nsoil: dry-sand\n", "hint: format: soilbin-case/1"},
      {"name: a\nsemi_empirical: {}\n", "hint: format: soilbin-soil/1"},
      {"format: soilbin-campain/1\nname: a\n", "hint: format: soilbin-campaign/1"},
      {"name: a\n", "one of format: soilbin-case/1, soilbin-campaign/1, "},
  };
  for (const auto& [text, hint] : told)
    EXPECT_THAT(soilbin("check '" + scratch.write("a.yaml", text).string() + "'"),
                Refuses(AllOf(HasSubstr("format"), HasSubstr(hint))))
        << text;
  EXPECT_THAT(soilbin("check '" + scratch.write("campaign.yaml", "name: a\n").string() + "'"),
              Refuses(HasSubstr("hint: format: soilbin-campaign/1")));
}

TEST(CommandWords, ACsvIsNoFileOfASpreadsheetAndIsNamedWhenWritten) {
  const Scratch scratch;
  const std::string ask = "estimate --soil dry-sand --tire rover-wheel --load 65N --slip 0%..60% --csv '";
  for (const char* ending : {"a.xlsx", "a.XLS", "a.ods"})
    EXPECT_THAT(soilbin(ask + (scratch / ending).string() + "'"), Refuses(HasSubstr("name it .csv"))) << ending;
  EXPECT_THAT(soilbin("design made-lesson --csv '" + (scratch / "a.ods").string() + "'"),
              Refuses(HasSubstr("name it .csv")));
  const std::string table = (scratch / "a.csv").string();
  EXPECT_THAT(soilbin(ask + table + "'").err, HasSubstr("wrote " + table + "\n"));
}

TEST(CommandWords, AnEmptyTextIsNoValue) {
  for (const std::string words :
       {"estimate --soil", "estimate --tire", "estimate --load", "estimate --effect", "estimate --plot",
        "estimate --model", "run paper-smooth --record", "run paper-smooth --recorded", "run paper-smooth --wheel-mesh",
        "run paper-smooth --csv", "vehicle rover --soil", "vehicle rover --driven", "vehicle rover --mass",
        "loop made-lesson --limit", "loop made-lesson --seed", "plates a.csv --only"})
    EXPECT_THAT(soilbin(words + " ''"),
                Refuses(HasSubstr(words.substr(words.rfind("--")) + ": the text is empty\n  hint: ")))
        << words;
  EXPECT_THAT(soilbin("estimate --soil= --slip 20%"), Refuses(HasSubstr("--soil: the text is empty")));
  EXPECT_THAT(soilbin("run ''"), Refuses(HasSubstr("an argument: the text is empty")));
}

TEST(CommandWords, WordsOfTheFieldLeadToOurs) {
  const std::pair<const char*, const char*> led[] = {
      {"estimate --soil dry-sand --grouser-height 8mm",
       "'estimate' has no option '--grouser-height', did you mean '--lug-height'?"},
      {"estimate --soil dry-sand --slope 8deg", "did you mean '--longitudinal-incline'?"},
      {"estimate rover-slip --effect grouser", "did you mean 'lug_thrust'?"},
      {"estimate rover-slip --effect lugs", "did you mean 'lug_thrust'?"},
      {"fit", "unknown command 'fit', did you mean 'loop' or 'plates'?"},
      {"incline", "did you mean 'limits' or 'failure-map'?"},
      {"map", "did you mean 'failure-map'?"},
      {"limits rover-slip --slip 20%", "limits looks for the slip and the slope; soilbin estimate answers"},
      {"limits rover-slip --slope 20deg", "limits looks for the slip and the slope; soilbin estimate answers"},
      {"limits --soil dry-sand --tire rover-wheel", "--load is missing\n  hint: such as --load 80N\n"},
      {"bevameter paper-sand --size 0.5", "hint: a larger --size"},
      {"list curiosity", "'curiosity' is in the list of tires\n  hint: soilbin list tires; the whole of it: "},
  };
  for (const auto& [words, said] : led) EXPECT_THAT(soilbin(words, "timeout 20 "), Refuses(HasSubstr(said))) << words;
  EXPECT_THAT(soilbin("limits --help").out, Not(AnyOf(HasSubstr("--slip "), HasSubstr("--longitudinal-incline"))));
}

TEST(CommandWords, AHintIsGivenOnce) {
  const std::string err = soilbin("run rover-slip --plot x.jpg").err;
  EXPECT_THAT(err, HasSubstr("hint: .svg, .png or .pdf"));
  EXPECT_EQ(err.find("hint: "), err.rfind("hint: ")) << err;
}

TEST(CommandWords, ALinkedPageIsAFileOfBoundedSize) {
  EXPECT_THAT(soilbin("report rover-slip --link /dev/zero --output /dev/null", "timeout 20 "),
              Refuses(HasSubstr("/dev/zero: is not a regular file")));
}

}  // namespace
}  // namespace soilbin::cli::test
