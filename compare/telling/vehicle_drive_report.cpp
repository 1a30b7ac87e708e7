// A vehicle driven in time as it is told; soilbin-vehicle-drive/1.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "compare/report/json_fields.hpp"
#include "compare/report/number_text.hpp"
#include "compare/telling/drive_columns.hpp"
#include "compare/telling/reports.hpp"
#include "compare/vehicle/vehicle_answers.hpp"
#include "scenario/csv.hpp"
#include "scenario/unit.hpp"

namespace soilbin::compare {
namespace {

std::string axle_called(const DrivenAnswers& answers, std::size_t axle) { return answers.question.axles[axle].name; }

std::string vehicle_end_in_words(DriveEnd end) {
  if (end == DriveEnd::time_is_up) return "it still travels when time is up";
  if (end == DriveEnd::arrived) return "it arrives";
  if (end == DriveEnd::rolled_back) return "it rolls back";
  return end == DriveEnd::tips_over ? "it tips over" : fmt::format("it is {}", word_of(end));
}

/// "dry-sand"; "snow, then dry-sand" where it meets another on its way.
std::string soils_driven_on(const VehicleCase& question) {
  const std::vector<Waypoint>& way = question.drive.profile;
  std::vector<std::string> names;
  if (way.empty() || !way.front().soil || way.front().at > 0.0) names.push_back(question.soil.name);
  for (const Waypoint& point : way)
    if (point.soil && (names.empty() || names.back() != point.soil->name)) names.push_back(point.soil->name);
  return fmt::format("{}", fmt::join(names, ", then "));
}

std::string number_or_error(double value, const std::optional<double>& std_error) {
  return std_error && *std_error > 0.0 ? number(Estimate{value, *std_error}) : number(value);
}

std::string why_in_words(const DrivenAnswers& answers) {
  const VehicleDriveRecord& record = *answers.record;
  const std::string axle = axle_called(answers, *record.gave_out);
  if (record.end == DriveEnd::buried) return fmt::format("The wheels of axle '{}' are in up to the hub.", axle);
  if (record.at_motors_limit)
    return fmt::format("The drive line gives no more torque. The axle that pulls least for its load is '{}'.", axle);
  return fmt::format("The wheels spin and the soil gives no more. The axle that pulls least for its load is '{}'.",
                     axle);
}

std::vector<BackedSentence> driven_verdicts(const DrivenAnswers& answers) {
  std::vector<BackedSentence> said;
  if (!answers.record) {
    said.push_back({"It does not stand at its start", fmt::format("{}.", capital(answers.failure->words))});
  } else {
    const VehicleDriveRecord& record = *answers.record;
    const VehicleDriveSample& end = record.samples.back();
    const bool timed = record.end != DriveEnd::time_is_up, placed = record.end != DriveEnd::arrived;
    said.push_back({capital(vehicle_end_in_words(record.end)),
                    fmt::format("After {} s and {} m, on a slope of {} deg.",
                                number_or_error(record.end_time, timed ? answers.end_time_error : std::nullopt),
                                number_or_error(end.travelled, placed ? answers.travelled_error : std::nullopt),
                                number(end.slope / degree, 3))});
    if (record.gave_out) said.push_back({"What gave out", why_in_words(answers)});
    if (end.slip && record.end != DriveEnd::stuck)
      said.push_back({"At the end", fmt::format("{} m/s at {} % slip, with {} N m at the wheels.", number(end.speed, 3),
                                                number(100 * *end.slip, 3), number(end.torque, 3))});
  }
  if (answers.up.angle)
    said.push_back({"Steadily",
                    fmt::format("It climbs up to {} deg of {}.",
                                number({answers.up.angle->value,
                                        std::isfinite(answers.up.angle->std_error) ? answers.up.angle->std_error : 0.0},
                                       1 / degree),
                                answers.question.soil.name)});
  for (const MovedVehicleDrive& moved : answers.moved)
    for (const MovedVehicleDrive::Side* side : {&moved.lower, &moved.higher}) {
      if (side->value == moved.value || side->end == answers.record->end) continue;
      said.push_back(
          {"", fmt::format("With the {} a standard deviation {} {}.", moved.title,
                           side == &moved.lower ? "lower" : "higher",
                           side->end ? fmt::format("{} after {} s and {} m", vehicle_end_in_words(*side->end),
                                                   number(side->end_time), number(side->travelled))
                                     : "it does not stand at its start")});
    }
  return said;
}

Table driven_samples_table(const VehicleDriveRecord& record) {
  Table table{"",
              {"time [s]", "travelled [m]", "slope [deg]", "speed [m/s]", "rim [m/s]", "slip [%]", "torque [N m]",
               "deepest [mm]"}};
  for (const VehicleDriveSample& s : picked_samples(record.samples, shown_samples)) {
    double deepest = 0.0;
    for (const DrivenAxle& axle : s.axles) deepest = std::max(deepest, axle.sinkage);
    table.add({number(s.time), number(s.travelled), number(s.slope / degree), number(s.speed), number(s.rim_speed),
               slip_text(s.slip), number(s.torque), number(1000 * deepest)});
  }
  return table;
}

Table driven_axles_table(const DrivenAnswers& answers) {
  Table table{"Each wheel of an axle at the end",
              {"axle", "load [N]", "slip [%]", "force [N]", "torque [N m]", "sinkage [mm]"}};
  const std::vector<DrivenAxle>& axles = answers.record->samples.back().axles;
  for (std::size_t i = 0; i < axles.size(); ++i)
    table.add({axle_called(answers, i), number(axles[i].normal_load), slip_text(axles[i].slip),
               number(axles[i].forward), number(axles[i].torque), number(1000 * axles[i].sinkage)});
  table.legend = "Load: normal to the ground. Force: of the soil along travel.";
  return table;
}

Table driven_energy_table(const bekker_wong::EnergyLedger& e) {
  Table table{"Where the work of the motors went", {"part", "J"}};
  table.add({"by the motors", number(e.motor)});
  table.add({"shears the soil", number(e.shear)});
  table.add({"presses the soil", number(e.compaction)});
  if (e.added != 0.0) table.add({"added forces of effects", number(e.added)});
  if (e.carcass != 0.0) table.add({"is in the tires' carcasses", number(e.carcass)});
  table.add({"gains height, less what the loads give where wheels sink", number(e.height)});
  table.add({"pulls the drawbar", number(e.drawbar)});
  table.add({"is in motion", number(e.kinetic)});
  table.add({"damps the heave", number(e.damping)});
  table.add({"unaccounted for: the integration's error", number(e.unaccounted())});
  return table;
}

Table driven_happenings_table(const DrivenAnswers& answers) {
  Table table{"", {"time [s]", "travelled [m]", "axle", "what happened"}, {false, false, true, true}};
  for (const VehicleDriveHappening& h : answers.record->happenings)
    table.add({number(h.time), number(h.travelled), axle_called(answers, h.axle), std::string(word_of(h.what))});
  return table;
}

Sheet driven_sheet(const DrivenAnswers& answers) {
  const std::vector<VehicleDriveSample>& samples = answers.record->samples;
  const Axis time{"time [s]"};
  Sheet sheet{answers.question.name + " on " + soils_driven_on(answers.question)};
  const auto axles_named = static_cast<int>(answers.question.axles.size());
  const auto curve = [&](const std::string& label, int color,
                         const std::function<double(const VehicleDriveSample&)>& get) {
    return over_samples({.label = label, .color = color % 6, .dash = color / 6}, samples, &VehicleDriveSample::time,
                        get);
  };
  const auto of_axles = [&](const std::string& title, const std::function<double(const DrivenAxle&)>& get) {
    Plot plot{title, time, {}, {}};
    for (std::size_t i = 0; i < answers.question.axles.size(); ++i)
      plot.series.push_back(curve(axle_called(answers, i), static_cast<int>(i),
                                  [&get, i](const VehicleDriveSample& s) { return get(s.axles[i]); }));
    sheet.plots.push_back(std::move(plot));
  };
  sheet.plots.push_back({"Speed [m/s]",
                         time,
                         {},
                         {curve("travel", axles_named, &VehicleDriveSample::speed),
                          curve("rim", axles_named + 1, &VehicleDriveSample::rim_speed)}});
  sheet.plots.push_back({"Slope [deg]", time, {}, {curve("", 0, in_degrees(&VehicleDriveSample::slope))}});
  of_axles("Slip [%]", [](const DrivenAxle& a) { return a.slip ? 100 * *a.slip : not_a_number; });
  of_axles("Load of a wheel [N]", &DrivenAxle::normal_load);
  of_axles("Sinkage [mm]", [](const DrivenAxle& a) { return 1000 * a.sinkage; });
  of_axles("Torque of a wheel [N m]", &DrivenAxle::torque);
  return sheet;
}

const DriveColumns<VehicleDriveSample>& driven_columns() {
  using S = VehicleDriveSample;
  using Energy = bekker_wong::EnergyLedger;
  static const DriveColumns<S> all = {{"time_s", &S::time},
                                      {"travelled_m", &S::travelled},
                                      {"speed_m_s", &S::speed},
                                      {"acceleration_m_s2", &S::acceleration},
                                      {"rim_speed_m_s", &S::rim_speed},
                                      {"slip", slip_or_none},
                                      {"torque_Nm", &S::torque},
                                      {"pull_N", &S::pull},
                                      {"slope_deg", in_degrees(&S::slope)},
                                      {"motor_J", energy(&Energy::motor)},
                                      {"kinetic_J", energy(&Energy::kinetic)},
                                      {"height_J", energy(&Energy::height)},
                                      {"drawbar_J", energy(&Energy::drawbar)},
                                      {"compaction_J", energy(&Energy::compaction)},
                                      {"shear_J", energy(&Energy::shear)},
                                      {"added_forces_J", energy(&Energy::added)},
                                      {"carcass_J", energy(&Energy::carcass)},
                                      {"damping_J", energy(&Energy::damping)},
                                      {"unaccounted_J", energy(&Energy::unaccounted)}};
  return all;
}

const DriveColumns<DrivenAxle>& driven_axle_columns() {
  using A = DrivenAxle;
  static const DriveColumns<A> all = {
      {"normal_load_N", &A::normal_load}, {"rim_speed_m_s", &A::rim_speed}, {"slip", slip_or_none},
      {"contact_slip", &A::contact_slip}, {"sinkage_m", &A::sinkage},       {"torque_Nm", &A::torque},
      {"soil_force_N", &A::forward}};
  return all;
}

Json moved_vehicle_json(const MovedVehicleDrive::Side& side) {
  return moved_drive_json(side.value, side.end, side.end_time, side.travelled);
}

Json driven_json(const DrivenAnswers& answers) {
  Json document = {{"format", "soilbin-vehicle-drive/1"},
                   {"vehicle", answers.question.name},
                   {"soil", answers.question.soil.name},
                   {"steepest_steady_slope", or_null(answers.up.angle)}};
  document["end"] = answers.record ? Json(std::string(word_of(answers.record->end))) : Json();
  document["failure"] = answers.failure ? Json(answers.failure->words) : Json();
  if (!answers.record) return document;
  const VehicleDriveRecord& record = *answers.record;
  document["end_time"] = record.end_time;
  document["end_time_std_error"] = or_null(answers.end_time_error);
  document["travelled"] = record.samples.back().travelled;
  document["travelled_std_error"] = or_null(answers.travelled_error);
  document["gave_out"] = record.gave_out ? Json(axle_called(answers, *record.gave_out)) : Json();
  document["at_motors_limit"] = record.at_motors_limit;
  document["soil_errors"] = list_of(answers.moved, [](const MovedVehicleDrive& moved) {
    return Json{{"of", moved.title},
                {"value", moved.value},
                {"std_error", moved.sd},
                {"lower", moved_vehicle_json(moved.lower)},
                {"higher", moved_vehicle_json(moved.higher)}};
  });
  document["happenings"] = list_of(record.happenings, [&](const VehicleDriveHappening& h) {
    return Json{{"time", h.time},
                {"travelled", h.travelled},
                {"axle", axle_called(answers, h.axle)},
                {"what", std::string(word_of(h.what))}};
  });
  document["samples"] = columns_json(driven_columns(), record.samples);
  document["axles"] = Json::array();
  for (std::size_t i = 0; i < answers.question.axles.size(); ++i) {
    std::vector<DrivenAxle> sampled;
    for (const VehicleDriveSample& s : record.samples) sampled.push_back(s.axles[i]);
    Json axle = {{"axle", axle_called(answers, i)}};
    axle.update(columns_json(driven_axle_columns(), sampled));
    document["axles"].push_back(std::move(axle));
  }
  return document;
}

std::string driven_csv(const DrivenAnswers& answers) {
  std::string text = names_csv(driven_columns()) + ",axle," + names_csv(driven_axle_columns(), "wheel_") + "\n";
  if (!answers.record) return text;
  for (const VehicleDriveSample& s : answers.record->samples)
    for (std::size_t i = 0; i < s.axles.size(); ++i)
      text += sample_csv(driven_columns(), s) + "," + csv_cell(axle_called(answers, i)) + "," +
              sample_csv(driven_axle_columns(), s.axles[i]) + "\n";
  return text;
}

}  // namespace

Report report_on(const DrivenAnswers& answers) {
  const VehicleCase& question = answers.question;
  Report report{
      "Vehicle in time: " + question.name, "Does it start, does it climb, and where does it get stuck?",
      fmt::format("{} ({:.6g} kg) on {}, from rest", question.name, question.mass, soils_driven_on(question))};
  if (answers.record) report.add(driven_samples_table(*answers.record), Told::on_terminals);
  report.add(Sentences(driven_verdicts(answers)));
  report.add(WarningsHere());
  if (answers.record) {
    report.sheet = drawn_once([&answers] { return driven_sheet(answers); });
    report.add("Against time", Figure(report.sheet, "Of each axle one of its wheels."));
    report.add("Axle by axle", driven_axles_table(answers));
    report.add("Where the work went", driven_energy_table(answers.record->samples.back().energy));
    if (!answers.record->happenings.empty()) report.add("On the way", driven_happenings_table(answers));
  } else {
    report.no_answer = "does not stand at its start: " + answers.failure->words;
  }
  report.data = [&answers] { return driven_json(answers); };
  report.csv = [&answers] { return driven_csv(answers); };
  return report;
}

}  // namespace soilbin::compare
