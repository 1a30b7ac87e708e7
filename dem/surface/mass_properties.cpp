#include "dem/surface/mass_properties.hpp"

#include <stdexcept>

namespace soilbin::dem {

MassProperties mass_properties(const TriangleMesh& mesh) {
  if (!mesh.closed()) throw std::logic_error(mesh.name() + ": an open mesh has no mass properties");
  const Vec3 o = 0.5 * (mesh.bounds().low + mesh.bounds().high);
  double volume = 0;
  Vec3 first, square, mixed;  // integrals of x, of (xx, yy, zz) and of (xy, yz, zx), from o
  for (int t = 0; t < mesh.size(); ++t) {
    const Vec3 a = mesh.corner(t, 0) - o, b = mesh.corner(t, 1) - o, c = mesh.corner(t, 2) - o, s = a + b + c;
    const double d = dot(a, cross(b, c));
    volume += d / 6;
    first += (d / 24) * s;
    square +=
        (d / 120) * Vec3{s.x * s.x + a.x * a.x + b.x * b.x + c.x * c.x, s.y * s.y + a.y * a.y + b.y * b.y + c.y * c.y,
                         s.z * s.z + a.z * a.z + b.z * b.z + c.z * c.z};
    mixed +=
        (d / 120) * Vec3{s.x * s.y + a.x * a.y + b.x * b.y + c.x * c.y, s.y * s.z + a.y * a.z + b.y * b.z + c.y * c.z,
                         s.z * s.x + a.z * a.x + b.z * b.x + c.z * c.x};
  }
  const Vec3 g = first / volume;
  square = square - volume * Vec3{g.x * g.x, g.y * g.y, g.z * g.z};
  mixed = mixed - volume * Vec3{g.x * g.y, g.y * g.z, g.z * g.x};
  return {volume, o + g, square.y + square.z, square.z + square.x, square.x + square.y, -mixed.x, -mixed.y, -mixed.z};
}

}  // namespace soilbin::dem
