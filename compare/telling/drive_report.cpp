// A drive as it is told: the analytic wheel's, and both models' side by side.
#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>

#include "compare/drives/drive.hpp"
#include "compare/drives/drive_sides.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/report/number_text.hpp"
#include "compare/sweep/answers.hpp"
#include "compare/sweep/result_json.hpp"
#include "compare/sweep/varying.hpp"
#include "compare/telling/drive_columns.hpp"
#include "compare/telling/reports.hpp"
#include "scenario/drive_way.hpp"
#include "scenario/nearest_word.hpp"
#include "scenario/unit.hpp"

namespace soilbin::compare {
namespace {

using bekker_wong::DriveSample;
using bekker_wong::EnergyLedger;

/// What every kind of sample has: `of_its_own` stand behind the slip, `of_its_energy` at the end.
template <class S>
DriveColumns<S> drive_columns(const DriveColumns<S>& of_its_own, const DriveColumns<S>& of_its_energy) {
  DriveColumns<S> all = {{"time_s", &S::time},
                         {"travelled_m", &S::travelled},
                         {"speed_m_s", &S::speed},
                         {"rim_speed_m_s", &S::rim_speed},
                         {"slip", slip_or_none}};
  const DriveColumns<S> more = {{"sinkage_m", &S::sinkage},
                                {"torque_Nm", &S::torque},
                                {"soil_force_N", &S::forward},
                                {"lateral_force_N", &S::lateral},
                                {"drawbar_N", &S::drawbar},
                                {"longitudinal_incline_deg", in_degrees(&S::longitudinal_incline)},
                                {"motor_J", energy(&WheelEnergy::motor)},
                                {"kinetic_J", energy(&WheelEnergy::kinetic)},
                                {"height_J", energy(&WheelEnergy::height)},
                                {"drawbar_J", energy(&WheelEnergy::drawbar)}};
  for (const DriveColumns<S>* columns : {&of_its_own, &more, &of_its_energy})
    all.insert(all.end(), columns->begin(), columns->end());
  return all;
}

/// A line a sample.
template <class Sample>
std::string samples_csv(const DriveColumns<Sample>& columns, const std::vector<Sample>& samples,
                        const std::string& first_cell = "") {
  std::string text;
  for (const Sample& sample : samples) text += first_cell + sample_csv(columns, sample) + "\n";
  return text;
}

Json happenings_json(const std::vector<DriveHappening>& happenings) {
  return list_of(happenings, [](const DriveHappening& h) {
    return Json{{"time", h.time}, {"travelled", h.travelled}, {"what", std::string(word_of(h.what))}};
  });
}

std::string heading_of(const Case& question) {
  return fmt::format("{}: {} on {}", question.name, in_words(question.scenario.tire), in_words(question.scenario.soil));
}

/// "Steadily it climbs less than 14 deg of dry-sand, with the cross slope of 10 deg at its start."
std::string words_on_steepest(const AnalyticDrive& part) {
  const Place start = angles_along(part.question.drive->profile).at(0.0);
  std::vector<std::string> askew;
  for (const auto& [name, angle] : {std::pair{"cross slope", start.transverse_incline}, {"yaw", start.yaw}})
    if (angle != 0.0) askew.push_back(fmt::format("{} of {:.3g} deg", name, angle / degree));
  return fmt::format("Steadily it climbs less than {:.3g} deg of {}{}.", *part.steepest / degree,
                     in_words(part.question.scenario.soil),
                     askew.empty() ? "" : fmt::format(", with the {} at its start", fmt::join(askew, " and the ")));
}

/// "the wheel is stuck"
std::string end_in_words(DriveEnd end) {
  if (end == DriveEnd::time_is_up) return "time is up";
  if (end == DriveEnd::arrived) return "the wheel arrives";
  if (end == DriveEnd::rolled_back) return "the wheel has rolled back";
  return end == DriveEnd::bed_ends ? "the bed ends" : fmt::format("the wheel is {}", word_of(end));
}

/// "50.49 ± 0.80", or the value alone where it has no error.
std::string with_error(double value, const std::optional<double>& std_error) {
  return std_error && *std_error > 0.0 ? number(Estimate{value, *std_error}) : fmt::format("{:.4g}", value);
}

std::string moved_in_words(const MovedDrive::Side& side) {
  if (!side.record) return "the soil can't carry the wheel at the start";
  return fmt::format("{} after {} s and {} m", end_in_words(side.record->end), number(side.record->end_time),
                     number(side.record->samples.back().travelled));
}

/// "friction angle", or "friction angle of snow" where values of other soils were moved too.
std::string title_of(const MovedDrive& drive, const DriveErrors& errors) {
  const bool elsewhere = !drive.soil.empty() && drive.soil != errors.moved.front().soil;
  return elsewhere ? fmt::format("{} of {}", drive.title, drive.soil) : drive.title;
}

/// "Most of the ± comes from the friction angle and K.": the values that make up four fifths of the variance, where
/// they are three at most. "" where values err together: then none has a part of its own.
std::string largest_parts(const AnalyticDrive& part) {
  constexpr double most = 0.8;
  if (part.errors.correlated()) return "";
  const bool by_time = part.record.end == DriveEnd::arrived;
  const auto value = [&](const bekker_wong::DriveRecord& r) {
    return std::optional(by_time ? r.end_time : r.samples.back().travelled);
  };
  std::vector<std::pair<double, std::string>> parts;
  double sum = 0.0, told = 0.0;
  for (const MovedDrive& drive : part.errors.moved) {
    const double by = change(drive, *value(part.record), value).value_or(0.0);
    parts.emplace_back(by * by, title_of(drive, part.errors));
    sum += by * by;
  }
  std::ranges::sort(parts, std::greater());
  std::vector<std::string> names;
  for (const auto& [square, name] : parts) {
    if (told >= most * sum) break;
    told += square;
    names.push_back(name);
  }
  return names.empty() || names.size() > 3 ? "" : "Most of the ± comes from " + listed(names) + ".";
}

/// "On snow from 0.5 m on: ± is ..." of each soil of the way that is another one than those before.
std::vector<std::string> words_on_other_soils(const Case& question) {
  const auto errors_on = [](const Soil& soil) {
    Scenario scenario;
    scenario.soil = soil;
    return errors_in_words(scenario);
  };
  const auto named = [&](const Soil& soil) { return soil.name + ": " + errors_on(soil); };
  std::vector<std::string> sentences, told = {named(question.scenario.soil)};
  for (const Waypoint& point : question.drive->profile) {
    if (!point.soil || std::ranges::find(told, named(*point.soil)) != told.end()) continue;
    told.push_back(named(*point.soil));
    sentences.push_back(
        fmt::format("On {} from {:.4g} m on: {}", compare::in_words(*point.soil), point.at, errors_on(*point.soil)));
  }
  return sentences;
}

/// Where the errors come from, and the drives that end in another way.
std::vector<std::string> words_on_errors(const AnalyticDrive& part) {
  std::vector<std::string> sentences;
  if (part.errors.travelled) {
    const Drive& drive = *part.question.drive;
    sentences.push_back(
        errors_in_words(seen_by({ModelKind::bekker_wong, drive.effects, "", drive.errors}, part.question.scenario)));
    const std::vector<std::string> others = words_on_other_soils(part.question);
    sentences.insert(sentences.end(), others.begin(), others.end());
    if (const std::string parts = largest_parts(part); !parts.empty()) sentences.push_back(parts);
  }
  for (const MovedDrive& drive : part.errors.moved)
    for (const MovedDrive::Side* side : {&drive.lower, &drive.higher}) {
      if (!drive.ends_otherwise(*side, part.record.end)) continue;
      sentences.push_back(fmt::format("With {}{} a standard deviation {} ({}{}) {}.", drive.soil.empty() ? "" : "the ",
                                      drive.soil.empty() ? drive.title : drive.title + " of " + drive.soil,
                                      side == &drive.lower ? "lower" : "higher", number(side->value * drive.per_si),
                                      unit_behind(drive.unit), moved_in_words(*side)));
    }
  return sentences;
}

std::vector<std::string> sentences_of(const AnalyticDrive& part) {
  const bekker_wong::DriveRecord& record = part.record;
  const DriveSample& end = record.samples.back();
  std::vector<std::string> sentences;
  const DriveErrors& errors = part.errors;
  // A time that is given and a place that is reached have no error.
  sentences.push_back(fmt::format(
      "{} after {} s and {} m, on a slope of {:.3g} deg.", capital(end_in_words(record.end)),
      with_error(record.end_time, record.end == DriveEnd::time_is_up ? std::nullopt : errors.end_time),
      with_error(end.travelled, record.end == DriveEnd::arrived && errors.end_time ? std::nullopt : errors.travelled),
      end.longitudinal_incline / degree));
  if (end.slip && record.end != DriveEnd::stuck)
    sentences.push_back(fmt::format("Its slip is then {:.3g} %, its sinkage {:.3g} mm, its torque {:.3g} N m.",
                                    100 * *end.slip, 1000 * end.sinkage, end.torque));
  if (part.steepest) sentences.push_back(words_on_steepest(part));
  const std::vector<std::string> on_errors = words_on_errors(part);
  sentences.insert(sentences.end(), on_errors.begin(), on_errors.end());
  return sentences;
}

Table happenings_table(const std::vector<DriveHappening>& happenings) {
  Table table{"", {"time [s]", "travelled [m]", "what happened"}, {false, false, true}};
  for (const DriveHappening& h : happenings)
    table.add({number(h.time), number(h.travelled), std::string(word_of(h.what))});
  return table;
}

Table errors_table(const DriveErrors& errors) {
  Table table{"What a standard deviation of each value does",
              {"", "as declared", "a standard deviation lower", "higher"},
              {true, false, true, true}};
  for (const MovedDrive& drive : errors.moved) {
    const auto cell = [&](const MovedDrive::Side& side) -> std::string {
      if (!drive.was_moved(side)) return "lies on its bound";
      if (!side.record) return moved_in_words(side);
      return fmt::format("{}, {:.3g} m, {:.3g} s", word_of(side.record->end), side.record->samples.back().travelled,
                         side.record->end_time);
    };
    table.add({title_of(drive, errors), number(drive.of, drive.per_si) + unit_behind(drive.unit), cell(drive.lower),
               cell(drive.higher)});
  }
  return table;
}

/// Where the motor's work went: a name, its share in J and in percent; what is unaccounted for, then all of it, last.
/// Of a wheel that came down or braked: where the work of motor and gravity went, and how much each put in.
Table energy_table(const EnergyLedger& e) {
  constexpr double by_sinking = 0.01;
  const bool motor_alone = e.motor >= 0.0 && -e.height <= by_sinking * e.motor;  // the wheel's sinking gives a little
  const double gravity = motor_alone ? 0.0 : std::max(0.0, -e.height), given = std::max(0.0, e.motor) + gravity;
  const std::string of = motor_alone ? "the motor's work" : "the work put in";
  Table table{"", {"of " + of, "J", "%"}, {true}};
  const auto add = [&](const char* name, double joules) {
    table.add({name, number(joules), given != 0.0 ? number(100 * joules / given) : "-"});
  };
  add("shears the soil", e.shear), add("presses the soil", e.compaction), add("added forces of effects", e.added);
  if (e.carcass != 0.0) add("is in the tire's carcass", e.carcass);
  if (motor_alone || e.height >= 0.0) add("lifts the load", e.height);
  add("pulls the drawbar", e.drawbar), add("is in motion", e.kinetic);
  if (e.motor < 0.0) add("is taken by the motor, which brakes", -e.motor);
  add("damps the heave", e.damping), add("unaccounted for", e.unaccounted());
  if (!motor_alone && e.motor > 0.0) add("put in: motor's work", e.motor);
  if (!motor_alone && gravity > 0.0) add("put in: gravity's work", gravity);
  table.add({"in all", number(given), "100"});
  return table;
}

Table samples_table(const bekker_wong::DriveRecord& record) {
  Table table{"",
              {"time [s]", "travelled [m]", "slope [deg]", "speed [cm/s]", "rim [cm/s]", "slip [%]", "sinkage [mm]",
               "torque [N m]", "soil force [N]"}};
  for (const DriveSample& s : picked_samples(record.samples, shown_samples))
    table.add({number(s.time), number(s.travelled), number(s.longitudinal_incline / degree), number(100 * s.speed),
               number(100 * s.rim_speed), slip_text(s.slip), number(1000 * s.sinkage), number(s.torque),
               number(s.forward)});
  return table;
}

struct Line {
  std::string label;
  std::function<double(const DriveSample&)> get;
};

/// A label tells its panel ("speed: rim"), since the sheet's panels share one legend: in it each has a colour, or
/// colour and dash, of its own. `named`: how many there are so far.
Plot plot_of(const AnalyticDrive& part, const std::string& title, const std::vector<Line>& lines, int& named) {
  const int available = static_cast<int>(colors(Palette::named).size());
  std::string panel = title.substr(0, title.find(" ["));
  panel.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(panel.front())));
  Plot plot{title, {"time [s]"}};
  for (const Line& line : lines) {
    Series series{.label = line.label.empty() ? "" : panel + ": " + line.label};
    if (!line.label.empty()) series.color = named % available, series.dash = named / available, ++named;
    plot.series.push_back(over_samples(std::move(series), part.record.samples, &DriveSample::time, line.get));
  }
  return plot;
}

