// Stretches of rows at one setpoint: where the conditions of a log, or of rows in their order, stay what they are.
//
//   const std::vector<HeldSeries> held = {{slips, 0.02}, {loads, 4.0}};
//   stretch_starts(held, 0, slips.size());   // {0, 30, 60}: three setpoints of thirty rows
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace soilbin::compare {

/// A condition, row by row, and by how much it may differ within one setpoint.
struct HeldSeries {
  std::vector<double> values;  ///< all finite
  double tolerance = 0.0;      ///< > 0, in the unit of the values
};

/// By how much a condition may differ within a setpoint [SI] (chosen): slip 0.02, an angle 2 deg, moisture 0.01 by
/// mass, speeds and rotation a tenth of `typical`, all else a twentieth of it.
double setpoint_tolerance(std::string_view quantity, std::string_view unit, double typical);

/// Standard deviation of white noise that the steps from value to value show: their median over that of such noise. 0
/// for less than three values.
double noise_in_steps(const std::vector<double>& values);

/// The rows of first .. last - 1 at which a stretch begins, `first` the first of them. The partition makes the sum over
/// rows and series of (value - mean of its stretch)^2/tolerance^2, with 20 + 5 (number of series) more for each stretch
/// (chosen: white noise of the tolerance does not earn that), least: optimal partitioning, Jackson et al. 2005, IEEE
/// Signal Processing Letters 12:105. Of more than 2000 rows blocks are parted, and each end is then moved to its best
/// row.
std::vector<std::size_t> stretch_starts(const std::vector<HeldSeries>& series, std::size_t first, std::size_t last);

}  // namespace soilbin::compare
