// A wheel put on a settled bed and loaded: what every way of driving it along the bin begins with. Grains may be those
// of the engine (WheelInBin) or of whoever else runs in stages and shares its grains (dem/rig/process_sums.hpp):
//
//   WheelInBinOf<Run> bin(on, at, [&] { return Run(...); });
//   bin.tilt(), bin.put_wheel(), bin.lower(load);
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>

#include "dem/bed/settled_bed.hpp"
#include "dem/rig/moving_patch.hpp"
#include "dem/rig/process_sums.hpp"
#include "dem/rig/rut.hpp"
#include "dem/rig/staged_run.hpp"
#include "dem/rig/wheel_motion.hpp"
#include "dem/rig/wheel_run.hpp"
#include "scenario/tire.hpp"

namespace soilbin::dem {

/// Between wheel and grains where it is put down [m].
inline constexpr double wheel_gap = 1e-4;

template <class Notes>
void archive(Notes& notes, SurfaceHeight& s) {
  notes(s.over.x_lower, s.over.x_upper, s.over.y_lower, s.over.y_upper, s.nx, s.ny, s.height);
}
template <class Notes>
void archive(Notes& notes, TreadForces& t) {
  notes(t.sectors, t.thrust, t.resistance, t.side);
}
template <class Notes>
void archive(Notes& notes, EnergyLosses& l) {
  auto& [damping, shear_damping, sliding, into_slide, into_roll, adhesion, added] = l;
  notes(damping, shear_damping, sliding, into_slide, into_roll, adhesion, added);
}
template <class Notes>
void archive(Notes& notes, WheelSample& s) {
  auto& [time, travel, force, moment, sinkage, speed, heave, rotation, into_soil, tread, ledger] = s;
  notes(time, travel, force, moment, sinkage, speed, heave, rotation, into_soil, tread, ledger);
}

/// What adds up to a sample, over its steps so far.
struct SampleUnderWay {
  WheelSample sum;         ///< shares of the means
  std::int64_t steps = 0;  ///< that it is to have; 0: none is under way
  std::int64_t taken = 0;  ///< of them
  double begun = 0;        ///< [s]
  double travel = 0;       ///< at its begin [m]
  double work = 0;         ///< of the wheel, before [J]
};

template <class Notes>
void archive(Notes& notes, SampleUnderWay& s) {
  notes(s.sum, s.steps, s.taken, s.begun, s.travel, s.work);
}

/// Least room between axle and either end of the bin, in outer radii (chosen): a wheel hangs over the end wall
/// once it has sunk by 13 % of that radius. The paper's tire has 0.7.
inline constexpr double least_room = 0.5;

/// Outer radii that a wheel goes on a moving patch at most, and at least, where it goes until its pull is known
/// (chosen).
inline constexpr double longest_way_on_patch = 30, shortest_way_on_patch = 4;

/// By which a patch advances: as thick as what is held at its ends [m].
inline double slab_of_patch(const BedRecipe& recipe) { return 4 * recipe.grading.factor * recipe.soil.radius_max; }

/// The way that the axle may go [m]; on a moving patch the longest way that it may take. Throws InputError for a bed
/// too short for the way or too narrow, and for an axle that least_room keeps from where it begins or ends.
double way_in_bin(const BedSize& size, const Tire& tire, const Rig& rig);

/// Throws InputError for an error of the pull that a run on a moving patch can't go on until.
void check_patch(const Rig& rig);

/// How far from the axle, along the bin, a wheel that has sunk so far [m] reaches at the height of the surface [m].
double reach_at(const Tire& tire, double sinkage);

/// The bed's setup with the tire's material and the rig's numerics.
Setup run_setup(const WheelOnBed& on, int threads);

/// The engine's run on a bed; `on` and options must outlive it. `inputs`: what the whole run follows from (StagedRun).
StagedRun staged_run(const WheelOnBed& on, const WorkOptions& how, const Checkpoints& checkpoints, std::string inputs);

/// The stages before a wheel is driven, its steps and its samples. `on` must outlive it. Of the condition load,
/// inclines and yaw are read. Run: StagedRun, or what has its once, steps, loop, step, keep and simulation().
template <class Run>
class WheelInBinOf {
 public:
  /// `make`: gives the Run, whose bed is that of `on`.
  template <class Make>
  WheelInBinOf(const WheelOnBed& on, const OperatingCondition& at, const Make& make)
      : bed_(on.bed), tire_(on.tire), at_(at), rig_(on.rig), stance_(wheel_stance(at)), run_(make()) {
    run_.keep("bin", *this);
  }

