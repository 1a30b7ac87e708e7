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

/// (name in words, label) of each label that a flag or a file spells otherwise than the page: once, where a reader
/// looks for what to type.
std::vector<std::pair<std::string, std::string>> names_and_ids(const std::vector<std::string>& labels);

}  // namespace soilbin::compare
