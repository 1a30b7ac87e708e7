// What changes between two steps where only a part of a long bed is simulated: grains leave, are held where they are,
// are let go, and come in with what their contacts remember of a bed that has settled elsewhere.
//
//   Exchange change;
//   change.leaves = [&](GrainId, const Motion& grain) { return grain.position.x < rear; };
//   change.enters.push_back({.id = id, .radius = 0.01, .mass = held_mass, .position = at});  // held
//   change.contacts.push_back({.first = id, .second = other, .memory = memory});
//   simulation.exchange(change);
#pragma once

#include <array>
#include <functional>
#include <limits>
#include <vector>

#include "dem/engine/clumps.hpp"
#include "dem/engine/grains.hpp"
#include "dem/engine/pair_list.hpp"
#include "dem/engine/surface_contacts.hpp"

namespace soilbin::dem {

/// The mass of a grain that comes in and is held.
inline constexpr double held_mass = std::numeric_limits<double>::infinity();

/// A contact of two grains that is there when they have come in or are let go; memory of the first against the second.
struct BroughtContact {
  GrainId first = 0, second = 0;
  std::array<double, memory_size> memory{};
};

/// A contact that comes in, of a grain on a surface; contact.who.grain is not read.
struct BroughtOnSurface {
  GrainId grain = 0;
  SurfaceContact contact;
};

struct LetGo {
  GrainId grain = 0;
  double mass = 1;  ///< [kg]; of a clump's sphere the clump's
};

/// `leaves` and `stays` are asked of a clump once, with its first sphere's id and the position and velocity of its
/// centre of mass, and hold for all its spheres. Absent: nobody.
struct Exchange {
  std::function<bool(GrainId, const Motion&)> leaves;
  std::function<bool(GrainId, const Motion&)> stays;  ///< who is held from now on
  std::vector<LetGo> let_go;                          ///< spheres that were held; they begin at rest
  std::vector<NewGrain> enters;                       ///< with ids of their own, at rest
  Clumps clumps;  ///< that come in: NewGrain::clump counts them, members tell ids among `enters` and no rows
  std::vector<BroughtContact> contacts;
  std::vector<BroughtOnSurface> on_surfaces;  ///< of one grain in the order of bodies and their surfaces
};

}  // namespace soilbin::dem
