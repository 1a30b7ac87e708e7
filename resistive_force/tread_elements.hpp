// A wheel's surface as plane elements, for the sum of the forces on each.
//
//   const TreadElements elements = tread_elements(tire);
//   elements.all.size(), elements.pitch  // 5,000 or so; [rad] after which the lugs look alike
#pragma once

#include <string>
#include <vector>

#include "dem/surface/vec3.hpp"
#include "scenario/tire.hpp"

namespace soilbin::resistive_force {

using dem::Vec3;

/// Which part of the wheel an element belongs to.
enum class WheelPart { tread, lugs, sides };

struct Element {
  Vec3 place;         ///< of its centre, from the middle of the axle: x forward, y along the axle to the left, z up [m]
  Vec3 normal;        ///< out of the wheel
  double area = 0.0;  ///< [m^2]
  WheelPart part = WheelPart::tread;
};

struct TreadElements {
  std::vector<Element> all;
  double pitch = 0.0;  ///< the wheel looks alike after this turn [rad]; 0: smooth, after any
  int turns = 1;       ///< of that pitch, over which forces are averaged
};

/// Edge of the elements where nobody asks for another: a share of the tread's radius, and of a lug's height, at least
/// [-]. Halving both moves the channels by less than 1 % (wheel_test.cpp).
inline constexpr double edge_per_radius = 0.05;

/// The elements of a tire as soilbin draws it (dem/surface/shapes.hpp), a triangle each, edges of at most
/// edge_per_radius times `finer` of its radius. Throws InputError where a lugged tire's number or thickness of lugs
/// is not known.
TreadElements tread_elements(const Tire& tire, double finer = 1.0);

/// The elements of the wheel in a file (dem/surface/drawn_wheel.hpp), its triangles halved until no edge is longer than
/// edge_per_radius of the radius. Lugs that the tire counts are taken to be alike; without a count the whole turn is
/// averaged. Throws InputError as dem::read_wheel.
TreadElements drawn_elements(const std::string& file, const Tire& tire);

}  // namespace soilbin::resistive_force
