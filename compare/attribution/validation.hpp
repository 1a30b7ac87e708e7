// Stage 6 of the loop: errors on conditions that neither the choice of the effect nor the fit has seen.
#pragma once

#include <array>
#include <set>
#include <string>
#include <vector>

#include "compare/attribution/candidates.hpp"
#include "compare/sweep/answers.hpp"

namespace soilbin::compare {

/// One held-out cell: what base model and chosen model, both made without its condition, predicted.
struct HeldOut {
  int row = 0;  ///< of the observations given
  int channel = 0;
  double measured = 0.0, before = 0.0, after = 0.0;
  double smooth = 0.0;  ///< base model plus a smooth term without a name (condition_functions.hpp)
  double named = 0.0;   ///< the chosen model without learned effects
  double sd = 0.0;      ///< noise of this cell
};

struct HeldOutErrors {
  int cells = 0;
  double before = 0.0, after = 0.0, named = 0.0, smooth = 0.0, noise_floor = 0.0;  ///< root mean squares
};

/// The whole procedure redone with each fold of conditions left out.
struct CrossValidation {
  std::vector<HeldOut> cells;                         ///< for which the fold's models have a balance
  std::vector<std::set<std::string>> chosen;          ///< of each fold
  std::array<HeldOutErrors, channel_count> channels;  ///< in the channels' units
  HeldOutErrors overall;                              ///< in sigma
  double gain = 0.0;                                  ///< mean fall of the squared error over conditions [sigma^2]
  double gain_error = 0.0;                            ///< its standard error, over conditions
};

/// What is redone in each fold, and how errors are expressed.
struct ValidationOptions {
  AttributionOptions attribution;
  bool with_model_discrepancy = false;  ///< choose with the base model's discrepancy, where that can be attributed;
                                        ///< errors before are those of the base model taken as exact, all the same
  bool use_candidate = true;            ///< the model whose error is asked for has the named effects that are chosen
  bool learn = false;  ///< beside the chosen model learned effects, looked for and accepted anew in each fold
  int folds = 5;
  int threads = 1;    ///< folds at once; the answer does not depend on it
  Progress progress;  ///< folds done, called again and again from the calling thread alone; may throw to stop
};

/// Folds are made of whole conditions, dealt by a seeded shuffle. Steps from the noise estimate to the choice of the
/// effects (choose) are redone in each; not the verdict: the choice is taken whether or not it would stand on the fewer
/// conditions. noise: of the cells left out, in whose sd errors are expressed.
CrossValidation cross_validate(const Dataset& whole, const NoiseFloor& noise, const ValidationOptions& options);

/// A validation as it would be without learned effects. whole: the observations that it is of.
CrossValidation errors_without_learned(CrossValidation validation, const Observations& whole);

/// A validation as it would be of the base model alone: nothing changes.
CrossValidation errors_of_base_alone(CrossValidation validation, const Observations& whole);

}  // namespace soilbin::compare
