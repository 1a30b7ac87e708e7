// The bed that soilbin and other engines are timed on: 57,000 grains at rest on a floor of 6 m x 1 m.
//   peer_bed make FILE [SECONDS]           settles it, and writes it as a LAMMPS data file (no velocities, no history)
//   peer_bed time FILE THREADS WARM STEPS  runs from that file and prints what bench/peers/run compares
#include <fmt/core.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "dem/bed/insertion.hpp"
#include "dem/engine/simulation.hpp"
#include "scenario/atomic_file.hpp"

namespace soilbin::dem {
namespace {

constexpr int grain_count = 57000;
constexpr double length_x = 6, length_y = 1, top = 2.6, density = 2463.51;

/// The law of LAMMPS's pair granular with hertz/material, mindlin, sds rolling and damping tsuji; the numbers stand in
/// bench/peers/bed.lammps once more.
Setup setup_of(int threads) {
  Setup setup;
  setup.materials.add({"sand", density, 31.75e6, 0.18}, {.restitution = 0.56,
                                                         .sliding_friction = 0.5,
                                                         .rolling_friction = 0.1,
                                                         .rolling_stiffness = 5000,
                                                         .rolling_viscosity = 1});
  setup.laws.rolling = RollingLaw::spring_slider;
  setup.laws.tangential_damping = 1;
  setup.domain = {{-0.01, -0.01, -0.01}, {length_x + 0.01, length_y + 0.01, top + 0.01}};
  setup.numerics.dt = 5e-5;
  setup.numerics.threads = threads;
  if (const char* skin = std::getenv("SKIN")) setup.numerics.skin = std::atof(skin);
  if (const char* set = std::getenv("INSTRUCTION_SET")) setup.numerics.instruction_set = set;
  return setup;
}

Simulation empty_bin(int threads) {
  Simulation simulation(setup_of(threads));
  simulation.set_gravity({0, 0, -9.81});
  Body bin;
  bin.name = "bin";
  bin.surfaces = {{Plane{{0, 0, 0}, {0, 0, 1}}, 0},
                  {Plane{{0, 0, 0}, {1, 0, 0}}, 0},
                  {Plane{{length_x, 0, 0}, {-1, 0, 0}}, 0},
                  {Plane{{0, 0, 0}, {0, 1, 0}}, 0},
                  {Plane{{0, length_y, 0}, {0, -1, 0}}, 0}};
  simulation.add_body(bin);
  return simulation;
}

void make(const std::string& file, double seconds) {
  Simulation simulation = empty_bin(0);
  insert_loosely(simulation, {{0, 0, 0}, {length_x, length_y, top}}, {0.015, 0.025}, 0, grain_count, 1);
  const auto steps = static_cast<std::int64_t>(seconds / simulation.setup().numerics.dt);
  for (int part = 0; part < 20; ++part) {
    simulation.run(steps / 20);
    fmt::print(stderr, "\rsettling: {} %", 5 * (part + 1));
  }
  fmt::print(stderr, "\n");
  std::string text = fmt::format(
      "a bed at rest\n\n{} atoms\n1 atom types\n{} {} xlo xhi\n{} {} ylo yhi\n{} {} zlo zhi\n\nAtoms # sphere\n\n",
      grain_count, -0.01, length_x + 0.01, -0.01, length_y + 0.01, -0.01, top + 0.01);
  for (GrainId id = 0; id < grain_count; ++id) {
    const Motion& m = simulation.state().grains.motion[id];
    text +=
        fmt::format("{} 1 {} {} {} {} {}\n", id + 1, 2 * m.radius, density, m.position.x, m.position.y, m.position.z);
  }
  write_file_atomically(file, text);
}

Simulation read(const std::string& file, int threads) {
  std::ifstream in(file);
  std::string line;
  while (std::getline(in, line) && !line.starts_with("Atoms")) continue;
  Simulation simulation = empty_bin(threads);
  long id;
  int type;
  double diameter, rho, x, y, z;
  while (in >> id >> type >> diameter >> rho >> x >> y >> z) simulation.add_grain({x, y, z}, diameter / 2, 0);
  if (simulation.state().grains.count() != grain_count) throw std::runtime_error(file + " is no bed of this bench");
  return simulation;
}

void time(const std::string& file, int threads, long warm, long steps) {
  Simulation simulation = read(file, threads);
  simulation.run(warm);
  const auto start = std::chrono::steady_clock::now();
  simulation.run(steps);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  double force = 0;
  long pairs = 0;
  for (const Contact& contact : simulation.contacts()) {
    if (contact.second < 0) continue;
    force += dot(contact.force, contact.normal);
    ++pairs;
  }
  fmt::print("soilbin threads={} particle_steps_per_second={:.5g} mean_force={:.6g} coordination={:.6g}\n", threads,
             grain_count * static_cast<double>(steps) / seconds, force / static_cast<double>(pairs),
             2.0 * static_cast<double>(pairs) / grain_count);
}

int run(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "";
  if (what == "make" && argc >= 3) return make(argv[2], argc > 3 ? std::atof(argv[3]) : 2.0), 0;
  if (what == "time" && argc == 6) return time(argv[2], std::atoi(argv[3]), std::atol(argv[4]), std::atol(argv[5])), 0;
  fmt::print(stderr, "usage: peer_bed make FILE [SECONDS] | time FILE THREADS WARM STEPS\n");
  return 2;
}

}  // namespace
}  // namespace soilbin::dem

int main(int argc, char** argv) { return soilbin::dem::run(argc, argv); }
