// The rut that a wheel leaves: how it changed the bed's surface.
#pragma once

#include "dem/bed/bed_report.hpp"
#include "dem/bed/surface_height.hpp"
#include "dem/rig/wheel_outcome.hpp"

namespace soilbin::dem {

/// The surface of a whole bed, its points half the smallest radius apart.
SurfaceHeight bed_surface(const Grains& grains, const BedSize& size, double smallest_radius);

/// Where the wheel ran.
struct Track {
  double middle = 0, width = 0;  ///< y of its middle, the tire's width [m]
  double from = 0, to = 0;       ///< stretch behind the wheel, x [m]
  double axle = 0;               ///< x at the end [m]
};

/// The change between two surfaces of the same bed, in cells of about `cell`.
Rut rut_between(const SurfaceHeight& before, const SurfaceHeight& after, const Track& track, double cell);

}  // namespace soilbin::dem
