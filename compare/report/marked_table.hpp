// A table whose cells carry marks: what is good or bad news, an id in grey behind a name, a link into the page.
//
//   MarkedTable table{"Channels", {"channel", "after"}, {}, {{{.text = "sinkage"}, {.text = "7.0 mm", .tone =
//   Tone::good}}}}; page.raw(marked_html(table)); fmt::print("{}", as_text(without_marks(table)));
#pragma once

#include <string>
#include <vector>

#include "compare/report/page.hpp"

namespace soilbin::compare {

enum class Tone { none, good, bad, open };

struct MarkedCell {
  std::string text;
  std::string note{};  ///< small and grey behind the text: an id, a p-value
  Tone tone = Tone::none;
  std::string anchor{};  ///< of this page: the text leads there; a folded part opens
};

struct MarkedTable {
  std::string caption;
  std::vector<std::string> header;
  std::vector<bool> text_columns{};             ///< columns set to the left; empty: the first alone
  std::vector<std::vector<MarkedCell>> rows{};  ///< each as long as the header
};

/// The table as an element of a page.
std::string marked_html(const MarkedTable& table);

/// The same for a terminal: notes in brackets, no colours.
HtmlTable without_marks(const MarkedTable& table);

}  // namespace soilbin::compare
