#include "compare/recorded/run_store.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "bekker_wong/effect_vocabulary.hpp"
#include "compare/recorded/step_pair.hpp"
#include "compare/report/number_text.hpp"
#include "compare/sweep/varying.hpp"
#include "scenario/atomic_file.hpp"
#include "scenario/case.hpp"
#include "scenario/errors.hpp"
#include "scenario/nearest_word.hpp"
#include "scenario/traction_channels.hpp"

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

namespace {

struct FoundRun {
  const std::filesystem::path* file;
  RecordedRun run;
};

/// A line of the record without what may differ between two makings of a run.
std::string answer_text(RecordedRun run) {
  run.seconds = 0, run.source.clear(), run.sealed = false;
  return run_text(run);
}

std::string made_by(const FoundRun& found) {
  return fmt::format("{} (made by {}, {:.0f} s)", found.file->string(), found.run.source, found.run.seconds);
}

void merge(std::vector<FoundRun>& all, FoundRun fresh, RunKind kind) {
  const RunSpec spec{fresh.run.answer.at, fresh.run.packing, kind};
  const auto known = std::ranges::find_if(all, [&](const FoundRun& one) { return answers(one.run, spec); });
  if (known == all.end()) return all.push_back(std::move(fresh));
  if (answer_text(known->run) != answer_text(fresh.run))
    throw InputError(fmt::format(
        "{}: two answers to the same run:\n  {}\n  {}\n  hint: the same program gives the same bits on every machine; "
        "different sources may not. Leave out the file that is not to be trusted",
        in_words(spec), made_by(*known), made_by(fresh)));
  const auto rank = [](const RecordedRun& run) { return std::tuple(!run.sealed, run.source, run.seconds); };
  if (rank(fresh.run) < rank(known->run)) *known = std::move(fresh);
}

std::vector<RecordedRun> all_of(const std::vector<NamedRecord>& shards, RunKind kind) {
  std::vector<FoundRun> found;
  for (const NamedRecord& shard : shards)
    for (const RecordedRun& run : shard.record.list(kind)) merge(found, {&shard.file, run}, kind);
  std::vector<RecordedRun> runs;
  for (FoundRun& one : found) runs.push_back(std::move(one.run));
  return runs;
}

/// The case of a record as it is written today: with the defaults of keys that came since. As it stands where it can't
/// be read.
std::string case_today(const NamedRecord& shard) try {
  const bekker_wong::CatalogueVocabulary effects;
  return write_case(parse_case({shard.file.string(), shard.record.question}, Library{}, effects), effects);
} catch (const InputError&) {
  return shard.record.question;
}

/// Throws InputError that names both files where they do not answer the same question.
void refuse_another_question(const NamedRecord& first, const NamedRecord& other) {
  refuse_other_inputs(other.record, first.record.inputs, other.file);
  if (other.record.model != first.record.model)
    throw InputError(fmt::format("{} holds answers of the model '{}', {} of '{}'", other.file.string(),
                                 other.record.model, first.file.string(), first.record.model));
  if (other.record.question != first.record.question && case_today(other) != case_today(first))
    throw InputError(
        fmt::format("{} and {} were begun with different cases\n  hint: all shards take the same study; 'soilbin "
                    "record show' shows which a record was begun with",
                    first.file.string(), other.file.string()));
}

/// The answer of a run in a line, for a person who has nothing else of it.
std::string in_a_line(const RunSpec& spec, const RecordedRun& run) {
  std::string line = in_words(spec) + ":";
  if (!run.answer.result) return line + " " + run.answer.error;
  for (const TractionChannel& channel : traction_channels) {
    const Estimate& value = (*run.answer.result).*channel.predicted;
    line += fmt::format(" {} {:.6g} ± {:.2g} {};", channel.title, value.value * channel.per_si,
                        value.std_error * channel.per_si, channel.unit);
  }
  return line.substr(0, line.size() - 1);
}

}  // namespace

