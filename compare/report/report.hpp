// An answer as it is told, whoever tells it: sentences, tables and figures in their order, and the data behind them.
// One function an answer makes it, report_on; one writer each gives it to terminals, pages and Markdown.
//
//   const Report report = report_on(drive);
//   fmt::print("{}", text_of(report));
//   write_file_atomically("drive.html", page_of(report, about));
//   write_markdown("drive", report, about);
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "compare/report/page.hpp"
#include "compare/report/plot.hpp"
#include "compare/report/table.hpp"

namespace soilbin::compare {

/// Who tells a part. Figures and drawings are never told on a terminal.
enum class Told { everywhere, on_terminals, on_pages };

/// What a report says first, each sentence perhaps behind the name of what it is about and before its evidence.
struct Sentences {
  std::vector<BackedSentence> all;

  Sentences() = default;
  explicit Sentences(std::vector<BackedSentence> backed) : all(std::move(backed)) {}
  explicit Sentences(const std::vector<std::string>& bare) {
    for (const std::string& text : bare) all.push_back({"", text});
  }
};
struct Figure {
  Sheet sheet;
  std::string caption;
};
/// A drawing of its own, an <svg> element.
struct Drawing {
  std::string svg, caption;
};

/// Names and their values, a line each.
struct NamedValues {
  std::vector<std::pair<std::string, std::string>> all;
};
/// Lines as they are, to be copied.
struct Code {
  std::string text;
};
using ReportContent = std::variant<Sentences, NamedValues, Table, Figure, Drawing, Code>;

struct ReportPart {
  std::string section;  ///< a heading before it on pages; "": none
  ReportContent content;
  Told told = Told::everywhere;
};

struct Report {
  std::string title, subtitle;  ///< of a page
  std::string heading{};        ///< a terminal's first line: what was asked
  std::vector<ReportPart> parts{};
  std::vector<std::string> notes{};  ///< how it was made: a terminal's last lines, a page's last list
  /// Made when asked for; empty: the answer has none.
  std::function<nlohmann::ordered_json()> data{};  ///< in SI
  std::function<std::string()> csv{};
  std::function<Sheet()> sheet{};  ///< its one drawing

  void add(ReportContent content, Told told = Told::everywhere) { parts.push_back({"", std::move(content), told}); }
  void add(std::string section, ReportContent content, Told told = Told::everywhere) {
    parts.push_back({std::move(section), std::move(content), told});
  }
};

/// The heading, the parts and the notes, with blank lines around tables. A table's caption stays on pages.
std::string text_of(const Report& report);

/// Every part, the doubts behind the first sentences, at the end the command, the notes and the versions.
std::string page_of(const Report& report, const PageAbout& about);

/// report.md in a folder, which is made; beside it each figure as SVG and its data as CSV and JSON, the answer's own
/// data (data.json) and CSV (data.csv). Throws std::runtime_error for what can't be written.
void write_markdown(const std::filesystem::path& folder, const Report& report, const PageAbout& about,
                    bool decimal_comma = false);

}  // namespace soilbin::compare
