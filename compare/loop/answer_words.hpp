// Stage 8 of the loop: its answer in plain words, as tables and as a page.
#pragma once

#include <string>
#include <vector>

#include "compare/loop/loop.hpp"
#include "compare/report/page.hpp"

namespace soilbin::compare {

/// "slip_sinkage", "multipass + sensor_offset"; "no effect" for an empty set.
std::string joined(const std::set<std::string>& ids);

/// The verdict as a sentence for people.
std::string verdict_sentence(const LoopAnswer& answer);

/// Further sentences: what was added and how large, what the data can't tell apart, errors before and after, what to
/// measure next. One string a sentence.
std::vector<std::string> explanation(const LoopAnswer& answer);

/// Whether a held-out error is larger with the effects than without, by more than its third digit.
bool rises(const ErrorPair& error);

/// The channels whose held-out error rises with the effects that the answer's model takes (Channel); none where it
/// takes none.
std::vector<int> worse_channels(const LoopAnswer& answer);

/// "held-out error falls by 28 +- 5 sigma^2 a value; predicted better: sinkage (20.6 to 7.04 mm); predicted worse:
/// drawbar pull (5.95 to 6.3 N)".
std::string held_out_words(const CrossValidation& validation);

/// The same as the end of a reason; empty where the model takes no effects or nothing was held out.
std::string held_out_clause(const LoopAnswer& answer);

/// What to measure next, or why no run is proposed; empty where no question is open.
std::vector<std::string> what_next(const LoopAnswer& answer);

/// The forms of a candidate's effects, in the order of its ids.
std::vector<std::string> forms_in_order(const CandidateModel& candidate);

/// Candidates, first those that the data can't tell apart, their weights and chi2; held-out errors before and after: as
/// tables for a page or a terminal.
HtmlTable candidates_table(const LoopAnswer& answer);
HtmlTable error_table(const LoopAnswer& answer);

/// The report: verdict, residuals against every variable before and after, the accepted effect's signature over the
/// residual, candidates, what is not testable, what to measure next. `doubts`: in the campaign
/// (compare/doubts/doubts.hpp). `command`: how to repeat it.
std::string loop_page(const Campaign& campaign, const LoopAnswer& answer, const std::vector<std::string>& doubts,
                      const std::string& command);

}  // namespace soilbin::compare
