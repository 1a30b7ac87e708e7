// The errors of a model that was fitted: how its values, of the soil and of the effects, err together. Key `errors` of
// a model in a case file (docs/reference/case-files.md).
//
//   errors:
//     - {parameter: k_phi}                                           # its standard deviation stands with the soil
//     - {parameter: slip_sinkage.a, sd: 0.04, correlations: [-0.93]}  # with those above it
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenario/effect_vocabulary.hpp"
#include "scenario/mapping_reader.hpp"
#include "scenario/mapping_writer.hpp"

namespace soilbin {

/// A parameter of an effect, by its place in a list of effects.
struct EffectParameterPlace {
  std::size_t effect = 0;
  std::string parameter;
};

/// What "slip_sinkage.a" or, where several forms of an id act, "learned:torque_by_slip.c1" names among these effects;
/// nothing where none of them has that id and form. Whether the form has the parameter is not looked at.
std::optional<EffectParameterPlace> find_effect_parameter(const std::string& name,
                                                          const std::vector<EffectChoice>& effects);

/// The name of a parameter of effects[effect], such that find_effect_parameter() finds it.
std::string effect_parameter_name(const std::vector<EffectChoice>& effects, std::size_t effect,
                                  const std::string& parameter);

/// Correlation of the i-th with the k-th of a list: 1 of each with itself, symmetric, 0 where none is given.
double correlation(const std::vector<FittedError>& errors, std::size_t i, std::size_t k);

/// Correlation of two parameters by name; 0 where the list lacks one of them: it errs by itself.
double correlation(const std::vector<FittedError>& errors, const std::string& one, const std::string& other);

/// Whether these are the correlations of any set of numbers: no combination of them has a negative variance.
bool are_correlations(const std::vector<FittedError>& errors);

/// Refuses a parameter that neither the soil nor the effects have, one that is listed twice, an effect's without sd,
/// and correlations that no numbers have. `reading.n` is the soil's exponent.
std::vector<FittedError> read_fitted_errors(const YamlNode& list, const std::vector<EffectChoice>& effects,
                                            const EffectVocabulary& vocabulary, const Reading& reading);

/// Writes them so that read_fitted_errors gives the same to the bit; nothing for an empty list. n: the soil's exponent.
void write_fitted_errors(const std::vector<FittedError>& errors, const std::vector<EffectChoice>& effects,
                         const EffectVocabulary& vocabulary, std::optional<double> n, YamlLines& lines);

}  // namespace soilbin
