#include "compare/report/markdown.hpp"

#include <fmt/core.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "compare/report/json_fields.hpp"
#include "scenario/atomic_file.hpp"
#include "scenario/csv.hpp"

namespace soilbin::compare {

std::string plain(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '|' || c == '<' || c == '*' || c == '_' || c == '\\' || c == '`') out += '\\';
    out += c == '\n' ? ' ' : c;
  }
  return out;
}

MarkdownFolder::MarkdownFolder(std::filesystem::path folder, bool decimal_comma)
    : folder_(std::move(folder)), decimal_comma_(decimal_comma) {
  make_folder(folder_);
}

void MarkdownFolder::table(const Table& table) {
  if (!table.caption.empty()) body_ += plain(table.caption) + ".\n\n";
  std::string rule = "|";
  for (std::size_t c = 0; c < table.header.size(); ++c) rule += table.is_text(c) ? ":--|" : "--:|";
  for (const std::vector<std::string>& line : lines_of(table)) {
    body_ += "|";
    for (const std::string& cell : line) body_ += " " + plain(cell) + " |";
    body_ += "\n" + rule + (rule.empty() ? "" : "\n");
    rule.clear();
  }
  body_ += "\n";
}

void MarkdownFolder::figure(const std::string& name, const Sheet& sheet) {
  if (sheet.plots.empty()) return;
  picture(name, svg(sheet), sheet.title.empty() ? name : sheet.title);
  csv(name, sheet_csv(sheet));
  file(name + ".json", json_text(to_json(sheet)));
  body_ += fmt::format("Data: [CSV]({0}.csv), [JSON]({0}.json).\n\n", name);
}

void MarkdownFolder::picture(const std::string& name, const std::string& drawing, const std::string& title) {
  file(name + ".svg", drawing);
  body_ += fmt::format("![{}]({}.svg)\n\n", plain(title), name);
}

void MarkdownFolder::csv(const std::string& name, const std::string& text) const {
  file(name + ".csv", decimal_comma_ ? with_decimal_commas(text) : text);
}

void MarkdownFolder::file(const std::string& name, const std::string& text) const {
  write_file_atomically(folder_ / name, text);
}

void MarkdownFolder::write() const { file("report.md", body_); }

}  // namespace soilbin::compare
