// What the loop's answer says in words, table and JSON, from numbers that the test put in.
#include <gtest/gtest.h>

#include "compare/loop/answer_words.hpp"
#include "compare/loop_fixture.hpp"

namespace soilbin::compare {
namespace {

/// Held out, sinkage falls by two thirds, the pull rises by 6 %, the torque stays within its third digit.
CrossValidation mixed() {
  CrossValidation validation;
  validation.channels[drawbar_pull] = {.cells = 90, .before = 5.95, .after = 6.30};
  validation.channels[torque] = {.cells = 90, .before = 2.000, .after = 2.001};
  validation.channels[sinkage] = {.cells = 90, .before = 0.0206, .after = 0.00704};
  validation.overall = {.cells = 270, .before = 6.0, .after = 2.6};
  validation.gain = 29.4, validation.gain_error = 6.2;
  return validation;
}

TEST(HeldOutWords, TellGainAndLossInTheSameBreath) {
  EXPECT_EQ(held_out_words(mixed()),
            "held-out error falls by 29 +- 6.2 sigma^2 a value; predicted better: sinkage (20.6 to 7.04 mm); predicted "
            "worse: drawbar pull (5.95 to 6.3 N)");
}

TEST(HeldOutWords, SayThatAllInAllTheErrorRises) {
  CrossValidation validation = mixed();
  validation.gain = -0.2;
  EXPECT_EQ(held_out_words(validation).find("held-out error rises by 0.2 +- 6.2 sigma^2 a value"), 0u);
}

// A channel is worse only for a model that takes effects; without any there is nothing that it could be worse for.
TEST(WorseChannels, AreThoseOfAModelWithEffects) {
  LoopAnswer answer;
  answer.validation = mixed();
  EXPECT_TRUE(worse_channels(answer).empty());
  EXPECT_EQ(to_json(answer).at("worse").size(), 0u);
  answer.stand_in.emplace_back();
  answer.stand_in.back().choice.id = "bulldozing";
  EXPECT_EQ(worse_channels(answer), std::vector<int>{drawbar_pull});
  EXPECT_EQ(to_json(answer).at("worse"), nlohmann::ordered_json({"drawbar_pull"}));
}

// A set's forms stand in the order of its ids, whichever was fitted first.
TEST(CandidatesTable, NamesFormsInTheOrderOfTheEffects) {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {}, fine_noise, 3);
  const auto data = std::make_shared<const Dataset>(Dataset{
      std::make_shared<const Campaign>(campaign), observe(campaign), {}, {}, Whitening({}, {}, Eigen::VectorXd())});
  const WheelPredictor predictor(*data->campaign, data->observations);
  const auto term = [&](const char* id, const char* form) {
    return make_term(bekker_wong::find_form({id, form, {}}), data->observations, true);
  };
  LoopAnswer answer;
  const CandidateModel candidate{
      .ids = {"bulldozing", "slip_sinkage"},
      .model = FittedModel(data, predictor.with({term("slip_sinkage", "lyasko"), term("bulldozing", "")}), Fit())};
  Attribution found{FittedModel(data, predictor, Fit()), {}, 0.0, {}};
  found.candidates.models = {candidate};
  found.candidates.sets = {{.ids = candidate.ids, .weight = 1.0}};
  answer.judgement = Judgement{.found = found, .before = {}, .choice = {}, .reason = {}};
  const std::vector<std::string> row = candidates_table(answer).rows.front();
  EXPECT_EQ(row[0], "bulldozing + slip_sinkage");
  EXPECT_EQ(row[1], candidate.terms()[1].form->form + " + lyasko");
  const auto forms = details_json(answer).at("sets").at(0).at("forms");
  EXPECT_EQ(forms.at(0), "bulldozing/" + candidate.terms()[1].form->form);
  EXPECT_EQ(forms.at(1), "slip_sinkage/lyasko");
}

}  // namespace
}  // namespace soilbin::compare
