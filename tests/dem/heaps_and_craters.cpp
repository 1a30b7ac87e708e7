#include "tests/dem/heaps_and_craters.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "dem/bed/insertion.hpp"
#include "dem/surface/mass_properties.hpp"
#include "dem/surface/shapes.hpp"
#include "dem/verification/cases.hpp"

namespace soilbin::dem {
namespace {

using std::numbers::pi;

Simulation empty_bed(const BedMaterial& of, const Domain& domain, int threads) {
  Setup setup;
  setup.materials.add(of.material, of.contact);
  setup.laws.rolling = of.rolling;
  setup.domain = domain;
  setup.numerics.threads = threads;
  const double shear = of.material.young / (2 * (1 + of.material.poisson));
  const double rayleigh =
      pi * 0.9 * of.radius * std::sqrt(of.material.density / shear) / (0.1631 * of.material.poisson + 0.8766);
  setup.numerics.dt = 0.15 * rayleigh;
  Simulation simulation(std::move(setup));
  simulation.set_gravity({0, 0, -verification::g});
  return simulation;
}

double kinetic_energy(const Simulation& simulation) {
  double sum = 0;
  const Grains& grains = simulation.state().grains;
  for (std::size_t k = 0; k < grains.count(); ++k)
    sum += 0.5 * squared(grains.motion[k].velocity) / grains.motion[k].inverse_mass;
  return sum;
}

double mass(const Simulation& simulation) {
  double sum = 0;
  const Grains& grains = simulation.state().grains;
  for (std::size_t k = 0; k < grains.count(); ++k) sum += 1 / grains.motion[k].inverse_mass;
  return sum;
}

/// Until the mean grain is slower than it gets by falling a thousandth of `radius`, or for `longest` seconds.
void settle(Simulation& simulation, double radius, double longest, const auto& each) {
  const double part = 0.02;
  for (double t = 0; t < longest; t += part) {
    simulation.run(static_cast<std::int64_t>(part / simulation.setup().numerics.dt));
    each();
    if (t > 0.2 && kinetic_energy(simulation) < mass(simulation) * verification::g * radius * 1e-3) break;
  }
}

/// The highest point of the grains in each of `count` strips of x from `low` to `high`.
std::vector<double> tops(const Simulation& simulation, double low, double high, int count) {
  std::vector<double> top(count, 0.0);
  const Grains& grains = simulation.state().grains;
  for (std::size_t k = 0; k < grains.count(); ++k) {
    const Motion& grain = grains.motion[k];
    const double at = (grain.position.x - low) / (high - low) * count;
    if (at >= 0 && at < count)
      top[static_cast<int>(at)] = std::max(top[static_cast<int>(at)], grain.position.z + grain.radius);
  }
  return top;
}

/// Slope of the least squares line.
double slope(const std::vector<double>& x, const std::vector<double>& y) {
  const double n = static_cast<double>(x.size());
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t k = 0; k < x.size(); ++k) sx += x[k], sy += y[k], sxx += x[k] * x[k], sxy += x[k] * y[k];
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

/// An octahedron whose faces are cut `times` times into four, put on the sphere.
TriangleMesh ball(double radius, int times) {
  std::vector<Vec3> v{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  std::vector<TriangleMesh::Corners> t{{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                       {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int k = 0; k < times; ++k) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [at, fresh] = middles.try_emplace(std::minmax(a, b), static_cast<int>(v.size()));
      if (fresh) v.push_back(unit(v[a] + v[b]));
      return at->second;
    };
    std::vector<TriangleMesh::Corners> finer;
    for (const auto& [a, b, c] : t) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    t = std::move(finer);
  }
  for (Vec3& p : v) p = radius * p;
  return {v, t, {.closed = true, .name = "ball"}};
}

/// Lowest height [m] of the middle of a ball at (x, y) that touches no grain from above, in a box much wider than it.
double touching_height(const Simulation& bed, const Vec3& middle, double radius) {
  double lowest = radius;
  for (const Motion& grain : bed.state().grains.motion) {
    const double reach = radius + grain.radius;
    const double dx = grain.position.x - middle.x, dy = grain.position.y - middle.y;
    const double left = reach * reach - dx * dx - dy * dy;
    if (grain.radius > 0 && left > 0) lowest = std::max(lowest, grain.position.z + std::sqrt(left));
  }
  return lowest;
}

/// How deep a ball comes to rest that falls on a bed. It starts where it touches the first grain, which is not the
/// bed's mean level: put there, it would overlap grains that stand out, and they would throw it back.
double depth_of_fall(Simulation bed, double level, const Vec3& middle, double diameter, double density, double height) {
  Body sphere;
  sphere.name = "ball";
  sphere.surfaces.push_back({MeshSurface{std::make_shared<TriangleMesh>(ball(diameter / 2, 3)), nullptr}, 0});
  sphere.mass = density * pi / 6 * diameter * diameter * diameter;
  const double inertia = 0.1 * sphere.mass * diameter * diameter;
  sphere.inertia = {inertia, inertia, inertia};
  sphere.free_translation = {true, true, true};
  sphere.turning = Turning::free;
  sphere.weighs = true;
  sphere.position = {middle.x, middle.y, touching_height(bed, middle, diameter / 2)};
  const double fallen = height - (sphere.position.z - diameter / 2 - level);
  sphere.velocity = {0, 0, -std::sqrt(2 * verification::g * std::max(fallen, 0.0))};
  const int index = bed.add_body(sphere);
  const auto part = static_cast<std::int64_t>(2e-3 / bed.setup().numerics.dt);
  double lowest = level;
  for (int k = 0; k < 150; ++k) {
    bed.run(part);
    const Body& now = bed.body(index);
    lowest = std::min(lowest, now.position.z - diameter / 2);
    if (now.velocity.z > -0.01) break;
  }
  return level - lowest;
}

}  // namespace

double drained_angle(const BedMaterial& of, std::uint64_t seed, int threads) {
  const double r = of.radius, length = 40 * r, width = 10 * r, height = 24 * r;
  Domain domain{{-r, 0, -1}, {length + 40 * r, width, 3 * height}, {false, true, false}};
  Simulation simulation = empty_bed(of, domain, threads);
  Body back, gate;
  back.surfaces.push_back({Plane{{0, 0, 0}, {1, 0, 0}}, 0});
  const TriangleMesh plate_of_floor = plate(length + 4 * r, 4 * width, 4, 4);
  back.surfaces.push_back({MeshSurface{std::make_shared<TriangleMesh>(plate_of_floor), nullptr}, 0});
  back.position = {length / 2 - 2 * r, width / 2, 0};
  std::get<Plane>(back.surfaces[0].shape).point.x = -back.position.x;
  simulation.add_body(back);
  gate.surfaces.push_back({Plane{{length, 0, 0}, {-1, 0, 0}}, 0});
  const int gate_index = simulation.add_body(gate);
  insert_loosely(simulation, {{0, 0, 0}, {length, width, 2.9 * height}}, {0.9 * r, 1.1 * r}, 0,
                 static_cast<int>(0.55 * length * width * height / sphere_volume(r)), seed);
  settle(simulation, r, 1, [] {});
  simulation.body(gate_index).velocity = {0.5, 0, 0};  // faster than grains follow
  settle(simulation, r, 4,
         [&] { simulation.remove_grains([](const GrainNow& grain) { return grain.position.z < -0.05; }); });
  // Neither the last of the slope at the edge nor its top at the wall.
  std::vector<double> x;
  const std::vector<double> z = tops(simulation, 0.15 * length, 0.85 * length, 14);
  for (int k = 0; k < 14; ++k) x.push_back((0.15 + 0.05 * (k + 0.5)) * length);
  return std::atan(-slope(x, z));
}

Craters craters(const BedMaterial& of, double mu, const BallDrops& drops, std::uint64_t seed, int threads) {
  const auto& [diameter, density, heights] = drops;
  const double r = of.radius, side = 5 * diameter, deep = 2.5 * diameter;
  Simulation bed = empty_bed(of, {{0, 0, -r}, {side, side, 1}, {true, true, false}}, threads);
  Body floor;
  floor.surfaces.push_back({Plane{}, 0});
  bed.add_body(floor);
  insert_loosely(bed, {{0, 0, 0}, {side, side, 3 * deep}}, {0.9 * r, 1.1 * r}, 0,
                 static_cast<int>(0.57 * side * side * deep / sphere_volume(r)), seed);
  settle(bed, r, 1, [] {});

  Craters out;
  const Grains& grains = bed.state().grains;
  const auto cells = static_cast<int>(side / (3 * r));
  std::vector<double> top(cells * cells, 0.0);
  double lower_half = 0;
  for (std::size_t k = 0; k < grains.count(); ++k) {
    const Motion& grain = grains.motion[k];
    const auto cell = [&](double at) { return std::clamp(static_cast<int>(at / side * cells), 0, cells - 1); };
    double& highest = top[cell(grain.position.x) * cells + cell(grain.position.y)];
    highest = std::max(highest, grain.position.z + grain.radius);
    if (grain.position.z < deep / 2) lower_half += 1 / grain.inverse_mass;
  }
  for (const double each : top) out.level += each / (cells * cells);
  out.bulk_density = lower_half / (side * side * deep / 2);
  std::vector<double> x, y;
  for (const double height : heights) {
    const double depth = depth_of_fall(bed, out.level, {side / 2, side / 2, 0}, diameter, density, height);
    const double law =
        0.14 / mu * std::sqrt(density / out.bulk_density) * std::pow(diameter, 2.0 / 3) * std::cbrt(height + depth);
    out.drops.push_back({height, depth, law});
    x.push_back(std::log(height + depth));
    y.push_back(std::log(depth));
  }
  out.exponent = heights.size() > 1 ? slope(x, y) : 0;
  return out;
}

}  // namespace soilbin::dem