Sheet drive_sheet(const AnalyticDrive& part) {
  Sheet sheet{part.question.name};
  int named = 0;
  const auto add = [&](const std::string& title, const std::vector<Line>& lines) {
    sheet.plots.push_back(plot_of(part, title, lines, named));
  };
  add("Speed [cm/s]", {{"travel", [](const DriveSample& s) { return 100 * s.speed; }},
                       {"rim", [](const DriveSample& s) { return 100 * s.rim_speed; }}});
  add("Slip [%]", {{"by the speeds of the instant", [](const DriveSample& s) { return 100 * slip_or_none(s); }},
                   {"seen by the soil in contact", [](const DriveSample& s) { return 100 * s.contact_slip; }}});
  add("Sinkage [mm]", {{"", [](const DriveSample& s) { return 1000 * s.sinkage; }}});
  add("Torque [N m]", {{"", &DriveSample::torque}});
  const double load = part.question.drive->load;
  add("Along travel [N]",
      {{"force of the soil", &DriveSample::forward},
       {"slope's share of the load", [load](const DriveSample& s) { return load * std::sin(s.longitudinal_incline); }},
       {"drawbar load", &DriveSample::drawbar}});
  add("Energy [J]", {{"motor's work", energy(&EnergyLedger::motor)},
                     {"shears the soil", energy(&EnergyLedger::shear)},
                     {"presses the soil", energy(&EnergyLedger::compaction)},
                     {"lifts the load", energy(&EnergyLedger::height)},
                     {"pulls the drawbar", energy(&EnergyLedger::drawbar)}});
  return sheet;
}

