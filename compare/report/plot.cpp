#include "compare/report/plot.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "compare/report/json_fields.hpp"
#include "compare/report/number_text.hpp"
#include "compare/report/plot_panel.hpp"
#include "scenario/csv.hpp"
#include "scenario/quantity.hpp"

namespace soilbin::compare {
namespace {

constexpr const char* fonts = "system-ui, -apple-system, 'Segoe UI', 'DejaVu Sans', Helvetica, Arial, sans-serif";

/// Width of a text in the legend, near enough [px].
double text_width(const std::string& text) {
  const auto characters =
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; });
  return 6.6 * static_cast<double>(characters);
}

/// What the legend says of one label: the first series with it, and the marks of all of them.
struct Entry {
  const Series* series = nullptr;
  bool line = false;
  bool points = false;
  bool area = false;
};

std::vector<Entry> entries_of(const Sheet& sheet) {
  std::vector<Entry> entries;
  for (const Plot& plot : sheet.plots)
    for (const Series& series : plot.series) {
      if (series.label.empty()) continue;
      auto entry = std::ranges::find_if(entries, [&](const Entry& e) { return e.series->label == series.label; });
      if (entry == entries.end()) entry = entries.insert(entries.end(), Entry{&series});
      const bool area = !series.base.empty();
      entry->area = entry->area || area;
      entry->line = entry->line || (!area && series.mark != Mark::points);
      entry->points = entry->points || (!area && series.mark != Mark::line);
    }
  return entries;
}

/// An entry's line and point in 26 x 12 px, middle left at (x, y).
std::string swatch(const Sheet& sheet, const Entry& entry, double x, double y) {
  std::string out;
  const int color = color_of(sheet, *entry.series);
  if (entry.area)
    out += fmt::format(R"(<rect {} fill-opacity="0.45" x="{:.1f}" y="{:.1f}" width="26" height="10"/>)",
                       fill(sheet.palette, color), x, y - 5);
  if (entry.line)
    out += fmt::format(R"(<line {}{} stroke-width="2" x1="{:.1f}" x2="{:.1f}" y1="{:.1f}" y2="{:.1f}"/>)",
                       stroke(sheet.palette, color), dashes(entry.series->dash), x, x + 26, y, y);
  if (entry.points)
    out += fmt::format(R"(<circle {} r="3.2" cx="{:.1f}" cy="{:.1f}"/>)", fill(sheet.palette, color), x + 13, y);
  return out;
}

/// The legend in columns that fit the width; the height it needs is added to `y`.
std::string legend_rows(const Sheet& sheet, double width, double& y) {
  const std::vector<Entry> entries = entries_of(sheet);
  if (entries.empty()) return "";
  constexpr double margin = 20.0, row_height = 20.0;
  double column = 0.0;
  for (const Entry& entry : entries) column = std::max(column, 34.0 + text_width(entry.series->label) + 18.0);
  const auto columns = static_cast<std::size_t>(std::max(1.0, std::floor((width - margin) / column)));
  std::string out;
  y += 14.0;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const double x = margin + column * static_cast<double>(i % columns);
    const double line = y + row_height * static_cast<double>(i / columns);
    out += swatch(sheet, entries[i], x, line - 4);
    out += fmt::format(R"(<text class="ink" fill="#1a1d23" x="{:.1f}" y="{:.1f}">{}</text>)", x + 34, line,
                       escaped(entries[i].series->label));
  }
  y += row_height * static_cast<double>((entries.size() - 1) / columns) + 12.0;
  return out;
}

}  // namespace

Series fitted_curve(std::string label, int color, double to, const std::function<double(double)>& y) {
  Series line{.label = std::move(label), .color = color};
  for (int i = 0; i <= 100; ++i) line.x.push_back(1e3 * (to * i / 100)), line.y.push_back(y(to * i / 100));
  return line;
}

std::vector<Color> colors(Palette palette) {
  if (palette == Palette::named)
    return {{"#0b63a8", "#6cb6ff"}, {"#c2500a", "#ff9a57"}, {"#0a7f5c", "#4fd1a1"},
            {"#a3418a", "#e594cf"}, {"#8a6d00", "#e3c34b"}, {"#4a5568", "#b4bfce"}};
  return {{"#2b1a8f", "#8f7dff"}, {"#6a1fa8", "#b584f5"}, {"#a0279a", "#dc86dd"}, {"#c9407a", "#f48fae"},
          {"#e0654f", "#fba07d"}, {"#e58a1c", "#fcc15c"}, {"#b9a011", "#f2e65a"}};
}

std::vector<double> ticks(double lower, double upper, int count) {
  const double rough = (upper - lower) / std::max(count, 1);
  if (!(rough > 0.0) || !std::isfinite(rough)) return {lower};
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10 * power;
  for (const double nice : {1.0, 2.0, 5.0})
    if (nice * power >= 0.999 * rough) {
      step = nice * power;
      break;
    }
  std::vector<double> found;
  for (double k = std::ceil(lower / step - 1e-9); k * step <= upper + 1e-9 * step; ++k) found.push_back(k * step);
  return found;
}

