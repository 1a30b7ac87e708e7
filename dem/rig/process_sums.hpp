// Sums and largest values over all grains of a run, where several processes hold a share of them each
// (dem/worker_lammps): the rig measures the grains of its own process, and these functions join the results.
//
//   double top = 0;
//   for (const Motion& grain : own_grains(simulation).motion) top = std::max(top, grain.position.z);
//   top = largest_of_all(simulation, top);            // the same number in each process
//
// The engine's one process holds all grains, so here there is nothing to join.
#pragma once

#include <span>

#include "dem/bed/surface_height.hpp"
#include "dem/engine/simulation.hpp"
#include "dem/rig/soil_flow.hpp"
#include "dem/rig/tread_stress.hpp"

namespace soilbin::dem {

/// The grains of this process, as they are now.
inline const Grains& own_grains(const Simulation& simulation) { return simulation.state().grains; }

/// Adds to a meter of the soil's flow what all grains do now.
inline void add_to_flow(const Simulation& simulation, const Vec3& axle, FlowMeter& flow) {
  flow.add(simulation.state().grains, axle);
}

/// Each number becomes the largest that any process has, or the sum over all. Every process calls them, in one order.
inline void join_largest(const Simulation&, std::span<double>) {}
inline void join_sums(const Simulation&, std::span<double>) {}

template <class Engine>
double largest_of_all(const Engine& engine, double mine) {
  join_largest(engine, {&mine, 1});
  return mine;
}

/// The surface of the grains of all processes, from that of one's own.
template <class Engine>
SurfaceHeight surface_of_all(const Engine& engine, SurfaceHeight mine) {
  join_largest(engine, mine.height);
  return mine;
}

/// The forces of the grains of all processes on a wheel.
template <class Engine>
TreadForces tread_of_all(const Engine& engine, TreadForces mine) {
  std::vector<double> numbers{mine.thrust, mine.resistance, mine.side};
  for (const Vec3& sector : mine.sectors) numbers.insert(numbers.end(), {sector.x, sector.y, sector.z});
  join_sums(engine, numbers);
  mine.thrust = numbers[0], mine.resistance = numbers[1], mine.side = numbers[2];
  for (std::size_t k = 0; k < mine.sectors.size(); ++k)
    mine.sectors[k] = {numbers[3 * k + 3], numbers[3 * k + 4], numbers[3 * k + 5]};
  return mine;
}

}  // namespace soilbin::dem
