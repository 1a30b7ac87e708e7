// What the loop's answer says in words, table and JSON, from numbers that the test put in.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "compare/loop_fixture.hpp"
#include "compare/telling/loop_report.hpp"

namespace soilbin::compare {
namespace {

/// Held out, sinkage falls by two thirds, the pull rises by 6 %, the torque stays within its third digit.
CrossValidation mixed() {
  CrossValidation validation;
  validation.channels[drawbar_pull] = {.cells = 90, .before = 5.95, .after = 6.30, .noise_floor = 5.0};
  validation.channels[torque] = {.cells = 90, .before = 2.000, .after = 2.001, .noise_floor = 1.9};
  validation.channels[sinkage] = {.cells = 90, .before = 0.0206, .after = 0.00704, .noise_floor = 0.0034};
  validation.overall = {.cells = 270, .before = 6.0, .after = 2.6};
  validation.gain = 29.4, validation.gain_error = 6.2;
  return validation;
}

TEST(HeldOutWords, TellGainAndLossInTheSameBreath) {
  EXPECT_EQ(held_out_words(mixed()),
            "cross-validated error falls by 29 +- 6.2 noise variances a value; predicted better: sinkage (20.6 to 7.04 "
            "mm); predicted worse: drawbar pull (5.95 to 6.30 N)");
}

/// Runs that differ in one condition alone, two of each setpoint.
Observations runs_at(const char* condition, const std::vector<std::pair<double, double>>& setpoints) {
  Campaign campaign;
  for (std::size_t s = 0; s < setpoints.size(); ++s)
    for (const double value : {setpoints[s].first, setpoints[s].second}) {
      Run run;
      condition_view(condition).set(run.at, value);
      run.setpoint = std::to_string(s);
      campaign.runs.push_back(run);
    }
  return observe(campaign);
}

// Measured speeds scatter about 10 mm/s by some 0.01 mm/s: that is what the rig was set to, all over.
TEST(RigSetting, IsWhatTheNearestRunsWereSetTo) {
  const Observations runs = runs_at("speed", {{0.009985, 0.009995}, {0.010003, 0.009993}, {0.01001, 0.01}});
  const ConditionView& speed = condition_view("speed");
  EXPECT_DOUBLE_EQ(rig_setting(speed, 0.009985, runs, {0.009985, 0.01001}, 1000), 0.01);
  EXPECT_DOUBLE_EQ(rig_setting(speed, 0.0100049, runs, {0.009985, 0.01001}, 1), 0.01);
}

// Re-runs scatter by 1 N (two of a setpoint differ by sqrt 2): 36.5 N is 36 N, but never more than the rig can.
TEST(RigSetting, AwayFromRunsIsRoundWithinTheirScatterAndTheLimits) {
  const Observations runs = runs_at("load", {{15.0, 16.414}, {20.0, 21.414}, {25.0, 26.414}});
  const ConditionView& load = condition_view("load");
  EXPECT_DOUBLE_EQ(rig_setting(load, 36.54, runs, {10, 36.54}, 1), 36);
  EXPECT_DOUBLE_EQ(rig_setting(load, 33.3, runs, {10, 33.3}, 1), 33);
  EXPECT_DOUBLE_EQ(rig_setting(load, 9.6, runs, {9.6, 40}, 1), 10);
  EXPECT_DOUBLE_EQ(rig_setting(load, 26.414, runs, {25.6, 26.414}, 1), 26);  // a limit that is the largest value run
}

TEST(RigSetting, OfWhatWasSetToTheDigitIsThatDigit) {
  const Observations runs = runs_at("yaw", {{0, 0}, {7.35 * degree, 7.35 * degree}, {20 * degree, 20 * degree}});
  const ConditionView& yaw = condition_view("yaw");
  const std::pair<double, double> all = {0.0, 20 * degree};
  EXPECT_NEAR(rig_setting(yaw, 7.35 * degree, runs, all, yaw.per_si) / degree, 7.35, 1e-9);
  EXPECT_NEAR(rig_setting(yaw, 3.33 * degree, runs, all, yaw.per_si) / degree, 3.5, 1e-9);  // 1 % of what was run
}

// Where a quantity spans decades, 1 % of what was run is more than its small values: they stay what they are.
TEST(RigSetting, OfASmallValueAmongLargeOnesIsNotZero) {
  const Observations runs = runs_at("speed", {{0.02, 0.02}, {0.2, 0.2}, {3.0, 3.0}});
  const ConditionView& speed = condition_view("speed");
  const std::pair<double, double> anywhere = {-1e9, 1e9};
  EXPECT_DOUBLE_EQ(rig_setting(speed, 0.02, runs, anywhere, 1), 0.02);
  EXPECT_DOUBLE_EQ(rig_setting(speed, 0.0215, runs, {0.0213, 0.1}, 1), 0.0215);
  EXPECT_DOUBLE_EQ(rig_setting(speed, 0.207764, runs, anywhere, 1), 0.21);
}

// The mean of three equal numbers may differ from them in the last digit: they were set exactly all the same.
TEST(RigSetting, TakesRoundingForNoScatter) {
  Campaign campaign;
  for (const double value : {0.02, 0.2, 3.0})
    for (int again = 0; again < 3; ++again) {
      compare::Run run;
      run.at.speed = value;
      run.setpoint = std::to_string(value);
      campaign.runs.push_back(run);
    }
  const std::pair<double, double> anywhere = {-1e9, 1e9};
  EXPECT_DOUBLE_EQ(rig_setting(condition_view("speed"), 0.2, observe(campaign), anywhere, 1), 0.2);
}

TEST(HeldOutWords, SayThatAllInAllTheErrorRises) {
  CrossValidation validation = mixed();
  validation.gain = -0.2;
  EXPECT_EQ(held_out_words(validation).find("cross-validated error rises by 0.2 +- 6.2 noise variances a value"), 0u);
}

AcceptedEffect bulldozing() {
  AcceptedEffect effect;
  effect.choice.id = "bulldozing";
  return effect;
}

// A channel is worse only for a model that takes effects; without any there is nothing that it could be worse for.
TEST(WorseChannels, AreThoseOfAModelWithEffects) {
  LoopAnswer answer;
  answer.validation = mixed();
  EXPECT_TRUE(worse_channels(answer).empty());
  EXPECT_EQ(to_json(answer).at("worse").size(), 0u);
  answer.outcome = UnknownEffect{{}, {bulldozing()}, {}, {}, {}};
  EXPECT_EQ(worse_channels(answer), std::vector<int>{drawbar_pull});
  EXPECT_EQ(to_json(answer).at("worse"), nlohmann::ordered_json({"drawbar_pull"}));
}

// What takes a column for mistaken comes before the verdict, which may be of that column.
TEST(Headline, OpensWithAColumnThatLooksMistaken) {
  LoopAnswer answer;
  EXPECT_EQ(headline(answer, {}).front().about, "What is missing");
  const auto parts = headline(answer, {"runs.csv:1:5: column 'load_N' looks as if it were in kg: ..."});
  EXPECT_EQ(parts.front().about, "Check first");
  EXPECT_NE(parts.front().text.find("column 'load_N' looks as if it were in kg"), std::string::npos);
  EXPECT_EQ(parts[1].about, "What is missing");
}

// The noise is what no smooth function of the conditions explains: more than re-runs scatter, where setpoints differ.
TEST(Notes, SayWhereTheNoiseIsMoreThanReRunsScatter) {
  LoopAnswer answer;
  ChannelNoise& pull = answer.noise.channels[drawbar_pull];
  pull.measured = true, pull.floor = 5.86, pull.rerun_sd = 0.71;
  const std::vector<std::string> said = notes(answer);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_NE(said[0].find("for the drawbar pull (5.86 beside 0.710 N)"), std::string::npos) << said[0];
  pull.rerun_sd = 4.0;
  EXPECT_TRUE(notes(answer).empty());
}

TEST(Noise, IsAnExplanationUnlessItIsUnlikely) {
  const auto of = [](double p) { return ResidualSignatures{{}, p, 4000}; };
  EXPECT_EQ(noise_verdict(of(0.0123)), "not explained by noise (p = 0.012)");
  EXPECT_EQ(noise_verdict(of(0.3)), "explained by noise (p = 0.3)");
  EXPECT_EQ(noise_verdict(of(1.0 / 4001)), "not explained by noise (p < 0.00025)");
}

// A parameter stands in its own unit, with its meaning, and says where the data did not determine it.
TEST(ParametersTable, ShowsUnitsMeaningAndBounds) {
  LoopAnswer answer;
  AcceptedEffect layer;
  layer.choice = {"hard_layer", "transition", {{"a", 50.0}, {"d", 0.0411}}};
  layer.fitted = {"a", "d"};
  layer.ci95 = {{0.0, 50.0}, {0.0373, 0.045}};
  layer.at_bound = {true, false};
  answer.outcome = UnknownEffect{{}, {layer}, {}, {}, {}};
  const Table table = parameters_table(answer);
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[0][0].text, "hard layer");
  EXPECT_EQ(table.rows[0][5].tone, Tone::bad);
  EXPECT_EQ(table.rows[1][1].text, "depth at which the firm layer begins");
  EXPECT_EQ(table.rows[1][2].text, "41.10 mm");
  EXPECT_EQ(table.rows[1][3].text, "37.30 to 45.00 mm");
  EXPECT_EQ(table.rows[1][4].text, "1 to 1000 mm");
  EXPECT_EQ(table.rows[1][5].text, "yes");
}

/// A pull about halfway through the runs, which the base model of two_sets misses.
std::ptrdiff_t missed_cell(const Observations& runs) {
  const auto pull = std::find_if(runs.cells.begin() + std::ssize(runs.cells) / 2, runs.cells.end(),
                                 [](const Cell& cell) { return cell.channel == drawbar_pull; });
  return pull - runs.cells.begin();
}

/// Two sets of effects, as if fitted to sand: bulldozing with slip sinkage, and slip sinkage by itself.
LoopAnswer two_sets() {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {}, fine_noise, 3);
  const auto data = std::make_shared<const Dataset>(Dataset{
      std::make_shared<const Campaign>(campaign), observe(campaign), {}, {}, Whitening({}, {}, Eigen::VectorXd())});
  const WheelPredictor predictor(*data->campaign, data->observations);
  const auto term = [&](const char* id, const char* form) {
    return make_term(bekker_wong::find_form({id, form, {}}), data->observations, true);
  };
  LoopAnswer answer;
  Fit fit;
  fit.residual = Eigen::VectorXd::Zero(data->cells());
  const CandidateModel both{
      .ids = {"bulldozing", "slip_sinkage"},
      .model = FittedModel(data, predictor.with({term("slip_sinkage", "lyasko"), term("bulldozing", "")}), fit)};
  const CandidateModel one{.ids = {"slip_sinkage"},
                           .model = FittedModel(data, predictor.with({term("slip_sinkage", "lyasko")}), fit)};
  fit.residual[missed_cell(data->observations)] = 4;
  Attribution found{FittedModel(data, predictor, fit), {}, {}, {}, {}};
  found.candidates.models = {both, one};
  found.candidates.sets = {{.ids = both.ids, .weight = 1.0}, {.ids = one.ids, .best_candidate = 1}};
  answer.judged = Judgement{.found = found, .before = {}, .choice = {}, .reason = {}};
  return answer;
}

