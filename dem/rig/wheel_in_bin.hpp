// A wheel put on a settled bed and loaded: what every way of driving it along the bin begins with.
#pragma once

#include <cstdint>
#include <string>

#include "dem/bed/settled_bed.hpp"
#include "dem/bed/surface_height.hpp"
#include "dem/rig/staged_run.hpp"
#include "dem/rig/wheel_motion.hpp"
#include "dem/rig/wheel_run.hpp"
#include "scenario/tire.hpp"

namespace soilbin::dem {

/// Between wheel and grains where it is put down [m].
inline constexpr double wheel_gap = 1e-4;

template <class Notes>
void parts(Notes& notes, SurfaceHeight& s) {
  notes(s.over.x_lower, s.over.x_upper, s.over.y_lower, s.over.y_upper, s.nx, s.ny, s.height);
}
template <class Notes>
void parts(Notes& notes, TreadForces& t) {
  notes(t.sectors, t.thrust, t.resistance, t.side);
}
template <class Notes>
void parts(Notes& notes, Ledger& l) {
  auto& [damping, shear_damping, sliding, into_slide, into_roll, adhesion, added] = l;
  notes(damping, shear_damping, sliding, into_slide, into_roll, adhesion, added);
}
template <class Notes>
void parts(Notes& notes, WheelSample& s) {
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
void parts(Notes& notes, SampleUnderWay& s) {
  notes(s.sum, s.steps, s.taken, s.begun, s.travel, s.work);
}

/// That the axle may go [m]. Throws InputError for a bed too short or narrow.
double way_in_bin(const BedSize& size, const Tire& tire, const Rig& rig);

/// The stages before a wheel is driven, its steps and its samples. `on` and options must outlive it. Of the condition
/// load, inclines and yaw are read. `inputs`: what the whole run follows from (StagedRun).
class WheelInBin {
 public:
  WheelInBin(const WheelOnBed& on, const OperatingCondition& at, const WorkOptions& how, const Checkpoints& checkpoints,
             std::string inputs);

  /// way_in_bin of this bed, tire and rig.
  double way() const { return way_in_bin(bed_.recipe.size, tire_, rig_); }
  /// Time in which gravity turns; 0 on level ground [s].
  double tilting() const;
  std::int64_t steps_of(double time) const;

  /// The stages; what is done between them goes through StagedRun::once.
  StagedRun& run() { return run_; }
  /// Turns gravity to the incline and lets the bed come to terms with it.
  void tilt();
  /// Measures the surface and puts the wheel over it.
  void put_wheel();
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

  Simulation& simulation() { return run_.simulation(); }
  const Simulation& simulation() const { return run_.simulation(); }
  Body& wheel() { return simulation().body(wheel_); }
  const Body& wheel() const { return simulation().body(wheel_); }
  int wheel_index() const { return wheel_; }
  const WheelStance& stance() const { return stance_; }
  /// Height of the undisturbed surface, mean over the track [m].
  double surface() const { return surface_; }
  /// Of the whole bed, where the wheel is put down.
  const SurfaceHeight& before() const { return before_; }
  /// Where the axle is put down, x in the bin [m].
  double begin() const { return rig_.behind; }
  /// Of the tread base below the undisturbed surface, now [m].
  double sinkage() const { return surface_ - (wheel().position.z - tire_.radius); }
  double travel() const { return wheel().position.x - begin(); }

  /// For StagedRun::keep.
  template <class Notes>
  void state(Notes& notes) {
    notes(wheel_, surface_, next_look_, before_, moment_at_rest_, sample_);
  }

 private:
  Setup setup_for(const ContactPair& tire_contact, int threads) const;
  void put_body();
  void show();

  const SettledBed& bed_;
  const Tire& tire_;
  OperatingCondition at_;
  const Rig& rig_;
  WheelStance stance_;
  StagedRun run_;
  int wheel_ = -1;
  double surface_ = 0, next_look_ = 0;
  SurfaceHeight before_;
  Vec3 moment_at_rest_;
  SampleUnderWay sample_;
};

}  // namespace soilbin::dem
