// Errors on conditions that neither the choice of the effect nor the fit has seen.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "compare/loop/identify.hpp"
#include "compare/sweep/answers.hpp"

namespace soilbin::compare {

/// One held-out cell: what base model and chosen model, both made without its condition, predicted.
struct HeldOut {
  int row = 0;  ///< of the observations given
  int channel = 0;
  double measured = 0.0, before = 0.0, after = 0.0;
  double smooth = 0.0;  ///< base model plus a smooth term without a name (smooth_term.hpp)
  double sd = 0.0;      ///< noise of this cell
};

struct ErrorPair {
  int cells = 0;
  double before = 0.0, after = 0.0, smooth = 0.0, noise_floor = 0.0;  ///< root mean squares
};

/// The whole procedure redone with each fold of conditions left out.
struct CrossValidation {
  std::vector<HeldOut> cells;
  std::vector<std::set<std::string>> chosen;      ///< of each fold
  std::array<ErrorPair, channel_count> channels;  ///< in the channels' units
  ErrorPair overall;                              ///< in sigma
  double gain = 0.0;                              ///< mean fall of the squared error over conditions [sigma^2]
  double gain_error = 0.0;                        ///< its standard error, over conditions
  int unpredicted = 0;                            ///< held-out cells for which a fold's model had no balance
};

/// Gain of one model over another in the ln density that they give to conditions left out, mean over conditions.
/// Densities include each model's own uncertainty, so that a bold extrapolation costs only what it claims to know.
struct PredictiveGain {
  double mean = 0.0;
  double std_error = 0.0;
  int conditions = 0;
};
PredictiveGain predictive_gain(const Campaign& campaign, const Identification& whole, const std::vector<Term>& terms,
                               const Fit& fit, const std::vector<Term>& over_terms, const Fit& over_fit, int folds,
                               std::uint64_t seed, const ThreadPool& pool = {});

/// Folds are made of whole conditions, dealt by a seeded shuffle. Steps from the noise estimate to the choice of the
/// effect are redone in each. with_model_discrepancy: choose by the reading in which the base model may be off by
/// itself, where there is one (model_discrepancy.hpp); errors before are those of the base model taken as exact, all
/// the same. noise: of the cells left out, in whose sd errors are told. threads: folds at once; the answer does not
/// depend on it. progress: folds done, called again and again from the calling thread alone; what it throws stops all
/// of them.
CrossValidation cross_validate(const Campaign& campaign, const Identification& whole, const NoiseFloor& noise,
                               bool with_model_discrepancy, const IdentifyOptions& options, int folds, int threads,
                               const Progress& progress = {});

}  // namespace soilbin::compare
