#include "compare/measured/time_log.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <cmath>
#include <ranges>

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

constexpr double day_of_seconds = 86400.0;

/// Which number of 01/02/2026 is the month.
enum class DateOrder { month_first, day_first };

struct ReadClock {
  double seconds = 0.0;
  bool of_day = false;  ///< 12:30:05 without a date: begins again at midnight
};

/// The numbers of a text between these marks, none below 0; nothing where one is no number.
std::optional<std::vector<double>> numbers_between(const std::string& text, char mark) {
  std::vector<double> numbers;
  for (const auto part : std::views::split(text, mark)) {
    const std::optional<double> number = read_number(std::string(part.begin(), part.end()));
    if (!number || *number < 0.0) return std::nullopt;
    numbers.push_back(*number);
  }
  return numbers;
}

/// Its days from 1970 on: 2026-01-31, 31.01.2026, 01/31/2026, 31/01/2026.
std::optional<double> days_of_date(const std::string& date, DateOrder order) {
  const std::size_t mark = date.find_first_of("-./");
  if (mark == date.npos) return std::nullopt;
  const std::optional<std::vector<double>> numbers = numbers_between(date, date[mark]);
  constexpr double most = 9999.0;
  if (!numbers || numbers->size() != 3 || std::ranges::max(*numbers) > most) return std::nullopt;
  std::vector<int> parts(numbers->begin(), numbers->end());
  constexpr std::size_t digits_of_year = 4;
  const bool year_first = mark == digits_of_year;
  if (year_first) std::swap(parts[0], parts[2]);
  if (!year_first && date[mark] == '/' && order == DateOrder::month_first) std::swap(parts[0], parts[1]);
  constexpr int century = 2000;
  const std::chrono::year_month_day day(std::chrono::year(parts[2] < 100 ? century + parts[2] : parts[2]),
                                        std::chrono::month(static_cast<unsigned>(parts[1])),
                                        std::chrono::day(static_cast<unsigned>(parts[0])));
  if (!day.ok()) return std::nullopt;
  return static_cast<double>(std::chrono::sys_days(day).time_since_epoch().count());
}

/// 12:30:05.25, and 12:30 where that can't be minutes and seconds.
std::optional<double> seconds_of_day(const std::string& text, bool hours_lead) {
  const std::optional<std::vector<double>> parts = numbers_between(text, ':');
  if (!parts || parts->size() < 2 || parts->size() > 3) return std::nullopt;
  constexpr double sixty = 60.0;
  double seconds = 0.0;
  for (const double part : *parts) seconds = sixty * seconds + part;
  return hours_lead && parts->size() == 2 ? sixty * seconds : seconds;
}

/// Whether a text ends so; then without that and the blanks before it.
bool take_end(std::string& text, std::string_view end) {
  if (!text.ends_with(end)) return false;
  text.erase(text.size() - end.size());
  text.erase(text.find_last_not_of(' ') + 1);
  return true;
}

std::optional<ReadClock> read_clock(const std::string& cell, DateOrder order) {
  if (const auto number = read_number(cell)) return ReadClock{*number};
  std::string text = in_small_letters(cell);
  const bool morning = take_end(text, "am"), afternoon = take_end(text, "pm"), halved = morning || afternoon;
  double ahead = 0.0;  // of universal time
  if (!take_end(text, "utc") && !take_end(text, "z"))
    if (const std::size_t sign = text.find_first_of("+-", text.find(':')); sign != text.npos) {
      std::string offset = text.substr(sign + 1);
      constexpr std::size_t hours = 2;
      if (offset.size() > hours && offset[hours] != ':') offset.insert(hours, ":");
      const auto by = seconds_of_day(offset.size() == hours ? offset + ":00" : offset, true);
      if (!by) return std::nullopt;
      ahead = text[sign] == '-' ? -*by : *by;
      take_end(text, text.substr(sign));
    }
  const std::size_t gap = text.find_last_of("t ");
  const std::string time = gap == text.npos ? text : text.substr(gap + 1);
  const auto days = gap == text.npos ? std::nullopt : days_of_date(text.substr(0, gap), order);
  if (gap != text.npos && !days) return std::nullopt;
  const auto of_day = seconds_of_day(time, days || halved);
  if (!of_day) return std::nullopt;
  constexpr double half_day = day_of_seconds / 2;
  const double seconds = halved ? std::fmod(*of_day, half_day) + (afternoon ? half_day : 0.0) : *of_day;
  if (days) return ReadClock{day_of_seconds * *days + seconds - ahead};
  return ReadClock{seconds - ahead, halved || std::ranges::count(time, ':') == 2};
}

