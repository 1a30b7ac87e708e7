#include "compare/measured/run_columns.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>
#include <utility>

#include "compare/measured/condition_views.hpp"
#include "scenario/mapping_writer.hpp"

namespace soilbin::compare {
namespace {

using Content = RunColumn::Content;

/// A condition; one whose default says it all needs no column.
RunColumn condition(std::string_view name) {
  const ConditionView& view = condition_view(name);
  return {.quantity = std::string(view.name),
          .canonical = std::string(view.column),
          .content = view.whole ? Content::whole_number : Content::number,
          .measure = {std::string(view.column_unit), view.range},
          .set = [&view](Run& run, double x) { view.set(run.at, x); },
          .get =
              [&view](const Run& run) {
                const double x = view.get(run.at);
                return std::isnan(x) ? std::nullopt : std::optional(x);
              }};
}

RunColumn required_condition(std::string_view name) {
  RunColumn column = condition(name);
  column.required = true;
  return column;
}

RunColumn channel(const ChannelView& view) {
  return {.quantity = std::string(view.name),
          .canonical = column_of(view),
          .measure = {view.si_unit, any_value},
          .channel = true,
          .set = [&view](Run& run, double x) { run.*view.measured = x; },
          .get = [&view](const Run& run) { return run.*view.measured; }};
}

/// What a run tells of a channel beside its mean: the scatter in time, the error of the mean.
RunColumn beside_channel(std::size_t place, const std::string& what, std::array<std::optional<double>, 4> Run::*told) {
  const ChannelView& view = channel_views.at(place);
  return {.quantity = std::string(view.name) + "_" + what,
          .canonical = column_of(view, what.c_str()),
          .measure = {view.si_unit, zero_or_more},
          .beside = column_of(view),
          .set = [place, told](Run& run, double x) { (run.*told).at(place) = x; },
          .get = [place, told](const Run& run) { return (run.*told).at(place); }};
}

std::vector<RunColumn> make_columns() {
  std::vector<RunColumn> all;
  all.push_back(condition("run"));
  all.push_back({.quantity = "setpoint", .canonical = "setpoint", .content = Content::label});
  for (const char* name : {"load", "slip"}) all.push_back(required_condition(name));
  for (const char* name : {"speed", "pass", "inflation_pressure", "position", "moisture", "longitudinal_incline",
                           "transverse_incline", "yaw"})
    all.push_back(condition(name));
  all.push_back({.quantity = "rotation",
                 .canonical = "rotation_rpm",
                 .measure = {"rpm", zero_or_more},
                 .set = [](Run& run, double x) { run.rotation = x; },
                 .get = [](const Run& run) { return run.rotation; }});
  for (const ChannelView& view : channel_views) all.push_back(channel(view));
  for (std::size_t place = 0; place < channel_views.size(); ++place)
    all.push_back(beside_channel(place, "sd", &Run::within_run_sd));
  for (std::size_t place = 0; place < channel_views.size(); ++place)
    all.push_back(beside_channel(place, "error", &Run::mean_error));
  return all;
}

/// Reads a cell that must hold a bare number, in SI.
double read_cell(const CsvCell& cell, const std::string& header, const ColumnChoice& choice, const SourceText& source) {
  const auto refuse = [&](const std::string& why, const std::string& hint = "") {
    source.refuse(cell.offset, fmt::format("column '{}': {}", clipped(header), why), hint);
  };
  number_in(cell, header, choice.unit, source);
  const Measure& measure = choice.column->measure;
  const std::string text = choice.unit == "-" ? cell.text : cell.text + " " + choice.unit;
  double value = 0.0;
  try {
    value = read_quantity(text, {measure.unit, any_value});
  } catch (const InputError& error) {
    refuse(error.what());
  }
  if (!measure.range.holds(value)) {
    const bool in_per_cent =
        choice.unit == "-" && choice.column->content == Content::number && measure.range.holds(value / 100);
    refuse(fmt::format("'{}' is out of range: must be {}", clipped(text), describe_range(measure)),
           in_per_cent ? fmt::format("if the column is in per cent, write in campaign.yaml: columns: {{{}: {{quantity: "
                                     "{}, unit: '%'}}}}",
                                     yaml_scalar(clipped(header)), choice.column->quantity)
           : value < 0.0 && choice.column->quantity == "load"
               ? "a load is never negative: is this the column of the drawbar pull?"
               : "");
  }
  constexpr double largest_whole = 1e9;
  if (choice.column->content == Content::whole_number && (std::floor(value) != value || value > largest_whole))
    refuse(fmt::format("expected a whole number, not '{}'", clipped(cell.text)));
  return value;
}

std::string cell_text(const RunColumn& column, const Run& run) {
  if (column.content == Content::label) return csv_cell(run.setpoint.value_or(""));
  const std::optional<double> value = column.get(run);
  if (!value) return "";
  if (column.measure.unit == "-") return write_number(*value);
  const std::string text = write_quantity(*value, column.measure.unit);
  if (text.ends_with(" " + column.measure.unit)) return text.substr(0, text.size() - column.measure.unit.size() - 1);
  const Unit unit = parse_unit(column.measure.unit);
  return write_number(*value * unit.denominator / unit.numerator / std::pow(10.0, unit.decimal));
}

/// Whether a column says more than its default does in every run.
bool worth_writing(const RunColumn& column, const std::vector<Run>& runs) {
  const Run plain;
  return column.required || std::any_of(runs.begin(), runs.end(), [&](const Run& run) {
           return cell_text(column, run) != cell_text(column, plain);
         });
}

}  // namespace

const std::vector<RunColumn>& run_columns() {
  static const std::vector<RunColumn> all = make_columns();
  return all;
}

namespace {

/// A heading with underscores and small letters: "drawbar_pull_[kn]" for "Drawbar pull [kN]".
std::string one_spelling(std::string header) {
  for (char& c : header)
    c = c == ' ' || c == '-' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return header;
}

}  // namespace

const RunColumn* column_begun_by(const std::string& header) {
  const RunColumn* likely = nullptr;
  const std::string begun = one_spelling(header);
  for (const RunColumn& column : run_columns())
    if (begun.starts_with(column.quantity) && (!likely || column.quantity.size() > likely->quantity.size()))
      likely = &column;
  return likely;
}

std::string unit_at_the_end(const std::string& header, const RunColumn& column) {
  const Unit expected = parse_unit(column.measure.unit);
  std::string tail = header;
  std::erase_if(tail, [](char c) { return c == ']' || c == ')'; });
  for (std::size_t cut = tail.find_first_of("_ [("); cut != std::string::npos; cut = tail.find_first_of("_ [(")) {
    tail.erase(0, cut + 1);
    if (column.measure.unit == "-") {
      if (tail == "%" || tail == "pct" || tail == "percent") return "%";
      continue;
    }
    std::string divided = tail, product = tail;
    std::replace(divided.begin(), divided.end(), '_', '/');
    if (product.ends_with("Nm")) product.insert(product.size() - 1, " ");
    for (const std::string& unit : {tail, divided, product}) try {
        if (same_dimension(parse_unit(unit).dimension, expected.dimension)) return unit;
      } catch (const InputError&) {  // the next spelling
      }
  }
  return "";
}

std::optional<ColumnChoice> column_by_its_name(const std::string& header) {
  const RunColumn* column = column_begun_by(header);
  if (!column) return std::nullopt;
  const std::string behind = header.substr(column->quantity.size());
  if (behind.empty() && column->measure.unit == "-") return ColumnChoice{column, "-"};
  if (column->content != RunColumn::Content::number) return std::nullopt;
  if (behind.empty() || std::string_view("_ [(").find(behind.front()) == std::string_view::npos) return std::nullopt;
  // "drawbar_pull_filtered_N" is another quantity: the unit is all that stands behind the name.
  std::string bare = behind;
  std::erase_if(bare, [](char c) { return std::string_view("_ [](),/").find(c) != std::string_view::npos; });
  const std::string unit = unit_at_the_end(header, *column);
  std::string of_unit = unit;
  std::erase_if(of_unit, [](char c) { return c == '/' || c == ' '; });
  const bool in_per_cent = unit == "%" && (bare == "percent" || bare == "pct");
  return unit.empty() || (bare != of_unit && !in_per_cent) ? std::nullopt : std::optional(ColumnChoice{column, unit});
}

namespace {

/// What spreadsheets call our quantities, in one spelling.
constexpr std::pair<std::string_view, std::string_view> spreadsheet_words[] = {
    {"run_no", "run"},
    {"run_nr", "run"},
    {"test", "run"},
    {"test_no", "run"},
    {"trial", "run"},
    {"no", "run"},
    {"nr", "run"},
    {"#", "run"},
    {"test_number", "run"},
    {"run_number", "run"},
    {"test_point", "setpoint"},
    {"condition", "setpoint"},
    {"label", "setpoint"},
    {"weight", "load"},
    {"wheel_load", "load"},
    {"axle_load", "load"},
    {"vertical_load", "load"},
    {"normal_load", "load"},
    {"vertical_force", "load"},
    {"fz", "load"},
    {"wheel_slip", "slip"},
    {"slip_ratio", "slip"},
    {"velocity", "speed"},
    {"forward_speed", "speed"},
    {"travel_speed", "speed"},
    {"rpm", "rotation"},
    {"rotational_speed", "rotation"},
    {"tire_pressure", "inflation_pressure"},
    {"tyre_pressure", "inflation_pressure"},
    {"inflation", "inflation_pressure"},
    {"moisture_content", "moisture"},
    {"water_content", "moisture"},
    {"slope", "longitudinal_incline"},
    {"incline", "longitudinal_incline"},
    {"cross_slope", "transverse_incline"},
    {"side_slope", "transverse_incline"},
    {"yaw_angle", "yaw"},
    {"slip_angle", "yaw"},
    {"pull", "drawbar_pull"},
    {"drawbar", "drawbar_pull"},
    {"drawbar_force", "drawbar_pull"},
    {"pull_force", "drawbar_pull"},
    {"net_traction", "drawbar_pull"},
    {"dp", "drawbar_pull"},
    {"fx", "drawbar_pull"},
    {"moment", "torque"},
    {"wheel_torque", "torque"},
    {"my", "torque"},
    {"depth", "sinkage"},
    {"side_force", "lateral_force"},
    {"fy", "lateral_force"},
};

/// Whether a heading is these words, alone or with a unit of the column behind them: "Depth mm", not "Depth of rut mm".
bool is_called(const std::string& header, std::string_view words, const RunColumn& column) {
  const std::string heading = one_spelling(header);
  if (!heading.starts_with(words)) return false;
  std::string behind = header.substr(words.size()), unit = unit_at_the_end(header, column);
  const bool another_word = !behind.empty() && std::isalnum(static_cast<unsigned char>(behind.front()));
  std::erase_if(behind, [](char c) { return std::string_view("_ [](),./-").find(c) != std::string_view::npos; });
  std::erase_if(unit, [](char c) { return c == '/' || c == ' '; });
  const bool in_other_words = behind == "percent" || behind == "pct" || (column.quantity == "load" && behind == "kg");
  return !another_word && (behind.empty() || behind == unit || in_other_words);
}

/// The column that a heading names, in our words or a spreadsheet's; nothing for none.
const RunColumn* column_in_other_words(const std::string& header) {
  for (const RunColumn& column : run_columns()) {
    if (is_called(header, column.quantity, column)) return &column;
    for (const auto& [words, quantity] : spreadsheet_words)
      if (quantity == column.quantity && is_called(header, words, column)) return &column;
  }
  return nullptr;
}

/// Whether every cell that isn't empty may be in such a column.
bool cells_fit(const CsvTable& table, std::size_t place, const RunColumn& column) {
  return column.content == Content::label || std::ranges::all_of(table.rows, [&](const CsvRow& row) {
           const std::string& text = row.cells[place].text;
           const std::optional<double> number = read_number(text);
           return text.empty() || (number && (column.content == Content::number || std::floor(*number) == *number));
         });
}

/// The unit that a heading tells of a column that it does not name in our words, or that its numbers tell.
std::string likely_unit(const CsvTable& table, std::size_t place, const RunColumn& column) {
  const std::string& header = table.header.cells[place].text;
  const std::string unit = unit_at_the_end(header, column), heading = one_spelling(header);
  if (!unit.empty() || column.content != Content::number) return unit;
  const bool in_kg = heading.ends_with("kg") || heading.ends_with("kg]") || heading.ends_with("kg)");
  if (column.quantity == "load" && in_kg) return "kgf";
  if (column.quantity == "rotation" && heading.starts_with("rpm")) return "rpm";
  if (column.measure.unit != "-") return "";
  const bool above_one = std::ranges::any_of(
      table.rows, [&](const CsvRow& row) { return std::abs(read_number(row.cells[place].text).value_or(0.0)) > 1.0; });
  return above_one ? "%" : "-";
}

}  // namespace

std::vector<LikelyColumn> likely_columns(const CsvTable& table) {
  std::vector<LikelyColumn> all;
  std::set<const RunColumn*> taken;
  for (const CsvCell& cell : table.header.cells) {
    LikelyColumn& column = all.emplace_back(LikelyColumn{cell.text});
    if (const auto named = column_by_its_name(cell.text); named && taken.insert(named->column).second)
      column.column = named->column, column.unit = named->unit;
  }
  for (std::size_t place = 0; place < all.size(); ++place) {
    const RunColumn* column = all[place].column ? nullptr : column_in_other_words(all[place].header);
    if (!column || !cells_fit(table, place, *column) || !taken.insert(column).second) continue;
    all[place].column = column, all[place].unit = likely_unit(table, place, *column);
  }
  return all;
}

std::string renaming_of(const LikelyColumn& column, const std::string& unknown) {
  if (!column.column) return fmt::format("{{quantity: QUANTITY, unit: {}}}", unknown);
  const std::string& unit = column.unit.empty() ? unknown : column.unit;
  if (column.column->content != Content::number || unit == "-")
    return fmt::format("{{quantity: {}}}", column.column->quantity);
  return fmt::format("{{quantity: {}, unit: {}}}", column.column->quantity, unit == "%" ? "'%'" : unit);
}

std::vector<Run> read_runs(const CsvTable& table, std::span<const ColumnChoice> columns, const SourceText& source) {
  std::vector<Run> runs;
  for (const CsvRow& row : table.rows) {
    Run run;
    run.csv_line = row.line;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const CsvCell& cell = row.cells[i];
      const std::string& header = table.header.cells[i].text;
      const RunColumn& column = *columns[i].column;
      if (cell.text.empty()) {
        if (column.required) source.refuse(cell.offset, fmt::format("column '{}': empty; every run needs it", header));
      } else if (column.content == Content::label) {
        run.setpoint = cell.text;
      } else {
        column.set(run, read_cell(cell, header, columns[i], source));
      }
    }
    runs.push_back(std::move(run));
  }
  return runs;
}

std::string write_runs(const std::vector<Run>& runs, const std::set<std::string_view>& to_fill_in,
                       const std::map<std::string, DataColumn>& named) {
  std::vector<RunColumn> columns;
  for (const RunColumn& column : run_columns()) {
    if (!worth_writing(column, runs) && !to_fill_in.contains(column.quantity)) continue;
    columns.push_back(column);
    if (const auto own = named.find(column.quantity); own != named.end())
      columns.back().canonical = own->second.header, columns.back().measure.unit = own->second.unit;
  }
  std::string text;
  const auto line = [&](const auto& cell_of) {
    for (std::size_t i = 0; i < columns.size(); ++i) text += (i == 0 ? "" : ",") + cell_of(columns[i]);
    text += '\n';
  };
  line([](const RunColumn& column) { return csv_cell(column.canonical); });
  for (const Run& run : runs) line([&](const RunColumn& column) { return cell_text(column, run); });
  return text;
}

}  // namespace soilbin::compare
