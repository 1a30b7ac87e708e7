// The runs of a time log: setpoints found, transients cut off, means with the errors of samples that follow each other.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <span>

#include "compare/measured/campaign.hpp"
#include "compare/measured/stretches.hpp"
#include "compare/measured/time_log.hpp"
#include "compare/measured/within_run_scatter.hpp"
#include "scenario/errors.hpp"
#include "scenario/mean_value.hpp"

namespace soilbin::compare {
namespace {

std::string samples_in_words(std::size_t count) { return fmt::format("{} sample{}", count, count == 1 ? "" : "s"); }

/// Whether a column is a condition of a setpoint: held, not counted and not measured.
bool is_held(const RunColumn& column) {
  return column.content == RunColumn::Content::number && !column.channel && column.beside.empty() &&
         column.quantity != "position";
}

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
      begins = begins || (column.column->content == RunColumn::Content::whole_number &&
                          column.values[i] != column.values[i - 1] && !std::isnan(column.values[i]));
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
    if (column.column->content != RunColumn::Content::number || column.column->quantity == "position") continue;
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
  return fmt::format("{:.4g}{}", si / one_in_si(unit), unit == "-" ? "" : " " + unit);
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
  if (!log.part.empty()) out.parted_by = log.parted_by;
  out.has_clock = !log.clock.empty();
  if (out.runs.empty()) {
    std::string why = out.left_out.front().why;
    for (const LeftOut& one : out.left_out)
      if (one.why.starts_with("a ramp")) why = one.why;
    throw InputError({log.file}, "no run has a steady setpoint: " + why, "",
                     "a run holds slip and load for some time; a column that names the runs: --by COLUMN");
  }
  name_setpoints(log, out.runs);
  out.notes = log.notes;
  out.periods = std::set<std::size_t>(clock_parts.begin(), clock_parts.end()).size();
  return out;
}

std::string runs_csv(const LogRuns& made, const std::map<std::string, DataColumn>& named) {
  std::vector<Run> runs;
  for (const LoggedRun& one : made.runs) runs.push_back(one.run);
  for (const RunColumn& column : run_columns()) {
    if (column.content != RunColumn::Content::number) continue;
    const auto own = named.find(column.quantity);
    const double unit = one_in_si(own == named.end() ? column.measure.unit : own->second.unit);
    for (Run& run : runs)
      if (const std::optional<double> value = column.get(run)) column.set(run, to_six_digits(*value / unit) * unit);
  }
  std::set<std::string_view> declared;
  for (const auto& [quantity, column] : named) declared.insert(quantity);
  return write_runs(runs, declared, named);
}

}  // namespace soilbin::compare
