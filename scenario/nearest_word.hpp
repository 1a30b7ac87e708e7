// "did you mean ...?": the right word nearest to a misspelt one, for error messages.
#pragma once

#include <string>
#include <vector>

namespace soilbin {

/// The right word nearest to a misspelt one (Damerau-Levenshtein distance, case ignored), or "" where none is near
/// enough to be meant (distance above a third of the word's length, at least 2, or as many as it has letters).
std::string nearest_word(const std::string& word, const std::vector<std::string>& right);

/// The right words that a word of the field means: "lug_height" for "grouser_height"; most often none.
std::vector<std::string> meant_words(const std::string& word, const std::vector<std::string>& right);

/// ", did you mean 'radius'?" for the end of a message, or "" where no word is near enough. A word of the field goes
/// before a misspelling: ", did you mean 'lug_height'?" for "grouser_height".
std::string did_you_mean(const std::string& word, const std::vector<std::string>& right);

/// The end of a message on a name that nothing has, as did_you_mean writes it. Where none is nearly spelt like it,
/// those that hold the most of its words, five at most: ", did you mean 'sandy-loam-wet'?" for "wet loam".
std::string did_you_mean_name(const std::string& name, const std::vector<std::string>& names);

/// "radius, width, lugs"; a word that is longer than any of ours is clipped, and more than 100 are counted.
std::string listed(const std::vector<std::string>& words);

/// "'rdius' is none of radius, width, did you mean 'radius'?"
std::string none_of(const std::string& word, const std::vector<std::string>& right);

}  // namespace soilbin
