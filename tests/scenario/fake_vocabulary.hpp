// A small catalogue of effects, so that the scenario floor is tested without the model above it.
#pragma once

#include <string>
#include <vector>

#include "scenario/effect_vocabulary.hpp"

namespace soilbin::test {

struct FakeVocabulary : EffectVocabulary {
  bool forms_add_up(const std::string&) const override { return false; }
  std::vector<std::string> ids() const override {
    return {"slip_sinkage", "lug_thrust", "shear_hump", "exit_angle", "interface_limit"};
  }

  std::vector<EffectFormWords> forms(const std::string& id) const override {
    if (id == "slip_sinkage")
      return {{"lyasko", {{"a", "-", 1.0, 0.0, 1.6, "amplitude"}}}, {"reece", {{"h", "mm", 0.01, 0.0, 0.2, "length"}}}};
    if (id == "lug_thrust")
      return {{"blade", {{"share", "-", 1.0, 0.0, 2.0, "amplitude"}, {"angle", "deg", 0.5, 0.0, 1.5, "of the wedge"}}},
              {"passive_blade", {{"a", "-", 1.0, 0.0, 2.0, "amplitude"}}},
              {"tips", {{"lambda", "-", 0.5, 0.0, 2.0, "share"}}}};
    if (id == "shear_hump") return {{"carried", {{"a", "-", 3.0, 0.0, 6.0, "amplitude"}}}};
    if (id == "interface_limit") return {{"cap", {{"a", "-", 0.1, 0.0, 1.0, "amplitude"}}}};
    if (id == "exit_angle")
      return {{"rebound", {{"lambda", "-", 0.3, 0.0, 1.1, "share"}}},
              {"unloading", {{"k_u", "kN/m^(n+3)", 1000.0, 0.0, 1e12, "stiffness"}}}};
    return {};
  }
};

}  // namespace soilbin::test
