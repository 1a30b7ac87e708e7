#include "compare/failure_map/learned_map.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "compare/doubts/doubts.hpp"

namespace soilbin::compare {
namespace {

/// Where the models agree: without lugs at any slip, else also up to a slip; with any lugs; and the largest box of all.
std::vector<AgreementClause> agreements(const FailureQuestion& question, FailureMap& rows, int rounds) {
  std::vector<AgreementClause> clauses;
  const auto add = [&](const std::vector<Role>& roles) {
    if (question.waits()) return true;
    if (const auto clause = agreement(question, rows, roles, 9, rounds)) clauses.push_back(*clause);
    return !clauses.empty();
  };
  if (!add({Role::limited, Role::held, Role::limited, Role::whole}))
    add({Role::limited, Role::held, Role::limited, Role::limited});
  add({Role::limited, Role::limited, Role::limited, Role::whole});
  add({Role::bounded, Role::bounded, Role::bounded, Role::bounded});
  return clauses;
}

/// Of both models at the conditions that were run, with the highest lugs.
Doubts doubts_at_rows(const FailureMapResult& result) {
  Case question;
  std::vector<Eigen::VectorXd> rows;
  for (const FailureRow& row : result.rows.rows) {
    rows.push_back(row.values);
    question.study.conditions.push_back(condition_at(result.map, row.values));
  }
  if (rows.empty()) return {};
  const auto height = [](const Eigen::VectorXd& values) { return values[map_lug_height]; };
  question.scenario = scenario_at(result.map, *std::ranges::max_element(rows, {}, height));
  for (const ModelKind kind : {result.map.of, result.map.against})
    if (kind == ModelKind::bekker_wong)
      question.study.models.push_back({kind, question.scenario.effects, ""});
    else if (kind == ModelKind::rft)
      question.study.models.push_back({kind, {}, ""});
  question.scenario.effects.clear();
  const std::vector<ModelAnswers> study = run_study(question);
  if (result.map.of == ModelKind::dem || result.map.against == ModelKind::dem)
    question.study.models.push_back({ModelKind::dem, {}, ""});
  return doubts(question, study);
}

}  // namespace

FailureMapResult learn_map(const InclineMap& map, const MapGrains& grains, const MapLearning& how) {
  FailureMapResult result;
  result.map = map;
  result.question = failure_question(result.map, grains, how.tolerance);
  result.rows = map_failures(result.question, how.runs);
  if (grains.waits()) return result;
  result.clauses = agreements(result.question, result.rows, how.rounds);
  if (grains.waits()) return result;
  result.coordinates = compare_coordinates(result.map, result.rows);
  result.checks = check_fresh(result.question, result.rows, how.fresh, how.runs.seed);
  result.lug_gains = lug_gains(result.map, result.question, result.rows);
  result.by_twins = grains.coarser != nullptr;
  result.shares = shares_of(result.question, result.rows);
  return result;
}

Doubts doubts_of(const FailureMapResult& result, const MapGrains& grains) {
  Doubts all = doubts_at_rows(result);
  if (result.by_twins) std::erase_if(all, [](const Doubt& one) { return one.kind == DoubtKind::coarse_grains; });
  if (const std::size_t older = grains.runs ? grains.store->of_other_engines(*grains.runs) : 0; older > 0)
    all.push_back({DoubtKind::earlier_engine, {older}});
  return all;
}

MapShares shares_of(const FailureQuestion& question, const FailureMap& map) {
  constexpr int nodes = 9;
  const std::vector<Factor>& factors = question.factors;
  std::size_t all = 1;
  for (std::size_t j = 0; j < factors.size(); ++j) all *= nodes;
  std::size_t beyond = 0;
  std::array<std::size_t, 3> judged{};  // by Judged
  for (std::size_t i = 0; i < all; ++i) {
    Eigen::VectorXd values(static_cast<Eigen::Index>(factors.size()));
    std::size_t rest = i;
    for (std::size_t j = 0; j < factors.size(); ++j, rest /= nodes)
      values[j] = level_value(factors[j], static_cast<int>(rest % nodes), nodes);
    beyond += std::abs(map.at(question, values).value) > question.tolerance;
    ++judged[static_cast<std::size_t>(map.judged(question, values))];
  }
  const auto share = [all](std::size_t count) { return static_cast<double>(count) / static_cast<double>(all); };
  return {share(beyond), share(judged[0]), share(judged[1]), share(judged[2])};
}

}  // namespace soilbin::compare
