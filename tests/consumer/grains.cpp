// A grain falls on a floor by the installed libraries and comes to rest where its weight is borne.
#include <cmath>
#include <cstdio>

#include "dem/engine/simulation.hpp"

int main() {
  using namespace soilbin::dem;
  Setup setup;
  setup.materials.add({"sand", 2500, 5e6, 0.25}, {.restitution = 0.3, .sliding_friction = 0.5});
  setup.numerics.dt = 1e-5;
  Simulation simulation(setup);
  simulation.set_gravity({0, 0, -9.81});
  Body floor;
  floor.surfaces.push_back({Plane{}, 0});
  simulation.add_body(floor);
  const GrainId grain = simulation.add_grain({0, 0, 0.011}, 0.01, 0);
  simulation.run(30000);
  const double weight = 9.81 / simulation.state().grains.motion[0].inverse_mass;
  const double borne = -simulation.body(0).force.z;
  std::printf("at %.6g m, floor bears %.6g of %.6g N\n", simulation.grain(grain).position.z, borne, weight);
  return std::abs(borne - weight) < 1e-3 * weight ? 0 : 1;
}
