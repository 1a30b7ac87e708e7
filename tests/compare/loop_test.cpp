// The loop as a whole, on campaigns whose missing effect the test put in.
#include "compare/loop/loop.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "bekker_wong/effect_vocabulary.hpp"
#include "bekker_wong/rolling_wheel.hpp"
#include "compare/fit/bounded_fit.hpp"
#include "compare/loop_fixture.hpp"
#include "compare/telling/loop_report.hpp"
#include "scenario/soil_parameters.hpp"

namespace soilbin::compare {
namespace {

LoopOptions quick() {
  LoopOptions options;
  options.attribution.simulations = 1000;
  options.folds = 3;
  return options;
}

bool in_ambiguity_set(const LoopAnswer& answer, const std::set<std::string>& ids) {
  for (const WeightedSet& w : answer.ambiguity_set())
    if (w.ids == ids) return true;
  return false;
}

TEST(Loop, FindsNothingWhereNothingIsMissing) {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {}, fine_noise, 21);
  const LoopAnswer answer = run_loop(campaign, quick());
  EXPECT_EQ(answer.verdict(), Verdict::nothing_missing) << reason_words(answer);
  EXPECT_TRUE(answer.effects().empty());
  EXPECT_NEAR(answer.validation.overall.before, 1.0, 0.25);
}

/// How much deeper the effect lets the declared wheel sink at 70 % slip [m].
double dug(const Campaign& campaign, const EffectChoice& choice) {
  OperatingCondition at;
  at.load = 1000, at.slip = 0.7, at.speed = 0.3;
  const auto sinkage = [&](const std::vector<EffectChoice>& effects) {
    return bekker_wong::RollingWheel(campaign.wheel, bekker_wong::values_of(campaign.soil),
                                     bekker_wong::make_effects(effects), campaign.bin)
        .roll(at)
        .reading.sinkage;
  };
  return sinkage({choice}) - sinkage({});
}

// Slip sinkage: found, in whichever form it digs as deep as nature does, in nature's own form its amplitude is nature's
// within three standard errors, and the held-out error falls to the noise.
TEST(SlowLoop, NamesSlipSinkageAndItsSize) {
  const EffectChoice truth = {"slip_sinkage", "lyasko", {{"a", 0.5}}};
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {truth}, fine_noise, 22);
  const LoopAnswer answer = run_loop(campaign, quick());
  ASSERT_EQ(answer.verdict(), Verdict::effect_found) << reason_words(answer);
  EXPECT_EQ(answer.ambiguity_set().front().ids, (std::set<std::string>{"slip_sinkage"}));
  EXPECT_GT(answer.validation.overall.before, 1.3 * answer.validation.overall.after);
  EXPECT_LT(answer.validation.overall.after, 1.3);
  ASSERT_EQ(answer.effects().size(), 1u);
  EXPECT_NEAR(dug(campaign, answer.effects().front().choice), dug(campaign, truth), 0.1 * dug(campaign, truth));
  const auto& candidates = answer.found().candidates.models;
  const auto own = std::find_if(candidates.begin(), candidates.end(), [](const CandidateModel& candidate) {
    return candidate.terms().size() == 1 && candidate.terms().front().form->id == "slip_sinkage" &&
           candidate.terms().front().form->form == "lyasko";
  });
  ASSERT_NE(own, candidates.end());
  const Eigen::Index amplitude = own->model.predictor().amplitude_index(0);
  const double error = own->model.standard_errors()[amplitude];
  EXPECT_NEAR(own->fit().theta[amplitude], 0.5, 3 * error);
  EXPECT_LT(error, 0.1);
}

