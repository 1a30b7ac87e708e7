#include "compare/drives/drive.hpp"

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>

#include "bekker_wong/limits.hpp"
#include "bekker_wong/model.hpp"
#include "compare/drives/drive_columns.hpp"
#include "compare/report/number_text.hpp"
#include "compare/report/page.hpp"
#include "compare/sweep/result_json.hpp"
#include "compare/sweep/varying.hpp"
#include "scenario/drive_way.hpp"
#include "scenario/errors.hpp"
#include "scenario/estimate.hpp"
#include "scenario/nearest_word.hpp"
#include "scenario/unit.hpp"

namespace soilbin::compare {
namespace {

using bekker_wong::DriveSample;
using bekker_wong::EnergyLedger;

double slip_of(const DriveSample& s) { return s.slip.value_or(not_a_number); }

Place start_of(const Drive& drive) { return angles_along(drive.profile).at(0.0); }

std::optional<double> steepest_of(const Case& question) {
  const Drive& drive = *question.drive;
  const Place start = start_of(drive);
  const bekker_wong::RollingWheel wheel(question.scenario.tire,
                                        bekker_wong::values_of(*question.scenario.soil.semi_empirical),
                                        bekker_wong::make_effects(drive.effects), question.scenario.bin);
  OperatingCondition at;
  at.load = drive.load;
  at.pass = drive.pass;
  at.transverse_incline = start.transverse_incline, at.yaw = start.yaw;
  at.speed = drive.controller.rim_speed.value_or(at.speed);
  try {
    return bekker_wong::steepest_slope(wheel, at);
  } catch (const NoSolution&) {
    return {};
  }
}

/// "Steadily it climbs less than 14 deg of dry-sand, with the cross slope of 10 deg at its start."
std::string words_on_steepest(const AnalyticDrive& part) {
  const Place start = start_of(*part.question.drive);
  std::vector<std::string> askew;
  for (const auto& [name, angle] : {std::pair{"cross slope", start.transverse_incline}, {"yaw", start.yaw}})
    if (angle != 0.0) askew.push_back(fmt::format("{} of {:.3g} deg", name, angle / degree));
  return fmt::format("Steadily it climbs less than {:.3g} deg of {}{}.", *part.steepest / degree,
                     in_words(part.question.scenario.soil),
                     askew.empty() ? "" : fmt::format(", with the {} at its start", fmt::join(askew, " and the ")));
}

/// "the wheel is stuck"
std::string in_words(DriveEnd end) {
  switch (end) {
    case DriveEnd::time_is_up:
      return "time is up";
    case DriveEnd::arrived:
      return "the wheel arrives";
    case DriveEnd::rolled_back:
      return "the wheel has rolled back";
    case DriveEnd::bed_ends:
      return "the bed ends";
    case DriveEnd::stuck:
    case DriveEnd::buried:
      break;
  }
  return fmt::format("the wheel is {}", word_of(end));
}

/// "50.49 ± 0.80", or the value alone where it has no error.
std::string with_error(double value, const std::optional<double>& std_error) {
  return std_error && *std_error > 0.0 ? number(Estimate{value, *std_error}) : fmt::format("{:.4g}", value);
}

std::string in_words(const MovedDrive::Side& side) {
  if (!side.record) return "the soil can't hold the wheel at its start";
  return fmt::format("{} after {} s and {} m", in_words(side.record->end), number(side.record->end_time),
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
                                      unit_behind(drive.unit), in_words(*side)));
    }
  return sentences;
}

/// A row for each uncertain value: what a standard deviation of it does to the drive.
Table errors_table(const DriveErrors& errors) {
  Table table{"What a standard deviation of each value does",
              {"", "as declared", "a standard deviation lower", "higher"},
              {true, false, true, true}};
  for (const MovedDrive& drive : errors.moved) {
    const auto cell = [&](const MovedDrive::Side& side) -> std::string {
      if (!drive.was_moved(side)) return "lies on its bound";
      if (!side.record) return in_words(side);
      return fmt::format("{}, {:.3g} m, {:.3g} s", word_of(side.record->end), side.record->samples.back().travelled,
                         side.record->end_time);
    };
    table.add({title_of(drive, errors), number(drive.of, drive.per_si) + unit_behind(drive.unit), cell(drive.lower),
               cell(drive.higher)});
  }
  return table;
}

