// The bed that soilbin and other engines are timed on: 57,000 grains at rest on a floor of 6 m x 1 m.
//   peer_bed make FILE [SECONDS]           settles it, and writes it as a LAMMPS data file (no velocities, no history)
//   peer_bed time FILE THREADS WARM STEPS  runs from that file and prints what bench/peers/run compares
//   peer_bed size FILE COUNT THREADS STEPS runs that many grains, the bed cut or laid several times in a row, and
//   prints
//                                          the cost of a grain
#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "bench/peers/shared_bed.hpp"
#include "dem/bed/insertion.hpp"
#include "scenario/atomic_file.hpp"

namespace soilbin::dem {
namespace {

void make(const std::string& file, double seconds) {
  Simulation simulation = empty_bin(setup_of(0));
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

/// Memory of this process [bytes].
double memory() {
  std::ifstream in("/proc/self/statm");
  double total = 0, resident = 0;
  in >> total >> resident;
  return resident * 4096;
}

void size(const std::string& file, int count, int threads, long steps) {
  std::vector<Place> bed = read_places(file);
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
  Simulation simulation = empty_bin(setup_of(threads), end);
  for (int k = 0; k < count; ++k) simulation.add_grain(place(k).position, place(k).radius, 0);
  simulation.run(100);
  const double seconds = seconds_of(simulation, steps);
  fmt::print("soilbin grains={} threads={} ns_per_grain_step={:.4g} bytes_per_grain={:.0f}\n", count, threads,
             1e9 * seconds / (static_cast<double>(steps) * count), (memory() - before) / count);
}

void time(const std::string& file, int threads, long warm, long steps) {
  Simulation simulation = empty_bin(setup_of(threads));
  for (const Place& place : read_places(file)) simulation.add_grain(place.position, place.radius, 0);
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
