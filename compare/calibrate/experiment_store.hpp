// Virtual tests for a calibration (VirtualTest: parameters to vary; Target: measured numbers to reach), and the store
// that keeps finished experiments in a file, so that work that was stopped goes on where it was.
//
//   ExperimentStore store("experiments.json");
//   const std::optional<Experiment> one = obtain(test, {values, 1}, store);  // found there, or made and kept
#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compare/design/factor.hpp"
#include "compare/recorded/kept_file.hpp"
#include "scenario/estimate.hpp"
#include "scenario/source_text.hpp"

namespace soilbin::compare {

// A virtual test: values of some contact parameters in, what a laboratory would measure out.

/// A number that was measured on the real soil and that a virtual test should give.
struct Target {
  std::string name;        ///< "friction_angle"
  Estimate measured;       ///< [SI]; the error is the measurement's. Not 0 without a tolerance
  std::string unit = "-";  ///< in which people read it
  /// How far off still counts as met [SI]; none: a share of the value, CalibrationOptions::within.
  std::optional<double> tolerance{};
};

/// An experiment that is asked for: what it is found by beside its test.
struct ExperimentSpec {
  Eigen::VectorXd values;  ///< of the factors [SI]
  std::uint64_t seed = 1;  ///< of the packing; another one is a repetition
};

/// A virtual test: the factors to vary, the targets to reach, and the run that finds out.
struct VirtualTest {
  std::string identity;  ///< a text of all that its answers follow from, beside factors and seed; keys the store
  std::vector<Factor> factors;
  std::vector<Target> targets;
  /// An estimate of each target at these values of the factors [SI]. Throws NoSolution where the values have no answer
  /// (the sample doesn't settle, the plane never slides). Where it is empty, only what a store has is answered.
  std::function<std::vector<Estimate>(const Eigen::VectorXd& values, std::uint64_t seed)> run;
  /// Called once what the last run gave is kept, where it is set.
  std::function<void()> on_saved{};
  /// Where it is set, nothing is run: what the store lacks is listed here, to be made elsewhere, and whoever needs it
  /// stops, as soon as all is listed that is needed at once.
  std::shared_ptr<std::vector<ExperimentSpec>> asked{};

  bool waits() const { return asked && !asked->empty(); }
};

/// Throws InputError where a test can't be calibrated: no factor or target, bounds out of order, a target of 0.
void check(const VirtualTest& test);

/// One experiment: what was asked and what came of it.
struct Experiment : ExperimentSpec {
  std::vector<Estimate> results{};  ///< of the targets; empty where it failed
  std::string error{};              ///< why it failed; empty where there are results
  double seconds = 0.0;             ///< of the clock on the wall
  bool sealed = true;               ///< whether a seal in its file vouches for it: not from before there were seals
  bool from_store = false;          ///< whether it had been made before
};

/// Experiments by everything that made them: the test's identity, its factors' and targets' names, the values to the
/// last bit, the seed. One JSON file (soilbin-experiments/1). Several processes may keep theirs in one file at once:
/// each reads it again under the folder's lock before it writes (KeptFile).
class ExperimentStore {
 public:
  /// Reads the file where there is one. Without a path nothing is kept on disk. Throws InputError that names the file
  /// for one that is no store, and the place in it for an experiment that is damaged.
  explicit ExperimentStore(std::filesystem::path file = {}, Writers writers = Writers::several);

  /// The experiment; where there is none to the bit, one from an engine of other bits ("bed.version" of its identity).
  std::optional<Experiment> find(const VirtualTest& test, const ExperimentSpec& spec) const;
  /// Keeps it beside what the file has by now. Throws std::runtime_error where the file can't be written.
  void add(const VirtualTest& test, const Experiment& experiment);
  /// Keeps the experiments of another store's file beside its own. Throws InputError that names the file where both
  /// have the same experiment with different results, and for what is no store; nothing is taken then.
  void merge(const std::filesystem::path& other);
  std::size_t size() const;
  /// The flags of the commands that made it, by their names, so that its answers can be asked for again without them;
  /// empty where it does not tell.
  using Asked = std::map<std::string, std::string>;
  const Asked& asked() const { return asked_; }
  /// Tells those that the file does not tell yet, as a check that was asked for later; what it tells stays. A file with
  /// no experiment is begun with its first one. Throws std::runtime_error where the file can't be written.
  void tell_asked(Asked asked);
  /// Number of this test's experiments that an engine of other bits made.
  std::size_t of_other_engines(const VirtualTest& test) const;
  /// Number of experiments that no seal vouches for.
  std::size_t unsealed() const;
  /// The file's text.
  std::string text() const { return text_of(tests_, asked_); }

 private:
  using Tests = std::vector<std::pair<std::string, std::vector<Experiment>>>;
  static Tests parsed(const SourceText& source, Asked& asked);
  static std::string text_of(const Tests& tests, const Asked& asked);
  /// Puts an experiment beside the others; gives the one of its spec that is there then. What is known stays, but for
  /// an experiment without a seal that a sealed one confirms.
  static const Experiment& put(Tests& tests, const std::string& key, Experiment experiment);
  void read();

  std::filesystem::path file_;
  Asked asked_;
  Tests tests_;    ///< by their keys, in the order in which they came
  KeptFile kept_;  ///< last: goes first, and writes the tests
};

/// Whether a file says that it is a store of experiments.
bool is_experiment_store(const std::filesystem::path& file);

/// The experiment of a spec: the store's, or made now, timed and kept; nothing where the store lacks it and the test
/// makes none. NoSolution and results that aren't finite become its error; what else the test throws goes through.
std::optional<Experiment> obtain(const VirtualTest& test, const ExperimentSpec& spec, ExperimentStore& store);

// Experiments made elsewhere: a batch in a file, answered in shards, each into a store of its own, and learnt from by
// whoever asked.
//
//   test.asked = std::make_shared<std::vector<ExperimentSpec>>();
//   const Calibration found = calibrate(test, options, store);
//   if (test.waits()) write(batch_text(test, *test.asked));

/// soilbin-batch/1: values by the factors' names in SI, and which test they are of. Reading it gives the same bits.
std::string batch_text(const VirtualTest& test, const std::vector<ExperimentSpec>& batch);
/// Throws InputError for what is no batch, and for one of another test.
std::vector<ExperimentSpec> parse_batch(const SourceText& source, const VirtualTest& test);

}  // namespace soilbin::compare
