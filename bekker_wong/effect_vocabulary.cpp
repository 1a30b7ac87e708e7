#include "bekker_wong/effect_vocabulary.hpp"

#include "bekker_wong/effect.hpp"
#include "bekker_wong/learned.hpp"

namespace soilbin::bekker_wong {

std::vector<std::string> CatalogueVocabulary::ids() const {
  std::vector<std::string> all = effect_ids();
  all.emplace_back(learned_id);
  return all;
}

bool CatalogueVocabulary::forms_add_up(const std::string& id) const { return id == learned_id; }

std::vector<EffectFormWords> CatalogueVocabulary::forms(const std::string& id) const {
  std::vector<EffectFormWords> forms;
  for (const EffectForm& form : id == learned_id ? learned_forms() : effect_catalogue()) {
    if (form.id != id) continue;
    EffectFormWords words{form.form, {}};
    for (const EffectParameter& p : form.parameters)
      words.parameters.push_back({p.name, p.unit, p.fallback, p.lower, p.upper, p.meaning});
    forms.push_back(std::move(words));
  }
  return forms;
}

}  // namespace soilbin::bekker_wong
