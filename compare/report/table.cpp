#include "compare/report/table.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <numeric>

#include "compare/report/plot.hpp"

namespace soilbin::compare {
namespace {

/// Characters of a UTF-8 text.
std::size_t characters_in(const std::string& text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

bool looks_like_number(const std::string& text) {
  if (text.empty() || text == "-") return true;
  const std::size_t first = text.front() == '-' || text.front() == '+' ? 1 : 0;
  return first < text.size() && std::isdigit(static_cast<unsigned char>(text[first])) != 0;
}

constexpr std::size_t widest_line = 120;
constexpr std::size_t between_columns = 2;

/// The words of a cell, in lines of at most `wide` characters where no word is longer.
std::vector<std::string> folded_cell(const std::string& cell, std::size_t wide) {
  std::vector<std::string> lines{""};
  for (std::size_t at = 0; at <= cell.size();) {
    const std::size_t end = std::min(cell.find(' ', at), cell.size());
    const std::string word = cell.substr(at, end - at);
    if (at > 0 && characters_in(lines.back()) + 1 + characters_in(word) > wide)
      lines.push_back(word);
    else
      lines.back() += (at > 0 ? " " : "") + word;
    at = end + 1;
  }
  return lines;
}

std::size_t longest_word(const std::string& cell) {
  std::size_t longest = 0;
  for (const std::string& word : folded_cell(cell, 0)) longest = std::max(longest, characters_in(word));
  return longest;
}

/// Narrows the widest columns, a character at a time, until a line fits. Where it cannot fit all stays as it is.
void narrow_columns(std::vector<std::size_t>& widths, const std::vector<std::size_t>& least) {
  const std::size_t gaps = between_columns * (widths.size() - 1);
  const auto line_of = [&](const std::vector<std::size_t>& all) {
    return std::accumulate(all.begin(), all.end(), gaps);
  };
  if (line_of(least) > widest_line) return;
  for (std::size_t line = line_of(widths); line > widest_line; --line) {
    std::size_t widest = widths.size();
    for (std::size_t c = 0; c < widths.size(); ++c)
      if (widths[c] > least[c] && (widest == widths.size() || widths[c] > widths[widest])) widest = c;
    if (widest == widths.size()) return;
    --widths[widest];
  }
}

/// Lines of cells with their columns aligned; a line of one cell stands for itself.
std::string aligned(const std::vector<std::vector<std::string>>& table) {
  std::vector<std::size_t> widths(table.front().size(), 0);
  std::vector<bool> right(widths.size(), true);
  const auto is_title = [&](const std::vector<std::string>& row) { return row.size() < table.front().size(); };
  for (std::size_t r = 0; r < table.size(); ++r)
    for (std::size_t c = 0; c < table[r].size() && !is_title(table[r]); ++c) {
      widths[c] = std::max(widths[c], characters_in(table[r][c]));
      if (r > 0 && !looks_like_number(table[r][c])) right[c] = false;
    }
  const auto has_note = [](const std::string& cell) { return cell.find(" (") != std::string::npos; };
  std::vector<std::size_t> least(widths.size(), 0);  // figures stay in one line, words may be folded
  for (std::size_t r = 0; r < table.size(); ++r)
    for (std::size_t c = 0; c < table[r].size() && !is_title(table[r]); ++c)
      least[c] = std::max(least[c], r > 0 && right[c] && !has_note(table[r][c]) ? characters_in(table[r][c])
                                                                                : longest_word(table[r][c]));
  narrow_columns(widths, least);
  std::string text;
  for (const std::vector<std::string>& row : table) {
    if (is_title(row)) {
      text += "\n" + row.front() + "\n";
      continue;
    }
    std::vector<std::vector<std::string>> cells;
    std::size_t lines = 1;
    for (std::size_t c = 0; c < row.size(); ++c) {
      cells.push_back(characters_in(row[c]) > widths[c] ? folded_cell(row[c], widths[c]) : std::vector{row[c]});
      lines = std::max(lines, cells.back().size());
    }
    for (std::size_t l = 0; l < lines; ++l) {
      std::string line;
      for (std::size_t c = 0; c < row.size(); ++c) {
        const std::string part = l < cells[c].size() ? cells[c][l] : "", blanks(widths[c] - characters_in(part), ' ');
        line += (c == 0 ? "" : std::string(between_columns, ' ')) + (right[c] ? blanks + part : part + blanks);
      }
      text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
    }
  }
  return text;
}

constexpr const char* tone_words[] = {"", "good", "bad", "open"};  // in the order of Tone
constexpr std::size_t phrase = 24, long_text = 48;                 // characters that a cell may wrap beyond

std::string note_behind(const std::string& note) {
  return note.empty() ? "" : fmt::format(" <small>{}</small>", escaped(note));
}

std::string plain_cell(const char* tag, const TableCell& cell, bool left) {
  const bool wide = cell.text.size() > long_text || cell.note.size() > phrase;
  const std::string classes = std::string(left ? "t" : "") + (wide ? " wide" : "");
  return fmt::format("<{0}{1}>{2}{3}</{0}>", tag, classes.empty() ? "" : " class=\"" + classes + "\"",
                     escaped(cell.text), note_behind(cell.note));
}

std::string marked_cell(const TableCell& cell, bool left) {
  std::string classes = tone_words[static_cast<std::size_t>(cell.tone)];
  if (left) classes += classes.empty() ? "t" : " t";
  const std::size_t length = cell.text.size() + cell.note.size();
  const std::string width = length > long_text ? "wide" : left && length > phrase ? "phrase" : "";
  if (!width.empty()) classes += classes.empty() ? width : " " + width;
  std::string inside = escaped(cell.text);
  if (!cell.anchor.empty()) inside = fmt::format("<a href=\"#{}\">{}</a>", escaped(cell.anchor), inside);
  return fmt::format("<td{}>{}{}</td>", classes.empty() ? "" : " class=\"" + classes + "\"", inside,
                     note_behind(cell.note));
}

}  // namespace

std::vector<std::vector<std::string>> lines_of(const Table& table) {
  std::vector<std::vector<std::string>> lines = {table.header};
  for (const std::vector<TableCell>& row : table.rows) {
    std::vector<std::string>& cells = lines.emplace_back();
    for (const TableCell& cell : row)
      cells.push_back(cell.note.empty() ? cell.text : fmt::format("{} ({})", cell.text, cell.note));
  }
  return lines;
}

std::string as_text(const Table& table) {
  return (table.caption.empty() ? "" : table.caption + "\n") + aligned(lines_of(table)) +
         (table.legend.empty() ? "" : table.legend + "\n");
}

std::string html_of(const Table& table) {
  std::string out = fmt::format("<div class=\"scroll\"><table{}>", table.marked ? " class=\"marked\"" : "");
  if (!table.caption.empty()) out += "<caption>" + escaped(table.caption) + "</caption>";
  const bool named = std::ranges::any_of(table.header, [](const std::string& name) { return !name.empty(); });
  out += named ? "<thead><tr>" : "<tbody>\n";
  for (std::size_t c = 0; c < table.header.size() && named; ++c)
    out += table.marked ? fmt::format("<th{}>{}</th>", table.is_text(c) ? " class=\"t\"" : "", escaped(table.header[c]))
                        : plain_cell("th", table.header[c], table.is_text(c));
  if (named) out += "</tr></thead><tbody>\n";
  for (const std::vector<TableCell>& row : table.rows) {
    out += "<tr>";
    for (std::size_t c = 0; c < row.size(); ++c)
      out += table.marked ? marked_cell(row[c], table.is_text(c)) : plain_cell("td", row[c], table.is_text(c));
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

}  // namespace soilbin::compare
