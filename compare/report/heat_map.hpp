// A grid of numbers in colours that diverge from zero, as SVG; every cell also tells its number in text.
#pragma once

#include <string>
#include <vector>

namespace soilbin::compare {

struct HeatCell {
  double value = 0.0;   ///< NaN: an empty cell
  std::string text;     ///< in the cell: "-12"
  std::string meaning;  ///< for who points at it or hears it: "4 kN, slip 20 %: -480 N, 3.1 sigma, difference"
  bool counts = true;   ///< false: drawn faint, as what is not called a difference
};

struct HeatMap {
  std::string title;     ///< what the numbers are, with their unit
  std::string subtitle;  ///< of whom: "dem less bekker_wong"
  std::string x_title, y_title;
  std::vector<std::string> x, y;             ///< names of columns and rows
  std::vector<std::vector<HeatCell>> cells;  ///< a row each of y
  double limit = 0.0;                        ///< |value| of the deepest colour; 0: the largest there is
};

/// The class of a cell's colour: "c0" below zero, "c1" above, "none" at zero.
std::string heat_class(const HeatCell& cell);

/// How deep a cell's colour is; `limit` as in HeatMap, above 0.
double heat_opacity(const HeatCell& cell, double limit);

/// An <svg> element of its natural size, its text 12 px high; a page lets it scroll rather than shrink. Blue below
/// zero, orange above, so that most colour-blind people tell them apart; the sign is in the text as well.
std::string heat_map_svg(const HeatMap& map);

}  // namespace soilbin::compare