Record merged(const std::vector<NamedRecord>& shards) {
  if (shards.empty()) throw InputError("no record to merge");
  Record whole = shards.front().record;
  for (const NamedRecord& other : shards) {
    refuse_another_question(shards.front(), other);
    if (other.record.question != whole.question) whole.question = case_today(other);
    whole.soilbin = std::min(whole.soilbin, other.record.soilbin);
    whole.sealed = whole.sealed && other.record.sealed;
  }
  for (const RunKind kind : run_kinds) whole.list(kind) = all_of(shards, kind);
  put_in_order(whole);
  return whole;
}

RunStore::RunStore(Record begin, std::filesystem::path file, Writers writers, const std::vector<NamedRecord>& known)
    : file_(std::move(file)),
      record_(std::move(begin)),
      kept_(
          file_, writers, [this] { read(); }, [this] { return record_text(record_); }) {
  kept_.look();
  for (const NamedRecord& other : known) {
    refuse_other_inputs(other.record, record_.inputs, other.file);
    known_.push_back(other.record);
  }
}

void RunStore::read() {
  Record there = read_record(file_);
  refuse_other_inputs(there, record_.inputs, file_);
  add_missing_runs(there, record_);  // without a lock another writer may have written over ours
  record_ = std::move(there);
}

bool RunStore::knows(const RunSpec& spec) const {
  return std::ranges::any_of(known_, [&](const Record& record) { return find_run(record, spec) != nullptr; });
}

const RecordedRun* RunStore::find(const RunSpec& spec) {
  for (const Record& record : known_)
    if (const RecordedRun* run = find_run(record, spec)) return run;
  if (const RecordedRun* run = find_run(record_, spec)) return run;
  kept_.look();
  return find_run(record_, spec);
}

void RunStore::add(const RunSpec& spec, const RecordedRun& run) {
  Record alone{record_.soilbin, record_.model, record_.question, record_.inputs, {}, {}, {}, record_.sealed};
  alone.list(spec.kind).push_back(run);
  try {
    kept_.add([&] { add_missing_runs(record_, alone); }, record_text(alone));
  } catch (const CannotWrite& error) {  // where its restart can't be written either, this is all that is left of it
    throw CannotWrite(fmt::format("{}\n  the run that is not in it: {}", error.what(), in_a_line(spec, run)));
  }
  if (!file_.empty() && run.on_saved) run.on_saved();
}

RecordedRun obtain(const RunSpec& spec, RunStore& store, const std::function<RecordedRun(const RunSpec&)>& make) {
  if (const RecordedRun* known = store.find(spec)) return *known;
  RecordedRun run = make(spec);
  store.add(spec, run);
  return run;
}

Table packings_table(const Record& record) {
  struct Line {
    std::size_t runs = 0, answers = 0, steady = 0;
    double seconds = 0;
  };
  std::map<std::uint64_t, Line> packings;
  for (const RecordedRun& run : record.runs) {
    Line& line = packings[run.packing];
    ++line.runs, line.seconds += run.seconds;
    line.answers += run.answer.result.has_value(), line.steady += run.answer.result && run.steady;
  }
  Table table{"", {"bed sample", "runs", "with a result", "steady", "seconds"}};
  for (const auto& [packing, line] : packings)
    table.add({std::to_string(packing), std::to_string(line.runs), std::to_string(line.answers),
               std::to_string(line.steady), fmt::format("{:.0f}", line.seconds)});
  return table;
}

std::string in_words(const NamedRecord& named) {
  const Record& record = named.record;
  std::set<std::string> sources;
  for (const RecordedRun& run : record.runs) sources.insert(run.source);
  std::string text = fmt::format("{}: {} by {}, {} at half the time step\nmade by   {} of soilbin {}\ninputs    {}\n{}",
                                 named.file.string(), counted(record.runs.size(), "run"), record.model,
                                 record.half_step.size(), listed({sources.begin(), sources.end()}), record.soilbin,
                                 inputs_key(record.inputs), as_text(packings_table(record)));
  if (!record.coarser.empty()) text += fmt::format("{} with coarser grains\n", counted(record.coarser.size(), "run"));
  for (const StepPair& pair : step_pairs(record)) text += in_words(pair) + "\n";
  return text;
}

}  // namespace soilbin::compare
