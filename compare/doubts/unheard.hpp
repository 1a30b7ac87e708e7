// Inputs of a question that change no digit of any of its models' answers: a part of the list of doubts (doubts.hpp).
#pragma once

#include <string>
#include <vector>

#include "bekker_wong/effect.hpp"
#include "scenario/case.hpp"

namespace soilbin::compare {

/// Something that is declared and changes no digit.
struct Unheard {
  std::string key;  ///< "lugs", "inflation", "pass", "moisture", "position", "run"; "effect": one without such a value
  std::string words;  ///< why
};

/// What a case declares and its analytic models, or its grains, hear nothing of, and the effects that it switches on
/// whose condition it gives nowhere.
std::vector<Unheard> unheard(const Case& question);

/// Whether a form's answer hangs on this key of Unheard, or on the "speed". Where it is not given the form changes
/// nothing (of lugs it assumes some).
bool hears_of(const bekker_wong::EffectForm& form, const std::string& key);

}  // namespace soilbin::compare