const DriveColumns<DriveSample>& sample_columns() {
  static const DriveColumns<DriveSample> all = drive_columns<DriveSample>(
      {{"contact_slip", &DriveSample::contact_slip}}, {{"compaction_J", energy(&EnergyLedger::compaction)},
                                                       {"shear_J", energy(&EnergyLedger::shear)},
                                                       {"added_forces_J", energy(&EnergyLedger::added)},
                                                       {"damping_J", energy(&EnergyLedger::damping)},
                                                       {"unaccounted_J", energy(&EnergyLedger::unaccounted)},
                                                       {"carcass_J", energy(&EnergyLedger::carcass)}});
  return all;
}

Json moved_side_json(const MovedDrive& drive, const MovedDrive::Side& side) {
  if (!drive.was_moved(side)) return nullptr;
  if (!side.record) return moved_drive_json(side.value, std::nullopt, 0.0, 0.0);
  return moved_drive_json(side.value, side.record->end, side.record->end_time, side.record->samples.back().travelled);
}

Json errors_json(const DriveErrors& errors) {
  return list_of(errors.moved, [](const MovedDrive& drive) {
    return Json{{"soil", drive.soil},
                {"parameter", drive.parameter},
                {"value", drive.of.value},
                {"std_error", drive.of.std_error},
                {"lower", moved_side_json(drive, drive.lower)},
                {"higher", moved_side_json(drive, drive.higher)}};
  });
}

