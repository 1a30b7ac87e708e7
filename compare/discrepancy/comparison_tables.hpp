// The tables of a comparison, for its page and its Markdown.
#pragma once

#include "compare/discrepancy/comparison.hpp"
#include "compare/report/marked_table.hpp"

namespace soilbin::compare {

/// A pair and channel a row, the widest apart first: how many differ, root mean square, mean, the widest condition.
/// Good where the root mean square is no larger than the stated errors make it, bad where it is and any row differs.
MarkedTable tally_table(const Comparison& comparison);
/// The rows of one pair and channel.
HtmlTable rows_table(const Comparison& comparison, const Tally& tally);
/// Each side at each condition with its errors, scatter, runs and doubts.
HtmlTable points_table(const Comparison& comparison, const Side& side);
/// Parts of the pull at one condition.
HtmlTable budget_table(const Comparison& comparison, std::size_t condition);
/// Sinkage at slip 0 and what slip adds, at the largest slip of each curve.
HtmlTable sinkage_table(const Comparison& comparison);
/// The tests of all differences at once.
HtmlTable joint_table(const Comparison& comparison);

/// The anchor of a page's rows of one pair and channel.
std::string rows_anchor(const Tally& tally);

}  // namespace soilbin::compare
