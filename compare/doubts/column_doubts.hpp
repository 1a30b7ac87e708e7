// Columns of a campaign that seem mistaken (swapped, of the wrong sign, in another unit): a part of the list of doubts
// (doubts.hpp).
#pragma once

#include <functional>
#include <vector>

#include "compare/doubts/doubt.hpp"
#include "compare/measured/campaign.hpp"
#include "compare/sweep/answers.hpp"

namespace soilbin::compare {

/// The model that gave the answers, asked at other conditions.
using AskAgain = std::function<std::vector<Answer>(const std::vector<OperatingCondition>&)>;

/// Columns that a model's answers, one a run, fit far better once what may have been done to them is undone: a sign
/// flipped (pull, torque, lateral force, slip), numbers a power of ten too large or too small (channels), slips or
/// loads in another unit, two columns swapped. Each column is named once at most, with what fits best; the rest is
/// judged with that put right. Of more than 200 runs some are looked at, evenly.
Doubts column_doubts(const Campaign& campaign, const std::vector<Answer>& answers, const AskAgain& ask);

}  // namespace soilbin::compare
