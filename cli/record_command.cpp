// soilbin record: what records of runs hold, what they lack, and several made one.
#include <fmt/core.h>

#include <memory>

#include "cli/commands.hpp"
#include "cli/flag_values.hpp"
#include "cli/outputs.hpp"
#include "cli/soil_bin.hpp"
#include "compare/recorded/run_store.hpp"
#include "compare/recorded/step_pair.hpp"
#include "compare/report/sealed_json.hpp"
#include "scenario/atomic_file.hpp"
#include "scenario/file_bytes.hpp"
#include "scenario/nearest_word.hpp"

namespace soilbin::cli {
namespace {

namespace fs = std::filesystem;

struct RecordOptions {
  std::string what;
  std::vector<std::string> names;
  SoilBinFlags expected;  ///< packings and the test of the time step
};

std::string names_expected(const RecordOptions& asked, const char* names) {
  return fmt::format("record {}: expected {}\n  hint: see soilbin record --help", asked.what, names);
}

/// Throws InputError for a place where there is anything but a record all of whose runs `whole` holds too: what is
/// there would be lost.
void refuse_other_runs(const std::string& out, const compare::Record& whole) {
  if (!is_there(out)) return;
  const std::string hint = "name the record to write first: soilbin record merge OUT.json SHARD.json...";
  compare::Record before;
  try {
    before = compare::read_record(out);
  } catch (const InputError&) {
    throw InputError({out}, "is there already, is no record, and stays as it is", "", hint);
  }
  for (const compare::RunKind kind : compare::run_kinds)
    for (const compare::RecordedRun& run : before.list(kind))
      if (const compare::RunSpec spec{run.answer.at, run.packing, kind}; compare::find_run(whole, spec) == nullptr)
        throw InputError(
            {out},
            fmt::format("holds a run that none of the others does ({}), and stays as it is", compare::in_words(spec)),
            "", hint);
}

int merge(const RecordOptions& asked) {
  if (asked.names.size() < 2) throw InputError(names_expected(asked, "OUT.json SHARD.json..."));
  std::vector<std::string> shards(asked.names.begin() + 1, asked.names.end());
  const compare::Record whole = compare::merged(read_records(shards));
  refuse_other_runs(asked.names.front(), whole);
  const std::string text = compare::record_text(whole);
  compare::need_readable_size(asked.names.front(), text);
  write_file_atomically(asked.names.front(), text);
  fmt::print("wrote {}: {}{} of {}\n", asked.names.front(), compare::counted(whole.runs.size(), "run"),
             whole.half_step.empty() ? "" : fmt::format(" and {} at half the time step", whole.half_step.size()),
             compare::counted(shards.size(), "record"));
  print_warnings(compare::step_doubts(whole));
  return done;
}

int show(const RecordOptions& asked) {
  if (asked.names.empty()) throw InputError(names_expected(asked, "RECORD.json..."));
  for (const compare::NamedRecord& record : read_records(asked.names)) {
    fmt::print("{}", compare::in_words(record));
    print_warnings(compare::step_doubts(record.record));
  }
  return done;
}

int missing(const RecordOptions& asked, const Session& session) {
  if (asked.names.size() < 2) throw InputError(names_expected(asked, "STUDY RECORD.json..."));
  const Case question = find_study(session.place, asked.names.front());
  std::vector<compare::Record> records;
  for (const auto& [file, record] : read_records({asked.names.begin() + 1, asked.names.end()})) {
    compare::refuse_other_grains(record, question.scenario, file);
    records.push_back(record);
  }
  const auto list =
      compare::specs(question, settings_of(asked.expected), asked.expected.packings, asked.expected.tests_step());
  const auto left = compare::missing_runs(list, records);
  for (const compare::RunSpec& run : left) fmt::print("{}\n", compare::in_words(run));
  fmt::print("{} of {} missing\n", left.size(), compare::counted(list.size(), "run"));
  return left.empty() ? done : unfinished;
}

/// Throws InputError for flags that are about the runs a study asks for.
void check_flags(const RecordOptions& asked, const CLI::App& command) {
  if (asked.what == "missing") return;
  for (const CLI::Option* option : command.get_options())
    if (!option->get_lnames().empty() && option->count() > 0)
      throw InputError(
          fmt::format("--{} is about the runs that are missing\n  hint: leave it out, or soilbin record "
                      "missing STUDY RECORD.json...",
                      option->get_lnames().front()));
}

int record(const RecordOptions& asked, const CLI::App& command, const Session& session) {
  check_flags(asked, command);
  if (asked.what == "merge") return merge(asked);
  if (asked.what == "show") return show(asked);
  if (asked.what == "missing") return missing(asked, session);
  const std::vector<std::string> right = {"merge", "show", "missing"};
  throw InputError("record: can't '" + clipped(asked.what) + "'" + did_you_mean(asked.what, right) +
                   "\n  hint: one of " + listed(right));
}

}  // namespace

void add_record(CLI::App& app, Session& session) {
  CLI::App* command = app.add_subcommand("record", "records of runs: merge several, show one, list what is missing");
  const auto asked = std::make_shared<RecordOptions>();
  add_value(*command, "what", asked->what, "WHAT", "merge, show or missing")->required();
  add_value(*command, "names", asked->names, "NAME",
            "merge: OUT.json SHARD.json...; show: RECORD.json...; missing: STUDY RECORD.json...");
  add_value(*command, "--packing", asked->expected.packing, "SEED", "missing: the first packing, 1");
  asked->expected.add_packings_to(*command);
  asked->expected.add_half_step_to(*command);
  asked->expected.add_coarser_twin_to(*command);
  command->footer(
      "merge: the same runs give the same bytes, in any order of the shards; a run that two hold with different "
      "answers\n"
      "is an error that names both. missing: status 3 where something is missing.\n"
      "Example: soilbin record merge whole.json shard-*.json");
  command->callback([=, &session] { session.action = [=, &session] { return record(*asked, *command, session); }; });
}

}  // namespace soilbin::cli
