#include "dem/bed/bed_report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace soilbin::dem {
namespace {

constexpr int cuts = 8;     // through the bed, for the stress
constexpr int slices = 10;  // along it, for the void ratio

double mean_radius(const Grains& grains) {
  double sum = 0;
  for (std::size_t k = 0; k < grains.count(); ++k) sum += grains.motion[k].radius;
  return grains.count() == 0 ? 0 : sum / static_cast<double>(grains.count());
}

double smallest_radius(const Grains& grains) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < grains.count(); ++k) smallest = std::min(smallest, grains.motion[k].radius);
  return smallest;
}

std::vector<std::uint32_t> rows_of(const Simulation& simulation) {
  const State& s = simulation.state();
  std::vector<std::uint32_t> row(s.next_id);
  for (std::uint32_t k = 0; k < s.grains.count(); ++k) row[s.grains.id[k]] = k;
  return row;
}

/// The force that goes up through the cut z, within the region's footprint, by
/// way of one contact; 0 where it doesn't.
double carried(const Contact& contact, const Vec3& first, const Vec3& second, double z, const Region& within) {
  if ((first.z > z) == (second.z > z)) return 0;
  const Vec3 at = first + (z - first.z) / (second.z - first.z) * (second - first);
  if (!inside(within, {at.x, at.y, (within.lower.z + within.upper.z) / 2})) return 0;
  return first.z > z ? contact.force.z : -contact.force.z;
}

void report_stress(const Simulation& simulation, const std::vector<Contact>& contacts, const Region& region,
                   BedReport& report) {
  const Grains& grains = simulation.state().grains;
  const std::vector<std::uint32_t> row = rows_of(simulation);
  const Domain& domain = simulation.setup().domain;
  const Periods periods(domain);
  const double area = (region.upper.x - region.lower.x) * (region.upper.y - region.lower.y);
  const double g = -simulation.state().gravity.z;
  for (int cut = 0; cut < cuts; ++cut) {
    const double depth = report.height * (cut + 0.5) / cuts, z = report.height - depth;
    StressAtDepth here{.depth = depth};
    for (const Contact& contact : contacts) {
      const Vec3& first = grains.motion[row[contact.first]].position;
      // A contact with the floor or a wall ends at its point there.
      Vec3 second =
          contact.second >= 0 ? grains.motion[row[static_cast<std::size_t>(contact.second)]].position : contact.point;
      if (domain.periodic[0]) second = first + periods.shortest(second - first);
      here.stress += carried(contact, first, second, z, region) / area;
    }
    const Region above{{region.lower.x, region.lower.y, z}, {region.upper.x, region.upper.y, z + 2 * report.height}};
    const double solid = solid_fraction(grains, above, smallest_radius(grains) / 3);
    here.weight = solid * 2 * report.height * simulation.setup().materials.all[0].density * g;
    report.stress.push_back(here);
  }
}

void report_contacts(const Simulation& simulation, const std::vector<Contact>& contacts, const Region& region,
                     BedReport& report) {
  const Grains& grains = simulation.state().grains;
  std::vector<int> count(simulation.state().next_id);
  double overlap = 0;
  for (const Contact& contact : contacts) {
    ++count[contact.first];
    if (contact.second >= 0) ++count[static_cast<std::size_t>(contact.second)];
    overlap += contact.overlap;
  }
  int here = 0, sum = 0, loose = 0;
  const auto add = [&](const Vec3& at, int n) {
    if (inside(region, at)) ++here, sum += n, loose += n < 2 ? 1 : 0;
  };
  for (std::size_t k = 0; k < grains.count(); ++k)
    if (grains.clump[k] == lone) add(grains.motion[k].position, count[grains.id[k]]);
  const Clumps& clumps = simulation.state().clumps;
  for (const Clump& clump : clumps.all) {
    int n = 0;
    for (const ClumpMember& member : clumps.of(clump)) n += count[member.id];
    add(clump.motion.position, n);
  }
  if (here > 0)
    report.coordination = static_cast<double>(sum) / here, report.rattlers = static_cast<double>(loose) / here;
  if (!contacts.empty()) report.overlap = overlap / static_cast<double>(contacts.size()) / (2 * mean_radius(grains));
}

}  // namespace

bool inside(const Region& region, const Vec3& at) {
  return at.x >= region.lower.x && at.y >= region.lower.y && at.z >= region.lower.z && at.x < region.upper.x &&
         at.y < region.upper.y && at.z < region.upper.z;
}

SolidLattice::SolidLattice(const Region& region, double spacing) : region_(region) {
  const Vec3 side = region.upper - region.lower;
  const auto points = [&](double length) { return std::max(1, static_cast<int>(std::lround(length / spacing))); };
  nx_ = points(side.x), ny_ = points(side.y), nz_ = points(side.z);
  step_ = {side.x / nx_, side.y / ny_, side.z / nz_};
  filled_.resize(static_cast<std::size_t>(nx_) * ny_ * nz_);
}

