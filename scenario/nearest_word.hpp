#pragma once

#include <string>
#include <vector>

namespace soilbin {

/// The right word nearest to a misspelt one (Damerau-Levenshtein distance, case ignored), or "" where none is near
/// enough to be meant (distance above a third of the word's length, at least 2).
std::string nearest_word(const std::string& word, const std::vector<std::string>& right);

}  // namespace soilbin
