// A table as data, and its text; a page draws it (page.hpp). Cells may carry marks: what is good or bad news, an id in
// grey behind a name, a link into the page.
//
//   Table table{"Channels", {"channel", "after"}};
//   table.add({"sinkage", {"7.0 mm", "held out", Tone::good}});
//   page.table(table);
//   fmt::print("{}", as_text(table));
#pragma once

#include <concepts>
#include <string>
#include <utility>
#include <vector>

namespace soilbin::compare {

enum class Tone { none, good, bad, open };

struct TableCell {
  std::string text;
  std::string note;  ///< small and grey behind the text: an id, a p-value; in brackets on a terminal
  Tone tone = Tone::none;
  std::string anchor;  ///< of the page: the text leads there; a folded part opens

  TableCell() = default;
  template <class Text>
  requires std::constructible_from<std::string, Text> TableCell(Text&& words, std::string beside = "",
                                                                Tone how = Tone::none, std::string to = "")
      : text(std::forward<Text>(words)), note(std::move(beside)), tone(how), anchor(std::move(to)) {}
};

struct Table {
  std::string caption;
  std::vector<std::string> header;
  std::vector<bool> text_columns{};  ///< columns set to the left; empty: the first alone
  std::vector<std::vector<TableCell>>
      rows{};            ///< each as long as the header; of one cell: a line across, in text alone
  bool marked = false;   ///< a page draws it wider, with the marks of its cells
  std::string legend{};  ///< below it: what its columns mean

  void add(std::vector<TableCell> row) { rows.push_back(std::move(row)); }
  bool is_text(std::size_t column) const {
    return text_columns.empty() ? column == 0 : column < text_columns.size() && text_columns[column];
  }
};

/// A table whose cells carry marks.
struct MarkedTable : Table {
  MarkedTable(std::string title, std::vector<std::string> names, std::vector<bool> texts = {})
      : Table{std::move(title), std::move(names), std::move(texts), {}, true} {}
};

/// The header, then the rows, as texts; notes in brackets.
std::vector<std::vector<std::string>> lines_of(const Table& table);

/// Its caption, where it has one, over aligned columns: text to the left, numbers (by their first character) to the
/// right.
std::string as_text(const Table& table);

/// The table as an element of a page; texts are escaped.
std::string html_of(const Table& table);

}  // namespace soilbin::compare
