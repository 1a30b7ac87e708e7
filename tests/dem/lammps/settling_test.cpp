// A bed that LAMMPS settles by the engine's stages, and a wheel on it.
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stop_token>
#include <vector>

#include "dem/rig/wheel_run_stages.hpp"
#include "dem/worker_lammps/lammps_bed.hpp"
#include "tests/dem/lammps/shared.hpp"
#include "tests/dem/small_bed.hpp"

namespace soilbin::dem {
namespace {

BedRecipe settled_recipe(std::uint64_t packing = 1) {
  BedRecipe recipe = test::small_recipe({0.36, 0.16, 0.08});
  recipe.packing = packing;
  return recipe;
}

LammpsSimulation poured_in_lammps(const BedRecipe& recipe) {
  return LammpsSimulation(
      MPI_COMM_WORLD, setup_of(recipe, 1), {0, 0, -recipe.gravity}, {bin_of(recipe.size)},
      {.largest = recipe.soil.radius_max, .pour = [&](const GrainSink& put) { pour(recipe, put); }});
}

Simulation poured_in_the_engine(const BedRecipe& recipe) {
  Simulation engine(setup_of(recipe, 1));
  engine.set_gravity({0, 0, -recipe.gravity});
  engine.add_body(bin_of(recipe.size));
  pour(recipe, [&](const Vec3& centre, double radius) { engine.add_grain(centre, radius, grain_material); });
  return engine;
}

double mean_overlap(const Simulation& engine) {
  double sum = 0, pairs = 0;
  for (const Contact& contact : engine.contacts())
    if (contact.second >= 0) sum += contact.overlap, pairs += 1;
  return sum / pairs;
}

/// Each process pours the whole sequence and keeps its share: together they have the engine's grains, which fall and
/// meet as there until chaos has blown up the order of sums.
TEST(LammpsSettling, PoursAndDropsTheEnginesGrainsAlike) {
  const BedRecipe recipe = settled_recipe();
  Simulation engine = poured_in_the_engine(recipe);
  LammpsSimulation lammps = poured_in_lammps(recipe);
  ASSERT_EQ(lammps.grain_count(), static_cast<double>(engine.state().grains.count()));
  constexpr int before_chaos = 400;
  engine.run(before_chaos), lammps.run(before_chaos);
  EXPECT_GT(engine.contacts().size(), 50u);
  const std::vector<double> there = test::places_of_all(lammps);
  double farthest = 0;
  for (const GrainId id : engine.state().grains.id) {
    const Vec3 here = engine.grain(id).position;
    farthest = std::max(farthest, length(here - Vec3{there[3 * id], there[3 * id + 1], there[3 * id + 2]}));
  }
  EXPECT_LT(farthest, 1e-9 * recipe.soil.radius_min);
}

/// Of one bed, handed over: the same surface, contacts and unrest, by each process's part.
TEST(LammpsSettling, MeasuresABedAsTheEngineAlike) {
  const BedRecipe recipe = settled_recipe();
  const SettledBed bed = settle_bed(recipe, test::with_threads(1));
  Simulation engine(bed.setup, bed.state);
  LammpsSimulation lammps(MPI_COMM_WORLD, bed.setup, bed.state);
  lammps.set_gravity({1, 0, -9.81}), engine.set_gravity({1, 0, -9.81});  // so that something moves
  lammps.run(0);
  const Footprint over{0.01, 0.35, 0.01, 0.15};
  for (const double cut : {0.06, 1.0})
    EXPECT_NEAR(mean_height(lammps, over, 0.0023, cut), mean_height(engine, over, 0.0023, cut), 1e-12);
  const BedReport report = report_on(lammps, recipe);
  EXPECT_EQ(report.grains, bed.report.grains);
  EXPECT_NEAR(report.void_ratio, bed.report.void_ratio, 0.003);  // by another lattice of points
  EXPECT_NEAR(report.coordination, bed.report.coordination, 0.01);
  EXPECT_NEAR(report.rattlers, bed.report.rattlers, 0.005);
  EXPECT_NEAR(report.height, bed.report.height, 1e-5);
  engine.run(20), lammps.run(20);
  const auto before = watched(lammps);
  const Unrest here = unrest(engine);
  lammps.run(16);
  const Unrest there = unrest_since(lammps, before, 16);
  EXPECT_NEAR(there.kinetic, here.kinetic, 0.05 * here.kinetic);
  EXPECT_NEAR(there.unbalanced, here.unbalanced, 0.05 * here.unbalanced);
  remove_above(engine, 0.06), remove_above(lammps, 0.06);
  EXPECT_EQ(lammps.grain_count(), static_cast<double>(engine.state().grains.count()));
  EXPECT_LT(lammps.grain_count(), static_cast<double>(report.grains));
  engine.run(50), lammps.run(50);  // what is left springs up
  EXPECT_NEAR(lammps.pair_means().overlap, mean_overlap(engine), 0.02 * mean_overlap(engine));
}

/// It is one packing among the engine's: within the scatter of six.
TEST(LammpsSettling, MakesABedLikeTheEngines) {
  std::vector<BedReport> engine;
  for (std::uint64_t packing = 1; packing <= 6; ++packing)
    engine.push_back(settle_bed(settled_recipe(packing), test::with_threads(1)).report);
  const BedRecipe recipe = settled_recipe();
  const WorkOptions how = test::with_threads(1);
  LammpsRun run(MPI_COMM_WORLD, recipe, how);
  const BedReport lammps = settle_in_lammps(run, recipe);
  const auto is_one_of_them = [&](double BedReport::*value) {
    double mean = 0, square = 0;
    for (const BedReport& bed : engine) mean += bed.*value / 6;
    for (const BedReport& bed : engine) square += std::pow(bed.*value - mean, 2) / 5;
    EXPECT_NEAR(lammps.*value, mean, 4 * std::sqrt(square));
  };
  is_one_of_them(&BedReport::void_ratio);
  is_one_of_them(&BedReport::coordination);
  is_one_of_them(&BedReport::settling_time);
  EXPECT_NEAR(lammps.height, recipe.size.depth, 0.1 * recipe.soil.radius_min);
  EXPECT_LT(lammps.unrest.kinetic, recipe.rest.kinetic);
  EXPECT_LT(lammps.unrest.unbalanced, recipe.rest.unbalanced);
}

/// Stopped while it settles, the bed goes on; then a wheel drives over it, from its folder.
TEST(LammpsSettling, StopsGoesOnAndCarriesAWheel) {
  const BedRecipe recipe = settled_recipe();
  const test::SharedFolder folder;
  std::stop_source stop;
  WorkOptions how = test::with_threads(1);
  how.stop = stop.get_token();
  how.progress = [&](const Progress& progress) {
    if (progress.done > 0.3) stop.request_stop();
  };
  const auto settle = [&] {
    LammpsRun run(MPI_COMM_WORLD, recipe, how, folder.path());
    return settle_in_lammps(run, recipe);
  };
  EXPECT_THROW(settle(), Stopped);
  how.stop = {}, how.progress = {};
  const BedReport report = settle();
  EXPECT_NEAR(report.height, recipe.size.depth, 0.1 * recipe.soil.radius_min);

  WheelJob job = test::wheel_job_on({.recipe = recipe, .setup = setup_of(recipe, 1), .state = {}, .report = report});
  job.bed.state.bodies = {bin_of(recipe.size)}, job.bed.grains_in = folder.path();
  job.rig.travel = 0.1;
  const WheelOnBed on = job.wheel();
  const WheelRun run = WheelRunStages<LammpsRun>(on, job.at, [&] { return LammpsRun(MPI_COMM_WORLD, job, how); }).run();
  const SettledBed bed = settle_bed(recipe, test::with_threads(1));
  const WheelRun engine = run_wheel({bed, on.tire, on.contact, on.rig}, job.at, test::with_threads(1));
  EXPECT_NEAR(run.surface, engine.surface, 0.5 * recipe.soil.radius_min);
  EXPECT_EQ(run.samples.size(), engine.samples.size());
  EXPECT_NEAR(run.result.torque.value, engine.result.torque.value, 0.2 * engine.result.torque.value);
}

}  // namespace
}  // namespace soilbin::dem
