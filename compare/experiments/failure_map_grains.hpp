// The grains' side of a failure map: runs in the soil bin as the experiments that a map is learnt from.
//
//   const VirtualTest grains = map_grains(map, question, settings, effects, keeping);
//   const FailureMapResult result = learn_map(map, grains, store, {});
#pragma once

#include "compare/experiments/soil_bin_runs.hpp"
#include "compare/failure_map/incline_map.hpp"

namespace soilbin::compare {

/// The map's wheel and conditions on grains, without the analytic model's effects. All that a run follows from beside
/// factors and packing is the experiment's identity. `question` is what a record holds that is begun.
VirtualTest map_grains(const InclineMap& map, const Case& question, const dem::DemSettings& settings,
                       const EffectVocabulary& effects, const RunKeeping& keeping);

}  // namespace soilbin::compare