  /// way_in_bin of this bed, tire and rig; on a moving patch at a later pass no more than that of the one before, whose
  /// rut ends there [m].
  double way() const { return std::min(way_in_bin(bed_.recipe.size, tire_, rig_), rut_way_); }
  /// Time in which gravity turns; 0 on level ground [s].
  double tilting() const;
  std::int64_t steps_of(double time) const;

  /// The stages; what is done between them goes through StagedRun::once.
  Run& run() { return run_; }
  /// Turns gravity to the incline and lets the bed come to terms with it. For a moving patch it first holds the grains
  /// that lie on the floor.
  void tilt();
  /// Measures the surface and puts the wheel over it.
  void put_wheel();
  /// Cuts the moving patch out of the bed, which is a tile of it so far; nothing without Rig::patch.
  void open_patch();
  /// Puts the patch back to where it began, on the rut that it has left over a `way` of the axle; the wheel touches no
  /// grain. `pass`: that comes now.
  void go_back_over_rut(double way, int pass);
  /// Brings `force` on evenly and lets the wheel rest under it.
  void lower(const Vec3& force);
  /// The soil's mean moment on the wheel over the second half of that rest [N m].
  const Vec3& moment_at_rest() const { return moment_at_rest_; }
  /// The lowest place of the axle over the start where no grain is within the rim that the lugs reach [m].
  double free_height() const;

  /// A sample of so many steps is to come. Lets the rig's onlooker look first, where it is time.
  void begin_sample(std::int64_t steps);
  /// One step of the engine, which counts to the sample under way.
  void step();
  bool is_sampling() const { return sample_.steps > 0; }
  bool is_full() const { return sample_.taken == sample_.steps; }
  const SampleUnderWay& sample() const { return sample_; }
  /// Means over the steps that were taken. What is at the sample's end is there too, but for tread and ledger.
  WheelSample end_sample();

  auto& simulation() { return run_.simulation(); }
  const auto& simulation() const { return run_.simulation(); }
  Body& wheel() { return simulation().body(wheel_); }
  const Body& wheel() const { return simulation().body(wheel_); }
  int wheel_index() const { return wheel_; }
  const WheelStance& stance() const { return stance_; }
  /// Height of the undisturbed surface, mean over the track [m].
  double surface() const { return surface_; }
  /// The surface of the whole bed, or of the patch, before the wheel and now.
  SurfaceHeight before() const;
  SurfaceHeight surface_now() const;
  /// Whether the patch has gone on from there, x [m].
  bool has_left(double x) const { return patch_ && x < patch_->rear(); }
  const std::optional<MovingPatch>& patch() const { return patch_; }
  /// Where the axle is put down, x in the bin [m].
  double begin() const { return rig_.behind; }
  /// Depth of the tread base below the undisturbed surface, now [m].
  double sinkage() const { return surface_ - (wheel().position.z - tire_.radius); }
  double travel() const { return wheel().position.x - begin(); }

  /// For StagedRun::keep.
  template <class Notes>
  void state(Notes& notes) {
    notes(wheel_, surface_, next_look_, before_, moment_at_rest_, sample_);
    if (!rig_.patch) return;
    notes(rut_way_);
    bool open = patch_.has_value();
    notes(open);
    if (!open) return;
    if (!patch_) patch_.emplace(tile_of(bed_.setup, bed_.state), patch_size());
    patch_->state(notes);
  }

 private:
  void hold_floor();
  void put_body();
  void show();
  KeepsRut keeps_rut_of(int pass) const { return pass < at_.pass ? KeepsRut::yes : KeepsRut::no; }
  PatchSize patch_size() const { return {rig_.behind, rig_.ahead, slab_of_patch(bed_.recipe)}; }
  Footprint window() const { return {patch_->rear(), patch_->front(), 0, bed_.recipe.size.width}; }

