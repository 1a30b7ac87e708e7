// What the loop answers, in plain words, as a page, and as a model that other commands use.
#pragma once

#include <string>
#include <vector>

#include "compare/loop/loop.hpp"
#include "compare/report/page.hpp"
#include "scenario/case.hpp"

namespace soilbin::compare {

/// "slip_sinkage", "multipass + sensor_offset"; "no effect" for an empty set.
std::string joined(const std::set<std::string>& ids);

/// The verdict as a sentence for people.
std::string verdict_sentence(const LoopAnswer& answer);

/// Further sentences: what was added and how large, what the data can't tell apart, errors before and after, what to
/// measure next. One string a sentence.
std::vector<std::string> explanation(const LoopAnswer& answer);

/// What to measure next, or why no run is proposed; empty where no question is open.
std::vector<std::string> what_next(const LoopAnswer& answer);

/// The forms of a candidate's effects, in the order of its ids.
std::vector<std::string> forms_in_order(const CandidateModel& candidate);

/// Candidates, first those that the data can't tell apart, their weights and chi2; held-out errors before and after: as
/// tables for a page or a terminal.
HtmlTable candidates_table(const LoopAnswer& answer);
HtmlTable error_table(const LoopAnswer& answer);

/// The campaign's wheel on the refitted soil with the accepted effects, at each of its conditions: what estimate, run
/// and predict --model take.
Case resolved_model(const Campaign& campaign, const LoopAnswer& answer);

/// The report: verdict, residuals against every variable before and after, the accepted effect's signature over the
/// residual, candidates, what is not testable, what to measure next. `doubts`: in the campaign (compare/sweep/doubts.hpp).
/// `command`: how to repeat it.
std::string loop_page(const Campaign& campaign, const LoopAnswer& answer, const std::vector<std::string>& doubts,
                      const std::string& command);

}  // namespace soilbin::compare
