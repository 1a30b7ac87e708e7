// A grid of numbers in colours that diverge from zero, as SVG; every cell also holds its number as text.
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

/// An <svg> element of its natural size, its text 12 px high; a page lets it scroll rather than shrink. Blue below
/// zero, orange above, so that most colour-blind people tell them apart; the sign is in the text as well.
std::string heat_map_svg(const HeatMap& map);

/// That element as a picture by itself, whatever is behind it: on white paper, in a sans-serif face.
std::string on_paper(std::string svg);

// Heat maps of which one is shown at a time, picked by sliders; without scripts the first alone.
//
//   const SlidingMap map{{{"slip", {"5 %", "20 %"}}, {"lug height", {"0 mm", "30 mm"}}}, maps};   // 4 maps
//   page.raw(sliding_map_html(map, "Loads across, angles up."));

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
