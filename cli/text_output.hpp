// Results as text on a terminal.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "compare/report/number_text.hpp"
#include "compare/report/table.hpp"
#include "compare/sweep/answers.hpp"
#include "compare/sweep/prediction.hpp"
#include "scenario/tire.hpp"

namespace soilbin::cli {

using compare::as_text;
using compare::number;
using compare::Table;
using compare::TableCell;

/// Each on a line of its own to stderr, as `soilbin check` tells them: "warning: ...".
void print_warnings(const std::vector<std::string>& warnings);

/// A document on standard output, with what is doubtful in it.
void print_json(nlohmann::ordered_json document, const std::vector<std::string>& doubts = {});

/// A line of an answer: "Sinkage", "20.6 ± 1.0", "mm"; no unit where the value is a sentence.
struct Reading {
  std::string name, value, unit;
};

/// What an answer says: four results with standard errors, efficiency, angles, budget.
std::vector<Reading> readings(const TractionResult& result);
/// The whole of one answer: condition, four results with standard errors, efficiency, angles, budget.
std::string answer_text(const compare::ModelAnswers& model, const compare::Answer& answer);
/// One line an answer, the conditions that vary in the first columns.
std::string study_text(const std::vector<compare::ModelAnswers>& study);
/// The runs of a campaign, measured and predicted, then the error table.
std::string prediction_text(const compare::Prediction& prediction);

}  // namespace soilbin::cli
