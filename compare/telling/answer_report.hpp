// Answers as they are told: one in full, a study a line each, an explanation with its equations.
//
//   const Report report = report_on(question, run_study(question));
#pragma once

#include <string>
#include <vector>

#include "compare/report/report.hpp"
#include "compare/sweep/answers.hpp"
#include "compare/sweep/explanation.hpp"

namespace soilbin::compare {

/// A line of an answer: "Sinkage", "20.6 ± 1.0", "mm"; no unit where the value is a sentence.
struct PrintedValue {
  std::string name, value, unit;
};

/// The unit in which forces are told.
enum class ForcesIn { newtons, kilonewtons };

/// What an answer says: four results with standard errors, efficiency, angles, budget.
std::vector<PrintedValue> printed_values(const TractionResult& result, ForcesIn unit = ForcesIn::newtons);

/// A table of each model, a line an answer, the conditions that vary in the first columns.
std::vector<ReportPart> study_parts(const std::vector<ModelAnswers>& study);

/// One answer in full, or a study_parts of several; curves, or the stresses under the wheel. Both outlive the report.
Report report_on(const Case& question, const std::vector<ModelAnswers>& study);

/// The equations with their values, the effects and the closed forms, each group under its heading.
std::string equations_text(const Explanation& explanation);

/// The answer, the budget of forces, the equations with the values put in, closed forms to check by.
std::vector<ReportPart> explanation_parts(const ModelChoice& choice, const OperatingCondition& at,
                                          const Explanation& explanation);

}  // namespace soilbin::compare
