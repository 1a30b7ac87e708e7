// The figures of a comparison: curves of all sides, heat maps of differences, stresses, contact angles, sinkage,
// budget.
#pragma once

#include "compare/discrepancy/comparison.hpp"
#include "compare/report/bars.hpp"
#include "compare/report/heat_map.hpp"
#include "compare/report/plot.hpp"
#include "compare/report/table.hpp"

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

// The tables of a comparison, for its page and its Markdown.

/// A pair and channel a row, the widest apart first: how many differ, root mean square, mean, the widest condition.
/// Good where the root mean square is no larger than the stated errors make it, bad where it is and any row differs.
Table tally_table(const Comparison& comparison);
/// The rows of one pair and channel.
Table rows_table(const Comparison& comparison, const Tally& tally);
/// Each side at each condition with its errors, scatter, runs and doubts.
Table points_table(const Comparison& comparison, const Side& side);
/// Parts of the pull at one condition.
Table budget_table(const Comparison& comparison, std::size_t condition);
/// Sinkage at slip 0 and what slip adds, at the largest slip of each curve.
Table sinkage_table(const Comparison& comparison);
/// The tests of all differences at once.
Table joint_table(const Comparison& comparison);

/// The anchor of a page's rows of one pair and channel.
std::string rows_anchor(const Tally& tally);

}  // namespace soilbin::compare
