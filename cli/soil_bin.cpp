#include "cli/soil_bin.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "cli/flag_values.hpp"
#include "cli/progress.hpp"
#include "cli/replay_recorder.hpp"
#include "cli/versions.hpp"
#include "cli/workplace.hpp"
#include "compare/experiments/soil_bin_runs.hpp"
#include "compare/measured/channels.hpp"
#include "compare/sweep/alike.hpp"
#include "compare/sweep/varying.hpp"
#include "dem/archive/paraview.hpp"
#include "scenario/errors.hpp"
#include "scenario/quantity.hpp"

namespace soilbin::cli {

namespace fs = std::filesystem;

std::filesystem::path folder_of_beds() {
  if (const char* folder = std::getenv("SOILBIN_BEDS")) return folder;
  const fs::path cache = user_cache();
  return cache.empty() ? fs::path() : cache / "beds";
}

void show_dem_progress(const dem::Progress& progress) {
  if (interrupt_asked()) throw Interrupted();
  if (progress.done >= 1) return clear_progress_line();
  const bool known = std::isfinite(progress.seconds_left);
  show_progress_line(fmt::format("dem, {}: {:.0f} %{}", progress.stage, 100 * progress.done,
                                 known ? fmt::format(", {:.0f} s left", progress.seconds_left) : ""));
}

void tell_beside_progress(const std::string& words) {
  clear_progress_line();
  fmt::print(stderr, "{}\n", words);
}

namespace {

/// A condition and its packing as the name of a file: "load-75-N-slip-20-packing-1".
std::string file_name_of(const OperatingCondition& at, std::uint64_t packing) {
  std::string name;
  for (const char c : fmt::format("{} packing {}", compare::in_words(at), packing))
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '-')
      name += c;
    else if (!name.empty() && name.back() != '-')
      name += '-';
  return name;
}

/// Runs conditions, and keeps what can be looked at of them.
class WatchedRuns {
 public:
  WatchedRuns(dem::DemSettings settings, Views views)
      : views_(std::move(views)), runs_(watched(std::move(settings)), source_state()) {}
  WatchedRuns(const WatchedRuns&) = delete;
  WatchedRuns& operator=(const WatchedRuns&) = delete;

  compare::RecordedRun operator()(const Scenario& scenario, const OperatingCondition& at, std::uint64_t packing) {
    name_ = file_name_of(at, packing);
    compare::RecordedRun run = runs_(scenario, at, packing);
    keep_replay(at, packing);
    if (!views_.paraview.empty())
      fmt::print(stderr, "wrote {}: ParaView opens it\n", (views_.paraview / (name_ + ".pvd")).string());
    return run;
  }

 private:
  dem::DemSettings watched(dem::DemSettings settings) {
    if (views_.replay.empty() && views_.paraview.empty()) return settings;
    settings.rig.onlooker.look = [this](const dem::Simulation& simulation, int wheel, double surface) {
      if (!views_.replay.empty() && !done_) recorder_.look(simulation, wheel, surface);
      if (!views_.paraview.empty()) dem::export_to_paraview(views_.paraview, name_, simulation.state());
    };
    if (!views_.replay.empty()) settings.rig.onlooker.keeper = recorder_.keeper();
    return settings;
  }

  void keep_replay(const OperatingCondition& at, std::uint64_t packing) {
    if (done_ || !recorder_.has_frames()) return;
    done_ = true;
    recorder_.write(views_.replay, compare::in_words(at),
                    {{"packing", std::to_string(packing)}, {"sources", source_state()}});
    fmt::print(stderr, "wrote {}: soilbin compare --replay shows it\n", views_.replay.string());
  }

  Views views_;
  std::string name_;  ///< of the run that is made, for its files
  ReplayRecorder recorder_;
  bool done_ = false;
  compare::SoilBinRuns runs_;
};

/// A record's answers, with the runs behind them told to a log.
class FromRecord : public Model {
 public:
  FromRecord(compare::Record record, RunLog log) : model_(std::move(record)), log_(std::move(log)) {}
  std::string name() const override { return model_.name(); }
  TractionResult evaluate(const Scenario& scenario, const OperatingCondition& at) const override {
    for (const compare::RecordedRun* run : model_.runs(at)) log_->push_back(*run);
    return model_.evaluate(scenario, at);
  }

