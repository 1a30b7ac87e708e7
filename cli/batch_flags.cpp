#include "cli/batch_flags.hpp"

#include <fmt/core.h>

#include "cli/commands.hpp"
#include "cli/flag_values.hpp"
#include "cli/progress.hpp"
#include "cli/soil_bin.hpp"
#include "compare/recorded/run_store.hpp"
#include "compare/report/number_text.hpp"
#include "compare/report/sealed_json.hpp"
#include "scenario/atomic_file.hpp"

namespace soilbin::cli {

void BatchFlags::add_to(CLI::App& command) {
  add_value(command, "--ask", ask, "N",
            "make nothing: write the next experiments, N chosen at once, to --batch and end with status 3; 0 when none "
            "is left")
      ->check(whole_number(1, 10'000));
  add_value(command, "--batch", batch, "FILE.json",
            "with --ask: the file to write; without: make its experiments, into --store");
  add_value(command, "--shard", shard, "K/N", "with --batch: only the K-th of N parts of it");
  add_value(command, "--tell", tell, "STORE.json", "first take the experiments of these stores into --store")
      ->allow_extra_args(true);
}

void BatchFlags::check(const std::string& store) const {
  if (asks() && batch.empty()) throw InputError("--ask needs a file for the experiments\n  hint: --batch FILE.json");
  if (!shard.empty() && !answers()) throw InputError("--shard is a part of a batch\n  hint: --batch FILE.json");
  if ((asks() || answers() || !tell.empty()) && store.empty())
    throw InputError("batches need a store to learn from, or to answer into\n  hint: --store FILE.json");
}

void BatchFlags::learn(compare::ExperimentStore& store) const {
  for (const std::string& file : tell) store.merge(file);
}

int BatchFlags::write(const compare::VirtualTest& test) const {
  clear_progress_line();
  write_file_atomically(batch, compare::batch_text(test, *test.asked));
  fmt::print("wrote {}: {} to be made\n", batch, compare::counted(test.asked->size(), "experiment"));
  return unfinished;
}

int BatchFlags::answer(const compare::VirtualTest& test, compare::ExperimentStore& store) const {
  std::vector<compare::ExperimentSpec> mine =
      compare::parse_batch(read_source_text(batch, compare::largest_json), test);
  if (!shard.empty()) mine = compare::shard_of(mine, compare::parse_shard(shard));
  try {
    for (std::size_t k = 0; k < mine.size(); ++k) {
      if (interrupt_asked()) throw Interrupted();
      print_beside_progress(fmt::format("experiment {} of {}", k + 1, mine.size()));
      compare::obtain(test, mine[k], store);
    }
  } catch (const Interrupted&) {
    clear_progress_line();
    fmt::print(stderr, "{} in the store: the same command goes on from there\n",
               compare::counted(store.size(), "experiment"));
    return unfinished;
  }
  clear_progress_line();
  fmt::print("{} of the batch are in the store\n", compare::counted(mine.size(), "experiment"));
  return done;
}

}  // namespace soilbin::cli
