// The catalogue's effects with their forms and parameters, as readers and writers of files ask for them, because
// scenario/ never includes the analytic model.
//
//   const Case question = read_case("rover.yaml", Library({"cases"}), CatalogueVocabulary());
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
