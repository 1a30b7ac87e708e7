// Which effects there are, as far as a reader must know. The semi-empirical model supplies it; the scenario floor
// never looks up at that model.
#pragma once

#include <string>
#include <vector>

namespace soilbin {

/// A parameter of an effect's form; values are SI.
struct EffectParameterWords {
  std::string name;
  std::string unit = "-";  ///< as in files
  double fallback = 0.0;
  double lower = 0.0;
  double upper = 0.0;
  std::string meaning;
};

/// One form of an effect.
struct EffectFormWords {
  std::string form;
  std::vector<EffectParameterWords> parameters;
};

/// Known effects, their forms and parameters.
struct EffectVocabulary {
  virtual ~EffectVocabulary() = default;
  /// Ids of the catalogue, each once.
  virtual std::vector<std::string> ids() const = 0;
  /// Forms of an id, the default form first; none for an unknown id.
  virtual std::vector<EffectFormWords> forms(const std::string& id) const = 0;
  /// Whether several forms of an id may act side by side, as learned effects do. Else a list holds an id once.
  virtual bool forms_add_up(const std::string& id) const = 0;
};

}  // namespace soilbin
