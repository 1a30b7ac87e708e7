// The tables of a comparison, for its page, its Markdown and a terminal: channel by channel, row by row, point by
// point.
#pragma once

#include <string>
#include <vector>

#include "compare/discrepancy/comparison.hpp"
#include "compare/report/table.hpp"

namespace soilbin::compare {

/// The comparison in one table, a condition a row: of each channel the baseline (measured, else grains, else the first
/// model) and the other sides' changes against it, with a star where one is significant. A table a channel where all
/// of them would be more than ten columns. Forces in kN where they are as large. Empty: there is nothing to compare.
std::vector<Table> matrix_tables(const Comparison& comparison);
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
