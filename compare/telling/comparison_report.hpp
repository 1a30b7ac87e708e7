// A comparison as it is told; soilbin-compare/1.
//
//   const ToldComparison told(comparison, {.title = "Comparison", .command = "soilbin compare ..."});
//   write_file_atomically("page.html", page_of(report_on(told), about));
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compare/discrepancy/comparison.hpp"
#include "compare/loop/loop.hpp"
#include "compare/replay/replay.hpp"
#include "compare/report/report.hpp"

namespace soilbin::compare {

/// What the loop makes of the best reference of a comparison.
struct LoopOfComparison {
  LoopAnswer answer;
  std::vector<std::string> mistaken_columns;  ///< of the measurements that it took (of_mistaken_columns)
};
/// Measurements before grains; nothing where all sides are analytic. Throws NoSolution where the loop has no answer.
std::optional<LoopOfComparison> ask_loop(const Comparison& comparison, const LoopOptions& options);

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

/// A comparison whose sides are called as people call them, beside itself: data keeps the labels.
struct ToldComparison {
  ToldComparison(const Comparison& comparison, ComparisonAbout about);

  const Comparison& answered;  ///< outlives this
  ComparisonAbout about;
  Comparison in_words;
  std::vector<std::string> labels;  ///< that the sides had
};

/// The largest difference and whether it is significant; curves, causes, what the loop finds, heat maps, all rows.
/// `told` outlives the report.
Report report_on(const ToldComparison& told);

/// soilbin-compare/1: sides, rows, tallies, joint tests, summary, the loop; SI.
nlohmann::ordered_json comparison_json(const Comparison& comparison, const ComparisonAbout& about);
/// Every row as CSV.
std::string differences_csv(const Comparison& comparison);

}  // namespace soilbin::compare
