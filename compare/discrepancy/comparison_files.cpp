#include <fmt/core.h>

#include "compare/discrepancy/causes.hpp"
#include "compare/discrepancy/comparison_page.hpp"
#include "compare/discrepancy/comparison_sheets.hpp"
#include "compare/discrepancy/summary.hpp"
#include "compare/doubts/doubts.hpp"
#include "compare/doubts/grain_resolution.hpp"
#include "compare/loop/answer_words.hpp"
#include "compare/measured/csv.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/report/plot.hpp"
#include "compare/sweep/result_json.hpp"
#include "compare/sweep/varying.hpp"
#include "scenario/atomic_file.hpp"
#include "scenario/mapping_writer.hpp"

namespace soilbin::compare {
namespace {

Json side_json(const Side& side, const Case& question) {
  const std::vector<OperatingCondition>& conditions = question.study.conditions;
  Json json = {{"label", side.label}, {"kind", std::string(word_of(side.kind))}, {"points", Json::array()}};
  for (std::size_t i = 0; i < side.points.size(); ++i) {
    const SidePoint& point = side.points[i];
    Json one = to_json(Answer{conditions[i], point.result, point.error});
    one["runs"] = point.runs;
    for (std::size_t c = 0; c < channel_views.size(); ++c)
      one["scatter"][std::string(channel_views[c].name)] = finite(point.scatter[c]);
    one["doubts"] = point.doubts;
    if (side.kind == SideKind::grains && point.result)
      one["resolution_error"] =
          to_json(resolution_error(question.scenario, conditions[i], point.result->sinkage.value));
    json["points"].push_back(std::move(one));
  }
  return json;
}

Json difference_json(const Comparison& comparison, const Difference& d) {
  return {{"side", comparison.sides[d.side].label},
          {"reference", comparison.sides[d.reference].label},
          {"channel", channel_views[d.channel].name},
          {"condition", d.condition},
          {"value", estimate_json(d.value)},
          {"reference_value", estimate_json(d.reference_value)},
          {"scatter", finite(d.scatter)},
          {"difference", finite(d.difference)},
          {"std_error", finite(d.std_error)},
          {"freedom", finite(d.freedom)},
          {"share_of_load", finite(d.share)},
          {"sigma", finite(d.sigma)},
          {"finding", word(d.finding)}};
}

Json tally_json(const Comparison& comparison, const Tally& t) {
  return {{"side", comparison.sides[t.side].label},
          {"reference", comparison.sides[t.reference].label},
          {"channel", channel_views[t.channel].name},
          {"values", t.values},
          {"differ", t.differ},
          {"within_scatter", t.in_scatter},
          {"within_errors", t.in_errors},
          {"not_judged", t.unknown},
          {"bias", finite(t.bias)},
          {"rms", finite(t.rms)},
          {"rms_share", finite(t.rms_share)},
          {"expected_rms", finite(t.expected_rms)},
          {"worst_row", t.worst}};
}

/// What is doubtful in the two points of a row.
std::string remarks_of(const Comparison& comparison, const Difference& d) {
  std::string text;
  const OperatingCondition& at = comparison.question.study.conditions[d.condition];
  for (const std::size_t s : {d.side, d.reference}) {
    const Side& side = comparison.sides[s];
    const SidePoint& point = side.points[d.condition];
    std::vector<std::string> remarks = point.doubts;
    if (side.kind == SideKind::analytic && s < comparison.choices.size())
      if (std::string one = remark_on(comparison.question.scenario, comparison.choices[s], {at, point.result, ""});
          !one.empty())
        remarks.push_back(std::move(one));
    for (const std::string& remark : remarks)
      text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", side.label, remark);
  }
  return text;
}

}  // namespace

Json comparison_json(const Comparison& comparison, const ComparisonAbout& about) {
  const Study& study = comparison.question.study;
  Json json = {{"format", "soilbin-compare/1"}, {"study", study.name}, {"summary", Json::array()}};
  for (const Clause& clause : summary(comparison, about.loop ? &*about.loop : nullptr))
    json["summary"].push_back(
        {{"about", clause.about}, {"text", clause.text}, {"rows", clause.rows}, {"evidence", clause.evidence}});
  json["sides"] = json["rows"] = json["tallies"] = json["joint_tests"] = Json::array();
  for (const Side& side : comparison.sides) json["sides"].push_back(side_json(side, comparison.question));
  for (const Difference& d : comparison.differences) json["rows"].push_back(difference_json(comparison, d));
  for (const Tally& t : comparison.tallies) json["tallies"].push_back(tally_json(comparison, t));
  for (const JointTest& test : comparison.joint)
    json["joint_tests"].push_back({{"side", comparison.sides[test.side].label},
                                   {"reference", comparison.sides[test.reference].label},
                                   {"values", test.values},
                                   {"chi2", finite(test.chi2)},
                                   {"freedom", finite(test.freedom)},
                                   {"chi2_soil_exact", finite(test.chi2_soil_exact)},
                                   {"p_value", finite(test.p_value)},
                                   {"soil", test.soil}});
  if (about.loop) json["loop"] = to_json(*about.loop);
  for (const auto& [name, value] : about.facts) json["facts"][name] = value;
  for (const auto& [name, value] : about.page.versions) json["versions"][name] = value;
  json["command"] = about.page.command;
  tell_doubts(json, about.page.doubts);
  return json;
}

std::string differences_csv(const Comparison& comparison) {
  std::string text =
      "side,reference,channel,unit,condition,value,value_se,reference_value,reference_se,scatter,difference,std_error,"
      "freedom,share_of_load,sigma,finding,remark\n";
  const auto cell = [](double value) { return std::isfinite(value) ? fmt::format("{}", value) : std::string(); };
  for (const Difference& d : comparison.differences)
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n",
                        csv_cell(comparison.sides[d.side].label), csv_cell(comparison.sides[d.reference].label),
                        channel_views[d.channel].name, channel_views[d.channel].si_unit,
                        csv_cell(in_words(comparison.question.study.conditions[d.condition])), cell(d.value.value),
                        cell(d.value.std_error), cell(d.reference_value.value), cell(d.reference_value.std_error),
                        cell(d.scatter), cell(d.difference), cell(d.std_error), cell(d.freedom), cell(d.share),
                        cell(d.sigma), word(d.finding), csv_cell(remarks_of(comparison, d)));
  return text;
}

