#include "dem/rig/wheel_run.hpp"

#include "dem/rig/run_inputs.hpp"
#include "dem/rig/wheel_in_bin.hpp"
#include "dem/rig/wheel_run_stages.hpp"

namespace soilbin::dem {

WheelRun run_wheel(const WheelOnBed& on, const OperatingCondition& at, const WorkOptions& how,
                   const Checkpoints& checkpoints) {
  check_patch(on.rig);
  return WheelRunStages<StagedRun>(on, at,
                                   [&] {
                                     const BedRecipe& recipe = on.bed.recipe;
                                     return staged_run(on, how, checkpoints,
                                                       inputs_text(recipe, on.tire, on.contact, on.rig, at));
                                   })
      .run();
}

}  // namespace soilbin::dem
