// Means of samples that fluctuate, with errors that allow for samples following each other: they are not independent.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "scenario/estimate.hpp"

namespace soilbin {

/// One number of each sample.
template <class Sample, class Read>
std::vector<double> series_of(std::span<const Sample> samples, const Read& read) {
  std::vector<double> out;
  for (const Sample& sample : samples) out.push_back(read(sample));
  return out;
}

/// The autocorrelation time of a series in samples: 1 + 2 sum of rho(k), k up
/// to the first window that is at least six times the sum so far (Sokal 1997).
/// 1 where samples are independent, and for less than four samples.
double autocorrelation_time(std::span<const double> series);

/// Mean and its standard error by block averaging: blocks of four autocorrelation times, error = sqrt(variance of block
/// means/blocks). Where fewer than eight such blocks fit: the error of eight, or that by the autocorrelation time,
/// sqrt(variance tau/n) with the bias of short series put right to first order, where it is larger. Less than eight
/// samples: the plain error of the mean; one: 0.
Estimate mean_with_error(std::span<const double> series);

/// Mean of repeats that each tell an error, such as packings of one test; and its standard error: by how much the
/// repeats differ, or, where that is more, by what each one tells of itself (both over the root of their number). Few
/// repeats may agree by chance. A single one: itself; none: NaN.
Estimate mean_of_repeats(std::span<const Estimate> repeats);

/// The sample at which the start-up is best cut off: of all cuts in the first
/// half, the one that minimises the estimated variance of the mean of what is
/// left, sum (x - mean)^2/n^2, over means of five samples (MSER-5, White, Cobb and Spratt 2000).
std::size_t end_of_start_up(std::span<const double> series);

/// Difference of the means of the two halves over its standard error, from the halves' own errors by blocks alone;
/// around 1 where the series is steady. 0 for less than sixteen samples.
double drift_over_error(std::span<const double> series);

/// Slope of a straight line through the whole series over its standard error; and how far the mean of the last fifth
/// lies from that of the rest, over its own. Errors come from what fluctuates within fifths alone, so that a trend does
/// not hide in its own error. Around 1 where the series is steady, as drift_over_error; 0 for less than sixteen
/// samples.
double trend_over_error(std::span<const double> series);
double last_fifth_over_error(std::span<const double> series);

/// What is left of several series of one length once their start-up is cut off.
struct SteadyPart {
  std::size_t from = 0;  ///< the latest end_of_start_up of them
  double drift = 0;      ///< of what is left the largest drift_, trend_ and last_fifth_over_error
};
SteadyPart steady_part(const std::vector<std::vector<double>>& series);

}  // namespace soilbin
