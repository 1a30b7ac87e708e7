// Virtual tests for a calibration (VirtualTest: parameters to vary; Target: measured numbers to reach), and the store
// that keeps finished experiments in a file, so that work that was stopped goes on where it was.
#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "compare/design/factor.hpp"
#include "scenario/estimate.hpp"
#include "scenario/file_lock.hpp"
#include "scenario/source_text.hpp"

namespace soilbin::compare {

// A virtual test: values of some contact parameters in, what a laboratory would measure out.

/// A number that was measured on the real soil and that a virtual test should give.
struct Target {
  std::string name;        ///< "friction_angle"
  Estimate measured;       ///< [SI], not 0; the error is the measurement's
  std::string unit = "-";  ///< in which people read it
};

/// What to vary, what to reach, and how to find out.
struct VirtualTest {
  std::string identity;  ///< a text of all that its answers follow from, beside factors and seed; keys the store
  std::vector<Factor> factors;
  std::vector<Target> targets;
  /// An estimate of each target at these values of the factors [SI]. seed: of the packing; another one is a repetition.
  /// Throws NoSolution where the values have no answer (the sample doesn't settle, the plane never slides).
  std::function<std::vector<Estimate>(const Eigen::VectorXd& values, std::uint64_t seed)> run;
  /// Called once what the last run gave is kept, where it is set.
  std::function<void()> on_saved{};
};

/// Throws InputError where a test can't be calibrated: no factor or target, bounds out of order, a target of 0.
void check(const VirtualTest& test);

/// One experiment: what was asked and what came of it.
struct Experiment {
  Eigen::VectorXd values;  ///< of the factors [SI]
  std::uint64_t seed = 1;
  std::vector<Estimate> results;  ///< of the targets; empty where it failed
  std::string error;              ///< why it failed; empty where there are results
  double seconds = 0.0;           ///< of the clock on the wall
};

/// An experiment of a store, and whether a seal vouches for it: not for those from before there were seals.
struct StoredExperiment {
  Experiment experiment;
  bool sealed = true;
};

/// Experiments by everything that made them: the test's identity, its factors' and targets' names, the values to the
/// last bit, the seed. One JSON file (soilbin-experiments/1), written anew as a whole after each experiment. Several
/// processes may keep theirs in one file at once: each reads it again under the folder's lock before it writes.
class ExperimentStore {
 public:
  /// Reads the file where there is one. Without a path nothing is kept on disk. Throws InputError that names the file
  /// for one that is no store, and the place in it for
  /// an experiment that is damaged.
  explicit ExperimentStore(std::filesystem::path file = {}, Writers writers = Writers::several);

  /// The experiment; where there is none to the bit, one from an engine of other bits ("bed.version" of its identity).
  std::optional<Experiment> find(const VirtualTest& test, const Eigen::VectorXd& values, std::uint64_t seed) const;
  /// Keeps it beside what the file has by now, and writes the file. Throws std::runtime_error where that fails.
  void keep(const VirtualTest& test, const Experiment& experiment);
  /// Keeps the experiments of another store's file beside its own. Throws InputError that names the file where both
  /// have the same experiment with different results, and for what is no store.
  void take(const std::filesystem::path& other);
  std::size_t size() const;
  /// Number of this test's experiments that an engine of other bits made.
  std::size_t of_other_engines(const VirtualTest& test) const;
  /// Number of experiments that no seal vouches for.
  std::size_t unsealed() const;

 private:
  struct OfOneTest {
    std::string key;
    std::vector<StoredExperiment> experiments;
  };
  void read();
  void put(const std::string& key, const Experiment& experiment);
  std::string text() const;

  void add(const std::function<void()>& change);

  std::filesystem::path file_;
  Writers writers_;
  std::vector<OfOneTest> tests_;
};

/// The experiment of this question: from the store (second: true), or made now, timed and kept. NoSolution and results
/// that aren't finite become its error; what else the test throws goes through.
std::pair<Experiment, bool> experiment_at(const VirtualTest& test, const Eigen::VectorXd& values, std::uint64_t seed,
                                          ExperimentStore& store);

// Experiments that are asked for now and made elsewhere: a batch in a file, answered in shards, each into a store of
// its own, and learnt from by whoever asked.
//
//   try { map_failures(question_of(only_asking(test)), {.at_once = 8}); }
//   catch (const ExperimentsAsked& asked) { write(batch_text(test, asked.experiments)); }

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
