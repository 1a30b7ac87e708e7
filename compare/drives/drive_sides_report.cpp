// The same drive by two models as a sheet, JSON, CSV and a page.
#include <fmt/core.h>

#include <functional>

#include "compare/drives/drive_columns.hpp"
#include "compare/drives/drive_sides.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/report/number_text.hpp"
#include "compare/sweep/model_names.hpp"
#include "scenario/estimate.hpp"

namespace soilbin::compare {
namespace {

const DriveColumns<DriveSideSample>& side_columns() {
  static const DriveColumns<DriveSideSample> all =
      drive_columns<DriveSideSample>({}, {{"soil_J", [](const DriveSideSample& s) { return s.soil; }}});
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
  Series line;
  line.label = "grains, steady";
  line.x = {steady.from, steady.to};
  line.y.assign(2, panel.per_si * mean.value);
  line.error.assign(2, panel.per_si * mean.std_error);
  line.color = color, line.dash = 1;
  return line;
}

Plot plot_of(const DriveSides& drive, const Panel& panel) {
  Plot plot{panel.title, {"time [s]"}};
  for (std::size_t i = 0; i < drive.sides.size(); ++i) {
    const DriveSide& side = drive.sides[i];
    Series series;
    series.label = side.packing ? "grains" : model_in_words(side.label);  // packings are of one colour
    series.color =
        side.packing ? static_cast<int>(drive.sides.front().kind == SideKind::analytic) : static_cast<int>(i);
    for (const DriveSideSample& sample : side.samples) {
      series.x.push_back(sample.time);
      series.y.push_back(panel.per_si * panel.get(sample));
    }
    plot.series.push_back(std::move(series));
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

Json side_json(const DriveSide& side) {
  const DriveSideSample& end = side.samples.back();
  Json row = {{"model", side.packing ? "dem" : side.label}};
  if (side.packing) row["packing"] = *side.packing;
  row["end"] = std::string(word_of(side.end));
  row["end_time"] = side.end_time;
  row["travelled"] = end.travelled;
  row["happenings"] = happenings_json(side.happenings);
  row["steady"] = side.steady ? steady_json(*side.steady) : Json(nullptr);
  if (!side.not_steady.empty()) row["not_steady"] = side.not_steady;
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
  Json ends = Json::array();
  for (const DriveEnd end : one.ends) ends.push_back(std::string(word_of(end)));
  return {{"ends", std::move(ends)},
          {"end_time", estimate_json(one.end_time)},
          {"travelled", estimate_json(one.travelled)},
          {"steady", one.steady ? steady_json(*one.steady) : Json(nullptr)}};
}

Table happenings_table(const DriveSides& drive) {
  Table table{"", {"model", "time [s]", "travelled [m]", "what happened"}, {true, false, false, true}};
  for (const DriveSide& side : drive.sides) {
    for (const DriveHappening& h : side.happenings)
      table.add({side.label, number(h.time), number(h.travelled), std::string(word_of(h.what))});
    table.add(
        {side.label, number(side.end_time), number(side.samples.back().travelled), std::string(word_of(side.end))});
  }
  return table;
}

}  // namespace

Table differences_table(const DriveSides& drive) {
  Table table{fmt::format("± is one standard error: of the analytic wheel the soil's uncertainty, of grains {}",
                          drive.over_packings ? "the scatter of bed samples" : "block averages of one run"),
              {"steady state", "bekker_wong", "dem", "difference", ""},
              {true, false, false, false, true}};
  for (const DriveDifference& row : drive.differences)
    table.add({fmt::format("{} [{}]", row.name, row.unit), number(row.analytic, row.per_si),
               number(row.grains, row.per_si), number({row.difference, row.std_error}, row.per_si),
               std::string(words(row.finding))});
  return table;
}

Table work_table(const DriveSides& drive, WorkTable where) {
  const bool page = where == WorkTable::on_page;
  Table table{page ? "Of the motor's work in all" : "", {page ? "J" : "of the motor's work [J]"}, {true}};
  for (const DriveSide& side : drive.sides) table.header.push_back(side.label), table.text_columns.push_back(false);
  for (const DriveWorkRow& work : work_rows(drive)) {
    std::vector<TableCell> row{work.name};
    for (const std::optional<double>& joules : work.joules) row.push_back(joules ? number(*joules) : "");
    table.add(std::move(row));
  }
  std::vector<TableCell> all{page ? "motor's work" : "in all"};
  for (const DriveSide& side : drive.sides) all.push_back(number(side.samples.back().energy.motor));
  table.add(std::move(all));
  return table;
}

Table samples_table(const DriveSides& drive, std::size_t rows) {
  const std::size_t rows_of_each = std::max<std::size_t>(3, rows / std::max<std::size_t>(2, drive.sides.size()));
  Table table{"",
              {"model", "time [s]", "travelled [m]", "slope [deg]", "speed [cm/s]", "slip [%]", "sinkage [mm]",
               "torque [N m]", "soil force [N]"}};
  for (const DriveSide& side : drive.sides)
    for (const DriveSideSample& s : picked_samples(side.samples, rows_of_each))
      table.add({side.label, number(s.time), number(s.travelled), number(s.longitudinal_incline / degree),
                 number(100 * s.speed), slip_text(s), number(1000 * s.sinkage), number(s.torque), number(s.forward)});
  return table;
}

Sheet drive_sheet(const DriveSides& drive) {
  using S = DriveSideSample;
  using M = dem::SteadyDrive;
  Sheet sheet{drive.question.name};
  for (const Panel& panel : std::initializer_list<Panel>{
           {"Travelled [m]", 1, [](const S& s) { return s.travelled; }},
           {"Speed [cm/s]", 100, [](const S& s) { return s.speed; }, &M::speed},
           {"Slip [%]", 100, [](const S& s) { return s.slip.value_or(not_a_number); }, &M::slip},
           {"Sinkage [mm]", 1000, [](const S& s) { return s.sinkage; }, &M::sinkage},
           {"Torque [N m]", 1, [](const S& s) { return s.torque; }, &M::torque},
           {"Force of the soil along travel [N]", 1, [](const S& s) { return s.forward; }, &M::forward},
           {"Motor's work [J]", 1, [](const S& s) { return s.energy.motor; }},
           {"Work given to the soil [J]", 1, [](const S& s) { return s.soil; }}})
    sheet.plots.push_back(plot_of(drive, panel));
  return sheet;
}

Json to_json(const DriveSides& drive) {
  Json document = {{"format", "soilbin-drive-sides/1"},
                   {"case", drive.question.name},
                   {"tire", drive.question.scenario.tire.name},
                   {"soil", drive.question.scenario.soil.name}};
  document["sides"] = Json::array();
  for (const DriveSide& side : drive.sides) document["sides"].push_back(side_json(side));
  if (drive.over_packings) document["over_packings"] = over_packings_json(*drive.over_packings);
  document["differences"] = Json::array();
  for (const DriveDifference& row : drive.differences)
    document["differences"].push_back({{"of", row.name},
                                       {"analytic", estimate_json(row.analytic)},
                                       {"grains", estimate_json(row.grains)},
                                       {"difference", row.difference},
                                       {"std_error", row.std_error},
                                       {"finding", std::string(word(row.finding))}});
  document["notes"] = drive.notes;
  return document;
}

std::string drive_csv(const DriveSides& drive) {
  std::string text = "model," + columns_csv(side_columns()) + "\n";
  for (const DriveSide& side : drive.sides)
    for (const DriveSideSample& sample : side.samples)
      text += side.label + "," + columns_csv(side_columns(), sample) + "\n";
  return text;
}

std::string drive_page(const DriveSides& answered, const PageAbout& about) {
  DriveSides drive = answered;  // with its sides called as people call them
  const std::vector<std::string> labels = call_in_words(drive.sides);
  Page page(about.title, drive.question.description);
  page.sentences(in_words(drive));
  page.doubts(about.doubts);
  page.section("Against time");
  page.figure(drive_sheet(drive),
              "Instants of the analytic wheel; of grains means since the sample before. Dashed: mean of the grains "
              "where way and motor no longer change, with its standard error.");
  if (!drive.differences.empty()) {
    page.section("Steady state");
    Table table = differences_table(drive);
    for (std::string& name : table.header) name = model_in_words(name);
    page.table(table);
  }
  if (drive.over_packings) {
    page.section("On each bed sample");
    page.table(packings_table(drive));
  }
  page.section("Where the motor's work went");
  page.table(work_table(drive, WorkTable::on_page));
  page.section("On the way");
  page.table(happenings_table(drive));
  page.section("Made by");
  page.code(about.command);
  std::vector<std::string> facts = drive.notes;
  for (const auto& [name, id] : names_and_ids(labels)) facts.push_back(name + ": " + id);
  for (const auto& [name, version] : about.versions) facts.push_back(name + " " + version);
  page.list(facts);
  return page.html();
}

}  // namespace soilbin::compare
