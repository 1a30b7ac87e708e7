// The figures of a comparison: curves of all sides, heat maps of differences, stresses, contact angles, sinkage,
// budget.
#pragma once

#include "compare/discrepancy/comparison.hpp"
#include "compare/report/bars.hpp"
#include "compare/report/heat_map.hpp"
#include "compare/report/plot.hpp"

namespace soilbin::compare {

/// The analytic sides along many slips of each curve, for smooth lines; no other side. No side at all where the
/// comparison does not tell their models.
Comparison smooth_sides(const Comparison& comparison);

/// All curves of all sides, as study_sheet draws them; grains with points on their lines, measurements as points. The
/// analytic sides are drawn by `smooth` where it has them.
Sheet overview_sheet(const Comparison& comparison, const Comparison& smooth = {});

/// One curve: each channel against slip, a colour for each side, with bands of one standard error. What limits grains
/// is marked: in the legend where it holds for all their points (one packing each, grains too coarse), else and for a
/// negative sinkage at the points. The analytic sides are drawn by `smooth` where it has them.
Sheet curve_sheet(const Comparison& comparison, std::size_t curve, bool coarse_grains = false,
                  const Comparison& smooth = {});

/// One curve: entry, largest stress and exit angle; sinkage at slip 0 and what slip adds to it.
Sheet contact_sheet(const Comparison& comparison, std::size_t curve);

/// Stresses under the wheel at one condition, sigma(theta) and tau(theta); no plots where no side tells them.
Sheet stress_sheet(const Comparison& comparison, std::size_t condition);

/// A pair and channel: differences in shares of the load, slip by curve; what is no difference is drawn faint.
HeatMap heat_map_of(const Comparison& comparison, const Tally& tally);

/// Parts of the pull at one condition, and the colours of their sides.
std::pair<Bars, std::vector<int>> budget_bars(const Comparison& comparison, std::size_t condition);

}  // namespace soilbin::compare
