// Why the semi-empirical answer is what it is: its equations with the values put in, closed forms to check it by, and
// where the numbers come from.
#pragma once

#include <string>
#include <vector>

#include "compare/report/json_fields.hpp"
#include "compare/report/table.hpp"
#include "compare/sweep/answers.hpp"
#include "scenario/scenario.hpp"

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

// Where the numbers of a question come from: each value of its wheel and of its soil with its source.

struct SourcedValue {
  std::string of;           ///< "tire" or "soil"
  std::string key;          ///< as files name it: "lugs.height"
  std::string name;         ///< for people: "lug height"
  std::string unit;         ///< as files write it; "-" for a plain number
  double per_si;            ///< units per SI unit
  Estimate value;           ///< [SI]
  bool assumed_sd = false;  ///< its standard deviation is a share that the soil's file assumes
  std::string source;       ///< its own, else that of the whole; "not stated" where neither is
};

/// The declared values of the wheel, then those of the soil for the analytic model.
std::vector<SourcedValue> sourced_values(const Scenario& scenario);

/// "1.04 ± 0.10 kPa (± assumed)".
std::string in_words(const SourcedValue& value);

/// "sources" of soilbin-explain/1, in SI; and the same for people.
Json sources_json(const Scenario& scenario);
Table sources_table(const Scenario& scenario);

}  // namespace soilbin::compare
