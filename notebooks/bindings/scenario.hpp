// Scenarios as questions, and their parts as Python may name them: effects ('slip_sinkage', 'slip_sinkage:lyasko' or an
// EffectChoice), tires and soils (of the library, or values).
#pragma once

#include <variant>

#include "notebooks/bindings/bindings.hpp"
#include "scenario/case.hpp"
#include "scenario/scenario.hpp"

namespace soilbin::python {

using EffectName = std::variant<EffectChoice, std::string>;
using TireName = std::variant<Tire, std::string>;
using SoilName = std::variant<Soil, std::string>;

/// Throws InputError with the nearest right word.
EffectChoice effect_of(const EffectName& named);
std::vector<EffectChoice> effects_of(const std::vector<EffectName>& named);
Tire tire_of(const TireName& named);
Soil soil_of(const SoilName& named);

// The attribute `effects` of what has some.
inline constexpr const char* effects_meaning = "ids or EffectChoice; assign a new list to change them";
template <class T>
std::vector<EffectChoice> effects_in(const T& of) {
  return of.effects;
}
template <class T>
void set_effects(T& of, const std::vector<EffectName>& effects) {
  of.effects = effects_of(effects);
}

void bind_library(py::module_& module);

}  // namespace soilbin::python
