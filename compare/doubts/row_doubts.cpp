#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "compare/doubts/doubts.hpp"
#include "compare/measured/campaign.hpp"
#include "compare/measured/condition_views.hpp"
#include "compare/measured/stretches.hpp"
#include "compare/measured/time_log.hpp"
#include "compare/measured/within_run_scatter.hpp"
#include "scenario/nearest_word.hpp"

namespace soilbin::compare {
namespace {

/// Whether numbers or times of day go on by even steps, but for restarts.
bool goes_on_evenly(const std::vector<std::string>& texts) {
  constexpr std::size_t fewest = 20;
  constexpr double alike = 0.2, most = 0.8;
  std::vector<double> steps;
  std::optional<double> before;
  for (const std::string& text : texts) {
    const std::optional<double> time = clock_time(text);
    if (!time) return false;
    if (before) steps.push_back(*time - *before);
    before = time;
  }
  if (texts.size() < fewest) return false;
  const double usual = upper_median(steps);
  const auto even =
      std::ranges::count_if(steps, [&](double step) { return std::abs(step - usual) <= alike * std::abs(usual); });
  return usual > 0.0 && static_cast<double>(even) >= most * static_cast<double>(steps.size());
}

/// First rows of stretches whose label, conditions and pass are alike.
std::vector<std::size_t> starts_at_one_setpoint(const std::vector<Run>& runs) {
  const auto labelled = [](const Run& run) { return run.setpoint.has_value(); };
  if (std::ranges::all_of(runs, labelled)) {
    std::vector<std::size_t> starts;
    for (std::size_t i = 0; i < runs.size(); ++i)
      if (i == 0 || runs[i].setpoint != runs[i - 1].setpoint || runs[i].at.pass != runs[i - 1].at.pass)
        starts.push_back(i);
    return starts;
  }
  std::vector<HeldSeries> held;
  for (const ConditionView& view : condition_views) {
    if (view.name == "run" || view.name == "position") continue;
    HeldSeries series;
    std::vector<double> sizes;
    for (const Run& run : runs) {
      const double x = view.get(run.at);
      series.values.push_back(std::isnan(x) ? 0.0 : x);
      sizes.push_back(std::abs(series.values.back()));
    }
    series.tolerance = view.whole ? 0.1 : setpoint_tolerance(view.name, view.unit, upper_median(std::move(sizes)));
    constexpr double noisy = 3.0;  // tolerances; more is another setpoint
    if (view.name != "slip" && !view.whole)
      series.tolerance = std::clamp(noise_in_steps(series.values), series.tolerance, noisy * series.tolerance);
    held.push_back(std::move(series));
  }
  return stretch_starts(held, 0, runs.size());
}

std::vector<Run> runs_between(const std::vector<Run>& runs, const std::vector<std::size_t>& starts, std::size_t k) {
  const std::size_t end = k + 1 < starts.size() ? starts[k + 1] : runs.size();
  return {runs.begin() + static_cast<std::ptrdiff_t>(starts[k]), runs.begin() + static_cast<std::ptrdiff_t>(end)};
}

/// Whether slip goes one way in four of five steps: rows sorted by slip, or a sweep; what follows slip is smooth there.
bool is_ramp(const std::vector<Run>& runs) {
  constexpr double most = 0.8;
  std::size_t up = 0, down = 0;
  for (std::size_t i = 1; i < runs.size(); ++i)
    up += runs[i].at.slip > runs[i - 1].at.slip, down += runs[i].at.slip < runs[i - 1].at.slip;
  return runs.size() > 1 && static_cast<double>(std::max(up, down)) >= most * static_cast<double>(runs.size() - 1);
}

/// Autocorrelation at lag 1 of rows of one setpoint.
struct RowCorrelation {
  double value = 0.0;
  std::string_view channel{};
};

/// The largest of all channels that is surely above 0; 0 for none.
RowCorrelation smoothness(const std::vector<Run>& runs, const std::vector<std::size_t>& starts) {
  constexpr double surely = 4.0, strong = 0.5;
  RowCorrelation largest;
  for (const ChannelView& channel : channel_views) {
    double squares = 0.0, products = 0.0, pairs = 0.0;
    for (std::size_t k = 0; k < starts.size(); ++k) {
      const std::vector<Run> stretch = runs_between(runs, starts, k);
      std::vector<double> values;
      for (const Run& run : stretch)
        if (const auto& value = run.*channel.measured) values.push_back(*value);
      if (values.size() < 4 || is_ramp(stretch)) continue;
      const auto [least, most] = std::ranges::minmax(values);
      constexpr double rounding = 1e-12;  // of the values: a constant has no order
      if (most - least <= rounding * std::max(std::abs(least), std::abs(most))) continue;
      double mean = 0.0;
      for (const double x : values) mean += x / static_cast<double>(values.size());
      for (std::size_t i = 0; i < values.size(); ++i) {
        squares += (values[i] - mean) * (values[i] - mean);
        if (i > 0) products += (values[i] - mean) * (values[i - 1] - mean), pairs += 1.0;
      }
    }
    const double r = squares > 0.0 ? products / squares : 0.0;
    if (r > std::max(strong, surely / std::sqrt(pairs)) && r > largest.value) largest = {r, channel.title};
  }
  return largest;
}

std::vector<double> slips_of(const std::vector<Run>& runs) {
  std::vector<double> slips;
  for (const Run& run : runs) slips.push_back(run.at.slip);
  return slips;
}

/// Whether rows have one slip, but for noise: neither a ramp nor several slips in any order.
bool holds_slip(const std::vector<Run>& runs) {
  const double tolerance = setpoint_tolerance("slip", "-", 1.0);
  double mean = 0.0, squares = 0.0;
  const double count = static_cast<double>(runs.size());
  for (const Run& run : runs) mean += run.at.slip / count;
  for (const Run& run : runs) squares += (run.at.slip - mean) * (run.at.slip - mean) / count;
  return squares <= tolerance * tolerance && std::abs(runs.back().at.slip - runs.front().at.slip) <= 2 * tolerance;
}

/// Whether slip and load go from row to row by a fifth of a setpoint's tolerance or less.
bool hardly_changes(const std::vector<Run>& runs) {
  constexpr double hardly = 0.2;
  std::vector<double> loads;
  for (const Run& run : runs) loads.push_back(run.at.load);
  return noise_in_steps(slips_of(runs)) <= hardly * setpoint_tolerance("slip", "-", 1.0) &&
         noise_in_steps(loads) <= hardly * setpoint_tolerance("load", "N", upper_median(loads));
}

std::string file_of(const Campaign& campaign) {
  return campaign.columns.empty() || campaign.columns.begin()->second.at.file.empty()
             ? campaign.data
             : campaign.columns.begin()->second.at.file;
}

/// What makes rows look like samples, one of these alone; the last two may stand together with a smooth channel.
struct SampleSigns {
  Said clock = "", of_one_number = "", at_one_setpoint = "", hardly_changing = "";
};

Doubts samples(const Campaign& campaign, const SampleSigns& signs, const RowCorrelation& smooth = {}) {
  const bool smoothly = smooth.value > 0.0;
  return {Doubt{DoubtKind::rows_are_samples,
                {file_of(campaign), signs.clock, signs.of_one_number, signs.at_one_setpoint, signs.hardly_changing,
                 smoothly ? smooth.channel : "", smoothly ? Said(smooth.value) : Said("")}}};
}

/// One on rows that look like samples, or none.
Doubts doubts_of_samples(const Campaign& campaign) {
  const std::vector<Run>& runs = campaign.runs;
  for (const IgnoredColumn& column : campaign.ignored)
    if (names_a_clock(column.header) && goes_on_evenly(column.texts))
      return samples(campaign, {.clock = clipped(column.header)});
  if (runs.size() < 2) return {};
  const double rows = static_cast<double>(runs.size());
  std::size_t numbers = 1;
  for (std::size_t i = 1; i < runs.size(); ++i) numbers += !runs[i].at.run || runs[i].at.run != runs[i - 1].at.run;
  constexpr double of_one_number = 3.0;
  if (rows >= of_one_number * static_cast<double>(numbers))
    return samples(campaign, {.of_one_number = rows / static_cast<double>(numbers)});

  constexpr std::size_t long_stretch = 10, short_stretch = 4, few_rows = 40, of_a_ramp = 20, rows_of_a_ramp = 100;
  const std::vector<std::size_t> starts = starts_at_one_setpoint(runs);
  const RowCorrelation smooth = smoothness(runs, starts);
  std::size_t in_long = 0, longs = 0;
  for (std::size_t k = 0; k < starts.size(); ++k) {
    const std::size_t size = (k + 1 < starts.size() ? starts[k + 1] : runs.size()) - starts[k];
    const std::vector<Run> stretch = runs_between(runs, starts, k);
    if (size >= long_stretch && holds_slip(stretch) && !is_ramp(stretch)) in_long += size, ++longs;
  }
  if (2 * in_long >= runs.size() && (longs > 1 || smooth.value > 0.0))
    return samples(campaign, {.at_one_setpoint = in_long / longs}, smooth);
  const std::size_t usual = runs.size() / starts.size();
  if (usual >= short_stretch && runs.size() >= few_rows && smooth.value > 0.0)
    return samples(campaign, {.at_one_setpoint = usual}, smooth);
  if (usual >= of_a_ramp && runs.size() >= rows_of_a_ramp && hardly_changes(runs))
    return samples(campaign, {.hardly_changing = runs.size()}, smooth);
  return {};
}

}  // namespace

Doubts signs_of_a_log(const Campaign& campaign) {
  Doubts signs = doubts_of_samples(campaign);
  for (const IgnoredColumn& column : campaign.ignored) {
    if (!names_the_wheel(column.header)) continue;
    const std::set<std::string> wheels(column.texts.begin(), column.texts.end());
    if (wheels.size() < 2) continue;
    signs.push_back(
        {DoubtKind::several_wheels, {clipped(column.header), wheels.size(), listed({wheels.begin(), wheels.end()})}});
  }
  return signs;
}

namespace {

/// What no wheel does.
void add_impossible_rows(const Campaign& campaign, Doubts& found) {
  for (const Run& run : campaign.runs) {
    if (run.sinkage && std::abs(*run.sinkage) > 2 * campaign.wheel.radius)
      found.push_back({DoubtKind::sinkage_beyond_wheel, {1000 * *run.sinkage}, {}, run.csv_line});
    if (run.drawbar_pull && std::abs(*run.drawbar_pull) > 3 * run.at.load)
      found.push_back({DoubtKind::pull_beyond_load, {*run.drawbar_pull}, {}, run.csv_line});
  }
}

/// Runs that scattered in time far more than the campaign's usual run: their means may be of no steady state.
void add_unsteady_runs(const std::vector<Run>& runs, Doubts& found) {
  constexpr double usual = 5.0;  // times the median
  for (std::size_t c = 0; c < channel_views.size(); ++c) {
    const double median = usual_scatter(runs, c).value_or(0.0);
    const ChannelView& view = channel_views[c];
    for (const Run& run : runs)
      if (run.within_run_sd[c] && median > 0.0 && *run.within_run_sd[c] > usual * median)
        found.push_back({DoubtKind::unsteady_run,
                         {view.title, *run.within_run_sd[c] * view.per_si, view.unit, median * view.per_si, view.unit},
                         {},
                         run.csv_line});
  }
}

/// Wheels stand above the undisturbed surface here and there; not in most runs.
void add_flipped_sinkage(const std::vector<Run>& runs, Doubts& found) {
  const auto measured = std::count_if(runs.begin(), runs.end(), [](const Run& run) { return run.sinkage.has_value(); });
  const auto above =
      std::count_if(runs.begin(), runs.end(), [](const Run& run) { return run.sinkage.value_or(0.0) < 0.0; });
  if (2 * above > measured) found.push_back({DoubtKind::sinkage_flipped, {above, measured}});
}

/// All that was set and measured in a run, but for the line it stands in.
auto values_of(const Run& run) {
  return std::make_tuple(run.setpoint, run.drawbar_pull, run.torque, run.sinkage, run.lateral_force, run.at);
}

/// A fifth of the rows or more that repeat an earlier one to the last digit under another number or label: here and
/// there a re-run does.
void add_renumbered_copies(const std::vector<Run>& runs, Doubts& found) {
  constexpr std::size_t few = 5, one_in = 5;
  std::set<decltype(values_of(runs.front()))> before;
  std::size_t copies = 0;
  for (Run run : runs) {
    run.setpoint.reset(), run.at.run.reset(), run.at.position.reset();
    if (!before.insert(values_of(run)).second) ++copies;
  }
  if (copies >= few && one_in * copies >= runs.size())
    found.push_back({DoubtKind::renumbered_rows, {copies, runs.size()}});
}

/// Rows that were copied: a run's number that was there before, or every value equal to that of an earlier row.
void add_repeated_rows(const std::vector<Run>& runs, Doubts& found) {
  std::map<decltype(values_of(runs.front())), int> line_of_values;
  std::map<int, int> line_of_number;
  const std::size_t others = found.size();
  for (const Run& run : runs) {
    const int same = line_of_values.try_emplace(values_of(run), run.csv_line).first->second;
    const int numbered = run.at.run ? line_of_number.try_emplace(*run.at.run, run.csv_line).first->second : same;
    const int earlier = std::min(same, numbered);
    if (earlier == run.csv_line) continue;
    if (earlier == same)
      found.push_back({DoubtKind::repeated_row, {earlier}, {}, run.csv_line});
    else
      found.push_back({DoubtKind::repeated_number, {*run.at.run, earlier}, {}, run.csv_line});
  }
  if (found.size() == others) add_renumbered_copies(runs, found);
}

}  // namespace

Doubts row_doubts(const Campaign& campaign) {
  Doubts found = signs_of_a_log(campaign);
  const bool runs = found.empty();
  add_impossible_rows(campaign, found);
  add_flipped_sinkage(campaign.runs, found);
  if (runs) add_repeated_rows(campaign.runs, found);  // samples of a log may well be alike
  add_unsteady_runs(campaign.runs, found);
  return found;
}

Doubts doubts(const LoggedRun& run) {
  constexpr double many = 1e4;
  Doubts found;
  for (const auto& [title, errors] : run.unsteady)
    found.push_back({DoubtKind::unsteady_samples, {title, errors < many ? Said(errors) : Said("very many")}});
  return found;
}

Doubts doubts(const LogRuns& runs) {
  Doubts found;
  for (const LoggedRun& one : runs.runs)
    for (Doubt& doubt : doubts(one)) {
      doubt.of = fmt::format("run {}, lines {}-{}", *one.run.at.run, one.first_line, one.last_line);
      found.push_back(std::move(doubt));
    }
  return found;
}

}  // namespace soilbin::compare
