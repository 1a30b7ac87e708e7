// Rows of a campaign that are hardly meant: a part of the list of doubts (doubts.hpp).
#pragma once

#include <string>
#include <vector>

#include "compare/measured/campaign.hpp"
#include "compare/sweep/answers.hpp"

namespace soilbin::compare {

/// Rows that no wheel makes, that were copied, that were unsteady, and channels whose sign seems flipped. `answers`: a
/// model's, one a run, which tell a flipped pull from an odd one. Those alike once (once_each).
std::vector<std::string> row_doubts(const Campaign& campaign, const std::vector<Answer>& answers);

}  // namespace soilbin::compare
