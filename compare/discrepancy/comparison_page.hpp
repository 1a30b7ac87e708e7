// A comparison as one page that a browser opens offline, as Markdown with drawings, and as data.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "compare/discrepancy/summary.hpp"
#include "compare/replay/replay.hpp"
#include "compare/report/page.hpp"

namespace soilbin::compare {

/// What a comparison's page tells beside the comparison.
struct ComparisonAbout {
  PageAbout page;                                          ///< title, command, versions
  std::vector<std::pair<std::string, std::string>> facts;  ///< seeds, hashes of inputs, grain runs
  std::string resolved_case;                               ///< as YAML
  std::optional<LoopAnswer> loop;
  std::vector<std::string> mistaken_columns;  ///< of the measurements that the loop took (DoubtsBeforeFit::columns)
  std::optional<ReplayFile> replay;
  bool decimal_comma = false;  ///< in the CSVs beside report.md (measured/csv.hpp)
};

/// What the loop makes of the best reference that there is, measurements before grains; nothing where all sides are
/// analytic. Throws NoSolution where the loop has no answer.
void ask_loop(const Comparison& comparison, const LoopOptions& options, ComparisonAbout& about);

/// Summary first, each clause with its rows; curves, heat maps, causes, the loop, the replay, all rows, provenance.
std::string comparison_page(const Comparison& comparison, const ComparisonAbout& about);

/// soilbin-compare/1: sides, rows, tallies, joint tests, summary, the loop; SI.
nlohmann::ordered_json comparison_json(const Comparison& comparison, const ComparisonAbout& about);

/// Every row as CSV.
std::string differences_csv(const Comparison& comparison);

/// report.md with its drawings as SVG, each figure's data as CSV and JSON beside it, differences.csv, comparison.json,
/// case.yaml. Makes the folder. Throws std::runtime_error where a file can't be written.
void write_markdown(const std::filesystem::path& folder, const Comparison& comparison, const ComparisonAbout& about);

}  // namespace soilbin::compare
