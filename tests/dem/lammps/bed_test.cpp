// A bed and a wheel on it, with the grains in LAMMPS and in the engine.
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <stop_token>

#include "dem/rig/lammps_worker.hpp"
#include "dem/rig/wheel_job.hpp"
#include "dem/rig/wheel_run_stages.hpp"
#include "dem/worker_lammps/lammps_run.hpp"
#include "scenario/file_lock.hpp"
#include "tests/dem/lammps/shared.hpp"
#include "tests/dem/small_bed.hpp"

namespace soilbin::dem {
namespace {

namespace fs = std::filesystem;
using namespace test;

class LammpsBed : public testing::Test {
 protected:
  static const SettledBed& bed() {
    static const SettledBed settled = settle_bed(test::small_recipe({0.5, 0.16, 0.08}), test::with_threads(1));
    return settled;
  }
};

/// A wheel driven down into the bed and along it.
Body diving_wheel(const Tire& tire) {
  Body wheel;
  wheel.name = "wheel", wheel.mass = 2, wheel.free_translation = {false, false, true};
  wheel.surfaces.push_back({MeshSurface{std::make_shared<TriangleMesh>(tire_surface(tire)), nullptr}, 1});
  wheel.position = {0.25, 0.08, 0.2}, wheel.velocity = {0.3, 0, -0.3}, wheel.spin = {0, 4, 0};
  wheel.applied_force = {0, 0, -20};
  return wheel;
}

/// The bed goes on with what its contacts remember: wheel and grains move as in the engine, step by step, until chaos
/// has blown up the order of sums.
TEST_F(LammpsBed, CarriesADivingWheelAsTheEngineStepByStep) {
  const Tire tire = lugged();
  dem::Setup setup = run_setup({bed(), tire, bed().recipe.soil.grain_tire, brief_rig()}, 1);
  setup.numerics.sleep.speed = 0;
  Simulation engine(setup, bed().state);
  LammpsSimulation lammps(MPI_COMM_WORLD, setup, bed().state);
  engine.add_body(diving_wheel(tire)), lammps.add_body(diving_wheel(tire));
  double pressed = 0;
  for (int k = 0; k < 150; ++k) {
    engine.run(1);
    if (k > 0) lammps.run(1);  // LAMMPS computes the forces of its first place before it moves
    if (k == 0) lammps.run(0);
    const Body &here = engine.body(1), &there = lammps.body(1);
    pressed = std::max(pressed, length(here.force));
    ASSERT_LT(length(here.force - there.force), 1e-8 * std::max(pressed, 1.0)) << k;
    ASSERT_LT(length(here.position - there.position), 1e-12) << k;
  }
  EXPECT_GT(pressed, 20);
  engine.run(2000), lammps.run(2000);  // on average they stay alike
  double contacts = 0, overlap = 0;
  for (const Contact& contact : engine.contacts())
    if (contact.second >= 0) ++contacts, overlap += contact.overlap;
  const LammpsSimulation::PairMeans means = lammps.pair_means();
  EXPECT_NEAR(means.contacts, contacts, 0.005 * contacts);
  EXPECT_NEAR(means.overlap, overlap / contacts, 0.005 * overlap / contacts);
}

/// Alone on each process, and on all of them together: the numbers differ by the order of sums alone.
TEST_F(LammpsBed, MovesAlikeOnAnyNumberOfProcesses) {
  const Tire tire = lugged();
  const dem::Setup setup = run_setup({bed(), tire, bed().recipe.soil.grain_tire, brief_rig()}, 1);
  const Body wheel = diving_wheel(tire);
  LammpsSimulation alone(MPI_COMM_SELF, setup, bed().state), together(MPI_COMM_WORLD, setup, bed().state);
  alone.add_body(wheel), together.add_body(wheel);
  constexpr int before_chaos = 150;
  alone.run(before_chaos), together.run(before_chaos);
  const std::vector<double> here = places_of_all(alone), there = places_of_all(together);
  double farthest = 0;
  for (std::size_t n = 0; n < here.size(); ++n) farthest = std::max(farthest, std::abs(here[n] - there[n]));
  EXPECT_LT(farthest, 1e-10 * bed().recipe.soil.radius_min);
  const double force = length(alone.body(1).force);
  EXPECT_GT(force, 5);
  EXPECT_LT(length(alone.body(1).force - together.body(1).force), 1e-10 * force);
  alone.run(400), together.run(400);  // from here on it is chaos, and the wheel still stands on the bed
  EXPECT_NEAR(alone.body(1).position.z, together.body(1).position.z, 0.1 * bed().recipe.soil.radius_min);
}

/// Forces of the last step are computed anew from velocities of the whole step, so they differ by what a half step
/// changes in dashpots: less than a hundredth here. A memory that was lost would change them by a tenth and more.
TEST_F(LammpsBed, GoesOnFromItsFiles) {
  const Tire tire = lugged();
  const dem::Setup setup = run_setup({bed(), tire, bed().recipe.soil.grain_tire, brief_rig()}, 1);
  const SharedFolder folder;
  LammpsSimulation whole(MPI_COMM_WORLD, setup, bed().state);
  whole.add_body(diving_wheel(tire));
  whole.run(150);
  whole.write_grains((folder.path() / "grains").string());
  const std::string notes = whole.notes();
  LammpsSimulation resumed(MPI_COMM_WORLD, setup, "", (folder.path() / "grains").string(), notes,
                           {bin_of(bed().recipe.size), diving_wheel(tire)});
  EXPECT_EQ(resumed.state().step, whole.state().step);
  whole.run(1), resumed.run(1);
  const double force = length(whole.body(1).force);
  EXPECT_GT(force, 5);
  EXPECT_LT(length(whole.body(1).force - resumed.body(1).force), 0.01 * force);
  EXPECT_LT(length(whole.body(1).position - resumed.body(1).position), 1e-9);
  const std::vector<double> here = places_of_all(whole), there = places_of_all(resumed);
  double farthest = 0;
  for (std::size_t n = 0; n < here.size(); ++n) farthest = std::max(farthest, std::abs(here[n] - there[n]));
  EXPECT_LT(farthest, 1e-4 * bed().recipe.soil.radius_min);
}

/// Stopped in the middle, the run keeps its state; the same call goes on from there and has all samples.
TEST_F(LammpsBed, StopsAndGoesOnInTheMiddleOfARun) {
  WheelJob job = wheel_job_on(bed());
  job.rig.travel = 0.1;
  const WheelOnBed on = job.wheel();
  const SharedFolder folder;
  std::stop_source stop;
  WorkOptions how = test::with_threads(1);
  how.stop = stop.get_token();
  how.progress = [&](const Progress& progress) {
    if (progress.stage == "driving") stop.request_stop();
  };
  const auto run = [&] {
    return WheelRunStages<LammpsRun>(on, job.at, [&] { return LammpsRun(MPI_COMM_WORLD, job, how, folder.path()); })
        .run();
  };
  EXPECT_THROW(run(), Stopped);
  EXPECT_TRUE(fs::exists(folder.path() / "state"));
  how.stop = {};
  const WheelRun rest = run();
  const WheelRun whole =
      WheelRunStages<LammpsRun>(on, job.at, [&] { return LammpsRun(MPI_COMM_WORLD, job, how); }).run();
  EXPECT_EQ(rest.samples.size(), whole.samples.size());
  EXPECT_GT(rest.earlier, 0);
  EXPECT_NEAR(rest.surface, whole.surface, 0.02 * bed().recipe.soil.radius_min);
  EXPECT_NEAR(rest.samples.back().travel, whole.samples.back().travel, 1e-9);
  EXPECT_NEAR(rest.result.torque.value, whole.result.torque.value,
              4 * std::hypot(rest.result.torque.std_error, whole.result.torque.std_error));
}

/// What stands in the files of a job is what was put there.
TEST_F(LammpsBed, GoesThroughFilesWhole) {
  const fs::path folder = fs::path(testing::TempDir()) / fmt::format("soilbin-job-{}", ::getpid());
  const SettledBed& settled = bed();
  const Tire tire = lugged();
  const WheelOnBed there{settled, tire, settled.recipe.soil.grain_tire, brief_rig()};
  write_job(folder / "job.h5", there, driven(), "inputs of it\n");
  const WheelJob job = read_job(folder / "job.h5");
  EXPECT_EQ(job.inputs, "inputs of it\n");
  EXPECT_EQ(job.at, driven());
  EXPECT_EQ(job.tire.lugs.count, lugged().lugs.count);
  EXPECT_EQ(job.rig.travel, brief_rig().travel);
  EXPECT_EQ(job.bed.state.grains.count(), settled.state.grains.count());
  EXPECT_EQ(job.setup.materials.all.size(), 2u);
  fs::remove_all(folder);
}

/// What is kept of a run goes when nobody is at it.
TEST(LammpsFolder, IsForgottenUnlessAnotherIsAtIt) {
  const fs::path folder = fs::path(testing::TempDir()) / fmt::format("soilbin-forget-{}", ::getpid());
  const fs::path run = lammps_folder(folder / "run-0123.h5");
  fs::create_directories(run);
  {
    const FileLock other(lammps_lock(run), FileLock::Wait::no);
    forget_run(folder / "run-0123.h5");
    EXPECT_TRUE(fs::exists(run));
  }
  forget_run(folder / "run-0123.h5");
  EXPECT_FALSE(fs::exists(run));
  fs::remove_all(folder);
}

TEST_F(LammpsBed, CarriesTheWheelAsTheEnginesBedDoes) {
  const WheelJob job = wheel_job_on(bed());
  const WheelOnBed on = job.wheel();
  const WheelRun engine = run_wheel(on, job.at, test::with_threads(1));
  const WorkOptions how = test::with_threads(1);
  const WheelRun lammps =
      WheelRunStages<LammpsRun>(on, job.at, [&] { return LammpsRun(MPI_COMM_WORLD, job, how); }).run();
  const auto alike = [](const Estimate& a, const Estimate& b) {  // within four standard errors of the difference
    EXPECT_NEAR(a.value, b.value, 4 * std::hypot(a.std_error, b.std_error));
  };
  alike(lammps.result.drawbar_pull, engine.result.drawbar_pull);
  alike(lammps.result.torque, engine.result.torque);
  alike(lammps.result.sinkage, engine.result.sinkage);
  EXPECT_EQ(lammps.samples.size(), engine.samples.size());
  EXPECT_NEAR(lammps.power.rest, 0, 0.03 * lammps.power.drive);
  EXPECT_NEAR(lammps.samples.back().travel, engine.samples.back().travel, 1e-9);

  const fs::path file = fs::path(testing::TempDir()) / fmt::format("soilbin-answer-{}.txt", ::getpid());
  write_answer(file, lammps);
  const WheelRun read = read_answer(file, job.tire, job.at, job.rig);
  EXPECT_EQ(read.result.drawbar_pull.value, lammps.result.drawbar_pull.value);
  EXPECT_EQ(read.power.rest, lammps.power.rest);
  EXPECT_EQ(read.result.patch.size(), lammps.result.patch.size());
  EXPECT_EQ(read.flow.solid, lammps.flow.solid);
  fs::remove(file);
}

}  // namespace
}  // namespace soilbin::dem
