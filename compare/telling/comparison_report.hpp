// A comparison as it is told; soilbin-compare/1.
//
//   const ComparisonAbout what{.title = "Comparison", .command = "soilbin compare ..."};
//   write_file_atomically("page.html", page_of(report_on(comparison, what), about));
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compare/discrepancy/comparison.hpp"
#include "compare/replay/replay.hpp"
#include "compare/report/bars.hpp"
#include "compare/report/heat_map.hpp"
#include "compare/report/plot.hpp"
#include "compare/report/report.hpp"
#include "compare/report/table.hpp"

namespace soilbin::compare {

/// What is told beside a comparison.
struct ComparisonAbout {
  std::string title{};                                          ///< of its page
  std::string command{};                                        ///< that made it
  std::vector<std::pair<std::string, std::string>> versions{};  ///< of what made it
  std::vector<std::pair<std::string, std::string>> facts{};     ///< seeds, hashes of inputs, grain runs
  std::string resolved_case{};                                  ///< as YAML
  std::optional<LoopOfComparison> loop{};
  std::optional<ReplayFile> replay{};
};

/// The largest difference and whether it is significant; curves, causes, what the loop finds, heat maps, all rows.
/// Both outlive the report.
Report report_on(const Comparison& comparison, const ComparisonAbout& about);

/// soilbin-compare/1: sides, rows, tallies, joint tests, summary, the loop; SI.
nlohmann::ordered_json comparison_json(const Comparison& comparison, const ComparisonAbout& about);
/// Every row as CSV.
std::string differences_csv(const Comparison& comparison);

// The comparison in plain words; each clause knows the rows that it rests on.

/// What a sentence rests on beside rows.
enum class ClauseEvidence { rule, joint_test, budget, loop, points, warnings };
/// "rule", "joint test", "the loop": as links and JSON name it.
const char* word(ClauseEvidence evidence);

/// A sentence and what it rests on.
struct Clause {
  std::string about;  ///< "drawbar pull"; "" for what concerns all
  std::string text;   ///< whole sentences
  std::vector<ClauseEvidence> evidence{};
  std::vector<std::size_t> rows{};  ///< of Comparison::differences
};

/// What every sentence, table and figure calls a side: "analytic wheel with slip sinkage". Data keep its label.
std::string name_of(const Side& side);

/// "analytic wheel - grains".
std::string less_in_words(const Comparison& comparison, const ComparedChannel& of);
/// "grains has no result at 1 of 4 conditions (...)".
std::string in_words(const Comparison& comparison, const NotCompared& gap);

/// The lines that a page opens with: the headline; how much of the difference the soil's uncertainty explains; what the
/// size of the grains does to their answers. The last two are absent where nothing can be said of them.
std::vector<Clause> opening(const Comparison& comparison);

/// The first of these lines: the largest difference in pull (of what is compared, where no pull is), whether it is
/// significant, and how many of all differences are. Nothing where nothing is compared.
std::optional<Clause> headline(const Comparison& comparison);

/// The row of the headline.
const Difference* widest_difference(const Comparison& comparison);

/// Where the widest gap in pull comes from.
std::vector<Clause> cause_clauses(const Comparison& comparison);

/// What the loop says is missing, what that does to the error, what to measure next.
std::vector<Clause> missing_clauses(const LoopOfComparison& loop);

/// How sure it is, what limits it, what was not compared.
std::vector<Clause> limits_of_the_comparison(const Comparison& comparison);

/// Pairs and channels, the largest share of the load first; pairs whose tires differ (tires_differ) behind all others.
std::vector<const Tally*> widest_first(const Comparison& comparison);

/// What a tally's shares are shares of: "the load", "load x radius", "the radius".
std::string measure_of(const Tally& tally);

/// The opening; then how far each pair is apart, channel by channel, largest first; what of it counts; where it comes
/// from; what the loop, where it was run, says is missing; and what the comparison cannot tell.
std::vector<Clause> summary(const Comparison& comparison, const LoopOfComparison* loop = nullptr);

// The tables of a comparison, for its page, its Markdown and a terminal: channel by channel, row by row, point by
// point.

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
std::string rows_anchor(const ComparedChannel& of);

// The figures of a comparison: curves of all sides, heat maps of differences, stresses, contact angles, sinkage,
// budget.

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
