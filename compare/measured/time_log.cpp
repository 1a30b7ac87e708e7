#include "compare/measured/time_log.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "scenario/csv.hpp"
#include "scenario/nearest_word.hpp"
#include "scenario/quantity.hpp"

namespace soilbin::compare {
namespace {

using Content = RunColumn::Content;

std::string in_small_letters(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

struct LogHeader {
  enum class Holds { quantity, clock, run, setpoint, wheel, nothing };
  Holds holds = Holds::nothing;
  ColumnChoice choice{};
  double per_unit = 1.0;  ///< SI in one of its unit
  std::string name{};
  std::optional<std::string> only{};  ///< the one text that rows may have
  bool parts = false;                 ///< named by --by
};

/// A text of each row as a number: equal texts get the same.
class NamedParts {
 public:
  std::size_t number_of(const std::string& text) { return numbers_.emplace(text, numbers_.size()).first->second; }
  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const auto& [name, number] : numbers_) all.push_back(name);
    return all;
  }

 private:
  std::map<std::string, std::size_t> numbers_;
};

LogHeader header_named(const std::string& name, const LogReading& how) {
  using Holds = LogHeader::Holds;
  LogHeader header;
  header.name = name;
  header.parts = name == how.by;
  for (const auto& [column, value] : how.only)
    if (column == name) header.only = value;
  const auto take = [&](const RunColumn& column, const std::string& unit) {
    header.choice = {&column, unit};
    if (column.quantity == "run") header.holds = Holds::run;
    if (column.content == Content::label) header.holds = Holds::setpoint;
    if (column.quantity == "run" || column.content == Content::label || !column.beside.empty()) return;
    header.holds = Holds::quantity;
    header.per_unit = one_in_si(unit);
  };
  for (const RunColumn& column : run_columns()) {
    const auto own = how.columns.find(column.quantity);
    if (own != how.columns.end() && own->second.header == name) take(column, own->second.unit);
    if (own == how.columns.end() && column.canonical == name) take(column, column.measure.unit);
  }
  if (header.holds != Holds::nothing || header.choice.column) return header;
  if (names_a_clock(name))
    header.holds = Holds::clock;
  else if (names_the_wheel(name))
    header.holds = Holds::wheel;
  else if (const auto choice = column_by_its_name(name))
    take(*choice->column, choice->unit);
  return header;
}

/// Takes the rows of a log one after the other.
class LogReader {
 public:
  LogReader(const SourceText& source, const LogReading& how) : source_(source), how_(how) { log_.file = source.file; }

  void begin(const CsvRow& header) {
    for (const CsvCell& cell : header.cells) headers_.push_back(header_named(cell.text, how_));
    first_ = header.cells.front().offset;
    need(header);
    for (std::size_t i = 0; i < headers_.size(); ++i)
      if (headers_[i].holds == LogHeader::Holds::quantity) {
        for (const LoggedColumn& other : log_.columns)
          if (other.column == headers_[i].choice.column)
            source_.refuse(header.cells[i].offset,
                           fmt::format("columns '{}' and '{}' both hold '{}'", clipped(other.header),
                                       clipped(headers_[i].name), other.column->quantity));
        log_.columns.push_back({headers_[i].choice.column, headers_[i].name, {}});
      }
    const std::string aside = names_of(LogHeader::Holds::nothing);
    if (!aside.empty()) log_.notes.push_back("Columns left aside: " + aside + ".");
  }

  void take(const CsvRow& row) {
    for (std::size_t i = 0; i < headers_.size(); ++i)
      if (headers_[i].only && row.cells[i].text != *headers_[i].only) return;
    std::vector<double> values;
    double time = not_a_number;
    std::optional<std::size_t> run, setpoint, by;
    std::string label;
    for (std::size_t i = 0; i < headers_.size(); ++i) {
      const CsvCell& cell = row.cells[i];
      using Holds = LogHeader::Holds;
      if (headers_[i].parts) by = by_.number_of(cell.text);
      switch (headers_[i].holds) {
        case Holds::quantity:
          values.push_back(value_in(cell, headers_[i]));
          break;
        case Holds::clock:
          time = clock_time(cell.text).value_or(not_a_number);
          break;
        case Holds::run:
          run = runs_.number_of(cell.text);
          break;
        case Holds::setpoint:
          setpoint = setpoints_.number_of(cell.text), label = cell.text;
          break;
        case Holds::wheel:
          wheels_.number_of(cell.text);
          break;
        case Holds::nothing:
          break;
      }
    }
    if (repeats(values, time, run, setpoint, by)) {
      ++repeated_;
      return;
    }
    for (std::size_t c = 0; c < values.size(); ++c) log_.columns[c].values.push_back(values[c]);
    log_.line.push_back(row.line);
    log_.clock.push_back(time);
    log_.setpoints.push_back(label);
    if (run) run_of_.push_back(*run);
    if (setpoint) setpoint_of_.push_back(*setpoint);
    if (by) part_by_.push_back(*by);
  }

