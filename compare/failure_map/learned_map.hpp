// A failure map learnt, with all that is to be said of it: where the models agree, how well the map knows, what there
// is to doubt. telling/failure_map_report.cpp tells it.
//
//   const FailureMapResult result = learn_map(map, grains, store, {.tolerance = 0.1});
//   for (const AgreementClause& clause : result.clauses) clause.lower, clause.upper;
#pragma once

#include "compare/doubts/doubt.hpp"
#include "compare/failure_map/incline_map.hpp"

namespace soilbin::compare {

/// A map and what was found with it.
struct FailureMapResult {
  InclineMap map;
  FailureQuestion question;
  FailureMap rows;
  std::vector<AgreementClause> clauses;  ///< where the models agree
  std::vector<Coordinates> coordinates;
  std::vector<FreshCheck> checks;
};

/// How a map is learnt.
struct MapLearning {
  FailureMapOptions runs{};   ///< which conditions are run
  int rounds = 4;             ///< further runs for each clause (agreement)
  int fresh = 0;              ///< conditions that are predicted, then run (check_fresh)
  double tolerance = 0.10;    ///< share of the load beyond which the models count as different
  std::uint64_t packing = 1;  ///< seed of the bed
};

/// Throws what map_failures throws. Where `grains` waits for experiments, the result is not finished. `grains` and
/// `store` must outlive the result.
FailureMapResult learn_map(const InclineMap& map, const VirtualTest& grains, ExperimentStore& store,
                           const MapLearning& how);

/// Of both models' answers where they were run, and of the runs that the store took from an earlier engine.
Doubts doubts_of(const FailureMapResult& result, const VirtualTest& grains, const ExperimentStore& store);

/// Share of the box, by the map, in which |difference| is above the tolerance: over a grid of 9 nodes a factor.
double share_beyond(const FailureMapResult& result);

}  // namespace soilbin::compare
