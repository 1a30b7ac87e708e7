#include "dem/rig/dem_model.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "dem/rig/run_inputs.hpp"
#include "dem/rig/staged_run.hpp"
#include "dem/rig/step_criteria.hpp"
#include "dem/rig/wheel_in_bin.hpp"
#include "scenario/errors.hpp"

namespace soilbin::dem {

namespace fs = std::filesystem;

BedRecipe DemModel::recipe(const Scenario& scenario) const {
  if (const TireMeshing& meshing = settings_.rig.meshing; !meshing.drawn.empty())
    tire_surface(scenario.tire, meshing);  // refused before a bed is settled
  BedRecipe recipe;
  recipe.soil = grains_of(scenario.soil);
  recipe.gravity = gravity_on(recipe.soil);
  static_cast<LawFlags&>(recipe.laws) = laws_of(recipe.soil);
  recipe.size = settings_.size;
  if (scenario.bin) recipe.size.depth = scenario.bin->depth, recipe.size.width = scenario.bin->width;
  recipe.packing = settings_.packing;
  Tire on_bed = scenario.tire;
  on_bed.lugs.height = std::max(on_bed.lugs.height, settings_.highest_lugs);
  recipe.grading = grading_for(on_bed, recipe.soil, settings_.graded);
  recipe.settling_friction = settings_.settling_friction;
  recipe.settled_by = settings_.settled_by;
  recipe.periodic = settings_.rig.patch;
  recipe.dt = settings_.bed_dt.value_or(settings_.rig.dt);
  return recipe;
}

std::shared_ptr<const SettledBed> DemModel::bed(const BedRecipe& recipe) const {
  if (recipe.settled_by == SettledBy::soilbin) return beds_.bed(recipe, settings_.how);
  return std::make_shared<const SettledBed>(
      bed_in_lammps(settings_.lammps.value(), recipe, settings_.beds, settings_.how));
}

void DemModel::check(const Scenario& scenario) const {
  const BedRecipe asked = recipe(scenario);
  if (settings_.rig.patch && settings_.lammps)
    throw InputError("a moving patch is simulated by soilbin's own engine alone\n  hint: leave out --engine lammps");
  way_in_bin(asked.size, scenario.tire, settings_.rig);
  if (!(settings_.rig.dt >= 0))
    throw InputError(fmt::format("a time step of {} s: above 0, or 0 for the longest that is safe", settings_.rig.dt));
  dem::check(asked);
  // The smallest grain of a bed is a little larger than radius_min: by how much, the engine sees.
  const double step = std::max(asked.dt, step_of(asked, settings_.rig)), usual = longest_step(asked.soil);
  if (step > 1.1 * usual)
    throw InputError(fmt::format(
        "a time step of {:.3g} s is too long: it is {:.3g} of the Rayleigh time of these grains, {:.3g} s, and "
        "{:.3g} of it is safe\n  hint: --time-step {:.3g}ms or less",
        step, step / usual * Numerics{}.safe_share, usual / Numerics{}.safe_share, Numerics{}.safe_share, 1e3 * usual));
}

double DemModel::expected_steps(const Scenario& scenario, const OperatingCondition& at) const {
  const Rig& rig = settings_.rig;
  const BedRecipe asked = recipe(scenario);
  const bool inclined = at.longitudinal_incline != 0 || at.transverse_incline != 0;
  const double way = way_in_bin(asked.size, scenario.tire, rig);
  const double driven = (way - at.speed * rig.starting / 2) / at.speed;
  const double time =
      (inclined ? rig.tilting : 0.0) + at.pass * (rig.lowering + rig.resting + rig.starting + std::max(0.0, driven));
  return time / step_of(asked, rig);
}

namespace {

constexpr double most_steps = 1e10;  // of a run: at a million a second, of a few grains, three hours

void check_steps(double steps, double step, const char* hint) {
  if (!(steps <= most_steps))
    throw InputError(fmt::format("this takes {:.2g} time steps of {:.2g} s, and {:.0e} at most make sense\n  hint: {}",
                                 steps, step, most_steps, hint));
}

}  // namespace

void DemModel::check(const Scenario& scenario, const OperatingCondition& at) const {
  wheel_motion(at, scenario.tire.radius);
  check_patch(settings_.rig);
  check(scenario);
  check_steps(expected_steps(scenario, at), step_of(recipe(scenario), settings_.rig),
              "a higher speed, a shorter way (--travel), shorter times of the rig, fewer passes");
}

TractionResult DemModel::evaluate(const Scenario& scenario, const OperatingCondition& at) const {
  if (!scenario.effects.empty())
    throw InputError("dem takes no effects, but '" + scenario.effects.front().id + "' is switched on");
  const BedRecipe asked = recipe(scenario);
  if (settings_.lammps) refuse_beyond_lammps(asked.soil);
  check(scenario, at);  // before a bed is settled for it
  const auto bed = this->bed(asked);
  const ContactPair& contact = scenario.soil.granular->grain_tire;
  const Checkpoints kept = checkpoints_of(scenario, at);
  const auto finished = [&] {
    if (settings_.forget_finished) forget_run(kept.restart);
  };
  WheelRun run;
  try {
    const WheelOnBed on{*bed, scenario.tire, contact, settings_.rig};
    run = settings_.lammps ? run_in_lammps(*settings_.lammps, on, at, settings_.how, kept)
                           : run_wheel(on, at, settings_.how, kept);
  } catch (const NoSolution&) {
    finished();
    throw;
  } catch (const OverlapTooDeep& stopped) {
    finished();
    throw RunStopped(fmt::format("{}; or a larger --deepest-overlap", stopped.what()));
  } catch (const RunStopped&) {
    finished();
    throw;
  }
  tell_of_ends(scenario.tire, run.result.sinkage.value);
  tell_of_patch(run, asked);
  if (settings_.on_run) settings_.on_run(run);
  finished();
  return run.result;
}

void DemModel::tell_of_ends(const Tire& tire, double sinkage) const {
  const Rig& rig = settings_.rig;
  const double reach = reach_at(tire, sinkage);
  if (!settings_.how.tell || reach <= std::min(rig.behind, rig.ahead)) return;
  settings_.how.tell(fmt::format(
      "note: the sunken wheel reaches {:.3g} m from its axle at the height of the soil, and the ends of the bin "
      "are nearer where it begins or ends (--behind {:.3g} m, --ahead {:.3g} m): it had too little soil there",
      reach, rig.behind, rig.ahead));
}

void DemModel::tell_of_patch(const WheelRun& run, const BedRecipe& bed) const {
  constexpr double much = 0.1;  // mean diameters (chosen; docs/lab/soil-bin.md, 'A moving patch')
  const double share = run.patch.disturbed / mean_diameter(bed.soil);
  if (run.patch.grains == 0 || !settings_.how.tell) return;
  const double error = run.result.drawbar_pull.std_error / run.result.at.load;
  if (settings_.rig.travel == 0 && !(error <= settings_.rig.until_error))
    settings_.how.tell(
        fmt::format("note: after {:.3g} m, the longest way on a patch, the mean pull is known to {:.2g} of the load, "
                    "not to {:.2g}\n"
                    "  hint: --packings, or a larger --until-error",
                    run.samples.back().travel, error, settings_.rig.until_error));
  if (share < much) return;
  settings_.how.tell(fmt::format(
      "note: where the patch ends ahead, the wheel had moved the soil by {:.2g} of a grain's diameter: that end is too "
      "near\n  hint: more than --ahead {:.4g}m",
      share, settings_.rig.ahead));
}

double DemModel::grains_of_run(const Scenario& scenario) const {
  const BedRecipe asked = recipe(scenario);
  const Rig& rig = settings_.rig;
  const double patch = rig.behind + rig.ahead + 2 * slab_of_patch(asked);
  return expected_grains(asked) * (rig.patch ? patch / asked.size.length : 1);
}

GrainDriveRecord DemModel::drive(const Scenario& scenario, const Drive& drive, int samples) const {
  check_drive(drive);
  if (settings_.lammps) throw InputError("a wheel that is free along the bin is driven by the engine alone");
  if (settings_.rig.patch)
    throw InputError("a drive has no moving patch: its wheel may turn back\n  hint: leave out --patch");
  check(scenario);
  const double step = step_of(recipe(scenario), settings_.rig);
  check_steps(drive.duration / step, step, "a shorter duration of the drive");
  const auto bed = beds_.bed(recipe(scenario), settings_.how);
  return drive_freely({*bed, scenario.tire, scenario.soil.granular->grain_tire, settings_.rig}, drive, samples,
                      settings_.how, checkpoints_of(scenario, drive, samples));
}

fs::path DemModel::restart_of(const Scenario& scenario, const OperatingCondition& at) const {
  return checkpoints_of(scenario, at).restart;
}

void DemModel::forget(const Scenario& scenario, const Drive& drive, int samples) const {
  forget_run(checkpoints_of(scenario, drive, samples).restart);
}

Checkpoints DemModel::checkpoints(const std::string& kind, const std::string& inputs) const {
  Checkpoints file = settings_.checkpoints;
  if (!file.restart.empty()) file.restart /= fmt::format("{}-{}.h5", kind, key_of(inputs));
  return file;
}

Checkpoints DemModel::checkpoints_of(const Scenario& scenario, const OperatingCondition& at) const {
  const BedRecipe bed = recipe(scenario);
  return checkpoints("run", inputs_text(bed, scenario.tire, bed.soil.grain_tire, settings_.rig, at));
}

Checkpoints DemModel::checkpoints_of(const Scenario& scenario, const Drive& drive, int samples) const {
  const BedRecipe bed = recipe(scenario);
  return checkpoints("drive", inputs_text(bed, scenario.tire, bed.soil.grain_tire, settings_.rig, drive, samples));
}

}  // namespace soilbin::dem
