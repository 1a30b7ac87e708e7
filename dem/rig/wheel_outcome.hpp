// What a run gives beside its result: power, the bed, its rut, and flow of the soil, as plain values that a record
// keeps.
#pragma once

#include <limits>
#include <vector>

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
  EnergyLosses losses;   ///< with Rig::ledger: where grains lost it
};

/// How dense the bed was before the wheel, in its core (BedReport). NaN where nobody told.
struct BedDensity {
  double void_ratio = std::numeric_limits<double>::quiet_NaN();    ///< volume of voids over volume of grains
  double bulk = std::numeric_limits<double>::quiet_NaN();          ///< [kg/m^3]
  double coordination = std::numeric_limits<double>::quiet_NaN();  ///< contacts a grain
};

/// How the run changed the bed's surface, seen from above: height after less height before. Cells are about a largest
/// radius wide; a cell's value stands at its middle.
struct Rut {
  double from = 0, to = 0;     ///< stretch behind the wheel over which `across` is a mean, x in the bin [m]
  double axle = 0;             ///< where the axle stood at the end, x in the bin [m]
  std::vector<double> y;       ///< from the middle of the track to the left [m]
  std::vector<double> across;  ///< change of height at each y [m]; empty where the wheel left no stretch behind it
  std::vector<double> x;       ///< along the bin [m]
  std::vector<double> along;   ///< change of height at each x, mean over the tire's width [m]
  double volume = 0;           ///< of the change, over the whole bin [m^3]: what the bed gained by loosening
  double heaped = 0, dug = 0;  ///< its parts above and below the old surface; volume = heaped - dug [m^3]
};

/// Mean velocity of the soil round the wheel, in the plane of the wheel's middle: cells of a mean grain's diameter that
/// travel with the axle. Means over the grains whose centres came into a cell in the second half of the way, by volume.
struct SoilFlow {
  double cell = 0;             ///< side of a cell [m]
  int nx = 0, nz = 0;          ///< cells along x and z
  double x = 0, z = 0;         ///< lower corner of the first cell, from the axle [m]
  std::vector<double> vx, vz;  ///< against the bin, x varying fastest [m/s]; NaN where no grain came
  std::vector<double> solid;   ///< mean volume of the grains with their centres in a cell, over the cell's
};

}  // namespace soilbin::dem
