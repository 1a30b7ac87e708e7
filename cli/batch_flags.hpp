// The flags --ask, --batch, --shard and --tell, by which a command has its experiments made elsewhere: it writes a
// batch of those that it needs next, any number of processes make them, and it learns from their results.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "compare/calibrate/experiment_store.hpp"

namespace soilbin::cli {

/// --ask N --batch FILE writes the next experiments; --batch FILE --shard K/N makes its part of them, into a store of
/// its own; --tell STORE... takes these.
struct BatchFlags {
  int ask = 0;
  std::string batch, shard;
  std::vector<std::string> tell;

  void add_to(CLI::App& command);
  bool asks() const { return ask > 0; }
  bool answers() const { return ask == 0 && !batch.empty(); }
  Writers writers() const { return answers() ? Writers::one : Writers::several; }
  /// Throws InputError where a flag is missing beside another; `store`: the file named by --store.
  void check(const std::string& store) const;

  /// Takes the stores that --tell names.
  void learn(compare::ExperimentStore& store) const;
  /// Writes what the test waits for as the batch; gives the exit status.
  int write(const compare::VirtualTest& test) const;
  /// Makes the shard's experiments of the batch that the store lacks; gives the exit status.
  int answer(const compare::VirtualTest& test, compare::ExperimentStore& store) const;
};

}  // namespace soilbin::cli