/// A log's clock, row by row, by both orders of a date's numbers.
class LogClock {
 public:
  void take(const std::string& cell) {
    std::array<double, 2> times{not_a_number, not_a_number};
    for (const DateOrder order : {DateOrder::month_first, DateOrder::day_first})
      if (const std::optional<ReadClock> read = read_clock(cell, order))
        times[static_cast<std::size_t>(order)] = read->of_day ? after_midnights(read->seconds) : read->seconds;
    if (!cell.empty() && std::isnan(times[0]) && std::isnan(times[1]) && unread_++ == 0) unread_cell_ = cell;
    now_ = times;
  }
  /// Whether the row's time is that of the one that was kept last.
  bool repeats() const { return !kept_[0].empty() && (now_[0] == kept_[0].back() || now_[1] == kept_[1].back()); }
  void keep() {
    for (std::size_t k = 0; k < kept_.size(); ++k) kept_[k].push_back(now_[k]);
  }
  /// Of 01/02/2026 and the like by the order that reads more of them, or makes the log shorter.
  std::vector<double> clock() const {
    const auto worth = [](const std::vector<double>& clock) {
      double first = HUGE_VAL, last = -HUGE_VAL;
      std::ptrdiff_t unread = 0;
      for (const double time : clock)
        if (std::isnan(time))
          ++unread;
        else
          first = std::min(first, time), last = std::max(last, time);
      return std::pair(unread, last - first);
    };
    std::vector<double> best = kept_[worth(kept_[1]) < worth(kept_[0]) ? 1 : 0];
    if (std::ranges::all_of(best, [](double time) { return std::isnan(time); })) best.clear();
    return best;
  }
  std::size_t unread() const { return unread_; }
  const std::string& unread_cell() const { return unread_cell_; }

 private:
  /// A clock that goes back by more than half a day has passed midnight.
  double after_midnights(double seconds) {
    if (seconds + midnights_ < before_ - day_of_seconds / 2) midnights_ += day_of_seconds;
    return before_ = seconds + midnights_;
  }

  std::array<double, 2> now_{not_a_number, not_a_number};
  std::array<std::vector<double>, 2> kept_{};
  double midnights_ = 0.0, before_ = 0.0;
  std::size_t unread_ = 0;
  std::string unread_cell_{};  ///< the first one
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
          clock_.take(cell.text);
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
    if (repeats(values, run, setpoint, by)) {
      ++repeated_;
      return;
    }
    for (std::size_t c = 0; c < values.size(); ++c) log_.columns[c].values.push_back(values[c]);
    log_.line.push_back(row.line);
    clock_.keep();
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
    log_.clock = clock_.clock();
    if (clock_.unread() > 0)
      log_.notes.push_back(fmt::format(
          "Times that can't be read: {}, the first '{}'; breaks of the clock there part no runs. Times are seconds, "
          "12:30:05, or 2026-01-31T12:30:05.",
          clock_.unread(), clipped(clock_.unread_cell())));
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

  bool repeats(const std::vector<double>& values, const std::optional<std::size_t>& run,
               const std::optional<std::size_t>& setpoint, const std::optional<std::size_t>& by) const {
    if (!clock_.repeats()) return false;
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
  LogClock clock_;
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
  const std::optional<ReadClock> read = read_clock(text, DateOrder::month_first);
  return read ? std::optional(read->seconds) : std::nullopt;
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
