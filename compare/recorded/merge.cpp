#include "compare/recorded/merge.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <tuple>

#include "bekker_wong/effect_vocabulary.hpp"
#include "compare/recorded/run_list.hpp"
#include "scenario/case.hpp"
#include "scenario/errors.hpp"

namespace soilbin::compare {
namespace {

/// A run and the file that it came from.
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

void add(std::vector<FoundRun>& all, FoundRun fresh, bool half_step) {
  const auto known = std::ranges::find_if(
      all, [&](const FoundRun& one) { return answers(one.run, fresh.run.answer.at, fresh.run.packing); });
  if (known == all.end()) return all.push_back(std::move(fresh));
  if (answer_text(known->run) != answer_text(fresh.run))
    throw InputError(fmt::format(
        "{}: two answers to the same run:\n  {}\n  {}\n  hint: the same program gives the same bits on every machine; "
        "different sources may not. Leave out the file that is not to be trusted",
        in_words(AskedRun{fresh.run.answer.at, fresh.run.packing, half_step}), made_by(*known), made_by(fresh)));
  const auto rank = [](const RecordedRun& run) { return std::tuple(!run.sealed, run.source, run.seconds); };
  if (rank(fresh.run) < rank(known->run)) *known = std::move(fresh);
}

std::vector<RecordedRun> all_of(const std::vector<NamedRecord>& shards, RunList list) {
  std::vector<FoundRun> found;
  for (const NamedRecord& shard : shards)
    for (const RecordedRun& run : shard.record.*list) add(found, {&shard.file, run}, list == &Record::half_step);
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
                    "record show' tells which a record was begun with",
                    first.file.string(), other.file.string()));
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
  whole.runs = all_of(shards, &Record::runs);
  whole.half_step = all_of(shards, &Record::half_step);
  put_in_order(whole);
  return whole;
}

}  // namespace soilbin::compare
