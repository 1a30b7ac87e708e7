#include "compare/experiments/run_plan.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <set>
#include <thread>

#include "compare/report/number_text.hpp"
#include "compare/report/table.hpp"
#include "compare/sweep/result_json.hpp"
#include "compare/sweep/varying.hpp"
#include "dem/bed/relative_density.hpp"
#include "dem/rig/wheel_in_bin.hpp"
#include "dem/rig/wheel_motion.hpp"
#include "scenario/errors.hpp"
#include "scenario/file_bytes.hpp"

namespace soilbin::compare {
namespace {

namespace fs = std::filesystem;

/// The packings whose beds are not in the folder of beds.
std::vector<std::uint64_t> without_file(const std::set<std::uint64_t>& packings, dem::DemSettings settings,
                                        const Scenario& scenario) {
  std::vector<std::uint64_t> missing;
  for (const std::uint64_t packing : packings) {
    settings.packing = packing;
    const fs::path file = dem::BedStore(settings.beds).file(dem::DemModel(settings).recipe(scenario));
    if (settings.beds.empty() || !is_there(file)) missing.push_back(packing);
  }
  return missing;
}

/// Speed of a thread of the engine over that of a process of LAMMPS, on settled beds of 11,333 to 400,000 grains
/// (docs/guide/past-one-machine.md, "When does it pay?").
constexpr double engine_over_lammps = 5;

/// Estimates for the runs of one scenario in one bin. Work counts in grain-steps: one step of the motion of one grain.
class RunCosts {
 public:
  /// The speed comes from the runs of `records` where they tell one: their seconds, as they were measured then, with
  /// however many threads and whatever ran beside them; else from a trial: a small bed of the same grains is settled
  /// for about a second of processor time on one thread, and more are taken to share the work evenly. LAMMPS is taken
  /// to be engine_over_lammps times slower than that, a process.
  RunCosts(const Scenario& scenario, const dem::DemSettings& settings, const std::vector<Record>& records);

  /// The cost of a run, in steps on as many grains as the soil's own.
  double steps(const RunSpec& run) const;
  /// On the clock on the wall, the bed already settled [s].
  double seconds(const RunSpec& run) const { return in_run_ * steps(run) / speed_; }
  /// To settle a bed, about: as long as grains take to fall by its depth, thirty times [s].
  double bed_seconds() const;
  int threads() const;  ///< of LAMMPS: processes
  void tell(RunPlan& plan) const;

 private:
  double trial(dem::DemSettings settings) const;  ///< grain-steps a second of one thread