// Errors are told in the noise beside the effect: what was put in, to the precision that 40 freedoms give (11 %; 3 sd
// allowed), however badly smooth functions beside the base model follow a large effect.
TEST(SlowLoop, TellsErrorsInTheNoiseBesideTheEffect) {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {{"multipass", "stiffer", {{"a", 1.5}}}}, fine_noise, 33);
  const LoopAnswer answer = run_loop(campaign, quick());
  ASSERT_EQ(answer.verdict(), Verdict::effect_found) << reason_words(answer);
  const Eigen::VectorXd& f = answer.found().best().fit().prediction;
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(
        std::log(answer.noise.channels[static_cast<std::size_t>(c)].sd(f[c]) / fine_noise[static_cast<std::size_t>(c)]),
        0.0, 0.35)
        << channel_views[static_cast<std::size_t>(c)].name;
}

TEST(SlowLoop, SetsTheOneNameThatIsLeftAgainstTheNextOne) {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {{"drift", "torque", {{"a", 0.5}}}}, fine_noise, 33);
  const LoopAnswer answer = run_loop(campaign, quick());
  ASSERT_EQ(answer.ambiguity_set().size(), 1u);
  const std::string next = what_next(answer).front();
  if (!answer.next()) {
    EXPECT_NE(next.find("no condition within the limits confirms it"), std::string::npos) << next;
    return;
  }
  EXPECT_FALSE(is_settled(answer.found().candidates));
  EXPECT_NE(answer.next()->separates.back(), answer.next()->separates.front());
  EXPECT_EQ(next.rfind("To confirm, measure", 0), 0u) << next;
}

// Each setpoint's torque off by its own amount, the same in both of its runs: re-runs say that this is no noise.
TEST(SlowLoop, SaysUnknownWhereSetpointsAreOffByMoreThanTheirRerunsDiffer) {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {}, fine_noise, 8);
  for (compare::Run& run : campaign.runs) {
    const int s = std::stoi(run.setpoint->substr(1));
    *run.torque += 4 * fine_noise[1] * ((s * s + s / 3) % 3 - 1.0);
  }
  const LoopAnswer answer = run_loop(campaign, quick());
  EXPECT_EQ(answer.verdict(), Verdict::unknown_effect) << reason_words(answer);
  EXPECT_LT(answer.judgement()->before.reruns.p_value, 1e-4);
}

// A constant torque of the bearings and a torque sensor's offset are one and the same in these data: both are named.
TEST(SlowLoop, SaysWhatCannotBeToldApart) {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {{"rig_friction", "coulomb", {{"a", 12.0}}}}, fine_noise, 23);
  const LoopAnswer answer = run_loop(campaign, quick());
  ASSERT_EQ(answer.verdict(), Verdict::effect_found) << reason_words(answer);
  EXPECT_TRUE(in_ambiguity_set(answer, {"rig_friction"}));
  EXPECT_TRUE(in_ambiguity_set(answer, {"sensor_offset"}));
  ASSERT_EQ(answer.effects().size(), 1u);
  const auto& [alike, cosines] = std::pair(answer.effects()[0].choice.id, answer.effects()[0].cosines);
  EXPECT_GT(cosines.at(alike == "rig_friction" ? "sensor_offset" : "rig_friction"), 0.9999);
  EXPECT_LT(cosines.at("slip_sinkage"), 0.9);
}

// The attack: a truck tire at two pressures, and the cell that tells its load is off by 900 N. No channel is the load
// itself, and what shows in all four was taken for lugs or the exit angle.
TEST(SlowLoop, NamesALoadCellThatIsOff) {
  Campaign campaign;
  campaign.name = "truck";
  campaign.wheel.radius = 0.67, campaign.wheel.width = 0.43;
  campaign.wheel.inflation_pressure = 150e3, campaign.wheel.carcass_pressure = Estimate{20e3, 5e3};
  campaign.soil = {.exponent = {0.7, 0.03},
                   .k_c = {5270, 500},
                   .k_phi = {1515e3, 80e3},
                   .cohesion = {1720, 200},
                   .friction_angle = {29 * degree, 0.5 * degree},
                   .shear_modulus = {0.025, 0.003},
                   .stress_angle_c1 = {0.43, 0.03},
                   .stress_angle_c2 = {0.32, 0.03},
                   .density = 1600};
  const EffectChoice flexible{"tire_flexibility", "flat_section", {}};
  campaign.effects = {flexible};
  std::vector<OperatingCondition> rows;
  for (const double pressure : {100e3, 300e3})
    for (const double load : {6e3, 12e3, 24e3})
      for (const double slip : {0.05, 0.15, 0.3, 0.5})
        for (int twice = 0; twice < 2; ++twice) {
          OperatingCondition at;
          at.load = load, at.slip = slip, at.inflation_pressure = pressure;
          rows.push_back(at);
        }
  measure(campaign, rows, {flexible, {"sensor_offset", "load", {{"a", 900.0}}}}, {60.0, 30.0, 5e-4, 50.0}, 3);
  const LoopAnswer answer = run_loop(campaign, quick());
  ASSERT_EQ(answer.verdict(), Verdict::effect_found) << reason_words(answer);
  EXPECT_TRUE(in_ambiguity_set(answer, {"sensor_offset"}));
}

