// What a run tells beside its result: plain values that a record keeps.
#pragma once

#include "dem/engine/energy.hpp"

namespace soilbin::dem {

/// Powers, means over the steady part [W].
struct PowerBalance {
  double drive = 0;      ///< M w
  double pull = 0;       ///< F_DP v, in the frame of travel
  double climb = 0;      ///< lifts the load up the slope
  double heave = 0;      ///< lifts the load out of the soil; negative while the wheel sinks
  double into_soil = 0;  ///< given to the grains, counted step by step
  double rest = 0;       ///< drive less all these: what rounding and the products of fluctuations leave
  Ledger losses;         ///< with Rig::ledger: where grains lost it
};

}  // namespace soilbin::dem
