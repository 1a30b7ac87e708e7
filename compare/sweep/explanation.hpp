// Why the semi-empirical answer is what it is: its equations with the values put in, and closed forms to check it by.
#pragma once

#include <string>
#include <vector>

#include "compare/report/json_fields.hpp"
#include "compare/report/table.hpp"
#include "compare/sweep/answers.hpp"

namespace soilbin::compare {

/// One equation, once in symbols and once in numbers.
struct Step {
  std::string name;      ///< "entry angle"
  std::string equation;  ///< "z = r (1 - cos theta_1)"
  std::string numbers;   ///< "0.11 m (1 - cos 35.6 deg)"
  double value = 0.0;    ///< in `unit`
  std::string unit;
  std::string remark = {};  ///< what to think of it
};

struct Explanation {
  TractionResult result;
  std::vector<Step> steps;         ///< of the model, in the order in which it takes them
  std::vector<Step> effects;       ///< an effect each: equation, parameters
  std::vector<Step> cross_checks;  ///< closed forms that need no balance
};

/// One condition of a question, by one of its models.
struct Explained {
  ModelChoice choice;
  OperatingCondition at;
  Explanation why;
};

/// Explains one condition. Throws InputError and NoSolution as the model does.
Explanation explain(const Scenario& scenario, const OperatingCondition& at);

/// Every condition of a question by every model. Throws InputError for a model that has no equations.
std::vector<Explained> explain(const Case& question);

/// Rows of soilbin-explain/1: the answer, then its equations, effects and closed forms.
Json rows_json(const std::vector<Explained>& explained);

/// The parts of the drawbar pull, their sum and the pull [N].
Table forces_table(const TractionResult& result);

}  // namespace soilbin::compare
