// Whether grains can stand for soil under a wheel: a part of the list of doubts (doubts.hpp).
#pragma once

#include <optional>
#include <vector>

#include "compare/doubts/doubt.hpp"
#include "compare/sweep/answers.hpp"

namespace soilbin::compare {

/// How many grains of the mean diameter a wheel's lengths hold.
struct GrainCounts {
  double diameter = 0.0;          ///< mean, of radii that are uniform between two bounds [m]
  double width = 0.0;             ///< across the tread
  std::optional<double> contact;  ///< along the shortest contact of the answers
  OperatingCondition at;          ///< where that is
  std::optional<double> lug;      ///< in a lug's height; none for a smooth wheel
};

/// Fewest grains that are wanted. Across and along: 10, as a shear box is wanted to be 10 largest grains wide (after
/// ASTM D3080). A lug of less than a grain (chosen) digs nothing.
inline constexpr double grains_wanted = 10.0, grains_wanted_in_a_lug = 1.0;

/// Counts them. The contact reaches from the lowest point to where the undisturbed surface meets the wheel,
/// r acos(1 - z/r) with the answer's sinkage z; those of grains are taken where there are any.
GrainCounts count_grains(const Scenario& scenario, const std::vector<ModelAnswers>& study);

/// One on grains that are coarse for the wheel: what that is estimated to do to the answer where that is most, and how
/// many lie along its lengths. None where they are fine or the soil has none. Of several studies of one wheel: their
/// answers together.
Doubts coarse_grain_doubts(const Scenario& scenario, const std::vector<ModelAnswers>& study);

/// Whether they are.
bool grains_are_coarse(const Scenario& scenario, const std::vector<ModelAnswers>& study);

/// Mean overlap of grains, over their radius, beyond which they are doubted (chosen): a run stops where two overlap by
/// half a radius, and single contacts bear several times the mean.
inline constexpr double deep_overlap = 0.2;

/// One on grains that the wheel's pressure presses into each other by more than deep_overlap, where that is
/// most. The contact's length follows from the answers' sinkage; where there are none, half the wheel's radius is taken
/// at each of the conditions. None elsewhere.
Doubts soft_grain_doubts(const Scenario& scenario, const std::vector<OperatingCondition>& conditions,
                         const std::vector<ModelAnswers>& study);

/// Bed's width over the tire's, below which its walls are doubted (chosen). At 2 they held the soil; the paper's
/// results were had at 2.6 (docs/lab/grain-size.md).
inline constexpr double wide_bed = 2.5;

/// One on a bed of this width [m] whose walls are near the tire.
Doubts narrow_bed_doubts(const Tire& tire, double bed_width);

/// Doubts of the values by themselves: a density that no grain has, friction of more than any rock's, radii that differ
/// by so much that runs take very long, cohesion that presses grains into each other by more than deep_overlap; the
/// directional rolling laws, whose answers depend on the time step, with where they turn into a dashpot.
Doubts grain_value_doubts(const GranularSoil& grains);

/// Each kind once: grain_value_doubts, soft_grain_doubts, coarse_grain_doubts. None where the soil has no grains.
Doubts grain_doubts(const Scenario& scenario, const std::vector<OperatingCondition>& conditions,
                    const std::vector<ModelAnswers>& study);

}  // namespace soilbin::compare
