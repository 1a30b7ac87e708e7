// Rows and columns of a campaign that are hardly meant: a part of the list of doubts (doubts.hpp).
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "compare/measured/campaign.hpp"
#include "compare/sweep/answers.hpp"

namespace soilbin::compare {

/// The model that gave the answers, asked at other conditions.
using AskAgain = std::function<std::vector<Answer>(const std::vector<OperatingCondition>&)>;

struct RowDoubt {
  std::optional<int> line;  ///< of the run in its file; none: of the whole column
  std::string words;
};

/// Rows that no wheel makes, that were copied, that were unsteady; a sinkage whose sign seems flipped.
std::vector<RowDoubt> row_doubts(const Campaign& campaign);

/// A pull whose sign seems flipped, and columns that seem swapped, by a model's answers, one a run.
std::vector<std::string> column_doubts(const Campaign& campaign, const std::vector<Answer>& answers,
                                       const AskAgain& ask);

}  // namespace soilbin::compare
