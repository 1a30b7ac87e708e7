// Answers as they are told: one in full, a study a line each, an explanation with its equations.
//
//   const Report report = report_on(question, run_study(question));
#pragma once

#include <string>
#include <vector>

#include "compare/experiments/study_results.hpp"
#include "compare/report/report.hpp"
#include "compare/sweep/answers.hpp"
#include "compare/sweep/explanation.hpp"

namespace soilbin::compare {

/// Said once where the efficiency or the power of a tire that flattens is told.
inline constexpr const char* carcass_without_loss =
    "What a tire loses in flexing is not in the model: real ones take some more torque, the more the softer they are.";

/// A line of an answer: "Sinkage", "20.6 ± 1.0", "mm"; no unit where the value is a sentence.
struct PrintedValue {
  std::string name, value, unit;
};

/// The unit in which forces are told.
enum class ForcesIn { newtons, kilonewtons };

/// What an answer says: four results with standard errors, efficiency, angles, budget.
std::vector<PrintedValue> printed_values(const TractionResult& result, ForcesIn unit = ForcesIn::newtons);

/// "tire radius 110 mm, width 100 mm on dry-sand": what was asked, as an answer's heading says it.
std::string asked_in_words(const Case& question);

/// "rover-wheel on dry-sand, load 65 N, slip 20 %": with what all conditions share; `with_slip` false: but for the
/// slip.
std::string title_of_question(const Case& question, bool with_slip = true);

/// A table of each model, a line an answer, the conditions that vary in the first columns.
std::vector<ReportPart> study_parts(const std::vector<ModelAnswers>& study);

/// One answer in full, or a study_parts of several; curves, or the stresses under the wheel. Where nothing is solved it
/// says why, and no more. Both outlive the report.
Report report_on(const Case& question, const std::vector<ModelAnswers>& study);

/// On runs of grains, beside their results: which did not become steady, how dense their beds are (`density`:
/// relative_density_of), what they cost.
std::vector<std::string> notes_on(const std::vector<RecordedRun>& runs, const std::string& density);

/// A study as study_parts, by grains too, with what their runs say of themselves; its curves. `density`: of their beds
/// (relative_density_of). Both outlive the report.
Report report_on(const Case& question, const StudyResults& results, const std::string& density);

/// The equations with their values, the effects and the closed forms, each group under its heading.
std::string equations_text(const Explanation& explanation);

/// The answer at each condition, the budget of forces, the equations with values put in, closed forms to check by;
/// then where the values come from.
Report report_on(const Case& question, const std::vector<Explained>& explained);

}  // namespace soilbin::compare
