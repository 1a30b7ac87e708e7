// A wheel as Gazebo's plugin WheelSlip has it, as it is told; soilbin-wheel-slip/1.
#include <fmt/core.h>

#include "compare/export/slip_map.hpp"
#include "compare/export/wheel_slip.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/report/number_text.hpp"
#include "compare/sweep/model_names.hpp"
#include "compare/sweep/varying.hpp"
#include "compare/telling/reports.hpp"
#include "scenario/markup.hpp"

namespace soilbin::compare {
namespace {

std::string sdf_of(const WheelSlipFit& fit) {
  return fmt::format(
      "<wheel link_name=\"LINK\">\n  <slip_compliance_lateral>{:.6g}</slip_compliance_lateral>\n"
      "  <slip_compliance_longitudinal>{:.6g}</slip_compliance_longitudinal>\n"
      "  <wheel_normal_force>{:.6g}</wheel_normal_force>\n  <wheel_radius>{:.6g}</wheel_radius>\n</wheel>\n"
      "<!-- friction of the wheel's collision: mu (lateral, fdir1 along the axle) {:.4g}, mu2 (longitudinal) {:.4g} "
      "-->\n",
      fit.lateral.compliance, fit.longitudinal.compliance, fit.normal_load, fit.radius, fit.lateral.friction,
      fit.longitudinal.friction);
}

Table lines_table(const WheelSlipFit& fit) {
  Table table{"Lines", {"direction", "slip compliance", "friction", "rms error [load]", "largest error [load]"}};
  const auto add = [&](const char* name, const SlipLine& line) {
    table.add({name, number(line.compliance), number(line.friction), number(line.rms_error, 3),
               number(line.largest_error, 3)});
  };
  add("longitudinal", fit.longitudinal);
  add("lateral", fit.lateral);
  table.legend = "Force = load x slip/compliance, up to load x friction; errors against the model's curve, in loads.";
  return table;
}

std::vector<BackedSentence> words_on(const WheelSlipFit& fit) {
  std::vector<BackedSentence> said;
  if (fit.idle_slip > 0.0)
    said.push_back(
        {"Without pull",
         fmt::format(
             "On this soil the driven wheel slips by {} % and takes {} N m before it pulls. The plugin has neither: "
             "its slip counts from there. A friction of {} N m in the wheel's joint makes the pull right for each "
             "torque; the wheel then travels too far for each turn.",
             number(100 * fit.idle_slip, 3), number(fit.idle_torque, 3), number(fit.idle_torque, 3))});
  said.push_back({"Range", fmt::format("Slips up to 60 % without yaw; yaws of 2 to 20 deg at {} % slip, at this load "
                                       "and on this soil. The plugin has no sinkage, and its forces do not know each "
                                       "other.",
                                       number(100 * fit.lateral_slip))});
  return said;
}

Json line_json(const SlipLine& line) {
  const Json points = list_of(line.points, [](const SlipPoint& point) {
    return Json{{"slip", finite(point.slip)}, {"force_share", finite(point.force_share)}};
  });
  return {{"slip_compliance", finite(line.compliance)},
          {"friction", finite(line.friction)},
          {"rms_error", finite(line.rms_error)},
          {"largest_error", finite(line.largest_error)},
          {"points", points}};
}

}  // namespace

Report report_on(const WheelSlipFit& fit) {
  const Scenario& scenario = fit.question.scenario;
  Report report{"Gazebo wheel slip: " + scenario.tire.name, "The plugin WheelSlip's numbers for a wheel on soft soil.",
                fmt::format("{} on {}, load {}\nby {}", in_words(scenario.tire), in_words(scenario.soil),
                            newtons(fit.normal_load), model_in_words(fit.question.study.models.front().label))};
  report.add(Sentences(words_on(fit)));
  report.add(WarningsHere());
  report.add("Lines", lines_table(fit));
  report.add("For the plugin's SDF", Code{sdf_of(fit)});
  report.data = [&fit] {
    return Json{{"format", "soilbin-wheel-slip/1"},        {"tire", fit.question.scenario.tire.name},
                {"soil", fit.question.scenario.soil.name}, {"model", fit.question.study.models.front().label},
                {"wheel_normal_force", fit.normal_load},   {"wheel_radius", fit.radius},
                {"lateral_slip", fit.lateral_slip},        {"idle_slip", fit.idle_slip},
                {"idle_torque", fit.idle_torque},          {"longitudinal", line_json(fit.longitudinal)},
                {"lateral", line_json(fit.lateral)},       {"sdf", sdf_of(fit)}};
  };
  return report;
}

// A map of soils for Gazebo's LookupWheelSlip as it is told: the key `map` of soilbin-wheel-slip/1.

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
