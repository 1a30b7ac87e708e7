// Rows of a campaign that seem mistaken (repeated, impossible, far from all others): a part of the list of doubts
// (doubts.hpp).
#pragma once

#include "compare/doubts/doubt.hpp"
#include "compare/measured/campaign.hpp"

namespace soilbin::compare {

/// Rows that are no runs, that no wheel makes, that were copied, that were unsteady; a sinkage whose sign seems
/// flipped. Without a line: of the whole column.
Doubts row_doubts(const Campaign& campaign);

}  // namespace soilbin::compare