Json drive_json(const AnalyticDrive& part) {
  const bekker_wong::DriveRecord& record = part.record;
  const DriveSample& end = record.samples.back();
  Json document = {{"format", "soilbin-drive/1"},
                   {"case", part.question.name},
                   {"tire", part.question.scenario.tire.name},
                   {"soil", part.question.scenario.soil.name},
                   {"end", std::string(word_of(record.end))},
                   {"end_time", record.end_time},
                   {"travelled", end.travelled},
                   {"end_time_std_error", or_null(part.errors.end_time)},
                   {"travelled_std_error", or_null(part.errors.travelled)},
                   {"soil_errors", errors_json(part.errors)},
                   {"steepest_steady_slope", or_null(part.steepest)}};
  document["happenings"] = happenings_json(record.happenings);
  document["energy"] = {{"motor", end.energy.motor},           {"kinetic", end.energy.kinetic},
                        {"height", end.energy.height},         {"drawbar", end.energy.drawbar},
                        {"compaction", end.energy.compaction}, {"shear", end.energy.shear},
                        {"added_forces", end.energy.added},    {"carcass", end.energy.carcass},
                        {"damping", end.energy.damping},       {"unaccounted", end.energy.unaccounted()}};
  document["samples"] = columns_json(sample_columns(), record.samples);
  return document;
}

