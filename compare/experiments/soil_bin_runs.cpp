#include "compare/experiments/soil_bin_runs.hpp"

#include <chrono>

#include "dem/rig/run_inputs.hpp"
#include "dem/rig/staged_run.hpp"
#include "scenario/errors.hpp"

namespace soilbin::compare {

SoilBinRuns::SoilBinRuns(dem::DemSettings settings, std::string source)
    : settings_(std::move(settings)), source_(std::move(source)) {
  settings_.on_run = [told = told_](const dem::WheelRun& run) { *told = run; };
  settings_.forget_finished = false;
}

RecordedRun SoilBinRuns::operator()(const Scenario& scenario, const OperatingCondition& at, std::uint64_t packing) {
  const auto began = std::chrono::steady_clock::now();
  RecordedRun run;
  run.answer.at = at, run.packing = packing, run.source = source_;
  run.when_safe = [restart = model(packing).restart_of(scenario, at)] { dem::forget_run(restart); };
  *told_ = {};
  try {
    run.answer.result = model(packing).evaluate(scenario, at);
    run.steady = told_->steady, run.drift = told_->drift, run.power = told_->power;
    run.rut = told_->rut, run.flow = told_->flow;
  } catch (const dem::RunStopped& stopped) {
    run.answer.error = stopped.what();
  } catch (const NoSolution& error) {
    run.answer.error = error.what();
  }
  run.seconds = told_->earlier + std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  return run;
}

const dem::DemModel& SoilBinRuns::model(std::uint64_t packing) {
  const auto known = models_.find(packing);
  if (known != models_.end()) return *known->second;
  settings_.packing = packing;
  return *models_.emplace(packing, std::make_unique<dem::DemModel>(settings_)).first->second;
}

RunOnce kept_runs(const std::filesystem::path& file, const dem::DemSettings& settings, const Case& question,
                  const EffectVocabulary& effects, std::string version, RunOnce run) {
  Record empty{std::move(version), "dem", write_case(question, effects), inputs_of(settings, question.scenario), {}};
  return kept_in(file, std::move(empty), std::move(run));
}

Inputs inputs_of(const dem::DemSettings& settings, const Scenario& scenario) {
  return dem::run_inputs(dem::DemModel(settings).recipe(scenario), scenario.tire, settings.rig);
}

}  // namespace soilbin::compare
