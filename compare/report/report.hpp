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

/// Who tells a part. What is drawn, folded or chosen from is never told on a terminal.
enum class Told : unsigned {
  on_terminals = 1,
  on_pages = 2,
  in_documents = 4,  ///< Markdown
  in_text = on_terminals | in_documents,
  on_screens = on_terminals | on_pages,
  to_look_at = on_pages | in_documents,
  everywhere = on_terminals | on_pages | in_documents,
};
constexpr bool holds(Told all, Told one) { return (static_cast<unsigned>(all) & static_cast<unsigned>(one)) != 0; }

struct ReportPart;
/// Parts that are made when a writer tells them: what a page alone tells costs a terminal nothing.
using MakeParts = std::function<std::vector<ReportPart>()>;

/// What a report says, each sentence perhaps behind the name of what it is about and before its evidence.
struct Sentences {
  std::vector<BackedSentence> all;

  Sentences() = default;
  explicit Sentences(std::vector<BackedSentence> backed) : all(std::move(backed)) {}
  explicit Sentences(const std::vector<std::string>& bare) {
    for (const std::string& text : bare) all.push_back({"", text});
  }
  explicit Sentences(const std::vector<std::pair<std::string, std::string>>& named) {
    for (const auto& [about, text] : named) all.push_back({about, text});
  }
};
/// What an answer opens with: on a terminal a paragraph each, with its details.
struct Headline {
  std::vector<BackedSentence> all;
};
/// Running text; on a terminal a line each.
struct Prose {
  std::vector<std::string> paragraphs;
};
struct Items {
  std::vector<std::string> all;
};
/// Names and their values, a line each.
struct NamedValues {
  std::vector<std::pair<std::string, std::string>> all;
};
/// Lines as they are, to be copied.
struct Code {
  std::string text;
};
/// A few numbers in large print.
struct KeyFigures {
  std::vector<KeyFigure> all;
};
struct Figure {
  std::function<Sheet()> sheet;
  std::string caption;
  std::string name{};  ///< of its files beside Markdown; "": it is numbered

  Figure(std::function<Sheet()> make, std::string below, std::string file = "")
      : sheet(std::move(make)), caption(std::move(below)), name(std::move(file)) {}
  Figure(Sheet made, std::string below, std::string file = "")
      : Figure([made = std::move(made)] { return made; }, std::move(below), std::move(file)) {}
};
/// Drawings of their own, <svg> elements, side by side.
struct Drawings {
  std::vector<std::string> svgs;
  std::string caption;
  std::string name{};  ///< of their files beside Markdown; "": they are numbered
  bool are_heat_maps = false;
};
/// A part that a click opens.
struct Fold {
  std::string title;
  MakeParts parts;
  std::string anchor{};
};
/// Parts of which a reader looks at one at a time; `first` is shown at the start.
struct Choices {
  std::string what;  ///< "Curve"
  std::vector<std::pair<std::string, MakeParts>> all;
  std::size_t first = 0;
  bool all_in_documents = true;  ///< else Markdown tells the first alone
};
/// Links to other pages, with their drawings.
struct Cards {
  std::vector<PageCard> all;
};
/// A replay to look at in 3D: Page::replay.
struct ReplayView {
  std::string title, bytes, caption;
};
/// HTML that the caller answers for; no other writer tells it.
struct Html {
  std::string text;
};
/// Where the doubts stand that the command has found; without it behind the first sentences.
struct WarningsHere {};

using ReportContent = std::variant<Sentences, Headline, Prose, Items, NamedValues, Table, Code, KeyFigures, Figure,
                                   Drawings, Fold, Choices, Cards, ReplayView, Html, WarningsHere>;

struct ReportPart {
  ReportContent content;
  Told told = Told::everywhere;
  std::string section{};  ///< a heading before it on pages; "": none
  std::string anchor{};   ///< of the heading
  enum class Heading { section, subsection, place } heading = Heading::section;  ///< a place is in the contents alone
};

struct Report {
  std::string title, subtitle;  ///< of a page
  std::string heading{};        ///< a terminal's first lines: what was asked
  std::vector<ReportPart> parts{};
  std::vector<std::string> notes{};  ///< how it was made: a terminal's last lines, a page's last list
  std::vector<std::pair<std::string, std::string>> made_of{};  ///< for pages: seeds, inputs, names and ids
  std::string resolved_case{};                                 ///< as YAML
  /// Made when asked for, while the answer is there; empty: it has none.
  std::function<nlohmann::ordered_json()> data{};  ///< in SI
  std::function<std::string()> csv{};
  std::function<Sheet()> sheet{};                     ///< its one drawing (drawn_once)
  std::string data_name = "data", csv_name = "data";  ///< of .json and .csv beside its Markdown
  std::string no_answer{};                            ///< why it has none: the last line on standard error; else ""

  void add(ReportContent content, Told told = Told::everywhere) { parts.push_back({std::move(content), told}); }
  /// Below a heading, which the contents of a page list.
  void add(std::string section, ReportContent content, Told told = Told::everywhere, std::string anchor = "",
           ReportPart::Heading below = ReportPart::Heading::section) {
    parts.push_back({std::move(content), told, std::move(section), std::move(anchor), below});
  }
};

/// Calls `draw` when it is first asked for: a report's drawing is saved by itself and stands on its page.
std::function<Sheet()> drawn_once(std::function<Sheet()> draw);

/// The heading, the parts and the notes, with blank lines around tables.
std::string text_of(const Report& report);

/// Every part, then how to repeat it: the command, what it was made of, the resolved case.
std::string page_of(const Report& report, const PageAbout& about);

/// report.md in a folder, which is made; beside it each figure as SVG and its data as CSV and JSON, the answer's own
/// data and CSV, and the resolved case (case.yaml). What is folded stays away: the files hold it. Throws
/// std::runtime_error for what can't be written.
void write_markdown(const std::filesystem::path& folder, const Report& report, const PageAbout& about,
                    bool decimal_comma = false);

}  // namespace soilbin::compare