  TimeLog finish() {
    if (log_.line.empty())
      throw InputError({source_.file}, how_.only.empty() ? "holds no samples" : "no row has what --only asks for");
    if (wheels_.names().size() > 1)
      source_.refuse(first_, fmt::format("samples of {} wheels: {}", wheels_.names().size(), listed(wheels_.names())),
                     fmt::format("a campaign is of one wheel: --only '{}={}', and so for each",
                                 names_of(LogHeader::Holds::wheel), wheels_.names().front()));
    if (std::ranges::all_of(log_.clock, [](double t) { return std::isnan(t); })) log_.clock.clear();
    if (setpoint_of_.empty()) log_.setpoints.clear();
    if (repeated_ > 0)
      log_.notes.push_back(fmt::format("Rows that repeat the one before them, dropped: {}.", repeated_));
    if (part_by_.empty()) {
      part_by_names(run_of_, names_of(LogHeader::Holds::run));
      part_by_names(setpoint_of_, names_of(LogHeader::Holds::setpoint));
    } else {
      log_.part = std::move(part_by_), log_.parted_by = "'" + how_.by + "'";
    }
    return std::move(log_);
  }

 private:
  std::string names_of(LogHeader::Holds what) const {
    std::vector<std::string> names;
    for (const LogHeader& header : headers_)
      if (header.holds == what && !header.parts && !header.only) names.push_back(header.name);
    return names.empty() ? "" : listed(names);
  }

  void need(const CsvRow& header) const {
    std::vector<std::string> names;
    for (const CsvCell& cell : header.cells) names.push_back(cell.text);
    const auto known = [&](const std::string& name, const char* flag) {
      if (std::ranges::find(names, name) == names.end())
        throw InputError(fmt::format("{}: {} has no column '{}'{}\n  hint: its columns are {}", flag, source_.file,
                                     clipped(name), did_you_mean(name, names), listed(names)));
    };
    if (!how_.by.empty()) known(how_.by, "--by");
    for (const auto& [column, value] : how_.only) known(column, "--only");
    const auto holds = [&](const auto& wanted) {
      return std::ranges::any_of(headers_, [&](const LogHeader& h) {
        return h.holds == LogHeader::Holds::quantity && wanted(*h.choice.column);
      });
    };
    constexpr const char* names_hint =
        "columns are named as in a campaign's runs.csv, in any unit of theirs (load_kN); or name the campaign whose "
        "campaign.yaml declares them: --campaign FOLDER";
    for (const char* quantity : {"load", "slip"})
      if (!holds([&](const RunColumn& column) { return column.quantity == quantity; }))
        source_.refuse(first_, fmt::format("no column holds the {}", quantity), names_hint);
    if (!holds([](const RunColumn& column) { return column.channel; }))
      source_.refuse(first_, "no measured channel: drawbar pull, torque, sinkage or lateral force", names_hint);
  }

  double value_in(const CsvCell& cell, const LogHeader& header) const {
    const std::string small = cell.text.size() < 4 ? in_small_letters(cell.text) : "";
    if (cell.text.empty() || small == "nan" || small == "-" || small == "n/a") return not_a_number;
    return number_in(cell, header.name, header.choice.unit, source_) * header.per_unit;
  }

  bool repeats(const std::vector<double>& values, double time, const std::optional<std::size_t>& run,
               const std::optional<std::size_t>& setpoint, const std::optional<std::size_t>& by) const {
    if (log_.line.empty() || std::isnan(time) || log_.clock.back() != time) return false;
    if ((run && run_of_.back() != *run) || (setpoint && setpoint_of_.back() != *setpoint) ||
        (by && part_by_.back() != *by))
      return false;
    for (std::size_t c = 0; c < values.size(); ++c) {
      const double before = log_.columns[c].values.back();
      if (before != values[c] && !(std::isnan(before) && std::isnan(values[c]))) return false;
    }
    return true;
  }