 private:
  compare::RecordedModel model_;
  RunLog log_;
};

std::unique_ptr<const Model> from_record(const SoilBinFlags& flags, const Case& question, const RunLog& log) {
  compare::Record record = read_record_aloud(flags.recorded);
  // Bed and rig are the record's; tire and grains must be the study's.
  compare::refuse_other_inputs(record, compare::inputs_of({}, question.scenario), flags.recorded,
                               {"tire.", "soil.", "bed.radius", "bed.density", "bed.young", "bed.poisson",
                                "bed.restitution", "bed.sliding", "bed.rolling"});
  return std::make_unique<const FromRecord>(std::move(record), log);
}

std::unique_ptr<const Model> running(const SoilBinFlags& flags, const Case& question, const EffectVocabulary& effects,
                                     const RunLog& log) {
  const dem::DemSettings settings = settings_of(flags);
  std::vector<std::uint64_t> packings;
  for (int k = 0; k < flags.packings; ++k) packings.push_back(settings.packing + static_cast<std::uint64_t>(k));
  return std::make_unique<const compare::RunOnPackings>(
      "dem", packings, run_with(settings, question, effects, flags.record, {flags.replay, flags.paraview}),
      [log](const compare::RecordedRun& told) { log->push_back(told); });
}

}  // namespace

void check_threads(int threads) {
  if (threads < 0 || threads > dem::most_threads())
    throw InputError(fmt::format("--threads: 0 (one a core) .. {}", dem::most_threads()));
}

dem::DemSettings settings_of(const SoilBinFlags& flags) {
  dem::DemSettings settings;
  set_where_given("--bed-length", flags.length, {"m", above_zero}, settings.size.length);
  set_where_given("--bed-width", flags.width, {"m", above_zero}, settings.size.width);
  set_where_given("--bed-depth", flags.depth, {"m", above_zero}, settings.size.depth);
  set_where_given("--behind", flags.behind, {"m", above_zero}, settings.rig.behind);
  set_where_given("--ahead", flags.ahead, {"m", above_zero}, settings.rig.ahead);
  set_where_given("--travel", flags.travel, {"m", above_zero}, settings.rig.travel);
  set_where_given("--lowering", flags.lowering, {"s", above_zero}, settings.rig.lowering);
  set_where_given("--resting", flags.resting, {"s", zero_or_more}, settings.rig.resting);
  set_where_given("--starting", flags.starting, {"s", above_zero}, settings.rig.starting);
  set_where_given("--tilting", flags.tilting, {"s", above_zero}, settings.rig.tilting);
  set_where_given("--time-step", flags.time_step, {"s", above_zero}, settings.rig.dt);
  set_where_given("--sleep", flags.sleep, {"-", {.lower = 0, .upper = 0.1}}, settings.rig.sleep_speed);
  set_where_given("--deepest-overlap", flags.deepest_overlap, {"-", {.lower = 0.05, .upper = 2}},
                  settings.rig.deepest_overlap);
  set_where_given("--settling-friction", flags.settling_friction, {"-", fractions}, settings.settling_friction);
  if (flags.packing < 0) throw InputError("--packing: a seed is 0 or more");
  if (flags.packings < 1) throw InputError("--packings: 1 or more");
  check_threads(flags.threads);
  settings.packing = static_cast<std::uint64_t>(flags.packing);
  settings.beds = folder_of_beds();
  settings.how.threads = flags.threads;
  settings.how.progress = show_dem_progress;
  settings.how.tell = tell_beside_progress;
  settings.checkpoints.restart = settings.beds;
  settings.checkpoints.tell = tell_beside_progress;
  return settings;
}

void SoilBinFlags::add_measures_to(CLI::App& command) {
  command.add_option("--bed-length", length, "dem: length of the bed, 2.5 m")->type_name("LENGTH");
  command.add_option("--bed-width", width, "dem: its width, 0.8 m")->type_name("LENGTH");
  command.add_option("--bed-depth", depth, "dem: its depth, 0.3 m")->type_name("LENGTH");
  command.add_option("--behind", behind, "dem: of the axle to the bin's rear end at the start, 0.35 m")
      ->type_name("LENGTH");
  command.add_option("--ahead", ahead, "dem: of the axle to its front end at the end, 0.5 m")->type_name("LENGTH");
  command.add_option("--travel", travel, "dem: way of the axle, as far as the bin lets it")->type_name("LENGTH");
  command.add_option("--lowering", lowering, "dem: time in which the load comes on, 0.5 s")->type_name("TIME");
  command.add_option("--resting", resting, "dem: time under the whole load before the start, 0.2 s")->type_name("TIME");
  command.add_option("--tilting", tilting, "dem: time in which gravity turns to an incline, 0.3 s")->type_name("TIME");
  command.add_option("--time-step", time_step, "dem: of bed and run, a fifth of the Rayleigh time")->type_name("TIME");
  command
      .add_option("--sleep", sleep,
                  "dem: grains far from the wheel rest that are slower than this share of sqrt(g d), 0.003; 0: none")
      ->type_name("SHARE");
  command.add_option("--deepest-overlap", deepest_overlap, "dem: of the smaller radius that grains may overlap, 0.5")
      ->type_name("SHARE");
}

