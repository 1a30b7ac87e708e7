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
#include "compare/report/json_fields.hpp"
#include "compare/report/markdown.hpp"
#include "compare/sweep/model_names.hpp"
#include "compare/sweep/varying.hpp"

namespace soilbin::compare {
namespace {

namespace fs = std::filesystem;

void add_differences(MarkdownFolder& md, const Comparison& comparison) {
  md.text("## Where they differ");
  for (std::size_t k = 0; k < comparison.tallies.size(); ++k) {
    const HeatMap map = heat_map_of(comparison, comparison.tallies[k]);
    md.picture(fmt::format("heat-map-{}", k + 1), heat_map_svg(map), map.title + ", " + map.subtitle);
  }
  md.text("All rows: [CSV](differences.csv). All points: [JSON](comparison.json).");
}

void add_causes(MarkdownFolder& md, const Comparison& comparison) {
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
  Comparison comparison = answered;
  const std::vector<std::string> labels = label_sides_in_words(comparison);
  MarkdownFolder md(folder, about.decimal_comma);
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
  md.file("comparison.json", json_text(comparison_json(answered, about)));
  md.file("case.yaml", about.resolved_case);
}

}  // namespace soilbin::compare
