// Physical nonsense in a question that the readers rightly accept: possible, but hardly meant.
#pragma once

#include <string>
#include <vector>

#include "compare/measured/campaign.hpp"
#include "scenario/case.hpp"

namespace soilbin::compare {

/// Warnings about a soil by itself: values out of the usual, combinations that carry nothing.
std::vector<std::string> doubts(const SemiEmpiricalSoil& soil);

/// Warnings about a whole case: its soil, its wheel on this soil, each of its conditions (those alike once).
std::vector<std::string> doubts(const Case& question);

/// Warnings about a campaign: its soil, its runs.
std::vector<std::string> doubts(const Campaign& campaign);

}  // namespace soilbin::compare
