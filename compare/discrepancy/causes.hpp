// Why sides differ: parts of the pull side by side, where the contact begins and ends, what slip adds to the sinkage.
#pragma once

#include <string>
#include <vector>

#include "compare/discrepancy/comparison.hpp"

namespace soilbin::compare {

/// One part of the drawbar pull [N] as each side gives it; NaN where a side doesn't name it.
struct BudgetRow {
  std::string name;  ///< "shear_thrust"
  std::vector<double> force;
};

/// Parts of the pull at one condition, in the order in which sides name them; a side without a budget is NaN
/// throughout. `sides`: those that have one, of Comparison::sides.
struct BudgetTable {
  std::size_t condition = 0;
  std::vector<std::size_t> sides;
  std::vector<BudgetRow> rows;
};
BudgetTable budget_at(const Comparison& comparison, std::size_t condition);

/// What a part is, for people: "thrust of the sheared soil".
std::string part_in_words(const std::string& name);

/// The part of the budget in which a side and its reference differ most, at the condition. No value where either has no
/// budget.
struct BudgetGap {
  std::string name;
  double side = 0.0, reference = 0.0;  ///< [N]
};
std::optional<BudgetGap> widest_part(const Comparison& comparison, std::size_t side, std::size_t reference,
                                     std::size_t condition);

/// Sinkage as what the load alone presses in, at slip 0 on the same curve, and what slip adds [m].
struct SinkageSplit {
  std::size_t side = 0, condition = 0;
  double at_rest = 0.0, by_slip = 0.0;
};
/// For each side and condition whose curve holds a condition of slip 0 (to 1e-6) with a result.
std::vector<SinkageSplit> sinkage_splits(const Comparison& comparison);

/// The condition that is shown first: of the worst difference in pull, else the middle one.
std::size_t condition_of_largest_difference(const Comparison& comparison);

}  // namespace soilbin::compare
