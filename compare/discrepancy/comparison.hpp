// A study's models and measurements side by side: how far apart, how sure, and why (docs/theory/comparing.md).
//
//   const std::vector<Side> sides = {side_of(analytic), side_of("dem", runs, question.study.conditions)};
//   const Comparison comparison = compare_sides(question, sides);
//   for (const Clause& clause : summary(comparison)) fmt::print("{}\n", clause.text);  // telling/comparison_report.hpp
#pragma once

#include <string>
#include <vector>

#include "compare/discrepancy/difference.hpp"
#include "compare/discrepancy/side.hpp"
#include "compare/loop/loop.hpp"
#include "compare/sweep/varying.hpp"

namespace soilbin::compare {

/// Over all conditions.
struct Tally : ComparedChannel {
  std::size_t values = 0, differ = 0, in_scatter = 0, in_errors = 0, unknown = 0;
  double bias = 0.0;          ///< mean of value less reference [SI]
  double rms = 0.0;           ///< root mean square [SI]
  double rms_share = 0.0;     ///< of the load (Difference::share)
  double expected_rms = 0.0;  ///< what the stated errors alone would give [SI]
  std::size_t worst = 0;      ///< of Comparison::differences: the largest share of the load
};

// All differences between a model and a reference tested together: a chi-square test that allows for the uncertainty of
// the soil's values, which moves all conditions at once (JointTest).

/// chi2 = d' (D + J S J')^-1 d over all channels and conditions: D, the reference's variances, with the correlation of
/// a measured run's channels; S, the covariance of the soil's values, independent but where the model comes from a fit;
/// J, the model's derivatives by them. The uncertainty of the soil moves all conditions together, which rows taken one
/// by one can't show. First order in the soil's values.
enum class JointVerdict {
  significant,  ///< more is left than noise
  noise,
  undecided,  ///< more than noise were the errors known; they were estimated from too few re-runs to tell
};

struct JointTest {
  std::size_t side = 0, reference = 0;
  std::size_t values = 0;
  double chi2 = 0.0;
  /// Degrees of freedom behind D, of the channel that has fewest; infinite where the errors are known.
  double freedom = std::numeric_limits<double>::infinity();
  /// Chance of chi2 where nothing differs: by chi square with `values` degrees of freedom where errors are known, else
  /// by trace_tail: with a measurement's channels, whose correlation is estimated too; with one for grains, whose
  /// channels stand each by itself (by F, which errs high where the channels' errors err apart).
  double p_value = 1.0;
  double p_errors_known = 1.0;    ///< p_value were the errors known, by chi square
  double chi2_soil_exact = 0.0;   ///< the same with S = 0: what the soil's uncertainty explains is the rest
  std::vector<std::string> soil;  ///< values that were free to move

