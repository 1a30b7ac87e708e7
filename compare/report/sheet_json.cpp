#include "compare/report/sheet_json.hpp"

#include <fmt/core.h>

#include <cmath>

#include "compare/measured/csv.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/report/plot_panel.hpp"
#include "scenario/quantity.hpp"

namespace soilbin::compare {
namespace {

/// Six digits: what a screen can show, at a third of the bytes.
double shortened(double value) { return read_number(fmt::format("{:.6g}", value)).value_or(value); }

Json numbers(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(finite(shortened(value)));
  return list;
}

Json axis_json(const Axis& axis) {
  Json json = {{"title", axis.title}};
  json["lower"] = axis.lower ? Json(*axis.lower) : Json(nullptr);
  json["upper"] = axis.upper ? Json(*axis.upper) : Json(nullptr);
  return json;
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
    }
    json["plots"].push_back(std::move(one));
  }
  return json;
}

std::string sheet_csv(const Sheet& sheet) {
  std::string text = "plot,series,x,y,error\n";
  const auto cell = [](double value) { return std::isfinite(value) ? fmt::format("{}", value) : std::string(); };
  for (const Plot& plot : sheet.plots)
    for (const Series& series : plot.series)
      for (std::size_t i = 0; i < series.x.size(); ++i)
        text += fmt::format("{},{},{},{},{}\n", csv_cell(plot.title), csv_cell(series.label), cell(series.x[i]),
                            cell(series.base.empty() ? series.y[i] : series.y[i] - series.base[i]),
                            i < series.error.size() ? cell(series.error[i]) : "");
  return text;
}

}  // namespace soilbin::compare
