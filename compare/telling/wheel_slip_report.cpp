// A wheel as Gazebo's plugin WheelSlip has it, as it is told; soilbin-wheel-slip/1.
#include <fmt/core.h>

#include "compare/export/wheel_slip.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/report/number_text.hpp"
#include "compare/sweep/model_names.hpp"
#include "compare/sweep/varying.hpp"
#include "compare/telling/reports.hpp"

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
  Json points = Json::array();
  for (const SlipPoint& point : line.points)
    points.push_back({{"slip", finite(point.slip)}, {"force_share", finite(point.force_share)}});
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

}  // namespace soilbin::compare
