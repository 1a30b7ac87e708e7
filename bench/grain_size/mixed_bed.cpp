// What a step costs in beds of mixed sizes: half of the volume in grains of 20 mm radius, half in grains RATIO times
// smaller, at rest in a bin of 1 m x 0.5 m.
//   mixed_bed RATIO STEPS [PLACES]   prints grains, contacts and processor time of a step a contact
#include <fmt/core.h>

#include <cstdlib>
#include <ctime>
#include <utility>

#include "dem/bed/random.hpp"
#include "dem/bed/settled_bed.hpp"

namespace soilbin::dem {
namespace {

constexpr double length = 1.0, width = 0.5, large = 0.02;

Simulation poured(int ratio, int places) {
  Setup setup;
  setup.materials.add({"stone", 2500, 1e7, 0.25}, {.restitution = 0.3, .sliding_friction = 0.0});
  const double small = large / ratio;
  setup.domain = {{-large, -large, -large}, {length + large, width + large, 100}};
  setup.numerics.dt = 0.999 * setup.numerics.safe_share * rayleigh_time(setup.materials.all.front(), small);
  setup.numerics.threads = 1;
  Simulation simulation(setup);
  simulation.set_gravity({0, 0, -9.81});
  Body bin;
  for (const Plane& plane :
       {Plane{{0, 0, 0}, {0, 0, 1}}, Plane{{0, 0, 0}, {1, 0, 0}}, Plane{{length, 0, 0}, {-1, 0, 0}},
        Plane{{0, 0, 0}, {0, 1, 0}}, Plane{{0, width, 0}, {0, -1, 0}}})
    bin.surfaces.push_back({plane, 0});
  simulation.add_body(bin);
  Random random(1);
  const int nx = static_cast<int>(length / (2.02 * large)), ny = static_cast<int>(width / (2.02 * large));
  const double place = length / nx;
  for (int k = 0; k < places; ++k) {
    const Vec3 corner = place * Vec3{double(k % nx), double(k / nx % ny), double(k / (nx * ny))};
    const int parts = random.uniform(0, 1) < 0.5 ? 1 : ratio;
    const double side = place / parts, radius = large / parts;
    for (int part = 0; part < parts * parts * parts; ++part) {
      const Vec3 in{part % parts + 0.5, part / parts % parts + 0.5, part / (parts * parts) + 0.5};
      const double slack = side / 2 - radius;
      const auto jolt = [&] { return random.uniform(-slack, slack); };
      simulation.add_grain(corner + side * in + Vec3{jolt(), jolt(), jolt()}, radius, 0);
    }
  }
  simulation.run(static_cast<std::int64_t>(0.5 / setup.numerics.dt));
  return simulation;
}

double processor_time() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

int run(int argc, char** argv) {
  if (argc < 3) return fmt::print(stderr, "usage: mixed_bed RATIO STEPS [PLACES]\n"), 2;
  const int ratio = std::atoi(argv[1]), steps = std::atoi(argv[2]), places = argc > 3 ? std::atoi(argv[3]) : 2000;
  Simulation simulation = poured(ratio, places);
  for (int turn = 0; turn < 3; ++turn) {
    const double begin = processor_time();
    simulation.run(steps);
    const double seconds = processor_time() - begin;
    simulation.set_gravity({0, 0, -9.81});
    const auto contacts = static_cast<double>(simulation.contacts().size());
    Simulation searched = simulation;
    const double before = processor_time();
    searched.remove_grains([first = true](const GrainNow&) mutable { return std::exchange(first, false); });
    fmt::print(
        "1:{} {} grains, {:.0f} contacts, {} near pairs, {:.3g} ns a step and contact, a search {:.3g} ns a contact\n",
        ratio, simulation.state().grains.count(), contacts, simulation.state().pairs.first.size(),
        1e9 * seconds / steps / contacts, 1e9 * (processor_time() - before) / contacts);
  }
  return 0;
}

}  // namespace
}  // namespace soilbin::dem

int main(int argc, char** argv) { return soilbin::dem::run(argc, argv); }
