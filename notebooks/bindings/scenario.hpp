// Scenarios as questions, and effects as Python may name them: 'slip_sinkage', 'slip_sinkage:lyasko' or an
// EffectChoice.
#pragma once

#include <variant>

#include "notebooks/bindings/bindings.hpp"
#include "scenario/case.hpp"
#include "scenario/scenario.hpp"

namespace soilbin::python {

using EffectName = std::variant<EffectChoice, std::string>;

/// Throws InputError with the nearest right word.
EffectChoice effect_of(const EffectName& named);
std::vector<EffectChoice> effects_of(const std::vector<EffectName>& named);

/// The analytic model's question about a scenario, without conditions.
Case question_of(const Scenario& scenario);

void bind_library(py::module_& module);

}  // namespace soilbin::python
