// Large campaigns: runs that lie near each other taken as one, so that the search for candidates costs the same on two
// thousand runs as on two hundred.
#pragma once

#include <optional>
#include <vector>

#include "compare/fit/fitted_model.hpp"

namespace soilbin::compare {

/// Deals rows to groups of rows that lie near each other, at most so many, of one pass each. Groups are halved at the
/// mean of the variable in which they scatter most, in sd of the campaign, the widest group first. Deterministic.
std::vector<std::vector<int>> near_rows(const Observations& observations, int most_groups);

/// The base model beside runs pooled to at most `most_rows`; nothing where no soil carries the wheel at their means.
///
/// A group stands at the mean of its conditions, and its value in a channel is what the base model predicts there plus
/// the mean residual of its k cells, with noise of sd/sqrt(k). So to first order in the spread of a group's conditions
/// chi2 between two models differs as it does on all runs; what the means hide is kept beside (Dataset::within_pools).
/// What is fitted so is where a fit of all runs starts, never an answer.
///
///     const auto small = pooled(base, thresholds::max_searched_rows);
///     small->data().observations.rows.size();   // that or less, of any number
std::optional<FittedModel> pooled(const FittedModel& base, int most_rows);

}  // namespace soilbin::compare
