// Signs that the rows of a campaign are samples of a log and no runs. Samples of one run share its bed: counted as runs
// they make errors too small by many times, and a fit takes what one bed differs by for an effect.
//
//   if (!signs_of_a_log(campaign).empty()) ...  // no verdict holds beside one
#pragma once

#include "compare/doubts/doubt.hpp"
#include "compare/measured/campaign.hpp"

namespace soilbin::compare {

/// One, or none, on rows that look like samples, by the first of these (numbers chosen):
/// - an ignored column holds a clock with even steps, over 20 rows or more;
/// - rows on end have one run's number, three or more on average;
/// - ten rows or more on end are at one setpoint: in half of all rows, and in two setpoints or more unless they are
///   smooth;
/// - four rows or more on end are at one setpoint on average, 40 rows or more in all, and they are smooth;
/// - a hundred rows or more whose conditions hardly change from one to the next, twenty on end at like conditions.
/// Rows of one setpoint are smooth where their autocorrelation at lag 1, about each stretch's mean and over all
/// stretches, is more than 0.5 and four of its standard errors for independent rows, 1/sqrt(pairs) (Bartlett 1946).
/// And one on an ignored column that names several wheels.
Doubts signs_of_a_log(const Campaign& campaign);

}  // namespace soilbin::compare
