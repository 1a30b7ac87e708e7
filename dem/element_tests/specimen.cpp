#include "dem/element_tests/specimen.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenario/errors.hpp"
#include "scenario/estimate.hpp"

namespace soilbin::dem {

void Requirements::operator()(bool holds, const std::string& what) const {
  if (!holds) throw InputError(fmt::format("{}: {}", test_, what));
}

BedRecipe specimen_recipe(const GranularSoil& soil, const BedSize& size, const SpecimenSettings& settings) {
  BedRecipe recipe;
  recipe.soil = soil;
  recipe.gravity = gravity_on(soil);
  recipe.size = size;
  recipe.packing = settings.packing;
  recipe.settling_friction = settings.settling_friction;
  recipe.dt = settings.dt;
  recipe.laws = settings.laws;
  // A specimen is pressed next, so it need not be as still as a bed: one grain that rocks would keep a box from rest.
  recipe.rest.kinetic *= 100;
  return recipe;
}

std::shared_ptr<const SettledBed> specimen_bed(const BedRecipe& recipe, const WorkOptions& how, BedStore* beds) {
  if (beds) return beds->bed(recipe, how);
  return std::make_shared<const SettledBed>(settle_bed(recipe, how));
}

Setup specimen_setup(const SettledBed& bed, const WorkOptions& how) {
  Setup setup = bed.setup;
  const BedSize& size = bed.recipe.size;
  const double room = size.length + size.width + size.depth;
  setup.domain.lower = {-room, -room, -room};
  setup.domain.upper = {size.length + room, size.width + room, size.depth + room};
  setup.numerics.skin = 0.2 * bed.recipe.soil.radius_max;
  setup.numerics.threads = how.threads;
  return setup;
}

Setup loose_setup(const GranularSoil& soil, double dt, double room, const WorkOptions& how) {
  Setup setup;
  setup.materials.add({"grains", soil.grain_density, soil.youngs_modulus, soil.poisson_ratio},
                      interaction_of(soil.grain_grain));
  setup.domain = {{-room, -room, -mean_diameter(soil)}, {room, room, room}};
  if (!(dt >= 0)) throw InputError(fmt::format("a time step of {} s: above 0, or 0 for the longest that is safe", dt));
  setup.numerics.dt = dt > 0 ? dt : longest_step(soil);
  check_pace(soil, gravity_on(soil), setup.numerics.dt);
  setup.numerics.skin = 0.2 * soil.radius_max;
  setup.numerics.threads = how.threads;
  return setup;
}

int add_wall_material(Setup& setup, const GranularSoil& soil, double share_of_friction) {
  Interaction interaction = interaction_of(soil.grain_grain);
  interaction.sliding_friction *= share_of_friction;
  interaction.rolling_friction *= share_of_friction;
  interaction.cohesion *= share_of_friction;
  return setup.materials.add({"wall", soil.grain_density, soil.youngs_modulus, soil.poisson_ratio}, interaction);
}

int add_gripping_material(Setup& setup, const GranularSoil& soil) {
  Interaction interaction = interaction_of(soil.grain_grain);
  interaction.sliding_friction = std::max(1.0, interaction.sliding_friction);
  interaction.rolling_friction = std::max(1.0, interaction.rolling_friction);
  return setup.materials.add({"gripping wall", soil.grain_density, soil.youngs_modulus, soil.poisson_ratio},
                             interaction);
}

namespace {

ClumpMotion at_rest(const ClumpMotion& motion) { return {.position = motion.position, .rotation = motion.rotation}; }

}  // namespace

double put_grains(Simulation& simulation, const SettledBed& bed) {
  // By id, so that the order does not depend on where the bed's search for pairs left them.
  constexpr std::uint32_t none = ~0u;
  std::vector<std::uint32_t> row_of(bed.state.next_id, none);
  const Grains& grains = bed.state.grains;
  for (std::uint32_t k = 0; k < grains.count(); ++k) row_of[grains.id[k]] = k;
  double top = 0;
  for (const std::uint32_t row : row_of) {
    if (row == none) continue;
    const Motion& grain = grains.motion[row];
    if (grains.clump[row] == lone)
      simulation.add_grain(grain.position, grain.radius, grain_material);
    else if (bed.state.clumps.of(bed.state.clumps.all[grains.clump[row]]).front().row == row)
      simulation.add_clump(
          shape_of(grains, bed.state.clumps, grains.clump[row], bed.setup.materials.all[grain_material].density),
          at_rest(bed.state.clumps.all[grains.clump[row]].motion), grain_material);
    top = std::max(top, grain.position.z + grain.radius);
  }
  return top;
}

Servo press(const Vec3& direction, double stress, double area, const GranularSoil& soil, double dt) {
  const double d = mean_diameter(soil);
  const double young = soil.youngs_modulus / (2 * (1 - soil.poisson_ratio * soil.poisson_ratio));
  const double overlap = std::pow(0.75 * stress * d * d / (young * std::sqrt(d / 4)), 2.0 / 3);
  const double count = area / (d * d), stiffness = 2 * young * std::sqrt(d / 4 * overlap);
  const double mass = soil.grain_density * std::numbers::pi / 6 * d * d * d;
  const double e = std::max(soil.grain_grain.restitution, 1e-6);
  const double beta = -std::log(e) / std::hypot(std::log(e), std::numbers::pi);
  const double dashpot = 2 * std::sqrt(5.0 / 6) * beta * std::sqrt(stiffness * mass);
  constexpr double share = 0.3;  // of a layer's force error that a step takes back
  return {.direction = direction,
          .target = stress * area,
          .gain = share / (count * (dt * stiffness + dashpot)),
          .fastest = 0.05 * std::sqrt(stress / soil.grain_density)};
}

double inertial_number(double rate, double pressure, const GranularSoil& soil) {
  return rate * mean_diameter(soil) * std::sqrt(soil.grain_density / pressure);
}

double shear_rate(double inertial_number, double pressure, const GranularSoil& soil) {
  return inertial_number / (mean_diameter(soil) * std::sqrt(soil.grain_density / pressure));
}

double void_ratio_within(const Simulation& simulation, const BedSize& size, double height) {
  const Grains& grains = simulation.state().grains;
  double sum = 0;
  for (std::size_t k = 0; k < grains.count(); ++k) sum += grains.motion[k].radius;
  const double radius = sum / static_cast<double>(grains.count());
  return 1 / solid_fraction(grains, core(size, height, 2 * radius), radius / 6) - 1;
}

MeshSurface surface_of(const TriangleMesh& mesh, const std::function<Vec3(const Vec3&)>& place) {
  std::vector<Vec3> vertices;
  for (const Vec3& vertex : mesh.vertices()) vertices.push_back(place(vertex));
  MeshOptions options;
  options.closed = mesh.closed();
  options.name = mesh.name();
  return {std::make_shared<TriangleMesh>(std::move(vertices), mesh.triangles(), options), nullptr};
}

MeshSurface surface_at(const TriangleMesh& mesh, const Vec3& by) {
  return surface_of(mesh, [&](const Vec3& vertex) { return vertex + by; });
}

std::int64_t steps_of_sample(double way, double way_of_step, int samples) {
  return std::max<std::int64_t>(1, std::llround(way / (way_of_step * samples)));
}

void SteppedWork::step(Simulation& simulation) {
  if (static_cast<std::int64_t>(done_) % 100 == 0) tell();
  simulation.run(1);
  done_ += 1;
}

void SteppedWork::settle_wall(Simulation& simulation, int body, double length, double at_most) {
  const double begin = simulation.time();
  const std::int64_t steps = std::llround(0.02 / simulation.setup().numerics.dt) + 1;
  double error = 1;
  for (int good = 0; simulation.time() - begin < at_most;) {
    const Servo servo = *simulation.body(body).servo;
    const Vec3 from = simulation.body(body).position;
    double force = 0;
    for (std::int64_t k = 0; k < steps; ++k) {
      step(simulation);
      force += dot(simulation.body(body).force, servo.direction) / static_cast<double>(steps);
    }
    error = std::abs(force / servo.target - 1);
    const double moved = std::sqrt(squared(simulation.body(body).position - from));
    good = error < 0.01 && moved < 1e-4 * length ? good + 1 : 0;
    if (good == 3) return;
  }
  throw RunStopped(fmt::format("wall '{}' did not come to rest under its load in {:.3g} s: off by {:.2g} of it",
                               simulation.body(body).name, at_most, error));
}

void SteppedWork::tell() const {
  if (how_.stop.stop_requested()) throw Stopped();
  if (!how_.progress) return;
  const double share = expected_ > 0 ? std::min(0.999, done_ / expected_) : 0;
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - began_;
  how_.progress({stage_, share, share > 0.01 ? spent.count() * (1 - share) / share : not_a_number});
}

}  // namespace soilbin::dem
