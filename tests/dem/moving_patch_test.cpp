// A moving patch of a bed that repeats itself: at rest without a wheel, and under one as on a fixed bed.
#include "dem/rig/moving_patch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "dem/bed/bed_store.hpp"
#include "dem/rig/dem_model.hpp"
#include "dem/rig/wheel_in_bin.hpp"
#include "scenario/mapping_writer.hpp"
#include "scenario/unit.hpp"
#include "tests/dem/archive_scene.hpp"
#include "tests/dem/small_bed.hpp"
#include "tests/dem/worlds.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin::dem {
namespace {

using test::Folder;
using test::small_wheel;
using test::with_threads;
using ::testing::HasSubstr;

BedRecipe tile_recipe(GrainShape shape = GrainShape::sphere) {
  BedRecipe recipe = test::small_recipe({0.3, 0.16, 0.06});
  recipe.periodic = true, recipe.soil.shape = shape;
  return recipe;
}

/// Settled once for all tests.
const SettledBed& settled(const BedRecipe& recipe) {
  static std::map<std::string, SettledBed> beds;
  const std::string key = recipe_text(recipe);
  const auto found = beds.find(key);
  return found != beds.end() ? found->second : beds.emplace(key, settle_bed(recipe, with_threads(1))).first->second;
}

const SettledBed& tile_bed(GrainShape shape = GrainShape::sphere) { return settled(tile_recipe(shape)); }

double slab() { return slab_of_patch(tile_recipe()); }
double diameter() { return mean_diameter(tile_recipe().soil); }

/// [m]
PatchSize small_patch() { return {.behind = 0.12, .ahead = 0.13, .slab = slab()}; }

Setup patch_setup(const SettledBed& bed = tile_bed(), int threads = 1, bool ledger = false) {
  Setup setup = bed.setup;
  setup.numerics.threads = threads, setup.numerics.ledger = ledger;
  return setup;
}

/// Goes on without a wheel by some slabs, with steps between.
void go_on(MovingPatch& patch, Simulation& simulation, int slabs, int steps_each) {
  for (int k = 0; k < slabs; ++k) {
    simulation.run(steps_each);
    patch.follow(simulation, small_patch().behind + static_cast<double>(patch.advances() + 1) * slab());
  }
}

/// On grains that are spheres, and on clumps.
class Patch : public ::testing::TestWithParam<GrainShape> {
 public:
  const SettledBed& bed() const { return tile_bed(GetParam()); }
  MovingPatch patch(KeepsRut keeps = KeepsRut::no) const {
    return MovingPatch(tile_of(bed().setup, bed().state), small_patch(), keeps);
  }
};

std::string name_of(const ::testing::TestParamInfo<GrainShape>& info) { return std::string(word_of(info.param)); }

INSTANTIATE_TEST_SUITE_P(Spheres, Patch, ::testing::Values(GrainShape::sphere), name_of);
INSTANTIATE_TEST_SUITE_P(SlowClumps, Patch, ::testing::Values(GrainShape::four_spheres), name_of);

TEST_P(Patch, IsMadeOfATileThatHoldsAsManyContactsThroughItsSeamAsThroughAnyOtherCut) {
  const Tile tile = tile_of(bed().setup, bed().state);
  EXPECT_EQ(tile.grains.size() - tile.clumps.members.size() + tile.clumps.all.size(), bed().report.grains);
  for (std::uint32_t grain = 0; grain < tile.grains.size(); ++grain) {
    EXPECT_GE(tile.x_of(0, grain), 0);
    EXPECT_LE(tile.x_of(0, grain), tile.length);
  }
  // Contacts that go through the cut x, the seam being x = 0.
  const auto through = [&](double x) {
    int count = 0;
    for (const TileContact& contact : tile.contacts) {
      const double a = tile.grains[contact.first].position.x;
      const double b = tile.grains[contact.second].position.x + contact.image * tile.length;
      EXPECT_LT(std::abs(a - b), 2.01 * 0.012) << "the image next to the first";
      for (const int image : {-1, 0, 1}) count += (a + image * tile.length < x) != (b + image * tile.length < x);
    }
    return count;
  };
  double sum = 0, squares = 0;
  constexpr int cuts = 14;
  for (int k = 1; k <= cuts; ++k) {
    const double here = through(tile.length * k / (cuts + 1));
    sum += here, squares += here * here;
  }
  const double mean = sum / cuts, deviation = std::sqrt(squares / cuts - mean * mean);
  EXPECT_GT(mean, 20);
  EXPECT_NEAR(through(0), mean, 4 * deviation);
}

TEST_P(Patch, WithoutAWheelStaysAtRestWhileItGoesOn) {
  MovingPatch patch = this->patch();
  Simulation simulation = patch.open(patch_setup(bed()), bed().state, 1);
  const RestTest& rest = tile_recipe().rest;
  const auto expect_rest = [&](const char* when) {
    const Unrest now = unrest(simulation);
    EXPECT_LT(now.kinetic, rest.kinetic) << when;
    EXPECT_LT(now.unbalanced, rest.unbalanced) << when;
  };
  expect_rest("opened");
  const int period = static_cast<int>(std::ceil(tile_bed().recipe.size.length / slab()));
  for (int k = 0; k < 2 * period; ++k) {
    go_on(patch, simulation, 1, 50);
    expect_rest("gone on");
  }
  EXPECT_NEAR(static_cast<double>(simulation.state().grains.count()), patch.grains(), 0.15 * patch.grains());
  EXPECT_LT(patch.disturbed(), 1e-3 * diameter());
  EXPECT_EQ(patch.thrown(), 0);
}

TEST(SlowMovingPatch, OfAGradedBedStaysAtRestWhileItGoesOn) {
  BedRecipe recipe = tile_recipe();
  recipe.soil.radius_min = 0.005, recipe.soil.radius_max = 0.007, recipe.size = {0.3, 0.2, 0.1};
  recipe.grading = {.factor = 2, .half_width = 0.05, .depth = 0.04, .transition = 0.03};
  const SettledBed bed = settle_bed(recipe, with_threads(1));
  const double advance = slab_of_patch(recipe);
  MovingPatch patch(tile_of(bed.setup, bed.state), {.behind = 0.12, .ahead = 0.13, .slab = advance});
  Simulation simulation = patch.open(bed.setup, bed.state, 1);
  for (int k = 0; k < 8; ++k) {
    simulation.run(50);
    patch.follow(simulation, 0.12 + static_cast<double>(patch.advances() + 1) * advance);
    EXPECT_LT(unrest(simulation).kinetic, recipe.rest.kinetic) << k;
    EXPECT_LT(unrest(simulation).unbalanced, recipe.rest.unbalanced) << k;
  }
  EXPECT_GT(static_cast<double>(patch.advances()) * advance, recipe.size.length) << "the whole tile came in";
  EXPECT_LT(patch.disturbed(), 1e-3 * mean_diameter(recipe.soil));
}

TEST_P(Patch, EndsInWhatIsHeldAndNothingElseIs) {
  MovingPatch patch = this->patch();
  Simulation simulation = patch.open(patch_setup(bed()), bed().state, 1);
  go_on(patch, simulation, 3, 10);
  const State& state = simulation.state();
  int held = 0;
  for (std::size_t row = 0; row < state.grains.count(); ++row) {
    const Motion& grain = state.grains.motion[row];
    const std::uint32_t clump = state.grains.clump[row];
    const double x = clump == lone ? grain.position.x : state.clumps.all[clump].motion.position.x;
    EXPECT_GE(x, patch.rear() - slab());
    EXPECT_LT(x, patch.front() + slab());
    EXPECT_EQ(grain.held(), x < patch.rear() || x >= patch.front()) << x;
    EXPECT_EQ(grain.held(), state.grains.spin[row].inverse_inertia == 0);
    held += grain.held();
  }
  EXPECT_GT(held, 50);
}

// A clump that went through a patch is the rigid body that it was: its spheres lie as in its tile, and weigh it.
TEST(MovingPatch, LeavesClumpsWhole) {
  BedRecipe recipe = tile_recipe(GrainShape::two_spheres);
  recipe.size.width = 0.06, recipe.size.depth = 0.05;
  const SettledBed& bed = settled(recipe);
  MovingPatch patch(tile_of(bed.setup, bed.state), small_patch());
  Simulation simulation = patch.open(patch_setup(bed), bed.state, 1);
  go_on(patch, simulation, 6, 40);
  const State& state = simulation.state();
  EXPECT_EQ(state.clumps.members.size(), state.grains.count());
  EXPECT_EQ(state.clumps.all.size() * 2, state.grains.count());
  for (const Clump& clump : state.clumps.all)
    for (const ClumpMember& member : state.clumps.of(clump)) {
      const Motion& sphere = state.grains.motion[member.row];
      EXPECT_EQ(state.grains.id[member.row], member.id);
      EXPECT_LT(length(clump.motion.position + clump.motion.rotation(member.arm) - sphere.position), 1e-12);
      if (!sphere.held()) {
        EXPECT_DOUBLE_EQ(sphere.inverse_mass * clump.mass, 1);
        EXPECT_DOUBLE_EQ(state.grains.spin[member.row].inverse_inertia * mean_inertia(clump), 1);
      }
    }
}

TEST_P(Patch, LedgerClosesWithWhatEntersAndLeaves) {
  MovingPatch patch = this->patch();
  Simulation simulation = patch.open(patch_setup(bed(), 1, true), bed().state, 1);
  // Something to count: all that lies on top gets a push.
  Body plate = test::mesh_body(box({0.06, 0.06, 0.02}));
  plate.position = {0.12, 0.08, 0.085};
  plate.velocity = {0.3, 0, -0.3};
  simulation.add_body(plate);
  double leaves_and_enters = 0;
  for (int k = 0; k < 4; ++k) {
    simulation.run(100);
    const double before = simulation.energy().total(), added = simulation.state().ledger.added;
    patch.follow(simulation, small_patch().behind + static_cast<double>(patch.advances() + 1) * slab());
    const double scale = simulation.energy().kinetic + std::abs(simulation.energy().potential);
    EXPECT_NEAR(simulation.energy().total(), before, 1e-12 * scale);
    leaves_and_enters += std::abs(simulation.state().ledger.added - added);
  }
  EXPECT_GT(leaves_and_enters, 1e-4);
  EXPECT_LT(std::abs(simulation.energy().total()), 0.02 * simulation.body(1).work);
}

TEST_P(Patch, TellsTheSameBitsForThreadsAndFromACopyOfItsState) {
  const auto begun = [&](MovingPatch& patch, int threads) {
    return patch.open(patch_setup(bed(), threads), bed().state, 1);
  };
  MovingPatch one = patch(), three = one;
  Simulation with_one = begun(one, 1), with_three = begun(three, 3);
  go_on(one, with_one, 2, 60), go_on(three, with_three, 4, 60);
  MovingPatch later = one;
  Simulation resumed(with_one.setup(), with_one.state());
  go_on(one, with_one, 2, 60), go_on(later, resumed, 2, 60);
  EXPECT_EQ(test::bits(with_one.state()), test::bits(with_three.state()));
  EXPECT_EQ(test::bits(with_one.state()), test::bits(resumed.state()));
}

// A plate has pushed the top of the bed; the furrow enters again grain by grain where it was left, and at rest.
TEST_P(Patch, GoesBackOverTheFurrowThatItHasLeft) {
  MovingPatch patch = this->patch(KeepsRut::yes);
  Simulation simulation = patch.open(patch_setup(bed()), bed().state, 1);
  Body plate = test::mesh_body(box({0.06, 0.06, 0.02}));
  const Footprint under_plate{0.08, 0.12, 0.06, 0.10};
  const SurfaceHeight settled = patch.undisturbed(under_plate, 0.002);
  plate.position = {0.1, 0.08, 0.1}, plate.velocity = {0, 0, -0.2};  // its lower face 0.09 m above the floor
  const int pusher = simulation.add_body(plate);
  const auto steps_of = [&](double time) { return static_cast<std::int64_t>(time / simulation.setup().numerics.dt); };
  simulation.run(steps_of((0.09 - settled.mean() + 0.15 * diameter()) / 0.2));
  simulation.body(pusher).velocity = {}, simulation.body(pusher).position.z = 0.3;
  const RestTest& rest = tile_recipe().rest;
  const auto is_at_rest = [&] {
    const Unrest now = unrest(simulation);
    return now.kinetic < rest.kinetic && now.unbalanced < rest.unbalanced;
  };
  for (int k = 0; k < 50 && !is_at_rest(); ++k) simulation.run(steps_of(0.1));
  ASSERT_TRUE(is_at_rest());
  std::vector<Vec3> left;  // places before the patch has gone on, and after: at its front end grains have moved
  const auto note_places = [&] {
    for (const GrainNow& grain : simulation.grains()) left.push_back(grain.position);
  };
  note_places();
  const std::size_t at_first = left.size();
  go_on(patch, simulation, 3, 400);
  note_places();
  const double disturbed = patch.disturbed();
  simulation = patch.back_over_its_rut(simulation, 3 * slab(), KeepsRut::no);
  EXPECT_EQ(patch.rear(), 0);
  int found = 0;
  for (const GrainNow& grain : simulation.grains()) {
    const auto near = [&](const Vec3& at) { return length(at - grain.position) < 2e-3 * diameter(); };
    found += std::ranges::any_of(left, near);
  }
  EXPECT_GE(found, 0.99 * static_cast<double>(at_first));
  const auto count = static_cast<double>(simulation.state().grains.count());
  const SurfaceHeight now = surface_height(simulation.state().grains, under_plate, 0.002);
  EXPECT_LT(now.mean(), settled.mean() - 0.1 * diameter()) << "the sinkage counts from before the furrow";
  for (int k = 0; k < 3; ++k) {
    EXPECT_TRUE(is_at_rest()) << k;
    go_on(patch, simulation, 1, 50);
  }
  EXPECT_NEAR(static_cast<double>(simulation.state().grains.count()), count, 0.1 * count);
  EXPECT_EQ(patch.disturbed(), disturbed) << "more than the plate did, at the first pass";
}

Rig patch_rig() {
  Rig rig;
  rig.behind = 0.12, rig.ahead = 0.16;
  rig.tilting = 0.1, rig.lowering = 0.1, rig.resting = 0.05;
  rig.patch = true;
  return rig;
}

OperatingCondition uphill() {
  OperatingCondition at;
  at.load = 20, at.slip = 0.3, at.speed = 0.3, at.longitudinal_incline = 2 * degree;
  return at;
}

WheelRun patch_run(const Rig& rig, const OperatingCondition& at, const WorkOptions& how,
                   const Checkpoints& checkpoints = {}, const SettledBed& bed = tile_bed()) {
  return run_wheel({bed, small_wheel(), bed.recipe.soil.grain_tire, rig}, at, how, checkpoints);
}

std::string patch_bits(WheelRun run) {
  NoteWriter bits;
  bits(run.samples, run.steady_from, run.drift, run.surface, run.moment, run.flow.vx, run.rut.across, run.rut.along);
  bits(run.patch.grains, run.patch.disturbed, run.patch.thrown);
  return bits.text();
}

void expect_stops_change_nothing(const SettledBed& bed, double travel) {
  const Folder folder;
  Rig rig = patch_rig();
  rig.travel = travel, rig.ledger = true;
  OperatingCondition twice = uphill();
  twice.pass = 2;
  const std::string whole = patch_bits(patch_run(rig, twice, with_threads(1), {}, bed));
  const Checkpoints kept{folder / "run.h5", 0};
  int stops = 0;
  for (std::string told; told.empty();) {
    std::stop_source source;
    WorkOptions how = with_threads(1 + stops % 2);
    how.stop = source.get_token();
    how.progress = [&, said = 0](const Progress&) mutable {
      if (++said == 8) source.request_stop();
    };
    try {
      told = patch_bits(patch_run(rig, twice, how, kept, bed));
      EXPECT_TRUE(told == whole);
    } catch (const Stopped&) {
      ++stops;
    }
  }
  EXPECT_GE(stops, 4);
}

TEST(SlowMovingPatch, ARunThatIsStoppedAgainAndAgainTellsTheSame) { expect_stops_change_nothing(tile_bed(), 0.12); }

TEST(SlowMovingPatch, ARunOnClumpsThatIsStoppedAgainAndAgainTellsTheSame) {
  expect_stops_change_nothing(tile_bed(GrainShape::two_spheres), 0.07);
}

/// Mean over packings of a channel, and its error from their scatter.
Estimate over(const std::vector<WheelRun>& runs, const auto& read) {
  double sum = 0, squares = 0;
  for (const WheelRun& run : runs) sum += read(run), squares += read(run) * read(run);
  const double n = static_cast<double>(runs.size()), mean = sum / n;
  return {mean, std::sqrt(std::max(squares / n - mean * mean, 0.0) / (n - 1))};
}

/// A bed whose grains on the floor are held, as a patch has them: these beds are three grains deep, and the wheel feels
/// how rough the floor is.
SettledBed with_rough_floor(SettledBed bed) {
  Simulation simulation(bed.setup, bed.state);
  EXPECT_GT(simulation.hold_grains([](const GrainNow& grain) { return grain.position.z <= grain.radius; }), 50U);
  bed.state = simulation.state();
  return bed;
}

/// The same run on long beds with end walls and on moving patches, several packings of each.
void expect_same_on_both(const OperatingCondition& at, GrainShape shape = GrainShape::sphere, double travel = 0.8,
                         std::uint64_t packings = 4) {
  std::vector<WheelRun> fixed, moving;
  for (std::uint64_t packing = 1; packing <= packings; ++packing) {
    const double length = travel + 0.38;
    BedRecipe recipe = test::small_recipe({length, 0.16, 0.06});
    recipe.packing = packing, recipe.soil.shape = shape;
    const SettledBed bed = with_rough_floor(settled(recipe));
    Rig rig = patch_rig();
    rig.patch = false, rig.travel = travel, rig.behind = 0.14, rig.ahead = 0.24;
    const Tire tire = small_wheel();
    fixed.push_back(run_wheel({bed, tire, recipe.soil.grain_tire, rig}, at, with_threads(1)));
    recipe.size.length = 0.3, recipe.periodic = true;
    const SettledBed& tile = settled(recipe);
    rig.patch = true;
    moving.push_back(run_wheel({tile, tire, recipe.soil.grain_tire, rig}, at, with_threads(1)));
    EXPECT_LT(moving.back().patch.grains, 0.57 / length * static_cast<double>(bed.state.grains.count()));
    EXPECT_LT(moving.back().patch.disturbed, 0.1 * diameter());
    EXPECT_NEAR(moving.back().samples.back().travel, travel, 0.01);
    EXPECT_GT(moving.back().rut.across.size(), 5U);
  }
  const auto same = [&](const char* what, const auto& read) {
    const Estimate a = over(fixed, read), b = over(moving, read);
    EXPECT_NEAR(a.value, b.value, 3.5 * std::hypot(a.std_error, b.std_error)) << what;
  };
  same("pull", [](const WheelRun& run) { return run.result.drawbar_pull.value; });
  same("torque", [](const WheelRun& run) { return run.result.torque.value; });
  same("sinkage", [](const WheelRun& run) { return run.result.sinkage.value; });
  same("lateral force", [](const WheelRun& run) { return run.result.lateral_force.value; });
}

TEST(SlowMovingPatch, PullsTurnsAndSinksAsOnAFixedBed) {
  OperatingCondition at = uphill();
  at.longitudinal_incline = 0;
  expect_same_on_both(at);
}

TEST(SlowMovingPatch, OfClumpsIsAsAFixedBedOfThemOnASlope) {
  expect_same_on_both(uphill(), GrainShape::two_spheres, 0.5, 3);
}

TEST(SlowMovingPatch, PullsTurnsSinksAndIsPushedAsideAsOnAFixedBedOnASlope) {
  OperatingCondition at = uphill();
  at.longitudinal_incline = 15 * degree, at.transverse_incline = 8 * degree, at.yaw = 8 * degree;
  expect_same_on_both(at);
}

TEST(SlowMovingPatch, GoesASecondTimeOverItsRutAsOnAFixedBed) {
  OperatingCondition at = uphill();
  at.longitudinal_incline = 0, at.pass = 2;
  expect_same_on_both(at);
}

TEST(SlowMovingPatch, OnASlopeSlipperyGrainsDoNotSlideOffTheirFloor) {
  BedRecipe recipe = tile_recipe();
  recipe.size = {0.3, 0.4, 0.06};
  recipe.soil.grain_grain.sliding_friction = 0.15, recipe.settling_friction = 0;  // of the floor too: 8.5 deg
  const SettledBed bed = settle_bed(recipe, with_threads(1));
  const Tire tire = small_wheel();
  const auto speed_after = [&](double incline, bool patch) {
    OperatingCondition at = uphill();
    at.longitudinal_incline = incline;
    Rig rig = patch_rig();
    rig.patch = patch;
    const WheelOnBed on{bed, tire, recipe.soil.grain_tire, rig};
    const WorkOptions how = with_threads(1);
    const Checkpoints kept{};
    WheelInBin bin(on, at, [&] { return staged_run(on, how, kept, ""); });
    bin.tilt(), bin.open_patch();
    if (patch) bin.simulation().run(400);
    Vec3 sum;
    for (const GrainNow& grain : bin.simulation().grains()) sum += grain.velocity;
    return std::abs(sum.x) / static_cast<double>(bin.simulation().state().grains.count());
  };
  // The side walls carry another 1 deg or so. Sliding for the last 0.03 s of the tilt alone ends at about
  // g (sin 14 - 0.17 cos 14) 0.03 s = 0.02 m/s.
  EXPECT_GT(speed_after(14 * degree, false), 0.01) << "a tile whose floor is smooth";
  EXPECT_LT(speed_after(14 * degree, true), 0.001);
  EXPECT_LT(speed_after(-14 * degree, true), 0.001);
}

TEST(SlowMovingPatch, GoesOnUntilThePullIsKnown) {
  OperatingCondition at = uphill();
  Rig rig = patch_rig();
  rig.until_error = 0.02;
  const WheelRun run = patch_run(rig, at, with_threads(1));
  EXPECT_TRUE(run.steady);
  EXPECT_LE(run.result.drawbar_pull.std_error, 0.02 * at.load);
  EXPECT_GT(run.samples.back().travel, shortest_way_on_patch * small_wheel().radius);
  EXPECT_LT(run.samples.back().travel, longest_way_on_patch * small_wheel().radius);
}

DemSettings patch_settings() {
  DemSettings settings;
  settings.size = tile_recipe().size, settings.rig = patch_rig(), settings.how = with_threads(1);
  return settings;
}

Scenario small_scenario() {
  Scenario scenario;
  scenario.tire = small_wheel(), scenario.soil.granular = test::soft_soil();
  return scenario;
}

void expect_refused(const char* why, const auto& work) {
  EXPECT_THAT(soilbin::test::refusal([&] { work(); }), HasSubstr(why));
}

TEST(MovingPatch, RefusesWhatItDoesNotHave) {
  const Scenario scenario = small_scenario();
  DemSettings lammps = patch_settings();
  lammps.lammps.emplace();
  expect_refused("soilbin's own engine alone", [&] { DemModel(lammps).check(scenario); });
  DemSettings brief = patch_settings();
  brief.size.length = 0.1;
  expect_refused("too short for grains", [&] { DemModel(brief).check(scenario); });
  DemSettings near = patch_settings();
  near.rig.ahead = 0.02;
  expect_refused("--ahead", [&] { DemModel(near).check(scenario); });
  expect_refused("its wheel may turn back", [&] { DemModel(patch_settings()).drive(scenario, Drive{}); });
  expect_refused("repeats itself along x", [&] {
    const SettledBed fixed = settle_bed(test::small_recipe({0.1, 0.06, 0.05}), with_threads(1));
    tile_of(fixed.setup, fixed.state);
  });
}

TEST(Tile, IsKeptAndFoundAgainApartFromTheBedWithWalls) {
  const Folder folder;
  BedRecipe recipe = tile_recipe();
  recipe.size = {0.15, 0.06, 0.05};
  BedRecipe walled = recipe;
  walled.periodic = false;
  EXPECT_NE(content_key(walled), content_key(recipe));
  BedStore(folder / "").bed(recipe, with_threads(1));
  std::string told;
  WorkOptions how = with_threads(1);
  how.tell = [&](const std::string& words) { told += words; };
  const auto found = BedStore(folder / "").bed(recipe, how);
  EXPECT_EQ(told, "");
  EXPECT_EQ(test::bits(found->state), test::bits(settle_bed(recipe, with_threads(1)).state));
}

}  // namespace
}  // namespace soilbin::dem
