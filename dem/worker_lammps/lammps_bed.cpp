#include "dem/worker_lammps/lammps_bed.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace soilbin::dem {
namespace {

/// Cells of a row of `count` over lower .. upper whose middles lie in from .. to: first, and past the last.
std::array<int, 2> cells_in(double from, double to, double lower, double upper, int count) {
  const double cell = (upper - lower) / count;
  const auto first = [&](double at) {
    return static_cast<int>(std::clamp(std::ceil((at - lower) / cell - 0.5), 0.0, static_cast<double>(count)));
  };
  return {first(from), first(to)};
}

/// The part of `whole` that is this process's.
Region meet(const Region& whole, const Region& part) {
  const Vec3 &a = whole.lower, &b = part.lower, &c = whole.upper, &d = part.upper;
  return {{std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)},
          {std::min(c.x, d.x), std::min(c.y, d.y), std::min(c.z, d.z)}};
}

double volume(const Region& region) {
  const Vec3 side = region.upper - region.lower;
  return side.x > 0 && side.y > 0 && side.z > 0 ? side.x * side.y * side.z : 0;
}

double solid_of_all(const LammpsSimulation& simulation, const Region& region, double spacing) {
  const Region mine = meet(region, simulation.part());
  std::array<double, 2> sums{0, volume(mine)};  // volumes: of grains, in all
  if (sums[1] > 0) {
    SolidLattice lattice(mine, spacing);
    simulation.see_grains([&](const Vec3& centre, double radius) { lattice.add(centre, radius); });
    sums[0] = lattice.share() * sums[1];
  }
  join_sums(simulation, sums);
  return sums[0] / sums[1];
}

}  // namespace

WatchedInLammps watched(LammpsSimulation& simulation) {
  simulation.watch();
  return {};
}

Unrest unrest_since(LammpsSimulation& simulation, const WatchedInLammps&, int steps) {
  return simulation.end_watch(steps * simulation.setup().numerics.dt).means();
}

/// Each process has the points that lie in its part.
double mean_height(const LammpsSimulation& simulation, const Footprint& over, double spacing, double cut) {
  const auto points = [&](double length) { return std::max(1, static_cast<int>(std::lround(length / spacing))); };
  const int nx = points(over.x_upper - over.x_lower), ny = points(over.y_upper - over.y_lower);
  const Region part = simulation.part();
  const auto xs = cells_in(part.lower.x, part.upper.x, over.x_lower, over.x_upper, nx);
  const auto ys = cells_in(part.lower.y, part.upper.y, over.y_lower, over.y_upper, ny);
  const double dx = (over.x_upper - over.x_lower) / nx, dy = (over.y_upper - over.y_lower) / ny;
  std::array<double, 2> sums{};  // heights, points
  if (xs[0] < xs[1] && ys[0] < ys[1]) {
    SurfaceHeight surface{.over = {over.x_lower + xs[0] * dx, over.x_lower + xs[1] * dx, over.y_lower + ys[0] * dy,
                                   over.y_lower + ys[1] * dy},
                          .nx = xs[1] - xs[0],
                          .ny = ys[1] - ys[0],
                          .height = {}};
    surface.height.resize(static_cast<std::size_t>(surface.nx) * surface.ny);
    simulation.see_grains([&](const Vec3& centre, double radius) {
      if (centre.z + radius <= cut) raise(surface, centre, radius);
    });
    sums[1] = static_cast<double>(surface.height.size());
    sums[0] = surface.mean() * sums[1];
  }
  join_sums(simulation, sums);
  return sums[0] / sums[1];
}

void remove_above(LammpsSimulation& simulation, double cut) {
  simulation.remove_grains([&](const Vec3& centre, double radius) { return centre.z + radius > cut; });
}

BedReport report_on(const LammpsSimulation& simulation, const BedRecipe& recipe) {
  constexpr double no_cut = std::numeric_limits<double>::infinity();
  const BedSize& size = recipe.size;
  const Grains& grains = own_grains(simulation);
  double radii = 0;
  for (std::size_t k = 0; k < grains.count(); ++k) radii += grains.motion[k].radius;
  join_sums(simulation, {&radii, 1});
  BedReport report;
  report.grains = static_cast<std::size_t>(simulation.grain_count());
  const double radius = radii / simulation.grain_count();
  report.height = mean_height(simulation, {2 * radius, size.length - 2 * radius, 2 * radius, size.width - 2 * radius},
                              radius / 4, no_cut);
  const Region middle = core(size, report.height, 2 * radius);
  const double solid = solid_of_all(simulation, middle, recipe.soil.radius_min / 5);
  report.void_ratio = void_ratio_of(solid);
  report.bulk_density = solid * recipe.soil.grain_density;
  std::vector<int> contacts(grains.count());
  simulation.see_contacts([&](std::size_t row) { ++contacts[row]; });
  std::array<double, 3> sums{};  // grains of the core, contacts, rattlers
  for (std::size_t k = 0; k < grains.count(); ++k) {
    if (!inside(middle, grains.motion[k].position)) continue;
    sums[0] += 1, sums[1] += contacts[k], sums[2] += contacts[k] < 2 ? 1 : 0;
  }
  join_sums(simulation, sums);
  if (sums[0] > 0) report.coordination = sums[1] / sums[0], report.rattlers = sums[2] / sums[0];
  report.overlap = simulation.pair_means().overlap / (2 * radius);
  return report;
}

BedReport settle_in_lammps(LammpsRun& run, const BedRecipe& recipe) {
  Settling<LammpsRun> settling(recipe, run);
  run.through([&] { settling.settle(); });
  run.write_restart();
  BedReport report = report_on(run.simulation(), recipe);
  report.unrest = settling.unrest();
  report.settling_time = run.simulation().time();
  return report;
}

}  // namespace soilbin::dem
