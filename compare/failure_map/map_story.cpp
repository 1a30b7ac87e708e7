#include "compare/failure_map/map_story.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "compare/doubts/doubts.hpp"

namespace soilbin::compare {
namespace {

/// Where the models agree: without lugs at any slip, else also up to a slip; with any lugs; and the largest box of all.
std::vector<AgreementClause> agreements(const FailureQuestion& question, FailureMap& rows, int rounds) {
  std::vector<AgreementClause> clauses;
  const auto add = [&](const std::vector<Role>& roles) {
    if (const auto clause = agreement(question, rows, roles, 9, rounds)) clauses.push_back(*clause);
    return !clauses.empty();
  };
  if (!add({Role::limited, Role::held, Role::limited, Role::whole}))
    add({Role::limited, Role::held, Role::limited, Role::limited});
  add({Role::limited, Role::limited, Role::limited, Role::whole});
  add({Role::bounded, Role::bounded, Role::bounded, Role::bounded});
  return clauses;
}

/// Of the analytic model and the grains at the conditions that were run, with the highest lugs.
std::vector<std::string> doubts_at_rows(const MapStory& story) {
  Case question;
  std::vector<Eigen::VectorXd> rows;
  for (const FailureRow& row : story.rows.rows) {
    rows.push_back(row.values);
    question.study.conditions.push_back(condition_at(story.map, row.values));
  }
  if (rows.empty()) return {};
  const auto height = [](const Eigen::VectorXd& values) { return values[map_lug_height]; };
  question.scenario = scenario_at(story.map, *std::ranges::max_element(rows, {}, height));
  question.study.models = {{ModelKind::bekker_wong, question.scenario.effects, ""}};
  question.scenario.effects.clear();
  const std::vector<ModelAnswers> study = run_study(question);
  question.study.models.push_back({ModelKind::dem, {}, ""});
  return doubts(question, study);
}

}  // namespace

MapStory learn_map(const InclineMap& map, const VirtualTest& grains, ExperimentStore& store, const MapLearning& how) {
  MapStory story;
  story.map = map;
  story.question = failure_question(story.map, grains, store, how.packing, how.tolerance);
  story.rows = map_failures(story.question, how.runs);
  story.clauses = agreements(story.question, story.rows, how.rounds);
  story.coordinates = compare_coordinates(story.map, story.rows);
  story.checks = check_fresh(story.question, story.rows, how.fresh, how.runs.seed);
  return story;
}

std::vector<std::string> doubts_of(const MapStory& story, const VirtualTest& grains, const ExperimentStore& store) {
  std::vector<std::string> all = doubts_at_rows(story);
  if (const std::size_t older = store.of_other_engines(grains); older > 0)
    all.push_back(
        fmt::format("{} of the experiments were made by an earlier engine, whose shear springs did "
                    "not turn with the spin of a pair: this one's answers differ",
                    older));
  return all;
}

}  // namespace soilbin::compare
