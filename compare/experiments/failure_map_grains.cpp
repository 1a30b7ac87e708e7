#include "compare/experiments/failure_map_grains.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <memory>

#include "scenario/errors.hpp"
#include "scenario/traction_channels.hpp"

namespace soilbin::compare {

VirtualTest map_grains(const InclineMap& map, const dem::DemSettings& asked, const RunKeeping& keeping) {
  dem::DemSettings settings = asked;
  settings.highest_lugs = std::max(settings.highest_lugs, map.factors.at(map_lug_height).upper);
  VirtualTest test;
  test.identity = fmt::format("soil bin, {}, speed {}", name_of(map.incline), map.base.speed);
  for (const auto& [name, value] : inputs_of(settings, map.scenario))
    if (name != "tire.lug_height") test.identity += fmt::format("\n{} {}", name, value);
  test.factors = map.factors;
  test.targets = grain_channels();
  const auto last = std::make_shared<RecordedRun>();
  test.on_saved = [last] {
    if (last->on_saved) last->on_saved();
  };
  test.run = [map, last, bin = std::make_shared<SoilBinRuns>(settings, keeping)](const Eigen::VectorXd& values,
                                                                                 std::uint64_t seed) {
    Scenario grains = scenario_at(map, values);
    grains.effects.clear();
    *last = (*bin)(grains, {condition_at(map, values), seed});
    if (!last->answer.result) throw NoSolution(last->answer.error);
    std::vector<Estimate> measured;
    for (const TractionChannel& channel : traction_channels)
      measured.push_back((*last->answer.result).*channel.predicted);
    return measured;
  };
  return test;
}

VirtualTest coarser_map_grains(InclineMap map, const dem::DemSettings& settings, const RunKeeping& keeping) {
  map.scenario = with_coarser_grains(map.scenario);
  return map_grains(map, settings, keeping);
}

}  // namespace soilbin::compare
