// The loop's answer as it is told: sentences, tables, figures, JSON, and a case that other commands take. Terminal,
// page, Python and the comparison say the same sentences in the same order.
//
//   fmt::print("{}", text_of(report_on(campaign, answer, doubts_before_fit(campaign))));
//   for (const BackedSentence& said : headline(answer, {})) fmt::print("{}. {}\n", said.about, said.text);
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "compare/doubts/doubt.hpp"
#include "compare/loop/loop.hpp"
#include "compare/report/plot.hpp"
#include "compare/report/report.hpp"
#include "scenario/case.hpp"

namespace soilbin::compare {

// Answers for programs (loop_data.cpp).

/// The answer as JSON, soilbin-loop/1.
nlohmann::ordered_json to_json(const LoopAnswer& answer);

/// What stands behind it: p-values, chi2, evidence, every set of effects that competed, the choice of each fold.
nlohmann::ordered_json details_json(const LoopAnswer& answer);

/// The campaign's wheel on the refitted soil with the accepted effects, at each of its conditions: what estimate, run
/// and predict --model take.
Case resolved_model(const Campaign& campaign, const LoopAnswer& answer);

/// The source that such a case tells: "fitted to campaign cmu-smooth".
std::string source_of_fit(const std::string& campaign);

// Sentences.

/// What the verdict rests on, and what the effects of the saved model do to the error: one plain sentence.
std::string reason_words(const LoopAnswer& answer);

std::string verdict_sentence(const LoopAnswer& answer);

/// At an unknown effect: what predicts in its place; "" where nothing does.
std::string proxy_sentence(const LoopAnswer& answer);

/// What a page opens with: what is missing and how sure that is; what it, or its proxies, do to the error, gain and
/// loss alike; what to measure next. A sentence each, with details in smaller print. The last is absent where no
/// question is open. Before all of it stands what takes a column of the data for mistaken, where anything does
/// (doubts_before_fit): then the verdict may be of that column.
std::vector<BackedSentence> headline(const LoopAnswer& answer, const std::vector<std::string>& column_doubts);

/// What else there is to know, a string a sentence: the reading that does not decide, what is presumed, set aside, not
/// testable.
std::vector<std::string> notes(const LoopAnswer& answer);

/// All that is said without tables: the headline, the parameters of the effects, the notes.
std::vector<std::string> in_sentences(const LoopAnswer& answer);

/// "held-out error falls by 28 +- 5 sigma^2 a value; predicted better: sinkage (20.6 to 7.04 mm); predicted worse:
/// drawbar pull (5.95 to 6.30 N)".
std::string held_out_words(const CrossValidation& validation);

// What to measure next: the run that sets the candidates apart (next_run), or where nothing has a
// name the runs that show how the unexplained part depends on a condition.

/// What to measure next, or why no run is proposed: first what to do, then sentences on why. Empty where no question is
/// open.
std::vector<std::string> what_next(const LoopAnswer& answer);

/// A number in three digits.
std::string setting(double value);

/// A condition of a run to be made as the rig would be set to it (rig_setting), in the unit of the campaign's own
/// column, and that unit: ("10", "mm/s"). An empty value where the condition is not known.
std::pair<std::string, std::string> next_setting(const LoopAnswer& answer, const OperatingCondition& at,
                                                 const std::string& condition);

// Sets of effects and the evidence for them.

/// "a", "a and b", "a, b and c".
std::string joined_with_and(const std::vector<std::string>& words);

/// Ids: "slip_sinkage", "multipass + sensor_offset"; "no effect" for an empty set.
std::string joined(const std::set<std::string>& ids);

/// Names for people: "side-wall bulldozing, slip sinkage and hard layer"; "no effect" for an empty set.
std::string named_effects(const std::set<std::string>& ids);

/// "p = 0.012"; "p < 0.00025" where no simulated campaign looked like this.
std::string p_words(const ResidualSignatures& signatures);
/// "not explained by noise (p = 0.012)"; from p = 0.05 on "explained by noise (p = 0.3)".
std::string noise_verdict(const ResidualSignatures& signatures);

/// Odds from their logarithm: "132 times", "more than a million times".
std::string times_likelier(double log_odds);

/// What a verdict rests on, as a clause.
std::string reason_words(const TooFewValues& few);
std::string reason_words(const Judgement& judgement);

/// "g = (0.110 ± 0.012) slip^2 - (0.031 ± 0.004)".
std::string formula_text(const LearnedFormula& formula);

/// A share of the evidence below this [-] is told as "< 1 %".
inline constexpr double least_share = 0.005;

/// A set's share of the evidence as every sentence and table has it: "81 %".
std::string share_words(double weight);

// Tables.

/// The next run as a row: a column each condition, how many runs, what they decide between; of an unknown effect the
/// rows of shape_series. No row: no run is proposed.
Table next_run_table(const LoopAnswer& answer);
/// Held-out errors before and after by channel; what falls is marked good, what rises bad.
Table error_table(const LoopAnswer& answer);
/// Candidates, first those that the data can't tell apart, their weights and chi2.
Table candidates_table(const LoopAnswer& answer);
/// The fitted parameters of the effects that the saved model takes: meaning, value, unit, whether they are at a bound.
Table parameters_table(const LoopAnswer& answer);
/// The soil's values beside the effects and without them.
Table soil_table(const LoopAnswer& answer);

/// The answer in full: headline, the next run, measured points with the model before and after, tables, notes, and
/// folded what stands behind it. `doubts`: in the campaign (doubts_before_fit); those of mistaken columns open the
/// headline. All outlive the report.
Report report_on(const Campaign& campaign, const LoopAnswer& answer, const Doubts& doubts);

// The figures of a loop's answer: measured values beside the model before and after. Before: the base model, its soil
// refitted. After: the model with the effects that the answer's model uses. Colours and names are the same in all of
// them.

/// The curves against slip that a figure of the fit shows: (name of the curve, its rows), the one that the effects
/// change most first. Empty where the runs do not lie on curves against slip: fewer than half of
/// them have three others at other slips under the same conditions, or there are more than a dozen curves.
std::vector<std::pair<std::string, std::vector<int>>> curves_of_the_fit(const LoopAnswer& answer);

/// Each channel of these rows against slip, with both models at the mean of the rows' conditions.
Sheet fit_sheet(const LoopAnswer& answer, const std::vector<int>& rows);

/// What the base model misses in each channel's unit over one variable, beside what the effects change.
Sheet gap_sheet(const LoopAnswer& answer, const Covariate& x);

/// Residuals over one variable before and after [sd of the noise].
Sheet residual_sheet(const LoopAnswer& answer, const Covariate& x);

/// The effects' change of the prediction over the base model's residual [sd of the noise].
Sheet signature_sheet(const LoopAnswer& answer, const Covariate& x);

/// The variables of the campaign, first the one on which the effects' change depends most.
std::vector<Covariate> variables_by_weight(const LoopAnswer& answer);

}  // namespace soilbin::compare
