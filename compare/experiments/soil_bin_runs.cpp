#include "compare/experiments/soil_bin_runs.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cmath>
#include <limits>

#include "compare/recorded/step_pair.hpp"
#include "compare/sweep/varying.hpp"
#include "dem/archive/paraview.hpp"
#include "dem/bed/relative_density.hpp"
#include "dem/rig/run_inputs.hpp"
#include "dem/rig/staged_run.hpp"
#include "scenario/errors.hpp"
#include "scenario/grain_sizes.hpp"
#include "scenario/quantity.hpp"

namespace soilbin::compare {

SoilBinRuns::SoilBinRuns(dem::DemSettings settings, const RunKeeping& keeping)
    : settings_(std::move(settings)), replay_{keeping.replay, keeping.source}, paraview_(keeping.paraview) {
  settings_.on_run = [this](const dem::WheelRun& run) { last_ = run; };
  settings_.forget_finished = false;
  if (!replay_.file.empty()) settings_.rig.onlooker = recorder_.onlooker();
  if (!paraview_.empty())
    settings_.rig.onlooker.look = [this, replayed = settings_.rig.onlooker.look](const dem::Simulation& simulation,
                                                                                 int wheel, double surface) {
      if (replayed) replayed(simulation, wheel, surface);
      dem::export_to_paraview(paraview_, name_, simulation.state());
    };
}

const dem::DemModel& SoilBinRuns::model(const Scenario& scenario, const RunSpec& spec) {
  std::unique_ptr<dem::DemModel>& model = models_[{spec.packing, spec.kind}];
  if (model) return *model;
  dem::DemSettings settings = settings_;
  settings.packing = spec.packing;
  if (spec.kind == RunKind::half_step) settings = at_half_step(settings, scenario);
  if (spec.kind != RunKind::usual) settings.rig.onlooker = {};
  model = std::make_unique<dem::DemModel>(std::move(settings));
  return *model;
}

namespace {

/// A condition and its packing as the name of a file: "load-75-N-slip-20-packing-1".
std::string file_name_of(const RunSpec& spec) {
  std::string name;
  for (const char c : fmt::format("{} packing {}", in_words(spec.at), spec.packing))
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '-')
      name += c;
    else if (!name.empty() && name.back() != '-')
      name += '-';
  return name;
}

}  // namespace

RecordedRun SoilBinRuns::operator()(const Scenario& asked, const RunSpec& spec) {
  const Scenario scenario = spec.kind == RunKind::coarser ? with_coarser_grains(asked) : asked;
  const auto began = std::chrono::steady_clock::now();
  const dem::DemModel& bin = model(scenario, spec);
  RecordedRun run;
  run.answer.at = spec.at, run.packing = spec.packing, run.source = replay_.source;
  run.on_saved = [restart = bin.restart_of(scenario, spec.at)] { dem::forget_run(restart); };
  name_ = file_name_of(spec), last_ = {};
  try {
    run.answer.result = bin.evaluate(scenario, spec.at);
    run.steady = last_.steady, run.drift = last_.drift, run.power = last_.power;
    run.bed = last_.bed, run.rut = last_.rut, run.flow = last_.flow;
  } catch (const dem::RunStopped& stopped) {
    run.answer.error = stopped.what();
  } catch (const NoSolution& error) {
    run.answer.error = error.what();
  }
  run.seconds = last_.earlier + std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  const auto wrote = [&](const std::filesystem::path& file, const char* what) {
    if (settings_.how.tell) settings_.how.tell(fmt::format("wrote {}: {}", file.string(), what));
  };
  if (recorder_.has_frames()) {
    recorder_.write(replay_, in_words(spec.at), spec.packing);
    wrote(replay_.file, "soilbin compare --replay shows it");
  }
  if (!paraview_.empty() && spec.kind == RunKind::usual) wrote(paraview_ / (name_ + ".pvd"), "ParaView opens it");
  return run;
}

namespace {

void refuse_a_differing_pair(const Record& record) {
  for (const StepPair& pair : step_pairs(record)) {
    if (agrees(pair)) continue;
    const auto whole = std::ranges::find(record.inputs, "rig.time_step", &Inputs::value_type::first);
    const double step = whole == record.inputs.end() ? not_a_number : read_number(whole->second).value_or(not_a_number);
    throw TimeStepMatters(
        fmt::format("answers depend on the time step of {:.3g} ms: {}\n  hint: --time-step {:.3g}ms, in another "
                    "record; or --half-step no: then every page says that they do",
                    1e3 * step, in_words(pair), 5e2 * step));
  }
}

}  // namespace

RunStore store_of(const dem::DemSettings& settings, const Case& question, const EffectVocabulary& effects,
                  const RunKeeping& keeping) {
  const Record begin{.soilbin = keeping.version,
                     .model = dem::model_name(settings),
                     .question = write_case(question, effects),
                     .inputs = inputs_of(settings, question.scenario),
                     .runs = {}};
  std::vector<NamedRecord> known;
  for (const std::filesystem::path& file : keeping.known) known.push_back({file, read_record(file)});
  return RunStore(begin, keeping.record, keeping.writers, known);
}

