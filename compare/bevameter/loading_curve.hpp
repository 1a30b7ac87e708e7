// Which readings of a plate test lie on its loading curve, and what the others are: spikes of a sensor, branches on
// which the plate was unloaded, reloaded or held, and a sinkage that stands still while the pressure rises.
//
//   const LoadingCurve loading = loading_curve({0.05, pressures, sinkages});   // in the order in which they were made
//   for (const AsideReadings& aside : loading.aside) fmt::print("{}\n", word(aside.why));
//
// Spikes are judged against the readings before and behind, as by Hampel's identifier (Davies and Gather 1993,
// J. Am. Stat. Assoc. 88:782), with the median step of the readings nearby in place of a deviation; unloading by its
// definition: the pressure falls and the plate goes no deeper than it was (Wong 2008, Theory of Ground Vehicles, 4th
// ed., 2.4).
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "bekker_wong/plate_fit.hpp"

namespace soilbin::compare {

enum class AsideWhy {
  sinkage_spike,   ///< the sinkage jumps and comes back
  pressure_spike,  ///< the pressure jumps and comes back
  end_spike,       ///< the first or the last readings lie off all the others
  unloading,       ///< unloaded, reloaded or held
  stuck,           ///< the pressure rises, and the sinkage does not
};

/// "sinkage_spike", ..: in JSON.
const char* word(AsideWhy why);

/// Readings of a test that follow each other and are not on its loading curve.
struct AsideReadings {
  AsideWhy why = AsideWhy::sinkage_spike;
  std::vector<std::size_t> readings{};  ///< places in the curve given, ascending
  double pressure = 0.0;                ///< where it starts [Pa]: of an unloading that from which the pressure falls
  double sinkage = 0.0;                 ///< and the sinkage there [m]
  /// k_u [Pa/m] of an unloading whose sinkage moves: slope of pressure over sinkage by least squares (Wong's p = p_u -
  /// k_u (z_u - z)).
  std::optional<double> unloading_stiffness{};
};

struct LoadingCurve {
  std::vector<std::size_t> readings;  ///< on it: places in the curve given, ascending
  std::vector<AsideReadings> aside;   ///< all others
};

/// Splits a test's readings, which stand in the order in which they were made. Smooth and monotone curves lose none.
LoadingCurve loading_curve(const bekker_wong::PlateCurve& test);

}  // namespace soilbin::compare