void SolidLattice::add(const Vec3& centre, double radius) {
  const auto first = [](double at, double lower, double cell) {
    return std::max(0, static_cast<int>(std::ceil((at - lower) / cell - 0.5)));
  };
  const Vec3 side = region_.upper - region_.lower, at = centre - region_.lower;
  const double r = radius;
  if (at.x + r < 0 || at.y + r < 0 || at.z + r < 0 || at.x - r > side.x || at.y - r > side.y || at.z - r > side.z)
    return;
  for (int iz = first(at.z - r, 0, step_.z); iz < nz_ && (iz + 0.5) * step_.z <= at.z + r; ++iz)
    for (int iy = first(at.y - r, 0, step_.y); iy < ny_ && (iy + 0.5) * step_.y <= at.y + r; ++iy) {
      const double dz = (iz + 0.5) * step_.z - at.z, dy = (iy + 0.5) * step_.y - at.y;
      const double half2 = r * r - dz * dz - dy * dy;
      if (half2 <= 0) continue;
      const double half = std::sqrt(half2);
      for (int ix = first(at.x - half, 0, step_.x); ix < nx_ && (ix + 0.5) * step_.x <= at.x + half; ++ix)
        filled_[(static_cast<std::size_t>(iz) * ny_ + iy) * nx_ + ix] = true;
    }
}

double SolidLattice::share() const {
  return static_cast<double>(std::count(filled_.begin(), filled_.end(), true)) / static_cast<double>(filled_.size());
}

double solid_fraction(const Grains& grains, const Region& region, double spacing) {
  SolidLattice lattice(region, spacing);
  for (std::size_t k = 0; k < grains.count(); ++k) lattice.add(grains.motion[k].position, grains.motion[k].radius);
  return lattice.share();
}

double void_ratio_of(double solid) { return solid > 0 ? 1 / solid - 1 : std::numeric_limits<double>::infinity(); }

Region core(const BedSize& size, double height, double mean_diameter) {
  const auto margin = [&](double side) { return std::min(2 * mean_diameter, side / 4); };
  const double x = margin(size.length), y = margin(size.width), z = margin(height);
  return {{x, y, z}, {size.length - x, size.width - y, height - z}};
}

void UnrestSums::add(double mass, double radius, const Vec3& displacement, const Vec3& change_of_velocity, double g,
                     double time) {
  kinetic += 0.5 * mass * squared(1 / time * displacement);
  net += mass * (1 / time) * length(change_of_velocity);
  weight += mass * g;
  diameters += 2 * radius;
  grains += 1;
}

Unrest UnrestSums::means() const {
  if (grains == 0) return {};
  return {.kinetic = kinetic / (weight * diameters / grains),
          .unbalanced = forces > 0 ? net / grains / (forces / contacts) : std::numeric_limits<double>::infinity()};
}

std::vector<Motion> watched(const Simulation& simulation) {
  const Grains& grains = simulation.state().grains;
  std::vector<Motion> before(simulation.state().next_id);
  for (std::size_t k = 0; k < grains.count(); ++k) before[grains.id[k]] = grains.motion[k];
  return before;
}

Unrest unrest_since(const Simulation& simulation, const std::vector<Motion>& before, int steps) {
  const Grains& grains = simulation.state().grains;
  const double time = steps * simulation.setup().numerics.dt, g = length(simulation.state().gravity);
  const Periods periods(simulation.setup().domain);
  UnrestSums sums;
  for (std::size_t k = 0; k < grains.count(); ++k) {
    const Motion &grain = grains.motion[k], &was = before[grains.id[k]];
    if (grain.held()) continue;
    sums.add(mass_share(grains, simulation.state().clumps, k), grain.radius,
             periods.shortest(grain.position - was.position), grain.velocity - was.velocity, g, time);
  }
  for (const Contact& contact : simulation.contacts()) sums.forces += length(contact.force), sums.contacts += 1;
  return sums.means();
}

Unrest unrest(Simulation& simulation, int steps) {
  if (simulation.state().grains.count() == 0) return {};
  const std::vector<Motion> before = watched(simulation);
  simulation.run(steps);
  return unrest_since(simulation, before, steps);
}

BedReport report_on(Simulation simulation, const BedSize& size) {
  const Grains& grains = simulation.state().grains;
  BedReport report;
  report.grains = number_of_grains(simulation.state());
  const double radius = mean_radius(grains), spacing = smallest_radius(grains) / 5;
  const Footprint over{2 * radius, size.length - 2 * radius, 2 * radius, size.width - 2 * radius};
  const SurfaceHeight surface = surface_height(grains, over, radius / 4);
  report.height = surface.mean(), report.roughness = surface.deviation();
  const Region middle = core(size, report.height, 2 * radius);
  const double solid = solid_fraction(grains, middle, spacing);
  report.void_ratio = void_ratio_of(solid);
  report.bulk_density = solid * simulation.setup().materials.all[0].density;
  const double slice = (middle.upper.x - middle.lower.x) / slices;
  for (int k = 0; k < slices; ++k) {
    Region part = middle;
    part.lower.x = middle.lower.x + k * slice, part.upper.x = part.lower.x + slice;
    report.void_ratio_along.push_back(void_ratio_of(solid_fraction(grains, part, spacing)));
  }
  const std::vector<Contact> contacts = simulation.contacts();
  report_contacts(simulation, contacts, middle, report);
  report_stress(simulation, contacts, middle, report);
  report.unrest = unrest(simulation);
  return report;
}

}  // namespace soilbin::dem
