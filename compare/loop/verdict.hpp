// From the best set of effects to a verdict: whether it stands on conditions left out, and what it leaves.
#pragma once

#include "compare/loop/loop.hpp"

namespace soilbin::compare {

/// Backward: an effect of the best set (LoopAnswer::details must have one) stays only if the set with it predicts
/// conditions left out better than the set without. Then what the set that stays gains over the base model, and what it
/// leaves.
void confirm(const Campaign& campaign, LoopAnswer& answer, const IdentifyOptions& options);

/// Whether the best set stands and what it leaves may be noise or its form's.
bool explains_all(const LoopAnswer& answer);

/// Verdict, reason, and the effects that are accepted or stand in.
void decide(const Campaign& campaign, LoopAnswer& answer);

/// The same for an unknown effect where the reading beside a base model that may be off by itself decides.
void decide_with_model_discrepancy(const Campaign& campaign, LoopAnswer& answer);

}  // namespace soilbin::compare
