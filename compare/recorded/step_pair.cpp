#include "compare/recorded/step_pair.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "compare/measured/channels.hpp"
#include "compare/sweep/varying.hpp"
#include "scenario/errors.hpp"

namespace soilbin::compare {
namespace {

constexpr std::array<std::size_t, 3> tested_channels = {0, 1, 2};  // pull, torque, sinkage

std::optional<std::array<double, 3>> difference_in_errors(const Answer& whole, const Answer& half) {
  if (!whole.result || !half.result) return std::nullopt;
  std::array<double, 3> differs{};
  for (const std::size_t c : tested_channels) {
    const Estimate &a = (*whole.result).*channel_views[c].predicted, &b = (*half.result).*channel_views[c].predicted;
    const double error = std::hypot(a.std_error, b.std_error);
    differs[c] = a.value == b.value ? 0.0 : (b.value - a.value) / error;
  }
  return differs;
}

}  // namespace

std::vector<StepPair> step_pairs(const Record& record) {
  std::vector<StepPair> pairs;
  for (const RecordedRun& half : record.half_step)
    if (const RecordedRun* whole = find_run(record.runs, half.answer.at, half.packing))
      pairs.push_back({whole, &half, difference_in_errors(whole->answer, half.answer)});
  return pairs;
}

bool agrees(const StepPair& pair) {
  return pair.differs && std::all_of(pair.differs->begin(), pair.differs->end(),
                                     [](double errors) { return std::abs(errors) <= step_alike; });
}

std::string in_words(const StepPair& pair) {
  std::string words =
      fmt::format("at {}, packing {}, half the time step ", in_words(pair.half->answer.at), pair.half->packing);
  if (!pair.differs)
    return words + fmt::format("has no answer to compare: {}",
                               pair.half->answer.result ? pair.whole->answer.error : pair.half->answer.error);
  words += "changes ";
  for (const std::size_t c : tested_channels) {
    const ChannelView& channel = channel_views[c];
    const Estimate &a = (*pair.whole->answer.result).*channel.predicted,
                   &b = (*pair.half->answer.result).*channel.predicted;
    words += fmt::format("{}{} by {:.3g} ± {:.2g} {} ({:.1f} errors)", c == 0 ? "" : ", ", channel.title,
                         (b.value - a.value) * channel.per_si, std::hypot(a.std_error, b.std_error) * channel.per_si,
                         channel.unit, std::abs((*pair.differs)[c]));
  }
  return words;
}

std::vector<std::string> step_doubts(const Record& record) {
  const std::vector<StepPair> pairs = step_pairs(record);
  const auto differing = std::find_if_not(pairs.begin(), pairs.end(), agrees);
  if (differing != pairs.end()) return {"the grains' answers depend on the time step: " + in_words(*differing)};
  if (!pairs.empty()) return {};
  return {
      "nobody tested whether the grains' answers depend on the time step: the record holds no run at half of it "
      "(soilbin run STUDY --model dem --record FILE --half-step yes makes one)"};
}

OperatingCondition hardest(const std::vector<OperatingCondition>& conditions) {
  if (conditions.empty()) throw InputError("no condition to test the time step at");
  const auto hardness = [](const OperatingCondition& at) {
    return std::tuple(at.load, std::abs(at.longitudinal_incline) + std::abs(at.transverse_incline), std::abs(at.yaw),
                      at.slip);
  };
  return *std::max_element(conditions.begin(), conditions.end(),
                           [&](const auto& a, const auto& b) { return hardness(a) < hardness(b); });
}

}  // namespace soilbin::compare