// A slip told by a rolling radius 6 % too large, or a torque cell that shows 12 % too little, on a wheel without lugs:
// lugs would shift the curves over slip too, and a slide of the tread lower the torque.
TEST(SlowLoop, NamesInstrumentsThatAreOutOfScale) {
  for (const EffectChoice& truth : {EffectChoice{"sensor_offset", "slip", {{"a", 0.06}}},
                                    EffectChoice{"sensor_offset", "torque_gain", {{"a", -0.12}}}}) {
    SCOPED_TRACE(truth.form);
    Campaign campaign = sand_campaign();
    measure(campaign, sweep(), {truth}, fine_noise, 41);
    const LoopAnswer answer = run_loop(campaign, quick());
    ASSERT_EQ(answer.verdict(), Verdict::effect_found) << reason_words(answer);
    EXPECT_TRUE(in_ambiguity_set(answer, {"sensor_offset"}));
    EXPECT_THAT(verdict_sentence(answer), testing::HasSubstr(bekker_wong::find_form(truth).meaning))
        << "which instrument";
    EXPECT_LT(answer.validation.overall.after, 1.3);
  }
}

TEST(SlowLoop, NamesTwoEffects) {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {{"multipass", "stiffer", {{"a", 0.8}}}, {"sensor_offset", "drawbar_pull", {{"a", 40.0}}}},
          fine_noise, 24);
  const LoopAnswer answer = run_loop(campaign, quick());
  ASSERT_EQ(answer.verdict(), Verdict::effect_found) << reason_words(answer);
  bool multipass = false;
  for (const WeightedSet& w : answer.ambiguity_set())
    multipass = multipass || (w.ids.count("multipass") && w.ids.size() == 2);
  EXPECT_TRUE(multipass);
}

// A torque sensor zeroed before the first run creeps from there: half a line about the mean run and half an offset, but
// one effect.
TEST(SlowLoop, CountsADriftFromWhicheverRun) {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {{"drift", "torque", {{"a", 0.5}, {"run_ref", 1.0}}}}, fine_noise, 29);
  const LoopAnswer answer = run_loop(campaign, quick());
  ASSERT_EQ(answer.verdict(), Verdict::effect_found) << reason_words(answer);
  EXPECT_EQ(answer.ambiguity_set().front().ids, (std::set<std::string>{"drift"}));
  ASSERT_EQ(answer.effects().size(), 1u);
  EXPECT_NE(std::find(answer.effects()[0].fitted.begin(), answer.effects()[0].fitted.end(), "run_ref"),
            answer.effects()[0].fitted.end());
}

