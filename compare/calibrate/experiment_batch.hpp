// Experiments that are asked for now and made elsewhere: a batch in a file, answered in shards, each into a store of
// its own, and learnt from by whoever asked.
//
//   try { map_failures(question_of(only_asking(test)), {.at_once = 8}); }
//   catch (const ExperimentsAsked& asked) { write(batch_text(test, asked.experiments)); }
#pragma once

#include <exception>
#include <string>
#include <vector>

#include "compare/calibrate/experiment_store.hpp"
#include "scenario/source_text.hpp"

namespace soilbin::compare {

struct AskedExperiment {
  Eigen::VectorXd values;  ///< of the factors [SI]
  std::uint64_t seed = 1;
};

/// Thrown where experiments are asked for that a store lacks and nobody is to make now.
struct ExperimentsAsked : std::exception {
  explicit ExperimentsAsked(std::vector<AskedExperiment> asked) : experiments(std::move(asked)) {}
  const char* what() const noexcept override { return "experiments are asked for"; }
  std::vector<AskedExperiment> experiments;
};

/// The test, whose run throws ExperimentsAsked in place of working.
VirtualTest only_asking(VirtualTest test);

/// Calls `ask` for each; what they ask for is asked together, once all were called.
template <class Items, class Ask>
void ask_together(Items&& items, const Ask& ask) {
  std::vector<AskedExperiment> asked;
  for (auto& item : items) try {
      ask(item);
    } catch (const ExperimentsAsked& more) {
      asked.insert(asked.end(), more.experiments.begin(), more.experiments.end());
    }
  if (!asked.empty()) throw ExperimentsAsked(std::move(asked));
}

/// soilbin-batch/1: values by the factors' names in SI, and which test they are of. Reading it gives the same bits.
std::string batch_text(const VirtualTest& test, const std::vector<AskedExperiment>& batch);
/// Throws InputError for what is no batch, and for one of another test.
std::vector<AskedExperiment> parse_batch(const SourceText& source, const VirtualTest& test);

}  // namespace soilbin::compare
