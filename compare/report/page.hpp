// One self-contained HTML page: inline CSS and SVG, light and dark, from a phone to a wide screen,
// nothing loaded. Its scripts are inline too; without them everything but the replay is still there.
//
//   Page page("Title", "one line below it");
//   page.section("Straight driving");
//   page.figure(sheet, "What to see in it.");
//   page.raw("<p>What was asked.</p>");
//   write_file_atomically("page.html", page.html());
//
// A report (report.hpp) is told on one by page_of.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "compare/report/javascript.hpp"
#include "compare/report/plot.hpp"

namespace soilbin::compare {

/// What a page says about itself.
struct PageAbout {
  std::string command;  ///< that made the page
  std::vector<std::pair<std::string, std::string>> versions;
  std::vector<std::string> doubts{};  ///< in what the page says (compare/doubts/doubts.hpp)
};

struct KeyFigure {
  std::string value, meaning;
};

/// A sentence, what it is about (or ""), and where on the page its evidence stands: (anchor, text).
struct BackedSentence {
  std::string about, text;
  std::vector<std::pair<std::string, std::string>> evidence{};
  std::string detail{};  ///< below it, in smaller print
};

/// A link to another of our pages as a person sees it: a small drawing, the title, a line on what it answers; all taken
/// from the page itself.
struct PageCard {
  std::string href;     ///< from the page that links
  std::string title;    ///< of the linked page
  std::string line;     ///< its description: the first sentences that it says
  std::string drawing;  ///< its first <svg class="plot">; "" where it has none
};

/// Reads a page that Page::html made. `from` is the file that links to it. Throws InputError where there is no such
/// file or it is no such page.
PageCard page_card(const std::filesystem::path& page, const std::filesystem::path& from);

/// A page that grows from top to bottom. Its figures are charts to zoom and to read by mouse and keys, each with
/// buttons that save it (SVG, PNG) and its data (copy, CSV, JSON); without scripts they are drawings. Every text is
/// escaped; none is taken as HTML, but for `raw`.
class Page {
 public:
  Page(std::string title, std::string subtitle);

  /// A heading with an anchor; the page's table of contents lists it.
  void section(const std::string& title, const std::string& anchor = "");
  /// A place that the table of contents lists, without a heading of its own.
  void place(const std::string& title, const std::string& anchor);
  /// The sheet's panels side by side as the width allows, its legend above them, a caption below.
  void figure(const Sheet& sheet, const std::string& caption);
  /// A replay to look at in 3D, the bytes of its file; without scripts its title and caption alone.
  void replay(const std::string& title, const std::string& bytes, const std::string& caption);
  /// What makes its figures interactive, as find_libraries() found it.
  const Libraries& libraries() const { return libraries_; }
  /// A script of the caller's, after the page's own.
  void script(const std::string& text) { extra_scripts_ += text; }
  /// What the page says first, for who links to it: the first of several.
  void describe(const std::string& text);
  /// HTML that the caller answers for.
  void raw(const std::string& html) { body_ += html; }

  std::string html() const;

 private:
  std::string scripts() const;

  std::string title_, subtitle_, body_, extra_scripts_;
  std::string description_;                                    ///< what the page says first, for who links to it
  std::vector<std::pair<std::string, std::string>> sections_;  ///< anchor, title
  std::vector<Sheet> sheets_;
  Libraries libraries_ = find_libraries();
  bool has_replay_ = false;
};

}  // namespace soilbin::compare
