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
#include "scenario/quantity.hpp"

namespace soilbin::compare {

SoilBinRuns::SoilBinRuns(dem::DemSettings settings, std::string source)
    : settings_(std::move(settings)), source_(std::move(source)) {
  settings_.on_run = [last = last_](const dem::WheelRun& run) { *last = run; };
  settings_.forget_finished = false;
}

RecordedRun SoilBinRuns::operator()(const Scenario& scenario, const OperatingCondition& at, std::uint64_t packing) {
  const auto began = std::chrono::steady_clock::now();
  RecordedRun run;
  run.answer.at = at, run.packing = packing, run.source = source_;
  run.on_saved = [restart = model(packing).restart_of(scenario, at)] { dem::forget_run(restart); };
  *last_ = {};
  try {
    run.answer.result = model(packing).evaluate(scenario, at);
    run.steady = last_->steady, run.drift = last_->drift, run.power = last_->power;
    run.bed = last_->bed, run.rut = last_->rut, run.flow = last_->flow;
  } catch (const dem::RunStopped& stopped) {
    run.answer.error = stopped.what();
  } catch (const NoSolution& error) {
    run.answer.error = error.what();
  }
  run.seconds = last_->earlier + std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  return run;
}

const dem::DemModel& SoilBinRuns::model(std::uint64_t packing) {
  const auto known = models_.find(packing);
  if (known != models_.end()) return *known->second;
  settings_.packing = packing;
  return *models_.emplace(packing, std::make_unique<dem::DemModel>(settings_)).first->second;
}

namespace {

/// A condition and its packing as the name of a file: "load-75-N-slip-20-packing-1".
std::string file_name_of(const OperatingCondition& at, std::uint64_t packing) {
  std::string name;
  for (const char c : fmt::format("{} packing {}", in_words(at), packing))
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '-')
      name += c;
    else if (!name.empty() && name.back() != '-')
      name += '-';
  return name;
}

/// Runs conditions, and keeps what can be looked at of them.
class WatchedRuns {
 public:
  WatchedRuns(const dem::DemSettings& settings, const RunKeeping& keeping)
      : replay_{keeping.replay, keeping.source},
        paraview_(keeping.paraview),
        tell_(settings.how.tell),
        runs_(watched(settings), keeping.source) {}
  WatchedRuns(const WatchedRuns&) = delete;
  WatchedRuns& operator=(const WatchedRuns&) = delete;

  RecordedRun operator()(const Scenario& scenario, const OperatingCondition& at, std::uint64_t packing) {
    name_ = file_name_of(at, packing);
    RecordedRun run = runs_(scenario, at, packing);
    if (recorder_.has_frames()) {
      recorder_.write(replay_, in_words(at), packing);
      tell(replay_.file, "soilbin compare --replay shows it");
    }
    if (!paraview_.empty()) tell(paraview_ / (name_ + ".pvd"), "ParaView opens it");
    return run;
  }

 private:
  dem::DemSettings watched(dem::DemSettings settings) {
    dem::Onlooker& onlooker = settings.rig.onlooker;
    if (!replay_.file.empty()) onlooker = recorder_.onlooker();
    if (!paraview_.empty())
      onlooker.look = [this, replayed = onlooker.look](const dem::Simulation& simulation, int wheel, double surface) {
        if (replayed) replayed(simulation, wheel, surface);
        dem::export_to_paraview(paraview_, name_, simulation.state());
      };
    return settings;
  }

  void tell(const std::filesystem::path& file, const char* what) const {
    if (tell_) tell_(fmt::format("wrote {}: {}", file.string(), what));
  }

  ReplayKeeping replay_;
  std::filesystem::path paraview_;
  std::string name_;  ///< of the run that is made, for its files
  std::function<void(const std::string&)> tell_;
  ReplayRecorder recorder_;
  SoilBinRuns runs_;
};

void refuse_a_differing_pair(const std::filesystem::path& file, double half_step) {
  const Record record = read_record(file);
  for (const StepPair& pair : step_pairs(record))
    if (!agrees(pair))
      throw TimeStepMatters(
          fmt::format("answers depend on the time step of {:.3g} ms: {}\n  hint: --time-step {:.3g}ms, in another "
                      "record; or --half-step no: then every page says that they do",
                      2e3 * half_step, in_words(pair), 1e3 * half_step));
}

}  // namespace

std::vector<Record> read_records(const std::vector<std::filesystem::path>& files, const Inputs& inputs) {
  std::vector<Record> records;
  for (const std::filesystem::path& file : files) {
    records.push_back(read_record(file));
    refuse_other_inputs(records.back(), inputs, file);
  }
  return records;
}

