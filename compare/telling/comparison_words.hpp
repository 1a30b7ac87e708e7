// The comparison in plain words; each clause knows the rows that it rests on.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/discrepancy/comparison.hpp"

namespace soilbin::compare {

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
std::vector<Clause> summary(const Comparison& comparison, const LoopAnswer* loop = nullptr);

}  // namespace soilbin::compare
