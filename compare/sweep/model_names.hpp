// Models as people call them, their effects by their titles (bekker_wong/effects/titles.hpp). Files, flags, JSON and
// CSV keep the ids.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace soilbin::compare {

/// "bekker_wong + slip_sinkage:ding" is "analytic wheel with slip sinkage (ding)", "dem" is "grains", "dem packing 2"
/// is "grains, bed sample 2". A label that somebody chose stays as it is, and so does one that is in words already.
std::string model_in_words(const std::string& label);

/// Calls the sides (anything with a label) in words; gives the labels that they had.
template <class Sides>
std::vector<std::string> call_in_words(Sides& sides) {
  std::vector<std::string> labels;
  for (auto& side : sides) {
    labels.push_back(side.label);
    side.label = model_in_words(side.label);
  }
  return labels;
}

/// The text with each of the labels that stands in it as a word of its own called in words.
std::string models_in_words(std::string text, const std::vector<std::string>& labels);

/// (name in words, label) of each label that a flag or a file spells otherwise than the page: once, where a reader
/// looks for what to type.
std::vector<std::pair<std::string, std::string>> names_and_ids(const std::vector<std::string>& labels);

}  // namespace soilbin::compare
