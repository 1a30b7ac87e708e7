#include "compare/recorded/run_specs.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "compare/recorded/step_pair.hpp"
#include "compare/sweep/varying.hpp"
#include "scenario/errors.hpp"

namespace soilbin::compare {
namespace {

std::vector<OperatingCondition> sorted_once(const std::vector<OperatingCondition>& conditions) {
  std::vector<OperatingCondition> kept;
  for (const OperatingCondition& at : conditions)
    if (std::ranges::none_of(kept, [&](const auto& known) { return alike(known, at); })) kept.push_back(at);
  std::ranges::sort(kept);
  return kept;
}

std::optional<int> whole_number(std::string_view text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

}  // namespace

std::vector<RunSpec> specs(const std::vector<OperatingCondition>& conditions,
                           const std::vector<std::uint64_t>& packings, TestStep test, Twins twins) {
  const std::vector<OperatingCondition> sorted = sorted_once(conditions);
  std::vector<RunSpec> all;
  for (const std::uint64_t packing : packings)
    for (const OperatingCondition& at : sorted) all.push_back({at, packing});
  if (all.empty()) return all;
  const std::vector<RunSpec> usual = all;
  if (test == TestStep::yes) {
    const OperatingCondition tested = hardest(sorted);
    const auto whole = std::ranges::find_if(all, [&](const RunSpec& spec) { return alike(spec.at, tested); });
    std::rotate(all.begin(), whole, whole + 1);
    all.insert(all.begin() + 1, {all.front().at, all.front().packing, RunKind::half_step});
  }
  if (twins == Twins::yes)
    for (const RunSpec& spec : usual) all.push_back({spec.at, spec.packing, RunKind::coarser});
  return all;
}

std::vector<RunSpec> missing_runs(const std::vector<RunSpec>& specs, const std::vector<Record>& records) {
  std::vector<RunSpec> missing = specs;
  std::erase_if(missing, [&](const RunSpec& spec) {
    return std::ranges::any_of(records, [&](const Record& record) { return find_run(record, spec) != nullptr; });
  });
  return missing;
}

Shard parse_shard(std::string_view text) {
  const std::size_t slash = text.find('/');
  const std::optional<int> number = whole_number(text.substr(0, slash));
  const std::optional<int> of = slash == text.npos ? std::nullopt : whole_number(text.substr(slash + 1));
  if (!number || !of || *of < 1 || *number < 1 || *number > *of)
    throw InputError(fmt::format(
        "--shard: expected K/N with K of 1 .. N, not '{}'\n  hint: --shard 2/4 is the second of four", text));
  return {*number, *of};
}

std::vector<int> shard_numbers(const std::vector<bool>& half_step, int of) {
  const long total = static_cast<long>(half_step.size()) + std::ranges::count(half_step, true);
  long before = 0, number = 1;
  std::vector<int> numbers;
  for (const bool half : half_step) {
    if (!half) number = before * of / total + 1;
    numbers.push_back(static_cast<int>(number));
    before += half ? 2 : 1;
  }
  return numbers;
}

}  // namespace soilbin::compare
