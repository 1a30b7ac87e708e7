#include "compare/measured/time_log.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include "compare/measured/channels.hpp"
#include "compare/measured/stretches.hpp"
#include "compare/measured/within_run_scatter.hpp"
#include "scenario/csv.hpp"
#include "scenario/mean_value.hpp"
#include "scenario/nearest_word.hpp"
#include "scenario/quantity.hpp"

namespace soilbin::compare {
namespace {

using Content = RunColumn::Content;

std::string in_small_letters(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::string samples_in_words(std::size_t count) { return fmt::format("{} sample{}", count, count == 1 ? "" : "s"); }

/// One of a unit in SI.
double in_si(const std::string& unit) {
  const Unit parsed = parse_unit(unit);
  return parsed.numerator / parsed.denominator * std::pow(10.0, parsed.decimal);
}

/// Whether a column is a condition of a setpoint: held, not counted and not measured.
bool is_held(const RunColumn& column) {
  return column.content == Content::number && !column.channel && column.beside.empty() && column.quantity != "position";
}

/// What a header of a log holds.
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
    header.per_unit = in_si(unit);
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

/// Rows first .. last - 1.
struct Rows {
  std::size_t first = 0, last = 0;
  std::size_t clock_part = 0;  ///< counts the breaks of the clock before them
  std::size_t size() const { return last - first; }
};

/// The time between rows that a clock most often tells; nothing where it never goes on.
std::optional<double> usual_step(const std::vector<double>& clock) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < clock.size(); ++i)
    if (clock[i] > clock[i - 1]) steps.push_back(clock[i] - clock[i - 1]);
  return steps.empty() ? std::nullopt : std::optional(upper_median(std::move(steps)));
}

/// A column's values with gaps filled by what stood before them.
std::vector<double> without_gaps(const std::vector<double>& values) {
  std::vector<double> filled = values;
  const auto first = std::ranges::find_if(filled, [](double x) { return !std::isnan(x); });
  double last = first == filled.end() ? 0.0 : *first;
  for (double& x : filled) x = last = std::isnan(x) ? last : x;
  return filled;
}

/// Each value replaced by the median of it and its neighbours, two on each side: a dropped sample is no new setpoint.
std::vector<double> without_spikes(const std::vector<double>& values) {
  std::vector<double> smooth = values;
  for (std::size_t i = 2; i + 2 < values.size(); ++i) {
    std::array<double, 5> near{};
    std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(i) - 2, near.size(), near.begin());
    std::ranges::nth_element(near, near.begin() + 2);
    smooth[i] = near[2];
  }
  return smooth;
}

/// Where runs may end whatever their conditions do: at named parts, at other passes, where the clock breaks.
std::vector<Rows> unbroken_parts(const TimeLog& log) {
  constexpr double long_pause = 10.0;  // usual steps
  const std::optional<double> step = usual_step(log.clock);
  std::vector<Rows> parts;
  std::size_t clock_part = 0;
  for (std::size_t i = 0; i < log.line.size(); ++i) {
    bool begins = i == 0 || (!log.part.empty() && log.part[i] != log.part[i - 1]);
    for (const LoggedColumn& column : log.columns)
      begins = begins || (column.column->content == Content::whole_number && column.values[i] != column.values[i - 1] &&
                          !std::isnan(column.values[i]));
    if (i > 0 && step) {
      const double passed = log.clock[i] - log.clock[i - 1];
      if (passed < 0.0 || passed > long_pause * *step) ++clock_part, begins = true;
    }
    if (begins) parts.push_back({i, i, clock_part});
    ++parts.back().last;
  }
  return parts;
}

/// Parts at one setpoint each: by names and clock, and by the conditions where nothing names the parts.
std::vector<Rows> setpoints_of(const TimeLog& log) {
  const std::vector<Rows> parts = unbroken_parts(log);
  if (!log.part.empty()) return parts;
  std::vector<HeldSeries> held;
  for (const LoggedColumn& column : log.columns) {
    if (!is_held(*column.column)) continue;
    const std::vector<double> column_values = without_gaps(column.values);
    HeldSeries series{without_spikes(column_values), 0.0};
    std::vector<double> sizes;
    for (const double x : series.values) sizes.push_back(std::abs(x));
    series.tolerance =
        setpoint_tolerance(column.column->quantity, column.column->measure.unit, upper_median(std::move(sizes)));
    series.tolerance = std::max(series.tolerance, noise_in_steps(column_values));
    held.push_back(std::move(series));
  }
  std::vector<Rows> all;
  for (const Rows& part : parts) {
    const std::vector<std::size_t> starts = stretch_starts(held, part.first, part.last);
    for (std::size_t k = 0; k < starts.size(); ++k)
      all.push_back({starts[k], k + 1 < starts.size() ? starts[k + 1] : part.last, part.clock_part});
  }
  return all;
}

