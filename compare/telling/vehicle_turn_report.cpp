// A vehicle in a steady turn as it is told; soilbin-vehicle-turn/1.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "compare/report/number_text.hpp"
#include "compare/telling/reports.hpp"
#include "compare/telling/vehicle_words.hpp"
#include "compare/vehicle/vehicle_turn.hpp"
#include "scenario/csv.hpp"
#include "scenario/unit.hpp"
#include "scenario/yawed_frames.hpp"

namespace soilbin::compare {
namespace {

const char* turn_limit_word(TurnLimit limit) {
  constexpr std::array<const char*, 3> words = {"steering", "motors", "balance"};  // in the order of its values
  return words[static_cast<std::size_t>(limit)];
}

std::string turn_end_in_words(const TurnAnswers& answers, const TurnEnd& end) {
  if (end.limit == TurnLimit::steering) return "the steered wheels turn no further";
  if (end.limit == TurnLimit::motors) return travel_limit_in_words(end.motors);
  return failure_in_words(answers.wheels, end.failure);
}

std::string why_not_in_words(const TurnAnswers& answers) {
  const TurnEnd& why = *answers.why_not;
  if (answers.asked.radius == 0.0 && why.limit == TurnLimit::balance && why.failure.why == GaveOut::pull)
    return "at every slip the soil holds its wheels across more than it lets them drive";
  return turn_end_in_words(answers, why);
}

bool is_steered_vehicle(const VehicleCase& question) { return std::ranges::any_of(question.axles, is_steered); }

std::string radius_text(double radius, double error = 0.0) {
  return number({std::abs(radius), told_error(error)}) + " m";
}

std::string asked_of_turn(const TurnAnswers& answers) {
  const TurnAsked& asked = answers.asked;
  const auto side = [](double to_left) { return to_left < 0.0 ? "right" : "left"; };
  if (asked.radius == 0.0) return "on the spot, to the left";
  if (asked.radius) return fmt::format("a turn of {} to the {}", radius_text(*asked.radius), side(*asked.radius));
  if (asked.steer)
    return fmt::format("a turn to the {} with {} deg of steering", side(*asked.steer),
                       number(std::abs(*asked.steer) / degree));
  return "the tightest turn to the left";
}

std::vector<BackedSentence> turn_verdicts(const TurnAnswers& answers) {
  std::vector<BackedSentence> said;
  if (answers.turn) {
    const VehicleTurn& turn = *answers.turn;
    const SteadyVehicle& v = turn.vehicle;
    const SteadyErrors& e = answers.errors;
    const std::string steering =
        is_steered_vehicle(answers.question)
            ? fmt::format(" Steering: {} deg.", number({std::abs(v.steering), told_error(e.steering)}, 1 / degree))
            : "";
    const bool on_the_spot = turn.radius == 0.0;
    const std::string rate = number(std::abs(turn.rate) / degree, 3);
    said.push_back(
        {"It turns",
         on_the_spot ? fmt::format("On the spot, {} deg a second; its outermost wheel runs {} from the centre.", rate,
                                   radius_text(turn.widest))
                     : fmt::format("Radius {} of its centre of gravity, {} of its outermost wheel, {} deg a second.{}",
                                   radius_text(turn.radius), radius_text(turn.widest), rate, steering)});
    said.push_back(
        {"That takes",
         fmt::format("{} % of slip of the drive line and {} W, {} J a {}.", number({v.slip, told_error(e.slip)}, 100),
                     number({v.power.into_wheels, told_error(e.into_wheels)}),
                     number(v.power.into_wheels / (on_the_spot ? turn.rate / (360 * degree) : v.at.speed), 3),
                     on_the_spot ? "full turn" : "metre")});
  } else {
    said.push_back({"It does not turn so", capital(why_not_in_words(answers)) + "."});
  }
  if (answers.tightest)
    said.push_back({"Tightest turn", fmt::format("Radius {}. A tighter one: {}.",
                                                 radius_text(answers.tightest->radius, answers.tightest_error),
                                                 turn_end_in_words(answers, answers.end))});
  if (answers.tightest && answers.end.limit == TurnLimit::balance && answers.end.failure.why == GaveOut::slides) {
    const std::size_t wheel = slips_most(answers.tightest->vehicle);
    const OperatingCondition& at = answers.tightest->vehicle.wheels[wheel].result.at;
    said.push_back({"Which wheel gives out first",
                    fmt::format("In it '{}' slips most: {} % along, at {} deg to its travel.",
                                answers.wheels[wheel].name, number(100 * at.slip, 3), number(at.yaw / degree, 3))});
  }
  return said;
}

/// The soil's force on a wheel in its plane and across it, to the left; on level ground [N].
GroundForce in_wheel_plane(const SteadyWheel& wheel) {
  const TractionResult& r = wheel.result;
  return turned({r.drawbar_pull.value, r.lateral_force.value}, r.at.yaw, ForceFrame::travel, ForceFrame::wheel);
}

Table turning_wheels_table(const TurnAnswers& answers) {
  const bool on_the_spot = answers.turn->radius == 0.0;
  Table table{"Wheels",
              {"wheel", "load [N]", on_the_spot ? "rolls" : "steered [deg]", "slip [%]", "slip angle [deg]",
               "force ahead [N]", "force to its left [N]", "torque [N m]", "sinkage [mm]"}};
  for (std::size_t i = 0; i < answers.wheels.size(); ++i) {
    const SteadyWheel& wheel = answers.turn->vehicle.wheels[i];
    const std::string steer = !on_the_spot ? number(wheel.steer / degree) : wheel.backward ? "backward" : "ahead";
    if (wheel.lifted) {
      table.add({answers.wheels[i].name, "0", steer, "off the ground", "-", "-", "-", "-", "-"});
      continue;
    }
    const TractionResult& r = wheel.result;
    const GroundForce force = in_wheel_plane(wheel);
    const SteadyErrors::Wheel e = i < answers.errors.wheels.size() ? answers.errors.wheels[i] : SteadyErrors::Wheel{};
    table.add({{answers.wheels[i].name, wheel.at_largest_torque ? "at its largest torque" : ""},
               number({wheel.normal_load, told_error(e.normal_load)}),
               steer,
               number({r.at.slip, told_error(e.slip)}, 100),
               number(r.at.yaw / degree),
               number(force.forward),
               number(force.left),
               number({r.torque.value, told_error(e.torque)}),
               number({r.sinkage.value, told_error(e.sinkage)}, 1e3)});
  }
  table.legend =
      "Slip angle: by which the wheel points to the left of its own travel (yaw). Forces of the soil, in the wheel's "
      "plane and across it.";
  if (on_the_spot) table.legend += " Of a wheel that rolls backward: as seen in the direction in which it rolls.";
  return table;
}

/// Of the turns from all but straight to the tightest, those that are tighter than this over the tightest.
constexpr double shown_radii = 20.0;

std::vector<VehicleTurn> shown_turns(const TurnAnswers& answers) {
  std::vector<VehicleTurn> shown;
  for (const VehicleTurn& turn : answers.ever_tighter)
    if (std::abs(turn.radius) <= shown_radii * std::abs(answers.tightest->radius)) shown.push_back(turn);
  return shown;
}

Table turns_table(const TurnAnswers& answers) {
  const bool steered = is_steered_vehicle(answers.question);
  Table table{"Ever tighter turns", {"radius [m]", "slip [%]", "into the wheels [J/m]", "points inward [deg]"}};
  if (steered) table.header.insert(table.header.begin() + 1, "steering [deg]");
  for (const VehicleTurn& turn : shown_turns(answers)) {
    const SteadyVehicle& v = turn.vehicle;
    const double inward = std::copysign(1.0, turn.radius) * v.crab / degree;
    std::vector<TableCell> row = {number(std::abs(turn.radius)), number(100 * v.slip),
                                  number(v.power.into_wheels / v.at.speed), number(inward)};
    if (steered) row.insert(row.begin() + 1, number(std::abs(v.steering) / degree));
    table.add(std::move(row));
  }
  return table;
}

Sheet turns_sheet(const TurnAnswers& answers) {
  const Axis radius{"radius [m]"};
  const bool steered = is_steered_vehicle(answers.question);
  Sheet sheet{answers.question.name + " on " + answers.question.soil.name};
  Series resists{""}, turns{""};
  for (const VehicleTurn& turn : shown_turns(answers)) {
    const SteadyVehicle& v = turn.vehicle;
    for (Series* one : {&resists, &turns}) one->x.push_back(std::abs(turn.radius));
    resists.y.push_back(v.power.into_wheels / v.at.speed);
    turns.y.push_back(steered ? std::abs(v.steering) / degree : 100 * v.slip);
  }
  sheet.plots.push_back({steered ? "Steering [deg]" : "Slip [%]", radius, {}, {std::move(turns)}});
  sheet.plots.push_back({"Into the wheels [J/m]", radius, {}, {std::move(resists)}});
  return sheet;
}

std::vector<std::string> turn_remarks(const TurnAnswers& answers) {
  std::vector<std::string> said;
  const auto has = [&](const char* id) {
    return std::ranges::any_of(answers.wheels, [&](const VehicleWheel& wheel) {
      return std::ranges::any_of(wheel.scenario.effects, [&](const EffectChoice& effect) { return effect.id == id; });
    });
  };
  if (!has("sidewall_bulldozing"))
    said.emplace_back(
        "Side forces are those of the tread's shear alone: no effect pushes soil with the wheels' sides. Deep wheels "
        "hold the vehicle better across and resist a turn more. Add sidewall_bulldozing to the effects.");
  if (!is_steered_vehicle(answers.question))
    said.emplace_back(
        "The moment with which the soil resists a wheel's turning on the spot is not in the model; it matters where "
        "contacts are long beside the wheelbase.");
  if (std::ranges::any_of(answers.wheels, [](const VehicleWheel& wheel) { return wheel.pass() > 1; }))
    said.emplace_back("Rear wheels are taken to roll in ruts as straight on; in a tight turn they leave them.");
  return said;
}

Json turning_wheel_json(const VehicleWheel& about, const SteadyWheel& wheel) {
  Json json = {{"wheel", about.name}, {"steer", wheel.steer}, {"off_the_ground", wheel.lifted}};
  if (wheel.lifted) return json;
  const TractionResult& r = wheel.result;
  const GroundForce force = in_wheel_plane(wheel);
  json["normal_load"] = wheel.normal_load;
  json["speed"] = r.at.speed;
  json["backward"] = wheel.backward;
  json["slip"] = r.at.slip;
  json["yaw"] = r.at.yaw;
  json["force_forward"] = force.forward;
  json["force_left"] = force.left;
  json["torque"] = r.torque.value;
  json["sinkage"] = r.sinkage.value;
  json["rim_speed"] = finite(wheel.rim_speed);
  json["power"] = finite(wheel.power_in);
  json["at_largest_torque"] = wheel.at_largest_torque;
  return json;
}

Json turn_json(const TurnAnswers& answers, const VehicleTurn& turn) {
  const SteadyVehicle& v = turn.vehicle;
  Json json = {{"radius", turn.radius}, {"widest_radius", turn.widest},
               {"yaw_rate", turn.rate}, {"steering", v.steering},
               {"crab", v.crab},        {"slip", v.slip},
               {"pull", v.pull},        {"into_wheels", v.power.into_wheels}};
  json["wheels"] = Json::array();
  for (std::size_t i = 0; i < answers.wheels.size(); ++i)
    json["wheels"].push_back(turning_wheel_json(answers.wheels[i], v.wheels[i]));
  return json;
}

Json turn_end_json(const TurnAnswers& answers, const TurnEnd& end) {
  Json json = {{"limit", turn_limit_word(end.limit)}, {"text", turn_end_in_words(answers, end)}};
  json["motors"] = end.limit == TurnLimit::motors ? Json(travel_limit_word(end.motors)) : Json();
  json["failure"] = end.limit == TurnLimit::balance ? failure_json(answers.wheels, end.failure) : Json();
  return json;
}

Json turns_json(const TurnAnswers& answers) {
  Json document = {{"format", "soilbin-vehicle-turn/1"},
                   {"vehicle", answers.question.name},
                   {"soil", answers.question.soil.name},
                   {"speed", answers.question.condition.speed},
                   {"asked",
                    {{"radius", answers.asked.radius ? Json(*answers.asked.radius) : Json()},
                     {"steer", answers.asked.steer ? Json(*answers.asked.steer) : Json()}}}};
  document["turn"] = answers.turn ? turn_json(answers, *answers.turn) : Json();
  if (answers.turn)
    document["std_errors"] = {{"slip", finite(answers.errors.slip)},
                              {"steering", finite(answers.errors.steering)},
                              {"into_wheels", finite(answers.errors.into_wheels)}};
  document["why_not"] = answers.why_not ? turn_end_json(answers, *answers.why_not) : Json();
  document["tightest"] = answers.tightest ? turn_json(answers, *answers.tightest) : Json();
  document["tightest_std_error"] = finite(answers.tightest_error);
  document["end"] = turn_end_json(answers, answers.end);
  return document;
}

std::string turn_csv(const TurnAnswers& answers) {
  std::string text =
      "wheel,radius_m,normal_load_N,steer_deg,slip,yaw_deg,force_forward_N,force_left_N,torque_Nm,sinkage_m,"
      "off_the_ground\n";
  if (!answers.turn) return text;
  for (std::size_t i = 0; i < answers.wheels.size(); ++i) {
    const SteadyWheel& wheel = answers.turn->vehicle.wheels[i];
    const TractionResult& r = wheel.result;
    const GroundForce force = in_wheel_plane(wheel);
    const auto answered = [&](double value) { return csv_number(wheel.lifted ? not_a_number : value); };
    text +=
        fmt::format("{},{},{},{},{},{},{},{},{},{},{}\n", csv_cell(answers.wheels[i].name),
                    csv_number(answers.turn->radius), csv_number(wheel.normal_load), csv_number(wheel.steer / degree),
                    answered(r.at.slip), answered(r.at.yaw / degree), answered(force.forward), answered(force.left),
                    answered(r.torque.value), answered(r.sinkage.value), wheel.lifted ? 1 : 0);
  }
  return text;
}

}  // namespace

Report report_on(const TurnAnswers& answers) {
  const VehicleCase& question = answers.question;
  Report report{"Vehicle in a turn: " + question.name, "How tightly does it turn, and what ends it?",
                fmt::format("{} ({:.6g} kg) on {}, level, {:.4g} m/s: {}", question.name, question.mass,
                            question.soil.name, question.condition.speed, asked_of_turn(answers))};
  report.add(Sentences(turn_verdicts(answers)));
  report.add(WarningsHere());
  if (answers.turn) report.add("Wheel by wheel", turning_wheels_table(answers));
  if (answers.tightest) {
    report.add("By radius", turns_table(answers));
    report.sheet = drawn_once([&] { return turns_sheet(answers); });
    report.add("Against radius", Figure(report.sheet, "Up to the tightest turn."));
  }
  if (const auto remarks = turn_remarks(answers); !remarks.empty()) report.add(Sentences(remarks));
  if (answers.why_not) report.no_answer = "does not turn so: " + why_not_in_words(answers);
  report.data = [&answers] { return turns_json(answers); };
  report.csv = [&answers] { return turn_csv(answers); };
  return report;
}

}  // namespace soilbin::compare
