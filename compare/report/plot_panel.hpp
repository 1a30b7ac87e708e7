// One panel of a sheet, drawn, and how its colours are written in SVG: what plot.cpp and bars.cpp share, and a
// sheet as data.
#pragma once

#include <string>
#include <vector>

#include "compare/report/plot.hpp"

namespace soilbin::compare {

/// Attributes that stroke or fill with a palette's colour: class="s c2" stroke="#...".
std::string stroke(Palette palette, int color);
std::string fill(Palette palette, int color);

/// Attribute of a dash pattern, "" for solid.
std::string dashes(int dash);

/// The sheet's colour of a series: ordered palettes are spread over the colours that the sheet uses.
int color_of(const Sheet& sheet, const Series& series);

/// By how many pixels each series' points stand beside their place, so that error bars at one place do not hide each
/// other. 0 where none would.
std::vector<double> bar_shifts(const Plot& plot);

/// Width and height of one panel [px].
inline constexpr double panel_width = 420, panel_height = 300;

/// Everything inside a panel's <svg>, with its origin at the panel's upper left corner.
std::string panel(const Sheet& sheet, const Plot& plot);

}  // namespace soilbin::compare
