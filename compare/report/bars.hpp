// Bars of signed numbers side by side, as SVG: parts of a budget by each model.
#pragma once

#include <string>
#include <vector>

namespace soilbin::compare {

/// A group of bars with one name: a bar each of Bars::sides; NaN: no bar, and "-" in its place.
struct BarGroup {
  std::string name;
  std::vector<double> values;
};

struct Bars {
  std::string title;               ///< what the numbers are, with their unit
  std::vector<std::string> sides;  ///< colours in their order
  std::vector<BarGroup> groups;
  std::string unit = "N";  ///< said of a bar that is pointed at
};

/// An <svg> element that scales with the page, its legend in it. `colors_of_sides`: in plot.hpp's named palette.
std::string bars_svg(const Bars& bars, const std::vector<int>& colors_of_sides);

}  // namespace soilbin::compare
