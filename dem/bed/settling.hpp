// The stages in which grains become a bed, whoever moves them: they fall, with as much friction as the recipe lets act
// meanwhile; what stands above the depth is taken away; the rest settles again, with all of it.
//
//   BedRun run(simulation, how);                 // once, loop, step, keep, simulation(): as RunStages has them
//   Settling<BedRun>(recipe, run).settle();
//
// Engines answer four questions about all grains: watched and unrest_since (bed_report.hpp), mean_height
// and remove_above.
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "dem/bed/settled_bed.hpp"
#include "scenario/errors.hpp"

namespace soilbin::dem {

/// Mean height of the surface over a footprint, of grains that lie below `cut` as a whole [m].
double mean_height(const Simulation& simulation, const Footprint& over, double spacing, double cut);
/// Takes away the others.
void remove_above(Simulation& simulation, double cut);

inline std::string number_or_words(double value) {
  return std::isfinite(value) ? fmt::format("{:.3g}", value) : "without bounds";
}

template <class Run>
class Settling {
 public:
  /// Both must outlive it.
  Settling(const BedRecipe& recipe, Run& run) : recipe_(recipe), run_(run) { run_.keep("settling", *this); }

  /// Throws RunStopped where no rest is found, and Stopped.
  void settle();
  /// At the last test.
  const Unrest& unrest() const { return now_; }

  /// For RunStages::keep.
  template <class Notes>
  void state(Notes& notes) {
    notes(begun_, taken_, rests_, now_.kinetic, now_.unbalanced);
  }

 private:
  void come_to_rest(const RestTest& test, double done, double share);
  void level();

  const BedRecipe& recipe_;
  Run& run_;
  double begun_ = 0;        ///< of this stage [s]
  std::int64_t taken_ = 0;  ///< steps since the last test
  bool rests_ = false;
  Unrest now_;
};

/// Steps until the test of rest holds, which looks at the last steps of each of its intervals.
template <class Run>
void Settling<Run>::come_to_rest(const RestTest& test, double done, double share) {
  constexpr int looking = 16;  // steps
  auto& simulation = run_.simulation();
  const auto steps = std::max<std::int64_t>(0, std::llround(test.every / simulation.setup().numerics.dt) - looking);
  std::optional<decltype(watched(simulation))> before;
  run_.once([&] { begun_ = simulation.time(), taken_ = 0, rests_ = false, now_ = {}; });
  if (taken_ > steps) taken_ = 0;  // gone on with while it was looking: at the next one
  run_.loop(
      "settling", [&] { return !rests_; },
      [&] {
        if (taken_ == steps) before = watched(simulation);
        run_.step();
        if (++taken_ < steps + looking) return;
        now_ = unrest_since(simulation, *before, looking), taken_ = 0;
        rests_ = now_.kinetic < test.kinetic && now_.unbalanced < test.unbalanced;
        if (rests_ || simulation.time() - begun_ < test.at_most) return;
        throw RunStopped(fmt::format(
            "the bed did not come to rest in {:.3g} s: kinetic {} (asked {:.3g}), unbalanced {} (asked {:.3g})\n"
            "  hint: a shorter time step, or a looser test",
            test.at_most, number_or_words(now_.kinetic), test.kinetic, number_or_words(now_.unbalanced),
            test.unbalanced));
      },
      [&] {  // kinetic energy falls by orders of magnitude; how many are left is the share left
        const double orders = now_.kinetic > 0 ? std::log10(now_.kinetic / test.kinetic) / 7 : 1;
        return done + share * (1 - std::clamp(orders, 0.0, 1.0));
      });
}

/// Takes away grains above a height chosen such that the surface seen from above comes to the depth on average.
template <class Run>
void Settling<Run>::level() {
  const BedSize& size = recipe_.size;
  const double radius = mean_diameter(recipe_.soil) / 2, coarse = recipe_.grading.factor * radius;
  const Footprint over{radius, size.length - radius, radius, size.width - radius};
  const auto mean_below = [&](double cut) { return mean_height(run_.simulation(), over, radius / 4, cut); };
  double low = size.depth - 2 * coarse, high = size.depth + 4 * coarse;
  if (const double mean = mean_below(high); mean < size.depth)
    throw RunStopped(fmt::format("the settled grains fill the bin only to {} m", number_or_words(mean)));
  for (int turn = 0; turn < 12; ++turn) {
    const double middle = (low + high) / 2;
    (mean_below(middle) < size.depth ? low : high) = middle;
  }
  remove_above(run_.simulation(), high);
}

template <class Run>
void Settling<Run>::settle() {
  const Interaction full = interaction_of(recipe_.soil.grain_grain);
  Interaction falling = full;
  falling.sliding_friction *= recipe_.settling_friction, falling.rolling_friction *= recipe_.settling_friction;
  constexpr double before_levelling = 100;  // so much less rest is asked for, as levelling disturbs it anyway
  RestTest poured = recipe_.rest;
  poured.kinetic *= before_levelling, poured.unbalanced *= before_levelling;
  run_.simulation().set_interaction(grain_material, grain_material, falling);
  come_to_rest(poured, 0.0, 0.8);
  run_.simulation().set_interaction(grain_material, grain_material, full);
  run_.once([&] { level(); });
  come_to_rest(recipe_.rest, 0.8, 0.2);
}

}  // namespace soilbin::dem