std::string drive_csv(const AnalyticDrive& part) {
  return names_csv(sample_columns()) + "\n" + samples_csv(sample_columns(), part.record.samples);
}

// Both models side by side.

std::string steady_words(const dem::SteadyDrive& s) {
  return fmt::format("; steady{} at {} % slip, {} mm sinkage, {} N m torque",
                     s.steady ? "" : " by way and motor, but still drifting,", number(s.slip, 100),
                     number(s.sinkage, 1000), number(s.torque));
}

/// "dem, mean of 3 packings: arrived on 2 and stuck on 1, ..."
std::string sentence_of(const DriveOverPackings& one) {
  std::string ends;
  std::vector<DriveEnd> listed;
  for (const DriveEnd end : one.ends) {
    if (std::ranges::find(listed, end) != listed.end()) continue;
    listed.push_back(end);
    ends += fmt::format("{}{} on {}", ends.empty() ? "" : ", ", word_of(end), std::ranges::count(one.ends, end));
  }
  std::string text = fmt::format("Grains, mean of {} bed samples: {}, after {} s and {} m", one.ends.size(), ends,
                                 number(one.end_time), number(one.travelled));
  return text + (one.steady ? steady_words(*one.steady) : "; not all bed samples have a steady state") + ".";
}

/// Why a side has no steady state, or which values' errors its steady values leave out; "": neither.
std::string why_not_steady(const DriveSide& side) {
  if (side.errors_leave_out.empty()) return side.not_steady;
  return "the standard errors leave out " + listed(side.errors_leave_out) + ": the drive has no steady state beside it";
}

std::string sentence_of(const DriveSide& side) {
  const DriveState& end = side.samples.back();
  std::string text = fmt::format("{}: {} after {:.4g} s and {:.4g} m", capital(model_in_words(side.label)),
                                 word_of(side.end), side.end_time, end.travelled);
  const std::string why = why_not_steady(side);
  if (!side.steady) return text + fmt::format("; no steady state: {}.", why);
  return text + steady_words(*side.steady) + (why.empty() ? "." : fmt::format(" ({}).", why));
}

std::vector<std::string> sentences_of(const DriveSides& drive) {
  std::vector<std::string> sentences;
  for (const DriveSide& side : drive.sides) sentences.push_back(sentence_of(side));
  if (drive.over_packings) sentences.push_back(sentence_of(*drive.over_packings));
  std::string apart;
  for (const DriveDifference& row : drive.differences)
    if (row.finding == DifferenceFinding::difference)
      apart += fmt::format("{}{} by {} {}", apart.empty() ? "" : ", ", row.name,
                           number({row.difference, row.std_error}, row.per_si), row.unit);
  if (!apart.empty())
    sentences.push_back("In the steady state the models differ in " + apart + ".");
  else if (!drive.differences.empty())
    sentences.push_back("In the steady state no difference is significant.");
  return sentences;
}

