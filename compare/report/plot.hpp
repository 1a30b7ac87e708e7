// Line plots as SVG: axes with units, legend, error bands, points with error bars. No scripts, no external resources.
//
// Every mark has a class ('c2': third named colour, 'q4': fifth ordered colour, 'ink', 'quiet', 'grid', 'paper') beside
// its colour, so that a page can give it other colours in the dark (page.hpp does).
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scenario/markup.hpp"

namespace soilbin::compare {

/// How a series is drawn.
enum class Mark { line, points, line_and_points };

/// Which palette a sheet's colours come from.
enum class Palette {
  named,    ///< things that have no order: models, soils
  ordered,  ///< things that have: loads, angles
};

/// One curve. x and y have the same length; a y that is not finite breaks the line.
struct Series {
  std::string label{};  ///< in the legend; empty: not there. Series with one label share an entry.
  std::vector<double> x{}, y{};
  std::vector<double> error{};  ///< one standard error of each y: a band along lines, bars at points; empty: none
  bool band = true;             ///< whether its errors are drawn; else readings alone tell them
  std::vector<double> base{};   ///< as long as y: fills from there to y, with no line; for parts piled up. Empty: none
  Mark mark = Mark::line;
  int color = 0;  ///< from 0, of the sheet's palette
  int dash = 0;   ///< 0: solid, then dashed, dotted, dash-dotted
};

struct Axis {
  std::string title{};            ///< with its unit: "slip [%]"; of y also empty, the plot's title then says it
  std::optional<double> lower{};  ///< absent: what the series need
  std::optional<double> upper{};
};

/// The series with a point for each of the samples behind its own; x and y: members, or functions of a sample.
template <class Samples, class X, class Y>
Series over_samples(Series series, const Samples& samples, const X& x, const Y& y) {
  for (const auto& sample : samples)
    series.x.push_back(std::invoke(x, sample)), series.y.push_back(std::invoke(y, sample));
  return series;
}

/// A line through y at 101 places from 0 to `to`, a thousand times as large: a fit's curve over readings in m, in mm.
Series fitted_curve(std::string label, int color, double to, const std::function<double(double)>& y);

/// One panel.
struct Plot {
  std::string title;  ///< what y is, with its unit: "Drawbar pull [N]"
  Axis x{}, y{};
  std::vector<Series> series{};
  bool identity_line = false;  ///< y = x, for predicted against measured
};

/// Panels that share a legend and a palette.
struct Sheet {
  std::string title;
  std::vector<Plot> plots{};
  Palette palette = Palette::named;
  std::string note{};  ///< a line under the title of a stand-alone file: of what it is, what bands are
};

/// A sheet as one stand-alone SVG file on white: panels in two columns (one where there is one), the legend below.
std::string svg(const Sheet& sheet);

/// One panel as an <svg> element that scales with the page, without a legend.
std::string panel_svg(const Sheet& sheet, std::size_t plot);

/// One entry of the legend: a small <svg> drawn like the series.
struct LegendEntry {
  std::string label;
  std::string swatch;
};
std::vector<LegendEntry> legend(const Sheet& sheet);

/// A palette's colours: in the light, in the dark.
struct Color {
  const char* light;
  const char* dark;
};
std::vector<Color> colors(Palette palette);

/// Round values that divide [lower, upper] into about `count` parts.
std::vector<double> ticks(double lower, double upper, int count);

// A sheet of plots as data: for the scripts of a page, and for who wants a figure's numbers.

/// {"title", "plots": [{"title", "x": {"title", "lower", "upper"}, "y", "series": [{"label", "x", "y", "error", "base",
/// "mark", "color": "c0", "dash"}]}]}; numbers have six digits, and what is not a number is null. Where there is one,
/// "shift" [px] of the points; "band": false where errors are told and not drawn.
nlohmann::ordered_json to_json(const Sheet& sheet);

/// A sheet as CSV, a row a point: plot, series, x, y (of an area what it adds to the pile), error.
std::string sheet_csv(const Sheet& sheet);

}  // namespace soilbin::compare