  const SettledBed& bed_;
  const Tire& tire_;
  OperatingCondition at_;
  const Rig& rig_;
  WheelStance stance_;
  Run run_;
  int wheel_ = -1;
  double surface_ = 0, next_look_ = 0;
  double rut_way_ = std::numeric_limits<double>::infinity();  ///< of the axle, over the rut of the pass before [m]
  SurfaceHeight before_;
  std::optional<MovingPatch> patch_;
  Vec3 moment_at_rest_;
  SampleUnderWay sample_;
};

template <class Run>
double WheelInBinOf<Run>::tilting() const {
  return at_.longitudinal_incline != 0 || at_.transverse_incline != 0 ? rig_.tilting : 0;
}

template <class Run>
std::int64_t WheelInBinOf<Run>::steps_of(double time) const {
  return std::llround(time / simulation().setup().numerics.dt);
}

/// No end walls hold a bed that repeats itself, and on a floor that is smooth beside the bed it would slide downhill as
/// one block.
template <class Run>
void WheelInBinOf<Run>::hold_floor() {
  if (!rig_.patch) return;
  if constexpr (std::is_same_v<Run, StagedRun>)
    run_.once(
        [&] { simulation().hold_grains([](const GrainNow& grain) { return grain.position.z <= grain.radius; }); });
}

template <class Run>
void WheelInBinOf<Run>::tilt() {
  hold_floor();
  const std::int64_t steps = steps_of(tilting());
  run_.steps("tilting", steps, [&](std::int64_t k) {
    const double share = std::min(1.0, 1.5 * static_cast<double>(k + 1) / static_cast<double>(steps));
    OperatingCondition part = at_;
    part.longitudinal_incline *= share, part.transverse_incline *= share;
    simulation().set_gravity(-bed_.recipe.gravity * wheel_stance(part).up);
    step();
  });
}

template <class Run>
double WheelInBinOf<Run>::free_height() const {
  const double rim = outer_radius(tire_), y = bed_.recipe.size.width / 2;
  double z = 0;
  const Grains& grains = own_grains(simulation());
  for (std::size_t k = 0; k < grains.count(); ++k) {
    const Vec3 from = grains.motion[k].position - Vec3{rig_.behind, y, 0};
    const double x = dot(from, stance_.heading), apart = rim + grains.motion[k].radius + wheel_gap;
    if (std::abs(dot(from, stance_.axle)) > tire_.width || std::abs(x) >= apart) continue;
    z = std::max(z, from.z + std::sqrt(apart * apart - x * x));
  }
  return largest_of_all(simulation(), z);
}

template <class Run>
void WheelInBinOf<Run>::open_patch() {
  if (!rig_.patch) return;
  if constexpr (std::is_same_v<Run, StagedRun>)
    run_.once([&] {
      patch_.emplace(tile_of(simulation().setup(), simulation().state()), patch_size(), keeps_rut_of(1));
      simulation() = patch_->open(simulation().setup(), simulation().state(), way());
    });
}

template <class Run>
void WheelInBinOf<Run>::go_back_over_rut(double way, int pass) {
  if constexpr (std::is_same_v<Run, StagedRun>) {
    rut_way_ = way;
    simulation() = patch_->back_over_its_rut(simulation(), way, keeps_rut_of(pass));
  }
}

template <class Run>
SurfaceHeight WheelInBinOf<Run>::before() const {
  return patch_ ? patch_->undisturbed(window(), bed_.recipe.soil.radius_min / 2) : before_;
}

template <class Run>
SurfaceHeight WheelInBinOf<Run>::surface_now() const {
  const Grains& grains = own_grains(simulation());
  const double smallest = bed_.recipe.soil.radius_min;
  return surface_of_all(simulation(), patch_ ? surface_height(grains, window(), smallest / 2)
                                             : bed_surface(grains, bed_.recipe.size, smallest));
}

template <class Run>
void WheelInBinOf<Run>::put_wheel() {
  run_.once([&] { put_body(); });
}

template <class Run>
void WheelInBinOf<Run>::put_body() {
  const Grains& grains = own_grains(simulation());
  const double y = bed_.recipe.size.width / 2, radius = bed_.recipe.soil.radius_min;
  const Footprint track{rig_.behind, rig_.behind + way(), y - tire_.width / 2, y + tire_.width / 2};
  if (patch_) {  // over a whole tile, which the wheel meets again and again
    Footprint tile = track;
    tile.x_upper = tile.x_lower + bed_.recipe.size.length;
    surface_ = patch_->undisturbed(tile, radius / 4).mean();
  } else {
    surface_ = surface_of_all(simulation(), surface_height(grains, track, radius / 4)).mean();
    before_ = surface_now();
  }

  Body body;
  body.name = "wheel";
  body.surfaces.push_back({MeshSurface{std::make_shared<TriangleMesh>(tire_surface(tire_, rig_.meshing)), nullptr},
                           static_cast<int>(simulation().setup().materials.all.size()) - 1});
  body.mass = rig_.mass > 0 ? rig_.mass : at_.load / bed_.recipe.gravity;
  const double inertia = rig_.inertia > 0 ? rig_.inertia : body.mass * tire_.radius * tire_.radius / 2;
  body.inertia = {inertia, inertia, inertia};
  body.free_translation = {false, false, true};
  body.axis = stance_.axle;
  body.rotation = rotation_by({0, 0, at_.yaw});
  body.position = {rig_.behind, y, free_height()};
  wheel_ = simulation().add_body(body);
}

template <class Run>
void WheelInBinOf<Run>::lower(const Vec3& force) {
  const std::int64_t ramp = steps_of(rig_.lowering), steps = ramp + steps_of(rig_.resting);
  const std::int64_t from = ramp + (steps - ramp) / 2;
  run_.once([&] { next_look_ = begin(), moment_at_rest_ = {}; });
  run_.steps("lowering", steps, [&](std::int64_t k) {
    const double share = k < ramp ? static_cast<double>(k + 1) / static_cast<double>(ramp) : 1.0;
    wheel().applied_force = share * force;
    step();
    if (k >= from) moment_at_rest_ += 1 / static_cast<double>(steps - from) * wheel().torque;
  });
}

template <class Run>
void WheelInBinOf<Run>::begin_sample(std::int64_t steps) {
  show();
  sample_ = {
      .sum = {}, .steps = steps, .taken = 0, .begun = simulation().time(), .travel = travel(), .work = wheel().work};
}

template <class Run>
void WheelInBinOf<Run>::step() {
  run_.step();
  if constexpr (std::is_same_v<Run, StagedRun>)
    if (patch_) patch_->follow(simulation(), wheel().position.x);
  if (!is_sampling()) return;
  ++sample_.taken;
  const double each = 1 / static_cast<double>(sample_.steps);
  WheelSample& sum = sample_.sum;
  const Body& now = wheel();
  sum.force += each * now.force;
  sum.moment += each * now.torque;
  sum.sinkage += each * sinkage();
  sum.speed += each * now.velocity.x;
  sum.heave += each * now.velocity.z;
  sum.rotation += each * dot(now.spin, stance_.axle);
}

template <class Run>
WheelSample WheelInBinOf<Run>::end_sample() {
  WheelSample out = sample_.sum;
  if (!is_full()) {
    const double more = static_cast<double>(sample_.steps) / static_cast<double>(sample_.taken);
    out.force = more * out.force, out.moment = more * out.moment;
    for (double* mean : {&out.sinkage, &out.speed, &out.heave, &out.rotation}) *mean *= more;
  }
  out.time = simulation().time();
  out.travel = travel();
  out.into_soil = (wheel().work - sample_.work) / (out.time - sample_.begun);
  sample_ = {};
  return out;
}

template <class Run>
void WheelInBinOf<Run>::show() {
  if (!rig_.onlooker.look || wheel().position.x < next_look_) return;
  if constexpr (std::is_same_v<Run, StagedRun>) rig_.onlooker.look(simulation(), wheel_, surface_);
  next_look_ += rig_.onlooker.every;
}

extern template class WheelInBinOf<StagedRun>;
using WheelInBin = WheelInBinOf<StagedRun>;

}  // namespace soilbin::dem
