// Candidates decided by the soil bin, where nature is the soil bin itself with a tire contact that is known.
#include "compare/experiments/soil_bin_trials.hpp"

#include <gmock/gmock.h>

#include "bekker_wong/effect_vocabulary.hpp"
#include "tests/dem/archive_scene.hpp"
#include "tests/dem/small_bed.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin::compare {
namespace {

using dem::test::Folder;
using testing::HasSubstr;

constexpr double truth = 0.4;  // sliding friction of tire and sand

dem::DemSettings small_bin() {
  dem::DemSettings bin;
  bin.size = {0.4, 0.13, 0.06};
  bin.rig.behind = 0.11, bin.rig.ahead = 0.11;
  bin.rig.lowering = 0.1, bin.rig.resting = 0.02, bin.rig.starting = 0.05;
  bin.how = dem::test::with_threads(1);
  return bin;
}

/// Grains that don't roll on the tire, so that its sliding friction counts.
Soil trial_sand() {
  Soil soil;
  soil.name = "soft", soil.granular = dem::test::soft_soil();
  soil.granular->grain_tire.rolling_friction = 1;
  return soil;
}

TrialQuestion unanswered() {
  TrialQuestion question;
  question.soil = trial_sand();
  question.factors = {{"sliding_friction", 0, 1, "-"}};
  question.campaign.name = "nature";
  question.campaign.wheel = dem::test::small_wheel();
  question.campaign.runs.resize(1);
  question.campaign.runs[0].at.load = 30, question.campaign.runs[0].at.slip = 0.3,
  question.campaign.runs[0].at.speed = 0.4;
  question.campaign.runs[0].drawbar_pull = 0;
  question.setpoints = setpoints_of(question.campaign);
  return question;
}

Eigen::VectorXd friction(double value) { return Eigen::VectorXd::Constant(1, value); }

/// What was measured in a bin whose tire has the true contact, on beds that no candidate gets.
TrialQuestion asked_of_nature() {
  TrialQuestion question = unanswered();
  const Case nature = trial_case(question, friction(truth));
  SoilBinRuns runs(small_bin(), {});
  const OperatingCondition at = question.setpoints[0].at;
  question.campaign.runs.clear();
  for (const std::uint64_t packing : {11U, 12U}) {
    const TractionResult result = runs(nature.scenario, {at, packing}).answer.result.value();
    Run& run = question.campaign.runs.emplace_back();
    run.at = at, run.setpoint = "A";
    run.drawbar_pull = result.drawbar_pull.value, run.torque = result.torque.value;
  }
  question.setpoints = setpoints_of(question.campaign);
  return question;
}

const TrialQuestion& trial_question() {
  static const TrialQuestion asked = asked_of_nature();
  return asked;
}

/// The likeliest by the board is wrong; the next two differ by less than the bin tells.
std::vector<Candidate> candidates() {
  std::vector<Candidate> all;
  for (const double value : {0.1, truth + 0.005, truth}) all.push_back({.values = friction(value), .predicted = {}});
  return all;
}

TrialSettings kept_in_folder(const Folder& folder) {
  TrialSettings settings;
  settings.bin = small_bin();
  settings.bin.beds = folder / "beds";
  settings.records = folder / "runs";
  settings.version = "0", settings.source = "test";
  return settings;
}

Decision decided(const TrialSettings& settings) {
  return decide_in_soil_bin(trial_question(), settings, candidates(), bekker_wong::CatalogueVocabulary{});
}

/// In one go.
const Decision& whole() {
  static const Decision decision = decided(kept_in_folder(Folder()));
  return decision;
}

std::string says_of(const TrialQuestion& wrong, const TrialSettings& settings) {
  return soilbin::test::error_of([&] { check(wrong, settings); });
}

TEST(SlowSoilBinTrials, TheContactOfNatureIsFoundAgainAndATieIsSaid) {
  const Decision& decision = whole();
  EXPECT_TRUE(decision.trials[0].apart);   // a tire of a quarter of the friction
  EXPECT_FALSE(decision.trials[1].apart);  // one and the same, as far as these runs can tell
  EXPECT_FALSE(decision.trials[2].apart);
  EXPECT_EQ(decision.chosen, 1U);  // of these the likelier
  EXPECT_EQ(decision.runs, 3);
}

TEST(SlowSoilBinTrials, StoppedAndGoneOnWithTheDecisionIsTheSame) {
  const Folder folder;
  struct Stopped {};
  TrialSettings settings = kept_in_folder(folder);
  settings.watch = [](const dem::Progress& progress) {
    if (progress.done > 0.5) throw Stopped();  // two of three
  };
  EXPECT_THROW(decided(settings), Stopped);
  int made = 0;
  settings.watch = {}, settings.bin.how.progress = [&](const dem::Progress& p) { made += p.done >= 1; };
  const Decision gone_on = decided(settings);
  EXPECT_EQ(made, 1);  // of three runs; the bed is there
  EXPECT_EQ(gone_on.chosen, whole().chosen);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(gone_on.trials[k].error->value, whole().trials[k].error->value);
}

TEST(SoilBinTrials, WhatNoRunCouldAnswerIsRefusedAtOnce) {
  const Folder folder;
  const TrialSettings settings = kept_in_folder(folder);
  EXPECT_EQ(says_of(unanswered(), settings), "");
  TrialQuestion wrong = unanswered();
  wrong.soil.granular.reset();
  EXPECT_THAT(says_of(wrong, settings), HasSubstr("need its section 'granular'"));
  wrong = unanswered(), wrong.setpoints.clear();
  EXPECT_THAT(says_of(wrong, settings), HasSubstr("nature has no setpoint to run"));
  wrong = unanswered(), wrong.campaign.wheel.lugs.height = 0.01;
  EXPECT_THAT(says_of(wrong, settings), HasSubstr("nature: its wheel: "));
  wrong = unanswered(), wrong.setpoints[0].at.slip = 1;
  EXPECT_THAT(says_of(wrong, settings), HasSubstr("slip from -1 to below 1"));
  wrong = unanswered(), wrong.campaign.bin = Bin{.depth = 0.06, .width = 0.1};
  EXPECT_THAT(says_of(wrong, settings), HasSubstr("too narrow"));
}

}  // namespace
}  // namespace soilbin::compare
