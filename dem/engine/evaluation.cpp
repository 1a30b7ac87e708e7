#include "dem/engine/evaluation.hpp"

#include <algorithm>
#include <array>

#include "dem/engine/pair_touch.hpp"
#include "dem/engine/world.hpp"

namespace soilbin::dem {
namespace {

/// One contact in all its parts.
struct Evaluated {
  std::uint32_t first;
  std::int64_t second;  ///< row, or -1 - body
  std::int32_t triangle;
  Vec3 point;
  double arm_second;
  LawConstants<double> constants;
  Touch<double> touch;
  Memory<double> memory;
  Response<double> does;
};

Memory<double> memory_of(const PairList& pairs, std::size_t pair) {
  return {{pairs.remembered(pair, 0), pairs.remembered(pair, 1), pairs.remembered(pair, 2)},
          {pairs.remembered(pair, 3), pairs.remembered(pair, 4), pairs.remembered(pair, 5)}};
}

template <class Visit>
void for_each_pair_contact(const World& world, const Visit& visit) {
  const State& s = world.state;
  const Setup& setup = world.setup;
  const Periods periods(setup.domain);
  const double dt = setup.numerics.dt;
  for (std::size_t pair = 0; pair < s.pairs.first.size(); ++pair) {
    const std::uint32_t i = s.pairs.first[pair], j = s.pairs.second[pair];
    const Motion &a = s.grains.motion[i], &b = s.grains.motion[j];
    const Vec3 between = periods.shortest(a.position - b.position);
    const double sum = a.radius + b.radius;
    // Rows from there on were idle when the list was made.
    if (i >= s.searched_at.size() || (squared(between) >= sum * sum && !s.pairs.touches(pair))) continue;
    Evaluated c{.first = i,
                .second = j,
                .triangle = -1,
                .point = {},
                .arm_second = 0,
                .constants = world.laws[world.kind(i, j)],
                .touch = touch_of_grains({a, s.grains.spin[i]}, {b, s.grains.spin[j]}, between, dt),
                .memory = memory_of(s.pairs, pair),
                .does = {}};
    const bool adheres = setup.laws.cohesion == CohesionLaw::jkr && s.pairs.touches(pair) &&
                         still_adheres(c.constants, c.touch.overlap, c.touch.radius);
    if (c.touch.overlap <= 0 && !adheres) continue;
    c.point = a.position - (a.radius - c.touch.overlap / 2) * vec3(c.touch.normal);
    c.arm_second = b.radius - c.touch.overlap / 2;
    c.does = contact_response<double>(setup.laws, c.constants, c.touch, c.memory, dt, nullptr);
    visit(c);
  }
}

template <class Visit>
void for_each_surface_contact(const World& world, const Visit& visit) {
  const State& s = world.state;
  const Setup& setup = world.setup;
  const double dt = setup.numerics.dt;
  Placed placed;
  placed.place(s.bodies);
  std::array<SurfaceTouch, 8> touches;
  std::vector<SurfaceContact> made;
  for (const SurfaceContacts& slab : s.surfaces) {
    std::size_t old = 0;
    for (const NearSurface& near : slab.near) {
      const std::size_t begin = old;
      while (old < slab.made.size() && slab.made[old].who == near) ++old;
      const Body& body = s.bodies[near.body];
      const Motion& grain = s.grains.motion[near.grain];
      const LawConstants<double>& constants = world.laws[world.kind(near)];
      made.clear();
      const GrainOnSurface at{.who = near,
                              .grain = grain,
                              .surface = placed.at(near),
                              .constants = constants,
                              .adhesion_reach = world.margins.adhesion,
                              .before = {slab.made.data() + begin, old - begin}};
      const int count = find_contacts(at, made, touches);
      for (int k = 0; k < count; ++k) {
        Evaluated c{.first = near.grain,
                    .second = -1 - near.body,
                    .triangle = touches[k].triangle,
                    .point = touches[k].point,
                    .arm_second = 0,
                    .constants = constants,
                    .touch = dem::touch_of(body, touches[k], grain, s.grains.spin[near.grain]),
                    .memory = made[k].memory,
                    .does = {}};
        c.does = contact_response<double>(setup.laws, c.constants, c.touch, c.memory, dt, nullptr);
        visit(c);
      }
    }
  }
}

/// Contact by contact, in a fixed order.
template <class Visit>
void for_each_contact(const World& world, const Visit& visit) {
  for_each_pair_contact(world, visit);
  for_each_surface_contact(world, visit);
}

}  // namespace

std::vector<Contact> contacts_of(const World& world) {
  std::vector<Contact> all;
  for_each_contact(world, [&](const Evaluated& c) {
    const std::int64_t second = c.second >= 0 ? static_cast<std::int64_t>(world.state.grains.id[c.second]) : c.second;
    all.push_back({.first = world.state.grains.id[c.first],
                   .second = second,
                   .triangle = c.triangle,
                   .point = c.point,
                   .normal = vec3(c.touch.normal),
                   .overlap = c.touch.overlap,
                   .force = vec3(c.does.force),
                   .couple = vec3(c.does.couple),
                   .pressing = c.does.pressing});
  });
  return all;
}

std::vector<Load> loads_of(const World& world) {
  std::vector<Load> all(world.state.grains.count());
  for_each_contact(world, [&](const Evaluated& c) {
    const Vec3 force = vec3(c.does.force), couple = vec3(c.does.couple), normal = vec3(c.touch.normal);
    Load& first = all[c.first];
    first.force += force;
    first.torque += couple + cross(c.point - world.state.grains.motion[c.first].position, force);
    if (c.second < 0) return;
    Load& second = all[c.second];
    second.force -= force;
    second.torque -= couple + c.arm_second * cross(normal, force);
  });
  return all;
}

bool is_new(const World& world, std::size_t row) {
  return std::binary_search(world.state.new_grains.begin(), world.state.new_grains.end(), world.state.grains.id[row]);
}

Kick kick_of(const World& world, std::size_t row, const Load& load, double time) {
  const Motion& grain = world.state.grains.motion[row];
  return {time * (grain.inverse_mass * load.force + (grain.held() ? 0.0 : 1.0) * world.state.gravity),
          (time * world.state.grains.spin[row].inverse_inertia) * load.torque};
}

std::vector<Kick> kicks_of(const World& world, const std::vector<Load>& loads, double time) {
  const State& s = world.state;
  std::vector<Kick> all(loads.size());
  for (std::size_t row = 0; row < all.size(); ++row)
    if (s.grains.clump[row] == lone) all[row] = kick_of(world, row, loads[row], time);
  for (const Clump& clump : s.clumps.all) {
    if (s.clumps.held(clump, s.grains)) continue;
    const Acceleration change = acceleration(clump, load_of(s.clumps, clump, loads), s.gravity);
    for (const ClumpMember& member : s.clumps.of(clump))
      all[member.row] = {time * (change.velocity + cross(change.spin, clump.motion.rotation(member.arm))),
                         time * change.spin};
  }
  return all;
}

GrainNow motion_at(const World& world, std::size_t row, const Kick& kick) {
  const Motion& grain = world.state.grains.motion[row];
  GrainNow now{grain.position, grain.velocity, world.state.grains.spin[row].rate, grain.radius};
  if (is_new(world, row)) return now;
  now.velocity += kick.velocity;
  now.spin += kick.spin;
  return now;
}

namespace {

/// Kinetic and potential energy of the clumps, at a whole step.
void add_clumps(const World& world, const std::vector<Load>& loads, EnergyBalance& out) {
  const State& s = world.state;
  const double half = world.setup.numerics.dt / 2;
  for (const Clump& clump : s.clumps.all) {
    if (s.clumps.held(clump, s.grains) || is_new(world, s.clumps.row_of(clump))) continue;
    const Acceleration change = acceleration(clump, load_of(s.clumps, clump, loads), s.gravity);
    out.kinetic +=
        kinetic_energy(clump, clump.motion.velocity + half * change.velocity, clump.motion.spin + half * change.spin);
    out.potential -= clump.mass * dot(s.gravity, clump.motion.position);
  }
}

}  // namespace

EnergyBalance energy_of(const World& world) {
  const State& s = world.state;
  EnergyBalance out;
  const std::vector<Load> loads = loads_of(world);
  const std::vector<Kick> kicks = kicks_of(world, loads, world.setup.numerics.dt / 2);
  for (std::size_t k = 0; k < s.grains.count(); ++k) {
    const Motion& grain = s.grains.motion[k];
    if (grain.held() || is_new(world, k) || s.grains.clump[k] != lone) continue;
    const GrainNow now = motion_at(world, k, kicks[k]);
    out.kinetic +=
        0.5 * (squared(now.velocity) / grain.inverse_mass + squared(now.spin) / s.grains.spin[k].inverse_inertia);
    out.potential -= dot(s.gravity, grain.position) / grain.inverse_mass;
  }
  add_clumps(world, loads, out);
  std::vector<BodyLoad> on_bodies(s.bodies.size());
  for_each_contact(world, [&](const Evaluated& c) {
    if (c.second < 0) {
      const Vec3 force = vec3(c.does.force);
      BodyLoad& on_body = on_bodies[-1 - c.second];
      on_body.force -= force;
      on_body.torque -= vec3(c.does.couple) + cross(c.point - s.bodies[-1 - c.second].position, force);
    }
    const Stored<double> stored = stored_energy(world.setup.laws, c.constants, c.touch, c.memory);
    out.elastic += stored.normal;
    out.tangential += stored.tangential;
    out.rolling += stored.rolling;
  });
  for (std::size_t b = 0; b < s.bodies.size(); ++b) {
    const Body& body = s.bodies[b];
    const Acceleration change = acceleration(body, on_bodies[b].force, on_bodies[b].torque, s.gravity);
    const double half = world.setup.numerics.dt / 2;
    out.kinetic += free_energy(body, body.velocity + half * change.velocity, body.spin + half * change.spin);
    if (body.weighs) out.potential -= body.mass * dot(s.gravity, where(body.free_translation, body.position));
    out.work_of_drives += body.driven_work;
  }
  out.ledger = s.ledger;
  return out;
}

}  // namespace soilbin::dem
