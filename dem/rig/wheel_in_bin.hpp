// A wheel put on a settled bed and loaded: what every way of driving it along the bin begins with.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string_view>

#include "dem/bed/settled_bed.hpp"
#include "dem/bed/surface_height.hpp"
#include "dem/rig/wheel_motion.hpp"
#include "dem/rig/wheel_run.hpp"
#include "scenario/tire.hpp"

namespace soilbin::dem {

/// Between wheel and grains where it is put down [m].
inline constexpr double wheel_gap = 1e-4;

/// The stages before a wheel is driven, its steps, its samples, and the word about how far it is. Bed, tire, rig and
/// options must outlive it. Of the condition load, inclines and yaw are read.
class WheelInBin {
 public:
  WheelInBin(const SettledBed& bed, const Tire& tire, const ContactPair& tire_contact, const OperatingCondition& at,
             const Rig& rig, const WorkOptions& how);

  /// Throws InputError for a bed too short or narrow.
  void check_room() const;
  /// That the axle may go [m].
  double way() const;
  /// Time in which gravity turns; 0 on level ground [s].
  double tilting() const;
  std::int64_t steps_of(double time) const;
  /// Of all work that is to come, for tell.
  void plan(double steps) { all_steps_ = steps; }

  /// Turns gravity to the incline and lets the bed come to terms with it.
  void tilt();
  /// Measures the surface and puts the wheel over it.
  void put_wheel();
  /// The lowest place of the axle over the start where no grain is within the rim that the lugs reach [m].
  double free_height() const;
  /// Brings `force` on evenly and lets the wheel rest under it. Gives the soil's mean moment on the wheel over the
  /// second half of the rest [N m].
  Vec3 lower(const Vec3& force);

  /// One step of the engine.
  void step();
  /// Takes `steps` steps by `one_step`, fewer where that says false; means over those that it took. What is at the
  /// sample's end is there too, but for tread and ledger.
  WheelSample sample(std::int64_t steps, const std::function<bool()>& one_step);
  /// Lets the rig's onlooker look where it is time.
  void show();
  /// Tells the stage and how far the work is, `done` where that isn't the share of the steps planned. Throws Stopped.
  void tell(std::string_view stage, std::optional<double> done = {});
  /// Share of the steps planned that are taken.
  double done() const { return std::min(1.0, static_cast<double>(steps_) / all_steps_); }

  Simulation& simulation() { return simulation_; }
  const Simulation& simulation() const { return simulation_; }
  Body& wheel() { return simulation_.body(wheel_); }
  const Body& wheel() const { return simulation_.body(wheel_); }
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

 private:
  Setup setup_for(const ContactPair& tire_contact) const;

  const SettledBed& bed_;
  const Tire& tire_;
  OperatingCondition at_;
  const Rig& rig_;
  const WorkOptions& how_;
  WheelStance stance_;
  Simulation simulation_;
  int wheel_ = -1;
  double surface_ = 0, next_look_ = 0;
  SurfaceHeight before_;
  std::int64_t steps_ = 0;
  double all_steps_ = 1;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

}  // namespace soilbin::dem
