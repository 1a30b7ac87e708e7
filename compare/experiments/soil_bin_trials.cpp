#include "compare/experiments/soil_bin_trials.hpp"

#include <fmt/core.h>

#include "compare/recorded/recorded_model.hpp"
#include "compare/sweep/varying.hpp"
#include "dem/rig/wheel_in_bin.hpp"
#include "scenario/atomic_file.hpp"
#include "scenario/errors.hpp"

namespace soilbin::compare {
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
  SoilBinRuns bin(settings.bin, {.source = settings.source});  // for all: the tire's contact doesn't change the bed
  const std::vector<std::uint64_t> packings = packings_from(settings.bin, settings.packings);
  const std::size_t all = candidates.size() * question.setpoints.size() * packings.size();
  std::size_t done = 0;
  double seconds = 0;
  int not_steady = 0;
  std::vector<std::vector<Answer>> answers;
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    const Case trial = trial_case(question, candidates[k].values);
    RunKeeping keeping{.version = settings.version, .source = settings.source};
    if (!settings.records.empty())
      keeping.record = settings.records / (inputs_key(inputs_of(settings.bin, trial.scenario)) + ".json");
    RunStore store = store_of(settings.bin, trial, effects, keeping);
    const RunOnPackings model("dem", packings, [&](const Scenario& scenario, const RunSpec& spec) {
      tell(settings.watch,
           fmt::format("soil bin: candidate {} of {}, run {} of {}", candidate_name(k), candidates.size(), done + 1,
                       all),
           done, all, seconds);
      RecordedRun run = obtain(spec, scenario, store, bin);
      if (settings.records.empty()) run.on_saved();  // nobody asked for more than what is in memory
      seconds += run.seconds, ++done;
      not_steady += run.answer.result && !run.steady;
      return run;
    });
    answers.push_back(sweep(model, trial.scenario, trial.study.conditions));
  }
  Decision decision =
      decide(question.campaign.name, question.setpoints, std::move(answers), question.campaign.wheel.radius);
  decision.runs = static_cast<int>(done), decision.not_steady = not_steady;
  return decision;
}

}  // namespace soilbin::compare
