#include "dem/worker_lammps/lammps_simulation.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <tuple>
#include <type_traits>
#include <unordered_map>
#include <utility>

#include "dem/archive/note_text.hpp"
#include "dem/archive/sealed_file.hpp"
#include "dem/bed/settled_bed.hpp"
#include "dem/engine/laws/contact_law.hpp"
#include "dem/engine/pair_touch.hpp"
#include "dem/surface/mass_properties.hpp"
#include "scenario/errors.hpp"

namespace soilbin::dem {

template <class Notes>
void parts(Notes& notes, Rotation& q) {
  notes(q.w, q.x, q.y, q.z);
}

/// All but its name and surfaces, which come from elsewhere, and a servo, which no wheel has.
template <class Notes>
void parts(Notes& notes, Body& body) {
  notes(body.mass, body.inertia, body.free_translation, body.turning, body.axis, body.weighs, body.applied_force,
        body.applied_torque, body.position, body.rotation, body.velocity, body.spin, body.force, body.torque, body.work,
        body.driven_work, body.travel);
}

template <class Notes>
void parts(Notes& notes, Triple<double>& t) {
  notes(t.x, t.y, t.z);
}

template <class Notes>
void parts(Notes& notes, Region& region) {
  notes(region.lower, region.upper);
}

template <class Notes>
void parts(Notes& notes, LammpsTravelling& t) {
  SurfaceContact& c = t.contact;
  notes(t.id, c.who.body, c.who.surface, c.triangle, c.normal, c.memory.slide, c.memory.roll);
}

namespace {

constexpr std::size_t grains_at_once = 100'000;  // on their way between processes
constexpr std::int64_t between_logs = 1000;      // steps after which LAMMPS's log begins anew: it has some lines a step

/// Why LAMMPS can't run this; "" where it can.
std::string fault_of(const Setup& setup) {
  const auto& periodic = setup.domain.periodic;
  if (periodic[0] || periodic[1] || periodic[2]) return "a bin in LAMMPS has no periodic sides";
  if (setup.laws.cohesion == CohesionLaw::jkr)
    return "LAMMPS lists no pairs of grains that adhere beyond their contact (jkr)\n"
           "  hint: linear cohesion, or --engine soilbin";
  return "";
}

/// Why it can't go on with this.
std::string fault_of(const State& begin) {
  if (begin.grains.count() == 0) return "LAMMPS needs grains: there are none";
  for (std::size_t k = 0; k < begin.grains.count(); ++k)
    if (begin.grains.motion[k].held() || begin.grains.material[k] != grain_material)
      return "grains in LAMMPS are free and of one material";
  if (!begin.new_grains.empty() && begin.new_grains.size() != begin.grains.count())
    return "grains in LAMMPS all begin at a whole step, or at the half step before";
  return "";
}

Vec3 vec(const double* a) { return {a[0], a[1], a[2]}; }
void add(double* to, const Vec3& a) { to[0] += a.x, to[1] += a.y, to[2] += a.z; }

bool comes_first(const SurfaceContact& a, const SurfaceContact& b) {
  return std::tie(a.who.grain, a.who.body, a.who.surface) < std::tie(b.who.grain, b.who.body, b.who.surface);
}

/// Of all processes; the same bits on each.
void sum_up(MPI_Comm world, std::span<double> numbers) {
  int rank = 0;
  MPI_Comm_rank(world, &rank);
  const int count = static_cast<int>(numbers.size());
  MPI_Reduce(rank == 0 ? MPI_IN_PLACE : numbers.data(), numbers.data(), count, MPI_DOUBLE, MPI_SUM, 0, world);
  MPI_Bcast(numbers.data(), count, MPI_DOUBLE, 0, world);
}

/// Those of all processes, on each.
template <class T>
std::vector<T> gathered(MPI_Comm world, const std::vector<T>& mine) {
  static_assert(std::is_trivially_copyable_v<T>);
  int size = 0, bytes = static_cast<int>(mine.size() * sizeof(T));
  MPI_Comm_size(world, &size);
  std::vector<int> sizes(size), begins(size);
  MPI_Allgather(&bytes, 1, MPI_INT, sizes.data(), 1, MPI_INT, world);
  int sum = 0;
  for (int k = 0; k < size; ++k) begins[k] = std::exchange(sum, sum + sizes[k]);
  std::vector<T> all(static_cast<std::size_t>(sum) / sizeof(T));
  MPI_Allgatherv(mine.data(), bytes, MPI_BYTE, all.data(), sizes.data(), begins.data(), MPI_BYTE, world);
  return all;
}

/// Hands a list of the first process to all, in parts that have room everywhere.
template <class T, class Visit>
void in_parts(MPI_Comm world, const std::vector<T>& of_first, const Visit& visit) {
  static_assert(std::is_trivially_copyable_v<T>);
  int rank = 0;
  MPI_Comm_rank(world, &rank);
  std::uint64_t total = of_first.size();
  MPI_Bcast(&total, 1, MPI_UINT64_T, 0, world);
  for (std::size_t from = 0; from < total; from += grains_at_once) {
    std::vector<T> part(std::min<std::size_t>(grains_at_once, total - from));
    if (rank == 0) std::copy_n(of_first.begin() + static_cast<std::ptrdiff_t>(from), part.size(), part.begin());
    MPI_Bcast(part.data(), static_cast<int>(part.size() * sizeof(T)), MPI_BYTE, 0, world);
    visit(part);
  }
}

/// What all processes must know of the state that the first one has.
struct Beginning {
  double largest = 0, time = 0;
  Vec3 gravity;
  std::int64_t step = 0, grains = 0;
  std::uint32_t next_id = 0;
  bool at_half_steps = false;
};

const FileKind pairs_kind{"contacts", 1, "contacts of pairs follow at byte 512: dem/worker_lammps/pair_memory.hpp"};

std::filesystem::path contacts_file(const std::string& grains, int rank) {
  return fmt::format("{}.contacts-{}", grains, rank);
}

}  // namespace

/// What all ways of beginning have in common, up to the box.
LammpsSimulation::LammpsSimulation(MPI_Comm world, Setup setup, std::string log)
    : world_(world), setup_(std::move(setup)), log_(std::move(log)), lammps_(world, log_) {
  MPI_Comm_rank(world_, &rank_);
  if (const std::string fault = fault_of(setup_); !fault.empty()) throw InputError(fault);
  lammps_.command("units si");
  lammps_.command("atom_style sphere");
  lammps_.command("newton off");
  lammps_.command("comm_modify vel yes");
  lammps_.command("boundary f f fs");   // a grain that is thrown up raises the box, as no other leaves it
  lammps_.command("processors * * 1");  // beds are flat
}

/// What follows from their largest radius and the range of their ids.
void LammpsSimulation::know_grains() {
  here_.resize(static_cast<std::size_t>(next_id_) + 1);
  laws_.fill(setup_.materials, setup_.laws, largest_);
  margin_ = setup_.numerics.skin > 0 ? setup_.numerics.skin : 0.2 * largest_;
}

/// Wider than the domain, so that the engine's own check comes before LAMMPS forgets a grain.
void LammpsSimulation::make_box() const {
  const Vec3 low = setup_.domain.lower - Vec3{largest_, largest_, largest_};
  const Vec3 high = setup_.domain.upper + Vec3{largest_, largest_, largest_};
  lammps_.command(fmt::format("region box block {} {} {} {} {} {}", low.x, high.x, low.y, high.y, low.z, high.z));
  lammps_.command("create_box 1 box");
}

LammpsSimulation::LammpsSimulation(MPI_Comm world, Setup setup, const State& begin, std::string log)
    : LammpsSimulation(world, std::move(setup), std::move(log)) {
  if (const std::string fault = fault_of_any(world_, rank_ == 0 ? fault_of(begin) : ""); !fault.empty())
    throw InputError(fault);
  Beginning first{begin.grains.largest_radius(),
                  begin.time,
                  begin.gravity,
                  begin.step,
                  static_cast<std::int64_t>(begin.grains.count()),
                  begin.next_id,
                  begin.new_grains.empty()};
  MPI_Bcast(&first, sizeof(first), MPI_BYTE, 0, world_);
  state_.gravity = first.gravity, state_.time = first.time, state_.step = first.step;
  largest_ = first.largest, all_grains_ = first.grains, at_half_steps_ = first.at_half_steps, next_id_ = first.next_id;
  know_grains();
  make_box();
  std::vector<NewGrain> all;
  for (std::size_t k = 0; k < begin.grains.count(); ++k)
    all.push_back({.id = begin.grains.id[k],
                   .radius = begin.grains.motion[k].radius,
                   .mass = 1 / begin.grains.motion[k].inverse_mass,
                   .material = grain_material,
                   .position = begin.grains.motion[k].position,
                   .velocity = begin.grains.motion[k].velocity,
                   .spin = begin.grains.spin[k].rate});
  in_parts(world_, all, [&](const std::vector<NewGrain>& part) { put_in(part); });
  write_commands();
  for (const Body& body : begin.bodies) add_body(body);
  take_contacts(begin);
}

LammpsSimulation::LammpsSimulation(MPI_Comm world, Setup setup, const Vec3& gravity, const std::vector<Body>& bodies,
                                   const PouredGrains& grains, std::string log)
    : LammpsSimulation(world, std::move(setup), std::move(log)) {
  largest_ = grains.largest, state_.gravity = gravity;
  make_box();
  const double density = setup_.materials.all[grain_material].density;
  std::vector<NewGrain> part;
  grains.pour([&](const Vec3& centre, double radius) {
    part.push_back({.id = static_cast<GrainId>(next_id_++),
                    .radius = radius,
                    .mass = sphere_mass(density, radius),
                    .material = grain_material,
                    .position = centre});
    if (part.size() < grains_at_once) return;
    put_in(part);
    part.clear();
  });
  if (!part.empty()) put_in(part);
  all_grains_ = next_id_;
  know_grains();
  write_commands();
  for (const Body& body : bodies) add_body(body);
}

/// What the first process's engine remembers of contacts goes to those that have the grains.
void LammpsSimulation::take_contacts(const State& begin) {
  const Grains& grains = begin.grains;
  const auto id_of = [&](std::uint32_t row) { return static_cast<int>(grains.id[row]) + 1; };
  std::vector<LammpsTravelling> on_surfaces;
  std::vector<PairContact> of_pairs;
  for (const SurfaceContacts& slab : begin.surfaces)
    for (const SurfaceContact& contact : slab.made) on_surfaces.push_back({id_of(contact.who.grain), contact});
  const PairList& pairs = begin.pairs;
  for (std::size_t pair = 0; pair < pairs.first.size(); ++pair) {
    if (!pairs.touches(pair) || pairs.first[pair] >= grains.count() || pairs.second[pair] >= grains.count()) continue;
    const auto kept = [&](int what) { return pairs.remembered(pair, what); };
    of_pairs.push_back({.first = id_of(pairs.first[pair]),
                        .second = id_of(pairs.second[pair]),
                        .memory = {{kept(0), kept(1), kept(2)}, {kept(3), kept(4), kept(5)}}});
  }
  note_who_is_here();
  in_parts(world_, on_surfaces, [&](const std::vector<LammpsTravelling>& part) {
    for (const LammpsTravelling& one : part)
      if (is_here(one.id)) arriving_.push_back(one);
  });
  in_parts(world_, of_pairs, [&](const std::vector<PairContact>& part) { take_pairs(part); });
}

void LammpsSimulation::note_who_is_here() {
  std::fill(here_.begin(), here_.end(), false);
  const Lammps::Rows rows = lammps_.rows();
  for (int row = 0; row < lammps_.count(); ++row) here_[static_cast<std::size_t>(rows.id[row])] = true;
}

/// Those of this process's grains, for its next step.
void LammpsSimulation::take_pairs(const std::vector<PairContact>& contacts) {
  for (const PairContact& contact : contacts)
    if (is_here(contact.first) || is_here(contact.second)) pairs_.take(contact);
}

LammpsSimulation::LammpsSimulation(MPI_Comm world, Setup setup, std::string log, const std::string& grains,
                                   const std::string& notes, std::vector<Body> bodies)
    : LammpsSimulation(world, std::move(setup), std::move(log)) {
  lammps_.command("read_restart " + grains);
  state_.bodies = std::move(bodies);
  before_ = state_.bodies;
  NoteReader reader("LAMMPS's run", notes);
  keep_in(reader);
  reader.end();
  know_grains();
  write_commands();
  note_who_is_here();
  read_pairs(grains);
  std::erase_if(arriving_, [&](const LammpsTravelling& one) { return !is_here(one.id); });
  for (Body& body : state_.bodies) get_ready(body);
  for (Body& body : before_) get_ready(body);
}

/// All but what LAMMPS keeps itself.
template <class Notes>
void LammpsSimulation::keep_in(Notes& notes) {
  notes(largest_, all_grains_, next_id_);
  notes(state_.step, state_.time, state_.gravity, done_, writers_, arriving_, state_.bodies, before_);
}

std::string LammpsSimulation::notes() {
  arriving_ = all_contacts();
  writers_ = gathered(world_, std::vector<Region>{part()});
  NoteWriter writer;
  keep_in(writer);
  arriving_.clear();
  return writer.text();
}

void LammpsSimulation::write_grains(const std::string& file) const {
  lammps_.command("write_restart " + file);
  const std::vector<PairContact>& mine = pairs_.contacts();
  write_sealed(contacts_file(file, rank_), pairs_kind,
               {reinterpret_cast<const char*>(mine.data()), mine.size() * sizeof(PairContact)}, Keep::nothing);
}

/// Of those that had a grain next to or in this process's part.
void LammpsSimulation::read_pairs(const std::string& grains) {
  const double reach = 2 * largest_ + margin_;
  const Region here = part();
  const auto reaches = [&](double Vec3::*axis, const Region& there) {
    return there.lower.*axis <= here.upper.*axis + reach && there.upper.*axis >= here.lower.*axis - reach;
  };
  for (std::size_t rank = 0; rank < writers_.size(); ++rank) {
    if (!reaches(&Vec3::x, writers_[rank]) || !reaches(&Vec3::y, writers_[rank])) continue;
    const SealedFile sealed(contacts_file(grains, static_cast<int>(rank)), pairs_kind);
    std::vector<PairContact> all(sealed.content().size() / sizeof(PairContact));
    std::memcpy(all.data(), sealed.content().data(), all.size() * sizeof(PairContact));
    take_pairs(all);
  }
}

/// Of all processes, by grain.
std::vector<LammpsTravelling> LammpsSimulation::all_contacts() const {
  std::vector<LammpsTravelling> mine;
  for (const SurfaceContact& contact : made_) mine.push_back({ids_[contact.who.grain], contact});
  return gathered(world_, mine);
}

/// Each process takes those that lie in its part of the box, in their order.
void LammpsSimulation::put_in(std::span<const NewGrain> part) const {
  std::vector<int> ids;
  std::vector<Vec3> positions, velocities;
  for (const NewGrain& grain : part) {
    ids.push_back(static_cast<int>(grain.id) + 1);
    positions.push_back(grain.position), velocities.push_back(grain.velocity);
  }
  const int before = lammps_.count();
  lammps_.add_grains(ids, positions, velocities);
  const Lammps::Rows rows = lammps_.rows();
  auto grain = part.begin();
  for (int row = before; row < lammps_.count(); ++row, ++grain) {
    while (static_cast<int>(grain->id) + 1 != rows.id[row]) ++grain;
    rows.radius[row] = grain->radius, rows.mass[row] = grain->mass;
    std::copy_n(&grain->spin.x, 3, rows.spin[row]);
  }
}

void LammpsSimulation::write_commands() const {
  // Without stiffness, damping and friction: it lists the pairs nearer than their radii and a skin, and presses none.
  lammps_.command("pair_style gran/hooke 0 NULL 0 NULL 0 0");
  lammps_.command("pair_coeff * *");
  lammps_.command(fmt::format("neighbor {} bin", margin_));
  lammps_.command("neigh_modify delay 0 every 1 check yes");
  lammps_.command(fmt::format("timestep {}", setup_.numerics.dt));
  lammps_.command("fix move all nve/sphere");
  lammps_.command("fix soil all external pf/callback 1 1");
  lammps_.command("thermo_style custom step");
  lammps_.command("thermo_modify lost ignore");  // join_loads counts them, and says which
}

void LammpsSimulation::set_interaction(int a, int b, const Interaction& interaction) {
  setup_.materials.set(a, b, interaction);
  laws_.fill(setup_.materials, setup_.laws, largest_);
}

void LammpsSimulation::remove_grains(const std::function<bool(const Vec3& centre, double radius)>& gone) {
  const Lammps::Rows rows = lammps_.rows();
  std::vector<int> which;
  for (int row = 0; row < lammps_.count(); ++row)
    if (gone(vec(rows.position[row]), rows.radius[row])) which.push_back(row);
  lammps_.remove_grains(which);
  all_grains_ = std::llround(lammps_.total());
  prepared_ = false;
}

int LammpsSimulation::add_body(Body body) {
  check(body, static_cast<int>(setup_.materials.all.size()));
  get_ready(body);
  state_.bodies.push_back(std::move(body));
  before_ = state_.bodies;
  travel_ = 2 * margin_ + 1;  // the next step searches
  return static_cast<int>(state_.bodies.size()) - 1;
}

/// Each mesh gets the index that finds the triangles a grain may touch before the next search.
void LammpsSimulation::get_ready(Body& body) const {
  for (Surface& surface : body.surfaces)
    if (auto* mesh = std::get_if<MeshSurface>(&surface.shape); mesh && !mesh->grid)
      mesh->grid = std::make_shared<TriangleGrid>(*mesh->mesh, largest_ + margin_);
}

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

Grains LammpsSimulation::own_grains() const {
  Grains own;
  const Lammps::Rows rows = lammps_.rows();
  for (int row = 0; row < lammps_.count(); ++row)
    own.add({.id = static_cast<GrainId>(rows.id[row] - 1),
             .radius = rows.radius[row],
             .mass = rows.mass[row],
             .material = grain_material,
             .position = vec(rows.position[row]),
             .velocity = vec(rows.velocity[row]),
             .spin = vec(rows.spin[row])});
  return own;
}

void LammpsSimulation::see_grains(const GrainSink& visit) const {
  const Lammps::Rows rows = lammps_.rows();
  for (int row = 0; row < lammps_.with_ghosts(); ++row) visit(vec(rows.position[row]), rows.radius[row]);
}

Region LammpsSimulation::part() const {
  const Lammps::Part part = lammps_.part();
  return {part.lower, part.upper};
}

void LammpsSimulation::see_contacts(const std::function<void(std::size_t row)>& visit) const {
  const Lammps::Neighbours pairs = lammps_.neighbours();
  const int rows = lammps_.count();
  const Lammps::Rows now = lammps_.rows();
  std::span<const int> others;
  for (int k = 0; k < pairs.size(); ++k) {
    const int i = pairs.of(k, others);
    for (const int marked : others) {
      const int j = marked & Lammps::Neighbours::mask;
      const double sum = now.radius[i] + now.radius[j];
      if (squared(vec(now.position[i]) - vec(now.position[j])) >= sum * sum) continue;
      visit(static_cast<std::size_t>(i));
      if (j < rows) visit(static_cast<std::size_t>(j));
    }
  }
}

void LammpsSimulation::watch() { lammps_.command("fix before all store/state 0 x y z vx vy vz"); }

UnrestSums LammpsSimulation::end_watch(double time) {
  UnrestSums sums;
  const Lammps::Rows rows = lammps_.rows();
  double** before = lammps_.kept_by("before");
  const double g = length(state_.gravity);
  for (int row = 0; row < lammps_.count(); ++row)
    sums.add(rows.mass[row], rows.radius[row], vec(rows.position[row]) - vec(before[row]),
             vec(rows.velocity[row]) - vec(before[row] + 3), g, time);
  lammps_.command("unfix before");
  sums.forces = pressing_, sums.contacts = contacts_made_;
  std::array<double*, 7> all{&sums.kinetic, &sums.net,    &sums.weight,  &sums.diameters,
                             &sums.grains,  &sums.forces, &sums.contacts};
  std::array<double, 7> numbers{};
  for (std::size_t k = 0; k < all.size(); ++k) numbers[k] = *all[k];
  sum_up(world_, numbers);
  for (std::size_t k = 0; k < all.size(); ++k) *all[k] = numbers[k];
  return sums;
}

LammpsSimulation::PairMeans LammpsSimulation::pair_means() const {
  const Lammps::Neighbours pairs = lammps_.neighbours();
  const int rows = lammps_.count();
  const Lammps::Rows now = lammps_.rows();
  std::array<double, 2> sums{};  // contacts, overlaps
  std::span<const int> others;
  for (int k = 0; k < pairs.size(); ++k) {
    const int i = pairs.of(k, others);
    for (const int marked : others) {
      const int j = marked & Lammps::Neighbours::mask;
      const double overlap = now.radius[i] + now.radius[j] - length(vec(now.position[i]) - vec(now.position[j]));
      const double share = j < rows ? 1 : 0.5;  // two processes have it
      if (overlap > 0) sums[0] += share, sums[1] += share * overlap;
    }
  }
  sum_up(world_, sums);
  return {sums[0], sums[0] > 0 ? sums[1] / sums[0] : 0};
}

double LammpsSimulation::memory_a_grain() const {
  double bytes = 1e6 * lammps_.memory() + 2.0 * static_cast<double>(pairs_.contacts().capacity() * sizeof(PairContact));
  sum_up(world_, {&bytes, 1});
  return bytes / grain_count();
}

std::string fault_of_any(MPI_Comm world, const std::string& mine) {
  int rank = 0, size = 0;
  MPI_Comm_rank(world, &rank), MPI_Comm_size(world, &size);
  int who = mine.empty() ? size : rank;
  MPI_Allreduce(MPI_IN_PLACE, &who, 1, MPI_INT, MPI_MIN, world);
  if (who == size) return "";
  std::array<char, 1000> words{};
  mine.copy(words.data(), words.size() - 1);
  MPI_Bcast(words.data(), static_cast<int>(words.size()), MPI_CHAR, who, world);
  return words.data();
}

void join_largest(const LammpsSimulation& simulation, std::span<double> numbers) {
  MPI_Allreduce(MPI_IN_PLACE, numbers.data(), static_cast<int>(numbers.size()), MPI_DOUBLE, MPI_MAX,
                simulation.world());
}

void join_sums(const LammpsSimulation& simulation, std::span<double> numbers) { sum_up(simulation.world(), numbers); }

void add_to_flow(const LammpsSimulation& simulation, const Vec3& axle, FlowMeter& flow) {
  FlowMeter now = flow.empty_one();
  now.add(simulation.own_grains(), axle);
  now.join([&](std::vector<double>& sums) { join_sums(simulation, sums); });
  flow += now;
}

}  // namespace soilbin::dem
