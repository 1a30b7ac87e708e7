// Inputs of a question that change no digit of any of its models' answers: a part of the list of doubts (doubts.hpp).
#pragma once

#include <string>
#include <vector>

#include "scenario/case.hpp"

namespace soilbin::compare {

/// Something that is declared and changes no digit.
struct UnusedInput {
  /// A key of a tire, a condition or a bin: "lugs", "lugs.count", "inflation_pressure", "pass", "bin"; "effect": an
  /// effect without such a value.
  std::string key;
  std::string words;  ///< why
};

/// What a case declares and its analytic models, or its grains, hear nothing of, and the effects that it switches on
/// whose condition it gives nowhere.
std::vector<UnusedInput> unused_inputs(const Case& question);

}  // namespace soilbin::compare
