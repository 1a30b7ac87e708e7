// The virtual soil bin as a Model: a scenario's tire on a settled bed of its soil's grains.
//
//   const DemModel bin({.size = {.length = 2.5, .width = 0.8, .depth = 0.3}, .beds = "beds"});  // [m]; folder of beds
//   const TractionResult result = bin.evaluate(scenario, {.load = 8000, .slip = 0.2});          // takes minutes
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "dem/bed/bed_store.hpp"
#include "dem/rig/free_drive.hpp"
#include "dem/rig/lammps_worker.hpp"
#include "dem/rig/wheel_run.hpp"
#include "scenario/scenario.hpp"

namespace soilbin::dem {

struct DemSettings {
  BedSize size;                               ///< of the bed; a scenario's bin replaces depth and width
  std::uint64_t packing = 1;                  ///< seed of the bed
  double settling_friction = 1;               ///< as in BedRecipe
  SettledBy settled_by = SettledBy::soilbin;  ///< lammps needs `lammps`
  double graded = 1;           ///< grains below and beside the track up to so many times coarser (Grading)
  double highest_lugs = 0;     ///< height of lugs for which a graded bed is fine too, where the tire's are lower [m]
  std::filesystem::path beds;  ///< folder that keeps beds; empty: none is kept on disk
  Rig rig;
  std::optional<double> bed_dt;  ///< step with which beds settle [s], 0 as in BedRecipe; without one the rig's
  WorkOptions how;
  /// How a run under way is kept, in files run-KEY.h5 and drive-KEY.h5 of the folder `restart`, by a hash of all that
  /// it follows from; without a folder none is.
  Checkpoints checkpoints{.restart = {}, .seconds = 60};
  /// A finished run's restart goes when evaluate returns; false: it stays until whoever has put the answer where it is
  /// safe calls forget.
  bool forget_finished = true;
  /// The engine of wheel runs: this program's own, or LAMMPS in processes of its own (drives stay
  /// with the engine, and beds but for settled_by).
  std::optional<LammpsWorker> lammps;
  std::function<void(const WheelRun&)> on_run;  ///< gets everything a run told, before evaluate returns
};

/// What answers carry: "dem", and this where LAMMPS moves the grains.
inline constexpr const char* lammps_model_name = "dem-lammps";
inline std::string model_name(const DemSettings& settings) { return settings.lammps ? lammps_model_name : "dem"; }

class DemModel : public Model {
 public:
  explicit DemModel(DemSettings settings = {}) : settings_(std::move(settings)), beds_(settings_.beds) {}

  std::string name() const override { return model_name(settings_); }
  /// Sinkage, forces and torque are means over the steady part of one run, with the errors of its fluctuations; the
  /// scatter between packings comes on top. Throws what check and run_wheel throw, and InputError for effects. One call
  /// at a time: a run uses all the threads it is given. Where runs are kept, what is there is gone on with.
  TractionResult evaluate(const Scenario& scenario, const OperatingCondition& at) const override;
  /// Where a run is kept, whether it has an answer or failed; empty where none is.
  std::filesystem::path restart_of(const Scenario& scenario, const OperatingCondition& at) const;

  /// A drive of the scenario's tire on a bed of its soil. Throws what check and drive_freely throw. The drive's effects
  /// belong to the analytic model and are not read. Where runs are kept the last restart stays and answers the same
  /// call at once, until it is forgotten.
  GrainDriveRecord drive(const Scenario& scenario, const Drive& drive, int samples = 400) const;
  /// Removes what is kept of a drive.
  void forget(const Scenario& scenario, const Drive& drive, int samples = 400) const;

  /// Throws InputError where no condition can be run, before a bed is settled: without granular values, for a bed that
  /// makes no sense or has no room for the wheel (way_in_bin), for a time step that is too long or too short, and for
  /// grains with which the work gets nowhere (check_pace).
  void check(const Scenario& scenario) const;
  /// Checks a run at this condition: throws also where wheel_motion does, and for a speed or times of the rig
  /// with which the run would take more than 1e10 steps.
  void check(const Scenario& scenario, const OperatingCondition& at) const;

  /// Steps of a run, from the tilt to the end of its way, about.
  double expected_steps(const Scenario& scenario, const OperatingCondition& at) const;

  /// Grains in a run at once, about: those of the bed, or of the moving patch.
  double grains_of_run(const Scenario& scenario) const;

  /// The bed that a scenario's soil gets.
  BedRecipe recipe(const Scenario& scenario) const;
  /// The bed of a recipe, from where beds are kept or settled now.
  std::shared_ptr<const SettledBed> bed(const BedRecipe& recipe) const;

 private:
  /// Where a sunken wheel reached over an end of the bin.
  void tell_of_ends(const Tire& tire, double sinkage) const;
  /// Where the soil at the front end of a moving patch had been moved.
  void tell_of_patch(const WheelRun& run, const BedRecipe& bed) const;
  /// With the restart's file: `kind` and key.
  Checkpoints checkpoints(const std::string& kind, const std::string& inputs) const;
  Checkpoints checkpoints_of(const Scenario& scenario, const OperatingCondition& at) const;
  Checkpoints checkpoints_of(const Scenario& scenario, const Drive& drive, int samples) const;

  DemSettings settings_;
  mutable BedStore beds_;
};

}  // namespace soilbin::dem
