#include "dem/rig/wheel_in_bin.hpp"

#include <fmt/core.h>

#include <cmath>

#include "scenario/errors.hpp"

namespace soilbin::dem {

Setup run_setup(const WheelOnBed& on, int threads) {
  Setup setup = on.bed.setup;
  const int tire = setup.materials.add({"tire", 1100, on.rig.young, on.rig.poisson});
  setup.materials.set(grain_material, tire, interaction_of(on.contact));
  setup.laws = with_cohesion_of(on.contact, setup.laws);
  if (on.rig.dt > 0) setup.numerics.dt = on.rig.dt;
  setup.numerics.skin = on.rig.skin * on.bed.recipe.soil.radius_max;
  setup.numerics.threads = threads;
  setup.numerics.deepest_overlap = on.rig.deepest_overlap;
  setup.numerics.ledger = on.rig.ledger;
  const double g = on.bed.recipe.gravity, d = mean_diameter(on.bed.recipe.soil);
  setup.numerics.sleep = {on.rig.sleep_speed * std::sqrt(g * d), on.rig.sleep_time * std::sqrt(d / g)};
  return setup;
}

double way_in_bin(const BedSize& size, const Tire& tire, const Rig& rig) {
  const double room = size.length - rig.behind - rig.ahead;
  const double way = rig.travel > 0 ? std::min(rig.travel, room) : room;
  if (way <= 0)
    throw InputError(
        fmt::format("a bed of {:.4g} m leaves the wheel no way: "
                    "{:.4g} m behind and {:.4g} m ahead are kept"
                    "\n  hint: --bed-length above {:.4g} m, or less --behind and --ahead",
                    size.length, rig.behind, rig.ahead, rig.behind + rig.ahead));
  if (size.width < 1.4999 * tire.width)  // 150 mm is 1.5 times 100 mm, whatever rounding says
    throw InputError(
        fmt::format("a bed {:.4g} m wide is too narrow for a tire "
                    "of {:.4g} m: at least 1.5 times its width",
                    size.width, tire.width));
  return way;
}

StagedRun staged_run(const WheelOnBed& on, const WorkOptions& how, const Checkpoints& checkpoints, std::string inputs) {
  return StagedRun(checkpoints, std::move(inputs), how,
                   [&] { return Simulation(run_setup(on, how.threads), on.bed.state); });
}

template class WheelInBinOf<StagedRun>;

}  // namespace soilbin::dem
