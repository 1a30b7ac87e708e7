#include "compare/recorded/run_list.hpp"

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

int share_of_work(const AskedRun& run) { return run.half_step ? 2 : 1; }

std::optional<int> whole_number(std::string_view text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

}  // namespace

std::vector<AskedRun> run_list(const std::vector<OperatingCondition>& conditions,
                               const std::vector<std::uint64_t>& packings, TestStep test) {
  const std::vector<OperatingCondition> sorted = sorted_once(conditions);
  std::vector<AskedRun> list;
  for (const std::uint64_t packing : packings)
    for (const OperatingCondition& at : sorted) list.push_back({at, packing});
  if (test == TestStep::no || list.empty()) return list;
  const OperatingCondition tested = hardest(sorted);
  const auto whole = std::ranges::find_if(list, [&](const AskedRun& run) { return alike(run.at, tested); });
  std::rotate(list.begin(), whole, whole + 1);
  list.insert(list.begin() + 1, {list.front().at, list.front().packing, true});
  return list;
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

std::vector<int> shard_numbers(const std::vector<AskedRun>& list, int of) {
  long total = 0, before = 0, number = 1;
  for (const AskedRun& run : list) total += share_of_work(run);
  std::vector<int> numbers;
  for (const AskedRun& run : list) {
    if (!run.half_step) number = before * of / total + 1;
    numbers.push_back(static_cast<int>(number));
    before += share_of_work(run);
  }
  return numbers;
}

std::vector<AskedRun> shard_of(const std::vector<AskedRun>& list, const Shard& shard) {
  const std::vector<int> numbers = shard_numbers(list, shard.of);
  std::vector<AskedRun> mine;
  for (std::size_t i = 0; i < list.size(); ++i)
    if (numbers[i] == shard.number) mine.push_back(list[i]);
  return mine;
}

const RecordedRun* find_run(const Record& record, const AskedRun& asked) {
  return find_run(asked.half_step ? record.half_step : record.runs, asked.at, asked.packing);
}

std::vector<AskedRun> missing_runs(const std::vector<AskedRun>& list, const std::vector<Record>& records) {
  std::vector<AskedRun> missing;
  for (const AskedRun& run : list)
    if (std::ranges::none_of(records, [&](const Record& r) { return find_run(r, run) != nullptr; }))
      missing.push_back(run);
  return missing;
}

std::string in_words(const AskedRun& run) {
  return fmt::format("{}, bed sample {}{}", in_words(run.at), run.packing, run.half_step ? ", half the time step" : "");
}

}  // namespace soilbin::compare
