// A step of the engine on grains that LAMMPS moves: forces of pairs and surfaces, what contacts remember, the bodies.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "dem/bed/settled_bed.hpp"
#include "dem/engine/laws/contact_law.hpp"
#include "dem/engine/pair_touch.hpp"
#include "dem/worker_lammps/lammps_simulation.hpp"
#include "dem/worker_lammps/processes.hpp"

namespace soilbin::dem {
namespace {

constexpr std::int64_t between_logs = 1000;  // steps after which LAMMPS's log begins anew: it has some lines a step

void add(double* to, const Vec3& a) { to[0] += a.x, to[1] += a.y, to[2] += a.z; }

bool comes_first(const SurfaceContact& a, const SurfaceContact& b) {
  return std::tie(a.who.grain, a.who.body, a.who.surface) < std::tie(b.who.grain, b.who.body, b.who.surface);
}

}  // namespace

void LammpsSimulation::run(std::int64_t steps) {
  if (!prepared_) {
    lammps_.call_for_forces("soil", &LammpsSimulation::on_forces, this);
    lammps_.command("run 0 post no");
    prepared_ = true;
  }
  for (std::int64_t k = 0; k < steps && stopped_.empty(); ++k) {
    if (!log_.empty() && done_ % between_logs == 0) lammps_.command("log " + log_);  // begins it anew
    lammps_.command("run 1 pre no post no");
  }
  if (!stopped_.empty()) throw RunStopped(stopped_);
}

void LammpsSimulation::on_forces(void* self, std::int64_t step, int rows, int* ids, double** x, double** force) {
  static_cast<LammpsSimulation*>(self)->add_forces(step, rows, ids, x, force);
}

/// A step of the engine, from LAMMPS's places on: forces, and the motion of the bodies. LAMMPS asks again for the same
/// step where it is set up anew: nothing then moves on or is remembered.
void LammpsSimulation::add_forces(std::int64_t step, int rows, const int* ids, double** x, double** force) {
  const bool again = step == done_;
  now_ = lammps_.rows();
  if (again) state_.bodies.swap(before_);  // where they were at this step
  fault_.clear();
  pressing_ = contacts_made_ = 0;
  follow_grains(rows, ids);
  travel_ += setup_.numerics.dt * (weigh(rows, x, force) + body_speed_);
  if (travel_ > margin_) find_near(rows);
  placed_.place(state_.bodies);
  add_pair_forces(rows, force, !again);
  add_surface_forces(force, !again);
  join_loads(rows);
  if (std::exchange(at_half_steps_, false)) kick(rows, force);
  if (again) return state_.bodies.swap(before_);
  before_ = state_.bodies;
  if (done_ >= 0) ++state_.step, state_.time += setup_.numerics.dt;
  done_ = step;
  move_bodies();
}

/// Gravity, and the checks of each grain's motion. Gives the speed of the fastest [m/s].
double LammpsSimulation::weigh(int rows, double** x, double** force) {
  double fastest = 0;
  for (int row = 0; row < rows; ++row) {
    const Vec3 weight = now_.mass[row] * state_.gravity, at = vec(x[row]);
    std::copy_n(&weight.x, 3, force[row]);
    const double speed2 = squared(vec(now_.velocity[row]));
    if (!(speed2 < 1e30))
      fail(fmt::format("the motion of grain {} is not finite", ids_[static_cast<std::size_t>(row)] - 1));
    else if (!setup_.domain.contains(at))
      fail(fmt::format("grain {} has left the bin at ({:.4g}, {:.4g}, {:.4g}) m",
                       ids_[static_cast<std::size_t>(row)] - 1, at.x, at.y, at.z));
    fastest = std::max(fastest, speed2);
  }
  return std::sqrt(fastest);
}

/// LAMMPS has velocities of whole steps between two steps: here are those of the half step before. It adds the other
/// half of the step itself.
void LammpsSimulation::kick(int rows, double** force) const {
  const double half = setup_.numerics.dt / 2;
  for (int row = 0; row < rows; ++row) {
    add(now_.velocity[row], half / now_.mass[row] * vec(force[row]));
    add(now_.spin[row], half * spin_of(row).inverse_inertia * vec(now_.torque[row]));
  }
}

/// Where LAMMPS has sorted its grains anew: what contacts remember goes where their grains are.
void LammpsSimulation::follow_grains(int rows, const int* ids) {
  if (!lammps_.listed_anew()) return;
  std::vector<bool> were_here(here_.size());
  were_here.swap(here_);
  for (int row = 0; row < rows; ++row) here_[static_cast<std::size_t>(ids[row])] = true;
  std::vector<LammpsTravelling> all;
  for (const SurfaceContact& contact : made_) all.push_back({ids_[contact.who.grain], contact});
  made_.clear();
  take_over(all, rows, ids);  // leaves those whose grain is elsewhere now
  take_over(arriving_, rows, ids);
  arriving_.clear();
  std::vector<LammpsTravelling> others = gathered(world_, all);
  take_over(others, rows, ids);
  std::stable_sort(made_.begin(), made_.end(), comes_first);
  follow_pairs(were_here);
  ids_.assign(ids, ids + rows);
  find_near(rows);
}

/// Contacts of two grains are known where either of them is.
void LammpsSimulation::follow_pairs(const std::vector<bool>& were_here) {
  const auto left = [&](int id) {
    const auto at = static_cast<std::size_t>(id);
    return were_here[at] && !here_[at];
  };
  std::vector<PairContact> leaving;
  for (const PairContact& contact : pairs_.contacts())
    if (left(contact.first) || left(contact.second)) leaving.push_back(contact);
  pairs_.forget_order();
  take_pairs(gathered(world_, leaving));
}

/// Moves to made_ those of the contacts whose grains this process has.
void LammpsSimulation::take_over(std::vector<LammpsTravelling>& contacts, int rows, const int* ids) {
  if (contacts.empty()) return;
  std::unordered_map<int, int> row_of;
  for (const LammpsTravelling& one : contacts) row_of[one.id] = -1;
  for (int row = 0; row < rows; ++row)
    if (const auto asked = row_of.find(ids[row]); asked != row_of.end()) asked->second = row;
  std::vector<LammpsTravelling> others;
  for (LammpsTravelling& one : contacts) {
    const int row = row_of[one.id];
    if (row < 0) {
      others.push_back(one);
      continue;
    }
    one.contact.who.grain = static_cast<std::uint32_t>(row);
    made_.push_back(one.contact);
  }
  contacts.swap(others);
}

void LammpsSimulation::find_near(int rows) {
  near_.clear();
  for (int row = 0; row < rows; ++row)
    add_near(state_.bodies, motion_of(row), static_cast<std::uint32_t>(row), margin_, near_);
  travel_ = 0;
}

/// The engine's law for each pair that LAMMPS lists. A pair of two processes is worked out on both, each for its grain.
void LammpsSimulation::add_pair_forces(int rows, double** force, bool keeps) {
  const Lammps::Neighbours pairs = lammps_.neighbours();
  std::span<const int> others;
  pairs_.begin_step();
  for (int k = 0; k < pairs.size(); ++k) {
    const int i = pairs.of(k, others);
    const Motion motion = motion_of(i);
    const Spin spin = spin_of(i);
    Load load;
    for (const int marked : others) {
      const int j = marked & Lammps::Neighbours::mask;
      const Vec3 between = motion.position - vec(now_.position[j]);
      const double sum = motion.radius + now_.radius[j];
      if (squared(between) >= sum * sum) {
        pairs_.pass(i, j);
        continue;
      }
      const Load on_other = press_pair(i, {motion, spin}, j, between, keeps, load);
      const double share = j < rows ? 1 : 0.5;  // two processes have it
      pressing_ += share * length(on_other.force), contacts_made_ += share;
      if (j < rows) add(force[j], on_other.force), add(now_.torque[j], on_other.torque);
    }
    add(force[i], load.force), add(now_.torque[i], load.torque);
  }
  pairs_.end_step();
}

/// Adds what the grain of row j does to that of row i to `load`; gives what is done to j.
Load LammpsSimulation::press_pair(int i, const GrainMotion& first, int j, const Vec3& between, bool keeps, Load& load) {
  const Motion motion = motion_of(j);
  const Spin spin = spin_of(j);
  const int* ids = now_.id;
  const double dt = setup_.numerics.dt, smaller = std::min(first.motion.radius, motion.radius);
  const Touch<double> touch = touch_of_grains(first, {motion, spin}, between, dt);
  if (touch.overlap > setup_.numerics.deepest_overlap * smaller)
    fail(fmt::format("grain {} overlaps grain {} by {:.3g} of the smaller radius, more than {:.3g}", ids[i] - 1,
                     ids[j] - 1, touch.overlap / smaller, setup_.numerics.deepest_overlap));
  const Memory<double> before = pairs_.before(i, j, ids).value_or(Memory<double>{});
  Memory<double> after = before;
  const Response<double> does = contact_response<double>(setup_.laws, laws_[laws_.kind(grain_material, grain_material)],
                                                         touch, after, dt, nullptr);
  pairs_.keep({i, j, ids[i], ids[j], keeps ? after : before});
  const PairTorques<double> torques =
      pair_torques(touch.normal, does, first.motion.radius - touch.overlap / 2, motion.radius - touch.overlap / 2);
  load.force += vec3(does.force), load.torque += vec3(torques.first);
  return {.force = -vec3(does.force), .torque = vec3(torques.second)};
}

void LammpsSimulation::add_surface_forces(double** force, bool keeps) {
  loads_.assign(state_.bodies.size(), {});
  making_.clear(), contacts_.clear();
  std::array<SurfaceTouch, 8> touches;
  std::size_t old = 0;
  for (const NearSurface& near : near_) {
    while (old < made_.size() && comes_first(made_[old], {near, -1, {}, {}})) ++old;
    const std::size_t begin = old, first = making_.size();
    while (old < made_.size() && made_[old].who == near) ++old;
    const Motion grain = motion_of(static_cast<int>(near.grain));
    const int material = state_.bodies[near.body].surfaces[near.surface].material;
    const GrainOnSurface at{.who = near,
                            .grain = grain,
                            .surface = placed_.at(near),
                            .constants = laws_[laws_.kind(grain_material, material)],
                            .adhesion_reach = 0,
                            .before = {made_.data() + begin, old - begin}};
    const int found = find_contacts(at, making_, touches);
    if (found > 0) press(at, first, {touches.data(), static_cast<std::size_t>(found)}, force[near.grain]);
  }
  if (keeps) made_.swap(making_);
}

/// The law for the contacts that were found of one grain on one surface, making_[first] and on.
void LammpsSimulation::press(const GrainOnSurface& on, std::size_t first, std::span<const SurfaceTouch> touches,
                             double* force) {
  const NearSurface& near = on.who;
  const Motion& grain = on.grain;
  const Spin spin = spin_of(static_cast<int>(near.grain));
  const Body& body = state_.bodies[near.body];
  Load load;
  for (std::size_t k = 0; k < touches.size(); ++k) {
    const SurfaceTouch& at = touches[k];
    if (at.overlap > setup_.numerics.deepest_overlap * grain.radius)
      fail(fmt::format("grain {} overlaps body {} by {:.3g} of its radius, more than {:.3g}", ids_[near.grain] - 1,
                       body.name, at.overlap / grain.radius, setup_.numerics.deepest_overlap));
    const Response<double> does = contact_response<double>(setup_.laws, on.constants, touch_of(body, at, grain, spin),
                                                           making_[first + k].memory, setup_.numerics.dt, nullptr);
    pressing_ += length(vec3(does.force)), contacts_made_ += 1;
    add_loads(at, grain.radius, vec3(does.force), vec3(does.couple), body.position, load, loads_[near.body]);
    if (at.triangle >= 0)
      contacts_.push_back({.first = static_cast<GrainId>(ids_[near.grain] - 1),
                           .second = -1 - static_cast<std::int64_t>(near.body),
                           .triangle = at.triangle,
                           .point = at.point,
                           .normal = at.normal,
                           .overlap = at.overlap,
                           .force = vec3(does.force),
                           .couple = vec3(does.couple),
                           .pressing = does.pressing});
  }
  add(force, load.force), add(now_.torque[near.grain], load.torque);
}

/// Sums of the loads on bodies over all processes, of their grains, and whether anyone found a fault.
void LammpsSimulation::join_loads(int rows) {
  std::vector<double> numbers{static_cast<double>(rows), fault_.empty() ? 0.0 : 1.0};
  for (const BodyLoad& load : loads_)
    numbers.insert(numbers.end(),
                   {load.force.x, load.force.y, load.force.z, load.torque.x, load.torque.y, load.torque.z});
  sum_up(world_, numbers);
  for (std::size_t b = 0; b < loads_.size(); ++b) {
    state_.bodies[b].force = vec(&numbers[2 + 6 * b]);
    state_.bodies[b].torque = vec(&numbers[5 + 6 * b]);
  }
  if (numbers[1] > 0) {
    stopped_ = fmt::format("{}, time {:.6g} s, step {}", fault_of_any(world_, fault_), state_.time, state_.step);
  } else if (static_cast<std::int64_t>(numbers[0]) != all_grains_) {
    name_lost_grain();
  }
}

void LammpsSimulation::name_lost_grain() {
  std::int64_t highest = 0;
  for (const int id : ids_) highest = std::max<std::int64_t>(highest, id);
  MPI_Allreduce(MPI_IN_PLACE, &highest, 1, MPI_INT64_T, MPI_MAX, world_);
  std::vector<unsigned char> there(static_cast<std::size_t>(highest) + 1);
  for (const int id : ids_) there[static_cast<std::size_t>(id)] = 1;
  MPI_Allreduce(MPI_IN_PLACE, there.data(), static_cast<int>(there.size()), MPI_UNSIGNED_CHAR, MPI_MAX, world_);
  const std::int64_t left = std::count(there.begin(), there.end(), 1);
  const auto lost = std::find(there.begin() + 1, there.end(), 0) - there.begin() - 1;
  stopped_ = fmt::format("LAMMPS has lost {} of {} grains, the first is grain {}, time {:.6g} s, step {}",
                         all_grains_ - left, all_grains_, lost, state_.time, state_.step);
}

void LammpsSimulation::move_bodies() {
  body_speed_ = 0;
  for (Body& body : state_.bodies) {
    advance(body, state_.gravity, setup_.numerics.dt);
    const double farthest = extent(body), speed = length(body.velocity) + length(body.spin) * std::max(farthest, 0.0);
    if (farthest < 0 && speed + length(body.spin) > 0) stopped_ = fmt::format("body {}: planes stay still", body.name);
    if (!(speed < 1e15))
      stopped_ = fmt::format("the motion of body {} is not finite, time {:.6g} s", body.name, state_.time);
    body_speed_ = std::max(body_speed_, speed);
  }
}

Motion LammpsSimulation::motion_of(int row) const {
  return {.position = vec(now_.position[row]),
          .radius = now_.radius[row],
          .velocity = vec(now_.velocity[row]),
          .inverse_mass = 1 / now_.mass[row]};
}

Spin LammpsSimulation::spin_of(int row) const {
  const double radius = now_.radius[row];
  return {.rate = vec(now_.spin[row]), .inverse_inertia = 2.5 / (now_.mass[row] * radius * radius)};
}

void LammpsSimulation::fail(const std::string& what) {
  if (fault_.empty()) fault_ = what;
}

}  // namespace soilbin::dem
