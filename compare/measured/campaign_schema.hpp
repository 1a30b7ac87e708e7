// soilbin-campaign/1 as JSON Schema, made from the descriptions that the reader visits.
#pragma once

#include <nlohmann/json.hpp>

#include "scenario/effect_vocabulary.hpp"

namespace soilbin::compare {

/// Schema of campaign.yaml.
nlohmann::ordered_json campaign_schema(const EffectVocabulary& effects);

}  // namespace soilbin::compare
