#include "dem/surface/mass_properties.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "dem/surface/positive.hpp"
#include "scenario/errors.hpp"

namespace soilbin::dem {
namespace {

constexpr double round = 2 * std::numbers::pi;

/// Integrals over a body of 1, of x, of (xx, yy, zz) and of (xy, yz, zx).
struct Moments {
  double volume = 0;
  Vec3 first, square, mixed;

  /// The share of an area of a surface at x with this normal.
  void add(const Vec3& x, const Vec3& normal, double area) {
    const double out = dot(x, normal) * area;
    volume += out / 3;
    first += (out / 4) * x;
    square += (out / 5) * Vec3{x.x * x.x, x.y * x.y, x.z * x.z};
    mixed += (out / 5) * Vec3{x.x * x.y, x.y * x.z, x.z * x.x};
  }
  /// Moments from o; about the centroid, the properties.
  MassProperties about_centroid(const Vec3& o) const {
    const Vec3 g = first / volume;
    const Vec3 s = square - volume * Vec3{g.x * g.x, g.y * g.y, g.z * g.z};
    const Vec3 m = mixed - volume * Vec3{g.x * g.y, g.y * g.z, g.z * g.x};
    return {volume, o + g, s.y + s.z, s.z + s.x, s.x + s.y, -m.x, -m.y, -m.z};
  }
};

template <class Visit>
void at_gauss_nodes(double from, double to, const Visit& visit) {
  using Rule = boost::math::quadrature::gauss<double, 20>;
  const double middle = (from + to) / 2, half = (to - from) / 2;
  for (std::size_t k = 0; k < Rule::abscissa().size(); ++k)
    for (const double side : {-1.0, 1.0}) visit(middle + side * half * Rule::abscissa()[k], half * Rule::weights()[k]);
}

/// A span of azimuths [rad].
using Arc = std::pair<double, double>;

/// What is hidden of a sphere by another: directions n with n . toward > beyond.
struct Cap {
  Vec3 toward;
  double beyond;

