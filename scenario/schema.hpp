// The file formats as JSON Schema (draft 2020-12), made from the same descriptions that the reader visits.
#pragma once

#include <nlohmann/json.hpp>

#include "scenario/case.hpp"

namespace soilbin {

/// Schema of soilbin-case/1. The vocabulary's ids, forms and parameters become its words.
nlohmann::ordered_json case_schema(const EffectVocabulary& effects);
/// Schema of soilbin-tire/1 and of soilbin-soil/1.
nlohmann::ordered_json tire_schema();
nlohmann::ordered_json soil_schema();

/// Schema of the `effects:` list, which cases and campaigns share.
nlohmann::ordered_json effects_schema(const EffectVocabulary& effects);

}  // namespace soilbin