RecordedRun obtain(const RunSpec& spec, const Scenario& scenario, RunStore& store, SoilBinRuns& bin) {
  RecordedRun run = obtain(spec, store, [&](const RunSpec& missing) { return bin(scenario, missing); });
  if (spec.kind == RunKind::half_step) refuse_a_differing_pair(store.record());
  return run;
}

Scenario with_coarser_grains(Scenario scenario) {
  if (scenario.soil.granular) scale_sizes(*scenario.soil.granular, coarser_by);
  return scenario;
}

dem::DemSettings at_half_step(dem::DemSettings settings, const Scenario& scenario) {
  settings.bed_dt = settings.bed_dt.value_or(settings.rig.dt);
  settings.rig.dt = dem::step_of(dem::DemModel(settings).recipe(scenario), settings.rig) / 2;
  return settings;
}

std::vector<std::uint64_t> packings_from(const dem::DemSettings& settings, int packings) {
  if (packings > most_packings) throw InputError(fmt::format("{} packings: {} at most", packings, most_packings));
  std::vector<std::uint64_t> seeds;
  for (int k = 0; k < packings; ++k) seeds.push_back(settings.packing + static_cast<std::uint64_t>(k));
  return seeds;
}

std::vector<RunSpec> specs(const Case& question, const dem::DemSettings& settings, int packings,
                           std::optional<bool> test, Twins twins) {
  const std::size_t conditions = question.study.conditions.size();
  const std::size_t runs = conditions * static_cast<std::size_t>(std::max(packings, 1));
  if (runs > most_runs)  // before the list is built
    throw InputError(
        fmt::format("{} conditions on {} packings are more than {} runs of grains", conditions, packings, most_runs));
  return specs(question.study.conditions, packings_from(settings, packings),
               test.value_or(runs >= runs_that_pay_a_test) ? TestStep::yes : TestStep::no, twins);
}

void check_runs(const Case& question, const dem::DemSettings& settings, Twins twins) {
  const dem::DemModel model(settings);
  model.check(question.scenario);
  if (twins == Twins::yes) try {
      model.check(with_coarser_grains(question.scenario));
    } catch (const InputError& error) {
      throw InputError(fmt::format("a twin with grains {} times as large: {}", coarser_by, error.what()));
    }
  for (const OperatingCondition& at : question.study.conditions) model.check(question.scenario, at);
}

void refuse_other_grains(const Record& record, const Scenario& scenario, const std::filesystem::path& file) {
  refuse_other_inputs(
      record, inputs_of({}, scenario), file,
      {"tire.", "soil.", "bed.radius", "bed.sizes", "bed.density", "bed.young", "bed.poisson", "bed.restitution",
       "bed.sliding", "bed.rolling", "bed.laws", "bed.twisting", "bed.cohesion", "bed.work_of_adhesion"});
}

std::string relative_density_of(const std::vector<RecordedRun>& runs, const Soil& soil,
                                const std::filesystem::path& beds) {
  dem::BedStore store(beds);
  if (!soil.granular) return "";
  const auto limits = dem::known_density_limits(*soil.granular, store);
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const RecordedRun& run : runs)
    if (limits && std::isfinite(run.bed.void_ratio)) {
      const double density = dem::relative_density(run.bed.void_ratio, *limits);
      least = std::min(least, density), most = std::max(most, density);
    }
  if (!(least <= most)) return "";
  const std::string low = fmt::format("{:.0f}", 100 * least), high = fmt::format("{:.0f}", 100 * most);
  return fmt::format("relative density {} % (void ratios {:.3f} loosest, {:.3f} densest{})",
                     low == high ? low : low + " to " + high, limits->loosest, limits->densest,
                     low == high ? dem::beyond_limits(least) : "");
}

std::optional<dem::StepCriteria> step_of(dem::DemSettings settings, const Case& question,
                                         const std::filesystem::path& record) {
  if (!asks(question.study, ModelKind::dem)) return std::nullopt;
  if (!record.empty())
    for (const auto& [name, value] : read_record(record).inputs)
      if (name == "rig.time_step") settings.rig.dt = read_number(value).value_or(0.0);
  double fastest = 0;
  for (const OperatingCondition& at : question.study.conditions)
    if (at.speed > 0 && std::abs(at.slip) < 1) fastest = std::max(fastest, dem::rim_speed(question.scenario.tire, at));
  if (!(fastest > 0)) return std::nullopt;
  return dem::step_criteria(dem::DemModel(settings).recipe(question.scenario), settings.rig, fastest);
}

nlohmann::ordered_json to_json(const dem::StepCriteria& step) {
  return {{"time_step", step.step},
          {"rayleigh_time", step.rayleigh},
          {"impact_speed", step.speed},
          {"hertz_time", step.hertz}};
}

Inputs inputs_of(const dem::DemSettings& settings, const Scenario& scenario) {
  Inputs inputs = dem::run_inputs(dem::DemModel(settings).recipe(scenario), scenario.tire, settings.rig);
  if (settings.lammps) inputs.emplace_back("engine", "lammps");  // on how many processes changes no more than chance
  return inputs;
}

}  // namespace soilbin::compare
