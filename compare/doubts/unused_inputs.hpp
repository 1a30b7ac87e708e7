// Inputs of a question that change no digit of any of its models' answers: a part of the list of doubts (doubts.hpp).
#pragma once

#include "compare/doubts/doubt.hpp"
#include "scenario/case.hpp"

namespace soilbin::compare {

/// What a case declares and its analytic models, or its grains, hear nothing of, and the effects that it switches on
/// whose condition it gives nowhere. Each says first the key of a tire, a condition or a bin: "lugs", "lugs.count",
/// "inflation_pressure", "pass", "bin"; but bin_depth_taken, which says the effect.
Doubts unused_inputs(const Case& question);

}  // namespace soilbin::compare
