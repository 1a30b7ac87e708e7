// What the soil bin decides between a calibration's candidates, as sentences, as columns beside these, as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "compare/calibrate/decision.hpp"

namespace soilbin::compare {

/// "(a)" for the first.
std::string candidate_name(std::size_t candidate);

/// What the soil bin says, what it can't tell apart, and what the errors don't hold. One string a sentence.
std::vector<std::string> decision_sentences(const Decision& decision);

/// Headings and a candidate's cells: the error of each channel that was measured, of all, and the verdict.
std::vector<std::string> decision_columns(const Decision& decision);
std::vector<std::string> decision_cells(const Decision& decision, std::size_t candidate);

/// All in SI; errors as shares of the load.
nlohmann::ordered_json to_json(const Decision& decision);

}  // namespace soilbin::compare
