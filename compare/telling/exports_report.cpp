// What other programs take, as it is told: a table of forces (soilbin-force-table/1), units of FMI, the numbers of
// Gazebo's plugins, soils of Chrono.
#include <fmt/core.h>

#include <array>
#include <iterator>
#include <string>
#include <vector>

#include "bekker_wong/effects/titles.hpp"
#include "compare/export/force_table.hpp"
#include "compare/export/wheel_fmu.hpp"
#include "compare/export/wheel_slip.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/report/number_text.hpp"
#include "compare/sweep/answers.hpp"
#include "compare/sweep/result_json.hpp"
#include "compare/sweep/varying.hpp"
#include "compare/telling/reports.hpp"
#include "scenario/markup.hpp"
#include "scenario/scm_soil.hpp"
#include "scenario/soil_parameters.hpp"

namespace soilbin::compare {
namespace {

std::vector<BackedSentence> verdicts_on(const ForceTable& table) {
  std::vector<BackedSentence> said;
  const auto [channel, share] = roughest(table);
  const double per = channel->channel->per_si;
  const std::string unit(channel->channel->unit);
  said.push_back(
      {"Interpolation",
       table.cells == 0
           ? "It could not be checked: no cell of the table has answers at all of its corners."
           : fmt::format("Between its nodes the table lies within {} of the model's largest {}: {} {} at most, {} {} "
                         "root mean square, in the middles of {}. The other channels have smaller shares.",
                         percent(share), channel->channel->title, number(channel->largest_error * per, 3), unit,
                         number(channel->rms_error * per, 3), unit, counted(table.cells, "cell"))});
  if (share > rough_share) {
    const ConditionView& view = *coarsest(table).view;
    said.push_back({"Refine it", fmt::format("Most of the error comes from the steps of '{}': half of them leave a "
                                             "quarter of it where the curves are smooth.",
                                             view.name)});
  }
  if (table.without_answer > 0)
    said.push_back({"Gaps", fmt::format("{} of {} have no answer of the model: a look-up beside one says so.",
                                        table.without_answer, counted(table.nodes.answers.size(), "node"))});
  if (table.cells_without_answer > 0)
    said.push_back({"Gaps between nodes",
                    fmt::format("In the middles of {} of {} the model has no answer, though it has one at their "
                                "corners: there the table answers where the model does not.",
                                table.cells_without_answer, counted(table.cells, "cell"))});
  return said;
}

Table axes_table(const ForceTable& table) {
  Table told{"Axes", {"condition", "from", "to", "unit", "nodes", "error along it [%]"}};
  told.text_columns = {true, false, false, true, false, false};
  for (const TableAxis& axis : table.axes)
    told.add({std::string(axis.view->title), number(axis.nodes.front() * axis.view->per_si),
              number(axis.nodes.back() * axis.view->per_si),
              axis.view->unit.empty() ? "-" : std::string(axis.view->unit), std::to_string(axis.nodes.size()),
              number(100 * axis.error_share, 2)});
  told.legend = "Error along it: root mean square half-way between nodes of this axis alone, by the channel's largest.";
  return told;
}

Table errors_table(const ForceTable& table) {
  Table told{"Error of the interpolation",
             {"channel", "unit", "largest value", "largest error", "root mean square", "largest error [%]"}};
  told.text_columns = {true, true, false, false, false, false};
  for (const TableChannel& channel : table.channels) {
    const double per = channel.channel->per_si;
    told.add({std::string(channel.channel->title), std::string(channel.channel->unit), number(channel.scale * per),
              number(channel.largest_error * per, 3), number(channel.rms_error * per, 3),
              channel.scale > 0.0 ? number(100 * channel.largest_error / channel.scale, 3) : "-"});
  }
  told.legend =
      "Against the model, in the middles of the cells. The standard errors of the soil are beside each value.";
  return told;
}

Json force_table_json(const ForceTable& table) {
  Json document = {{"format", "soilbin-force-table/1"},
                   {"tire", table.question.scenario.tire.name},
                   {"soil", table.question.scenario.soil.name},
                   {"model", table.nodes.choice.label},
                   {"fixed", to_json(table.fixed)},
                   {"nodes", table.nodes.answers.size()},
                   {"nodes_without_answer", table.without_answer},
                   {"cells", table.cells},
                   {"cells_without_answer", table.cells_without_answer},
                   {"axes", Json::array()},
                   {"channels", Json::array()}};
  for (const TableAxis& axis : table.axes) {
    document["fixed"].erase(std::string(axis.view->name));
    document["axes"].push_back(
        {{"name", axis.view->name}, {"nodes", list_of(axis.nodes, finite)}, {"error_share", finite(axis.error_share)}});
  }
  for (const TableChannel& channel : table.channels)
    document["channels"].push_back({{"name", channel.channel->name},
                                    {"unit", channel.channel->si_unit},
                                    {"largest_error", finite(channel.largest_error)},
                                    {"rms_error", finite(channel.rms_error)},
                                    {"scale", finite(channel.scale)},
                                    {"values", list_of(channel.values, finite)},
                                    {"std_errors", list_of(channel.std_errors, finite)}});
  return document;
}

}  // namespace

Report report_on(const ForceTable& table) {
  const Case& question = table.question;
  const std::string asked = fmt::format("{} on {}", in_words(question.scenario.tire), in_words(question.scenario.soil));
  const std::string errors = errors_in_words(question);
  Report report{
      "Force table of " + question.scenario.tire.name,
      "Forces on a grid of conditions, for programs that look them up.",
      fmt::format("{}\nby {}{}", asked, model_in_words(table.nodes.choice.label), errors.empty() ? "" : "\n" + errors)};
  report.add(Sentences(verdicts_on(table)));
  report.add(WarningsHere());
  report.add("Axes", axes_table(table));
  report.add("Errors", errors_table(table));
  report.data = [&table] { return force_table_json(table); };
  report.csv = [&table] { return csv_of(table); };
  report.data_name = report.csv_name = "table";
  return report;
}

// A driven wheel as a unit of FMI 2.0 as it is told; soilbin-fmu/1.

namespace {

const char* role_in_words(FmuVariable::Role role) {
  return role == FmuVariable::Role::input ? "input" : role == FmuVariable::Role::parameter ? "parameter" : "output";
}

std::vector<BackedSentence> words_on(const WheelFmu& fmu, const CompiledC& compiled) {
  std::vector<BackedSentence> said;
  said.push_back({"Range",
                  "Outside the table the unit uses the nearest values, returns fmi2Warning and logs what was "
                  "left. Where the table has no answer it returns fmi2Error, and the wheel stays as it was."});
  said.push_back({"Motion", fmt::format("Steady, the wheel is the table. What is faster than {} rad/s is not in it: it "
                                        "takes what soil the contact has seen by its length alone.",
                                        number(fmu.rest_frequency, 2))});
  said.push_back(compiled.library
                     ? BackedSentence{"Compiled",
                                      "The unit holds a library for Linux of this machine's processor, and "
                                      "its source in C99 for others."}
                     : BackedSentence{"Not compiled", fmt::format("The unit holds its source alone: {}. Programs that "
                                                                  "compile units take it; else install a compiler "
                                                                  "(Debian: apt install gcc) and export again.",
                                                                  compiled.why_not)});
  return said;
}

Table fmu_variables(const WheelFmu& fmu) {
  Table table{"Variables", {"name", "", "unit", "start", "meaning"}};
  table.text_columns = {true, true, true, false, true};
  for (const FmuVariable& variable : fmu.variables)
    table.add({variable.name, role_in_words(variable.role), variable.unit,
               variable.start ? number(*variable.start) : "", variable.meaning});
  table.add(
      {"spin_is_given", "parameter", "", "false", "the wheel turns with given_spin, in place of by motor_torque"});
  table.add({"outside", "output", "", "", "0 where the last step stayed in the table"});
  return table;
}

Json fmu_json(const WheelFmu& fmu, const CompiledC& compiled, Json table) {
  const Json variables = list_of(fmu.variables, [](const FmuVariable& variable) {
    Json one = {{"name", variable.name}, {"role", role_in_words(variable.role)}, {"unit", variable.unit}};
    if (variable.start) one["start"] = *variable.start;
    return one;
  });
  Json document = {{"format", "soilbin-fmu/1"},
                   {"name", fmu.name},
                   {"guid", fmu.guid},
                   {"compiled", compiled.library.has_value()},
                   {"rest_frequency", fmu.rest_frequency},
                   {"variables", variables},
                   {"table", std::move(table)}};
  if (!compiled.library) document["why_not_compiled"] = compiled.why_not;
  return document;
}

}  // namespace

Report report_on(const WheelFmu& fmu, const CompiledC& compiled) {
  Report report = report_on(fmu.table);
  report.title = "FMI unit of " + fmu.table.question.scenario.tire.name;
  report.subtitle = "A driven wheel on soft soil for co-simulation by FMI 2.0.";
  report.add(Sentences(words_on(fmu, compiled)));
  report.add("Variables", fmu_variables(fmu));
  report.data = [&fmu, &compiled, table = report.data] { return fmu_json(fmu, compiled, table()); };
  return report;
}

// A wheel as Gazebo's plugin WheelSlip has it, as it is told; soilbin-wheel-slip/1.

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
         fmt::format("On this soil the driven wheel slips by {} % and takes {} N m before it pulls. The plugin has "
                     "neither: its slip counts from there. A friction of {} N m in the wheel's joint makes the pull "
                     "right for each torque; the wheel then travels too far for each turn.",
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

// A soil for Chrono's SCM terrain, and what that terrain does not have of our wheel.

namespace {

/// What SCM has of one of our effects of wheel and soil: read in SCMTerrain.cpp of projectchrono/chrono.
struct InScm {
  const char* effect;
  bool lacks;
  const char* words;
};

constexpr std::array<InScm, 14> in_scm = {{
    {"slip_sinkage", true, "the sinkage follows from the normal stress alone, at every slip"},
    {"lug_thrust", true, "lugs of the wheel's mesh press deeper; their faces push no soil"},
    {"sidewall_bulldozing", true, "a side wall pushes no soil: stresses act on the ground's own surface"},
    {"shear_hump", true, "the shear stress rises to c + p tan phi and stays there"},
    {"pressure_dependent_shear_modulus", true, "one K for every normal stress"},
    {"hard_layer", true, "nothing changes with depth"},
    {"moisture", true, "only as other values, by place: RegisterSoilParametersCallback"},
    {"slope_weakening", true, "the soil's own weight on a slope takes none of its strength"},
    {"bulldozing", false,
     "EnableBulldozing moves soil to the rut's sides; its resistance is that of what piles up ahead"},
    {"exit_angle", false, "the soil springs back by the elastic stiffness, which is chosen here"},
    {"multipass", false, "the rut stays, with the pressure that it has carried; c, phi and K stay those of fresh soil"},
    {"tire_flexibility", false, "by a deformable tire of Chrono"},
    {"rate_dependence", false, "a damping by the vertical speed, which is chosen here"},
    {"interface_limit", false, "SCMContactableData: c, phi and K between wheel and soil"},
}};

constexpr const char* scm_differences[] = {
    "SCM has no angle of maximum stress (c1, c2): each point's pressure follows from its own depth, so that it is "
    "largest where the wheel is deepest.",
    "b is that of the contact patch, 1/b = perimeter/(2 area); here it is the wheel's width.",
    "SCM has no standard errors: those of the soil stand in the file's section 'soilbin', which Chrono does not read.",
};

const Estimate& scm_value(const SemiEmpiricalSoil& soil, const ScmParameter& p) {
  return soil.*soil_parameter(p.name).value;
}

Json scm_document(const Soil& soil, const std::string& version) {
  const SemiEmpiricalSoil& semi = *soil.semi_empirical;
  const ScmChoices chosen = scm_choices(semi);
  Json document = {{"Type", "SCM"},
                   {"Patch dimensions", {{"Length", chosen.length}, {"Width", chosen.width}}},
                   {"Grid spacing", chosen.grid_spacing},
                   {"Soil parameters", Json::object()},
                   {"Simulation settings", {{"Proxy contact radius", 0.002}, {"Fix proxies", true}}}};
  Json sd = Json::object(), beside = Json::object(), units = Json::object(), lacks = Json::array();
  for (const ScmParameter& p : scm_parameters) {
    document["Soil parameters"][p.key] = scm_value(semi, p).value * p.per_si;
    sd[p.key] = scm_value(semi, p).std_error * p.per_si;
    units[p.key] = p.unit;
  }
  document["Soil parameters"]["Elastic stiffness"] = chosen.elastic_stiffness;
  document["Soil parameters"]["Damping"] = chosen.damping;
  units["Elastic stiffness"] = "Pa/m", units["Damping"] = "Pa s/m";
  for (const char* name : {"stress_angle_c1", "stress_angle_c2"}) {
    const Estimate& value = semi.*soil_parameter(name).value;
    beside[name] = value.value, sd[name] = value.std_error;
  }
  for (const ExactSoilValue& exact : exact_soil_values)
    if (const std::optional<double>& value = semi.*exact.value) beside[exact.name] = *value;
  if (semi.assumed_sd) sd["assumed share"] = *semi.assumed_sd;
  for (const InScm& one : in_scm)
    if (one.lacks) lacks.push_back(one.effect);
  document["soilbin"] = {
      {"version", version},
      {"soil", soil.name},
      {"source", soil.source},
      {"sources", semi.sources},
      {"units", units},
      {"sd", sd},
      {"beside SCM", beside},
      {"chosen", {"Elastic stiffness", "Damping", "Grid spacing", "Patch dimensions", "Simulation settings"}},
      {"lacks", lacks}};
  return document;
}

Table values_in_scm(const Soil& soil) {
  Table table{"Soil parameters", {"in the file", "of SetSoilParameters", "value", "unit"}};
  table.text_columns = {true, true, false, true};
  for (const ScmParameter& p : scm_parameters)
    table.add({p.key, p.argument, number(scm_value(*soil.semi_empirical, p), p.per_si), p.unit});
  const ScmChoices chosen = scm_choices(*soil.semi_empirical);
  table.add({"Elastic stiffness", "elastic_K", number(chosen.elastic_stiffness), "Pa/m"});
  table.add({"Damping", "damping_R", number(chosen.damping), "Pa s/m"});
  table.legend =
      "In the order of the arguments. The last two are chosen, not measured: 20 times the number of Kphi and at least "
      "5e7 Pa/m, and the damping of Chrono's example.";
  return table;
}

Table effects_in_scm(bool lacks) {
  Table table{lacks ? "What SCM lacks of our effects" : "What SCM has in another way", {"effect", "in SCM"}};
  table.text_columns = {true, true};
  for (const InScm& one : in_scm)
    if (one.lacks == lacks)
      table.add({{std::string(bekker_wong::effect_title(one.effect).name), one.effect}, one.words});
  return table;
}

}  // namespace

Report report_on_scm(const Soil& soil, const std::string& version) {
  Report report{"SCM terrain: " + soil.name, "A soil as Chrono's SCM terrain reads it.", soil.name + " as SCM terrain"};
  report.add("Values", values_in_scm(soil));
  report.add(WarningsHere());
  report.add(Items{std::vector<std::string>(std::begin(scm_differences), std::end(scm_differences))});
  report.add("Effects", effects_in_scm(true));
  report.add(effects_in_scm(false));
  if (!soil.source.empty()) report.add(NamedValues{{{"Source", soil.source}}});
  report.add(Prose{{"The values hold for pressures and plates like those that found them."}});
  report.data = [&soil, version] { return scm_document(soil, version); };
  return report;
}

}  // namespace soilbin::compare
