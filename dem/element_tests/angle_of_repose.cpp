#include "dem/element_tests/angle_of_repose.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dem/bed/grain_shape.hpp"
#include "dem/bed/surface_height.hpp"
#include "scenario/grain_sizes.hpp"

namespace soilbin::dem {
namespace {

using std::numbers::pi;

constexpr double loose = 0.55;  // share of grains in the poured cylinder, about

void check(const AngleOfReposeSettings& s) {
  const Requirements require("angle of repose");
  require(s.radius >= 3 && s.height >= 3, "the cylinder must be at least 3 grains in radius and height");
  require(s.lift > 0 && s.lift <= 1, "the lift must lie in 0 .. 1");
  require(s.from >= 0 && s.to > s.from && s.to <= 1, "the part that is fitted must rise within 0 .. 1");
  require(s.sectors >= 3, "at least 3 sectors");
  require(s.floor_friction >= 0, "friction must not be below 0");
}

/// A tube about z, open at both ends: a sheet.
TriangleMesh tube(double radius, double height, int segments) {
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Corners> triangles;
  for (int k = 0; k < segments; ++k) {
    const double angle = 2 * pi * k / segments;
    for (const double z : {0.0, height}) vertices.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
    const int a = 2 * k, b = 2 * ((k + 1) % segments);
    triangles.push_back({a, b, b + 1});
    triangles.push_back({a, b + 1, a + 1});
  }
  MeshOptions options;
  options.name = "tube";
  return {std::move(vertices), std::move(triangles), options};
}

class Heap {
 public:
  Heap(const GranularSoil& soil, const AngleOfReposeSettings& settings, const WorkOptions& how)
      : soil_(soil),
        settings_(settings),
        d_(mean_diameter(soil)),
        gravity_(gravity_on(soil)),
        work_(how),
        simulation_(setup_for(how)) {
    pour();
  }
  AngleOfReposeResult run();

 private:
  Setup setup_for(const WorkOptions& how) const;
  void pour();
  void come_to_rest(const RestTest& test);
  void measure(AngleOfReposeResult& result) const;

