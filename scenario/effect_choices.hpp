// The `effects:` list of cases and campaigns.
#pragma once

#include <vector>

#include "scenario/effect_vocabulary.hpp"
#include "scenario/mapping_reader.hpp"
#include "scenario/mapping_writer.hpp"

namespace soilbin {

/// The words of a choice's form, the default one where it names none. Throws InputError for one that the vocabulary
/// lacks.
EffectFormWords form_of(const EffectChoice& choice, const EffectVocabulary& vocabulary);

/// Reads a list of effects: plain ids, or {id, form, parameters}. Form and parameters left out are filled in from the
/// vocabulary, so that what was assumed can be written out. `reading.n` is the soil's exponent.
/// Refused, with the nearest right word: unknown ids, forms and parameters; values without their unit or out of
/// bounds; an id listed twice.
std::vector<EffectChoice> read_effects(const YamlNode& list, const EffectVocabulary& vocabulary,
                                       const Reading& reading);

/// Writes them so that read_effects gives the same choices. Throws InputError for a choice that the vocabulary lacks.
void write_effects(const std::vector<EffectChoice>& effects, const EffectVocabulary& vocabulary,
                   std::optional<double> n, YamlLines& lines);

}  // namespace soilbin
