#include "compare/report/heat_map.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "compare/report/javascript.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/report/plot.hpp"
#include "scenario/quantity.hpp"

namespace soilbin::compare {
namespace {

constexpr double cell_width = 43, cell_height = 30, above = 48, below = 40, letter = 6.6;

double deepest(const HeatMap& map) {
  double most = map.limit;
  if (most > 0.0) return most;
  for (const auto& row : map.cells)
    for (const HeatCell& cell : row)
      if (std::isfinite(cell.value)) most = std::max(most, std::abs(cell.value));
  return most > 0.0 ? most : 1.0;
}

/// How deep a cell's colour is; `limit` as in HeatMap, above 0.
double heat_opacity(const HeatCell& cell, double limit) {
  const double depth = std::clamp(std::abs(cell.value) / limit, 0.0, 1.0) * (cell.counts ? 1.0 : 0.35);
  return 0.08 + 0.5 * depth;
}

std::string cell_svg(const HeatMap& map, double x, double y, double limit, std::size_t row, std::size_t column) {
  const HeatCell& cell = map.cells[row][column];
  if (!std::isfinite(cell.value))
    return fmt::format(R"(<rect class="cell-empty" fill="none" stroke="#dfe3e8" x="{:.0f}" y="{:.0f}" width="{:.0f}" )"
                       R"(height="{:.0f}"/>)",
                       x + 1, y + 1, cell_width - 2, cell_height - 2);
  // Class f and c0 or c1 give the page's colours in the dark; opacity is the depth.
  const std::string side = heat_class(cell);
  const char* fill = side == "none" ? "#8a919c" : colors(Palette::named)[side == "c0" ? 0 : 1].light;
  return fmt::format(
      R"(<g class="cell" role="img" data-row="{}" data-column="{}" data-x="{}" data-y="{}" data-value="{:.6g}" )"
      R"(data-tip="{}" aria-label="{}"><title>{}</title>)"
      R"(<rect class="f {}" fill="{}" fill-opacity="{:.2f}" x="{:.0f}" y="{:.0f}" width="{:.0f}" height="{:.0f}"/>)"
      R"(<text class="{}" fill="{}" x="{:.0f}" y="{:.0f}" text-anchor="middle"{}>{}</text></g>)",
      row, column, escaped(map.x[column]), escaped(map.y[row]), cell.value, escaped(cell.meaning),
      escaped(cell.meaning), escaped(cell.meaning), side, fill, heat_opacity(cell, limit), x + 1, y + 1, cell_width - 2,
      cell_height - 2, cell.counts ? "ink" : "quiet", cell.counts ? "#1a1d23" : "#5a6270", x + cell_width / 2,
      y + cell_height / 2 + 4, cell.counts ? R"( font-weight="600")" : "", escaped(cell.text));
}

}  // namespace

std::string heat_class(const HeatCell& cell) { return cell.value == 0.0 ? "none" : cell.value < 0.0 ? "c0" : "c1"; }

std::string heat_map_svg(const HeatMap& map) {
  std::size_t longest = 3;
  for (const std::string& name : map.y) longest = std::max(longest, name.size());
  const double left = 26 + letter * static_cast<double>(longest), limit = deepest(map);
  const double words = letter * static_cast<double>(std::max(map.title.size(), map.subtitle.size())) + 24;
  const double width = std::max(left + cell_width * static_cast<double>(map.x.size()) + 8, words);
  const double bottom = above + cell_height * static_cast<double>(map.y.size());
  std::string body =
      fmt::format(R"(<text class="ink" fill="#1a1d23" font-size="13" font-weight="600" x="4" y="17">{}</text>)",
                  escaped(map.title));
  body += fmt::format(R"(<text class="quiet" fill="#5a6270" x="4" y="35">{}</text>)", escaped(map.subtitle));
  for (std::size_t r = 0; r < map.y.size(); ++r) {
    const double y = above + cell_height * static_cast<double>(r);
    body += fmt::format(R"(<text class="quiet" fill="#5a6270" x="{:.0f}" y="{:.0f}" text-anchor="end">{}</text>)",
                        left - 6, y + cell_height / 2 + 4, escaped(map.y[r]));
    for (std::size_t c = 0; c < map.x.size(); ++c)
      body += cell_svg(map, left + cell_width * static_cast<double>(c), y, limit, r, c);
  }
  for (std::size_t c = 0; c < map.x.size(); ++c)
    body += fmt::format(R"(<text class="quiet" fill="#5a6270" x="{:.0f}" y="{:.0f}" text-anchor="middle">{}</text>)",
                        left + cell_width * (static_cast<double>(c) + 0.5), bottom + 16, escaped(map.x[c]));
  body += fmt::format(R"(<text class="quiet" fill="#5a6270" x="{:.0f}" y="{:.0f}" text-anchor="middle">{}</text>)",
                      left + cell_width * 0.5 * static_cast<double>(map.x.size()), bottom + 33, escaped(map.x_title));
  return fmt::format(
      R"(<svg xmlns="http://www.w3.org/2000/svg" class="plot heat" viewBox="0 0 {0:.0f} {1:.0f}" width="{0:.0f}" )"
      R"(height="{1:.0f}" role="group" aria-label="{2}" font-size="12">{3}</svg>)",
      width, bottom + below, escaped(map.title + ", " + map.subtitle + ", " + map.y_title + " by " + map.x_title),
      body);
}

std::string on_paper(std::string svg) {
  svg.insert(svg.find('>') + 1, R"(<rect width="100%" height="100%" fill="#ffffff"/><g font-family="sans-serif">)");
  svg.insert(svg.rfind("</svg>"), "</g>");
  return svg;
}

namespace {

Json one_map(const HeatMap& map) {
  Json json = {{"title", map.title}, {"cells", Json::array()}};
  for (const auto& row : map.cells)
    for (const HeatCell& cell : row)
      json["cells"].push_back({cell.text, cell.meaning, heat_class(cell),
                               read_number(fmt::format("{:.2f}", heat_opacity(cell, map.limit))).value(),
                               cell.counts ? 1 : 0,
                               read_number(fmt::format("{:.6g}", cell.value)).value_or(cell.value)});
  return json;
}

}  // namespace

std::string sliding_map_html(const SlidingMap& map, const std::string& caption) {
  std::size_t settings = 1, first = 0;
  for (std::size_t s = 0; s < map.sliders.size(); ++s) {
    const std::size_t places = map.sliders[s].settings.size();
    settings *= places;
    first = first * places + map.first.at(s);
  }
  if (settings != map.maps.size()) throw std::invalid_argument("sliding map: a map for each setting of the sliders");
  Json data = {{"sliders", Json::array()}, {"maps", Json::array()}};
  for (std::size_t s = 0; s < map.sliders.size(); ++s)
    data["sliders"].push_back(
        {{"name", map.sliders[s].name}, {"settings", map.sliders[s].settings}, {"first", map.first[s]}});
  for (const HeatMap& one : map.maps) data["maps"].push_back(one_map(one));
  return fmt::format(
      "<figure class=\"sliding-map\"><div class=\"sliders\"></div><div class=\"maps\"><div>{}</div></div><script "
      "type=\"application/json\">{}</script><figcaption>{}</figcaption></figure>\n",
      heat_map_svg(map.maps[first]), json_in_script(data.dump()), escaped(caption));
}

}  // namespace soilbin::compare
