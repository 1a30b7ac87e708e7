#include "compare/doubts/row_doubts.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "compare/doubts/log_signs.hpp"
#include "compare/measured/channels.hpp"
#include "compare/measured/within_run_scatter.hpp"

namespace soilbin::compare {
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

}  // namespace soilbin::compare
