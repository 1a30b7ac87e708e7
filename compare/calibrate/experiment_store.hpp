// Finished experiments, kept in a file, so that work that was stopped goes on where it was.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "compare/calibrate/virtual_test.hpp"
#include "scenario/file_lock.hpp"

namespace soilbin::compare {

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

}  // namespace soilbin::compare
