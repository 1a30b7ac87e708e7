#include "dem/engine/surface_contacts.hpp"

#include <array>

#include "dem/surface/touching_points.hpp"

namespace soilbin::dem {
namespace {

constexpr double cos_45 = 0.70710678118654752;

bool is_near(const Body& body, const Surface& surface, const Motion& grain, double margin) {
  const Vec3 centre = body.to_body(grain.position);
  if (const auto* plane = std::get_if<Plane>(&surface.shape))
    return dot(centre - plane->point, plane->normal) < grain.radius + margin;
  return !std::get<MeshSurface>(surface.shape).grid->around(centre).empty();
}

int touches_of_mesh(const Body& body, const MeshSurface& surface, const Motion& grain, double reach,
                    std::span<SurfaceTouch, 8> out) {
  static const MergeAngle merge;
  const Vec3 centre = body.to_body(grain.position);
  const auto candidates = surface.grid->around(centre);
  if (candidates.empty()) return 0;
  TouchingPoints points;
  find_touching_points(*surface.mesh, candidates, centre, grain.radius + reach, merge, points);
  int count = 0;
  for (const TouchingPoint& point : points) {
    const double overlap = point.overlap(grain.radius);
    const Vec3 normal = body.rotation(point.normal);
    out[count++] = {point.triangle, grain.position - (grain.radius - overlap / 2) * normal, normal, overlap, normal};
  }
  return count;
}

/// The one whose normal is nearest to this one, within 45 degrees; -1 for none.
template <class Contact>
int nearest(std::span<const Contact> among, const Vec3& normal) {
  double best = cos_45;
  int which = -1;
  for (std::size_t k = 0; k < among.size(); ++k)
    if (const double near = dot(among[k].normal, normal); near > best) best = near, which = static_cast<int>(k);
  return which;
}

/// All points of a surface nearer to a grain's centre than its radius plus `reach`.
int find_touches(const PlacedSurface& surface, const Motion& grain, double reach, std::span<SurfaceTouch, 8> out) {
  if (surface.mesh) return touches_of_mesh(*surface.body, *surface.mesh, grain, reach, out);
  const double overlap = grain.radius - (dot(grain.position, surface.normal) - surface.offset);
  if (overlap <= -reach) return 0;
  out[0] = {-1, grain.position - (grain.radius - overlap / 2) * surface.normal, surface.normal, overlap,
            surface.normal};
  return 1;
}

/// The contact of before that touches[k] goes on with; nullptr for none.
const SurfaceContact* remembered(std::span<const SurfaceContact> before, std::span<const SurfaceTouch> touches, int k) {
  const int old = nearest(before, touches[k].normal);
  return old >= 0 && nearest(touches, before[old].normal) == k ? &before[old] : nullptr;
}

PlacedSurface place(const Body& body, const Surface& surface) {
  if (const auto* mesh = std::get_if<MeshSurface>(&surface.shape)) return {.body = &body, .mesh = mesh, .normal = {}};
  const Plane& plane = std::get<Plane>(surface.shape);
  const Vec3 normal = body.rotation(plane.normal);
  return {.body = &body, .normal = normal, .offset = dot(body.to_bin(plane.point), normal)};
}

}  // namespace

void add_near(std::span<const Body> bodies, const Motion& grain, std::uint32_t row, double margin,
              std::vector<NearSurface>& near) {
  for (std::size_t b = 0; b < bodies.size(); ++b)
    for (std::size_t s = 0; s < bodies[b].surfaces.size(); ++s)
      if (is_near(bodies[b], bodies[b].surfaces[s], grain, margin))
        near.push_back({row, static_cast<std::uint16_t>(b), static_cast<std::uint16_t>(s)});
}

std::vector<NearSurface> find_near(std::span<const Body> bodies, const Grains& grains, std::uint32_t first,
                                   std::uint32_t last, double margin) {
  std::vector<NearSurface> near;
  for (std::uint32_t grain = first; grain < last; ++grain)
    if (!grains.motion[grain].held()) add_near(bodies, grains.motion[grain], grain, margin, near);
  return near;
}

int find_contacts(const GrainOnSurface& at, std::vector<SurfaceContact>& made, std::span<SurfaceTouch, 8> touches) {
  const int found = find_touches(at.surface, at.grain, at.adhesion_reach, touches);
  if (found == 0) return 0;
  std::array<const SurfaceContact*, 8> old;
  for (int k = 0; k < found; ++k) old[k] = remembered(at.before, touches.first(found), k);
  int kept = 0;
  for (int k = 0; k < found; ++k) {
    const double overlap = touches[k].overlap;
    if (overlap <= 0 && !(old[k] && still_adheres(at.constants, overlap, at.grain.radius))) continue;
    touches[kept] = touches[k];
    if (old[k]) touches[kept].before = old[k]->normal;
    made.push_back({at.who, touches[k].triangle, touches[k].normal, old[k] ? old[k]->memory : Memory<double>{}});
    ++kept;
  }
  return kept;
}

Touch<double> touch_of(const Body& body, const SurfaceTouch& at, const Motion& grain, const Spin& spin) {
  const double arm = grain.radius - at.overlap / 2;
  const Vec3 velocity = grain.velocity - arm * cross(spin.rate, at.normal) - body.velocity_at(at.point);
  return {.normal = triple(at.normal),
          .overlap = at.overlap,
          .radius = grain.radius,
          .mass = 1 / grain.inverse_mass,
          .velocity = triple(velocity),
          .rotation = triple(spin.rate - body.spin),
          .inertia = 1 / spin.inverse_inertia,
          .turning = 0.5 * dot(spin.rate + body.spin, at.normal),
          .before = triple(at.before)};
}

void Placed::place(std::span<const Body> bodies) {
  surfaces_.clear();
  begin_.clear();
  for (const Body& body : bodies) {
    begin_.push_back(surfaces_.size());
    for (const Surface& surface : body.surfaces) surfaces_.push_back(dem::place(body, surface));
  }
}

}  // namespace soilbin::dem
