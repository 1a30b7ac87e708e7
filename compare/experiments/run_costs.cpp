#include "compare/experiments/run_costs.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <thread>

#include "dem/rig/step_criteria.hpp"
#include "dem/rig/wheel_in_bin.hpp"
#include "dem/rig/wheel_motion.hpp"

namespace soilbin::compare {
RunCosts::RunCosts(const Scenario& scenario, const dem::DemSettings& settings, const std::vector<Record>& records)
    : scenario_(scenario),
      settings_(settings),
      recipe_(dem::DemModel(settings).recipe(scenario)),
      grains_(dem::expected_grains(recipe_)) {
  double work = 0, seconds = 0;
  for (const Record& record : records)
    for (RunList list : {&Record::runs, &Record::half_step})
      for (const RecordedRun& run : record.*list) {
        if (!run.answer.result) continue;  // it may have ended early
        work += grains_ * steps({run.answer.at, run.packing, list == &Record::half_step}), seconds += run.seconds;
        ++from_runs_;
      }
  speed_ = seconds > 0 ? work / seconds : trial(settings);
}

double RunCosts::steps(const AskedRun& run) const {
  const dem::Rig& rig = settings_.rig;
  const OperatingCondition& at = run.at;
  const double way = dem::way_in_bin(recipe_.size, scenario_.tire, rig);
  const bool inclined = at.longitudinal_incline != 0 || at.transverse_incline != 0;
  const double driven = (way - at.speed * rig.starting / 2) / at.speed;
  const double time =
      (inclined ? rig.tilting : 0.0) + at.pass * (rig.lowering + rig.resting + rig.starting + std::max(0.0, driven));
  return time / dem::step_of(recipe_, rig) * (run.half_step ? 2 : 1);
}

double RunCosts::bed_seconds() const {
  const double step = recipe_.dt > 0 ? recipe_.dt : dem::longest_step(recipe_.soil);
  return grains_ * 30 * std::sqrt(2 * recipe_.size.depth / recipe_.gravity) / step / speed_;
}

int RunCosts::threads() const {
  return settings_.how.threads > 0 ? settings_.how.threads
                                   : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

double RunCosts::memory() const { return 60e6 + 900 * grains_; }

double RunCosts::bed_bytes() const { return 250 * grains_; }

double RunCosts::trial(dem::DemSettings settings) const {
  const double grain = mean_diameter(recipe_.soil);
  dem::BedRecipe recipe = recipe_;
  recipe.size = {12 * grain, 12 * grain, 8 * grain};
  recipe.grading = {};  // there is no room for coarser ones
  settings.how.progress = {};
  settings.how.threads = 1;                 // so small a bed keeps more than one waiting, which a run's does not
  const std::clock_t began = std::clock();  // of the processor: what runs beside it now will not run beside the jobs
  const dem::SettledBed bed = dem::settle_bed(recipe, settings.how);
  const double seconds = static_cast<double>(std::clock() - began) / CLOCKS_PER_SEC / threads();
  const double step = recipe.dt > 0 ? recipe.dt : dem::longest_step(recipe.soil);
  return static_cast<double>(bed.report.grains) * bed.report.settling_time / step / seconds;
}

}  // namespace soilbin::compare
