#include "compare/report/sliding_map.hpp"

#include <fmt/core.h>

#include <stdexcept>

#include "compare/report/javascript.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/report/plot.hpp"

namespace soilbin::compare {
namespace {

Json one_map(const HeatMap& map) {
  Json json = {{"title", map.title}, {"cells", Json::array()}};
  for (const auto& row : map.cells)
    for (const HeatCell& cell : row)
      json["cells"].push_back({cell.text, cell.meaning, heat_class(cell),
                               std::stod(fmt::format("{:.2f}", heat_opacity(cell, map.limit))), cell.counts ? 1 : 0,
                               std::stod(fmt::format("{:.6g}", cell.value))});
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
      "<figure class=\"sliding-map\"><div class=\"sliders\"></div><div class=\"maps\"><div>{}</div></div>"
      "<script type=\"application/json\">{}</script><figcaption>{}</figcaption></figure>\n",
      heat_map_svg(map.maps[first]), json_in_script(data.dump()), escaped(caption));
}

}  // namespace soilbin::compare
