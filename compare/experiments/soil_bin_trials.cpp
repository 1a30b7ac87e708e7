#include "compare/experiments/soil_bin_trials.hpp"

#include <fmt/core.h>

#include <memory>

#include "compare/experiments/soil_bin_runs.hpp"
#include "compare/sweep/varying.hpp"
#include "dem/rig/wheel_in_bin.hpp"
#include "scenario/atomic_file.hpp"
#include "scenario/errors.hpp"

namespace soilbin::compare {
namespace {

/// The trials of one decision: counts and times runs, and keeps each candidate's in a record of its own.
class Trials {
 public:
  Trials(const TrialQuestion& question, const TrialSettings& settings, const EffectVocabulary& effects,
         std::size_t candidates)
      : question_(question),
        settings_(settings),
        effects_(effects),
        runs_(std::make_shared<SoilBinRuns>(settings.bin, settings.source)) {
    for (int k = 0; k < settings.packings; ++k)
      packings_.push_back(settings.bin.packing + static_cast<std::uint64_t>(k));
    at_.candidates = candidates;
    at_.at_all = static_cast<int>(candidates * question.setpoints.size() * packings_.size());
  }

  std::vector<Answer> answers_of(std::size_t candidate, const Eigen::VectorXd& values) {
    at_.candidate = candidate;
    const Case question = trial_case(question_, values);
    const RunOnPackings model("dem", packings_, counted(kept(question)));
    return sweep(model, question.scenario, question.study.conditions);
  }

  int runs() const { return at_.done; }
  int not_steady() const { return not_steady_; }

 private:
  RunOnce kept(const Case& question) const {
    const bool recorded = !settings_.records.empty();
    RunOnce run = [runs = runs_, recorded](const Scenario& scenario, const OperatingCondition& at,
                                           std::uint64_t packing) {
      RecordedRun made = (*runs)(scenario, at, packing);
      if (!recorded) made.on_saved();  // nobody asked for more than what is in memory
      return made;
    };
    if (!recorded) return run;
    const std::string key = inputs_key(inputs_of(settings_.bin, question.scenario));
    RunKeeping keeping;
    keeping.record = settings_.records / (key + ".json"), keeping.version = settings_.version;
    return kept_runs(keeping, settings_.bin, question, effects_, std::move(run));
  }

  RunOnce counted(RunOnce run) {
    return [this, run = std::move(run)](const Scenario& scenario, const OperatingCondition& at, std::uint64_t packing) {
      if (settings_.progress) settings_.progress(at_);
      RecordedRun made = run(scenario, at, packing);
      seconds_ += made.seconds, ++at_.done;
      at_.seconds_a_run = seconds_ / at_.done;
      not_steady_ += made.answer.result && !made.steady;
      return made;
    };
  }

  const TrialQuestion& question_;
  const TrialSettings& settings_;
  const EffectVocabulary& effects_;
  std::shared_ptr<SoilBinRuns> runs_;  // one for all: the tire's contact doesn't change the bed
  std::vector<std::uint64_t> packings_;
  TrialProgress at_;
  double seconds_ = 0.0;
  int not_steady_ = 0;
};

}  // namespace

void check(const TrialQuestion& question, const TrialSettings& settings) {
  grains_of(question.soil);
  if (question.setpoints.empty()) throw InputError(fmt::format("{} has no setpoint to run", question.campaign.name));
  if (settings.packings < 1) throw InputError("a candidate runs on one bed or more");
  const std::string& name = question.campaign.name;
  const auto tell = [&](const std::string& where, const auto& work) {
    try {
      work();
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: {}: {}", name, where, error.what()));
    }
  };
  tell("its wheel", [&] { dem::tire_surface(question.campaign.wheel, settings.bin.rig.meshing); });
  for (const Setpoint& setpoint : question.setpoints)
    tell(in_words(setpoint.at), [&] { dem::wheel_motion(setpoint.at, question.campaign.wheel.radius); });
  const dem::BedRecipe bed = dem::DemModel(settings.bin).recipe(trial_case(question, {}).scenario);
  tell("its wheel", [&] { dem::way_in_bin(bed.size, question.campaign.wheel, settings.bin.rig); });
}

Case trial_case(const TrialQuestion& question, const Eigen::VectorXd& values) {
  Case trial;
  trial.name = "decide-" + question.campaign.name;
  trial.description = "A candidate of a calibration where a campaign was measured";
  trial.scenario.tire = question.campaign.wheel;
  if (trial.scenario.tire.name.empty()) trial.scenario.tire.name = question.campaign.name;
  trial.scenario.soil = question.soil;
  if (values.size() > 0) put_values(*trial.scenario.soil.granular, question.kind, question.factors, values);
  trial.scenario.bin = question.campaign.bin;
  trial.study.name = trial.name;
  trial.study.models.push_back({ModelKind::dem, {}, "dem"});
  for (const Setpoint& setpoint : question.setpoints) trial.study.conditions.push_back(setpoint.at);
  return trial;
}

Decision decide_in_soil_bin(const TrialQuestion& question, const TrialSettings& settings,
                            const std::vector<Candidate>& candidates, const EffectVocabulary& effects) {
  check(question, settings);
  if (!settings.records.empty()) make_folder(settings.records);
  Trials trials(question, settings, effects, candidates.size());
  std::vector<std::vector<Answer>> answers;
  for (std::size_t k = 0; k < candidates.size(); ++k) answers.push_back(trials.answers_of(k, candidates[k].values));
  Decision decision =
      decide(question.campaign.name, question.setpoints, std::move(answers), question.campaign.wheel.radius);
  decision.runs = trials.runs(), decision.not_steady = trials.not_steady();
  return decision;
}

}  // namespace soilbin::compare
