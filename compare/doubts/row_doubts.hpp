// Rows of a campaign that are hardly meant: a part of the list of doubts (doubts.hpp).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "compare/measured/campaign.hpp"
#include "compare/sweep/answers.hpp"

namespace soilbin::compare {

/// The model that gave the answers, asked at other conditions.
using AskAgain = std::function<std::vector<Answer>(const std::vector<OperatingCondition>&)>;

/// Rows that no wheel makes, that were copied, that were unsteady, channels whose sign seems flipped, and columns that
/// seem swapped. `answers`: a model's, one a run, which tell a flipped pull from an odd one. Those on one row begin
/// with its line.
std::vector<std::string> row_doubts(const Campaign& campaign, const std::vector<Answer>& answers, const AskAgain& ask);

}  // namespace soilbin::compare