  const Scenario& scenario_;
  const dem::DemSettings& settings_;
  dem::BedRecipe recipe_;
  double grains_ = 0, in_run_ = 0;  ///< grains that the bed and a run will hold, about
  double speed_ = 0;                ///< grain-steps a second
  std::size_t from_runs_ = 0;
};

RunCosts::RunCosts(const Scenario& scenario, const dem::DemSettings& settings, const std::vector<Record>& records)
    : scenario_(scenario),
      settings_(settings),
      recipe_(dem::DemModel(settings).recipe(scenario)),
      grains_(dem::expected_grains(recipe_)),
      in_run_(dem::DemModel(settings).grains_of_run(scenario)) {
  double work = 0, seconds = 0;
  for (const Record& record : records)
    for (const RunKind kind : run_kinds)
      for (const RecordedRun& run : record.list(kind)) {
        if (!run.answer.result) continue;  // it may have ended early
        work += in_run_ * steps({run.answer.at, run.packing, kind}), seconds += run.seconds;
        ++from_runs_;
      }
  speed_ = seconds > 0 ? work / seconds : trial(settings) * threads() / (settings.lammps ? engine_over_lammps : 1);
}

double RunCosts::steps(const RunSpec& run) const {
  const dem::DemModel model(settings_);
  if (run.kind != RunKind::coarser)
    return model.expected_steps(scenario_, run.at) * (run.kind == RunKind::half_step ? 2 : 1);
  const Scenario coarser = with_coarser_grains(scenario_);
  return model.expected_steps(coarser, run.at) * model.grains_of_run(coarser) / in_run_;
}

double RunCosts::bed_seconds() const {
  const double step = recipe_.dt > 0 ? recipe_.dt : dem::longest_step(recipe_.soil);
  const bool of_the_engine = settings_.lammps && settings_.settled_by == dem::SettledBy::soilbin;
  return grains_ * 30 * std::sqrt(2 * recipe_.size.depth / recipe_.gravity) / step /
         (speed_ * (of_the_engine ? engine_over_lammps : 1));
}

int RunCosts::threads() const {
  if (settings_.lammps) return settings_.lammps->ranks;
  return settings_.how.threads > 0 ? settings_.how.threads
                                   : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

/// Memory is that of a process while pairs are searched, which needs the most.
void RunCosts::tell(RunPlan& plan) const {
  plan.threads = threads(), plan.in_lammps = settings_.lammps.has_value(), plan.from_runs = from_runs_,
  plan.speed = speed_, plan.grains = in_run_;
  const double spheres = std::max(grains_, in_run_) * spheres_of(recipe_.soil.shape);
  plan.bed_seconds = bed_seconds(), plan.memory = 60e6 + 900 * spheres / (plan.in_lammps ? threads() : 1);
  plan.bed_bytes = 250 * spheres, plan.record_bytes = 40e3;
}

double RunCosts::trial(dem::DemSettings settings) const {
  const double grain = mean_diameter(recipe_.soil);
  dem::BedRecipe recipe = recipe_;
  recipe.size = {12 * grain, 12 * grain, 8 * grain};
  recipe.grading = {};  // there is no room for coarser ones
  recipe.settled_by = dem::SettledBy::soilbin;
  settings.how.progress = {};
  settings.how.threads = 1;                 // so small a bed keeps more than one waiting, which a run's does not
  const std::clock_t began = std::clock();  // of the processor: what runs beside it now will not run beside the jobs
  const dem::SettledBed bed = dem::settle_bed(recipe, settings.how);
  const double seconds = static_cast<double>(std::clock() - began) / CLOCKS_PER_SEC;
  const double step = recipe.dt > 0 ? recipe.dt : dem::longest_step(recipe.soil);
  return static_cast<double>(bed.report.grains) * bed.report.settling_time / step / seconds;
}

}  // namespace

std::size_t RunPlan::recorded() const {
  return static_cast<std::size_t>(std::ranges::count_if(runs, [](const auto& run) { return run.recorded; }));
}

double RunPlan::seconds_left() const {
  double sum = 0;
  for (const PlannedRun& run : runs) sum += run.recorded ? 0.0 : run.seconds;
  return sum;
}

double RunPlan::core_hours_left() const {
  return (seconds_left() + static_cast<double>(unsettled.size()) * bed_seconds) * threads / 3600;
}

namespace {

/// Why the soil bin has no answer at a condition, whatever the grains do; "" where it may have one.
std::string why_refused(const OperatingCondition& at, const Tire& tire) {
  try {
    dem::wheel_motion(at, tire.radius);
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

}  // namespace

RunPlan plan_of(const Case& question, const dem::DemSettings& settings, const std::vector<RunSpec>& specs,
                const RunKeeping& keeping) {
  std::vector<fs::path> files = keeping.known;
  if (is_there(keeping.record)) files.push_back(keeping.record);
  const Inputs inputs = inputs_of(settings, question.scenario);
  std::vector<Record> records;
  for (const fs::path& file : files) refuse_other_inputs(records.emplace_back(read_record(file)), inputs, file);
  dem::DemModel(settings).check(question.scenario);
  const RunCosts costs(question.scenario, settings, records);
  RunPlan plan{.study = question.study.name, .runs = {}};
  std::set<std::uint64_t> packings;
  for (const RunSpec& spec : specs) {
    packings.insert(spec.packing);
    PlannedRun planned{spec, missing_runs({spec}, records).empty(), 0, why_refused(spec.at, question.scenario.tire)};
    if (planned.refused.empty()) planned.seconds = costs.seconds(spec);
    plan.runs.push_back(std::move(planned));
  }
  plan.beds = packings.size(), plan.unsettled = without_file(packings, settings, question.scenario);
  plan.density_limits =
      !settings.beds.empty() && dem::has_density_limits(*question.scenario.soil.granular, dem::BedStore(settings.beds));
  costs.tell(plan);
  return plan;
}

std::string plan_text(const RunPlan& plan) {
  Table table{"", {"run", "bed sample", "condition", "time"}};
  for (std::size_t k = 0; k < plan.runs.size(); ++k) {
    const PlannedRun& planned = plan.runs[k];
    table.add({std::to_string(k + 1), std::to_string(planned.packing),
               in_words(planned.at) + (planned.of_tire.empty() ? "" : ", " + planned.of_tire) +
                   (planned.kind == RunKind::half_step ? ", half the time step" : "") +
                   (planned.kind == RunKind::coarser ? ", coarser grains" : ""),
               planned.recorded          ? "recorded"
               : planned.refused.empty() ? duration_text(planned.seconds)
                                         : "no answer: " + planned.refused});
  }
  const std::size_t recorded = plan.recorded(), left = plan.runs.size() - recorded;
  std::string text = fmt::format("{}: {} of grains on {}\n\n{}\n", plan.study, counted(plan.runs.size(), "run"),
                                 counted(plan.beds, "bed"), as_text(table));
  text += fmt::format("recorded  {}\nto make   {}\n", recorded, left);
  const bool twins = std::ranges::any_of(plan.runs, [](const auto& run) { return run.kind == RunKind::coarser; });
  text += fmt::format("beds      {} to settle, {} each{}{}\n", plan.unsettled.size(), duration_text(plan.bed_seconds),
                      twins ? ", and as many of coarser grains" : "",
                      plan.density_limits ? "" : "; soilbin bed settles two small ones as well, to tell their density");
  text += fmt::format(
      "time      about {:.2g} core-hours, {} ({}: {:.2g} million grain-steps a second, {:.0f} grains)\n",
      plan.core_hours_left(),
      plan.in_lammps ? fmt::format("{} process{} of LAMMPS a run", plan.threads, plan.threads == 1 ? "" : "es")
                     : counted(static_cast<std::size_t>(plan.threads), "thread") + " a process",
      plan.from_runs > 0 ? "from " + counted(plan.from_runs, "recorded run") : "from a trial on this machine",
      plan.speed / 1e6, plan.grains);
  text +=
      fmt::format("memory    about {} a process\ndisk      about {} a bed, {} for the record\n", size_text(plan.memory),
                  size_text(plan.bed_bytes), size_text(plan.record_bytes * static_cast<double>(plan.runs.size())));
  return text;
}

Json plan_json(const RunPlan& plan) {
  Json runs = Json::array();
  for (const PlannedRun& planned : plan.runs) {
    Json row = to_json(planned.at);
    row["packing"] = planned.packing;
    row["half_step"] = planned.kind == RunKind::half_step, row["coarser"] = planned.kind == RunKind::coarser;
    row["recorded"] = planned.recorded, row["seconds"] = planned.seconds;
    if (!planned.refused.empty()) row["refused"] = planned.refused;
    if (!planned.of_tire.empty()) row["tire"] = planned.of_tire;
    runs.push_back(row);
  }
  return {{"format", "soilbin-plan/1"},
          {"study", plan.study},
          {"recorded", plan.recorded()},
          {"beds", plan.beds},
          {"beds_to_settle", plan.unsettled},
          {"threads", plan.threads},
          {"core_hours_left", plan.core_hours_left()},
          {"seconds_a_bed", plan.bed_seconds},
          {"grain_steps_a_second", plan.speed},
          {"from_recorded_runs", plan.from_runs},
          {"bytes_a_process", plan.memory},
          {"bytes_a_bed", plan.bed_bytes},
          {"runs", runs}};
}

}  // namespace soilbin::compare
