// Whose equation a form of an effect is.
#pragma once

#include <string>

#include "bekker_wong/effect.hpp"

namespace soilbin::bekker_wong {

enum class Provenance {
  published,  ///< as its source has it
  after,      ///< after a source: its shape as the literature quotes it, or taken further
  stated      ///< ours
};

/// By how the form's source begins: "after ...", "stated ..." or the source itself.
Provenance provenance_of(const EffectForm& form);

/// "published", "after a source", "ours"
std::string in_words(Provenance provenance);

}  // namespace soilbin::bekker_wong