namespace {

namespace fs = std::filesystem;

/// A cell or sentence that can't be taken for markup.
std::string plain(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '|' || c == '<' || c == '*' || c == '_' || c == '\\' || c == '`') out += '\\';
    out += c == '\n' ? ' ' : c;
  }
  return out;
}

std::string table_text(const Table& table) {
  std::string text = table.caption.empty() ? "" : plain(table.caption) + ".\n\n", rule = "|";
  for (std::size_t c = 0; c < table.header.size(); ++c) rule += table.is_text(c) ? ":--|" : "--:|";
  for (const std::vector<std::string>& line : lines_of(table)) {
    text += "|";
    for (const std::string& cell : line) text += " " + plain(cell) + " |";
    text += "\n" + rule + (rule.empty() ? "" : "\n");
    rule.clear();
  }
  return text + "\n";
}

/// Grows report.md, and writes each figure and its data beside it.
class Markdown {
 public:
  explicit Markdown(fs::path folder) : folder_(std::move(folder)) {}

  void text(const std::string& paragraph) { body_ += paragraph + "\n\n"; }
  void table(const Table& table) { body_ += table_text(table); }
  void figure(const std::string& name, const Sheet& sheet) {
    if (sheet.plots.empty()) return;
    picture(name, svg(sheet), sheet.title.empty() ? name : sheet.title);
    write_file_atomically(folder_ / (name + ".csv"), sheet_csv(sheet));
    write_file_atomically(folder_ / (name + ".json"), json_text(to_json(sheet)));
    body_ += fmt::format("Data: [CSV]({0}.csv), [JSON]({0}.json).\n\n", name);
  }
  void picture(const std::string& name, const std::string& drawing, const std::string& title) {
    write_file_atomically(folder_ / (name + ".svg"), drawing);
    body_ += fmt::format("![{}]({}.svg)\n\n", plain(title), name);
  }
  void write() const { write_file_atomically(folder_ / "report.md", body_); }

