// What the model says to a served question, at its point and along its curves, and that as JSON for the page.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "cli/serve/setup.hpp"
#include "compare/report/plot.hpp"
#include "compare/sweep/answers.hpp"

namespace soilbin::cli {

/// A question with its answers, by one model.
struct ServedAnswer {
  Asked asked;
  Case swept;                                ///< the question at the slips of the curves
  std::vector<compare::ModelAnswers> point;  ///< at the condition that is asked for
  std::vector<compare::ModelAnswers> curves;
  compare::Doubts notes{};  ///< what the tire was taken with: compare::as_declared
  std::string label{};      ///< what tells it from the one beside it; "" where there is none
};

/// The question at the 61 slips of a curve from the first to the second.
Case swept_over(Case question, const std::pair<double, double>& slips);

ServedAnswer answer_to(Asked asked, const std::pair<double, double>& slips);

/// Tells the forces of a sheet, in N by their titles, in kN.
void in_kilonewtons(compare::Sheet& sheet);

/// Sheets (compare/report/plot.hpp): the curves, the point marked on each; the parts of the drawbar pull piled
/// up; the stresses along the contact at the point.
nlohmann::ordered_json curves_json(const std::vector<ServedAnswer>& sides);
nlohmann::ordered_json budget_json(const std::vector<ServedAnswer>& sides);
nlohmann::ordered_json stresses_json(const std::vector<ServedAnswer>& sides);

/// What a drawing of the wheel in the ground needs, in SI and radians; stresses from where soil lets go to where it
/// meets the wheel. null where there is no solution.
nlohmann::ordered_json wheel_json(const ServedAnswer& one);

/// Names, values and units as `soilbin estimate` prints them.
nlohmann::ordered_json readings_json(const ServedAnswer& one);

}  // namespace soilbin::cli
