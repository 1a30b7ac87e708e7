// What Simulation tells of the present time: contacts, motion at whole steps, energy. The forces are those that the
// next step will find; nothing is changed.
#include <algorithm>
#include <stdexcept>
#include <string>

#include "dem/engine/periodic.hpp"
#include "dem/engine/simulation.hpp"

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

Touch<double> touch_of(const Grains& grains, std::uint32_t i, std::uint32_t j, const Vec3& between) {
  const Motion &a = grains.motion[i], &b = grains.motion[j];
  const Spin &wa = grains.spin[i], &wb = grains.spin[j];
  const Vec3 normal = unit(between);
  const double overlap = a.radius + b.radius - length(between);
  const Vec3 turn = (a.radius - overlap / 2) * wa.rate + (b.radius - overlap / 2) * wb.rate;
  return {.normal = triple(normal),
          .overlap = overlap,
          .radius = a.radius * b.radius / (a.radius + b.radius),
          .mass = 1 / (a.inverse_mass + b.inverse_mass),
          .velocity = triple(a.velocity - b.velocity - cross(turn, normal)),
          .rotation = triple(wa.rate - wb.rate),
          .inertia = 1 / (wa.inverse_inertia + wb.inverse_inertia)};
}

Memory<double> memory_of(const PairList& pairs, std::size_t pair) {
  return {{pairs.remembered(pair, 0), pairs.remembered(pair, 1), pairs.remembered(pair, 2)},
          {pairs.remembered(pair, 3), pairs.remembered(pair, 4), pairs.remembered(pair, 5)}};
}

}  // namespace

template <class Visit>
void Simulation::for_each_contact(const Visit& visit) const {
  const State& s = state_;
  const Periods periods(setup_.domain);
  const double dt = setup_.numerics.dt;
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
                .constants = constants_of(kind_of(s.grains.material[i], s.grains.material[j])),
                .touch = touch_of(s.grains, i, j, between),
                .memory = memory_of(s.pairs, pair),
                .does = {}};
    const bool adheres = setup_.laws.cohesion == CohesionLaw::jkr && s.pairs.touches(pair) &&
                         still_adheres(c.constants, c.touch.overlap, c.touch.radius);
    if (c.touch.overlap <= 0 && !adheres) continue;
    c.point = a.position - (a.radius - c.touch.overlap / 2) * vec3(c.touch.normal);
    c.arm_second = b.radius - c.touch.overlap / 2;
    c.does = contact_response<double>(setup_.laws, c.constants, c.touch, c.memory, dt, nullptr);
    visit(c);
  }
  std::array<SurfaceTouch, 8> touches;
  std::vector<SurfaceContact> made;
  for (const SurfaceContacts& slab : s.surfaces) {
    std::size_t old = 0;
    for (const NearSurface& near : slab.near) {
      const std::size_t begin = old;
      while (old < slab.made.size() && slab.made[old].who == near) ++old;
      const Body& body = s.bodies[near.body];
      const Motion& grain = s.grains.motion[near.grain];
      const LawConstants<double>& constants =
          constants_of(kind_of(s.grains.material[near.grain], body.surfaces[near.surface].material));
      made.clear();
      const int count =
          find_contacts(place(body, body.surfaces[near.surface]), near, grain, {constants, adhesion_reach_},
                        {slab.made.data() + begin, old - begin}, made, touches);
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
        c.does = contact_response<double>(setup_.laws, c.constants, c.touch, c.memory, dt, nullptr);
        visit(c);
      }
    }
  }
}

