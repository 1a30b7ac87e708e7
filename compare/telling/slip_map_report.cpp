// A map of soils for Gazebo's LookupWheelSlip as it is told: the key `map` of soilbin-wheel-slip/1.
#include <fmt/core.h>

#include "compare/export/slip_map.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/report/number_text.hpp"
#include "compare/telling/export_reports.hpp"
#include "compare/telling/reports.hpp"
#include "scenario/markup.hpp"

namespace soilbin::compare {
namespace {

std::string lookup_sdf(const SlipMap& map, const std::string& file) {
  return fmt::format(
      "<plugin filename=\"gz-sim-lookup-wheel-slip-system\" name=\"gz::sim::systems::LookupWheelSlip\">\n"
      "  <slip_map>{}</slip_map>\n  <size_x>{:.6g}</size_x>\n  <size_y>{:.6g}</size_y>\n"
      "  <wheel_link_name>LINK</wheel_link_name>\n"
      "  <slip_compliance_lateral_delta>{:.9g}</slip_compliance_lateral_delta>\n"
      "  <slip_compliance_longitudinal_delta>{:.9g}</slip_compliance_longitudinal_delta>\n"
      "  <friction_delta>{:.9g}</friction_delta>\n</plugin>\n"
      "<!-- the ground's own friction: 100, as the smaller of the two holds -->\n",
      escaped(file), map.size, map.size, map.step.lateral, map.step.longitudinal, map.step.friction);
}

Table map_table(const SlipMap& map) {
  Table table{"Soils of the map",
              {"soil", "colour (R G B)", "lateral", "longitudinal", "friction", "off across [load]"}};
  table.text_columns = {true, true, false, false, false, false};
  for (const SlipMapSoil& one : map.soils) {
    const MappedSlip there = slip_at(map, one.colour);
    table.add({one.soil, fmt::format("{} {} {}", one.colour[0], one.colour[1], one.colour[2]), number(there.lateral),
               number(there.longitudinal), number(there.friction), number(there.friction - one.lateral_friction, 2)});
  }
  table.legend = fmt::format(
      "What the plugins have there: off the fit by half a colour's step at most, {} lateral, {} longitudinal, {} of "
      "friction. The map has one friction for both directions: that along the wheel; the last column is how far it is "
      "from the fitted one across it.",
      number(map.step.lateral / 2, 2), number(map.step.longitudinal / 2, 2), number(map.step.friction / 2, 2));
  return table;
}

Json mapped_json(const MappedSlip& slip) {
  return {{"lateral", finite(slip.lateral)},
          {"longitudinal", finite(slip.longitudinal)},
          {"friction", finite(slip.friction)}};
}

Json map_json(const SlipMap& map, const std::string& file) {
  Json soils = Json::array();
  for (const SlipMapSoil& one : map.soils) {
    Json fitted = mapped_json(one.fitted);
    fitted["lateral_friction"] = finite(one.lateral_friction);
    soils.push_back({{"soil", one.soil},
                     {"colour", {one.colour[0], one.colour[1], one.colour[2]}},
                     {"fitted", fitted},
                     {"mapped", mapped_json(slip_at(map, one.colour))}});
  }
  return {{"size", map.size},
          {"pixels", map.pixels},
          {"step", mapped_json(map.step)},
          {"nominal", mapped_json(map.nominal)},
          {"soils", soils},
          {"sdf", lookup_sdf(map, file)}};
}

}  // namespace

Report report_on(const WheelSlipFit& fit, const SlipMap& map, const std::string& file) {
  Report report = report_on(fit);
  report.add("Map", map_table(map));
  report.add(Prose{{fmt::format(
      "The map is a square of {} m about the world's origin, with {} from the lowest x to the highest. Paint your own "
      "with these colours, as a square too: the plugin takes the picture's height for its width. Beyond its edge a "
      "wheel keeps what it had last.",
      number(map.size), map.soils.size() == 1 ? "one soil" : "the soils in stripes of equal width")}});
  report.add("For the map's SDF, beside that of WheelSlip", Code{lookup_sdf(map, file)});
  report.data = [&map, file, wheel = report.data] {
    Json document = wheel();
    document["map"] = map_json(map, file);
    return document;
  };
  return report;
}

}  // namespace soilbin::compare