  static constexpr double level = 0.01;  ///< of p
  JointVerdict verdict() const {
    if (p_value < level) return JointVerdict::significant;
    return p_errors_known < level ? JointVerdict::undecided : JointVerdict::noise;
  }
};

/// The test, or why there is none.
struct JointOutcome {
  std::optional<JointTest> test;
  std::string why_not;
};

/// No test where a value of the reference has no standard error, where its re-runs are too few for its channels, where
/// the model has no balance at some condition, or where there is no semi-empirical soil.
JointOutcome joint_test(const Side& reference, const Case& question, const ModelChoice& model);

/// Chance of a larger sum of squares over `values` numbers in `channels` channels whose covariance was estimated with
/// `freedom` degrees of freedom (Lawley and Hotelling's trace): by F, exactly for one channel, else by McKeon's
/// approximation (Biometrika 61, 1974), which takes freedom > channels + 3.
double trace_tail(double trace, double values, double channels, double freedom);

/// A pair, or a side's conditions, that a comparison leaves out, and why.
struct NotCompared {
  enum class What { no_shared_condition, no_joint_test, no_result } what;
  std::size_t side = 0, reference = 0;    ///< of no_result the side alone
  std::string why{};                      ///< of no_joint_test; of no_result at the first such condition
  std::vector<std::size_t> conditions{};  ///< of no_result
};

struct Comparison {
  Case question;
  Curves curves;                        ///< the question's conditions, sorted against slip
  std::vector<Side> sides;              ///< analytic first, then grains, then measured
  std::vector<Difference> differences;  ///< by pair, channel, condition
  std::vector<Tally> tallies;           ///< by pair, channel
  std::vector<JointTest> joint;         ///< an analytic side against a reference each, where it can be made
  std::vector<NotCompared> not_compared;
};

/// Sides have a point for each condition of the question.
Comparison compare_sides(const Case& question, std::vector<Side> sides);

/// A side's results as a measured campaign: a run for each condition with a result, at its mean. The declared soil and
/// wheel are the case's. Throws InputError where the case has no semi-empirical soil or the side no result.
Campaign means_of(const Side& side, const Case& question, const std::vector<EffectChoice>& effects);

/// Throws InputError for a soil without semi-empirical values: ask before grains are run.
void check_soil_for_loop(const Soil& soil);

/// What the loop looks at for what the analytic model lacks, with the case's soil and wheel as declared: of a
/// measurement the runs that count in the comparison, as they were measured (setpoints, order, position, frame, slip);
/// of grains or a model means_of. Throws as that.
Campaign as_campaign(const Side& side, const Case& question);

/// What the loop makes of the best reference of a comparison.
struct LoopOfComparison {
  LoopAnswer answer;
  Doubts mistaken_columns;  ///< of the measurements that it took (of_mistaken_columns)
};
/// Measurements before grains; nothing where all sides are analytic. Throws NoSolution where the loop has no answer.
std::optional<LoopOfComparison> ask_loop(const Comparison& comparison, const LoopOptions& options);

/// Whether the pair sets a flexible tire (an analytic side whose effects read the inflation pressure) against the rigid
/// one that grains meet.
bool tires_differ(const Comparison& comparison, std::size_t side, std::size_t reference);

/// Whether the grains of a side are coarse for the wheel (doubts/grain_doubts.hpp).
bool grains_are_coarse(const Comparison& comparison);

/// What is doubtful in models side by side (compare/doubts/doubts.hpp): the analytic ones, then grains where there
/// are any.
Doubts doubts_of_sides(const Case& question, const std::vector<Side>& sides);

// Why sides differ: parts of the pull side by side, where the contact begins and ends, what slip adds to the sinkage.

/// One part of the drawbar pull [N] as each side gives it; NaN where a side doesn't name it.
struct BudgetRow {
  std::string name;  ///< "shear_thrust"
  std::vector<double> force;
};

/// Parts of the pull at one condition, in the order in which sides name them; a side without a budget is NaN
/// throughout. `sides`: those that have one, of Comparison::sides.
struct BudgetTable {
  std::size_t condition = 0;
  std::vector<std::size_t> sides;
  std::vector<BudgetRow> rows;
};
BudgetTable budget_at(const Comparison& comparison, std::size_t condition);

/// What a part is, for people: "thrust of the sheared soil".
std::string part_in_words(const std::string& name);

/// The part of the budget in which a side and its reference differ most, at the condition. No value where either has no
/// budget.
struct BudgetGap {
  std::string name;
  double side = 0.0, reference = 0.0;  ///< [N]
};
std::optional<BudgetGap> widest_part(const Comparison& comparison, std::size_t side, std::size_t reference,
                                     std::size_t condition);

/// Shear force over normal force on the parts of the contact ahead of the largest normal stress and behind it: how the
/// shear stress builds up along the contact. By Janosi's curve it rises from the entry on.
struct ShearRatios {
  double ahead = 0.0, behind = 0.0;
};
/// Of one side at the condition. No value without a result, or without normal stress on both parts.
std::optional<ShearRatios> shear_ratios(const Comparison& comparison, std::size_t side, std::size_t condition);

/// Sinkage as what the load alone presses in, at slip 0 on the same curve, and what slip adds [m].
struct SinkageSplit {
  std::size_t side = 0, condition = 0;
  double at_rest = 0.0, by_slip = 0.0;
};
/// For each side and condition whose curve holds a condition of slip 0 (to 1e-6) with a result.
std::vector<SinkageSplit> sinkage_splits(const Comparison& comparison);

/// The condition that is shown first: of the worst difference in pull, else the middle one.
std::size_t condition_of_largest_difference(const Comparison& comparison);

}  // namespace soilbin::compare