Json side_json(const MovedDrive& drive, const MovedDrive::Side& side) {
  if (!drive.was_moved(side)) return nullptr;
  Json json = {{"value", side.value}};
  json["end"] = side.record ? Json(std::string(word_of(side.record->end))) : Json(nullptr);
  json["end_time"] = side.record ? Json(side.record->end_time) : Json(nullptr);
  json["travelled"] = side.record ? Json(side.record->samples.back().travelled) : Json(nullptr);
  return json;
}

Json errors_json(const DriveErrors& errors) {
  Json rows = Json::array();
  for (const MovedDrive& drive : errors.moved)
    rows.push_back({{"soil", drive.soil},
                    {"parameter", drive.parameter},
                    {"value", drive.of.value},
                    {"std_error", drive.of.std_error},
                    {"lower", side_json(drive, drive.lower)},
                    {"higher", side_json(drive, drive.higher)}});
  return rows;
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
    Series series;
    series.label = line.label.empty() ? "" : panel + ": " + line.label;
    if (!line.label.empty()) series.color = named % available, series.dash = named / available, ++named;
    for (const DriveSample& sample : part.record.samples) {
      series.x.push_back(sample.time);
      series.y.push_back(line.get(sample));
    }
    plot.series.push_back(std::move(series));
  }
  return plot;
}

const DriveColumns<DriveSample>& sample_columns() {
  using S = DriveSample;
  static const DriveColumns<S> all =
      drive_columns<S>({{"contact_slip", [](const S& s) { return s.contact_slip; }}},
                       {
                           {"compaction_J", [](const S& s) { return s.energy.compaction; }},
                           {"shear_J", [](const S& s) { return s.energy.shear; }},
                           {"added_forces_J", [](const S& s) { return s.energy.added; }},
                           {"damping_J", [](const S& s) { return s.energy.damping; }},
                           {"unaccounted_J", [](const S& s) { return s.energy.unaccounted(); }},
                       });
  return all;
}

}  // namespace

AnalyticDrive run_drive(const Case& question, int samples, const bekker_wong::DriveProgress& progress, int threads) {
  if (!question.drive) throw InputError("case '" + question.name + "' has no section 'drive'");
  const Drive& drive = *question.drive;
  AnalyticDrive part{
      question, bekker_wong::drive_wheel(question.scenario, drive, samples, {}, progress), steepest_of(question), {}};
  const auto pulse = [&] {
    if (progress) progress(part.record.end_time, drive.duration);
  };
  part.errors = drive_errors(question, part.record, {threads, pulse});
  return part;
}

