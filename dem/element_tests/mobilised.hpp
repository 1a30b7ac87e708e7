// Peak and residual strength of a measured curve that fluctuates.
#pragma once

#include <cstddef>
#include <span>

#include "scenario/estimate.hpp"

namespace soilbin::dem {

struct Mobilised {
  Estimate peak, residual;
  double peak_at = 0;             ///< place of the peak, the middle of its window
  std::size_t peak_from = 0;      ///< first sample of the peak's window
  std::size_t peak_samples = 1;   ///< number of samples in it
  std::size_t residual_from = 0;  ///< first sample of the residual part
};

/// The residual is the mean over the last `residual_share` of the way, its error from block averages
/// (mean_with_error). The peak is the highest mean over `window` of the way; its error is that of its window's mean,
/// at least the residual's. `way` rises evenly; both have the same length, at least 2.
Mobilised peak_and_residual(std::span<const double> way, std::span<const double> curve, double window,
                            double residual_share);

/// A stress that a test was to hold [Pa], as it was measured.
struct HeldStress {
  double at_peak = 0;      ///< mean over the peak's window
  double at_residual = 0;  ///< mean over the residual part
  double error = 0;        ///< the larger |mean/asked - 1| of the two
};

/// `curve`: the stress, a sample each, as many as the strength was found in.
HeldStress held_stress(std::span<const double> curve, const Mobilised& strength, double asked);

}  // namespace soilbin::dem
