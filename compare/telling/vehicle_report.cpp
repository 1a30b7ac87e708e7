// A vehicle on soil as it is told; soilbin-vehicle-answer/1.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bekker_wong/closed_forms.hpp"
#include "bekker_wong/effect.hpp"
#include "compare/report/heat_map.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/report/number_text.hpp"
#include "compare/telling/answer_report.hpp"
#include "compare/telling/reports.hpp"
#include "compare/telling/vehicle_words.hpp"
#include "compare/vehicle/vehicle_answers.hpp"
#include "compare/vehicle/vehicle_doubts.hpp"
#include "scenario/csv.hpp"
#include "scenario/unit.hpp"

namespace soilbin::compare {
namespace {

std::string condition_in_words(const VehicleCondition& at) {
  std::string words = fmt::format("slope {:.4g} deg", at.slope / degree);
  if (at.cross_slope != 0.0) words += fmt::format(", cross slope {:.4g} deg", at.cross_slope / degree);
  words += fmt::format(", {:.4g} m/s", at.speed);
  if (at.pull != 0.0) words += ", pulling " + newtons(at.pull);
  return words;
}

/// "26.6 ± 4.0 deg", without an error where none is known; "none" where it moves on no slope that was looked at.
std::string angle_of(const VehicleLimit& limit) {
  return limit.angle    ? number({limit.angle->value, told_error(limit.angle->std_error)}, 1 / degree) + " deg"
         : limit.on_all ? "any"
                        : "none";
}

std::string too_fast_in_words(const VehicleAnswers& answers) {
  return fmt::format("it does not hold {} m/s", number(answers.question.condition.speed, 3));
}

std::string speed_of(const Estimate& speed) { return number({speed.value, told_error(speed.std_error)}) + " m/s"; }

/// How fast it goes and how steep it climbs at its speed, where a motor with a torque curve says so.
void add_motor_verdicts(const VehicleAnswers& answers, std::vector<BackedSentence>& said) {
  const auto& fastest = answers.fastest;
  if (fastest && fastest->speed && fastest->limit != TravelLimit::power)
    said.push_back(
        {"Fastest", fmt::format("{}: {}.", speed_of(*fastest->speed), travel_limit_in_words(*fastest->limit))});
  if (!answers.gradeability) return;
  const std::string speed = number(answers.question.condition.speed, 3) + " m/s";
  const auto& angle = answers.gradeability->angle;
  said.push_back(
      {"Climbs at its speed",
       fmt::format(
           "{}: {}.",
           angle ? fmt::format("{} deg at {}", number({angle->value, told_error(angle->std_error)}, 1 / degree), speed)
                 : "not even level ground at " + speed,
           travel_limit_in_words(answers.gradeability->limit))});
}

Table climbs_table(const VehicleAnswers& answers) {
  Table table{"Speed on slopes", {"slope [deg]", "fastest [m/s]", "what limits it"}, {false, false, true}};
  for (const FastestTravel& one : answers.climbs)
    table.add({number(one.slope / degree), one.speed ? number(one.speed->value) : "-",
               one.limit ? travel_limit_in_words(*one.limit) : "nothing that the file declares"});
  table.legend = "Straight up, with the pull that is asked.";
  return table;
}

/// The unit in which a power of so many watts is told.
struct PowerUnit {
  double watts;
  const char* prefix;  ///< of W and J
};

PowerUnit power_unit(double watts) { return std::abs(watts) >= 1000.0 ? PowerUnit{1000.0, "k"} : PowerUnit{1.0, ""}; }

/// "2.98 deg uphill of its travel": an angle to the left; on the level to the left or to the right.
std::string turned_in_words(double angle, const VehicleCondition& at, const char* of) {
  const bool left = angle > 0.0, uphill = left == (at.cross_slope > 0.0);
  const char* way = at.cross_slope == 0.0 ? (left ? "to the left" : "to the right") : uphill ? "uphill" : "downhill";
  return fmt::format("{} deg {}{}", number(std::abs(angle) / degree), way, of);
}

/// Depth of the rut that it leaves: that of the deepest wheel; more than that where later wheels count from its floor.
std::optional<std::string> rut_in_words(const VehicleAnswers& answers) {
  const SteadyVehicle& v = *answers.steady;
  std::optional<std::size_t> deepest;
  bool from_floor = false;
  for (std::size_t i = 0; i < v.wheels.size(); ++i) {
    if (v.wheels[i].lifted) continue;
    if (!deepest || v.wheels[i].result.sinkage.value > v.wheels[*deepest].result.sinkage.value) deepest = i;
    from_floor |=
        v.wheels[i].result.at.pass > 1 && std::ranges::any_of(answers.question.effects, [](const EffectChoice& effect) {
          return bekker_wong::find_form(effect).sinkage_from_rut_floor;
        });
  }
  if (!deepest || !(v.wheels[*deepest].result.sinkage.value > 0.0)) return {};
  const double error = *deepest < answers.errors.wheels.size() ? answers.errors.wheels[*deepest].sinkage : 0.0;
  return fmt::format("{}{} mm deep behind it.", from_floor ? "At least " : "",
                     number({v.wheels[*deepest].result.sinkage.value, told_error(error)}, 1e3));
}

/// "It climbs 12.3 ± 1.2 deg, and 12 deg are asked: --map gives the chance."
std::string not_decided_in_words(const NotDecided& open, const VehicleAnswers& answers) {
  const std::string asked = number(answers.question.condition.slope / degree) + " deg are asked";
  std::string words;
  if (open.steepest)
    words = fmt::format("It climbs {} deg, and {}: --map gives the chance.", number(*open.steepest, 1 / degree), asked);
  if (open.as_in_grains)
    words += fmt::format(
        "{}With what grains show under heavy tires on sand it climbs {:.3g} deg in place of {:.3g}, and {}.",
        words.empty() ? "" : " ", *open.as_in_grains / degree, answers.up.angle->value / degree, asked);
  return words;
}

std::vector<BackedSentence> vehicle_verdicts(const VehicleAnswers& answers, const std::optional<NotDecided>& open) {
  std::vector<BackedSentence> said;
  if (open) said.push_back({"Not decided", not_decided_in_words(*open, answers)});
  if (answers.steady) {
    const SteadyVehicle& v = *answers.steady;
    const auto [unit, prefix] = power_unit(v.power.into_wheels);
    if (answers.not_held == TravelLimit::power)
      said.push_back(
          {capital(too_fast_in_words(answers)),
           fmt::format("That takes {} {}W at the wheels, and {} {}W reach them, enough for {} m/s.",
                       number({v.power.into_wheels, told_error(answers.errors.into_wheels)}, 1 / unit), prefix,
                       number(*answers.question.power / unit, 3), prefix, number(*answers.power_speed, 3))});
    else if (!answers.holds_speed())
      said.push_back({capital(too_fast_in_words(answers)), capital(travel_limit_in_words(*answers.not_held)) + "."});
    said.push_back({!answers.holds_speed() ? "At that speed"
                    : open                 ? "As computed it travels"
                                           : "It travels",
                    fmt::format("The drive line slips by {} %; the wheels take {} {}W, {} {}J/m.",
                                number({v.slip, told_error(answers.errors.slip)}, 100),
                                number({v.power.into_wheels, told_error(answers.errors.into_wheels)}, 1 / unit), prefix,
                                number(v.power.into_wheels / v.at.speed / unit, 3), prefix)});
    if (answers.power_speed && answers.holds_speed() && answers.fastest && answers.fastest->limit == TravelLimit::power)
      said.push_back({"Power", fmt::format("All of it is used at {} m/s.", number(*answers.power_speed, 3))});
    if (constexpr double rounding = 1e-9; std::abs(v.crab) > rounding)
      said.push_back({"Across", fmt::format("It points {}{}.", turned_in_words(v.crab, v.at, " of its travel"),
                                            v.steering != 0.0 ? ", with its steered wheels turned by " +
                                                                    turned_in_words(v.steering, v.at, "")
                                                              : "")});
    if (const auto rut = rut_in_words(answers)) said.push_back({"Rut", *rut});
    if (const double arm = std::abs(v.yaw_moment); arm > 1e-6 * answers.question.mass)
      said.push_back({"Yaw moment",
                      fmt::format("{} N m are left to turn it; no steered axle balances them.", number(v.yaw_moment))});
  } else {
    said.push_back({open ? "As computed it does not travel" : "It does not travel",
                    failure_in_words(answers.wheels, *answers.failure) + "."});
  }
  add_motor_verdicts(answers, said);
  if (!answers.in_full) return said;
  const bool chance_unknown = !answers.up.angle && !answers.up.on_all && !answers.map;
  said.push_back({"Steepest slopes",
                  fmt::format("Up {}, down {}, across {}.{}", angle_of(answers.up), angle_of(answers.down),
                              angle_of(answers.across),
                              chance_unknown ? " Where there is none there is no ±: --map gives the chance." : "")});
  return said;
}

std::vector<KeyFigure> key_figures_of(const VehicleAnswers& answers, bool open) {
  std::vector<KeyFigure> figures;
  if (open) figures.push_back({"Not decided", "whether it travels"});
  if (answers.steady) {
    const SteadyVehicle& v = *answers.steady;
    const auto [unit, prefix] = power_unit(v.power.into_wheels);
    figures.push_back({number({v.slip, told_error(answers.errors.slip)}, 100) + " %", "slip of the drive line"});
    figures.push_back(
        {number({v.power.into_wheels, told_error(answers.errors.into_wheels)}, 1 / unit) + " " + prefix + "W",
         "into the wheels"});
  } else if (!open) {
    figures.push_back({"It does not travel", "in this condition"});
  }
  if (!answers.in_full) return figures;
  figures.push_back({angle_of(answers.up), "steepest up"});
  figures.push_back({angle_of(answers.down), "steepest down"});
  figures.push_back({angle_of(answers.across), "steepest across"});
  return figures;
}

TableCell limit_in_words(const VehicleLimit& limit) {
  if (!limit.angle) return "-";
  const bool known = std::isfinite(limit.angle->std_error);
  return {number({limit.angle->value, told_error(limit.angle->std_error)}, 1 / degree),
          known ? "" : "its error is not known"};
}

Table limits_of_vehicle(const VehicleAnswers& answers) {
  Table table{"Steepest slopes", {"way", "slope [deg]", "slip there [%]", "what ends it"}};
  table.text_columns = {true, false, false, true};
  const auto add = [&](const char* way, const VehicleLimit& limit) {
    table.add({way, limit_in_words(limit), limit.angle ? number(100 * limit.slip) : "-",
               limit.angle    ? failure_in_words(answers.wheels, limit.beyond)
               : limit.on_all ? "nothing up to 69 deg"
                              : "-"});
  };
  add("up", answers.up);
  add("down", answers.down);
  add("across", answers.across);
  table.legend = "Straight up, straight down, level across, each with the pull that is asked.";
  return table;
}

/// A force, or none where it and its error are what the balance of a load leaves.
Estimate without_rest(const Estimate& force, double load) {
  const double rest = 1e-9 * load;
  return std::abs(force.value) < rest && force.std_error < rest ? Estimate{} : force;
}

Table wheels_table(const VehicleAnswers& answers) {
  Table table{"Wheels",
              {"wheel", "load [N]", "slip [%]", "pull [N]", "torque [N m]", "sinkage [mm]", "contact area [cm^2]",
               "ground pressure [kPa]", "pass"}};
  for (std::size_t i = 0; i < answers.wheels.size(); ++i) {
    const SteadyWheel& wheel = answers.steady->wheels[i];
    const TractionResult& r = wheel.result;
    if (wheel.lifted) {
      table.add({answers.wheels[i].name, "0", "off the ground", "-", "-", "-", "-", "-",
                 std::to_string(answers.wheels[i].pass())});
      continue;
    }
    const SteadyErrors::Wheel e = i < answers.errors.wheels.size() ? answers.errors.wheels[i] : SteadyErrors::Wheel{};
    table.add({{answers.wheels[i].name, wheel.at_largest_torque ? "at its largest torque" : ""},
               number({wheel.normal_load, told_error(e.normal_load)}),
               number({r.at.slip, told_error(e.slip)}, 100),
               number(without_rest({r.drawbar_pull.value, told_error(e.drawbar_pull)}, wheel.normal_load)),
               number({r.torque.value, told_error(e.torque)}),
               number({r.sinkage.value, told_error(e.sinkage)}, 1e3),
               number(r.contact_area * 1e4),
               number(wheel.normal_load / r.contact_area * 1e-3),
               std::to_string(answers.wheels[i].pass())});
  }
  table.legend = "Load: normal to the ground. Pull: what is left beyond the wheel's share of the slope.";
  return table;
}

Table power_table(const SteadyVehicle& v) {
  Table table{"Where the power goes", {"part", "W", "J/m"}};
  std::vector<std::pair<const char*, double>> parts = {
      {"into the wheels", v.power.into_wheels}, {"drawbar", v.power.drawbar}, {"climbing", v.power.climbing}};
  if (v.power.slip_loss < 0.0) {  // wheels of a model that need no slip
    parts.emplace_back("slip, sinkage and other resistance of the soil", v.power.slip_loss + v.power.soil_loss);
  } else {
    parts.emplace_back("slip", v.power.slip_loss);
    parts.emplace_back("sinkage and other resistance of the soil", v.power.soil_loss);
  }
  const double nothing = 1e-9 * std::abs(v.power.into_wheels);  // what the balance leaves
  for (const auto& [name, power] : parts) {
    const double watt = std::abs(power) > nothing ? power : 0.0;
    table.add({name, number(watt), number(watt / v.at.speed)});
  }
  return table;
}

Table pulls_table(const VehicleAnswers& answers) {
  Table table{"Drawbar pull against slip", {"slip [%]", "pull [N]", "into the wheels [J/m]", "deepest [mm]"}};
  for (const VehiclePullRow& row : answers.pulls) {
    if (!row.vehicle) {
      table.add({number(100 * row.slip), "-", "-", "-"});
      continue;
    }
    double deepest = 0.0;
    for (const SteadyWheel& wheel : row.vehicle->wheels) deepest = std::max(deepest, wheel.result.sinkage.value);
    table.add({number(100 * row.slip), number({row.vehicle->pull, told_error(row.pull_error)}),
               number(row.vehicle->power.into_wheels / row.vehicle->at.speed), number(deepest * 1e3)});
  }
  return table;
}

std::vector<std::string> vehicle_remarks(const VehicleAnswers& answers) {
  std::vector<std::string> said;
  const bool ruts = std::ranges::any_of(answers.wheels, [](const VehicleWheel& wheel) { return wheel.pass() > 1; });
  const auto& effects = answers.question.effects;
  const bool read = std::ranges::any_of(effects, [](const EffectChoice& effect) {
    return bekker_wong::depends_on(bekker_wong::find_form(effect), "pass");
  });
  if (ruts && !read)
    said.emplace_back(
        "Wheels in ruts roll as on undisturbed soil: no effect reads the pass. Add multipass to the effects.");
  if (ruts && read)
    said.emplace_back(
        "A wheel behind another rolls in its rut. The forms reload and slip_hardening of multipass know what went "
        "before "
        "(the largest load; the slip of the last wheel), the others how many wheels did.");
  if (std::ranges::any_of(answers.wheels,
                          [](const VehicleWheel& wheel) { return bekker_wong::is_flexible(wheel.scenario.effects); }))
    said.emplace_back(carcass_without_loss);
  if (const auto& [x, y, z] = answers.question.hitch.at; x == 0.0 && y == 0.0 && z == 0.0)
    said.emplace_back("The pull acts on the ground, at x = 0 and y = 0: no hitch says otherwise.");
  const std::size_t axles = answers.question.axles.size();
  if (axles > 2)
    said.push_back(fmt::format("Loads of {} axles: a rigid frame on {}.", axles,
                               answers.question.axles.front().stiffness ? "springs of the stiffness that they declare"
                                                                        : "springs that are all alike"));
  if (axles == 1) said.emplace_back("One axle alone does not stand: it is held level, as in a rig.");
  return said;
}

std::string degrees_text(double angle) { return fmt::format("{:.4g}", angle / degree); }

Table map_table(const GoMap& map) {
  Table table{"Chance to go [%], by slope and by heading from straight up", {"slope [deg]"}};
  for (const double heading : map.headings) table.header.push_back(degrees_text(heading) + " deg");
  for (std::size_t i = 0; i < map.slopes.size(); ++i) {
    std::vector<TableCell> row = {degrees_text(map.slopes[i])};
    for (const GoCell& cell : map.cells[i]) row.emplace_back(fmt::format("{:.0f}", 100 * cell.chance));
    table.add(std::move(row));
  }
  double widest = 0.0;
  for (const auto& row : map.cells)
    for (const GoCell& cell : row) widest = std::max(widest, cell.std_error);
  table.legend = fmt::format(
      "Share of {} soils, drawn by the standard deviations of the soil's values, on which it travels steadily; a "
      "share's standard error is up to {:.0f} %. A soil on which it fails counts as failed on every steeper slope.",
      map.samples, 100 * widest);
  return table;
}

HeatMap heat_map_of_go(const GoMap& map) {
  HeatMap heat;
  heat.title = "Chance to go [%]", heat.subtitle = fmt::format("share of {} soils", map.samples);
  heat.x_title = "heading from straight up [deg]", heat.y_title = "slope [deg]";
  heat.limit = 1.0;
  for (const double heading : map.headings) heat.x.push_back(degrees_text(heading));
  for (std::size_t i = map.slopes.size(); i-- > 0;) {
    heat.y.push_back(degrees_text(map.slopes[i]));
    std::vector<HeatCell>& row = heat.cells.emplace_back();
    for (std::size_t k = 0; k < map.headings.size(); ++k) {
      const double chance = map.cells[i][k].chance;
      row.push_back({1 - 2 * chance, fmt::format("{:.0f}", 100 * chance),
                     fmt::format("slope {} deg, heading {} deg: goes on {:.0f} % of the soils",
                                 degrees_text(map.slopes[i]), degrees_text(map.headings[k]), 100 * chance)});
    }
  }
  return heat;
}

/// The other wheel of a wheel's axle.
std::optional<std::size_t> beside(const VehicleAnswers& answers, std::size_t wheel) {
  for (std::size_t i = 0; i < answers.wheels.size(); ++i)
    if (i != wheel && answers.wheels[i].axle == answers.wheels[wheel].axle) return i;
  return {};
}

/// Whether two wheels sink alike at every slip, so that one curve is both.
bool sink_alike(const VehicleAnswers& answers, std::size_t a, std::size_t b) {
  constexpr double seen = 1e-6;  // [m]
  return std::ranges::all_of(answers.pulls, [&](const VehiclePullRow& row) {
    return !row.vehicle ||
           std::abs(row.vehicle->wheels[a].result.sinkage.value - row.vehicle->wheels[b].result.sinkage.value) < seen;
  });
}

Sheet vehicle_sheet(const VehicleAnswers& answers) {
  const Axis slip{"slip of the drive line [%]"};
  Sheet sheet{answers.question.name + " on " + answers.question.soil.name,
              {{"Drawbar pull [N]", slip, {}, {}}, {"Sinkage [mm]", slip, {}, {}}}};
  sheet.note = "bands: one standard error, from the standard deviations of the soil's values";
  Series pull{"drawbar pull"};
  for (const VehiclePullRow& row : answers.pulls) {
    pull.x.push_back(100 * row.slip);
    pull.y.push_back(row.vehicle ? row.vehicle->pull : not_a_number);
    pull.error.push_back(told_error(row.pull_error));
  }
  sheet.plots[0].series.push_back(std::move(pull));
  int curves = 1;  // the pull's colour is its own: the panels share a legend
  for (std::size_t i = 0; i < answers.wheels.size(); ++i) {
    const std::optional<std::size_t> other = beside(answers, i);
    const bool alike = other && sink_alike(answers, i, *other);
    if (alike && *other < i) continue;
    sheet.plots[1].series.push_back(over_samples(
        {.label = alike ? answers.question.axles[answers.wheels[i].axle].name : answers.wheels[i].name,
         .color = curves % 6,
         .dash = curves / 6},
        answers.pulls, [](const VehiclePullRow& row) { return 100 * row.slip; },
        [i](const VehiclePullRow& row) {
          return row.vehicle ? 1e3 * row.vehicle->wheels[i].result.sinkage.value : not_a_number;
        }));
    ++curves;
  }
  return sheet;
}

Json wheel_json(const VehicleWheel& about, const SteadyWheel& wheel, const SteadyErrors::Wheel& e) {
  const TractionResult& r = wheel.result;
  const auto estimate = [](double value, double error) { return estimate_json({value, error}); };
  Json json = {{"wheel", about.name}, {"pass", about.pass()}, {"off_the_ground", wheel.lifted}};
  json["normal_load"] = estimate(wheel.normal_load, e.normal_load);
  if (wheel.lifted) return json;
  json["load"] = r.at.load;
  json["yaw"] = r.at.yaw;
  json["slip"] = estimate(r.at.slip, e.slip);
  json["drawbar_pull"] = estimate(r.drawbar_pull.value, e.drawbar_pull);
  json["torque"] = estimate(r.torque.value, e.torque);
  json["sinkage"] = estimate(r.sinkage.value, e.sinkage);
  json["lateral_force"] = r.lateral_force.value;
  json["contact_area"] = finite(r.contact_area);
  json["ground_pressure"] = finite(wheel.normal_load / r.contact_area);
  json["rim_speed"] = finite(wheel.rim_speed);
  json["power"] = finite(wheel.power_in);
  json["at_largest_torque"] = wheel.at_largest_torque;
  return json;
}

Json limit_json(const VehicleAnswers& answers, const VehicleLimit& limit) {
  Json json = {{"slope", or_null(limit.angle)}};
  if (!limit.angle) return json;
  json["slip"] = limit.slip;
  json["beyond"] = failure_json(answers.wheels, limit.beyond);
  return json;
}

Json fastest_json(const FastestTravel& fastest) {
  return {{"slope", fastest.slope},
          {"speed", or_null(fastest.speed)},
          {"limit", fastest.limit ? Json(travel_limit_word(*fastest.limit)) : Json()}};
}

Json asked_of_vehicle_json(const VehicleCondition& at) {
  return {{"slope", at.slope}, {"cross_slope", at.cross_slope}, {"speed", at.speed}, {"pull", at.pull}};
}

Json steady_vehicle_json(const VehicleAnswers& answers) {
  const SteadyVehicle& v = *answers.steady;
  Json json = {{"slip", estimate_json({v.slip, answers.errors.slip})},
               {"pull", v.pull},
               {"crab", v.crab},
               {"steering", v.steering},
               {"yaw_moment", v.yaw_moment},
               {"nose_down", v.nose_down},
               {"left_down", v.left_down},
               {"power",
                {{"into_wheels", estimate_json({v.power.into_wheels, answers.errors.into_wheels})},
                 {"drawbar", v.power.drawbar},
                 {"climbing", v.power.climbing},
                 {"slip_loss", v.power.slip_loss},
                 {"soil_loss", v.power.soil_loss}}},
               {"energy_per_metre", v.power.into_wheels / v.at.speed}};
  json["wheels"] = Json::array();
  for (std::size_t i = 0; i < answers.wheels.size(); ++i)
    json["wheels"].push_back(
        wheel_json(answers.wheels[i], v.wheels[i],
                   i < answers.errors.wheels.size() ? answers.errors.wheels[i] : SteadyErrors::Wheel{}));
  return json;
}

Json map_json(const GoMap& map) {
  Json json = {{"samples", map.samples}, {"slopes", map.slopes}, {"headings", map.headings}};
  json["chance"] = list_of(map.cells, [](const std::vector<GoCell>& row) {
    return list_of(row, [](const GoCell& cell) { return estimate_json({cell.chance, cell.std_error}); });
  });
  return json;
}

Json vehicle_json(const VehicleAnswers& answers, const std::optional<NotDecided>& open) {
  const VehicleCase& question = answers.question;
  Json document = {{"format", "soilbin-vehicle-answer/1"},
                   {"vehicle", question.name},
                   {"soil", question.soil.name},
                   {"condition", asked_of_vehicle_json(question.condition)}};
  document["steady"] = answers.steady ? steady_vehicle_json(answers) : Json();
  document["failure"] = answers.failure ? failure_json(answers.wheels, *answers.failure) : Json();
  document["not_decided"] =
      open ? Json{{"steepest", or_null(open->steepest)}, {"steepest_as_in_grains", or_null(open->as_in_grains)}}
           : Json();
  document["speed_at_largest_power"] = or_null(answers.power_speed);
  document["holds_speed"] = answers.steady && answers.holds_speed();
  document["steepest"] = {{"up", limit_json(answers, answers.up)},
                          {"down", limit_json(answers, answers.down)},
                          {"across", limit_json(answers, answers.across)}};
  document["fastest"] = answers.fastest ? fastest_json(*answers.fastest) : Json();
  document["gradeability"] = answers.gradeability ? Json{{"slope", or_null(answers.gradeability->angle)},
                                                         {"limit", travel_limit_word(answers.gradeability->limit)}}
                                                  : Json();
  document["climbs"] = list_of(answers.climbs, fastest_json);
  document["map"] = answers.map ? map_json(*answers.map) : Json();
  document["pulls"] = list_of(answers.pulls, [&](const VehiclePullRow& row) {
    Json json = {{"slip", row.slip}};
    json["pull"] = row.vehicle ? estimate_json({row.vehicle->pull, row.pull_error}) : Json();
    json["into_wheels"] = row.vehicle ? finite(row.vehicle->power.into_wheels) : Json();
    if (row.failure) json["failure"] = failure_json(answers.wheels, *row.failure);
    return json;
  });
  return document;
}

std::string vehicle_csv(const VehicleAnswers& answers) {
  std::string text =
      "slip,pull_N,pull_se_N,into_wheels_W,wheel,wheel_load_N,wheel_slip,wheel_pull_N,wheel_torque_Nm,"
      "wheel_sinkage_m,wheel_contact_area_m2,error\n";
  for (const VehiclePullRow& row : answers.pulls) {
    if (!row.vehicle) {
      text += fmt::format("{},,,,,,,,,,,{}\n", csv_number(row.slip),
                          csv_cell(failure_in_words(answers.wheels, *row.failure)));
      continue;
    }
    for (std::size_t i = 0; i < answers.wheels.size(); ++i) {
      const SteadyWheel& wheel = row.vehicle->wheels[i];
      const TractionResult& r = wheel.result;
      text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},\n", csv_number(row.slip), csv_number(row.vehicle->pull),
                          csv_number(row.pull_error), csv_number(row.vehicle->power.into_wheels),
                          csv_cell(answers.wheels[i].name), csv_number(wheel.normal_load), csv_number(r.at.slip),
                          csv_number(r.drawbar_pull.value), csv_number(r.torque.value), csv_number(r.sinkage.value),
                          csv_number(r.contact_area));
    }
  }
  return text;
}

}  // namespace