RunOnce run_once(const dem::DemSettings& settings, const Case& question, const EffectVocabulary& effects,
                 const RunKeeping& keeping) {
  RunOnce run = [runs = std::make_shared<WatchedRuns>(settings, keeping)](const auto&... of) { return (*runs)(of...); };
  if (keeping.record.empty()) return run;
  run = kept_runs(keeping, settings, question, effects, std::move(run));
  if (keeping.known.empty()) return run;
  return [known = read_records(keeping.known, inputs_of(settings, question.scenario)), run = std::move(run)](
             const Scenario& scenario, const OperatingCondition& at, std::uint64_t packing) {
    for (const Record& record : known)
      if (const RecordedRun* there = find_run(record.runs, at, packing)) return *there;
    return run(scenario, at, packing);
  };
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

TestStep test_of_step(const Case& question, int packings, std::optional<bool> asked) {
  const std::size_t runs = question.study.conditions.size() * static_cast<std::size_t>(std::max(packings, 1));
  return asked.value_or(runs >= runs_that_pay_a_test) ? TestStep::yes : TestStep::no;
}

std::vector<AskedRun> list_of(const Case& question, const dem::DemSettings& settings, int packings,
                              std::optional<bool> test) {
  const std::size_t conditions = question.study.conditions.size();
  if (conditions * static_cast<std::size_t>(std::max(packings, 1)) > most_runs)  // before the list is built
    throw InputError(
        fmt::format("{} conditions on {} packings are more than {} runs of grains", conditions, packings, most_runs));
  return run_list(question.study.conditions, packings_from(settings, packings), test_of_step(question, packings, test));
}

std::vector<AskedRun> runs_of(const Case& question, const dem::DemSettings& settings, int packings,
                              std::optional<bool> test) {
  const dem::DemModel model(settings);
  model.check(question.scenario);
  std::vector<AskedRun> list = list_of(question, settings, packings, test);
  for (const OperatingCondition& at : question.study.conditions) model.check(question.scenario, at);
  return list;
}

void make_runs(const std::vector<AskedRun>& list, const dem::DemSettings& settings, const Case& question,
               const EffectVocabulary& effects, const RunKeeping& keeping, const BeforeRun& before) {
  const std::vector<Record> known = read_records(keeping.known, inputs_of(settings, question.scenario));
  const dem::DemSettings half = at_half_step(settings, question.scenario);
  const RunOnce whole_step = run_once(settings, question, effects, keeping);
  RunOnce half_runs = [runs = std::make_shared<SoilBinRuns>(half, keeping.source)](const auto&... of) {
    return (*runs)(of...);
  };
  const RunOnce half_step = kept_runs(keeping, settings, question, effects, std::move(half_runs), &Record::half_step);
  std::size_t place = 0;
  for (const AskedRun& run : list) {
    if (missing_runs({run}, known).empty()) {
      ++place;
      continue;
    }
    if (before) before(place++, run);
    (run.half_step ? half_step : whole_step)(question.scenario, run.at, run.packing);
    if (run.half_step) refuse_a_differing_pair(keeping.record, half.rig.dt);
  }
}

std::unique_ptr<const Model> soil_bin_model(const dem::DemSettings& settings, int packings, RunOnce run,
                                            RunListener on_run) {
  return std::make_unique<const RunOnPackings>(dem::model_name(settings), packings_from(settings, packings),
                                               std::move(run), std::move(on_run));
}

void refuse_other_grains(const Record& record, const Scenario& scenario, const std::filesystem::path& file) {
  refuse_other_inputs(record, inputs_of({}, scenario), file,
                      {"tire.", "soil.", "bed.radius", "bed.density", "bed.young", "bed.poisson", "bed.restitution",
                       "bed.sliding", "bed.rolling", "bed.laws", "bed.twisting"});
}

std::unique_ptr<const Model> recorded_soil_bin(Record record, const Scenario& scenario,
                                               const std::filesystem::path& file, RunListener on_run) {
  refuse_other_grains(record, scenario, file);
  return std::make_unique<const RecordedModel>(std::move(record), std::move(on_run));
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
  return fmt::format("relative density {} % (void ratios {:.3f} loosest, {:.3f} densest{})\n",
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

std::string in_words(const dem::StepCriteria& step) {
  return fmt::format(
      "dem: time step {:.3g} s, {:.2g} of the Rayleigh time of {:.3g} s; an impact at the rim's {:.2g} m/s lasts "
      "{:.3g} s, {:.0f} steps\n",
      step.step, step.step / step.rayleigh, step.rayleigh, step.speed, step.hertz, step.hertz / step.step);
}

nlohmann::ordered_json to_json(const dem::StepCriteria& step) {
  return {{"time_step", step.step},
          {"rayleigh_time", step.rayleigh},
          {"impact_speed", step.speed},
          {"hertz_time", step.hertz}};
}

RunOnce kept_runs(const RunKeeping& keeping, const dem::DemSettings& settings, const Case& question,
                  const EffectVocabulary& effects, RunOnce run, RunList list) {
  Record empty{.soilbin = keeping.version,
               .model = dem::model_name(settings),
               .question = write_case(question, effects),
               .inputs = inputs_of(settings, question.scenario),
               .runs = {},
               .half_step = {}};
  return kept_in(keeping.record, std::move(empty), std::move(run), list, keeping.writers);
}

Inputs inputs_of(const dem::DemSettings& settings, const Scenario& scenario) {
  Inputs inputs = dem::run_inputs(dem::DemModel(settings).recipe(scenario), scenario.tire, settings.rig);
  if (settings.lammps) inputs.emplace_back("engine", "lammps");  // on how many processes changes no more than chance
  return inputs;
}

}  // namespace soilbin::compare
