#include "dem/surface/touching_points.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "dem/surface/closest_point.hpp"

namespace soilbin::dem {
namespace {

/// A local minimum of the distance. Plain numbers, so that a row of them costs nothing before it is filled.
struct Minimum {
  double x, y, z, squared_distance;
  int triangle, feature;

  Vec3 point() const { return {x, y, z}; }
  bool operator<(const Minimum& b) const {
    return squared_distance != b.squared_distance ? squared_distance < b.squared_distance : triangle < b.triangle;
  }
};

struct Minima {
  static constexpr int capacity = 32;
  int count, dropped;
  Minimum rows[capacity];
};

bool is_minimum(const TriangleMesh& mesh, int t, const ClosestPoint& closest, const Vec3& c, double slack) {
  if (closest.feature == ClosestPoint::face) return true;
  if (closest.feature < ClosestPoint::corner) {
    const EdgeLink& link = mesh.across(t, closest.feature);
    if (link.triangle < 0) return true;
    const TriangleFrame& other = mesh.frame(link.triangle);
    return dot(other.sides[link.edge], c) - other.side_offsets[link.edge] >= -slack;
  }
  const Vec3 to_centre = c - closest.point;
  for (const Vec3& u : mesh.directions(mesh.triangles()[t][closest.feature - ClosestPoint::corner])) {
    if (dot(u, to_centre) > slack) return false;
  }
  return true;
}

/// Not of unit length.
Vec3 outward(const TriangleMesh& mesh, const Minimum& m) {
  if (m.feature == ClosestPoint::face) return mesh.frame(m.triangle).normal;
  if (m.feature >= ClosestPoint::corner) {
    return mesh.vertex_normal(mesh.triangles()[m.triangle][m.feature - ClosestPoint::corner]);
  }
  const Vec3& own = mesh.frame(m.triangle).normal;
  const EdgeLink& link = mesh.across(m.triangle, m.feature);
  return link.triangle < 0 ? own : own + mesh.frame(link.triangle).normal;
}

/// How far c is before the surface, along its outward normal there; of the right sign, not to scale.
double before(const TriangleMesh& mesh, const Minimum& m, const Vec3& c) {
  if (m.feature == ClosestPoint::face) {
    const TriangleFrame& f = mesh.frame(m.triangle);
    return dot(f.normal, c) - f.offset;
  }
  return dot(outward(mesh, m), c - m.point());
}

/// Adds a minimum unless it coincides with an earlier one.
void add(const ClosestPoint& closest, int t, double slack, Minima& found) {
  const double same = 16 * slack * slack;  // (4 slack)^2: two that are each off by up to sqrt(2) slack
  Minimum* const end = found.rows + found.count;
  const auto coincides = [&](const Minimum& m) { return squared(m.point() - closest.point) <= same; };
  if (std::any_of(found.rows, end, coincides)) return;
  const Vec3& p = closest.point;
  const Minimum fresh{p.x, p.y, p.z, closest.squared_distance, t, closest.feature};
  if (found.count < Minima::capacity) {
    *end = fresh;
    ++found.count;
    return;
  }
  ++found.dropped;
  Minimum* const farthest = std::max_element(found.rows, end);
  if (fresh < *farthest) *farthest = fresh;
}

/// All local minima; of those that coincide, the first.
void find_minima(const TriangleMesh& mesh, std::span<const int> candidates, const Vec3& c, double radius, double slack,
                 Minima& found) {
  found.count = found.dropped = 0;
  ClosestPoint closest;
  int judged = -1;  // the last vertex that was closest: all triangles of a fan ask of the same one
  bool verdict = false;
  const auto is_one = [&](int t) {
    if (closest.feature < ClosestPoint::corner || closest.feature == ClosestPoint::face)
      return is_minimum(mesh, t, closest, c, slack);
    const int vertex = mesh.triangles()[t][closest.feature - ClosestPoint::corner];
    if (vertex != judged) judged = vertex, verdict = is_minimum(mesh, t, closest, c, slack);
    return verdict;
  };
  // Some at a time: first those whose ball is near, without branches to guess wrong.
  constexpr std::size_t at_a_time = 64;
  int near[at_a_time];
  while (!candidates.empty()) {
    const auto now = candidates.first(std::min(at_a_time, candidates.size()));
    candidates = candidates.subspan(now.size());
    int count = 0;
    for (const int t : now) {
      near[count] = t;
      count += mesh.ball(t).may_be_within(radius, c);
    }
    for (int k = 0; k < count; ++k) {
      const int t = near[k];
      if (closest_within(mesh, t, c, radius, closest) && is_one(t)) add(closest, t, slack, found);
    }
  }
}

TouchingPoint touching_point(const TriangleMesh& mesh, const Minimum& m, const Vec3& c, bool inside, double slack) {
  const double distance = std::sqrt(m.squared_distance);
  TouchingPoint touching{m.point(), {}, inside ? -distance : distance, m.triangle};
  if (m.feature == ClosestPoint::face) {
    const Vec3& normal = mesh.frame(m.triangle).normal;
    touching.normal = inside || before(mesh, m, c) >= 0 ? normal : -normal;
  } else if (distance > slack) {
    touching.normal = (c - touching.point) / touching.distance;
  } else {
    touching.normal = unit(outward(mesh, m));  // the centre lies on the edge: no direction of its own
  }
  return touching;
}

/// What a point counts in the normal of the deepest, with which it is one.
double share_of(const TouchingPoint& point, const TouchingPoint& deepest, double radius) {
  const double until_its_end = point.distance * (1 - dot(point.normal, deepest.normal));
  if (!(until_its_end > 0)) return 0;
  const double of_way = std::max(0.0, 1 - (point.distance - deepest.distance) / until_its_end);
  return of_way * point.overlap(radius) / deepest.overlap(radius);
}

}  // namespace

MergeAngle::MergeAngle(double angle) : cosine_(angle > 0 ? std::cos(angle) : 2.0) {
  if (!(angle >= 0 && angle <= std::numbers::pi / 2)) {
    throw std::invalid_argument("the angle that merges touching points must be from 0 to pi/2");
  }
}

void find_touching_points(const TriangleMesh& mesh, std::span<const int> candidates, const Vec3& centre, double radius,
                          const MergeAngle& merge, TouchingPoints& out) {
  out.count = out.dropped = 0;
  const double slack = 1e-9 * radius + mesh.rounding();
  Minima found;
  find_minima(mesh, candidates, centre, radius, slack, found);
  if (found.count == 0) return;

  Minimum* const end = found.rows + found.count;
  if (found.count > 1) std::sort(found.rows, end);
  if (mesh.closed() && before(mesh, found.rows[0], centre) < 0) {
    out.points[out.count++] = touching_point(mesh, found.rows[0], centre, true, slack);
    return;
  }
  out.dropped = found.dropped;
  std::array<Vec3, TouchingPoints::capacity> added;  // to their normals, by what is one with them
  for (const Minimum* m = found.rows; m < end; ++m) {
    if (mesh.closed() && m > found.rows && before(mesh, *m, centre) < 0) continue;
    const TouchingPoint touching = touching_point(mesh, *m, centre, false, slack);
    const auto parallel = [&](const TouchingPoint& other) {
      return dot(other.normal, touching.normal) > merge.cosine();
    };
    const auto* const deeper = std::find_if(out.begin(), out.end(), parallel);
    if (deeper != out.end()) {
      added[deeper - out.begin()] += share_of(touching, *deeper, radius) * touching.normal;
    } else if (out.count < TouchingPoints::capacity) {
      added[out.count] = {};
      out.points[out.count++] = touching;
    } else {
      ++out.dropped;
    }
  }
  for (int k = 0; k < out.count; ++k) {
    if (added[k] == Vec3{}) continue;
    TouchingPoint& one = out.points[k];
    const Vec3 mean = unit(one.normal + added[k]);
    one.distance *= dot(mean, one.normal);
    one.normal = mean;
    one.point = centre - one.distance * one.normal;
  }
}

}  // namespace soilbin::dem
