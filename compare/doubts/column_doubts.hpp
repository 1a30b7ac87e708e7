// Columns of a campaign that seem mistaken (swapped, of the wrong sign, in another unit): a part of the list of doubts
// (doubts.hpp).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "compare/measured/campaign.hpp"
#include "compare/sweep/answers.hpp"

namespace soilbin::compare {

/// The model that gave the answers, asked at other conditions.
using AskAgain = std::function<std::vector<Answer>(const std::vector<OperatingCondition>&)>;

/// A pull whose sign seems flipped, columns that seem swapped, loads that seem to be in another unit, by a model's
/// answers, one a run.
std::vector<std::string> column_doubts(const Campaign& campaign, const std::vector<Answer>& answers,
                                       const AskAgain& ask);

}  // namespace soilbin::compare