// Each accepted effect has a p-value of its own beside the other, and the soil's bias is told for each free value.
TEST(SlowLoop, TellsWhatEachEffectRestsOn) {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {{"multipass", "stiffer", {{"a", 0.8}}}, {"sensor_offset", "drawbar_pull", {{"a", 40.0}}}},
          fine_noise, 24);
  const LoopAnswer answer = run_loop(campaign, quick());
  ASSERT_EQ(answer.verdict(), Verdict::effect_found) << reason_words(answer);
  ASSERT_EQ(answer.effects().size(), 2u);
  const AcceptedEffect &one = answer.effects()[0], &other = answer.effects()[1];
  for (const AcceptedEffect& effect : answer.effects()) {
    EXPECT_LT(effect.p_value, 0.05) << effect.choice.id;
    EXPECT_EQ(effect.cosines.count(effect.choice.id), 0u);
  }
  EXPECT_EQ(one.cosines.at(other.choice.id), other.cosines.at(one.choice.id));
  EXPECT_LT(one.cosines.at(other.choice.id), 0.9);  // one changes with the pass, the other doesn't
  EXPECT_EQ(answer.with_candidates().soil_shifts.size(), 8u);
  for (const SoilShift& s : answer.with_candidates().soil_shifts) EXPECT_NE(s.with.value, s.without.value) << s.name;
}

// Progress runs from the start to the end, and what it throws stops the work.
TEST(SlowLoop, CanBeStopped) {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {{"bulldozing", "", {}}}, fine_noise, 29);
  LoopOptions options = quick();
  std::size_t last = 0;
  options.progress = [&](std::size_t done, std::size_t total) {
    EXPECT_GE(done, last);
    EXPECT_LE(done, total);
    last = done;
  };
  run_loop(campaign, options);
  EXPECT_EQ(last, 100u);
  struct Stop {};
  for (const std::size_t at : {5u, 45u}) {
    options.progress = [at](std::size_t done, std::size_t) {
      if (done >= at) throw Stop();
    };
    EXPECT_THROW(run_loop(campaign, options), Stop);
  }
}

LoopAnswer with_swinging_torque(double swings) {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {}, fine_noise, 25);
  for (compare::Run& run : campaign.runs)
    *run.torque += 10.0 * std::sin(2 * 3.141592653589793 * swings * run.at.slip / 0.65);
  return run_loop(campaign, quick());
}

// A torque that swings over the slips belongs to no effect of the catalogue. Half a swing is a hump, which a parabola
// over the slip follows: so what is left is seen to depend on the slip. Three swings are none that it could follow.
TEST(SlowLoop, SaysUnknownWhereTheCatalogueHasNoName) {
  for (const double swings : {0.5, 3.0}) {
    const LoopAnswer answer = with_swinging_torque(swings);
    EXPECT_EQ(answer.verdict(), Verdict::unknown_effect) << reason_words(answer);
    EXPECT_TRUE(answer.effects().empty());
  }
  const std::vector<std::string> said = what_next(with_swinging_torque(0.5));
  ASSERT_GE(said.size(), 2u);
  EXPECT_EQ(said[0], "Measure several settings of the slip alone, each one twice, all else kept.");
  EXPECT_TRUE(said[1].starts_with("The unexplained part of the torque depends most on the slip")) << said[1];
}

// Asked of runs in which nothing is missing, the pull as shown by a cell that reads too little the more it is pulled:
// the largest one as tanh(share)/share of itself.
LoopAnswer loop_with_bent_force_cell(double share, std::uint64_t seed) {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {}, fine_noise, seed);
  double most = 0.0;
  for (const compare::Run& run : campaign.runs) most = std::max(most, std::abs(*run.drawbar_pull));
  const double bent = most / share;
  for (compare::Run& run : campaign.runs) *run.drawbar_pull = bent * std::tanh(*run.drawbar_pull / bent);
  return run_loop(campaign, quick());
}

// Read too little by a third at the most, a scale that is off mimics all but the bend: it may have the name, and
// nothing of the soil may.
TEST(SlowLoop, BlamesNoSoilForAForceCellThatIsBent) {
  for (const std::uint64_t seed : {31, 37}) {
    const LoopAnswer answer = loop_with_bent_force_cell(1.3, seed);
    if (answer.verdict() == Verdict::unknown_effect) continue;
    ASSERT_EQ(answer.verdict(), Verdict::effect_found) << reason_words(answer);
    ASSERT_EQ(answer.effects().size(), 1u);
    EXPECT_EQ(answer.effects().front().choice.form, "drawbar_pull_gain");
    EXPECT_LT(answer.validation.overall.after, 1.3);
  }
}

