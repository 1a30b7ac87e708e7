// The bed that engines are timed on, as soilbin's engine takes it.
#pragma once

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "dem/engine/simulation.hpp"

namespace soilbin::dem {

inline constexpr int grain_count = 57000;
inline constexpr double length_x = 6, length_y = 1, top = 2.6, density = 2463.51;

/// The law of LAMMPS's pair granular with hertz/material, mindlin, sds rolling and damping tsuji; the numbers stand in
/// bench/peers/bed.lammps once more.
inline Setup setup_of(int threads) {
  Setup setup;
  setup.materials.add({"sand", density, 31.75e6, 0.18}, {.restitution = 0.56,
                                                         .sliding_friction = 0.5,
                                                         .rolling_friction = 0.1,
                                                         .rolling_damping = 0.3,
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

/// Floor and four walls.
inline Simulation empty_bin(Setup setup, double length = length_x) {
  setup.domain.upper.x = length + 0.01;
  Simulation simulation(setup);
  simulation.set_gravity({0, 0, -9.81});
  Body bin;
  bin.name = "bin";
  bin.surfaces = {{Plane{{0, 0, 0}, {0, 0, 1}}, 0},
                  {Plane{{0, 0, 0}, {1, 0, 0}}, 0},
                  {Plane{{length, 0, 0}, {-1, 0, 0}}, 0},
                  {Plane{{0, 0, 0}, {0, 1, 0}}, 0},
                  {Plane{{0, length_y, 0}, {0, -1, 0}}, 0}};
  simulation.add_body(bin);
  return simulation;
}

/// A grain of the bed.
struct Place {
  Vec3 position;
  double radius;
};

/// The grains of a LAMMPS data file that peer_bed made.
inline std::vector<Place> read_places(const std::string& file) {
  std::ifstream in(file);
  std::string line;
  while (std::getline(in, line) && !line.starts_with("Atoms")) continue;
  std::vector<Place> places;
  long id;
  int type;
  double diameter, rho, x, y, z;
  while (in >> id >> type >> diameter >> rho >> x >> y >> z) places.push_back({{x, y, z}, diameter / 2});
  if (places.size() != grain_count) throw std::runtime_error(file + " is no bed of this bench");
  return places;
}

/// Wall-clock time that so many steps take [s].
inline double seconds_of(Simulation& simulation, long steps) {
  const auto start = std::chrono::steady_clock::now();
  simulation.run(steps);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace soilbin::dem
