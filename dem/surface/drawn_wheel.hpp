// A wheel as somebody drew it: read from a file, mended, turned so that its axle is y, in metres.
//
//   const DrawnWheel wheel = read_wheel("wheel.stl", tire);  // in the unit that makes it as large as the tire
//   wheel.mesh, wheel.unit.name, wheel.changes               // closed, [m]; "mm"; what was mended and moved, in words
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "dem/surface/mesh_mending.hpp"
#include "dem/surface/triangle_mesh.hpp"
#include "scenario/tire.hpp"

namespace soilbin::dem {

struct LengthUnit {
  const char* name;
  double metres;
};
/// The units that wheels are drawn in, the commonest first.
inline constexpr std::array<LengthUnit, 4> drawing_units = {{{"mm", 1e-3}, {"m", 1}, {"cm", 1e-2}, {"inch", 0.0254}}};

struct DrawnWheel {
  TriangleMesh mesh;                       ///< closed; axle along y, x forward, z up [m]
  LengthUnit unit;                         ///< of the drawing
  std::vector<std::string> other_units{};  ///< without a tire: in which it would be a wheel too
  char axle = 'y';                         ///< in the drawing
  Vec3 moved;                              ///< so that the middle of the axle is the origin [m]
  double radius = 0;                       ///< how far it reaches from its axle, to the tips of lugs [m]
  double left = 0, right = 0;              ///< from where to where it goes along its axle [m]
  double volume = 0;                       ///< within its outer surface [m^3]
  MeshMends mends;
  std::vector<Vec3> mended_at{};       ///< some of the places where slivers, doubled and split triangles were [m]
  std::vector<std::string> changes{};  ///< sentences: what was mended, turned and moved; empty: nothing

  double width() const { return right - left; }
};

/// The wheel in a file, .stl or .obj, in the unit that makes it as large as the tire: it reaches radius + lugs.height
/// to 2 % and is tire.width wide, half on either side of the middle, to 5 %. As drawn where its axle is the y axis
/// through the origin; else with its axle, along x or z, turned to y, or its middle moved to the origin, whichever fits
/// first. x stays forward where the axle was z, and is the drawing's -y where it was x. Throws InputError where none
/// fits, and what read_triangles and mended throw.
DrawnWheel read_wheel(const std::filesystem::path& file, const Tire& tire);

/// Reads a drawing without a tire: the axle is the axis of the roundest turn of the wheel, y where there is
/// little between them, and the unit, where none is given, the first of drawing_units that makes the radius 10 mm to 3
/// m. Throws InputError where none does.
DrawnWheel read_wheel(const std::filesystem::path& file, std::optional<LengthUnit> unit);

}  // namespace soilbin::dem
