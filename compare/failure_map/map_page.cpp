// A failure map as heat maps, an HTML page and JSON.
#include <fmt/core.h>

#include <cmath>

#include "compare/failure_map/map_report.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/report/number_text.hpp"
#include "compare/sweep/varying.hpp"

namespace soilbin::compare {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr int cells = 7;  // of a heat map, along and up

std::string in_units(const Factor& factor, double value) {
  return fmt::format("{:.3g}{}", value * per_unit(factor.unit), factor.unit == "-" ? "" : " " + factor.unit);
}

HeatCell cell_at(const MapStory& story, const VectorXd& values) {
  const std::vector<Factor>& factors = story.question.factors;
  const Estimate there = story.rows.at(story.question, values);
  const double tolerance = story.question.tolerance, size = std::abs(there.value);
  const double percent = std::round(100 * there.value);
  HeatCell cell{100 * there.value, percent == 0 ? "0" : fmt::format("{:+.0f}", percent), "", true};
  cell.counts = size - 1.645 * there.std_error > tolerance;
  for (std::size_t j = 0; j < factors.size(); ++j)
    cell.meaning += fmt::format("{}{} {}", j == 0 ? "" : ", ", factors[j].name,
                                in_units(factors[j], values[static_cast<Index>(j)]));
  cell.meaning += fmt::format(": {} % of the load, {}", number({100 * there.value, 100 * there.std_error}),
                              cell.counts                                  ? "the models part"
                              : size + 1.645 * there.std_error < tolerance ? "the models agree"
                                                                           : "the map can't tell");
  return cell;
}

std::vector<double> two_levels(const Factor& factor) {
  return factor.upper > factor.lower ? std::vector{factor.lower, factor.upper} : std::vector{factor.lower};
}

Json values_json(const std::vector<Factor>& factors, const VectorXd& values) {
  Json json = Json::object();
  for (std::size_t j = 0; j < factors.size(); ++j) json[factors[j].name] = values[static_cast<Index>(j)];
  return json;
}

Json where_known(const std::optional<Estimate>& estimate) {
  return estimate ? estimate_json(*estimate) : Json(nullptr);
}

}  // namespace

HeatMap heat_map_of(const MapStory& story, double lug_height, double slip) {
  const std::vector<Factor>& factors = story.question.factors;
  const Factor &load = factors[map_load], &angle = factors[map_angle];
  HeatMap map;
  map.title = fmt::format("{} {}, {} {}", factors[map_lug_height].name, in_units(factors[map_lug_height], lug_height),
                          factors[map_slip].name, in_units(factors[map_slip], slip));
  map.subtitle = "analytic less grains [% of the load]";
  map.x_title = heading(load.name, load.unit), map.y_title = heading(angle.name, angle.unit);
  map.limit = 300 * story.question.tolerance;
  for (int c = 0; c < cells; ++c)
    map.x.push_back(fmt::format("{:.4g}", level_value(load, c, cells) * per_unit(load.unit)));
  for (int r = cells - 1; r >= 0; --r) {
    map.y.push_back(in_units(angle, level_value(angle, r, cells)));
    std::vector<HeatCell> row;
    for (int c = 0; c < cells; ++c) {
      VectorXd values(4);
      values << level_value(load, c, cells), lug_height, level_value(angle, r, cells), slip;
      row.push_back(cell_at(story, values));
    }
    map.cells.push_back(std::move(row));
  }
  return map;
}

std::string failure_map_page(const MapStory& story, const PageAbout& about, const std::string& resolved_case) {
  Page page(about.title, fmt::format("{} on {}: where the analytic model and the grains part",
                                     story.map.scenario.tire.name, in_words(story.map.scenario.soil)));
  std::vector<std::pair<std::string, std::string>> sentences;
  for (const std::string& sentence : map_summary(story)) sentences.emplace_back("", sentence);
  page.summary(sentences);
  page.doubts(about.doubts);
  page.figures_at_a_glance(
      {{std::to_string(story.rows.rows.size()), "conditions run"},
       {fmt::format("{:.1f} %", 100 * story.rows.held_out.rms()), "cross-validated error, of the load"},
       {fmt::format("{:.0f} %", 100 * share_beyond(story)), "of the box beyond the tolerance"}});
  page.section("The map", "map");
  page.paragraph(
      "Difference of the drawbar pull, analytic less grains, in per cent of the load, as the map has it. Bold: the map "
      "is "
      "sure that the models part by more than the tolerance. Faint: they agree, or the map can't tell; each cell says "
      "which.");
  const std::vector<Factor>& factors = story.question.factors;
  std::vector<std::string> maps;
  for (const double slip :
       {factors[map_slip].lower, (factors[map_slip].lower + factors[map_slip].upper) / 2, factors[map_slip].upper})
    for (const double height : two_levels(factors[map_lug_height]))
      maps.push_back(heat_map_svg(heat_map_of(story, height, slip)));
  page.heat_maps(maps, "Loads across, angles up.");
  page.section("What it rests on", "rows");
  page.table(rows_table(story));
  page.table(coordinates_table(story));
  if (!story.checks.empty()) page.table(checks_table(story));
  page.section("How to repeat this", "repeat");
  page.code(about.command);
  HtmlTable facts{"", {"part", ""}, {}, {true, true}};
  for (const auto& [name, value] : about.versions) facts.rows.push_back({name, value});
  page.table(facts);
  page.folded("The resolved case", [&] { page.code(resolved_case); });
  return page.html();
}

nlohmann::ordered_json failure_map_json(const MapStory& story) {
  const std::vector<Factor>& factors = story.question.factors;
  Json document = {
      {"format", "soilbin-failure-map/1"},     {"incline", name_of(story.map.incline)},
      {"tolerance", story.question.tolerance}, {"summary", map_summary(story)},
      {"share_beyond", share_beyond(story)},   {"cross_validated_error", finite(story.rows.held_out.rms())}};
  Json ranges = Json::array(), rows = Json::array(), groups = Json::array(), checks = Json::array();
  for (const Factor& factor : factors)
    ranges.push_back({{"name", factor.name}, {"lower", factor.lower}, {"upper", factor.upper}});
  for (const FailureRow& row : story.rows.rows) {
    Json json = values_json(factors, row.values);
    json["difference"] = where_known(row.difference), json["beyond"] = row.beyond(story.question.tolerance);
    rows.push_back(std::move(json));
  }
  for (const Coordinates& c : story.coordinates) groups.push_back({{"name", c.name}, {"held_out", finite(c.held_out)}});
  for (const FreshCheck& check : story.checks) {
    Json json = values_json(factors, check.values);
    json["predicted"] = where_known(check.predicted), json["found"] = where_known(check.found);
    checks.push_back(std::move(json));
  }
  document["factors"] = ranges, document["rows"] = rows;
  document["coordinates"] = groups, document["checks"] = checks;
  return document;
}

}  // namespace soilbin::compare