std::vector<std::string> in_words(const AnalyticDrive& part) {
  const bekker_wong::DriveRecord& record = part.record;
  const DriveSample& end = record.samples.back();
  std::vector<std::string> sentences;
  const DriveErrors& errors = part.errors;
  // A time that is given and a place that is reached have no error.
  sentences.push_back(fmt::format(
      "{} after {} s and {} m, on a slope of {:.3g} deg.", capital(in_words(record.end)),
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

Table energy_table(const EnergyLedger& e, WorkTable where) {
  constexpr double by_sinking = 0.01;
  const bool page = where == WorkTable::on_page,
             motor_alone = e.motor >= 0.0 && -e.height <= by_sinking * e.motor;  // the wheel's sinking gives a little
  const double gravity = motor_alone ? 0.0 : std::max(0.0, -e.height), given = std::max(0.0, e.motor) + gravity;
  const std::string of = motor_alone ? "the motor's work" : "the work put in";
  Table table{page ? "Of " + of + " in all" : "", {page ? "" : "of " + of, "J", "%"}, {true}};
  const auto add = [&](const char* name, double joules) {
    table.add({name, number(joules), given != 0.0 ? number(100 * joules / given) : "-"});
  };
  add("shears the soil", e.shear), add("presses the soil", e.compaction), add("added forces of effects", e.added);
  if (motor_alone || e.height >= 0.0) add("lifts the load", e.height);
  add("pulls the drawbar", e.drawbar), add("is in motion", e.kinetic);
  if (e.motor < 0.0) add("is taken by the motor, which brakes", -e.motor);
  add("damps the heave", e.damping), add("unaccounted for", e.unaccounted());
  if (!motor_alone && e.motor > 0.0) add("put in: motor's work", e.motor);
  if (!motor_alone && gravity > 0.0) add("put in: gravity's work", gravity);
  table.add({page && motor_alone ? "motor's work" : "in all", number(given), "100"});
  return table;
}

Table samples_table(const bekker_wong::DriveRecord& record, std::size_t rows) {
  Table table{"",
              {"time [s]", "travelled [m]", "slope [deg]", "speed [cm/s]", "rim [cm/s]", "slip [%]", "sinkage [mm]",
               "torque [N m]", "soil force [N]"}};
  for (const DriveSample& s : picked_samples(record.samples, rows))
    table.add({number(s.time), number(s.travelled), number(s.longitudinal_incline / degree), number(100 * s.speed),
               number(100 * s.rim_speed), slip_text(s), number(1000 * s.sinkage), number(s.torque), number(s.forward)});
  return table;
}

Sheet drive_sheet(const AnalyticDrive& part) {
  Sheet sheet{part.question.name};
  int named = 0;
  const auto add = [&](const std::string& title, const std::vector<Line>& lines) {
    sheet.plots.push_back(plot_of(part, title, lines, named));
  };
  add("Speed [cm/s]", {{"travel", [](const DriveSample& s) { return 100 * s.speed; }},
                       {"rim", [](const DriveSample& s) { return 100 * s.rim_speed; }}});
  add("Slip [%]", {{"by the speeds of the instant", [](const DriveSample& s) { return 100 * slip_of(s); }},
                   {"seen by the soil in contact", [](const DriveSample& s) { return 100 * s.contact_slip; }}});
  add("Sinkage [mm]", {{"", [](const DriveSample& s) { return 1000 * s.sinkage; }}});
  add("Torque [N m]", {{"", [](const DriveSample& s) { return s.torque; }}});
  const double load = part.question.drive->load;
  add("Along travel [N]",
      {{"force of the soil", [](const DriveSample& s) { return s.forward; }},
       {"slope's share of the load", [load](const DriveSample& s) { return load * std::sin(s.longitudinal_incline); }},
       {"drawbar load", [](const DriveSample& s) { return s.drawbar; }}});
  add("Energy [J]", {{"motor's work", [](const DriveSample& s) { return s.energy.motor; }},
                     {"shears the soil", [](const DriveSample& s) { return s.energy.shear; }},
                     {"presses the soil", [](const DriveSample& s) { return s.energy.compaction; }},
                     {"lifts the load", [](const DriveSample& s) { return s.energy.height; }},
                     {"pulls the drawbar", [](const DriveSample& s) { return s.energy.drawbar; }}});
  return sheet;
}

Json to_json(const AnalyticDrive& part) {
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
  document["energy"] = {{"motor", end.energy.motor},
                        {"kinetic", end.energy.kinetic},
                        {"height", end.energy.height},
                        {"drawbar", end.energy.drawbar},
                        {"compaction", end.energy.compaction},
                        {"shear", end.energy.shear},
                        {"added_forces", end.energy.added},
                        {"damping", end.energy.damping},
                        {"unaccounted", end.energy.unaccounted()}};
  document["samples"] = columns_json(sample_columns(), record.samples);
  return document;
}

std::string drive_csv(const AnalyticDrive& part) {
  std::string text = columns_csv(sample_columns()) + "\n";
  for (const DriveSample& sample : part.record.samples) text += columns_csv(sample_columns(), sample) + "\n";
  return text;
}

std::string drive_page(const AnalyticDrive& part, const PageAbout& about) {
  const DriveSample& end = part.record.samples.back();
  Page page(about.title, part.question.description);
  page.sentences(in_words(part));
  page.doubts(about.doubts);
  page.section("Against time");
  page.figure(drive_sheet(part),
              "The soil in contact has seen the slip of the last quarter turn or so: it lags behind the speeds.");
  if (!part.errors.moved.empty()) {
    page.section("How sure");
    page.table(errors_table(part.errors));
  }
  page.section("Where the work went");
  page.table(energy_table(end.energy, WorkTable::on_page));
  if (!part.record.happenings.empty()) {
    page.section("On the way");
    Table events{"", {"time [s]", "travelled [m]", "what happened"}, {false, false, true}};
    for (const DriveHappening& h : part.record.happenings)
      events.add({number(h.time), number(h.travelled), std::string(word_of(h.what))});
    page.table(events);
  }
  page.section("Made by");
  page.code(about.command);
  std::vector<std::string> versions;
  for (const auto& [name, version] : about.versions) versions.push_back(name + " " + version);
  page.list(versions);
  return page.html();
}

}  // namespace soilbin::compare
