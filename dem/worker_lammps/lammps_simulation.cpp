#include "dem/worker_lammps/lammps_simulation.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "dem/archive/note_text.hpp"
#include "dem/archive/sealed_file.hpp"
#include "dem/bed/settled_bed.hpp"
#include "dem/surface/mass_properties.hpp"
#include "dem/worker_lammps/processes.hpp"
#include "scenario/errors.hpp"

namespace soilbin::dem {

template <class Notes>
void archive(Notes& notes, Rotation& q) {
  notes(q.w, q.x, q.y, q.z);
}

/// All but its name and surfaces, which come from elsewhere, and a servo, which no wheel has.
template <class Notes>
void archive(Notes& notes, Body& body) {
  notes(body.mass, body.inertia, body.free_translation, body.turning, body.axis, body.weighs, body.applied_force,
        body.applied_torque, body.position, body.rotation, body.velocity, body.spin, body.force, body.torque, body.work,
        body.driven_work, body.travel);
}

template <class Notes>
void archive(Notes& notes, Triple<double>& t) {
  notes(t.x, t.y, t.z);
}

template <class Notes>
void archive(Notes& notes, Region& region) {
  notes(region.lower, region.upper);
}

template <class Notes>
void archive(Notes& notes, LammpsTravelling& t) {
  SurfaceContact& c = t.contact;
  notes(t.id, c.who.body, c.who.surface, c.triangle, c.normal, c.memory.slide, c.memory.roll);
}

namespace {

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

/// Takes the contacts of this process's grains, for its next step.
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

/// Reads the pairs that had a grain next to or in this process's part.
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

/// The contacts of all processes, by grain.
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

}  // namespace soilbin::dem
