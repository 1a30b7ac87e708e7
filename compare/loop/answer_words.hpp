// Stage 8 of the loop: its answer in plain words, as tables and as a page. Terminal, page, Python and the comparison
// say the same sentences in the same order.
//
//   for (const BackedSentence& said : headline(answer, {})) fmt::print("{}. {}\n", said.about, said.text);
//   fmt::print("{}", as_text(error_table(answer)));
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "compare/attribution/evidence_words.hpp"
#include "compare/loop/loop.hpp"
#include "compare/report/page.hpp"

namespace soilbin::compare {

/// Whether the saved model takes any effects, accepted ones or stand-ins.
bool takes_effects(const LoopAnswer& answer);

/// The verdict as one sentence.
std::string verdict_sentence(const LoopAnswer& answer);

/// At an unknown effect: what predicts in its place; "" where nothing does.
std::string stand_in_sentence(const LoopAnswer& answer);

/// What a page opens with: what is missing and how sure that is; what it, or a stand-in, does to the error, gain and
/// loss alike; what to measure next. A sentence each, with details in smaller print. The last is absent where no
/// question is open. Before all of it stands what takes a column of the data for mistaken, where anything does
/// (doubts_before_fit): then the verdict may be of that column.
std::vector<BackedSentence> headline(const LoopAnswer& answer, const std::vector<std::string>& column_doubts);

/// What else there is to know, a string a sentence: the reading that does not decide, what is presumed, set aside, not
/// testable.
std::vector<std::string> notes(const LoopAnswer& answer);

/// Headline without the verdict, the parameters of the effects, notes: one string a sentence.
std::vector<std::string> explanation(const LoopAnswer& answer);

/// Whether a held-out error is larger with the effects than without, by more than its third digit.
bool rises(const HeldOutErrors& error);

/// The channels whose held-out error rises with the effects that the answer's model takes (Channel); none where it
/// takes none.
std::vector<int> worse_channels(const LoopAnswer& answer);

/// "held-out error falls by 28 +- 5 sigma^2 a value; predicted better: sinkage (20.6 to 7.04 mm); predicted worse:
/// drawbar pull (5.95 to 6.30 N)".
std::string held_out_words(const CrossValidation& validation);

/// The same as the end of a reason, beside effects that are accepted or that stand in; empty where there are none, or
/// nothing was held out.
std::string held_out_clause(const CrossValidation& validation, bool accepted, bool stands_in);

/// The forms of a candidate's effects, in the order of its ids.
std::vector<std::string> forms_in_order(const CandidateModel& candidate);

/// The sets of the table of candidates: those that compete, then those that stand next.
std::vector<const WeightedSet*> sets_shown(const LoopAnswer& answer);

// Tables (answer_tables.cpp).

/// The next run as a row: a column each condition, how many runs, what they decide between; of an unknown effect the
/// rows of shape_series. No row: no run is proposed.
Table next_run_table(const LoopAnswer& answer);
/// Held-out errors before and after by channel; what falls is marked good, what rises bad.
Table error_table(const LoopAnswer& answer);
/// Candidates, first those that the data can't tell apart, their weights and chi2; and what its columns mean.
Table candidates_table(const LoopAnswer& answer);
std::string candidates_columns_in_words();
/// The fitted parameters of the effects that the saved model takes: meaning, value, unit, whether they are at a bound.
Table parameters_table(const LoopAnswer& answer);
/// The soil's values beside the effects and without them.
Table soil_table(const LoopAnswer& answer);

/// The report: headline, the next run, measured points with the model before and after, tables, doubts, and folded what
/// stands behind it. `doubts`: in the campaign (compare/doubts/doubts.hpp), `column_doubts` those of them that the
/// headline opens with. `command`: how to repeat it.
std::string loop_page(const Campaign& campaign, const LoopAnswer& answer, const std::vector<std::string>& doubts,
                      const std::vector<std::string>& column_doubts, const std::string& command);

}  // namespace soilbin::compare
