// A layer of grains on a rough incline: at which angles it comes to rest, how fast it flows, against published fits.
// Minutes each, but for thin and narrow layers, so these are no part of verification_rows().
//
// Units here: d = 1, m = 1, g = 1, a grain's diameter, its mass and gravity; time in sqrt(d/g).
#pragma once

#include <cstdint>
#include <functional>
#include <numbers>
#include <vector>

#include "dem/bed/work_options.hpp"
#include "dem/engine/simulation.hpp"
#include "dem/verification/cases.hpp"
#include "scenario/estimate.hpp"

namespace soilbin::dem {

/// One layer, and how long it is watched. Contacts are those of Weinhart, Thornton, Luding and Bokhove 2012, Granular
/// Matter 14:531, with base grains of the layer's own size, as the driver of that study in MercuryDPM has them: linear
/// springs, k_n = 2e5 m g/d, k_t = (2/7) k_n, dashpots of 25 m sqrt(g/d) along the normal and across, mu = 0.5, so e =
/// 0.88; after Silbert et al. 2001, Phys. Rev. E 64:051302. The driver's box is 20 d long and its step 1e-4.
struct InclineLayer {
  double angle = 24 * std::numbers::pi / 180;  ///< of the incline [rad], in (0, pi/2)
  double layers = 10;                          ///< grains a d^2 of the base, above 0
  double length = 10, width = 10;              ///< of the periodic box [d], above 2
  double base_from = 11;  ///< depth of the settled bed whose uppermost 1.7 d become the base [d], at least 3
  double longest = 500;   ///< [sqrt(d/g)], above 0
  double dt = 2e-4;       ///< [sqrt(d/g)]; an impact takes 5e-3
  std::uint64_t seed = 1;
  int threads = 1;
  std::function<void(double share)> watch{};  ///< each sqrt(d/g), with how much of `longest` is over; may throw to stop
};

/// What became of a layer.
struct InclineOutcome {
  /// Whether it came to rest: its kinetic energy, after 10 sqrt(d/g), fell below 1e-5 of that of the contacts' springs.
  bool rests = false;
  double time = 0;  ///< until then, or `longest` [sqrt(d/g)]
  /// Between 1 and 99 % of the weight, over 0.98 [d]; after Weinhart et al. 2012, who take the normal stress.
  double thickness = 0;
  /// Speed of the layer down the incline [sqrt(g d)], a mean over its steady part, with the error of block averages.
  Estimate speed;
  std::vector<double> speeds;  ///< of the layer, one each sqrt(d/g)
  double drift = 0;            ///< of the speed in that part, over its error; around 1 where the flow is steady
};

/// Pours a bed, holds a slice of it as base, pours a layer on it, tilts gravity. Throws InputError for values out of
/// range.
InclineOutcome run_incline(const InclineLayer& layer);

/// Two angles a step apart, of which a layer comes to rest at the lower one and flows at the higher one.
struct AngleOfRest {
  double rests = 0, flows = 0;  ///< [rad]
  double thickness = 0;         ///< of the layer at rest [d]
};

/// Finds them by halving between two angles that are a whole number of `step` [rad] apart and of which the lower one
/// rests and the higher one flows; layer.angle isn't read. Throws InputError where they don't.
AngleOfRest angle_of_rest(InclineLayer layer, double rests, double flows, double step);

/// The angle [rad] at which a layer of this thickness h [d] comes to rest, by the fit of Weinhart et al. 2012: h = A
/// (tan delta_2 - tan angle)/(tan angle - tan delta_1), delta_1 = 17.561 deg, delta_2 = 32.257 deg, A = 3.836.
double stopping_angle(double thickness);

/// Thin layers against the fit of h_stop, to the step of half a degree in which the publication's driver looked and
/// half of ours, half a degree too. A quarter of an hour on one core; `progress` may throw to stop.
std::vector<VerificationRow> incline_rows(std::uint64_t seed,
                                          const std::function<void(const Progress&)>& progress = {});

}  // namespace soilbin::dem