/// Means of so many values that no more than 2000 are left, whose mean and error are those of all; and how many each is
/// of.
struct Thinned {
  std::vector<double> means;
  std::size_t each = 1;
};

Thinned thinned(const std::vector<double>& values) {
  constexpr std::size_t most = 2000;
  Thinned out{{}, values.empty() ? 1 : (values.size() - 1) / most + 1};
  for (std::size_t k = 0; k + out.each <= values.size(); k += out.each) {
    double sum = 0.0;
    for (std::size_t i = k; i < k + out.each; ++i) sum += values[i];
    out.means.push_back(sum / static_cast<double>(out.each));
  }
  return out;
}

double mean_of(std::span<const double> values) {
  double sum = 0.0;
  for (const double x : values) sum += x;
  return sum / static_cast<double>(values.size());
}

double sd_of(std::span<const double> values) {
  if (values.size() < 2) return 0.0;
  const double middle = mean_of(values);
  double squares = 0.0;
  for (const double x : values) squares += (x - middle) * (x - middle);
  return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

/// By how many standard deviations of samples means must differ at least, of so many that few show how alike samples
/// are: a few slow waves look like a transient. Falls with 1/sqrt(samples) beyond a hundred (chosen).
double least_difference(double deviations, std::size_t samples) {
  constexpr double many = 100.0;
  return deviations * std::sqrt(std::min(1.0, many / static_cast<double>(samples)));
}

/// Values to cut off at the beginning of a series as its transient; 0 where they are like the rest.
std::size_t transient(std::span<const double> series) {
  constexpr double clearly = 3.0;  // standard errors, and deviations of samples where these are few
  const std::size_t cut = end_of_start_up(series);
  if (cut == 0) return 0;
  const std::span<const double> before = series.first(cut), rest = series.subspan(cut);
  const double scatter = sd_of(rest),
               of_before = scatter * std::sqrt(autocorrelation_time(rest) / static_cast<double>(before.size())),
               error = std::hypot(of_before, mean_with_error(rest).std_error);
  const double least = std::max(clearly * error, least_difference(clearly, rest.size()) * scatter);
  return std::abs(mean_of(before) - mean_of(rest)) > least ? cut : 0;
}

std::vector<double> rows_of(const LoggedColumn& column, const Rows& rows) {
  return {column.values.begin() + static_cast<std::ptrdiff_t>(rows.first),
          column.values.begin() + static_cast<std::ptrdiff_t>(rows.last)};
}

std::vector<double> told_rows_of(const LoggedColumn& column, const Rows& rows) {
  std::vector<double> values = rows_of(column, rows);
  std::erase_if(values, [](double x) { return std::isnan(x); });
  return values;
}

/// The longest transient at one end of a run, of all columns.
std::size_t transient_of(const TimeLog& log, const Rows& rows, bool at_the_end) {
  std::size_t longest = 0;
  for (const LoggedColumn& column : log.columns) {
    if (column.column->content != Content::number || column.column->quantity == "position") continue;
    if (told_rows_of(column, rows).size() < fewest_samples) continue;
    Thinned series = thinned(without_gaps(rows_of(column, rows)));
    if (at_the_end) std::ranges::reverse(series.means);
    longest = std::max(longest, series.each * transient(series.means));
  }
  return longest;
}

/// The rows of a run without its transients, each end's found once more where the other's no longer hides it. All of
/// them where half or more would go: that is no transient.
Rows steady_rows(const TimeLog& log, const Rows& rows) {
  Rows rest = rows;
  for (bool cut = true; cut && 2 * rest.size() > rows.size();) {
    const std::size_t before = transient_of(log, rest, false);
    rest.first += before;
    const std::size_t after = transient_of(log, rest, true);
    rest.last -= after;
    cut = before + after > 0;
  }
  return 2 * rest.size() > rows.size() ? rest : rows;
}

std::string spaced_name(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return name;
}

/// A value of a column in its canonical unit: "20 %" of a slip.
std::string value_in_words(const RunColumn& column, double si) {
  const bool slip = column.quantity == "slip";
  const std::string unit = slip ? "%" : column.measure.unit;
  return fmt::format("{:.4g}{}", si / in_si(unit), unit == "-" ? "" : " " + unit);
}

/// Why a condition is no setpoint's: it goes on changing; "" where it stays.
std::string ramp_of(const RunColumn& column, const std::vector<double>& values) {
  constexpr double far = 3.0;  // tolerances
  const std::size_t third = values.size() / 3;
  if (third == 0) return "";
  const std::span<const double> all(values);
  const double from = mean_of(all.first(third)), to = mean_of(all.last(third)), middle = mean_of(all),
               change = 1.5 * (to - from);
  const double tolerance = setpoint_tolerance(column.quantity, column.measure.unit, middle);
  const double error =
      1.5 * std::hypot(mean_with_error(all.first(third)).std_error, mean_with_error(all.last(third)).std_error);
  if (!(std::abs(change) > far * tolerance && std::abs(change) > far * error)) return "";
  return fmt::format("a ramp: the {} goes from {} to {}", spaced_name(column.quantity),
                     value_in_words(column, middle - change / 2), value_in_words(column, middle + change / 2));
}

RunMean mean_with_effective(const std::vector<double>& values) {
  RunMean out;
  out.mean = {mean_of(values), mean_with_error(thinned(values).means).std_error};
  out.sd = sd_of(values);
  const double all = static_cast<double>(values.size());
  out.effective = out.mean.std_error > 0.0 ? std::min(all, std::pow(out.sd / out.mean.std_error, 2)) : 1.0;
  return out;
}

/// A channel whose halves differ; none where it is steady.
std::optional<UnsteadyChannel> unsteadiness(const ChannelView& channel, const std::vector<double>& values) {
  constexpr double clearly = 4.0, deviations = 1.5;
  const std::vector<double> series = thinned(values).means;
  const double drift = drift_over_error(series);
  const std::span<const double> all(series);
  const double halves = std::abs(mean_of(all.first(all.size() / 2)) - mean_of(all.last(all.size() / 2)));
  if (!(drift > clearly && halves > least_difference(deviations, all.size()) * sd_of(all))) return {};
  return UnsteadyChannel{channel.title, drift};
}

/// A run, or why there is none.
struct Made {
  std::optional<LoggedRun> run;
  std::string why;
};

Made run_of(const TimeLog& log, const Rows& rows) {
  if (rows.size() < fewest_samples) return {std::nullopt, "too few samples for a setpoint"};
  LoggedRun made;
  made.first_line = log.line[rows.first], made.last_line = log.line[rows.last - 1], made.samples = rows.size();
  const Rows steady = steady_rows(log, rows);
  if (steady.size() < fewest_samples) return {std::nullopt, "too few samples behind the transients"};
  made.cut_before = steady.first - rows.first, made.cut_after = rows.last - steady.last;
  for (const LoggedColumn& column : log.columns) {
    const std::vector<double> values = told_rows_of(column, steady);
    const RunColumn& about = *column.column;
    if (values.size() < fewest_samples && about.required)
      return {std::nullopt, fmt::format("no {} in {}", spaced_name(about.quantity), samples_in_words(steady.size()))};
    if (values.empty() || (about.channel && values.size() < fewest_samples)) continue;
    const double mean = mean_of(values);
    if (is_held(about))
      if (std::string ramp = ramp_of(about, values); !ramp.empty()) return {std::nullopt, std::move(ramp)};
    if (!about.measure.range.holds(mean))
      return {std::nullopt, fmt::format("its mean {} is {}, and must be {}", spaced_name(about.quantity),
                                        value_in_words(about, mean), describe_range(about.measure))};
    about.set(made.run, mean);
    for (std::size_t c = 0; c < channel_views.size(); ++c) {
      if (about.quantity != channel_views[c].name) continue;
      made.channels[c] = mean_with_effective(values);
      made.run.within_run_sd[c] = made.channels[c]->sd;
      made.run.mean_error[c] = made.channels[c]->mean.std_error;
      if (const auto unsteady = unsteadiness(channel_views[c], values)) made.unsteady.push_back(*unsteady);
    }
  }
  if (!has_channel(made.run)) return {std::nullopt, "no channel is measured"};
  if (!log.setpoints.empty() && !log.setpoints[rows.first].empty()) made.run.setpoint = log.setpoints[rows.first];
  return {std::move(made), ""};
}

/// Whether two runs are at like conditions.
bool at_like_conditions(const TimeLog& log, const Run& a, const Run& b) {
  return a.at.pass == b.at.pass && std::ranges::all_of(log.columns, [&](const LoggedColumn& column) {
           if (!is_held(*column.column)) return true;
           const std::optional<double> x = column.column->get(a), y = column.column->get(b);
           if (!x || !y) return x.has_value() == y.has_value();
           return std::abs(*x - *y) <= setpoint_tolerance(column.column->quantity, column.column->measure.unit, *x);
         });
}

void name_setpoints(const TimeLog& log, std::vector<LoggedRun>& runs) {
  if (!log.setpoints.empty()) return;
  std::vector<const Run*> firsts;
  for (LoggedRun& made : runs) {
    auto place = std::ranges::find_if(firsts, [&](const Run* one) { return at_like_conditions(log, *one, made.run); });
    if (place == firsts.end()) place = firsts.insert(place, &made.run);
    made.run.setpoint = fmt::format("s{}", place - firsts.begin() + 1);
  }
}

/// To six significant digits: what a mean of samples is good for, and what a person wants to read.
double to_six_digits(double value) { return read_number(fmt::format("{:.6g}", value)).value_or(value); }

}  // namespace

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

