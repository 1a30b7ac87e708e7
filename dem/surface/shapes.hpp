// Meshes of simple shapes. Lengths in metres. Frame of a wheel: its axle is y, x forward, z up, centre in the origin.
// Sizes that are not positive and finite are refused with InputError.
//
//   const TriangleMesh wheel = tire_surface(tire, {.edge = 0.01});  // with its lugs
//   const TriangleMesh lid = box({0.2, 0.1, 0.01});
#pragma once

#include <limits>
#include <string>

#include "dem/surface/triangle_mesh.hpp"
#include "scenario/tire.hpp"

namespace soilbin::dem {

/// No edge of a mesh need be longer: as coarse as the shape allows.
inline constexpr double any_edge = std::numeric_limits<double>::infinity();

/// Closed; centred in the origin, `size` along x, y, z. Each face is cut into cells of at most `edge`.
TriangleMesh box(const Vec3& size, double edge = any_edge);

/// Open; lies in z = 0, centred in the origin, normal +z; n x m rectangles of two triangles each.
TriangleMesh plate(double length_x, double length_y, int n, int m);

/// A smooth wheel, closed: a prism of `segments` >= 3 sides with its vertices on the radius, its cells at most `edge`
/// along the axle and on the sides. Its volume is width (n/2) r^2 sin(2 pi/n).
TriangleMesh smooth_wheel(double radius, double width, int segments, double edge = any_edge);

inline constexpr double usual_lug_angle = 0.5;  ///< of slanted bars to the axle where a tire tells none, chosen [rad]

/// How a tire is cut into triangles.
struct TireMeshing {
  double edge = 0.02;   ///< [m] target length of edges: cells round the tread, along the axle and on the sides
  std::string drawn{};  ///< file with the wheel as drawn, .stl or .obj, in place of all this; empty: none
};

/// The tread base is a cylinder of tire.radius and tire.width, its vertices on the radius. On it stand lugs.count bars
/// over the whole width, one of them centred at the top of the wheel: lugs.thickness between parallel sides, tops on
/// radius + lugs.height. Straight bars lie parallel to the axle. A chevron's two halves meet on the centre line, which
/// leads when the wheel rolls to +x; its section is the same at each y, turned back by |y| tan(angle)/radius, so the
/// thickness is measured along the circumference. Slanted bars are turned back by y tan(angle)/radius: their left end
/// (+y) trails. Staggered ones are a chevron whose halves to the right (y < 0) stand half a pitch further; a bar ends
/// in a face on the centre line. Closed. A smooth tire gives smooth_wheel with edges of at most
/// meshing.edge. Throws InputError where lugs.count or lugs.thickness are not known or the bars leave no gap.
/// Volume, as the edge goes to zero: width (pi R^2 + count (A(R + h) - A(R))), A(r) = s sqrt(r^2 - s^2) + r^2 asin(s/r)
/// with s half the thickness.
///
/// Where meshing.drawn names a file, the mesh in it (drawn_wheel.hpp).
TriangleMesh tire_surface(const Tire& tire, const TireMeshing& meshing = {});

}  // namespace soilbin::dem
