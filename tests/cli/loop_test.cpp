// soilbin loop, run as a person runs it.
#include <gmock/gmock.h>

#include "cli/command.hpp"

namespace soilbin::cli::test {
namespace {

using testing::HasSubstr;

TEST(LoopCommand, NamesTheLessonsEffectInWordsAndLeavesItsFiles) {
  const Scratch scratch;
  const std::string page = (scratch / "loop.html").string(), model = (scratch / "fitted.yaml").string();
  const Outcome outcome = soilbin("loop made-lesson --report '" + page + "' --save-model '" + model + "'");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("The model lacks multipass"));
  EXPECT_THAT(outcome.out, HasSubstr("Measure next"));
  EXPECT_THAT(text_of(page), HasSubstr("<svg"));
  const Outcome predicted = soilbin("predict made-lesson --model '" + model + "'");
  EXPECT_EQ(predicted.status, 0) << predicted.err;
}

TEST(LoopCommand, AnswersInTheContractsForm) {
  const Outcome outcome = soilbin("loop made-lesson --json");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const nlohmann::json answer = outcome.json();
  EXPECT_EQ(answer.at("format"), "soilbin-loop/1");
  EXPECT_EQ(answer.at("campaign"), "made-lesson");
  EXPECT_EQ(answer.at("verdict"), "effect_found");
  EXPECT_EQ(answer.at("effects").at(0).at("id"), "multipass");
  const nlohmann::json& overall = answer.at("error").at("overall");
  EXPECT_LT(overall.at("after").get<double>(), overall.at("before").get<double>());
}

TEST(LoopCommand, RefusesALimitThatIsNone) {
  const Outcome outcome = soilbin("loop made-lesson --limit lod=1..2");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("did you mean 'load'"));
}

}  // namespace
}  // namespace soilbin::cli::test
