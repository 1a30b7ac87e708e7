// Contacts, energy and the grains' motion at whole steps, worked out from a run's present state, which stays as it is.
// Forces are those that the next step will apply.
#pragma once

#include <cstdint>
#include <vector>

#include "dem/engine/energy.hpp"
#include "dem/engine/grains.hpp"

namespace soilbin::dem {

struct World;

/// A contact as it is now.
struct Contact {
  GrainId first;
  std::int64_t second;    ///< id of a grain; or -1 - index of a body
  std::int32_t triangle;  ///< of the body's mesh, -1 for none
  Vec3 point, normal;     ///< normal toward `first`
  double overlap;         ///< [m]
  Vec3 force, couple;     ///< on `first` [N], [N m]
  double pressing;        ///< F_N [N]
};

/// Motion of a grain at a whole step.
struct GrainNow {
  Vec3 position, velocity, spin;
  double radius;
};

/// What a load and gravity change in a grain's motion within some time.
struct Kick {
  Vec3 velocity, spin;
};

std::vector<Contact> contacts_of(const World& world);
/// Loads of the contacts on each grain, row by row.
std::vector<Load> loads_of(const World& world);
EnergyBalance energy_of(const World& world);

/// Whether the velocity of the grain in this row is still at a whole step.
bool is_new(const World& world, std::size_t row);
/// The kick of a grain that is no sphere of a clump, within `time` [s].
Kick kick_of(const World& world, std::size_t row, const Load& load, double time);
/// Kicks of all grains, from the loads of all, row by row.
std::vector<Kick> kicks_of(const World& world, const std::vector<Load>& loads, double time);
/// From the kick of half a step.
GrainNow motion_at(const World& world, std::size_t row, const Kick& kick);

}  // namespace soilbin::dem
