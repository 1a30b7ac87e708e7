#include "compare/recorded/step_pair.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "compare/measured/campaign.hpp"
#include "compare/recorded/recorded_model.hpp"
#include "compare/sweep/varying.hpp"
#include "scenario/errors.hpp"

namespace soilbin::compare {
namespace {

std::optional<std::array<Estimate, 3>> difference_of(const Answer& whole, const Answer& half,
                                                     const std::array<double, 3>& factors) {
  if (!whole.result || !half.result) return std::nullopt;
  std::array<Estimate, 3> difference;
  for (const std::size_t c : channels_in_plane) {
    const Estimate &a = (*whole.result).*channel_views[c].predicted, &b = (*half.result).*channel_views[c].predicted;
    difference[c] = {b.value - a.value, factors[c] * std::hypot(a.std_error, b.std_error)};
  }
  return difference;
}

double in_errors(const Estimate& difference) {
  return difference.value == 0 ? 0.0 : std::abs(difference.value) / difference.std_error;
}

}  // namespace

std::vector<StepPair> step_pairs(const Record& record) {
  std::array<double, 3> factors{};
  bool widened = false;
  for (const std::size_t c : channels_in_plane) {
    const auto channel = channel_views[c].predicted;
    factors[c] = std::max(1.0, packing_factor(record, channel).value_or(usual_packing_factor(record.runs, channel)));
    widened |= factors[c] > 1;
  }
  std::vector<StepPair> pairs;
  for (const RecordedRun& half : record.half_step)
    if (const RecordedRun* whole = find_run(record, {half.answer.at, half.packing}))
      pairs.push_back({whole, &half, difference_of(whole->answer, half.answer, factors), widened});
  return pairs;
}

bool agrees(const StepPair& pair) {
  return pair.difference &&
         std::ranges::all_of(*pair.difference, [](const Estimate& of) { return in_errors(of) <= step_alike; });
}

std::string in_words(const StepPair& pair) {
  std::string words =
      fmt::format("at {}, bed sample {}, half the time step ", in_words(pair.half->answer.at), pair.half->packing);
  if (!pair.difference)
    return words + fmt::format("has no answer to compare: {}",
                               pair.half->answer.result ? pair.whole->answer.error : pair.half->answer.error);
  words += "changes ";
  for (const std::size_t c : channels_in_plane) {
    const ChannelView& channel = channel_views[c];
    const Estimate& of = (*pair.difference)[c];
    words += fmt::format("{}{} by {:.3g} ± {:.2g} {} ({:.1f} errors)", c == 0 ? "" : ", ", channel.title,
                         of.value * channel.per_si, of.std_error * channel.per_si, channel.unit, in_errors(of));
  }
  return words + (pair.widened ? "; the errors include the scatter between bed samples" : "");
}

Doubts step_doubts(const Record& record) {
  const std::vector<StepPair> pairs = step_pairs(record);
  const auto differing = std::find_if_not(pairs.begin(), pairs.end(), agrees);
  if (differing != pairs.end()) return {Doubt{DoubtKind::step_matters, {in_words(*differing)}}};
  if (!pairs.empty()) return {};
  return {Doubt{DoubtKind::step_untested}};
}

OperatingCondition hardest(const std::vector<OperatingCondition>& conditions) {
  if (conditions.empty()) throw InputError("no condition to test the time step at");
  const auto hardness = [](const OperatingCondition& at) {
    return std::tuple(at.load, std::abs(at.longitudinal_incline) + std::abs(at.transverse_incline), std::abs(at.yaw),
                      at.slip);
  };
  return *std::ranges::max_element(conditions, [&](const auto& a, const auto& b) { return hardness(a) < hardness(b); });
}

}  // namespace soilbin::compare
