#include "dem/rig/dem_model.hpp"

#include <fmt/core.h>

#include "scenario/errors.hpp"

namespace soilbin::dem {

BedRecipe DemModel::recipe(const Scenario& scenario) const {
  if (!scenario.soil.granular)
    throw InputError("soil '" + scenario.soil.name + "' has no granular values, which dem needs");
  BedRecipe recipe;
  recipe.soil = *scenario.soil.granular;
  recipe.laws.rolling = rolling_law(recipe.soil.rolling_resistance);
  recipe.size = settings_.size;
  if (scenario.bin) recipe.size.depth = scenario.bin->depth, recipe.size.width = scenario.bin->width;
  recipe.packing = settings_.packing;
  recipe.settling_friction = settings_.settling_friction;
  recipe.dt = settings_.rig.dt;
  return recipe;
}

TractionResult DemModel::evaluate(const Scenario& scenario, const OperatingCondition& at) const {
  if (!scenario.effects.empty())
    throw InputError("dem takes no effects, but '" + scenario.effects.front().id + "' is switched on");
  wheel_motion(at, scenario.tire.radius);  // refuses what can't be run before a bed is settled for it
  const auto bed = beds_.bed(recipe(scenario), settings_.how);
  const WheelRun run =
      run_wheel(*bed, scenario.tire, scenario.soil.granular->grain_tire, at, settings_.rig, settings_.how);
  if (settings_.on_run) settings_.on_run(run);
  if (settings_.only_steady && !run.steady)
    throw NoSolution(
        fmt::format("the run did not become steady: its halves differ by {:.3g} standard errors, {:.3g} is "
                    "allowed\n  hint: a longer bed",
                    run.drift, settings_.rig.steady_drift));
  return run.result;
}

GrainDriveRecord DemModel::drive(const Scenario& scenario, const Drive& drive, int samples) const {
  check_drive(drive);
  const auto bed = beds_.bed(recipe(scenario), settings_.how);
  return drive_freely(*bed, scenario.tire, scenario.soil.granular->grain_tire, drive, settings_.rig, samples,
                      settings_.how);
}

}  // namespace soilbin::dem
