// What the best set of effects puts into the answer: effects with their errors, the soil refitted with them.
#pragma once

#include <vector>

#include "compare/loop/loop.hpp"

namespace soilbin::compare {

/// The campaign's soil with the values of a fit and their standard errors.
SemiEmpiricalSoil fitted_soil(const Campaign& campaign, const WheelPredictor& predictor, const Fit& fit);

/// The best candidate's effects; its soil and what its residual still depends on go into the answer.
std::vector<AcceptedEffect> take_best(const Campaign& campaign, LoopAnswer& answer);

/// p-value and separability of each accepted effect.
void describe_effects(const Campaign& campaign, LoopAnswer& answer, const IdentifyOptions& options);

}  // namespace soilbin::compare
