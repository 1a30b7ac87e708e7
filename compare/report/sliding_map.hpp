// Heat maps of which one is shown at a time, picked by sliders; without scripts the first alone.
//
//   const SlidingMap map{{{"slip", {"5 %", "20 %"}}, {"lug height", {"0 mm", "30 mm"}}}, maps};   // 4 maps
//   page.raw(sliding_map_html(map, "Loads across, angles up."));
#pragma once

#include <string>
#include <vector>

#include "compare/report/heat_map.hpp"

namespace soilbin::compare {

struct Slider {
  std::string name;
  std::vector<std::string> settings;  ///< what the slider says at each of its places
};

/// A map for each setting of the sliders, the last slider's settings next to each other. All have the same rows and
/// columns and a cell everywhere.
struct SlidingMap {
  std::vector<Slider> sliders;
  std::vector<HeatMap> maps;
  std::vector<std::size_t> first;  ///< place of each slider at the start
};

/// A figure. Throws std::invalid_argument where there is not a map for each setting.
std::string sliding_map_html(const SlidingMap& map, const std::string& caption);

}  // namespace soilbin::compare
