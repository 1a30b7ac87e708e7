// The catalogue of effects as the scenario floor's readers and writers need it.
#pragma once

#include "scenario/effect_vocabulary.hpp"

namespace soilbin::bekker_wong {

/// Ids, forms and parameters of effect_catalogue(), and of what the loop learned (learned.hpp).
class CatalogueVocabulary final : public EffectVocabulary {
 public:
  std::vector<std::string> ids() const override;
  std::vector<EffectFormWords> forms(const std::string& id) const override;
  bool forms_add_up(const std::string& id) const override;
};

}  // namespace soilbin::bekker_wong