void SoilBinFlags::add_rig_to(CLI::App& command) {
  add_measures_to(command);
  command.add_option("--packing", packing, "dem: seed of the bed, 1")->type_name("SEED");
  command
      .add_option("--settling-friction", settling_friction,
                  "dem: share of friction while the bed settles, 1; 0: densest")
      ->type_name("SHARE");
  command.add_option("--threads", threads, "dem: 0, one a core")->type_name("N");
}

void SoilBinFlags::add_starting_to(CLI::App& command) {
  command.add_option("--starting", starting, "dem: time in which speed and rotation come on, 0.2 s")->type_name("TIME");
}

void SoilBinFlags::add_to(CLI::App& command) {
  add_rig_to(command);
  add_starting_to(command);
  command.add_option("--packings", packings, "dem: runs on so many packings, from --packing on, and their mean; 1")
      ->type_name("N");
  command.add_option("--record", record, "dem: keep each run in this file, and go on with what is there")
      ->type_name("FILE.json")
      ->check(writable_file());
  command
      .add_option("--recorded", recorded,
                  "dem: answer from this record, without running; without a file from the one in the library")
      ->type_name("[FILE.json]")
      ->expected(0, 1)
      ->default_str(library_record)
      ->excludes("--record");
}

compare::MakeModel models_with(const SoilBinFlags& flags, const Case& question, const EffectVocabulary& effects,
                               const RunLog& log) {
  return [=, &effects](ModelKind kind) -> std::unique_ptr<const Model> {
    if (kind != ModelKind::dem) return compare::make_model(kind);
    return flags.recorded.empty() ? running(flags, question, effects, log) : from_record(flags, question, log);
  };
}

compare::RunOnce run_with(const dem::DemSettings& settings, const Case& question, const EffectVocabulary& effects,
                          const fs::path& file, const Views& views) {
  compare::RunOnce run = [runs = std::make_shared<WatchedRuns>(settings, views)](
                             const Scenario& scenario, const OperatingCondition& at, std::uint64_t packing) {
    return (*runs)(scenario, at, packing);
  };
  if (file.empty()) return run;
  return compare::kept_runs(file, settings, question, effects, SOILBIN_VERSION, std::move(run));
}

std::optional<dem::StepCriteria> step_of(const SoilBinFlags& flags, const Case& question) {
  const auto& models = question.study.models;
  if (std::none_of(models.begin(), models.end(), [](const ModelChoice& c) { return c.model == ModelKind::dem; }))
    return std::nullopt;
  dem::DemSettings settings = settings_of(flags);
  if (!flags.recorded.empty())
    for (const auto& [name, value] : compare::read_record(flags.recorded).inputs)
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
      "{:.3g} s, "
      "{:.0f} steps\n",
      step.step, step.step / step.rayleigh, step.rayleigh, step.speed, step.hertz, step.hertz / step.step);
}

nlohmann::ordered_json to_json(const dem::StepCriteria& step) {
  return {{"time_step", step.step},
          {"rayleigh_time", step.rayleigh},
          {"impact_speed", step.speed},
          {"hertz_time", step.hertz}};
}

compare::Record read_record_aloud(const fs::path& file) {
  compare::Record record = compare::read_record(file);
  if (const std::string note = compare::unsealed_note(record, file); !note.empty())
    fmt::print(stderr, "note: {}\n", note);
  return record;
}

void tell_unsealed(const compare::ExperimentStore& store, const fs::path& file) {
  if (store.unsealed() > 0)
    fmt::print(stderr,
               "note: {}: {} of its {} experiments carry no seal, as from before there were any: damage to them can't "
               "be told\n",
               file.string(), store.unsealed(), store.size());
}

void forget_runs(const std::vector<compare::RecordedRun>& runs, const Outputs& outputs) {
  if (runs.empty()) return;
  if (!outputs.complete() || std::fflush(stdout) != 0) {
    fmt::print(stderr, "soilbin: {}\n", finished_runs_stay);
    return;
  }
  for (const compare::RecordedRun& run : runs)
    if (run.when_safe) run.when_safe();
}

std::string notes_on(const std::vector<compare::RecordedRun>& runs) {
  std::string notes;
  double seconds = 0;
  for (const compare::RecordedRun& run : runs) {
    seconds += run.seconds;
    if (run.answer.result && !run.steady)
      notes +=
          fmt::format("not steady at {}{}: halves differ by {:.3g} standard errors\n", compare::in_words(run.answer.at),
                      run.packing == 1 ? "" : fmt::format(", packing {}", run.packing), run.drift);
  }
  if (runs.empty()) return "";
  return notes + fmt::format("dem: {} run{}, {:.0f} s in all\n", runs.size(), runs.size() == 1 ? "" : "s", seconds);
}

}  // namespace soilbin::cli
