// What the element tests share: a specimen of a soil's grains, walls that press at a stress, a rate that is slow
// enough, and the stepping with progress and stop.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "dem/bed/bed_store.hpp"

namespace soilbin::dem {

/// What a test asks of its settings: throws InputError "TEST: what" where that doesn't hold.
class Requirements {
 public:
  explicit Requirements(const char* test) : test_(test) {}
  void operator()(bool holds, const std::string& what) const;

 private:
  const char* test_;
};

/// How the grains of a specimen are put together; as in BedRecipe.
struct SpecimenSettings {
  std::uint64_t packing = 1;     ///< seed of the random places and radii
  double settling_friction = 1;  ///< share of friction while grains fall, 0 .. 1; 1 gives a loose, 0 the densest
  double dt = 0;                 ///< [s]; 0: longest_step
  ContactLaws laws = BedRecipe{}.laws;
};

/// The recipe of a bed that fills a box of this size, to be poured, levelled and settled by settle_bed.
BedRecipe specimen_recipe(const GranularSoil& soil, const BedSize& size, const SpecimenSettings& settings);

/// The bed of a recipe: from `beds` where there is one, else settled now.
std::shared_ptr<const SettledBed> specimen_bed(const BedRecipe& recipe, const WorkOptions& how, BedStore* beds);

/// A setup with the bed's material and laws, a domain that leaves walls room to move, and no bodies. Other materials
/// are added to it before the grains.
Setup specimen_setup(const SettledBed& bed, const WorkOptions& how);

/// A setup for grains that are put in loosely, on a floor in z = 0: their material, a domain that reaches `room` [m]
/// to all sides, and dt [s], 0: longest_step.
Setup loose_setup(const GranularSoil& soil, double dt, double room, const WorkOptions& how);

/// Adds a material of walls, as stiff as the grains, that rubs on them with this share of the grains' own sliding and
/// rolling friction and that of their cohesion; gives its index.
int add_wall_material(Setup& setup, const GranularSoil& soil, double share_of_friction);

/// Adds a material of plates with teeth, as stiff and as cohesive as the grains, on which they neither slide nor roll:
/// sliding and rolling friction of 1 or more; gives its index.
int add_gripping_material(Setup& setup, const GranularSoil& soil);

/// Puts the bed's grains, at rest, where they lie in the bed; the histories of their contacts start anew. Gives the
/// height of the highest one's top [m].
double put_grains(Simulation& simulation, const SettledBed& bed);

/// A servo that keeps `stress` [Pa] on a wall of `area` [m^2]; its gain follows from the stiffness and the dashpots of
/// a layer of Hertz contacts at this stress: a wall that answers its own dashpots in full flips to and fro every step.
/// `direction` points from the grains to the wall.
Servo press(const Vec3& direction, double stress, double area, const GranularSoil& soil, double dt);

/// Keeps a force at what is asked while the wall that a servo presses has to move. A servo's speed goes with its error,
/// so a wall that the grains push back steadily is off by its speed over the gain; what was missing in the past, added
/// to the target, takes that away. One object for each wall.
class HeldForce {
 public:
  /// Before each step; `asked` [N].
  void aim(Servo& servo, double asked) { servo.target = asked_ = asked, servo.target += lead_; }
  /// After it; `held` [N] is what should have been `asked`.
  void learn(double held) { lead_ += (asked_ - held) / steps; }
  /// The lead that lets the wall move at `speed` [m/s], away from the grains, without an error.
  void expect(const Servo& servo, double speed) { lead_ = -speed / servo.gain; }

 private:
  static constexpr double steps = 200;  // in which a steady error is made good
  double asked_ = 0, lead_ = 0;
};

/// I = rate d sqrt(rho/p): inertial number of a shear rate [1/s] at pressure p [Pa]. Below 1e-3 dense grains count as
/// quasi-static (after GDR MiDi 2004 and da Cruz et al. 2005).
double inertial_number(double rate, double pressure, const GranularSoil& soil);
/// The rate [1/s] that has this inertial number.
double shear_rate(double inertial_number, double pressure, const GranularSoil& soil);

/// Void ratio of the grains away from the bounds of a box of this size, filled to `height` [m].
double void_ratio_within(const Simulation& simulation, const BedSize& size, double height);

/// A mesh whose vertices are placed anew, or moved by a vector, as the surface of a body.
MeshSurface surface_of(const TriangleMesh& mesh, const std::function<Vec3(const Vec3&)>& place);
MeshSurface surface_at(const TriangleMesh& mesh, const Vec3& by);

/// Steps of one of so many samples over a way [m], `way_of_step` each; at least 1.
std::int64_t steps_of_sample(double way, double way_of_step, int samples);

/// Whether a line of strength can be laid through runs.
template <class Run>
bool under_two_stresses(const std::vector<Run>& runs) {
  for (const Run& run : runs)
    if (run.stress != runs.front().stress) return true;
  return false;
}

/// A test on every packing under every stress: run_one(bed, stress) gives the result, which keeps its packing. Each
/// packing's bed is taken once.
template <class RunOne>
auto on_packings(const BedRecipe& first, int packings, std::span<const double> stresses, const WorkOptions& how,
                 BedStore* beds, const RunOne& run_one) {
  std::vector<std::invoke_result_t<RunOne, const SettledBed&, double>> runs;
  BedRecipe recipe = first;
  for (int k = 0; k < packings; ++k, ++recipe.packing) {
    const std::shared_ptr<const SettledBed> bed = specimen_bed(recipe, how, beds);
    for (const double stress : stresses) runs.push_back(run_one(*bed, stress)), runs.back().packing = recipe.packing;
  }
  return runs;
}

/// Steps a simulation, tells progress and stops when asked to. Shares of the work are counted in steps.
class SteppedWork {
 public:
  explicit SteppedWork(const WorkOptions& how) : how_(how) {}
  /// Work that is still to come, so that the share done is known.
  void expect(double steps) { expected_ += steps; }
  void begin(std::string_view stage) { stage_ = stage; }
  /// One step. Throws Stopped.
  void step(Simulation& simulation);
  /// Runs until the wall `body`, kept by its servo, has carried its target to 1 % on average over 0.02 s three times in
  /// a row while it moved less than 1e-4 of `length` each time. Throws RunStopped after `at_most` [s].
  void settle_wall(Simulation& simulation, int body, double length, double at_most = 10);

 private:
  void tell() const;

  const WorkOptions& how_;
  std::string_view stage_ = "pressing";
  double expected_ = 0, done_ = 0;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

}  // namespace soilbin::dem
