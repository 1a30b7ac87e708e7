// How much each channel fluctuates in time within a run, in the median run of a campaign: unsteady runs stand out.
//
//   usual_scatter(campaign.runs, 0)   // of the drawbar pull, [N]; nothing where no run says it
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "compare/measured/campaign.hpp"

namespace soilbin::compare {

/// The upper median of some values, at least one.
inline double upper_median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Median over the runs of a channel's standard deviation in time [SI]; nothing where none does.
inline std::optional<double> usual_scatter(const std::vector<Run>& runs, std::size_t channel) {
  std::vector<double> scatters;
  for (const Run& run : runs)
    if (run.within_run_sd[channel]) scatters.push_back(*run.within_run_sd[channel]);
  return scatters.empty() ? std::nullopt : std::optional(upper_median(std::move(scatters)));
}

}  // namespace soilbin::compare
