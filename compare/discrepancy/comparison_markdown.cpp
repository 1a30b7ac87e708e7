// A comparison as Markdown with its figures and their data beside it, for a repository, a notebook or, by pandoc, a
// document: one table, a condition a row; the files beside it hold the rest.
#include <fmt/core.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "compare/discrepancy/causes.hpp"
#include "compare/discrepancy/comparison_page.hpp"
#include "compare/discrepancy/comparison_sheets.hpp"
#include "compare/discrepancy/comparison_tables.hpp"
#include "compare/loop/answer_words.hpp"
#include "compare/measured/csv.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/sweep/model_names.hpp"
#include "compare/sweep/varying.hpp"
#include "scenario/atomic_file.hpp"

namespace soilbin::compare {
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
  Markdown(fs::path folder, bool decimal_comma) : folder_(std::move(folder)), decimal_comma_(decimal_comma) {}

  void text(const std::string& paragraph) { body_ += paragraph + "\n\n"; }
  void table(const Table& table) { body_ += table_text(table); }
  void figure(const std::string& name, const Sheet& sheet) {
    if (sheet.plots.empty()) return;
    picture(name, svg(sheet), sheet.title.empty() ? name : sheet.title);
    csv(name, sheet_csv(sheet));
    write_file_atomically(folder_ / (name + ".json"), json_text(to_json(sheet)));
    body_ += fmt::format("Data: [CSV]({0}.csv), [JSON]({0}.json).\n\n", name);
  }
  void csv(const std::string& name, const std::string& text) const {
    write_file_atomically(folder_ / (name + ".csv"), decimal_comma_ ? with_decimal_commas(text) : text);
  }
  void picture(const std::string& name, const std::string& drawing, const std::string& title) {
    write_file_atomically(folder_ / (name + ".svg"), drawing);
    body_ += fmt::format("![{}]({}.svg)\n\n", plain(title), name);
  }
  void write() const { write_file_atomically(folder_ / "report.md", body_); }

 private:
  fs::path folder_;
  bool decimal_comma_;
  std::string body_;
};

void add_differences(Markdown& md, const Comparison& comparison) {
  md.text("## Where they differ");
  for (std::size_t k = 0; k < comparison.tallies.size(); ++k) {
    const HeatMap map = heat_map_of(comparison, comparison.tallies[k]);
    md.picture(fmt::format("heat-map-{}", k + 1), heat_map_svg(map), map.title + ", " + map.subtitle);
  }
  md.text("All rows: [CSV](differences.csv). All points: [JSON](comparison.json).");
}

void add_causes(Markdown& md, const Comparison& comparison) {
  md.text("## Why");
  const std::size_t condition = condition_of_largest_difference(comparison);
  const auto [bars, side_colors] = budget_bars(comparison, condition);
  if (!bars.groups.empty()) {
    md.text(fmt::format("At {}:", in_words(comparison.question.study.conditions[condition])));
    md.picture("budget", bars_svg(bars, side_colors), bars.title);
  }
  md.figure("stresses", stress_sheet(comparison, condition));
  for (std::size_t c = 0; c < comparison.curves.labels.size(); ++c)
    md.figure(fmt::format("contact-{}", c + 1), contact_sheet(comparison, c));
}

}  // namespace

void write_markdown(const fs::path& folder, const Comparison& answered, const ComparisonAbout& about) {
  make_folder(folder);
  Comparison comparison = answered;
  const std::vector<std::string> labels = label_sides_in_words(comparison);
  Markdown md(folder, about.decimal_comma);
  md.text("# " + plain(about.page.title));
  for (const Clause& clause : summary(comparison, about.loop ? &*about.loop : nullptr))
    md.text(fmt::format("- {}{}", clause.about.empty() ? "" : "**" + plain(clause.about) + ".** ", plain(clause.text)));
  if (const Table matrix = matrix_table(comparison); !matrix.rows.empty()) md.table(matrix);
  if (!about.page.doubts.empty()) md.text("## Warnings");
  for (const std::string& doubt : about.page.doubts) md.text("- " + plain(doubt));
  md.text("## Curves");
  md.figure("overview", overview_sheet(comparison));
  for (std::size_t c = 0; c < comparison.curves.labels.size(); ++c)
    md.figure(fmt::format("curve-{}", c + 1), curve_sheet(comparison, c));
  add_differences(md, comparison);
  add_causes(md, comparison);
  if (about.loop) {
    md.text("## What the analytic model lacks");
    for (const Clause& clause : missing_clauses(*about.loop, about.mistaken_columns))
      md.text(fmt::format("- **{}.** {}", plain(clause.about), plain(clause.text)));
  }
  md.text("## How to repeat this");
  md.text("    " + about.page.command);
  md.text("The resolved case is [case.yaml](case.yaml).");
  const std::vector<std::pair<std::string, std::string>> ids = names_and_ids(labels);
  for (const auto* list : {&ids, &about.page.versions, &about.facts})
    for (const auto& [name, value] : *list) md.text(fmt::format("- {}: {}", plain(name), plain(value)));
  md.write();
  md.csv("differences", differences_csv(answered));
  write_file_atomically(folder / "comparison.json", json_text(comparison_json(answered, about)));
  write_file_atomically(folder / "case.yaml", about.resolved_case);
}

}  // namespace soilbin::compare