// The first sentences name gain, loss and what hardly changes; the table marks them.
TEST(ErrorSentence, TellsGainLossAndWhatHardlyChanges) {
  LoopAnswer answer = two_sets();
  std::get<Judgement>(answer.judged).found.candidates.best = 1;
  answer.validation = mixed();
  answer.outcome = EffectFound{{}, {bulldozing()}};
  const auto parts = headline(answer, {});
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[1].about, "Error with the effect");
  EXPECT_EQ(parts[1].text.find("The cross-validated RMS error rises for the "
                               "drawbar pull (5.95 to 6.30 N; noise 5.00 N), falls for the sinkage (20.6 to 7.04 mm; "
                               "noise 3.40 mm) and changes little for the torque (2.00 to 2.00 N m; noise 1.90 N m)."),
            0u)
      << parts[1].text;
  const Table table = error_table(answer);
  EXPECT_EQ(table.rows.at(0).at(3).tone, Tone::bad);
  EXPECT_EQ(table.rows.at(1).at(3).tone, Tone::none);
  EXPECT_EQ(table.rows.at(2).at(3).tone, Tone::good);
  EXPECT_EQ(table.rows.at(2).at(4).text, "-66 %");
}

// Every reason in words, with its numbers.
TEST(ReasonWords, SayEachReason) {
  Judgement judged = std::get<Judgement>(two_sets().judged);
  judged.found.signatures.p_value = 0.0123, judged.found.signatures.simulations = 4000;
  judged.found.candidates.best = 1;
  const UnnamedEvidence misread{std::log(132.0), Unnamed::misread_condition};
  const std::pair<Reason, const char*> all[] = {
      {NoiseUnknown{2.5}, "the noise of a channel has only 2.5 degrees of freedom, too few to judge by"},
      {NothingVisible{}, "no known effect would be visible in these data, whatever its size"},
      {NoneStandsOut{}, "the strongest of all known effects reaches p = 0.0123"},
      {NoGain{{.mean = 0.1, .std_error = 0.2}},
       "the best effect fits (p = 0.012) but does not improve cross-validated predictions (gain in ln density a "
       "condition 0.1 +- 0.2)"},
      {Refuted{.without = 2.0, .with = 2.5},
       "the best effect fits (p = 0.012), but with the effects that are found without them conditions left out are "
       "predicted worse: 2.5 standard deviations of the noise, root mean square, in place of 2"},
      {StandsOut{}, "p = 0.012 among the whole catalogue"},
      {NoneAccepted{misread},
       "no known effect is accepted (not explained by noise (p = 0.012)), but a function of the conditions unlike any "
       "of them explains the residual 130 times better than noise: most like a slip or load that is not the one "
       "written"},
      {NoneAccepted{LackOfFit{.p_value = 0.001}},
       "no known effect is accepted (not explained by noise (p = 0.012)), but the residual is more than noise (p = "
       "0.001)"},
      {NoneAccepted{RerunTest{.p_value = 0.001}},
       "no known effect is accepted (not explained by noise (p = 0.012)), but setpoints deviate more than their "
       "re-runs scatter (p = 0.001)"},
      {NoneAccepted{SerialTest{.p_value = 0.001, .channel = torque}},
       "no known effect is accepted (not explained by noise (p = 0.012)), but the residuals of the torque are "
       "correlated between successive runs (p = 0.001)"},
      {MoreThanNamed{UnexplainedShare{0.42}},
       "the residual is real (not explained by noise (p = 0.012)), but the best set of known effects leaves 42 % of "
       "it"},
      {MoreThanNamed{misread},
       "the residual is real (not explained by noise (p = 0.012)), and after the best set of known effects a function "
       "of the conditions unlike any of them explains the rest 130 times better than noise: most like a slip or load "
       "that is not the one written"},
      {MoreThanNamed{RerunTest{.p_value = 0.001}},
       "the residual is real (not explained by noise (p = 0.012)), and after the best set of known effects setpoints "
       "still deviate more than their re-runs scatter (p = 0.001)"},
      {BaseModelWrong{},
       "the base model errs by a smooth function of load and slip, not explained by noise (p = 0.012); of the known "
       "effects slip sinkage comes nearest"}};
  for (const auto& [reason, words] : all) {
    judged.reason = reason;
    EXPECT_EQ(reason_words(judged), words);
  }
  EXPECT_EQ(reason_words(TooFewValues{12, 4, 8}), "12 measured values of 4 conditions are too few for 8 soil values");
}