std::string svg(const Sheet& sheet) {
  const std::size_t columns = sheet.plots.size() > 1 ? 2 : 1;
  const std::size_t rows = (sheet.plots.size() + columns - 1) / columns;
  const double width = panel_width * static_cast<double>(columns);
  double y = (sheet.title.empty() ? 8.0 : 40.0) + (sheet.note.empty() ? 0.0 : 18.0);
  std::string body;
  for (std::size_t i = 0; i < sheet.plots.size(); ++i)
    body += fmt::format(R"svg(<g transform="translate({:.0f} {:.0f})">{}</g>)svg",
                        panel_width * static_cast<double>(i % columns),
                        y + panel_height * static_cast<double>(i / columns), panel(sheet, sheet.plots[i])) +
            "\n";
  y += panel_height * static_cast<double>(rows);
  body += legend_rows(sheet, width, y);
  std::string title;
  if (!sheet.title.empty())
    title = fmt::format(R"(<text class="ink" fill="#1a1d23" font-size="15" font-weight="600" x="20" y="26">{}</text>)",
                        escaped(sheet.title));
  if (!sheet.note.empty())
    title += fmt::format(R"(<text class="quiet" fill="#5a6270" x="20" y="44">{}</text>)", escaped(sheet.note));
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "font-family=\"{2}\" font-size=\"12\">\n"
      "<rect class=\"paper\" width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n{3}\n{4}\n</svg>\n",
      width, y + 4, fonts, title, body);
}

std::string panel_svg(const Sheet& sheet, std::size_t plot) {
  const Plot& one = sheet.plots.at(plot);
  return fmt::format(
      "<svg class=\"plot\" viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"{}\" font-size=\"12\">{}</svg>",
      panel_width, panel_height, escaped(one.title + " against " + one.x.title), panel(sheet, one));
}

std::vector<LegendEntry> legend(const Sheet& sheet) {
  std::vector<LegendEntry> entries;
  for (const Entry& entry : entries_of(sheet))
    entries.push_back({entry.series->label,
                       fmt::format(R"(<svg viewBox="0 0 26 12" width="26" height="12" aria-hidden="true">{}</svg>)",
                                   swatch(sheet, entry, 0, 6))});
  return entries;
}

namespace {

/// Six digits: what a screen can show, at a third of the bytes.
double shortened(double value) { return read_number(fmt::format("{:.6g}", value)).value_or(value); }

Json numbers(const std::vector<double>& values) {
  return list_of(values, [](double value) { return finite(shortened(value)); });
}

Json axis_json(const Axis& axis) {
  return {{"title", axis.title}, {"lower", or_null(axis.lower)}, {"upper", or_null(axis.upper)}};
}

constexpr const char* mark_words[] = {"line", "points", "line_and_points"};  // in the order of Mark

}  // namespace

Json to_json(const Sheet& sheet) {
  Json json = {{"title", sheet.title}, {"plots", Json::array()}};
  for (const Plot& plot : sheet.plots) {
    Json one = {{"title", plot.title}, {"x", axis_json(plot.x)}, {"y", axis_json(plot.y)}, {"series", Json::array()}};
    one["identity_line"] = plot.identity_line;
    const std::vector<double> shifts = bar_shifts(plot);
    for (std::size_t s = 0; s < shifts.size(); ++s) {
      const Series& series = plot.series[s];
      one["series"].push_back(
          {{"label", series.label},
           {"x", numbers(series.x)},
           {"y", numbers(series.y)},
           {"error", numbers(series.error)},
           {"base", numbers(series.base)},
           {"mark", mark_words[static_cast<std::size_t>(series.mark)]},
           {"color", fmt::format("{}{}", sheet.palette == Palette::named ? 'c' : 'q', color_of(sheet, series))},
           {"dash", series.dash}});
      if (shifts[s] != 0.0) one["series"].back()["shift"] = shifts[s];  // [px]
      if (!series.band) one["series"].back()["band"] = false;
    }
    json["plots"].push_back(std::move(one));
  }
  return json;
}

std::string sheet_csv(const Sheet& sheet) {
  std::string text = "plot,series,x,y,error\n";
  for (const Plot& plot : sheet.plots)
    for (const Series& series : plot.series)
      for (std::size_t i = 0; i < series.x.size(); ++i)
        text += fmt::format("{},{},{},{},{}\n", csv_cell(plot.title), csv_cell(series.label), csv_number(series.x[i]),
                            csv_number(series.base.empty() ? series.y[i] : series.y[i] - series.base[i]),
                            i < series.error.size() ? csv_number(series.error[i]) : "");
  return text;
}

}  // namespace soilbin::compare
