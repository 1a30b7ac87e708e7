// The base model's fit and the noise floor, which need each other.
#pragma once

#include "compare/loop/identify.hpp"

namespace soilbin::compare {

/// Base fit and noise, in turn until they agree; outliers set aside on the way. Fills observations, outlier, noise,
/// whitening and base. Throws NoSolution where no soil near the declared one carries the wheel in every run.
void settle_base(const Campaign& campaign, const Observations& given, const IdentifyOptions& options,
                 Identification& id);

/// The noise estimated once more, beside a candidate in place of the base model: where an effect is large and the
/// smooth functions follow it badly, it counts as noise beside the base model.
NoiseFloor noise_beside(const Campaign& campaign, const Identification& id, const CandidateModel& candidate);

}  // namespace soilbin::compare
