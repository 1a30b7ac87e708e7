// Grains on the surfaces of bodies: which may touch, where they touch, and what those contacts remember.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "dem/engine/grains.hpp"
#include "dem/engine/laws/contact_law.hpp"
#include "dem/surface/body.hpp"

namespace soilbin::dem {

/// A vector as the laws take it, and back.
inline Triple<double> triple(const Vec3& a) { return {a.x, a.y, a.z}; }
inline Vec3 vec3(const Triple<double>& a) { return {a.x, a.y, a.z}; }

/// A grain that is near a surface.
struct NearSurface {
  std::uint32_t grain;          ///< row
  std::uint16_t body, surface;  ///< indices
  bool operator==(const NearSurface&) const = default;
};

/// A touch of a grain and a surface. A grain in a corner has several on one mesh; each keeps its memory by its normal,
/// so it goes on as the grain slides or rolls over edges from one triangle to the next.
struct SurfaceContact {
  NearSurface who;
  std::int32_t triangle = -1;  ///< where it is now; -1 on a plane
  Vec3 normal;                 ///< toward the grain, in the frame of the bin
  Memory<double> memory{};
};

/// Surface contacts of one slab; both lists are in the order of who.
struct SurfaceContacts {
  std::vector<NearSurface> near;
  std::vector<SurfaceContact> made;
};

/// A surface where its body is now.
struct PlacedSurface {
  const Body* body = nullptr;
  const MeshSurface* mesh = nullptr;  ///< nullptr: a plane
  Vec3 normal;                        ///< of the plane, in the frame of the bin
  double offset = 0;                  ///< normal . x on the plane [m]
};

/// What the grains of a slab do to a body.
struct BodyLoad {
  Vec3 force, torque;
};

/// A contact point found, before any law.
struct SurfaceTouch {
  std::int32_t triangle;
  Vec3 point;  ///< in the middle of the overlap
  Vec3 normal;
  double overlap;
  Vec3 before;  ///< the normal of the contact that it goes on with, else its own
};

/// Grains of rows [first, last) that come within `margin` of a surface; those that are held touch none.
std::vector<NearSurface> find_near(std::span<const Body> bodies, const Grains& grains, std::uint32_t first,
                                   std::uint32_t last, double margin);

/// Adds to `near` the surfaces that one grain, of this row, comes within `margin` of.
void add_near(std::span<const Body> bodies, const Motion& grain, std::uint32_t row, double margin,
              std::vector<NearSurface>& near);

/// A grain near a surface, and what its contacts there follow from.
struct GrainOnSurface {
  const NearSurface& who;
  const Motion& grain;
  const PlacedSurface& surface;
  const LawConstants<double>& constants;
  double adhesion_reach;                   ///< how far beyond its radius a grain that adheres may be held [m]
  std::span<const SurfaceContact> before;  ///< its contacts there a step ago
};

/// Finds all points where a grain touches a surface (none, one, or up to eight in the corners of a mesh), adds a
/// contact for each to `made` and tells the points in the same order. Each takes the memory of the one among `before`
/// whose normal is nearest, within 45 degrees and nearest the other way round too; the others start anew. A contact
/// that adheres is kept beyond the radius.
int find_contacts(const GrainOnSurface& at, std::vector<SurfaceContact>& made, std::span<SurfaceTouch, 8> touches);

/// What contact_response needs to know of it.
Touch<double> touch_of(const Body& body, const SurfaceTouch& at, const Motion& grain, const Spin& spin);

/// Adds what a contact does to the loads of its grain and of its body, which is at `centre`; force and couple on the
/// grain. Seven parameters: here and in LAMMPS they come from different structs, and no struct holds them together.
inline void add_loads(const SurfaceTouch& at, double radius, const Vec3& force, const Vec3& couple, const Vec3& centre,
                      Load& on_grain, BodyLoad& on_body) {
  on_grain.force += force;
  on_grain.torque += couple - (radius - at.overlap / 2) * cross(at.normal, force);
  on_body.force -= force;
  on_body.torque -= couple + cross(at.point - centre, force);
}

/// Where each surface of each body is now, body by body.
class Placed {
 public:
  void place(std::span<const Body> bodies);
  const PlacedSurface& at(const NearSurface& who) const { return surfaces_[begin_[who.body] + who.surface]; }

 private:
  std::vector<PlacedSurface> surfaces_;
  std::vector<std::size_t> begin_;
};

}  // namespace soilbin::dem