std::vector<Contact> Simulation::contacts() const {
  std::vector<Contact> all;
  for_each_contact([&](const Evaluated& c) {
    const std::int64_t second = c.second >= 0 ? static_cast<std::int64_t>(state_.grains.id[c.second]) : c.second;
    all.push_back({.first = state_.grains.id[c.first],
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

std::vector<Load> Simulation::loads() const {
  std::vector<Load> all(state_.grains.count());
  for_each_contact([&](const Evaluated& c) {
    const Vec3 force = vec3(c.does.force), couple = vec3(c.does.couple), normal = vec3(c.touch.normal);
    Load& first = all[c.first];
    first.force += force;
    first.torque += couple + cross(c.point - state_.grains.motion[c.first].position, force);
    if (c.second < 0) return;
    Load& second = all[c.second];
    second.force -= force;
    second.torque -= couple + c.arm_second * cross(normal, force);
  });
  return all;
}

std::size_t Simulation::row_of(GrainId id) const {
  const auto found = std::find(state_.grains.id.begin(), state_.grains.id.end(), id);
  if (found == state_.grains.id.end()) throw std::out_of_range("there is no grain " + std::to_string(id));
  return found - state_.grains.id.begin();
}

bool Simulation::is_new(std::size_t row) const {
  return std::binary_search(state_.new_grains.begin(), state_.new_grains.end(), state_.grains.id[row]);
}

Simulation::Kick Simulation::kick(std::size_t row, const Load& load, double time) const {
  const Motion& grain = state_.grains.motion[row];
  return {time * (grain.inverse_mass * load.force + (grain.held() ? 0.0 : 1.0) * state_.gravity),
          (time * state_.grains.spin[row].inverse_inertia) * load.torque};
}

GrainNow Simulation::motion_at(std::size_t row, const Load& load) const {
  const Motion& grain = state_.grains.motion[row];
  GrainNow now{grain.position, grain.velocity, state_.grains.spin[row].rate, grain.radius};
  if (is_new(row)) return now;
  const Kick change = kick(row, load, setup_.numerics.dt / 2);
  now.velocity += change.velocity;
  now.spin += change.spin;
  return now;
}

GrainNow Simulation::grain(GrainId id) const {
  const std::size_t row = row_of(id);
  return motion_at(row, is_new(row) ? Load{} : loads()[row]);
}

std::vector<GrainNow> Simulation::grains() const {
  const std::vector<Load> all = loads();
  std::vector<GrainNow> out;
  for (std::size_t row = 0; row < all.size(); ++row) out.push_back(motion_at(row, all[row]));
  return out;
}

/// Velocities of the grains that are new, or of the others, become those of `time` later [s].
void Simulation::shift(bool new_ones, double time) {
  State& s = state_;
  const std::vector<Load> all = loads();
  for (std::size_t k = 0; k < s.grains.count(); ++k) {
    if (is_new(k) != new_ones) continue;
    const Kick change = kick(k, all[k], time);
    s.grains.motion[k].velocity += change.velocity;
    s.grains.spin[k].rate += change.spin;
  }
}

/// Velocities of new grains are those of a whole step; all others live at half steps.
void Simulation::half_step_back() {
  if (state_.new_grains.empty()) return;
  shift(true, -setup_.numerics.dt / 2);
  state_.new_grains.clear();
}

EnergyBalance Simulation::energy() const {
  const State& s = state_;
  EnergyBalance out;
  const std::vector<Load> all = loads();
  for (std::size_t k = 0; k < s.grains.count(); ++k) {
    const Motion& grain = s.grains.motion[k];
    if (grain.held() || is_new(k)) continue;
    const GrainNow now = motion_at(k, all[k]);
    out.kinetic +=
        0.5 * (squared(now.velocity) / grain.inverse_mass + squared(now.spin) / s.grains.spin[k].inverse_inertia);
    out.potential -= dot(s.gravity, grain.position) / grain.inverse_mass;
  }
  std::vector<BodyLoad> on_bodies(s.bodies.size());
  for_each_contact([&](const Evaluated& c) {
    if (c.second < 0) {
      const Vec3 force = vec3(c.does.force);
      BodyLoad& on_body = on_bodies[-1 - c.second];
      on_body.force -= force;
      on_body.torque -= vec3(c.does.couple) + cross(c.point - s.bodies[-1 - c.second].position, force);
    }
    const Stored<double> stored = stored_energy(setup_.laws, c.constants, c.touch, c.memory);
    out.elastic += stored.normal;
    out.tangential += stored.tangential;
    out.rolling += stored.rolling;
  });
  for (std::size_t b = 0; b < s.bodies.size(); ++b) {
    const Body& body = s.bodies[b];
    const Acceleration change = acceleration(body, on_bodies[b].force, on_bodies[b].torque, s.gravity);
    const double half = setup_.numerics.dt / 2;
    out.kinetic += free_energy(body, body.velocity + half * change.velocity, body.spin + half * change.spin);
    if (body.weighs) out.potential -= body.mass * dot(s.gravity, where(body.free_translation, body.position));
    out.work_of_drives += body.driven_work;
  }
  out.ledger = s.ledger;
  return out;
}

/// Contacts told what they took from the motion by velocities of half a step ago. The work of a load on the way from
/// that half step to the next is exactly that at the mean of both velocities; this adds the difference.
void Simulation::count_kick(int slab, std::uint32_t row) {
  const Load& load = state_.grains.load[row];
  Taking& taking = taking_[row];
  const Kick half = kick(row, load, setup_.numerics.dt / 2);
  double* losses = found_[slab].losses;  // in the order of Losses
  const double rolled = dot(taking.couple, half.spin);
  losses[0] -= dot(taking.dashpot, half.velocity);
  losses[3] -= dot(taking.slide, half.velocity) + dot(load.torque, half.spin) - rolled;
  losses[4] -= rolled;
  taking = {};
}

/// What contacts of jkr that broke in the last step had stored [J]: each is stretched to its utmost when it breaks.
double Simulation::broken_bonds() const {
  if (setup_.laws.cohesion != CohesionLaw::jkr) return 0;
  const State& s = state_;
  double sum = 0;
  const auto broken = [&](const LawConstants<double>& constants, double radius) {
    Touch<double> touch{};
    touch.overlap = -adhesion_reach(constants, radius);
    touch.radius = radius;
    sum += stored_energy(setup_.laws, constants, touch, {}).normal;
  };
  for (std::size_t pair = 0; pair < s.pairs.first.size(); ++pair) {
    if (!(bonds_before_[pair / batch_size] >> (pair % batch_size) & 1) || s.pairs.touches(pair)) continue;
    const std::uint32_t i = s.pairs.first[pair], j = s.pairs.second[pair];
    const double a = s.grains.motion[i].radius, b = s.grains.motion[j].radius;
    broken(constants_of(kind_of(s.grains.material[i], s.grains.material[j])), a * b / (a + b));
  }
  for (std::size_t slab = 0; slab < s.surfaces.size(); ++slab) {
    if (asleep_[slab]) continue;
    const std::vector<SurfaceContact>&old = made_[slab], &now = s.surfaces[slab].made;
    std::size_t in_old = 0, in_now = 0;
    for (const NearSurface& near : s.surfaces[slab].near) {
      int gone = 0;
      for (; in_old < old.size() && old[in_old].who == near; ++in_old) ++gone;
      for (; in_now < now.size() && now[in_now].who == near; ++in_now) --gone;
      const int material = s.bodies[near.body].surfaces[near.surface].material;
      for (; gone > 0; --gone)
        broken(constants_of(kind_of(s.grains.material[near.grain], material)), s.grains.motion[near.grain].radius);
    }
  }
  return sum;
}

}  // namespace soilbin::dem
