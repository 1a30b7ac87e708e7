// A table as lines of text, its columns aligned, on a terminal or in a file.
//
//   TextTable table({"load [N]", "pull [N]"});
//   table.add({"80", "12.3"});
//   fmt::print("{}", table.text());
#pragma once

#include <string>
#include <vector>

#include "compare/report/page.hpp"

namespace soilbin::compare {

/// A table with aligned columns: text to the left, numbers (by their first character) to the right.
class TextTable {
 public:
  explicit TextTable(std::vector<std::string> header) : rows_{std::move(header)} {}
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  /// A line across the columns over the rows that follow.
  void add_title(std::string title) { rows_.push_back({std::move(title)}); }
  std::size_t rows() const { return rows_.size() - 1; }  ///< without the header
  std::string text() const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

/// Its caption, where it has one, over its aligned columns.
std::string as_text(const HtmlTable& table);

}  // namespace soilbin::compare
