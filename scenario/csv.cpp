#include "scenario/csv.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <regex>
#include <set>
#include <string_view>
#include <utility>

#include "scenario/quantity.hpp"

namespace soilbin {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t'; }

/// ',', or ';' where the first line that isn't blank holds more of these, both outside quotes.
char separator_of(std::string_view text) {
  std::size_t commas = 0, semicolons = 0;
  bool quoted = false;
  for (std::size_t i = std::min(text.find_first_not_of("\r\n"), text.size()); i < text.size(); ++i) {
    if (text[i] == '"') quoted = !quoted;
    if (quoted) continue;
    if (text[i] == '\n' || text[i] == '\r') break;
    commas += text[i] == ',', semicolons += text[i] == ';';
  }
  return semicolons > commas ? ';' : ',';
}

/// "-4,4e3" as "-4.4e3" where that is a number.
void take_decimal_comma(std::string& text) {
  const std::size_t comma = text.find(',');
  if (comma == text.npos) return;
  std::string point = text;
  point[comma] = '.';
  if (read_number(point)) text = std::move(point);
}

/// Reads rows one after the other.
class CsvReader {
 public:
  explicit CsvReader(const SourceText& source)
      : source_(source), text_(source.text), separator_(separator_of(source.text)) {}

  bool at_end() const { return at_ >= text_.size(); }

  /// The next row that is not blank; false at the end.
  bool next(CsvRow& row, std::size_t most_cells) {
    do {
      if (at_end()) return false;
      row = {};
      row.line = line_;
      read_row(row, most_cells);
    } while (row.cells.size() == 1 && row.cells.front().text.empty());
    return true;
  }

 private:
  void read_row(CsvRow& row, std::size_t most_cells) {
    while (true) {
      if (row.cells.size() >= most_cells)
        source_.refuse(at_, fmt::format("more cells in a row than the {} expected", most_cells),
                       separator_ == ',' ? "commas part the cells, so a decimal point is '.': 4.4, not 4,4"
                                         : "semicolons part the cells, as in the first line");
      row.cells.push_back(read_cell());
      if (at_end()) return;
      if (text_[at_] == separator_) {
        ++at_;
        continue;
      }
      end_line();
      return;
    }
  }

  CsvCell read_cell() {
    while (!at_end() && is_blank(text_[at_])) ++at_;
    CsvCell cell{"", at_};
    if (!at_end() && text_[at_] == '"') {
      read_quoted(cell);
    } else {
      const std::size_t begin = at_;
      while (!at_end() && !ends_cell(text_[at_])) ++at_;
      cell.text = text_.substr(begin, at_ - begin);
      while (!cell.text.empty() && is_blank(cell.text.back())) cell.text.pop_back();
      if (separator_ == ';') take_decimal_comma(cell.text);
    }
    return cell;
  }

  void read_quoted(CsvCell& cell) {
    cell.quoted = true;
    ++at_;
    while (true) {
      if (at_end()) source_.refuse(cell.offset, "a quote is opened here and never closed");
      const char c = text_[at_++];
      if (c == '\n') ++line_;
      if (c != '"') {
        cell.text += c;
      } else if (!at_end() && text_[at_] == '"') {
        cell.text += text_[at_++];
      } else {
        break;
      }
    }
    while (!at_end() && is_blank(text_[at_])) ++at_;
    if (!at_end() && !ends_cell(text_[at_])) source_.refuse(at_, "text behind a closing quote");
  }

  bool ends_cell(char c) const { return c == separator_ || c == '\n' || c == '\r'; }

  void end_line() {
    if (text_[at_] == '\r') ++at_;
    if (!at_end() && text_[at_] == '\n') ++at_;
    ++line_;
  }

  const SourceText& source_;
  std::string_view text_;
  char separator_;
  std::size_t at_ = 0;
  int line_ = 1;
};

void check_header(const CsvRow& header, const SourceText& source) {
  std::set<std::string_view> seen;
  for (const CsvCell& cell : header.cells) {
    if (cell.text.empty())
      source.refuse(cell.offset, "a column without a name",
                    "name it, or take it out of the file; a spreadsheet writes its empty columns too");
    for (const auto& [mark, name] : {std::pair{';', "semicolons"}, {'\t', "tabs"}})
      if (!cell.quoted && cell.text.find(mark) != std::string::npos)
        source.refuse(cell.offset, fmt::format("'{}' is no column's name", clipped(cell.text)),
                      fmt::format("columns are parted by commas or, all of them, by semicolons, not by {}", name));
    if (!seen.insert(cell.text).second)
      source.refuse(cell.offset, fmt::format("column '{}' appears twice", clipped(cell.text)));
  }
}

}  // namespace

CsvRow read_csv_rows(const SourceText& source, std::size_t most_rows, const std::string& too_long,
                     const std::function<void(const CsvRow& header)>& begin,
                     const std::function<void(CsvRow&& row)>& take) {
  CsvReader reader(source);
  CsvRow header, row;
  if (!reader.next(header, most_csv_columns)) source.refuse(0, "the file is empty: a header line is expected");
  check_header(header, source);
  begin(header);
  const std::size_t columns = header.cells.size();
  std::size_t rows = 0;
  while (reader.next(row, columns)) {
    if (row.cells.size() != columns)
      source.refuse(row.cells.front().offset,
                    fmt::format("a row of {} cells under a header of {}", row.cells.size(), columns));
    if (rows >= most_rows)
      source.refuse(row.cells.front().offset, fmt::format("more than {} rows", most_rows), too_long);
    if (std::ranges::all_of(row.cells, [](const CsvCell& cell) { return cell.text.empty(); })) continue;
    ++rows;
    take(std::move(row));
  }
  return header;
}

