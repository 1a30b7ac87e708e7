// Answers as text on a terminal: one answer in full, a study a line each.
//
//   for (const ModelAnswers& model : study) fmt::print("{}\n", answer_text(model, model.answers.front()));
#pragma once

#include <string>
#include <vector>

#include "compare/sweep/answers.hpp"

namespace soilbin::compare {

/// A line of an answer: "Sinkage", "20.6 ± 1.0", "mm"; no unit where the value is a sentence.
struct PrintedValue {
  std::string name, value, unit;
};

/// What an answer says: four results with standard errors, efficiency, angles, budget.
std::vector<PrintedValue> printed_values(const TractionResult& result);
/// The whole of one answer: condition, four results with standard errors, efficiency, angles, budget.
std::string answer_text(const ModelAnswers& model, const Answer& answer);
/// One line an answer, the conditions that vary in the first columns.
std::string study_text(const std::vector<ModelAnswers>& study);

}  // namespace soilbin::compare