 private:
  fs::path folder_;
  std::string body_;
};

void add_differences(Markdown& md, const Comparison& comparison) {
  md.text("## Where they differ");
  md.table(tally_table(comparison));
  if (!comparison.joint.empty()) md.table(joint_table(comparison));
  for (std::size_t k = 0; k < comparison.tallies.size(); ++k) {
    const HeatMap map = heat_map_of(comparison, comparison.tallies[k]);
    md.picture(fmt::format("heat-map-{}", k + 1), heat_map_svg(map), map.title + ", " + map.subtitle);
  }
  for (const Tally& tally : comparison.tallies) md.table(rows_table(comparison, tally));
  md.text("All rows: [CSV](differences.csv), [JSON](comparison.json).");
}

void add_causes(Markdown& md, const Comparison& comparison) {
  md.text("## Why");
  const std::size_t condition = telling_condition(comparison);
  const auto [bars, side_colors] = budget_bars(comparison, condition);
  if (!bars.groups.empty()) {
    md.text(fmt::format("At {}:", in_words(comparison.question.study.conditions[condition])));
    md.picture("budget", bars_svg(bars, side_colors), bars.title);
    md.table(budget_table(comparison, condition));
  }
  md.figure("stresses", stress_sheet(comparison, condition));
  for (std::size_t c = 0; c < comparison.curves.labels.size(); ++c)
    md.figure(fmt::format("contact-{}", c + 1), contact_sheet(comparison, c));
  if (const Table table = sinkage_table(comparison); !table.rows.empty()) md.table(table);
}

}  // namespace

void write_markdown(const fs::path& folder, const Comparison& comparison, const ComparisonAbout& about) {
  make_folder(folder);
  Markdown md(folder);
  md.text("# " + plain(about.page.title));
  for (const Clause& clause : summary(comparison, about.loop ? &*about.loop : nullptr))
    md.text(fmt::format("- {}{}", clause.about.empty() ? "" : "**" + plain(clause.about) + ".** ", plain(clause.text)));
  if (!about.page.doubts.empty()) md.text("## What is doubtful");
  for (const std::string& doubt : about.page.doubts) md.text("- " + plain(doubt));
  md.text("## Curves");
  md.figure("overview", overview_sheet(comparison));
  for (std::size_t c = 0; c < comparison.curves.labels.size(); ++c)
    md.figure(fmt::format("curve-{}", c + 1), curve_sheet(comparison, c));
  add_differences(md, comparison);
  add_causes(md, comparison);
  if (about.loop) {
    md.text("## What the analytic model lacks");
    md.text(plain(verdict_sentence(*about.loop)));
    if (about.loop->validation.overall.cells > 0) md.table(error_table(*about.loop));
    if (about.loop->has_candidates()) md.table(candidates_table(*about.loop));
  }
  md.text("## Every point");
  for (const Side& side : comparison.sides) md.table(points_table(comparison, side));
  md.text("## How to repeat this");
  md.text("    " + about.page.command);
  md.text("The resolved case is [case.yaml](case.yaml).");
  Table facts{"", {"part", "version or value"}, {true, true}};
  for (const auto* list : {&about.page.versions, &about.facts})
    for (const auto& [name, value] : *list) facts.add({name, value});
  md.table(facts);
  md.write();
  write_file_atomically(folder / "differences.csv", differences_csv(comparison));
  write_file_atomically(folder / "comparison.json", json_text(comparison_json(comparison, about)));
  write_file_atomically(folder / "case.yaml", about.resolved_case);
}

}  // namespace soilbin::compare