Table packings_table(const DriveSides& drive) {
  Table table{
      "± is one standard error; of the mean from the scatter of bed samples or, where it is larger, from their own",
      {"on each bed sample"},
      {true}};
  if (!drive.over_packings) return table;
  const DriveOverPackings& mean = *drive.over_packings;
  const std::vector<const DriveSide*> grains = grain_sides(drive);
  const auto add = [&](const std::string& name, const auto& of, const std::string& last) {
    std::vector<TableCell> row{name};
    for (const DriveSide* side : grains) row.push_back(of(*side));
    row.push_back(last);
    table.add(std::move(row));
  };
  for (const DriveSide* side : grains) table.header.push_back(side->label);
  table.header.emplace_back("mean");
  table.text_columns.resize(table.header.size(), false);
  add(
      "end", [](const DriveSide& s) { return std::string(word_of(s.end)); }, "");
  add(
      "after [s]", [](const DriveSide& s) { return number(s.end_time); }, number(mean.end_time));
  add(
      "travelled [m]", [](const DriveSide& s) { return number(s.samples.back().travelled); }, number(mean.travelled));
  for (const SteadyValue& value : steady_values) {
    const auto text_of = [&](const std::optional<dem::SteadyDrive>& steady) {
      return steady ? number((*steady).*value.value, value.per_si) : "-";
    };
    add(
        fmt::format("{} [{}]", value.name, value.unit), [&](const DriveSide& s) { return text_of(s.steady); },
        text_of(mean.steady));
  }
  return table;
}

const DriveColumns<DriveSideSample>& side_columns() {
  static const DriveColumns<DriveSideSample> all =
      drive_columns<DriveSideSample>({}, {{"soil_J", &DriveSideSample::soil}});
  return all;
}

/// One quantity over time; `steady`: its mean where nothing changes any more.
struct Panel {
  const char* title;
  double per_si;
  std::function<double(const DriveSideSample&)> get;
  Estimate dem::SteadyDrive::*steady = nullptr;
};

/// The mean of grains over the time that it is a mean of, with its error.
Series steady_line(const dem::SteadyDrive& steady, const Panel& panel, int color) {
  const Estimate mean = steady.*panel.steady;
  const double value = panel.per_si * mean.value, error = panel.per_si * mean.std_error;
  return {.label = "grains, steady",
          .x = {steady.from, steady.to},
          .y = {value, value},
          .error = {error, error},
          .color = color,
          .dash = 1};
}

Plot plot_of(const DriveSides& drive, const Panel& panel) {
  Plot plot{panel.title, {"time [s]"}};
  for (std::size_t i = 0; i < drive.sides.size(); ++i) {
    const DriveSide& side = drive.sides[i];
    const bool behind_the_wheel = drive.sides.front().kind == SideKind::analytic;
    plot.series.push_back(
        over_samples({.label = side.packing ? "grains" : model_in_words(side.label),  // packings are of one colour
                      .color = side.packing ? static_cast<int>(behind_the_wheel) : static_cast<int>(i)},
                     side.samples, &DriveSideSample::time,
                     [&](const DriveSideSample& sample) { return panel.per_si * panel.get(sample); }));
  }
  if (const auto steady = steady_of_grains(drive); panel.steady && steady) {
    constexpr int after_sides = 2;
    plot.series.push_back(steady_line(*steady, panel, after_sides));
  }
  return plot;
}

Json steady_json(const dem::SteadyDrive& steady) {
  return {{"from", steady.from},
          {"to", steady.to},
          {"speed", estimate_json(steady.speed)},
          {"rim_speed", estimate_json(steady.rim_speed)},
          {"slip", estimate_json(steady.slip)},
          {"sinkage", estimate_json(steady.sinkage)},
          {"torque", estimate_json(steady.torque)},
          {"soil_force", estimate_json(steady.forward)},
          {"steady", steady.steady},
          {"drift", steady.drift}};
}

