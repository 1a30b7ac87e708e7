// Effects as Python may name them: 'slip_sinkage', 'slip_sinkage:lyasko' or an EffectChoice.
#pragma once

#include <variant>

#include "notebooks/bindings/bindings.hpp"
#include "scenario/scenario.hpp"

namespace soilbin::python {

using EffectName = std::variant<EffectChoice, std::string>;

/// Throws InputError with the nearest right word.
EffectChoice effect_of(const EffectName& named);
std::vector<EffectChoice> effects_of(const std::vector<EffectName>& named);

void bind_library(py::module_& module);

}  // namespace soilbin::python
