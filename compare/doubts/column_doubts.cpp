#include "compare/doubts/column_doubts.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "compare/measured/channels.hpp"
#include "compare/sweep/varying.hpp"
#include "scenario/quantity.hpp"

namespace soilbin::compare {
namespace {

using Warnings = std::vector<std::string>;

/// Correlation within groups of two columns; 0 where one of them doesn't vary.
double correlation(const std::vector<double>& x, const std::vector<double>& y, const std::vector<std::size_t>& group) {
  const std::size_t groups = group.empty() ? 0 : *std::max_element(group.begin(), group.end()) + 1;
  std::vector<double> n(groups), sum_x(groups), sum_y(groups);
  for (std::size_t i = 0; i < x.size(); ++i) n[group[i]] += 1, sum_x[group[i]] += x[i], sum_y[group[i]] += y[i];
  double xx = 0, xy = 0, yy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const std::size_t g = group[i];
    const double dx = x[i] - sum_x[g] / n[g], dy = y[i] - sum_y[g] / n[g];
    xx += dx * dx, xy += dx * dy, yy += dy * dy;
  }
  return xx > 0 && yy > 0 ? xy / std::sqrt(xx * yy) : 0.0;
}

/// A pull whose sign is flipped falls along each curve against slip while the torque rises, and lies nearer to what the
/// model says once it is turned round.
void add_flipped_pull(const Campaign& campaign, const std::vector<Answer>& answers, Warnings& warnings) {
  constexpr std::size_t fewest = 6;
  constexpr double clearly = 0.7;
  std::vector<OperatingCondition> conditions;
  for (const Run& run : campaign.runs) conditions.push_back(run.at);
  const std::vector<std::size_t> curve_of = curves_against_slip(conditions, Spread::measured).curve_of;
  std::vector<double> slip, pull, torque;
  std::vector<std::size_t> curve;
  for (std::size_t i = 0; i < campaign.runs.size(); ++i) {
    const Run& run = campaign.runs[i];
    if (!run.drawbar_pull || !run.torque) continue;
    slip.push_back(run.at.slip), pull.push_back(*run.drawbar_pull), torque.push_back(*run.torque);
    curve.push_back(curve_of[i]);
  }
  if (slip.size() < fewest ||
      !(correlation(slip, pull, curve) < -clearly && correlation(slip, torque, curve) > clearly))
    return;
  double as_given = 0, turned_round = 0;
  for (std::size_t i = 0; i < campaign.runs.size(); ++i) {
    const auto& measured = campaign.runs[i].drawbar_pull;
    const auto& predicted = answers[i].result;
    if (!measured || !predicted) continue;
    as_given += std::pow(*measured - predicted->drawbar_pull.value, 2);
    turned_round += std::pow(*measured + predicted->drawbar_pull.value, 2);
  }
  if (turned_round < as_given)
    warnings.emplace_back(
        "the drawbar pull falls as slip rises while the torque rises: is its sign flipped? Positive pulls forward");
}

double root_mean_square(const std::vector<double>& values) {
  const double squares = std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
  return std::sqrt(squares / static_cast<double>(values.size()));
}

constexpr std::size_t fewest_to_compare = 3;

/// The column of a quantity; where there is no file, named as the quantity.
DataColumn column_of(const Campaign& campaign, std::string_view quantity) {
  const auto found = campaign.columns.find(std::string(quantity));
  return found == campaign.columns.end() ? DataColumn{std::string(quantity), "", {}} : found->second;
}

/// "runs.csv:1:34: ", empty where there is no file.
std::string place_of(const DataColumn& column) {
  const SourcePosition& at = column.at;
  return at.line > 0 ? fmt::format("{}:{}:{}: ", at.file, at.line, at.column) : "";
}

/// "runs.csv:1:34: the columns 'drawbar_pull_N' and 'torque_Nm' look swapped: ...", at the second of them.
std::string swapped(const Campaign& campaign, std::string_view one, std::string_view other, const char* why) {
  DataColumn first = column_of(campaign, one), second = column_of(campaign, other);
  if (second.at.column < first.at.column) std::swap(first, second);
  return fmt::format("{}the columns '{}' and '{}' look swapped: {}; look at the header{}", place_of(second),
                     first.header, second.header, why,
                     campaign.columns.empty() ? "" : ", and at 'columns:' in campaign.yaml");
}

/// How much nearer two channels lie to what the model says of the other: the product of their two errors that way over
/// the product as it is given; 1 where few rows say anything.
double error_if_swapped(const Campaign& campaign, const std::vector<Answer>& answers, const ChannelView& one,
                        const ChannelView& other) {
  std::vector<double> as_given[2], exchanged[2];
  for (std::size_t i = 0; i < campaign.runs.size(); ++i) {
    const auto &a = campaign.runs[i].*one.measured, &b = campaign.runs[i].*other.measured;
    const auto& predicted = answers[i].result;
    if (!a || !b || !predicted) continue;
    const double says_a = ((*predicted).*one.predicted).value, says_b = ((*predicted).*other.predicted).value;
    as_given[0].push_back(*a - says_a), as_given[1].push_back(*b - says_b);
    exchanged[0].push_back(*a - says_b), exchanged[1].push_back(*b - says_a);
  }
  if (as_given[0].size() < fewest_to_compare) return 1.0;
  const auto product = [](const std::vector<double>(&errors)[2]) {
    return root_mean_square(errors[0]) * root_mean_square(errors[1]);
  };
  return product(as_given) > 0.0 ? product(exchanged) / product(as_given) : 1.0;
}

/// The two channels that look most like each other's. Their error if swapped is below this in no campaign known to be
/// in order (0.89 and above in 242); exchanged, nine of ten fall below it. Where three are mixed up, one pair at a
/// time.
void add_swapped_channels(const Campaign& campaign, const std::vector<Answer>& answers, Warnings& warnings) {
  constexpr double clearly = 0.25;
  const auto& [pull, torque, sinkage, side_force] = channel_views;
  const std::pair<const ChannelView*, const ChannelView*> pairs[] = {
      {&pull, &torque}, {&pull, &side_force}, {&torque, &side_force}};
  double least = clearly;
  const std::pair<const ChannelView*, const ChannelView*>* worst = nullptr;
  for (const auto& pair : pairs)
    if (const double error = error_if_swapped(campaign, answers, *pair.first, *pair.second); error < least)
      least = error, worst = &pair;
  if (worst)
    warnings.push_back(
        swapped(campaign, worst->first->name, worst->second->name, "each fits the prediction of the other far better"));
}

/// Load and pull exchanged, the model says the pull of each run far better. No load is negative, so only a campaign in
/// which every pull is positive can be meant. 0.56 and above in campaigns known to be in order.
void add_swapped_load(const Campaign& campaign, const std::vector<Answer>& answers, const AskAgain& ask,
                      Warnings& warnings) {
  constexpr double clearly = 1.0 / 3;
  std::vector<double> load, as_given, exchanged, pull_given, load_given;
  std::vector<OperatingCondition> other_way;
  for (std::size_t i = 0; i < campaign.runs.size(); ++i) {
    const Run& run = campaign.runs[i];
    if (!run.drawbar_pull) continue;
    if (!(*run.drawbar_pull > 0.0)) return;
    load.push_back(run.at.load);
    other_way.push_back(run.at);
    other_way.back().load = *run.drawbar_pull;
    if (!answers[i].result) continue;
    as_given.push_back(*run.drawbar_pull - answers[i].result->drawbar_pull.value);
    pull_given.push_back(*run.drawbar_pull);
  }
  if (as_given.size() < fewest_to_compare) return;
  const std::vector<Answer> again = ask(other_way);
  for (std::size_t i = 0; i < again.size(); ++i)
    if (again[i].result)
      exchanged.push_back(load[i] - again[i].result->drawbar_pull.value), load_given.push_back(load[i]);
  if (exchanged.size() < fewest_to_compare || 2 * exchanged.size() < again.size()) return;
  if (root_mean_square(exchanged) / root_mean_square(load_given) <
      clearly * root_mean_square(as_given) / root_mean_square(pull_given))
    warnings.push_back(swapped(campaign, "load", "drawbar_pull", "exchanged, they fit the prediction far better"));
}

/// How much smaller the model's errors are where each load is this many times what the campaign says: the ratio of the
/// root mean square errors, the geometric mean over the channels that are measured. 1 where few rows say anything. Of a
/// long campaign only so many rows, evenly, are asked.
double error_with_loads(double times, const Campaign& campaign, const std::vector<Answer>& answers,
                        const AskAgain& ask) {
  constexpr std::size_t most = 100;
  const std::size_t every = 1 + (campaign.runs.size() - 1) / most;
  std::vector<OperatingCondition> heavier;
  for (std::size_t i = 0; i < campaign.runs.size(); i += every) {
    heavier.push_back(campaign.runs[i].at);
    heavier.back().load *= times;
  }
  const std::vector<Answer> again = ask(heavier);
  double log_ratio = 0;
  int channels = 0;
  for (const ChannelView& view : channel_views) {
    std::vector<double> as_given, otherwise;
    for (std::size_t i = 0; i < campaign.runs.size(); i += every) {
      const auto& measured = campaign.runs[i].*view.measured;
      const std::optional<TractionResult>&answer = answers[i].result, &heavy = again[i / every].result;
      if (!measured || !answer) continue;
      as_given.push_back(*measured - ((*answer).*view.predicted).value);
      if (heavy) otherwise.push_back(*measured - ((*heavy).*view.predicted).value);
    }
    if (as_given.size() < fewest_to_compare || 2 * otherwise.size() < as_given.size()) continue;
    log_ratio += std::log(root_mean_square(otherwise) / root_mean_square(as_given)), ++channels;
  }
  return channels > 0 ? std::exp(log_ratio / channels) : 1.0;
}

/// Loads in kilograms, pounds or kilonewtons under a heading that says newtons, and the like.
void add_loads_in_another_unit(const Campaign& campaign, const std::vector<Answer>& answers, const AskAgain& ask,
                               Warnings& warnings) {
  constexpr double clearly = 0.5;
  constexpr std::pair<const char*, const char*> units[] = {{"kg", "1 kgf"}, {"lbf", "1 lbf"}, {"kN", "1 kN"}};
  double least = clearly;
  std::string words;
  const DataColumn column = column_of(campaign, "load");
  for (const auto& [unit, one] : units) {
    const double newtons = read_quantity(one, {"N", above_zero});
    if (const double error = error_with_loads(newtons, campaign, answers, ask); error < least) {
      least = error;
      words = fmt::format(
          "{}column '{}' looks as if it were in {}: with loads {:.4g} times as large the prediction "
          "fits far better; look at its unit",
          place_of(column), clipped(column.header), unit, newtons);
    }
  }
  if (!words.empty()) warnings.push_back(words);
}

}  // namespace

std::vector<std::string> column_doubts(const Campaign& campaign, const std::vector<Answer>& answers,
                                       const AskAgain& ask) {
  Warnings warnings;
  add_flipped_pull(campaign, answers, warnings);
  add_swapped_channels(campaign, answers, warnings);
  add_swapped_load(campaign, answers, ask, warnings);
  add_loads_in_another_unit(campaign, answers, ask, warnings);
  return warnings;
}

}  // namespace soilbin::compare