// A reason is of one verdict, and proxies are used where conditions left out do not refuse them.
TEST(Judgement, UsesACandidateThatStandsUnlessTheReasonSaysNo) {
  Judgement judged = std::get<Judgement>(two_sets().judged);
  judged.reason = StandsOut{};
  EXPECT_EQ(judged.verdict(), Verdict::effect_found);
  EXPECT_FALSE(judged.may_use_candidate()) << "there is none";
  judged.choice.emplace().stands = true;
  EXPECT_TRUE(judged.may_use_candidate());
  judged.reason = MoreThanNamed{};
  EXPECT_EQ(judged.verdict(), Verdict::unknown_effect);
  EXPECT_TRUE(judged.may_use_candidate());
  for (const Reason& refused : {Reason(NoneAccepted{}), Reason(Refuted{}), Reason(NoneStandsOut{})}) {
    judged.reason = refused;
    EXPECT_FALSE(judged.may_use_candidate());
  }
  judged.choice->stands = false, judged.reason = MoreThanNamed{};
  EXPECT_FALSE(judged.may_use_candidate());
}

// A set's forms stand in the order of its ids, whichever was fitted first.
TEST(CandidatesTable, NamesFormsInTheOrderOfTheEffects) {
  const LoopAnswer answer = two_sets();
  const CandidateModel& candidate = answer.found().candidates.models.front();
  const std::vector<TableCell> row = candidates_table(answer).rows.front();
  EXPECT_EQ(row[0].text, "bulldozing and slip sinkage");
  EXPECT_EQ(row[0].note, "bulldozing + slip_sinkage");
  EXPECT_EQ(row[1].text, candidate.terms()[1].form->form + " + lyasko");
  const auto forms = details_json(answer).at("sets").at(0).at("forms");
  EXPECT_EQ(forms.at(0), "bulldozing/" + candidate.terms()[1].form->form);
  EXPECT_EQ(forms.at(1), "slip_sinkage/lyasko");
}

