// The stages of a step, as functions of a World. step() reads as their list: search for pairs where it is due, choose
// who sleeps; slab by slab forces of pairs, forces of surfaces, motion of grains; motion of clumps and of bodies; stop
// what can't go on. The same setup and state give the same bits for any number of threads.
#pragma once

#include <span>

#include "dem/engine/world.hpp"

namespace soilbin::dem {

/// Takes one step. Throws RunStopped; the state is then that after the step in which it failed.
void step(World& world);

/// Sets what follows from the largest grain that is left: the tables of the laws and the margins of a search.
void fit_to_largest_grain(World& world);
/// Whether grains or bodies may have moved by so much since the last search that pairs could be missed.
bool search_is_due(World& world);
/// Sorts grains into slabs, finds pairs and grains near surfaces, and hands on what contacts remember. Rows that are
/// marked `gone` are taken away first. Throws RunStopped for a grain outside the domain.
void search(World& world, std::span<const std::uint8_t> gone = {});
/// What follows from a search, or from a state that has had one: nobody sleeps, nothing is found yet.
void make_room(World& world);
/// Cuts the slabs into blocks anew, since others sleep now.
void cut_blocks(World& world);

/// Adds the forces of a slab's pairs to the loads of their grains.
void pair_forces(World& world, int slab);
/// Adds the forces of a slab's contacts with surfaces to the loads of grains and bodies.
void surface_forces(World& world, int slab);
/// Moves the grains of a slab by their loads, and clears those; spheres of clumps wait for move_clumps.
void move_grains(World& world, int slab);

}  // namespace soilbin::dem