Json drive_side_json(const DriveSide& side) {
  const DriveSideSample& end = side.samples.back();
  Json row = {{"model", side.packing ? "dem" : side.label}};
  if (side.packing) row["packing"] = *side.packing;
  row["end"] = std::string(word_of(side.end));
  row["end_time"] = side.end_time;
  row["travelled"] = end.travelled;
  row["happenings"] = happenings_json(side.happenings);
  row["steady"] = side.steady ? steady_json(*side.steady) : Json(nullptr);
  if (const std::string why = why_not_steady(side); !why.empty()) row["not_steady"] = why;
  row["energy"] = {{"motor", end.energy.motor},
                   {"kinetic", end.energy.kinetic},
                   {"height", end.energy.height},
                   {"drawbar", end.energy.drawbar},
                   {"soil", end.soil},
                   {"unaccounted", end.energy.left() - end.soil}};
  row["soil_parts"] = Json::object();
  for (const auto& [name, joules] : side.soil_parts) row["soil_parts"][name] = joules;
  row["samples"] = columns_json(side_columns(), side.samples);
  return row;
}

Json over_packings_json(const DriveOverPackings& one) {
  return {{"ends", list_of(one.ends, [](DriveEnd end) { return std::string(word_of(end)); })},
          {"end_time", estimate_json(one.end_time)},
          {"travelled", estimate_json(one.travelled)},
          {"steady", one.steady ? steady_json(*one.steady) : Json(nullptr)}};
}

Table happenings_table(const DriveSides& drive) {
  Table table{"", {"model", "time [s]", "travelled [m]", "what happened"}, {true, false, false, true}};
  for (const DriveSide& side : drive.sides) {
    const std::string model = model_in_words(side.label);
    for (const DriveHappening& h : side.happenings)
      table.add({model, number(h.time), number(h.travelled), std::string(word_of(h.what))});
    table.add({model, number(side.end_time), number(side.samples.back().travelled), std::string(word_of(side.end))});
  }
  return table;
}

Table differences_table(const DriveSides& drive) {
  Table table{fmt::format("± is one standard error: of the analytic wheel the soil's uncertainty, of grains {}",
                          drive.over_packings ? "the scatter of bed samples" : "block averages of one run"),
              {"steady state", "analytic wheel", "grains", "difference", ""},
              {true, false, false, false, true}};
  for (const DriveDifference& row : drive.differences)
    table.add({fmt::format("{} [{}]", row.name, row.unit), number(row.analytic, row.per_si),
               number(row.grains, row.per_si), number({row.difference, row.std_error}, row.per_si),
               std::string(words(row.finding))});
  return table;
}

Table work_table(const DriveSides& drive) {
  Table table{"", {"of the motor's work [J]"}, {true}};
  for (const DriveSide& side : drive.sides)
    table.header.push_back(model_in_words(side.label)), table.text_columns.push_back(false);
  for (const DriveWorkRow& work : work_rows(drive)) {
    std::vector<TableCell> row{work.name};
    for (const std::optional<double>& joules : work.joules) row.push_back(joules ? number(*joules) : "");
    table.add(std::move(row));
  }
  std::vector<TableCell> all{"in all"};
  for (const DriveSide& side : drive.sides) all.push_back(number(side.samples.back().energy.motor));
  table.add(std::move(all));
  return table;
}

/// So many of all sides' samples, but three of each at least.
Table samples_table(const DriveSides& drive) {
  const std::size_t rows_of_each =
      std::max<std::size_t>(3, shown_samples / std::max<std::size_t>(2, drive.sides.size()));
  Table table{"",
              {"time [s]", "travelled [m]", "slope [deg]", "speed [cm/s]", "slip [%]", "sinkage [mm]", "torque [N m]",
               "soil force [N]"}};
  for (const DriveSide& side : drive.sides) {
    table.add({capital(model_in_words(side.label))});
    for (const DriveSideSample& s : picked_samples(side.samples, rows_of_each))
      table.add({number(s.time), number(s.travelled), number(s.longitudinal_incline / degree), number(100 * s.speed),
                 slip_text(s.slip), number(1000 * s.sinkage), number(s.torque), number(s.forward)});
  }
  return table;
}

