// The bed that soilbin and other engines are timed on: 57,000 grains at rest on a floor of 6 m x 1 m.
//   peer_bed make FILE [SECONDS]           settles it, and writes it as a LAMMPS data file (no velocities, no history)
//   peer_bed time FILE THREADS WARM STEPS  runs from that file and prints what bench/peers/run compares
//   peer_bed size FILE COUNT THREADS STEPS runs that many grains, the bed cut or laid several times in a row, and
//   prints
//                                          the cost of a grain
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

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

Simulation empty_bin(int threads, double length = length_x) {
  Setup setup = setup_of(threads);
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

struct Place {
  Vec3 position;
  double radius;
};

std::vector<Place> read(const std::string& file) {
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

double seconds_of(Simulation& simulation, long steps) {
  const auto start = std::chrono::steady_clock::now();
  simulation.run(steps);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Memory of this process [bytes].
double memory() {
  std::ifstream in("/proc/self/statm");
  double total = 0, resident = 0;
  in >> total >> resident;
  return resident * 4096;
}

void size(const std::string& file, int count, int threads, long steps) {
  std::vector<Place> bed = read(file);
  std::sort(bed.begin(), bed.end(), [](const Place& a, const Place& b) { return a.position.x < b.position.x; });
  const double before = memory();
  const auto place = [&](int k) {
    const Place& in_bed = bed[k % grain_count];
    return Place{in_bed.position + Vec3{length_x * (k / grain_count), 0, 0}, in_bed.radius};
  };
  // The end wall stands where the last grain ends: a bed cut open would flow.
  double end = length_x;
  for (int k = std::max(0, count - grain_count); k < count; ++k)
    end = std::max(end, place(k).position.x + place(k).radius);
  if (count < grain_count) end = place(count - 1).position.x + place(count - 1).radius;
  Simulation simulation = empty_bin(threads, end);
  for (int k = 0; k < count; ++k) simulation.add_grain(place(k).position, place(k).radius, 0);
  simulation.run(100);
  const double seconds = seconds_of(simulation, steps);
  fmt::print("soilbin grains={} threads={} ns_per_grain_step={:.4g} bytes_per_grain={:.0f}\n", count, threads,
             1e9 * seconds / (static_cast<double>(steps) * count), (memory() - before) / count);
}

void time(const std::string& file, int threads, long warm, long steps) {
  Simulation simulation = empty_bin(threads);
  for (const Place& place : read(file)) simulation.add_grain(place.position, place.radius, 0);
  simulation.run(warm);
  const double seconds = seconds_of(simulation, steps);
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
  if (what == "size" && argc == 6) return size(argv[2], std::atoi(argv[3]), std::atoi(argv[4]), std::atol(argv[5])), 0;
  fmt::print(stderr,
             "usage: peer_bed make FILE [SECONDS] | time FILE THREADS WARM STEPS | size FILE COUNT THREADS STEPS\n");
  return 2;
}

}  // namespace
}  // namespace soilbin::dem

int main(int argc, char** argv) { return soilbin::dem::run(argc, argv); }