LogRuns runs_of_log(const TimeLog& log) {
  LogRuns out;
  const std::vector<Rows> all = setpoints_of(log);
  std::vector<std::size_t> clock_parts;
  for (const Rows& rows : all) {
    Made made = run_of(log, rows);
    if (made.run) {
      clock_parts.push_back(rows.clock_part);
      out.runs.push_back(std::move(*made.run));
      out.runs.back().run.at.run = static_cast<int>(out.runs.size());
    } else {
      out.left_out.push_back({log.line[rows.first], log.line[rows.last - 1], rows.size(), std::move(made.why)});
    }
  }
  out.parted = fmt::format("Runs were told from each other by {}{}.",
                           !log.part.empty() ? "the changes of " + log.parted_by
                                             : std::string("the changes of slip, load and other conditions"),
                           log.clock.empty() ? "" : ", and by breaks of the clock");
  if (out.runs.empty()) {
    std::string why = out.left_out.front().why;
    for (const LeftOut& one : out.left_out)
      if (one.why.starts_with("a ramp")) why = one.why;
    throw InputError({log.file}, "no run has a steady setpoint: " + why, "",
                     "a run holds slip and load for some time; a column that names the runs: --by COLUMN");
  }
  name_setpoints(log, out.runs);
  out.notes = log.notes;
  const std::size_t sessions = std::set<std::size_t>(clock_parts.begin(), clock_parts.end()).size();
  if (!log.clock.empty() && sessions < out.runs.size())
    out.notes.push_back(
        fmt::format("{} runs stand in {} unbroken stretch{} of time. Runs that follow each other on one bed share its "
                    "differences, and a campaign takes each run for one on a freshly prepared bed.",
                    out.runs.size(), sessions, sessions == 1 ? "" : "es"));
  return out;
}

std::string reduction_in_words() {
  return "A mean is that of the steady part: transients are cut off at both ends by MSER-5 (White 1997). Its standard "
         "error is by blocks of four autocorrelation times (Sokal 1997), so samples that follow each other do not "
         "count "
         "as independent; the effective number of samples is (sd/error)^2. This error holds within the run: how much "
         "another bed differs only re-runs tell.";
}

std::string runs_csv(const LogRuns& made, const std::map<std::string, DataColumn>& named) {
  std::vector<Run> runs;
  for (const LoggedRun& one : made.runs) runs.push_back(one.run);
  for (const RunColumn& column : run_columns()) {
    if (column.content != Content::number) continue;
    const auto own = named.find(column.quantity);
    const double unit = in_si(own == named.end() ? column.measure.unit : own->second.unit);
    for (Run& run : runs)
      if (const std::optional<double> value = column.get(run)) column.set(run, to_six_digits(*value / unit) * unit);
  }
  std::set<std::string_view> declared;
  for (const auto& [quantity, column] : named) declared.insert(quantity);
  return write_runs(runs, declared, named);
}

}  // namespace soilbin::compare
