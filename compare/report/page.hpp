// One self-contained HTML page: inline CSS and SVG, light and dark, from a phone to a wide screen, nothing loaded.
//
//   Page page("Title", "one line below it");
//   page.summary({{"Straight driving", "Plain words first."}, {"", "A sentence without a name."}});
//   page.section("Straight driving");
//   page.paragraph("What was asked.");
//   page.figure(sheet, "What to see in it.");
//   page.table(table);
//   page.code("soilbin run paper-straight");
//   write_file_atomically("report.html", page.html());
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "compare/report/plot.hpp"

namespace soilbin::compare {

/// A table of texts; cells are escaped.
struct HtmlTable {
  std::string caption;
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;  ///< each as long as the header
  std::vector<bool> text_columns{};            ///< columns set to the left; empty: the first alone
};

/// A row of key figures.
struct KeyFigure {
  std::string value, meaning;
};

/// A page that grows from top to bottom. Every text is escaped; none is taken as HTML, but for `raw`.
class Page {
 public:
  Page(std::string title, std::string subtitle);

  /// Plain-words sentences in a box, each behind the name of what it is about (or "").
  void summary(const std::vector<std::pair<std::string, std::string>>& sentences);
  void figures_at_a_glance(const std::vector<KeyFigure>& figures);
  /// A heading with an anchor; the page's table of contents lists it.
  void section(const std::string& title);
  void subsection(const std::string& title);
  void paragraph(const std::string& text);
  void list(const std::vector<std::string>& items);
  void table(const HtmlTable& table);
  /// The sheet's panels side by side as the width allows, its legend above them, a caption below.
  void figure(const Sheet& sheet, const std::string& caption);
  void code(const std::string& text);
  /// A folded part that a click opens: what `fill` adds to the page goes into it.
  template <class Fill>
  void folded(const std::string& title, const Fill& fill) {
    open_fold(title);
    fill();
    close_fold();
  }
  /// HTML that the caller answers for.
  void raw(const std::string& html) { body_ += html; }

  std::string html() const;

 private:
  void open_fold(const std::string& title);
  void close_fold();

  std::string title_, subtitle_, body_;
  std::vector<std::string> sections_;
};

}  // namespace soilbin::compare
