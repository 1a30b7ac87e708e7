// How much each channel fluctuates in time within a run, in the median run of a campaign: unsteady runs stand out.
//
//   usual_scatter(campaign.runs, 0)   // of the drawbar pull, [N]; nothing where no run says it
#pragma once

#include <algorithm>
#include <array>
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

/// What runs tell of each channel beside its mean: &Run::within_run_sd or &Run::mean_error.
using ToldBeside = std::array<std::optional<double>, 4> Run::*;

/// Median over the runs of what they tell of a channel, by default its standard deviation in time [SI]; nothing where
/// none does.
inline std::optional<double> usual_scatter(const std::vector<Run>& runs, std::size_t channel,
                                           ToldBeside told = &Run::within_run_sd) {
  std::vector<double> scatters;
  for (const Run& run : runs)
    if ((run.*told)[channel]) scatters.push_back(*(run.*told)[channel]);
  return scatters.empty() ? std::nullopt : std::optional(upper_median(std::move(scatters)));
}

/// What tells how far a run's channel may be off beside other runs': errors of means where a run gives one, else
/// standard deviations in time.
inline ToldBeside best_told(const std::vector<Run>& runs, std::size_t channel) {
  return usual_scatter(runs, channel, &Run::mean_error) ? &Run::mean_error : &Run::within_run_sd;
}

}  // namespace soilbin::compare