TEST(SoilTable, SaysWhatAValueMeansAndWhetherItIsAtItsBound) {
  LoopAnswer answer;
  WithCandidates with;
  with.soil_shifts = {{"stress_angle_c2", {-0.5, 0.1}, {0.2, 0.1}, 0.2, true},
                      {"exponent", {0.9, 0.1}, {1.0, 0.1}, 0.3},
                      {"cohesion", {1000, 290}, {1010, 295}, 300}};  // the runs tell next to nothing of it
  answer.outcome = EffectFound{std::move(with), {}};
  const Table table = soil_table(answer);
  EXPECT_EQ(table.rows[0].front().note, "c2 of theta_m = (c1 + c2 |s|) theta_1");
  EXPECT_EQ(table.rows[0].back().text, "no: at its bound");
  EXPECT_EQ(table.rows[1].back().text, "yes");
  EXPECT_EQ(table.rows[2].back().text, "no: as declared");
}

/// As if something without a name depended on the slip.
LoopAnswer unknown_by_slip() {
  LoopAnswer answer = two_sets();
  answer.outcome = UnknownEffect{};
  answer.dependences_before = {
      {.channel = drawbar_pull, .variable = "slip", .share = 0.6, .p_value = 0.001, .false_discovery_rate = 0.01}};
  return answer;
}