// Read too little by three fifths at the most, the bend stays.
TEST(SlowLoop, SaysUnknownWhereAnInstrumentIsBent) {
  for (const std::uint64_t seed : {31, 37}) {
    const LoopAnswer answer = loop_with_bent_force_cell(2.5, seed);
    EXPECT_EQ(answer.verdict(), Verdict::unknown_effect) << reason_words(answer);
    EXPECT_TRUE(answer.effects().empty());
  }
}

// Slip sinkage and, beside it, waves that no effect makes: the verdict stays unknown and names nothing, but the saved
// model carries what predicts better than nothing.
TEST(SlowLoop, LetsNamedEffectsStandInForAnUnknownOne) {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {{"slip_sinkage", "lyasko", {{"a", 1.0}}}}, fine_noise, 25);
  for (compare::Run& run : campaign.runs)
    *run.torque += 10.0 * std::sin(2 * 3.141592653589793 * 3.0 * run.at.slip / 0.65);
  const LoopAnswer answer = run_loop(campaign, quick());
  ASSERT_EQ(answer.verdict(), Verdict::unknown_effect) << reason_words(answer);
  EXPECT_TRUE(answer.effects().empty());
  ASSERT_FALSE(answer.proxy_effects().empty());
  EXPECT_EQ(to_json(answer).at("effects").size(), 0u);
  EXPECT_EQ(to_json(answer).at("stand_in").at(0).at("id"), answer.proxy_effects()[0].choice.id);
  const Case saved = resolved_model(campaign, answer);
  EXPECT_EQ(saved.study.models[0].effects.size(), answer.proxy_effects().size());
  EXPECT_NE(saved.description.find("Better predictions, no physical cause."), std::string::npos);
}

// Where no model comes near the noise a set of effects still loses nothing by one more: of nested fits the larger
// leaves no more (the two lugs' wheels of the library end there).
TEST(SlowLoop, ALargerSetOfEffectsLeavesNoMore) {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {{"slip_sinkage", "lyasko", {{"a", 1.2}}}, {"bulldozing", "", {}}}, fine_noise, 31);
  const LoopAnswer answer = run_loop(campaign, quick());
  const auto& candidates = answer.found().candidates.models;
  int nested = 0;
  for (const auto& more : candidates)
    for (const auto& less : candidates) {
      const bool holds = more.terms().size() == less.terms().size() + 1 &&
                         std::equal(less.terms().begin(), less.terms().end(), more.terms().begin(),
                                    [](const auto& a, const auto& b) { return a.form == b.form; });
      if (!holds) continue;
      EXPECT_LE(more.fit().chi2, less.fit().chi2 * (1 + 1e-3) + 0.1);
      ++nested;
    }
  EXPECT_GT(nested, 0);
}

// Effects whose covariate never varies leave no trace: not testable, never absent.
TEST(Loop, ListsWhatTheDataCannotShow) {
  Campaign campaign = sand_campaign();
  std::vector<OperatingCondition> rows = sweep();
  for (OperatingCondition& at : rows) at.pass = 1, at.position.reset();
  measure(campaign, rows, {}, fine_noise, 26);
  const LoopAnswer answer = run_loop(campaign, quick());
  for (const char* id : {"multipass", "moisture", "slope_weakening", "soil_gradient"})
    EXPECT_NE(std::find(answer.not_testable.begin(), answer.not_testable.end(), id), answer.not_testable.end()) << id;
  EXPECT_EQ(std::find(answer.not_testable.begin(), answer.not_testable.end(), "sensor_offset"),
            answer.not_testable.end());
}

