// Stage 2 of the loop: the noise of a campaign and the base model's fit, which need each other.
#pragma once

#include <cstdint>

#include "compare/fit/fitted_model.hpp"
#include "compare/fit/thread_pool.hpp"

namespace soilbin::compare {

/// How a campaign is read: from its noise to the choice of a candidate.
struct AttributionOptions {
  int simulations = 4000;  ///< of the maximum statistic
  std::uint64_t seed = 1;
  bool drop_outliers = true;
  ThreadPool pool = {};  ///< for signatures and fits; its pulse comes before each
};

/// Base fit and noise, in turn until they agree (four fits); outliers are set aside on the way. Fits start from the
/// declared soil and from soils drawn from its priors. Throws NoSolution where no soil near the declared one carries
/// the wheel in every run.
///
///     const FittedModel base = fit_base(campaign, observe(campaign), {});
///     base.data().noise.channels[drawbar_pull].sd(100.0);   // of a pull of 100 N [N]
FittedModel fit_base(const Campaign& campaign, const Observations& given, const AttributionOptions& options);

/// The noise estimated once more, beside another model in place of the base model: where an effect is large and the
/// smooth functions follow it badly, it counts as noise beside the base model.
NoiseFloor noise_beside(const FittedModel& model);

}  // namespace soilbin::compare
