#include "compare/drives/drive.hpp"

#include <fmt/core.h>

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
#include "scenario/errors.hpp"
#include "scenario/estimate.hpp"
#include "scenario/unit.hpp"

namespace soilbin::compare {
namespace {

using bekker_wong::DriveSample;
using bekker_wong::EnergyLedger;

double slip_of(const DriveSample& s) { return s.slip.value_or(not_a_number); }

std::optional<double> steepest_of(const Case& question) {
  const Drive& drive = *question.drive;
  const bekker_wong::RollingWheel wheel(question.scenario.tire,
                                        bekker_wong::values_of(*question.scenario.soil.semi_empirical),
                                        bekker_wong::make_effects(drive.effects), question.scenario.bin);
  OperatingCondition at;
  at.load = drive.load;
  at.pass = drive.pass;
  at.speed = drive.controller.rim_speed.value_or(at.speed);
  try {
    return bekker_wong::steepest_slope(wheel, at);
  } catch (const NoSolution&) {
    return {};
  }
}

struct Line {
  std::string label;
  std::function<double(const DriveSample&)> get;
};

/// A label tells its panel ("speed: rim"), since the sheet's panels share one legend: in it each has a colour, or
/// colour and dash, of its own. `named`: how many there are so far.
Plot plot_of(const DrivePart& part, const std::string& title, const std::vector<Line>& lines, int& named) {
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

DrivePart run_drive(const Case& question, int samples, const bekker_wong::DriveProgress& progress) {
  if (!question.drive) throw InputError("case '" + question.name + "' has no section 'drive'");
  return {question, bekker_wong::drive_wheel(question.scenario, *question.drive, samples, {}, progress),
          steepest_of(question)};
}

std::vector<std::string> in_words(const DrivePart& part) {
  const bekker_wong::DriveRecord& record = part.record;
  const DriveSample& end = record.samples.back();
  std::vector<std::string> sentences;
  sentences.push_back(fmt::format("{} after {:.4g} s and {:.4g} m, on a slope of {:.3g} deg.",
                                  record.end == DriveEnd::time_is_up    ? "Time is up"
                                  : record.end == DriveEnd::arrived     ? "The wheel arrives"
                                  : record.end == DriveEnd::stuck       ? "The wheel is stuck"
                                  : record.end == DriveEnd::rolled_back ? "The wheel has rolled back"
                                                                        : "The wheel is buried",
                                  record.end_time, end.travelled, end.longitudinal_incline / degree));
  if (end.slip && record.end != DriveEnd::stuck)
    sentences.push_back(fmt::format("Its slip is then {:.3g} %, its sinkage {:.3g} mm, its torque {:.3g} N m.",
                                    100 * *end.slip, 1000 * end.sinkage, end.torque));
  if (part.steepest)
    sentences.push_back(fmt::format("Steadily it climbs {:.3g} deg of {} at most.", *part.steepest / degree,
                                    in_words(part.question.scenario.soil)));
  return sentences;
}

std::vector<std::pair<std::string, double>> energy_rows(const EnergyLedger& e) {
  return {{"shears the soil", e.shear},   {"presses the soil", e.compaction},  {"added forces of effects", e.added},
          {"lifts the load", e.height},   {"pulls the drawbar", e.drawbar},    {"is in motion", e.kinetic},
          {"damps the heave", e.damping}, {"unaccounted for", e.unaccounted()}};
}

Sheet drive_sheet(const DrivePart& part) {
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

Json to_json(const DrivePart& part) {
  const bekker_wong::DriveRecord& record = part.record;
  const DriveSample& end = record.samples.back();
  Json document = {{"format", "soilbin-drive/1"},
                   {"case", part.question.name},
                   {"tire", part.question.scenario.tire.name},
                   {"soil", part.question.scenario.soil.name},
                   {"end", std::string(word_of(record.end))},
                   {"end_time", record.end_time},
                   {"travelled", end.travelled},
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

std::string drive_csv(const DrivePart& part) {
  std::string text = columns_csv(sample_columns()) + "\n";
  for (const DriveSample& sample : part.record.samples) text += columns_csv(sample_columns(), sample) + "\n";
  return text;
}

std::string drive_page(const DrivePart& part, const PageAbout& about) {
  const DriveSample& end = part.record.samples.back();
  Page page(about.title, part.question.description);
  page.sentences(in_words(part));
  page.doubts(about.doubts);
  page.section("Against time");
  page.figure(drive_sheet(part),
              "The soil in contact has seen the slip of the last quarter turn or so: it lags behind the speeds.");
  page.section("Where the motor's work went");
  Table energy{"Of the motor's work in all", {"", "J", "%"}, {true}};
  for (const auto& [name, joules] : energy_rows(end.energy))
    energy.add({name, number(joules), end.energy.motor != 0.0 ? number(100 * joules / end.energy.motor) : "-"});
  energy.add({"motor's work", number(end.energy.motor), "100"});
  page.table(energy);
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