TEST(SlowLoop, IsNotMovedByOneOutlier) {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {}, fine_noise, 27);
  *campaign.runs[5].drawbar_pull += 200.0;
  const LoopAnswer answer = run_loop(campaign, quick());
  ASSERT_EQ(answer.outliers(), 1);
  EXPECT_EQ(answer.set_aside.front().channel, drawbar_pull);
  EXPECT_EQ(answer.set_aside.front().measured, *campaign.runs[5].drawbar_pull);
  EXPECT_NEAR(answer.set_aside.front().measured - answer.set_aside.front().predicted, 200, 5 * fine_noise[0]);
  EXPECT_EQ(answer.verdict(), Verdict::nothing_missing) << reason_words(answer);
  EXPECT_TRUE(answer.effects().empty());
  LoopOptions all = quick();
  all.attribution.drop_outliers = false;
  const LoopAnswer kept = run_loop(campaign, all);
  EXPECT_EQ(kept.outliers(), 0);
  EXPECT_FALSE(kept.with_outliers);
  ASSERT_TRUE(answer.with_outliers);
  EXPECT_EQ(answer.with_outliers->verdict, kept.verdict());
  const std::vector<std::string> said = in_sentences(answer);
  EXPECT_TRUE(std::any_of(said.begin(), said.end(), [](const std::string& sentence) {
    return sentence.find("With it kept the verdict") != std::string::npos;
  }));
}

// A soil that is half a standard deviation off, declared ten times as surely: no effect is there.
TEST(SlowLoop, SaysWhereTheFitLeavesTheDeclaredSoilFarBehind) {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {}, fine_noise, 27);
  const auto told = [&] {
    const std::vector<std::string> said = notes(run_loop(campaign, quick()));
    return std::ranges::any_of(said, [](const std::string& sentence) {
      return sentence.starts_with(
          "The fitted soil differs from the declared one by more than three standard deviations: ");
    });
  };
  EXPECT_FALSE(told());
  for (const SoilParameter& p : soil_parameters) (campaign.soil.*p.value).std_error /= 10;
  EXPECT_TRUE(told());
}

// One setpoint, read a little otherwise each time and without a label: nothing can be left out to try a model on.
TEST(Loop, SaysWhenAllRunsMayBeRerunsOfOneSetpoint) {
  Campaign campaign = sand_campaign();
  std::vector<OperatingCondition> rows(14, sweep().front());
  measure(campaign, rows, {}, fine_noise, 27);
  for (std::size_t i = 0; i < campaign.runs.size(); ++i) {
    campaign.runs[i].setpoint.reset();
    campaign.runs[i].at.load += 0.1 * static_cast<double>(i);
  }
  const LoopAnswer answer = run_loop(campaign, quick());
  EXPECT_EQ(answer.verdict(), Verdict::not_enough_data);
  EXPECT_EQ(std::get<TooFewValues>(answer.judged).conditions, 1u);
}

TEST(Loop, SaysWhenThereIsTooLittle) {
  Campaign campaign = sand_campaign();
  measure(campaign, {sweep()[0], sweep()[4], sweep()[8], sweep()[12]}, {}, fine_noise, 28);
  const LoopAnswer answer = run_loop(campaign, quick());
  EXPECT_EQ(answer.verdict(), Verdict::not_enough_data);
}

// Same bits whatever the number of threads.
TEST(SlowLoop, DoesNotDependOnThreads) {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {{"bulldozing", "", {}}}, fine_noise, 29);
  LoopOptions one = quick(), four = quick();
  one.threads = 1;
  four.threads = 4;
  EXPECT_EQ(to_json(run_loop(campaign, one)).dump(), to_json(run_loop(campaign, four)).dump());
}

