// Several soils under one wheel as the picture that Gazebo's system LookupWheelSlip reads beside WheelSlip
// (gz::sim::systems::LookupWheelSlip, src/systems/lookup_wheel_slip in gazebosim/gz-sim, since Gazebo Jetty): red
// changes the lateral slip compliance, green the longitudinal one, blue both frictions,
//
//   value = max(0, nominal + (colour - 128) step),
//
// where the nominal compliances are those that WheelSlip has, and its frictions are 1.
//
//   const SlipMap map = slip_map(fit_on_sand, {clay, mud}, {.size = 10.0});  // [m]
//   write_file_atomically("map.png", rgb_png(picture_of(map)));
#pragma once

#include <array>
#include <string>
#include <vector>

#include "compare/export/packed_files.hpp"
#include "compare/export/wheel_slip.hpp"

namespace soilbin::compare {

/// What the two plugins have together for one place on the map.
struct MappedSlip {
  double lateral = 0.0;       ///< slip compliance [-]
  double longitudinal = 0.0;  ///< slip compliance [-]
  double friction = 0.0;      ///< in both directions: the map has one channel for it
};

struct SlipMapSoil {
  std::string soil;
  std::array<unsigned char, 3> colour{};  ///< red, green, blue
  MappedSlip fitted;                      ///< its friction is the longitudinal one
  double lateral_friction = 0.0;          ///< fitted; the map gives `fitted.friction` in its place
};

struct SlipMap {
  double size = 0.0;   ///< of the square on the ground, about the world's origin [m]
  int pixels = 0;      ///< along each side: the plugin takes the picture's height for its width
  MappedSlip nominal;  ///< of WheelSlip: the first soil's compliances, and a friction of 1
  MappedSlip step;     ///< a colour's step changes each by so much: what is read is off by half of it at most
  std::vector<SlipMapSoil> soils;  ///< in stripes of equal width along x, the first at the lowest x
};

struct SlipMapSize {
  double size = 10.0;  ///< [m]
  int pixels = 256;    ///< along each side
};

/// The map of one wheel's fits, a soil each, under one load. The steps are the smallest with which the colours 1 to 255
/// reach every soil. Throws InputError for no fit, fits of several wheels or loads, fewer pixels than soils, and a size
/// that is not above 0.
SlipMap slip_map(const std::vector<WheelSlipFit>& fits, const SlipMapSize& asked = {});

/// The map of a fit's soil and of others, each fitted in its place. Throws as wheel_slip_of, with the soil's name, and
/// as above.
SlipMap slip_map(const WheelSlipFit& first, const std::vector<Soil>& others, const SlipMapSize& asked = {});

/// What the plugins have where the map has this colour.
MappedSlip slip_at(const SlipMap& map, const std::array<unsigned char, 3>& colour);

/// The colours in rows from the largest y down, each from the lowest x up.
RgbPicture picture_of(const SlipMap& map);

}  // namespace soilbin::compare