CsvTable parse_csv(const SourceText& source, std::size_t most_rows) {
  CsvTable table;
  const std::string too_long = fmt::format(
      "this is a log. A campaign wants one row a run, the means of its steady part: soilbin runs '{0}' makes them; of "
      "plates a part will do, such as each tenth row: awk 'NR == 1 || NR % 10 == 0' '{0}' > fewer.csv",
      source.file);
  table.header = read_csv_rows(
      source, most_rows, too_long, [](const CsvRow&) {}, [&](CsvRow&& row) { table.rows.push_back(std::move(row)); });
  return table;
}

namespace {

/// Whether a text is a day that a spreadsheet wrote: "03. Apr", "3-Apr", "Apr 03", "3/4/2026", "03.04.26".
bool looks_like_a_date(const std::string& text) {
  static const std::regex with_a_month(
      R"(([0-9]{1,4}[-/. ]+)?(jan|feb|mar|mär|apr|ma[iy]|jun|jul|aug|sep|o[ck]t|nov|de[cz])[a-z]*[-/. ]*[0-9]{0,4})",
      std::regex::icase);
  static const std::regex of_numbers(R"([0-9]{1,4}([-/.])[0-9]{1,2}\1([0-9]{2}|[0-9]{4})?)");
  return text.size() < 20 && (std::regex_match(text, with_a_month) || std::regex_match(text, of_numbers));
}

/// What to write in place of a number with commas: "1,400" may be 1400 or 1.4.
std::string without_commas(const std::string& text) {
  static const std::regex in_thousands("-?[0-9]{1,3}(,[0-9]{3})+(\\.[0-9]*)?"), one_thousand("-?[0-9]{1,3},[0-9]{3}");
  constexpr std::size_t longest = 40;  // no number is longer, and a match recurses by the length
  if (text.size() > longest) return "a decimal point is '.'";
  std::string whole = text, point = text;
  std::erase(whole, ',');
  std::ranges::replace(point, ',', '.');
  const bool thousands = std::regex_match(text, in_thousands);
  if (std::regex_match(text, one_thousand))
    return fmt::format("this may be {} or {}: write it without the comma", whole, write_number(*read_number(point)));
  if (thousands) return fmt::format("write {}: thousands are not separated", whole);
  return read_number(point) ? fmt::format("write {}: a decimal point is '.'", point) : "a decimal point is '.'";
}

}  // namespace

double number_in(const CsvCell& cell, const std::string& column, const std::string& unit, const SourceText& source) {
  if (const auto value = read_number(cell.text)) return *value;
  const std::string first = cell.text.substr(0, cell.text.find(' '));
  std::string hint = "where nothing was measured leave the cell empty; take out a second line of headings";
  if (cell.text.starts_with('#'))
    hint = "the spreadsheet could not compute this cell: mend its formula, or leave the cell empty";
  else if (cell.text.find(',') != std::string::npos)
    hint = without_commas(cell.text);
  else if (looks_like_a_date(cell.text))
    hint =
        "the spreadsheet took a number such as 3.4 for a date: set the column's format to Number, and type it once "
        "more";
  else if (first != cell.text && read_number(first))
    hint =
        fmt::format("write {}: the unit of the whole column ({}) stands in its name or in campaign.yaml, not in a cell",
                    first, unit == "-" ? "none" : unit);
  else if (cell.text.find_first_of("0123456789") != std::string::npos)
    hint = "a cell holds digits and a decimal point alone, such as 12.5";
  source.refuse(cell.offset,
                fmt::format("column '{}': expected a finite number, not '{}'", clipped(column), clipped(cell.text)),
                hint);
}

namespace {

/// A text as a cell between these separators.
std::string quoted_where_needed(const std::string& text, char separator) {
  const bool edge_blank = !text.empty() && (is_blank(text.front()) || is_blank(text.back()));
  if (!edge_blank && text.find_first_of(std::string("\"\r\n") + separator) == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

}  // namespace

std::string csv_cell(const std::string& text) {
  // A spreadsheet takes what begins like this for a formula, and some formulas start programs.
  if (!text.empty() && std::string_view("=+-@\t\r").find(text.front()) != std::string_view::npos && !read_number(text))
    return csv_cell("'" + text);
  return quoted_where_needed(text, ',');
}

std::string with_decimal_commas(const std::string& csv) {
  const SourceText source{"", csv};
  CsvReader reader(source);
  std::string text = "\xEF\xBB\xBF";
  CsvRow row;
  while (reader.next(row, most_csv_columns)) {
    for (std::size_t i = 0; i < row.cells.size(); ++i) {
      const CsvCell& cell = row.cells[i];
      if (i > 0) text += ';';
      std::string written = cell.text;
      if (!cell.quoted && read_number(written)) std::ranges::replace(written, '.', ',');
      std::string as_read = written;
      take_decimal_comma(as_read);
      const bool only_text = cell.quoted && as_read != written;  // a label such as "4,4"
      text += only_text ? '"' + written + '"' : quoted_where_needed(written, ';');
    }
    text += '\n';
  }
  return text;
}

}  // namespace soilbin
