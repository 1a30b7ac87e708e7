// A failure map learnt, with all that is to be said of it: where the models agree, how well the map knows, what there
// is to doubt. telling/failure_map_report.cpp tells it.
//
//   const FailureMapResult result = learn_map(map, {&runs, &coarser, &store}, {.tolerance = 0.1});
//   for (const AgreementClause& clause : result.clauses) clause.lower, clause.upper;
#pragma once

#include "compare/doubts/doubt.hpp"
#include "compare/failure_map/incline_map.hpp"

namespace soilbin::compare {

/// Shares of the box, over a grid of 9 nodes a factor.
struct MapShares {
  double beyond = 0.0;                                ///< |difference| is above the tolerance, by the map's own value
  double agree = 0.0, differ = 0.0, undecided = 0.0;  ///< FailureMap::judged
};

/// A map and what was found with it.
struct FailureMapResult {
  InclineMap map;
  FailureQuestion question;
  FailureMap rows;
  std::vector<AgreementClause> clauses;  ///< where the models agree
  std::vector<Coordinates> coordinates;
  std::vector<FreshCheck> checks;
  std::vector<LugGain> lug_gains;
  MapShares shares;
  bool by_twins = false;  ///< whether the resolution errors are the map's own
};

/// How a map is learnt.
struct MapLearning {
  FailureMapOptions runs{};  ///< which conditions are run
  int rounds = 4;            ///< further runs for each clause (agreement)
  int fresh = 0;             ///< conditions that are predicted, then run (check_fresh)
  double tolerance = 0.10;   ///< share of the load beyond which the models count as different
};

/// Throws what map_failures throws. Where `grains` waits for experiments, the result is not finished. What `grains`
/// points to must outlive the result.
FailureMapResult learn_map(const InclineMap& map, const MapGrains& grains, const MapLearning& how);

/// Of both models' answers where they were run, and of the runs that the store took from an earlier engine. Coarse
/// grains are no doubt where twins tell what they do.
Doubts doubts_of(const FailureMapResult& result, const MapGrains& grains);

MapShares shares_of(const FailureQuestion& question, const FailureMap& map);

}  // namespace soilbin::compare
