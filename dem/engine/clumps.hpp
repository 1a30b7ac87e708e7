// Clumps: spheres joined for good, so that a grain has a shape. Contacts see the spheres, each a row of Grains as any
// other; a clump adds up what its spheres feel, moves by it as the rigid body that they fill together, and takes them
// along. Spheres of one clump do not touch each other.
//
//   const ClumpShape rod = clump_shape({{{-0.004, 0, 0}, 0.005}, {{0.004, 0, 0}, 0.005}});
//   simulation.add_clump(rod, {.position = {0.1, 0.1, 0.3}}, material);
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "dem/engine/grains.hpp"
#include "dem/surface/body.hpp"
#include "dem/surface/mass_properties.hpp"

namespace soilbin::dem {

struct World;

/// What clumps of one form have in common. Its frame's origin is the centre of mass, its axes are the principal ones.
struct ClumpShape {
  std::vector<Sphere> spheres;
  double volume = 0;  ///< that they fill together [m^3]
  Vec3 inertia;       ///< about the axes, at unit density [m^5]

  /// A shape of the same form, `factor` times as large.
  ClumpShape scaled(double factor) const;
  /// Radius of the smallest ball about the centre of mass that holds it [m].
  double reach() const;
};

/// The shape of these spheres, in a frame of any kind. Throws InputError for none, and as mass_properties does.
ClumpShape clump_shape(std::vector<Sphere> spheres);

/// Where a clump is and how it moves.
struct ClumpMotion {
  Vec3 position;  ///< of its centre of mass [m]
  Rotation rotation{};
  Vec3 velocity{}, spin{};  ///< [m/s], [rad/s]; of a running simulation at the half step
};

struct Clump {
  double mass = 0;  ///< [kg]
  Vec3 inertia;     ///< principal [kg m^2]
  ClumpMotion motion;
  std::uint32_t first = 0, count = 0;  ///< of Clumps::members
};

/// A sphere of a clump.
struct ClumpMember {
  GrainId id = 0;
  Vec3 arm;               ///< from the centre of mass, in the clump's frame [m]
  std::uint32_t row = 0;  ///< of Grains, as they are sorted now
};

struct Clumps {
  std::vector<Clump> all;
  std::vector<ClumpMember> members;  ///< clump by clump

  std::span<const ClumpMember> of(const Clump& clump) const { return {members.data() + clump.first, clump.count}; }
  /// The row of its first sphere: what holds for all of them is asked of that one.
  std::uint32_t row_of(const Clump& clump) const { return members[clump.first].row; }
  bool held(const Clump& clump, const Grains& grains) const { return grains.motion[row_of(clump)].held(); }
  /// After grains were sorted: finds the rows again.
  void find_rows(const Grains& grains);
  /// Marks all spheres of a clump of which one is marked, row by row.
  void join(std::vector<std::uint8_t>& marked) const;
  /// Takes away the clumps whose spheres are marked, before the rows are taken away.
  void remove(std::span<const std::uint8_t> gone, Grains& grains);
};

/// The shape of the clump with this index. Its material must be of the density that it was added with.
ClumpShape shape_of(const Grains& grains, const Clumps& clumps, std::uint32_t index, double density);

/// The mass of a grain, or of its clump shared evenly among the spheres [kg].
double mass_share(const Grains& grains, const Clumps& clumps, std::size_t row);

/// About an axis of any direction, on average [kg m^2]: what the contacts of its spheres know of it.
inline double mean_inertia(const Clump& clump) { return (clump.inertia.x + clump.inertia.y + clump.inertia.z) / 3; }

/// What a clump feels: the loads of its spheres, row by row in `loads`, about its centre of mass.
Load load_of(const Clumps& clumps, const Clump& clump, std::span<const Load> loads);
/// How that and gravity change its motion at once.
Acceleration acceleration(const Clump& clump, const Load& load, const Vec3& gravity);
/// Kinetic energy at this velocity and spin [J].
double kinetic_energy(const Clump& clump, const Vec3& velocity, const Vec3& spin);
/// Gives its spheres the velocity and spin that they have with it, the rotation that of `arms_at`.
void carry_velocity(const Clumps& clumps, const Clump& clump, const Rotation& arms_at, Grains& grains);

/// The stage that moves the clumps by the loads of their spheres, and clears those. A clump of which a sphere lies in a
/// slab asleep stands still. Gives a bound on the speed of the spheres [m/s].
double move_clumps(World& world);
/// What falls asleep loses its motion: the clumps of which a sphere does.
void still_sleeping_clumps(World& world);

}  // namespace soilbin::dem