  /// A column that names a part in at least so many rows on end parts the log; one that counts the rows doesn't.
  void part_by_names(const std::vector<std::size_t>& names, const std::string& header) {
    if (names.empty()) return;
    std::size_t parts = 1;
    for (std::size_t i = 1; i < names.size(); ++i) parts += names[i] != names[i - 1];
    if (parts * fewest_samples > names.size()) {
      log_.notes.push_back(fmt::format("Column '{}' changes every {:.2g} samples: it names no runs.", header,
                                       static_cast<double>(names.size()) / static_cast<double>(parts)));
      return;
    }
    log_.parted_by += (log_.parted_by.empty() ? "'" : " and '") + header + "'";
    if (log_.part.empty()) log_.part.assign(names.size(), 0);
    std::size_t part = 0;
    for (std::size_t i = 0, before = 0; i < names.size(); ++i) {
      const std::size_t own = log_.part[i];
      part += i > 0 && (names[i] != names[i - 1] || own != before);
      before = own;
      log_.part[i] = part;
    }
  }

  const SourceText& source_;
  const LogReading& how_;
  TimeLog log_;
  std::vector<LogHeader> headers_;
  std::size_t first_ = 0, repeated_ = 0;
  NamedParts runs_, setpoints_, by_, wheels_;
  std::vector<std::size_t> run_of_, setpoint_of_, part_by_;
};

}  // namespace

double one_in_si(const std::string& unit) {
  const Unit parsed = parse_unit(unit);
  return parsed.numerator / parsed.denominator * std::pow(10.0, parsed.decimal);
}

std::optional<double> clock_time(const std::string& text) {
  if (const auto number = read_number(text)) return number;
  const std::size_t day = text.find_first_of("T ");
  std::string rest = day == text.npos ? text : text.substr(day + 1);
  if (!rest.empty() && (rest.back() == 'Z' || rest.back() == 'z')) rest.pop_back();
  constexpr double sixty = 60.0, day_of_seconds = 86400.0;
  double seconds = 0.0;
  std::size_t parts = 0;
  for (std::size_t at = 0; at <= rest.size(); ++parts) {
    const std::size_t colon = std::min(rest.find(':', at), rest.size());
    const std::optional<double> part = read_number(rest.substr(at, colon - at));
    if (!part || *part < 0.0) return std::nullopt;
    seconds = sixty * seconds + *part, at = colon + 1;
  }
  if (parts < 2 || parts > 3) return std::nullopt;
  if (day == text.npos || day < 2) return seconds;
  const std::optional<double> of_month = read_number(text.substr(day - 2, 2));  // 2026-01-31
  return of_month ? day_of_seconds * *of_month + seconds : seconds;
}

bool names_a_clock(const std::string& header) {
  const std::size_t end = std::min(header.find_first_of("_ [("), header.size());
  const std::string name = in_small_letters(header.substr(0, end));
  if (header.front() == 'T' && name == "t") return false;  // a temperature
  constexpr std::array clocks = {"t", "time", "timestamp", "elapsed", "zeit", "temps", "clock", "datetime"};
  if (std::ranges::find(clocks, name) == clocks.end()) return false;
  std::string unit = header.substr(end);
  std::erase_if(unit, [](char c) { return std::string_view("_ []()").find(c) != std::string_view::npos; });
  if (unit.empty() || unit == "stamp" || unit == "sec" || unit == "ofday") return true;
  try {
    return same_dimension(parse_unit(unit).dimension, parse_unit("s").dimension);
  } catch (const InputError&) {
    return false;
  }
}

bool names_the_wheel(const std::string& header) {
  const std::string name = in_small_letters(header);
  for (const char* wheel : {"wheel", "tire", "tyre", "wheel_id", "tire_id", "tyre_id", "wheel_name", "tire_name"})
    if (name == wheel) return true;
  return false;
}

TimeLog read_time_log(const SourceText& source, const LogReading& how) {
  LogReader reader(source, how);
  read_csv_rows(
      source, most_log_rows, "keep one wheel or one day in a file, or each tenth sample",
      [&](const CsvRow& header) { reader.begin(header); }, [&](CsvRow&& row) { reader.take(row); });
  return reader.finish();
}

}  // namespace soilbin::compare