  /// Heights n.z at which its circle begins and ends, where it has one.
  void add_ends(std::vector<double>& heights) const {
    const double far = length(toward);
    if (std::abs(beyond) >= far) return;
    const double tilt = std::acos(std::clamp(toward.z / far, -1.0, 1.0)), opening = std::acos(beyond / far);
    for (const double end : {tilt - opening, tilt + opening}) heights.push_back(std::cos(end));
  }
  /// The azimuths that it hides at a height, from 0 on and below two turns.
  void add_hidden(double height, std::vector<Arc>& hidden) const {
    const double across = std::sqrt(1 - height * height) * std::hypot(toward.x, toward.y);
    const double least = beyond - height * toward.z;
    if (across <= least) return;
    if (-across >= least) return hidden.emplace_back(0, round), void();
    const double half = std::acos(least / across);
    const double begin = std::fmod(std::atan2(toward.y, toward.x) - half + 2 * round, round);
    hidden.emplace_back(begin, begin + 2 * half);
  }
};

std::vector<Cap> caps_on(std::span<const Sphere> spheres, std::size_t own) {
  std::vector<Cap> caps;
  const auto& [centre, r] = spheres[own];
  for (std::size_t k = 0; k < spheres.size(); ++k) {
    if (k == own) continue;
    const Vec3 toward = spheres[k].centre - centre;
    if (toward == Vec3{} && spheres[k].radius == r) throw InputError("two spheres of a clump are the same");
    caps.push_back({toward, (squared(toward) + r * r - spheres[k].radius * spheres[k].radius) / (2 * r)});
  }
  return caps;
}

/// Azimuths that no cap hides at a height.
std::vector<Arc> bare_arcs(const std::vector<Cap>& caps, double height) {
  std::vector<Arc> hidden, bare;
  for (const Cap& cap : caps) cap.add_hidden(height, hidden);
  std::sort(hidden.begin(), hidden.end());
  if (hidden.empty()) return {{0, round}};
  double reached = 0;  // arcs that go round beyond a turn hide the beginning
  for (const Arc& arc : hidden) reached = std::max(reached, arc.second - round);
  for (const Arc& arc : hidden) {
    if (arc.first > reached) bare.emplace_back(reached, arc.first);
    reached = std::max(reached, arc.second);
  }
  if (reached < round) bare.emplace_back(reached, round);
  return bare;
}

/// Adds the bare part of one sphere. The height runs as (3 t - t^3)/2 between the ends of circles, where arcs open as a
/// square root.
void add_bare(const Sphere& sphere, const std::vector<Cap>& caps, const Vec3& o, Moments& sum) {
  std::vector<double> ends{-1, 1};
  for (const Cap& cap : caps) cap.add_ends(ends);
  std::sort(ends.begin(), ends.end());
  for (std::size_t k = 1; k < ends.size(); ++k) {
    const double middle = (ends[k] + ends[k - 1]) / 2, half = (ends[k] - ends[k - 1]) / 2;
    const auto add_height = [&](double t, double weight) {
      const double height = middle + half * (3 * t - t * t * t) / 2, share = weight * half * 1.5 * (1 - t * t);
      const double across = std::sqrt(std::max(0.0, 1 - height * height));
      for (const Arc& arc : bare_arcs(caps, height))
        at_gauss_nodes(arc.first, arc.second, [&](double azimuth, double of_arc) {
          const Vec3 n{across * std::cos(azimuth), across * std::sin(azimuth), height};
          sum.add(sphere.centre - o + sphere.radius * n, n, share * of_arc * sphere.radius * sphere.radius);
        });
    };
    constexpr int panels = 16;
    for (int panel = 0; panel < panels; ++panel)
      at_gauss_nodes(-1 + 2.0 * panel / panels, -1 + 2.0 * (panel + 1) / panels, add_height);
  }
}

}  // namespace

MassProperties mass_properties(std::span<const Sphere> spheres) {
  Vec3 o;
  for (const Sphere& sphere : spheres) {
    if (!positive(sphere.radius)) throw InputError("a sphere's radius must be above 0");
    o += sphere.centre / static_cast<double>(spheres.size());
  }
  Moments sum;
  for (std::size_t k = 0; k < spheres.size(); ++k) add_bare(spheres[k], caps_on(spheres, k), o, sum);
  return sum.about_centroid(o);
}

PrincipalAxes principal_axes(const MassProperties& p) {
  const double small = 1e-9 * (p.xx + p.yy + p.zz);
  if (std::abs(p.xy) < small && std::abs(p.yz) < small && std::abs(p.zx) < small) return {{p.xx, p.yy, p.zz}, {}};
  Eigen::Matrix3d tensor;
  tensor << p.xx, p.xy, p.zx, p.xy, p.yy, p.yz, p.zx, p.yz, p.zz;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solved(tensor);
  Eigen::Matrix3d axes = solved.eigenvectors();
  if (axes.determinant() < 0) axes.col(0) *= -1;
  const Eigen::Vector3d& inertia = solved.eigenvalues();
  const Eigen::Quaterniond q(axes);
  return {{inertia.x(), inertia.y(), inertia.z()}, {q.w(), q.x(), q.y(), q.z()}};
}

MassProperties mass_properties(const TriangleMesh& mesh) {
  if (!mesh.closed()) throw std::logic_error(mesh.name() + ": an open mesh has no mass properties");
  const Vec3 o = 0.5 * (mesh.bounds().low + mesh.bounds().high);
  Moments sum;
  for (int t = 0; t < mesh.size(); ++t) {
    const Vec3 a = mesh.corner(t, 0) - o, b = mesh.corner(t, 1) - o, c = mesh.corner(t, 2) - o, s = a + b + c;
    const double d = dot(a, cross(b, c));
    sum.volume += d / 6;
    sum.first += (d / 24) * s;
    sum.square +=
        (d / 120) * Vec3{s.x * s.x + a.x * a.x + b.x * b.x + c.x * c.x, s.y * s.y + a.y * a.y + b.y * b.y + c.y * c.y,
                         s.z * s.z + a.z * a.z + b.z * b.z + c.z * c.z};
    sum.mixed +=
        (d / 120) * Vec3{s.x * s.y + a.x * a.y + b.x * b.y + c.x * c.y, s.y * s.z + a.y * a.z + b.y * b.z + c.y * c.z,
                         s.z * s.x + a.z * a.x + b.z * b.x + c.z * c.x};
  }
  return sum.about_centroid(o);
}

}  // namespace soilbin::dem
