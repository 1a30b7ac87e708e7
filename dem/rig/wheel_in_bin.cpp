#include "dem/rig/wheel_in_bin.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "scenario/errors.hpp"

namespace soilbin::dem {

Setup run_setup(const WheelOnBed& on, int threads) {
  Setup setup = on.bed.setup;
  const int tire = setup.materials.add({"tire", 1100, tire_young, tire_poisson});
  setup.materials.set(grain_material, tire, interaction_of(on.contact));
  setup.laws = with_cohesion_of(on.contact, setup.laws);
  if (on.rig.dt > 0) setup.numerics.dt = on.rig.dt;
  setup.numerics.skin = on.rig.skin * on.bed.recipe.soil.radius_max;
  setup.numerics.threads = threads;
  setup.numerics.deepest_overlap = on.rig.deepest_overlap;
  setup.numerics.ledger = on.rig.ledger;
  const double g = on.bed.recipe.gravity, d = mean_diameter(on.bed.recipe.soil);
  setup.numerics.sleep = {on.rig.sleep_speed * std::sqrt(g * d), sleep_time * std::sqrt(d / g)};
  return setup;
}

namespace {

/// Refuses a bed too narrow for the wheel.
void check_width(const BedSize& size, const Tire& tire) {
  if (size.width < 1.4999 * tire.width)  // 150 mm is 1.5 times 100 mm, whatever rounding says
    throw InputError(
        fmt::format("a bed {:.4g} m wide is too narrow for a tire "
                    "of {:.4g} m: at least 1.5 times its width"
                    "\n  hint: --bed-width {:.4g}m",
                    size.width, tire.width, 1.5 * tire.width));
}

/// Refuses a wheel that stands in an end wall. `flag`: --behind or --ahead; `room`: from the axle to that wall [m].
void check_end(const char* flag, double room, const Tire& tire) {
  const double outer = outer_radius(tire);
  if (room >= least_room * outer) return;
  throw InputError(fmt::format(
      "{} {:.4g} m: that near to the end of the bin the wheel, of {:.4g} m outer radius, would hang over the end wall "
      "as soon as it has sunk by {:.2g} m\n  hint: {} {:.4g}m, the outer radius, or more; {:.4g}m at least",
      flag, room, outer, outer - std::sqrt(outer * outer - room * room), flag, outer, least_room * outer));
}

}  // namespace

double way_in_bin(const BedSize& size, const Tire& tire, const Rig& rig) {
  if (rig.patch) {
    check_end("--behind", rig.behind, tire), check_end("--ahead", rig.ahead, tire);
    check_width(size, tire);
    return rig.travel > 0 ? rig.travel : longest_way_on_patch * outer_radius(tire);
  }
  const double room = size.length - rig.behind - rig.ahead;
  if (room <= 0)
    throw InputError(
        fmt::format("a bed of {:.4g} m leaves the wheel no way: --behind keeps {:.4g} m and --ahead {:.4g} m\n  hint: "
                    "--bed-length above {:.4g} m, or less --behind and --ahead",
                    size.length, rig.behind, rig.ahead, rig.behind + rig.ahead));
  check_end("--behind", rig.behind, tire), check_end("--ahead", rig.ahead, tire);
  if (rig.travel > room * (1 + 1e-9))  // whatever rounding says
    throw InputError(fmt::format(
        "--travel {:.4g} m is more than the {:.4g} m that a bed of {:.4g} m leaves: --behind keeps {:.4g} m "
        "and --ahead {:.4g} m\n  hint: --bed-length {:.4g}m, or a shorter --travel",
        rig.travel, room, size.length, rig.behind, rig.ahead, rig.behind + rig.travel + rig.ahead));
  check_width(size, tire);
  return rig.travel > 0 ? std::min(rig.travel, room) : room;
}

void check_patch(const Rig& rig) {
  if (rig.patch && !(rig.until_error > 0 && rig.until_error < 1))
    throw InputError(
        fmt::format("an error of the mean pull of {:.4g} of the load: above 0 and below 1", rig.until_error));
}

double reach_at(const Tire& tire, double sinkage) {
  const double outer = outer_radius(tire), above = std::clamp(tire.radius - sinkage, 0.0, outer);
  return std::sqrt(outer * outer - above * above);
}

StagedRun staged_run(const WheelOnBed& on, const WorkOptions& how, const Checkpoints& checkpoints, std::string inputs) {
  return StagedRun(checkpoints, std::move(inputs), how,
                   [&] { return Simulation(run_setup(on, how.threads), on.bed.state); });
}

template class WheelInBinOf<StagedRun>;

}  // namespace soilbin::dem
