// Markdown that grows from top to bottom in a folder, with its figures and their data beside it: for a repository, a
// notebook or, by pandoc, a document.
//
//   MarkdownFolder md("results");
//   md.text("# Results");
//   md.figure("overview", sheet);
//   md.write();
#pragma once

#include <filesystem>
#include <string>

#include "compare/report/plot.hpp"
#include "compare/report/table.hpp"

namespace soilbin::compare {

/// A cell or a sentence that can't be taken for markup.
std::string plain(const std::string& text);

class MarkdownFolder {
 public:
  /// Makes the folder. `decimal_comma`: of the CSVs.
  explicit MarkdownFolder(std::filesystem::path folder, bool decimal_comma = false);

  /// A paragraph, as it is.
  void text(const std::string& paragraph) { body_ += paragraph + "\n\n"; }
  void table(const Table& table);
  /// A drawing NAME.svg, NAME.csv and NAME.json with its numbers, and links to them; nothing for a sheet without plots.
  void figure(const std::string& name, const Sheet& sheet);
  void picture(const std::string& name, const std::string& drawing, const std::string& title);
  /// A file beside it that nothing links to.
  void csv(const std::string& name, const std::string& text) const;
  void file(const std::string& name, const std::string& text) const;
  /// Writes report.md.
  void write() const;

 private:
  std::filesystem::path folder_;
  bool decimal_comma_;
  std::string body_;
};

}  // namespace soilbin::compare
