#include "dem/engine/clumps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "dem/engine/world.hpp"
#include "dem/surface/turning.hpp"
#include "scenario/errors.hpp"

namespace soilbin::dem {
namespace {

bool sleeps(const World& world, const Clump& clump) {
  if (world.setup.numerics.sleep.speed == 0) return false;
  const std::vector<std::uint32_t>& begins = world.state.slab_rows;
  const auto of_clump = world.state.clumps.of(clump);
  return std::any_of(of_clump.begin(), of_clump.end(), [&](const ClumpMember& member) {
    const auto after = std::upper_bound(begins.begin(), begins.end(), member.row);
    return world.sleeping[static_cast<int>(after - begins.begin()) - 1];
  });
}

void stand_still(State& s, Clump& clump) {
  clump.motion.velocity = clump.motion.spin = {};
  carry_velocity(s.clumps, clump, clump.motion.rotation, s.grains);
}

/// What its spheres feel, about its centre of mass.
Load load_of(std::span<const ClumpMember> spheres, const RotationMatrix& turn, std::span<const Load> loads) {
  Load sum;
  for (const ClumpMember& member : spheres) {
    const Load& load = loads[member.row];
    sum.force += load.force;
    sum.torque += load.torque + cross(turn(member.arm), load.force);
  }
  return sum;
}

/// Where the ledger is kept: what the contacts of its spheres take from the motion (EnergyLedger).
void count_kicks(World& world, const Clump& clump, const Load& load) {
  State& s = world.state;
  const Acceleration change = acceleration(clump, load, s.gravity);
  const double half = world.setup.numerics.dt / 2;
  for (const ClumpMember& member : s.clumps.of(clump)) {
    const Vec3 arm = clump.motion.rotation(member.arm);
    world.ledger.count_kick(member.row, s.grains.load[member.row],
                            {half * (change.velocity + cross(change.spin, arm)), half * change.spin},
                            world.found.front().lost);
  }
}

/// Gives a bound on the speed of its spheres [m/s].
double move(World& world, Clump& clump) {
  State& s = world.state;
  ClumpMotion& motion = clump.motion;
  const double dt = world.setup.numerics.dt;
  const std::span<const ClumpMember> spheres = s.clumps.of(clump);
  const RotationMatrix before = matrix_of(motion.rotation);
  const Load load = load_of(spheres, before, s.grains.load);
  if (world.setup.numerics.ledger) count_kicks(world, clump, load);
  motion.velocity += dt * (load.force / clump.mass + s.gravity);
  motion.spin = spin_after(motion.rotation, clump.inertia, motion.spin, load.torque, dt);
  motion.position += dt * motion.velocity;
  motion.rotation = turned(motion.rotation, dt * motion.spin);
  const RotationMatrix after = matrix_of(motion.rotation);
  const Periods periods(world.setup.domain);
  double farthest = 0;
  for (const ClumpMember& member : spheres) {
    Motion& sphere = s.grains.motion[member.row];
    const Vec3 arm = after(member.arm);
    // Spheres live at half steps as all grains: there its arm lies halfway.
    sphere.velocity = motion.velocity + cross(motion.spin, 0.5 * (before(member.arm) + arm));
    sphere.position += periods.shortest(motion.position + arm - sphere.position);
    s.grains.spin[member.row].rate = motion.spin;
    s.grains.load[member.row] = {};
    farthest = std::max(farthest, squared(member.arm));
  }
  return length(motion.velocity) + std::sqrt(farthest) * length(motion.spin);
}

}  // namespace

ClumpShape ClumpShape::scaled(double factor) const {
  ClumpShape out = *this;
  for (Sphere& sphere : out.spheres) sphere = {factor * sphere.centre, factor * sphere.radius};
  out.volume *= std::pow(factor, 3);
  out.inertia = std::pow(factor, 5) * inertia;
  return out;
}

double ClumpShape::reach() const {
  double farthest = 0;
  for (const Sphere& sphere : spheres) farthest = std::max(farthest, length(sphere.centre) + sphere.radius);
  return farthest;
}

ClumpShape clump_shape(std::vector<Sphere> spheres) {
  if (spheres.empty()) throw InputError("a clump needs a sphere");
  const MassProperties properties = mass_properties(spheres);
  const PrincipalAxes axes = principal_axes(properties);
  const Rotation back = axes.rotation.inverse();
  for (Sphere& sphere : spheres) sphere.centre = back(sphere.centre - properties.centroid);
  return {std::move(spheres), properties.volume, axes.inertia};
}

void Clumps::find_rows(const Grains& grains) {
  if (all.empty()) return;
  for (std::uint32_t row = 0; row < grains.count(); ++row) {
    if (grains.clump[row] == lone) continue;
    const Clump& clump = all[grains.clump[row]];
    const auto begin = members.begin() + clump.first;
    std::find_if(begin, begin + clump.count, [&](const ClumpMember& m) { return m.id == grains.id[row]; })->row = row;
  }
}

void Clumps::join(std::vector<std::uint8_t>& marked) const {
  for (const Clump& clump : all) {
    const auto spheres = of(clump);
    if (std::any_of(spheres.begin(), spheres.end(), [&](const ClumpMember& m) { return marked[m.row] != 0; }))
      for (const ClumpMember& member : spheres) marked[member.row] = 1;
  }
}

void Clumps::remove(std::span<const std::uint8_t> gone, Grains& grains) {
  std::uint32_t clumps = 0, first = 0;
  for (const Clump& clump : all) {
    const ClumpMember* spheres = members.data() + clump.first;
    if (gone[spheres->row]) continue;
    Clump kept = clump;
    kept.first = first;
    for (std::uint32_t k = 0; k < clump.count; ++k) {
      grains.clump[spheres[k].row] = clumps;
      members[first++] = spheres[k];
    }
    all[clumps++] = kept;
  }
  all.resize(clumps);
  members.resize(first);
}

ClumpShape shape_of(const Grains& grains, const Clumps& clumps, std::uint32_t index, double density) {
  const Clump& clump = clumps.all[index];
  ClumpShape shape{.spheres = {}, .volume = clump.mass / density, .inertia = clump.inertia / density};
  for (const ClumpMember& member : clumps.of(clump))
    shape.spheres.push_back({member.arm, grains.motion[member.row].radius});
  return shape;
}

double mass_share(const Grains& grains, const Clumps& clumps, std::size_t row) {
  const double mass = 1 / grains.motion[row].inverse_mass;
  return grains.clump[row] == lone ? mass : mass / clumps.all[grains.clump[row]].count;
}

Load load_of(const Clumps& clumps, const Clump& clump, std::span<const Load> loads) {
  return load_of(clumps.of(clump), matrix_of(clump.motion.rotation), loads);
}

Acceleration acceleration(const Clump& clump, const Load& load, const Vec3& gravity) {
  const ClumpMotion& motion = clump.motion;
  return {load.force / clump.mass + gravity, spin_rate(motion.rotation, clump.inertia, motion.spin, load.torque)};
}

double kinetic_energy(const Clump& clump, const Vec3& velocity, const Vec3& spin) {
  const Vec3 momentum = angular_momentum(clump.motion.rotation, clump.inertia, spin);
  return 0.5 * (clump.mass * squared(velocity) + dot(spin, momentum));
}

void carry_velocity(const Clumps& clumps, const Clump& clump, const Rotation& arms_at, Grains& grains) {
  for (const ClumpMember& member : clumps.of(clump)) {
    grains.motion[member.row].velocity = clump.motion.velocity + cross(clump.motion.spin, arms_at(member.arm));
    grains.spin[member.row].rate = clump.motion.spin;
  }
}

double move_clumps(World& world) {
  State& s = world.state;
  if (s.clumps.all.empty()) return 0;  // beds of spheres start no threads for it
  const auto count = static_cast<std::ptrdiff_t>(s.clumps.all.size());
  double fastest = 0;
  bool finite = true;
  // The ledger is one sum, in the clumps' order.
#pragma omp parallel for num_threads(world.threads) if (!world.setup.numerics.ledger) reduction(max : fastest) \
    reduction(&& : finite)
  for (std::ptrdiff_t k = 0; k < count; ++k) {
    Clump& clump = s.clumps.all[static_cast<std::size_t>(k)];
    if (s.clumps.held(clump, s.grains) || sleeps(world, clump)) {
      stand_still(s, clump);
      for (const ClumpMember& member : s.clumps.of(clump)) {
        s.grains.load[member.row] = {};
        world.ledger.clear(member.row, member.row + 1);
      }
      continue;
    }
    const double speed = move(world, clump);
    fastest = std::max(fastest, speed);
    finite = finite && speed < 1e15;
  }
  return finite ? fastest : std::numeric_limits<double>::infinity();
}

void still_sleeping_clumps(World& world) {
  for (Clump& clump : world.state.clumps.all)
    if (sleeps(world, clump)) stand_still(world.state, clump);
}

}  // namespace soilbin::dem