Sheet drive_sheet(const DriveSides& drive) {
  using S = DriveSideSample;
  using M = dem::SteadyDrive;
  Sheet sheet{drive.question.name};
  for (const Panel& panel :
       std::initializer_list<Panel>{{"Travelled [m]", 1, &S::travelled},
                                    {"Speed [cm/s]", 100, &S::speed, &M::speed},
                                    {"Slip [%]", 100, slip_or_none, &M::slip},
                                    {"Sinkage [mm]", 1000, &S::sinkage, &M::sinkage},
                                    {"Torque [N m]", 1, &S::torque, &M::torque},
                                    {"Force of the soil along travel [N]", 1, &S::forward, &M::forward},
                                    {"Motor's work [J]", 1, energy(&WheelEnergy::motor)},
                                    {"Work given to the soil [J]", 1, &S::soil}})
    sheet.plots.push_back(plot_of(drive, panel));
  return sheet;
}

Json drive_json(const DriveSides& drive) {
  Json document = {{"format", "soilbin-drive-sides/1"},
                   {"case", drive.question.name},
                   {"tire", drive.question.scenario.tire.name},
                   {"soil", drive.question.scenario.soil.name}};
  document["sides"] = list_of(drive.sides, drive_side_json);
  if (drive.over_packings) document["over_packings"] = over_packings_json(*drive.over_packings);
  document["differences"] = list_of(drive.differences, [](const DriveDifference& row) {
    return Json{{"of", row.name},
                {"analytic", estimate_json(row.analytic)},
                {"grains", estimate_json(row.grains)},
                {"difference", row.difference},
                {"std_error", row.std_error},
                {"finding", std::string(word(row.finding))}};
  });
  document["notes"] = drive.notes;
  return document;
}

std::string drive_csv(const DriveSides& drive) {
  std::string text = "model," + names_csv(side_columns()) + "\n";
  for (const DriveSide& side : drive.sides) text += samples_csv(side_columns(), side.samples, side.label + ",");
  return text;
}

}  // namespace

Report report_on(const AnalyticDrive& drive) {
  Report report{drive.question.name, drive.question.description, heading_of(drive.question)};
  report.add(samples_table(drive.record), Told::on_terminals);
  report.add(Sentences(sentences_of(drive)));
  report.sheet = drawn_once([&drive] { return drive_sheet(drive); });
  report.add(
      "Against time",
      Figure{report.sheet,
             "The soil in contact has seen the slip of the last quarter turn or so: it lags behind the speeds."});
  if (!drive.errors.moved.empty()) report.add("How sure", errors_table(drive.errors));
  report.add("Where the work went", energy_table(drive.record.samples.back().energy));
  if (!drive.record.happenings.empty()) report.add("On the way", happenings_table(drive.record.happenings));
  report.data = [&drive] { return drive_json(drive); };
  report.csv = [&drive] { return drive_csv(drive); };
  return report;
}

Report report_on(const DriveSides& drive) {
  Report report{drive.question.name, drive.question.description, heading_of(drive.question)};
  report.add(samples_table(drive), Told::on_terminals);
  report.add(Sentences(sentences_of(drive)));
  report.sheet = drawn_once([&drive] { return drive_sheet(drive); });
  report.add("Against time",
             Figure{report.sheet,
                    "Instants of the analytic wheel; of grains means since the sample before. Dashed: "
                    "mean of the grains where way and motor no longer change, with its standard error."});
  if (!drive.differences.empty()) report.add("Steady state", differences_table(drive));
  if (drive.over_packings) report.add("On each bed sample", packings_table(drive));
  report.add("Where the motor's work went", work_table(drive));
  report.add("On the way", happenings_table(drive));
  report.notes = drive.notes;
  report.data = [&drive] { return drive_json(drive); };
  report.csv = [&drive] { return drive_csv(drive); };
  return report;
}

}  // namespace soilbin::compare
