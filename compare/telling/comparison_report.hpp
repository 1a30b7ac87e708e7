// A comparison as it is told; soilbin-compare/1.
//
//   const ComparisonAbout what{.title = "Comparison", .command = "soilbin compare ..."};
//   write_file_atomically("page.html", page_of(report_on(comparison, what), about));
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compare/discrepancy/comparison.hpp"
#include "compare/replay/replay.hpp"
#include "compare/report/report.hpp"

namespace soilbin::compare {

/// What is told beside a comparison.
struct ComparisonAbout {
  std::string title{};                                          ///< of its page
  std::string command{};                                        ///< that made it
  std::vector<std::pair<std::string, std::string>> versions{};  ///< of what made it
  std::vector<std::pair<std::string, std::string>> facts{};     ///< seeds, hashes of inputs, grain runs
  std::string resolved_case{};                                  ///< as YAML
  std::optional<LoopOfComparison> loop{};
  std::optional<ReplayFile> replay{};
};

/// The largest difference and whether it is significant; curves, causes, what the loop finds, heat maps, all rows.
/// Both outlive the report.
Report report_on(const Comparison& comparison, const ComparisonAbout& about);

/// soilbin-compare/1: sides, rows, tallies, joint tests, summary, the loop; SI.
nlohmann::ordered_json comparison_json(const Comparison& comparison, const ComparisonAbout& about);
/// Every row as CSV.
std::string differences_csv(const Comparison& comparison);

}  // namespace soilbin::compare