// The model that the loop writes predicts what the loop's fit predicted.
TEST(SlowLoop, ResolvedModelReproducesTheFit) {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {{"slip_sinkage", "lyasko", {{"a", 0.5}}}}, fine_noise, 30);
  const LoopAnswer answer = run_loop(campaign, quick());
  ASSERT_EQ(answer.verdict(), Verdict::effect_found) << reason_words(answer);
  const bekker_wong::CatalogueVocabulary words;
  const Case model = parse_case({"model.yaml", write_case(resolved_model(campaign, answer), words)}, Library{}, words);
  const Scenario scenario = seen_by(model.study.models.front(), model.scenario);
  const Observations& observations = answer.found().base.data().observations;
  const CandidateModel& best = answer.found().best();
  for (std::size_t i = 0; i < observations.cells.size(); i += 7) {
    const Cell& cell = observations.cells[i];
    if (cell.channel != drawbar_pull) continue;
    const TractionResult r = bekker_wong::BekkerWong({false, false})
                                 .evaluate(scenario, observations.rows[static_cast<std::size_t>(cell.row)]);
    EXPECT_NEAR(r.drawbar_pull.value, best.fit().prediction[static_cast<Eigen::Index>(i)],
                1e-6 * campaign.runs[0].at.load);
  }
}

// Lugs of 5 % of the radius (12.5 mm) on a wheel that declares none: whoever tells the effect tells them.
TEST(SlowLoop, TellsWhatAnEffectPresumesOfTheWheel) {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {{"lug_thrust", "shear_radius", {{"lambda_s", 2.0}}}}, fine_noise, 35);
  const LoopAnswer answer = run_loop(campaign, quick());
  ASSERT_EQ(answer.verdict(), Verdict::effect_found) << reason_words(answer);
  ASSERT_EQ(answer.effects().front().choice.id, "lug_thrust");
  const auto j = to_json(answer);
  for (const auto& told : {j.at("effects").at(0), j.at("ambiguity_set").at(0)}) {
    const auto& presumed = told.at("presumes").at(0);
    EXPECT_EQ(presumed.at("effect"), "lug_thrust");
    EXPECT_EQ(presumed.at("key"), "lugs.height");
    EXPECT_DOUBLE_EQ(presumed.at("value").get<double>(), 0.0125);
  }
  const std::string words = "lug thrust assumes lug height = 12.5 mm (5 % of the radius)";
  const auto tells = [&](const std::string& text) { return text.find(words) != std::string::npos; };
  const std::vector<std::string> said = in_sentences(answer);
  EXPECT_TRUE(std::any_of(said.begin(), said.end(), tells));
  EXPECT_TRUE(tells(resolved_model(campaign, answer).description));
  const std::string page = page_of(report_on(campaign, answer, {}),
                                   {.command = {}, .versions = {}, .doubts = {"rows 3 and 7 repeat each other"}});
  EXPECT_NE(page.find("lug thrust assumes lug height = 12.5 mm (5"), std::string::npos);
  EXPECT_NE(page.find("rows 3 and 7 repeat each other"), std::string::npos);
  campaign.wheel.lugs.height = 0.0125;
  campaign.wheel.lugs.count = 24;
  const LoopAnswer declared = run_loop(campaign, quick());
  EXPECT_EQ(declared.verdict(), answer.verdict());
  EXPECT_FALSE(tells(resolved_model(campaign, declared).description));
}

TEST(Loop, AnswersInTheContractsForm) {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {{"rig_friction", "coulomb", {{"a", 12.0}}}}, fine_noise, 31);
  const auto j = to_json(run_loop(campaign, quick()));
  EXPECT_EQ(j.at("format"), "soilbin-loop/1");
  EXPECT_EQ(j.at("verdict"), "effect_found");
  for (const char* key : {"id", "form", "parameters", "ci95", "p_value"})
    EXPECT_TRUE(j.at("effects").at(0).contains(key));
  for (const char* key : {"unit", "before", "after", "noise_floor", "kind"})
    EXPECT_TRUE(j.at("error").at("torque").contains(key)) << key;
  EXPECT_EQ(j.at("error").at("overall").at("unit"), "sigma");
  EXPECT_EQ(j.at("error").at("overall").at("kind"), "held_out");
  EXPECT_TRUE(j.at("error").at("lateral_force").empty());
  for (const char* key : {"next_test", "worse"}) EXPECT_TRUE(j.contains(key)) << key;
}

}  // namespace
}  // namespace soilbin::compare