  const GranularSoil& soil_;
  const AngleOfReposeSettings& settings_;
  double d_, gravity_;
  SteppedWork work_;
  Simulation simulation_;
  int tube_ = 0;
};

Setup Heap::setup_for(const WorkOptions& how) const {
  Setup setup = loose_setup(soil_, settings_.dt, 40 * (settings_.radius + settings_.height) * d_, how);
  add_wall_material(setup, soil_, settings_.floor_friction);
  setup.laws = with_cohesion_of(soil_.grain_grain, settings_.laws);
  return setup;
}

/// Fills the cylinder: grains put in loosely over the square around it, those outside taken away.
void Heap::pour() {
  GrainMaker maker(soil_, settings_.packing);
  const RadiusRange balls = maker.balls();
  const double radius = settings_.radius * d_, rim = radius - balls.largest;
  const double volume = pi * radius * radius * settings_.height * d_ * loose;
  const double mean_volume = 4 * pi / 3 * mean_cube(soil_);
  const double wanted = volume / mean_volume;
  Region region{{-radius, -radius, 0}, {radius, radius, 0}};
  while (room_for(region, balls) * pi / 4 * (rim * rim) / (radius * radius) < wanted) region.upper.z += balls.largest;
  insert_loosely([&](const Vec3& centre, double ball) { maker.put(simulation_, centre, ball); }, region, balls,
                 room_for(region, balls), settings_.packing);
  simulation_.remove_grains([&](const GrainNow& grain) {
    return std::hypot(grain.position.x, grain.position.y) > radius - 1.02 * grain.radius;
  });
  Body floor;
  floor.name = "floor";
  floor.surfaces.push_back({Plane{}, 1});
  simulation_.add_body(floor);
  Body sleeve;
  sleeve.name = "cylinder";
  sleeve.surfaces.push_back({surface_at(tube(radius, region.upper.z + d_, 64), {}), 1});
  tube_ = simulation_.add_body(sleeve);
  simulation_.set_gravity({0, 0, -gravity_});
}

void Heap::come_to_rest(const RestTest& test) {
  const double begin = simulation_.time();
  const auto steps = std::max<std::int64_t>(1, std::llround(test.every / simulation_.setup().numerics.dt));
  Unrest now;
  while (simulation_.time() - begin < test.at_most) {
    for (std::int64_t k = 0; k < steps; ++k) work_.step(simulation_);
    now = unrest(simulation_);
    if (now.kinetic < test.kinetic && now.unbalanced < test.unbalanced) return;
  }
  throw RunStopped(
      fmt::format("the heap did not come to rest in {:.3g} s: kinetic {:.3g} (asked {:.3g}), unbalanced {:.3g} (asked "
                  "{:.3g})\n  hint: grains without rolling friction roll on; give them some",
                  test.at_most, now.kinetic, test.kinetic, now.unbalanced, test.unbalanced));
}

/// Mean heights in rings, of one sector or (negative) all round.
std::vector<HeapProfile> profile_of(const SurfaceHeight& seen, int sector, int sectors, double wide) {
  std::vector<HeapProfile> rings;
  std::vector<int> count;
  const double dx = (seen.over.x_upper - seen.over.x_lower) / seen.nx;
  for (int iy = 0; iy < seen.ny; ++iy)
    for (int ix = 0; ix < seen.nx; ++ix) {
      const double x = seen.over.x_lower + (ix + 0.5) * dx, y = seen.over.y_lower + (iy + 0.5) * dx;
      const double turn = (std::atan2(y, x) + pi) / (2 * pi);
      if (sector >= 0 && std::min(sectors - 1, static_cast<int>(turn * sectors)) != sector) continue;
      const auto ring = static_cast<std::size_t>(std::hypot(x, y) / wide);
      if (ring >= rings.size()) rings.resize(ring + 1), count.resize(ring + 1);
      rings[ring].radius += std::hypot(x, y), rings[ring].height += seen.at(ix, iy), ++count[ring];
    }
  for (std::size_t k = 0; k < rings.size(); ++k)
    if (count[k] > 0) rings[k].radius /= count[k], rings[k].height /= count[k];
  return rings;
}

struct Slope {
  double angle, base;
};

/// A line through the flank: from the first ring below `high` to the last above `low`. Throws RunStopped with
/// `why_none` where there are too few or they do not fall outward.
Slope slope_of(const std::vector<HeapProfile>& profile, double low, double high, const char* why_none) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  bool below = false;
  for (const auto& [x, y] : profile) {
    below |= y < high;
    if (!below) continue;
    if (y < low) break;
    n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  const double determinant = n * sxx - sx * sx;
  const double slope = n < 2 || determinant <= 0 ? 0 : (n * sxy - sx * sy) / determinant;
  if (!(slope < 0)) throw RunStopped(why_none);
  return {std::atan(-slope), (sx - sy / slope) / n};
}

/// Cohesive grains stand as they were poured, up to the height that their cohesion bears.
const char* why_no_slope(const GranularSoil& soil) {
  const ContactPair& contact = soil.grain_grain;
  return contact.cohesion > 0 || contact.work_of_adhesion > 0 ? "the heap has no slope: its grains' cohesion holds up "
                                                                "its wall\n  hint: the soil's file without cohesion "
                                                                "between its grains tells what friction alone does"
                                                              : "the heap is too flat for a slope\n  hint: more grains";
}

void Heap::measure(AngleOfReposeResult& result) const {
  const double reach = 3 * (settings_.radius + settings_.height) * d_, wide = d_ / 2;
  const SurfaceHeight seen = surface_height(simulation_.state().grains, {-reach, reach, -reach, reach}, d_ / 6);
  result.profile = profile_of(seen, -1, 1, wide);
  for (const HeapProfile& ring : result.profile) result.height = std::max(result.height, ring.height);
  while (!result.profile.empty() && result.profile.back().height < 0.01 * d_) result.profile.pop_back();
  const double low = settings_.from * result.height, high = settings_.to * result.height;
  result.base = slope_of(result.profile, low, high, why_no_slope(soil_)).base;
  double sum = 0, squares = 0;
  for (int k = 0; k < settings_.sectors; ++k) {
    const double angle = slope_of(profile_of(seen, k, settings_.sectors, wide), low, high, why_no_slope(soil_)).angle;
    result.by_sector.push_back(angle);
    sum += angle, squares += angle * angle;
  }
  const double n = settings_.sectors;
  result.angle = {sum / n, std::sqrt(std::max(0.0, squares / n - sum * sum / (n * n)) / (n - 1))};
}

AngleOfReposeResult Heap::run() {
  AngleOfReposeResult result;
  const double dt = simulation_.setup().numerics.dt;
  result.mean_diameter = d_, result.packing = settings_.packing;
  result.lift_speed = settings_.lift * std::sqrt(gravity_ * d_);
  const double way = (settings_.height + 4) * d_;
  work_.expect((way / result.lift_speed + 3) / dt);
  work_.begin("settling");
  RestTest poured = settings_.rest;
  poured.kinetic *= 100;
  come_to_rest(poured);

  work_.begin("lifting");
  const double begin = simulation_.time();
  simulation_.body(tube_).velocity.z = result.lift_speed;
  const auto steps = std::llround(way / (result.lift_speed * dt));
  for (std::int64_t k = 0; k < steps; ++k) work_.step(simulation_);
  simulation_.body(tube_).velocity = {};
  come_to_rest(settings_.rest);
  result.settling_time = simulation_.time() - begin;
  result.grains = static_cast<int>(number_of_grains(simulation_.state()));
  measure(result);
  return result;
}

}  // namespace

AngleOfReposeResult angle_of_repose(const GranularSoil& soil, const AngleOfReposeSettings& settings,
                                    const WorkOptions& how) {
  check(settings);
  return Heap(soil, settings, how).run();
}

std::vector<AngleOfReposeResult> heaps_of_repose(const GranularSoil& soil, AngleOfReposeSettings settings, int packings,
                                                 const WorkOptions& how) {
  const Requirements require("angle of repose");
  require(packings >= 1, "at least one packing");
  require(settings.lowest >= 0, "the lowest heap must not be below 0");
  std::vector<AngleOfReposeResult> heaps{angle_of_repose(soil, settings, how)};
  const double wanted = settings.lowest * mean_diameter(soil);
  while (heaps.front().height < wanted) {
    // A heap's height goes as the cylinder's size, for grains of one slope.
    constexpr double spare = 1.05, smallest = 1.1, largest = 2;
    const double factor = std::clamp(spare * wanted / heaps.front().height, smallest, largest);
    if (heaps.front().grains * factor * factor * factor > most_heap_grains) break;
    AngleOfReposeSettings larger = settings;
    larger.radius *= factor, larger.height *= factor;
    try {
      heaps.front() = angle_of_repose(soil, larger, how);
    } catch (const RunStopped&) {  // soft grains that fall deeper overlap
      break;
    }
    settings = larger;
  }
  for (int k = 1; k < packings; ++k) {
    ++settings.packing;
    heaps.push_back(angle_of_repose(soil, settings, how));
  }
  return heaps;
}

}  // namespace soilbin::dem