std::string svg_of(const GoMap& map) { return on_paper(heat_map_svg(heat_map_of_go(map))); }

std::string csv_of(const GoMap& map) {
  std::string text = "slope_deg,heading_deg,chance,chance_se\n";
  for (std::size_t i = 0; i < map.slopes.size(); ++i)
    for (std::size_t k = 0; k < map.headings.size(); ++k)
      text += fmt::format("{},{},{},{}\n", csv_number(map.slopes[i] / degree), csv_number(map.headings[k] / degree),
                          csv_number(map.cells[i][k].chance), csv_number(map.cells[i][k].std_error));
  return text;
}

Report report_on(const VehicleAnswers& answers) { return report_on(answers, std::nullopt); }

Report report_on(const VehicleAnswers& answers, const std::optional<NotDecided>& open) {
  const VehicleCase& question = answers.question;
  const std::string asked = fmt::format("{} ({:.6g} kg) on {}: {}", question.name, question.mass, question.soil.name,
                                        condition_in_words(question.condition));
  Report report{"Vehicle: " + question.name, asked, asked};
  report.add(KeyFigures{key_figures_of(answers, open.has_value())}, Told::on_pages);
  report.add(Sentences(vehicle_verdicts(answers, open)));
  report.add(WarningsHere());
  if (answers.in_full) report.add("How steep", limits_of_vehicle(answers));
  if (!answers.climbs.empty()) report.add("How fast", climbs_table(answers));
  if (answers.steady) {
    report.add("Wheel by wheel", wheels_table(answers));
    report.add("Power", power_table(*answers.steady));
  }
  report.add("Pull", pulls_table(answers));
  if (answers.map) {
    report.add("Where it goes", map_table(*answers.map));
    report.add(Drawings{{heat_map_svg(heat_map_of_go(*answers.map))},
                        "Blue: goes on more than half of the soils; orange: on fewer.",
                        "chance-to-go",
                        true},
               Told::to_look_at);
  }
  if (const auto remarks = vehicle_remarks(answers); !remarks.empty()) report.add(Sentences(remarks));
  report.sheet = drawn_once([&] { return vehicle_sheet(answers); });
  report.add("Against slip", Figure(report.sheet, "Band: one standard error of the pull."));
  if (answers.failure)
    report.no_answer = fmt::format("does not travel{}: {}", open ? " (not decided)" : "",
                                   failure_in_words(answers.wheels, *answers.failure));
  if (answers.steady && !answers.holds_speed())
    report.no_answer =
        too_fast_in_words(answers) + ": " +
        (answers.not_held == TravelLimit::power ? "too little power" : travel_limit_in_words(*answers.not_held));
  report.data = [&answers, open] { return vehicle_json(answers, open); };
  report.csv = [&answers] { return vehicle_csv(answers); };
  return report;
}

}  // namespace soilbin::compare
