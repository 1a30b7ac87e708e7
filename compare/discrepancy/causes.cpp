#include "compare/discrepancy/causes.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "compare/report/number_text.hpp"
#include "compare/sweep/varying.hpp"
#include "scenario/estimate.hpp"

namespace soilbin::compare {
namespace {

const TractionResult* result_of(const Comparison& comparison, std::size_t side, std::size_t condition) {
  const SidePoint& point = comparison.sides[side].points[condition];
  return point.result ? &*point.result : nullptr;
}

double force_of(const TractionResult& result, const std::string& name) {
  for (const Contribution& part : result.budget)
    if (part.name == name) return part.force;
  return not_a_number;
}

}  // namespace

BudgetTable budget_at(const Comparison& comparison, std::size_t condition) {
  BudgetTable table{condition, {}, {}};
  for (std::size_t s = 0; s < comparison.sides.size(); ++s) {
    const TractionResult* result = result_of(comparison, s, condition);
    if (result == nullptr || result->budget.empty()) continue;
    table.sides.push_back(s);
    for (const Contribution& part : result->budget)
      if (std::ranges::none_of(table.rows, [&](const BudgetRow& r) { return r.name == part.name; }))
        table.rows.push_back({part.name, {}});
  }
  for (BudgetRow& row : table.rows)
    for (const std::size_t s : table.sides)
      row.force.push_back(force_of(*result_of(comparison, s, condition), row.name));
  return table;
}

std::string part_in_words(const std::string& name) {
  static const std::map<std::string, std::string> known = {
      {"shear_thrust", "thrust of the sheared soil"},
      {"compaction_resistance", "compaction resistance (normal stresses)"},
      {"side_force", "side force of a yawed wheel"},
      {"slope", "gravity on the slope"},
      {"measurement", "what the instruments add"},
      {"bulldozing", "bulldozing ahead of the wheel"},
      {"sidewall_bulldozing", "bulldozing by the sidewalls"},
      {"lug_thrust", "thrust of the lugs' faces"},
  };
  const auto found = known.find(name);
  if (found != known.end()) return found->second;
  return spaced(name);
}

std::optional<BudgetGap> widest_part(const Comparison& comparison, std::size_t side, std::size_t reference,
                                     std::size_t condition) {
  const TractionResult *a = result_of(comparison, side, condition), *b = result_of(comparison, reference, condition);
  if (a == nullptr || b == nullptr || a->budget.empty() || b->budget.empty()) return std::nullopt;
  std::optional<BudgetGap> widest;
  for (const BudgetRow& row : budget_at(comparison, condition).rows) {
    // A part that one side doesn't name is a part that this side leaves out: 0.
    const double x = force_of(*a, row.name), y = force_of(*b, row.name);
    const BudgetGap gap{row.name, std::isnan(x) ? 0.0 : x, std::isnan(y) ? 0.0 : y};
    if (!widest || std::abs(gap.side - gap.reference) > std::abs(widest->side - widest->reference)) widest = gap;
  }
  return widest;
}

std::vector<SinkageSplit> sinkage_splits(const Comparison& comparison) {
  constexpr double no_slip = 1e-6;
  const std::vector<OperatingCondition>& conditions = comparison.question.study.conditions;
  const Curves& curves = comparison.curves;
  std::vector<SinkageSplit> splits;
  for (std::size_t s = 0; s < comparison.sides.size(); ++s) {
    std::map<std::size_t, double> at_rest;
    for (std::size_t i = 0; i < conditions.size(); ++i)
      if (const TractionResult* result = result_of(comparison, s, i); result && std::abs(conditions[i].slip) < no_slip)
        at_rest[curves.curve_of[i]] = result->sinkage.value;
    for (std::size_t i = 0; i < conditions.size(); ++i) {
      const TractionResult* result = result_of(comparison, s, i);
      const auto rest = at_rest.find(curves.curve_of[i]);
      if (result == nullptr || rest == at_rest.end() || !std::isfinite(result->sinkage.value)) continue;
      splits.push_back({s, i, rest->second, result->sinkage.value - rest->second});
    }
  }
  return splits;
}

std::size_t condition_of_largest_difference(const Comparison& comparison) {
  std::size_t condition = comparison.question.study.conditions.size() / 2;
  double most = 0.0;
  for (const Difference& d : comparison.differences)
    if (channel_views[d.channel].name == "drawbar_pull" && std::abs(d.share) > most)
      most = std::abs(d.share), condition = d.condition;
  return condition;
}

}  // namespace soilbin::compare
