// The grains' side of a failure map: runs in the soil bin as the experiments that a map is learnt from.
//
//   const VirtualTest grains = map_grains(map, settings, keeping);
//   const FailureMapResult result = learn_map(map, {&grains, nullptr, &store}, {});
#pragma once

#include "compare/experiments/soil_bin_runs.hpp"
#include "compare/failure_map/incline_map.hpp"

namespace soilbin::compare {

/// The map's wheel and conditions on grains, without the analytic model's effects. A graded bed is fine as deep as the
/// map's highest lugs ask for, so one bed serves all heights. All that a run follows from beside factors and packing is
/// the experiment's identity. Of `keeping` what can be looked at and the source are read.
VirtualTest map_grains(const InclineMap& map, const dem::DemSettings& settings, const RunKeeping& keeping);
/// The runs with grains coarser_by times as large.
VirtualTest coarser_map_grains(InclineMap map, const dem::DemSettings& settings, const RunKeeping& keeping);

}  // namespace soilbin::compare