// What shows the form of an effect without a name: the condition it depends on, alone, from end to end.
TEST(NextRunTable, OfAnUnknownEffectVariesWhatItDependsOnAlone) {
  const LoopAnswer answer = unknown_by_slip();
  const std::vector<OperatingCondition> series = shape_series(answer);
  const auto [lowest, highest] = ranges_of(answer.found().base.data().observations).at("slip");
  ASSERT_EQ(series.size(), 5u);
  EXPECT_DOUBLE_EQ(series.front().slip, lowest);
  EXPECT_DOUBLE_EQ(series.back().slip, highest);
  const Observations& runs = answer.found().base.data().observations;
  const OperatingCondition& missed = runs.rows[runs.cells[missed_cell(runs)].row];
  for (const OperatingCondition& at : series) EXPECT_EQ(at.load, missed.load) << "as in the run that is missed most";
  const Table table = next_run_table(answer);
  EXPECT_NE(table.caption.find("the slip alone varies"), std::string::npos) << table.caption;
  ASSERT_EQ(table.rows.size(), 5u);
  EXPECT_EQ(table.rows.front().back().text, "2");
}

// A condition whose limit is given is not asked for again.
TEST(NextRun, AsksForNoLimitThatIsGiven) {
  NextRun next;
  next.given = {{"load", {0.0, 1.0}}}, next.beyond = {"load", "slip"};
  EXPECT_EQ(beyond_what_is_known(next), std::vector<std::string>{"slip"});
}

// Candidates of which none explains the data need no run between them where they are far apart already.
TEST(NextRun, BetweenNamedSetsIsNotProposedWhereTheyAreFarApart) {
  LoopAnswer answer = unknown_by_slip();
  answer.dependences_before.clear();
  WithCandidates with;
  with.next.emplace().separates = {{"bulldozing", "slip_sinkage"}, {"slip_sinkage"}};
  with.ambiguity_set = answer.found().candidates.sets;
  for (const double behind : {2.0, 12.0}) {
    with.ambiguity_set[1].log_evidence = -behind;
    answer.outcome = UnknownEffect{with, {}, {}, {}, {}};
    EXPECT_EQ(proposes_next(answer), behind < 4.6) << behind;
  }
  answer.outcome = EffectFound{with, {}};
  EXPECT_TRUE(proposes_next(answer));
}

}  // namespace
}  // namespace soilbin::compare
