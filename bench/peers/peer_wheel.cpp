// The paper's tire moved in a prescribed way over the bed of peer_bed, as other engines move it too.
//   peer_wheel make BED WHEEL.stl                      writes the tire where it starts, and prints its centre
//   peer_wheel time BED THREADS LOWER STEPS ROLLING    lowers it in so many steps, times the next ones, and prints
//                                                      push, lift and torque every ten steps and then the seconds;
//                                                      ROLLING: off, cdt or epsd, as LIGGGHTS calls the laws
#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "bench/peers/shared_bed.hpp"
#include "dem/bed/surface_height.hpp"
#include "dem/surface/mesh_files.hpp"
#include "dem/surface/shapes.hpp"

namespace soilbin::dem {
namespace {

// Section 4.1 of the paper: 10 rpm at 20 % slip; lugs as cases/tires/paper-lugged.yaml has them.
constexpr double radius = 0.496, width = 0.305, rotation = 10 * 2 * std::numbers::pi / 60, slip = 0.2;
constexpr double sinkage = 0.03;  ///< of the tread base below the mean surface, when it is timed [m]
constexpr double start_x = 1.0, gap = 1e-3;

Tire tire() {
  Tire tire;
  tire.radius = radius, tire.width = width;
  tire.lugs = {.height = 0.011, .count = 40, .thickness = 0.025, .pattern = LugPattern::chevron};
  return tire;
}

RollingLaw rolling_law(const std::string& of_liggghts) {
  if (of_liggghts == "off") return RollingLaw::none;
  if (of_liggghts == "cdt") return RollingLaw::directional;
  if (of_liggghts == "epsd") return RollingLaw::elastic_plastic;
  throw std::invalid_argument("rolling is off, cdt or epsd, not " + of_liggghts);
}

Simulation bed(const std::string& file, int threads, RollingLaw rolling = RollingLaw::none) {
  Setup setup = setup_of(threads);
  setup.laws.rolling = rolling;
  Simulation simulation = empty_bin(setup);
  for (const Place& place : read_places(file)) simulation.add_grain(place.position, place.radius, 0);
  return simulation;
}

/// Where the wheel starts, above all grains, and how far down it goes [m].
struct Start {
  Vec3 centre;
  double down;
};

Start start_on(const Simulation& simulation) {
  const Footprint track{start_x - 0.3, start_x + 0.6, length_y / 2 - width / 2, length_y / 2 + width / 2};
  const double surface = surface_height(simulation.state().grains, track, 0.004).mean();
  const double rim = radius + tire().lugs.height;
  double z = 0;
  for (std::size_t k = 0; k < simulation.state().grains.count(); ++k) {
    const Motion& grain = simulation.state().grains.motion[k];
    const double x = grain.position.x - start_x, apart = rim + grain.radius + gap;
    if (std::abs(x) < apart) z = std::max(z, grain.position.z + std::sqrt(apart * apart - x * x));
  }
  return {{start_x, length_y / 2, z}, z - (surface + radius - sinkage)};
}

TriangleMesh moved(const TriangleMesh& mesh, const Vec3& by) {
  std::vector<Vec3> vertices = mesh.vertices();
  for (Vec3& vertex : vertices) vertex += by;
  return TriangleMesh(vertices, mesh.triangles());
}

void make(const std::string& file, const std::string& stl) {
  const Start start = start_on(bed(file, 1));
  write_stl(stl, moved(tire_surface(tire()), start.centre), 1.0);
  fmt::print("{:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}\n", start.centre.x, start.centre.y, start.centre.z,
             start.down, (1 - slip) * radius * rotation, rotation);
}

void time(const std::string& file, int threads, long lower, long steps, RollingLaw rolling) {
  Simulation simulation = bed(file, threads, rolling);
  const Start start = start_on(simulation);
  Body body;
  body.name = "wheel";
  body.surfaces.push_back({MeshSurface{std::make_shared<TriangleMesh>(tire_surface(tire())), nullptr}, 0});
  body.position = start.centre;
  const double forward = (1 - slip) * radius * rotation;
  body.velocity = {forward, 0, -start.down / (static_cast<double>(lower) * simulation.setup().numerics.dt)};
  body.spin = {0, rotation, 0};
  const int wheel = simulation.add_body(body);
  simulation.run(lower);
  simulation.body(wheel).velocity = {forward, 0, 0};
  double seconds = 0;
  constexpr long every = 10;  // as LIGGGHTS writes them
  for (long k = 1; k <= steps / every; ++k) {
    seconds += seconds_of(simulation, every);
    const Body& moved = simulation.body(wheel);
    fmt::print("{} {:.6g} {:.6g} {:.6g}\n", lower + k * every, moved.force.x, moved.force.z, moved.torque.y);
  }
  fmt::print("# seconds {:.6g}\n", seconds);
}

int run(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "";
  if (what == "make" && argc == 4) return make(argv[2], argv[3]), 0;
  if (what == "time" && argc == 7) {
    time(argv[2], std::atoi(argv[3]), std::atol(argv[4]), std::atol(argv[5]), rolling_law(argv[6]));
    return 0;
  }
  fmt::print(stderr, "usage: peer_wheel make BED WHEEL.stl | time BED THREADS LOWER STEPS off|cdt|epsd\n");
  return 2;
}

}  // namespace
}  // namespace soilbin::dem

int main(int argc, char** argv) { return soilbin::dem::run(argc, argv); }
