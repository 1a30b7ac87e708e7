#include "compare/report/text_table.hpp"

#include <algorithm>
#include <cctype>
#include <numeric>

namespace soilbin::compare {
namespace {

/// Characters of a UTF-8 text.
std::size_t characters_in(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
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

}  // namespace

std::string TextTable::text() const {
  std::vector<std::size_t> widths(rows_.front().size(), 0);
  std::vector<bool> right(widths.size(), true);
  const auto is_title = [&](const std::vector<std::string>& row) { return row.size() < rows_.front().size(); };
  for (std::size_t r = 0; r < rows_.size(); ++r)
    for (std::size_t c = 0; c < rows_[r].size() && !is_title(rows_[r]); ++c) {
      widths[c] = std::max(widths[c], characters_in(rows_[r][c]));
      if (r > 0 && !looks_like_number(rows_[r][c])) right[c] = false;
    }
  const auto has_note = [](const std::string& cell) { return cell.find(" (") != std::string::npos; };
  std::vector<std::size_t> least(widths.size(), 0);  // figures stay in one line, words may be folded
  for (std::size_t r = 0; r < rows_.size(); ++r)
    for (std::size_t c = 0; c < rows_[r].size() && !is_title(rows_[r]); ++c)
      least[c] = std::max(least[c], r > 0 && right[c] && !has_note(rows_[r][c]) ? characters_in(rows_[r][c])
                                                                                : longest_word(rows_[r][c]));
  narrow_columns(widths, least);
  std::string text;
  for (const std::vector<std::string>& row : rows_) {
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

std::string as_text(const HtmlTable& table) {
  TextTable text(table.header);
  for (const auto& row : table.rows) text.add(row);
  return table.caption.empty() ? text.text() : table.caption + "\n" + text.text();
}

}  // namespace soilbin::compare
