#include "compare/report/marked_table.hpp"

#include <fmt/core.h>

namespace soilbin::compare {
namespace {

constexpr const char* tone_words[] = {"", "good", "bad", "open"};  // in the order of Tone

bool to_the_left(const MarkedTable& table, std::size_t column) {
  return table.text_columns.empty() ? column == 0 : column < table.text_columns.size() && table.text_columns[column];
}

std::string marked_cell(const MarkedCell& cell, bool left) {
  constexpr std::size_t phrase = 24, long_text = 48;
  std::string classes = tone_words[static_cast<std::size_t>(cell.tone)];
  if (left) classes += classes.empty() ? "t" : " t";
  const std::size_t length = cell.text.size() + cell.note.size();
  const std::string width = length > long_text ? "wide" : left && length > phrase ? "phrase" : "";
  if (!width.empty()) classes += classes.empty() ? width : " " + width;
  std::string inside = escaped(cell.text);
  if (!cell.anchor.empty()) inside = fmt::format("<a href=\"#{}\">{}</a>", escaped(cell.anchor), inside);
  if (!cell.note.empty()) inside += fmt::format(" <small>{}</small>", escaped(cell.note));
  return fmt::format("<td{}>{}</td>", classes.empty() ? "" : " class=\"" + classes + "\"", inside);
}

}  // namespace

std::string marked_html(const MarkedTable& table) {
  std::string out = "<div class=\"scroll\"><table class=\"marked\">";
  if (!table.caption.empty()) out += "<caption>" + escaped(table.caption) + "</caption>";
  out += "<thead><tr>";
  for (std::size_t c = 0; c < table.header.size(); ++c)
    out += fmt::format("<th{}>{}</th>", to_the_left(table, c) ? " class=\"t\"" : "", escaped(table.header[c]));
  out += "</tr></thead><tbody>\n";
  for (const std::vector<MarkedCell>& row : table.rows) {
    out += "<tr>";
    for (std::size_t c = 0; c < row.size(); ++c) out += marked_cell(row[c], to_the_left(table, c));
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

HtmlTable without_marks(const MarkedTable& table) {
  HtmlTable text{table.caption, table.header, table.text_columns};
  for (const std::vector<MarkedCell>& row : table.rows) {
    std::vector<std::string>& cells = text.rows.emplace_back();
    for (const MarkedCell& cell : row)
      cells.push_back(cell.note.empty() ? cell.text : fmt::format("{} ({})", cell.text, cell.note));
  }
  return text;
}

}  // namespace soilbin::compare
