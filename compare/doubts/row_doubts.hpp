// Rows of a campaign that seem mistaken (repeated, impossible, far from all others): a part of the list of doubts
// (doubts.hpp).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/measured/campaign.hpp"

namespace soilbin::compare {

struct RowDoubt {
  std::optional<int> line;  ///< of the run in its file; none: of the whole column
  std::string words;
  bool no_runs = false;  ///< the rows are samples, or of several wheels (measured/log_signs.hpp): no verdict holds
};

/// Rows that are no runs, that no wheel makes, that were copied, that were unsteady; a sinkage whose sign seems
/// flipped.
std::vector<RowDoubt> row_doubts(const Campaign& campaign);

}  // namespace soilbin::compare
