// Calibration of contact parameters by virtual tests, after Zhou et al., section 3.2 (orthogonal design, range
// analysis, candidates near the target). Beyond the paper, a surrogate that knows its own error chooses further runs
// until the target is met with a stated probability. docs/theory/calibration.md has the maths.
//
//   ExperimentStore store("experiments.json");  // finished runs are not made again
//   const Calibration found = calibrate(test, {.within = 0.03, .probability = 0.9}, store);
//   found.reached, found.best.values            // of the test's factors [SI]
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "compare/calibrate/decision.hpp"
#include "compare/calibrate/experiment_store.hpp"
#include "compare/design/gaussian_process.hpp"
#include "compare/design/orthogonal_array.hpp"
#include "compare/recorded/watch.hpp"

namespace soilbin::compare {

enum class Stage {
  design,      ///< the orthogonal array
  candidates,  ///< points that the surrogate puts near the target, spread out
  refinement,  ///< the likeliest points, until one is good enough
};

/// An experiment, and why it was made.
struct CalibrationRun {
  Stage stage = Stage::design;
  Experiment experiment;
};

/// A point of the box and what is known of it.
struct Candidate {
  Eigen::VectorXd values;           ///< of the factors [SI]
  std::vector<Estimate> predicted;  ///< of each target, by the surrogates of all runs [SI]
  double chi_square = 0.0;          ///< sum over targets of (predicted - measured)^2/(both errors squared)
  double chance = 0.0;              ///< that every target is met within CalibrationOptions::within
  int runs = 0;                     ///< made at this very point
};

struct CalibrationOptions {
  std::string design = "L9";
  double near = 0.05;    ///< candidates lie within this share of each target (the paper's 5 %), or twice its tolerance
  double within = 0.03;  ///< the end: each target met within this share of it, or its own tolerance ...
  double probability = 0.90;  ///< ... with this probability
  int candidates = 4;         ///< at most
  int most_runs = 30;         ///< in all
  std::uint64_t seed = 1;     ///< of the packings' first, the cloud and the surrogates
  int cloud = 4096;           ///< points of the box that are looked at
  Watch watch{};              ///< of each run: "design: run 3 of at most 30"
  /// What another experiment, such as the soil bin, decides between the candidates: decide_in_soil_bin. Absent: the
  /// likeliest point that was run.
  std::function<Decision(const std::vector<Candidate>&)> decide{};
};

/// The design's analysis of one target.
struct TargetAnalysis {
  RangeAnalysis ranges;
  AnalysisOfVariance variance;
};

/// A finished calibration.
struct Calibration {
  std::vector<CalibrationRun> runs;
  std::vector<TargetAnalysis> analyses;  ///< a target each; empty where a run of the design failed
  std::vector<LeaveOneOut> held_out;     ///< a target each: the final surrogate's own test
  std::vector<double> extra_sd;          ///< a target each: scatter that the runs' own errors don't tell [SI]
  std::vector<Candidate> candidates;     ///< run, and still predicted near every target; the likeliest first
  std::optional<Decision> decision;      ///< between the candidates, where there are any and `decide` is given
  Candidate best;                        ///< chosen: by the decision, else the likeliest point that was run
  bool reached = false;                  ///< whether best.chance is at least the probability asked for
  std::vector<Estimate> parameters;      ///< of the factors, given the targets and a flat prior in the box [SI]
  std::vector<double> learned;       ///< 1 - sd of `parameters` over that of the flat prior: 0, the test says nothing
  Eigen::MatrixXd correlations;      ///< of `parameters`, a row and a column a factor [-]
  double smallest_chi_square = 0.0;  ///< over the cloud; large where no point of the box meets the targets
};

/// Runs the stages. Work found in the store isn't done again: the same test, options and store give the same answer
/// whether it was stopped in between or not. Throws InputError for a test or options that make no sense, NoSolution
/// where too many experiments fail to learn from the rest, and what `watch` throws. Where the test waits for
/// experiments, of the design, of the candidates, or of one refinement, the answer is empty.
Calibration calibrate(const VirtualTest& test, const CalibrationOptions& options, ExperimentStore& store);

/// "design", "candidates", "refinement".
std::string stage_name(Stage stage);

}  // namespace soilbin::compare
