// A restart gives back every bit, and nothing but a whole one is taken.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <array>
#include <csignal>
#include <functional>
#include <limits>
#include <memory>
#include <random>

#include "dem/archive/hdf5.hpp"
#include "dem/archive/restart.hpp"
#include "dem/archive/sealed_file.hpp"
#include "scenario/checksum.hpp"
#include "scenario/errors.hpp"
#include "scenario/estimate.hpp"
#include "tests/dem/archive_scene.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin::dem {
namespace {

using test::Bits;
using test::Folder;
using test::read_bytes;
using test::scene;
using test::write_bytes;
using ::testing::HasSubstr;

/// What a file is refused with; empty where it is taken.
std::string file_refusal(const std::filesystem::path& path) {
  return soilbin::test::error_of([&] { read_restart(path); });
}

TEST(Restart, GivesBackEveryBit) {
  Simulation simulation = scene();
  simulation.run(1500);
  ASSERT_FALSE(simulation.contacts().empty());
  const Folder folder;
  write_restart(folder / "run.h5", simulation.setup(), simulation.state(), {{"phase", "settling"}, {"empty", ""}});
  const Restart back = read_restart(folder / "run.h5");
  EXPECT_EQ(Bits(back.state), Bits(simulation.state()));
  EXPECT_EQ(back.notes, (Notes{{"phase", "settling"}, {"empty", ""}}));
  // Shared meshes stay shared.
  const auto mesh_of = [&](int body) { return std::get<MeshSurface>(back.state.bodies[body].surfaces[0].shape).mesh; };
  EXPECT_EQ(mesh_of(1), mesh_of(2));
}

TEST(Restart, KeepsNotesOfAnyLengthAndAnyBytes) {
  const Simulation simulation = scene(20);
  const Folder folder;
  const Notes notes{{"short", "a b"},
                    {"long", std::string(1 << 20, 'x')},
                    {"zeros", std::string("a\0b\0", 4)},
                    {"zero", std::string(1, '\0')}};
  write_restart(folder / "run.h5", simulation.setup(), simulation.state(), notes);
  EXPECT_EQ(read_restart(folder / "run.h5").notes, notes);
}

TEST(Restart, GivesBackTheSetup) {
  const Simulation simulation = scene();
  const Folder folder;
  write_restart(folder / "run.h5", simulation.setup(), simulation.state());
  const dem::Setup& setup = simulation.setup();
  const dem::Setup back = read_restart(folder / "run.h5").setup;
  ASSERT_EQ(back.materials.all.size(), 2u);
  EXPECT_EQ(back.materials.all[1].name, "rubber \xc3\xa9");
  EXPECT_EQ(back.materials.all[1].young, 2e6);
  EXPECT_EQ(back.materials.between(0, 1).sliding_friction, setup.materials.between(0, 1).sliding_friction);
  EXPECT_EQ(back.materials.between(0, 0).rolling_stiffness, 500);
  EXPECT_EQ(back.laws.rolling, RollingLaw::spring_slider);
  EXPECT_EQ(back.laws.tangential_damping, setup.laws.tangential_damping);
  EXPECT_EQ(back.domain, setup.domain);
  EXPECT_EQ(back.numerics.dt, setup.numerics.dt);
  EXPECT_EQ(back.numerics.deepest_overlap, 0.5);
  EXPECT_TRUE(back.numerics.ledger);
}

TEST(Restart, TwiceAsManyStepsAreAsManyTwice) {
  const int steps = 1200;
  Simulation through = scene();
  const Folder folder;
  through.run(steps);
  const auto searched = through.state().searched_at;
  through.run(steps);
  ASSERT_FALSE(searched == through.state().searched_at) << "there should be a search in the second half";
  for (const int threads : {1, 2}) {
    Simulation first = scene(220, threads);
    first.run(steps);
    write_restart(folder / "run.h5", first.setup(), first.state());
    Restart restart = read_restart(folder / "run.h5");
    Simulation second(std::move(restart.setup), std::move(restart.state));
    second.run(steps);
    EXPECT_EQ(Bits(second.state()), Bits(through.state())) << threads << " threads";
  }
}

TEST(Restart, KeepsGrainsThatHaveNotMovedYet) {
  Simulation simulation = scene();
  const Folder folder;
  write_restart(folder / "run.h5", simulation.setup(), simulation.state());
  Restart restart = read_restart(folder / "run.h5");
  EXPECT_EQ(Bits(restart.state), Bits(simulation.state()));
  Simulation again(std::move(restart.setup), std::move(restart.state));
  again.run(50);
  simulation.run(50);
  EXPECT_EQ(Bits(again.state()), Bits(simulation.state()));
}

/// Both go on the same way from what was changed between steps.
void expect_same_after(const std::function<void(Simulation&)>& change) {
  Simulation simulation = scene(60);
  simulation.run(100);
  change(simulation);
  const Folder folder;
  write_restart(folder / "run.h5", simulation.setup(), simulation.state());
  Restart restart = read_restart(folder / "run.h5");
  Simulation again(std::move(restart.setup), std::move(restart.state));
  again.run(50);
  simulation.run(50);
  EXPECT_EQ(Bits(again.state()), Bits(simulation.state()));
}

TEST(Restart, KeepsWhatWasChangedBetweenSteps) {
  expect_same_after([](Simulation& s) { s.add_grain({0.2, 0.1, 0.8}, 0.015, 0, {0, 0, -3}); });
  expect_same_after(
      [](Simulation& s) { s.remove_grains([](const GrainNow& grain) { return grain.position.x < 0.1; }); });
  expect_same_after([](Simulation& s) {
    Interaction smooth = s.setup().materials.between(0, 0);
    smooth.sliding_friction = 0.1;
    s.set_interaction(0, 0, smooth);
  });
  expect_same_after([](Simulation& s) {
    Body lid;
    lid.surfaces = {{Plane{{0, 0, 0}, {0, 0, -1}}, 1}};
    lid.position = {0, 0, 1};
    s.add_body(lid);
  });
}

TEST(Restart, KeepsVerticesThatWouldBeWelded) {
  Simulation simulation = scene(12);
  MeshOptions exact;
  exact.weld = 0;
  exact.name = "sliver";
  const auto mesh =
      std::make_shared<const TriangleMesh>(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 1e-7, 1}},
                                           std::vector<TriangleMesh::Corners>{{0, 1, 2}, {2, 3, 4}}, exact);
  Body body;
  body.surfaces = {{MeshSurface{mesh, nullptr}, 0}};
  body.position = {0, 0, 5};
  simulation.add_body(body);
  const Folder folder;
  write_restart(folder / "run.h5", simulation.setup(), simulation.state());
  EXPECT_EQ(Bits(read_restart(folder / "run.h5").state), Bits(simulation.state()));
}

TEST(Restart, KeepsNumbersThatAreNone) {
  // A run that stopped because of them must be looked at.
  Simulation simulation = scene(20);
  simulation.run(10);
  State state = simulation.state();
  state.grains.motion[3].velocity = {not_a_number, -0.0, -std::numeric_limits<double>::infinity()};
  state.grains.motion[4].position.x = 5e-324;
  const Folder folder;
  write_restart(folder / "run.h5", simulation.setup(), state);
  EXPECT_EQ(Bits(read_restart(folder / "run.h5").state), Bits(state));
}

TEST(Restart, HoldsAnEmptySimulation) {
  dem::Setup setup;
  setup.materials.add({"sand", 2500, 5e6, 0.2});
  Simulation simulation(setup);
  const Folder folder;
  write_restart(folder / "run.h5", simulation.setup(), simulation.state());
  EXPECT_EQ(read_restart(folder / "run.h5").state.grains.count(), 0u);
}

TEST(Restart, IsTheSameFileForTheSameState) {
  Simulation simulation = scene(60);
  simulation.run(100);
  const Folder folder;
  write_restart(folder / "a.h5", simulation.setup(), simulation.state());
  write_restart(folder / "b.h5", simulation.setup(), simulation.state());
  EXPECT_TRUE(read_bytes(folder / "a.h5") == read_bytes(folder / "b.h5"));
  // And once more through a reading.
  const Restart restart = read_restart(folder / "a.h5");
  write_restart(folder / "c.h5", restart.setup, restart.state);
  EXPECT_TRUE(read_bytes(folder / "a.h5") == read_bytes(folder / "c.h5"));
}

TEST(Restart, IsLaidOutAsH5md) {
  Simulation simulation = scene(60);
  simulation.run(100);
  const Folder folder;
  write_restart(folder / "run.h5", simulation.setup(), simulation.state());
  const std::string bytes = read_bytes(folder / "run.h5");
  const hdf5::InputFile file(std::string_view(bytes).substr(512), "run.h5");
  std::array<std::int32_t, 2> version{};
  file.root().open("h5md").get_numbers("version", hdf5::Number::i32, {2}, version.data());
  EXPECT_EQ(version, (std::array<std::int32_t, 2>{1, 1}));
  const hdf5::Group grains = file.root().open("particles").open("grains");
  std::int32_t dimension = 0;
  grains.open("box").get_numbers("dimension", hdf5::Number::i32, {}, &dimension);
  EXPECT_EQ(dimension, 3);
  const std::size_t count = simulation.state().grains.count();
  EXPECT_EQ(grains.open("position").shape("value"), (hdf5::Shape{1, count, 3}));
  EXPECT_EQ(grains.open("species").shape("value"), (hdf5::Shape{1, count}));
  double at = 0, velocity_at = 0;
  grains.open("position").read("time", hdf5::Number::f64, {1}, &at);
  grains.open("velocity").read("time", hdf5::Number::f64, {1}, &velocity_at);
  EXPECT_EQ(at, simulation.time());
  EXPECT_EQ(velocity_at, simulation.time() - simulation.setup().numerics.dt / 2);
  std::vector<Vec3> positions(count);
  grains.open("position").read("value", hdf5::Number::f64, {1, count, 3}, positions.data());
  EXPECT_EQ(positions[5], simulation.state().grains.motion[5].position);
}

TEST(Seal, IsFnv1a) {
  EXPECT_EQ(fnv1a(""), 0xcbf29ce484222325u);  // RFC 9923
  EXPECT_EQ(fnv1a("a"), 0xaf63dc4c8601ec8cu);
  EXPECT_EQ(fnv1a("foobar"), 0x85944171f73967e8u);
}

TEST(Seal, KeepsTheOneBefore) {
  Simulation simulation = scene(20);
  const Folder folder;
  const auto path = folder / "run.h5";
  EXPECT_FALSE(has_restart(path));
  for (int k = 0; k < 3; ++k) {
    simulation.run(10);
    write_restart(path, simulation.setup(), simulation.state());
  }
  EXPECT_EQ(read_restart(path).state.step, 30);
  EXPECT_EQ(read_restart(previous_of(path)).state.step, 20);
  EXPECT_EQ(read_last_good(path).warning, "");
  // Nothing else is left in the folder.
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 2);
}

TEST(Seal, FallsBackAndSaysSo) {
  Simulation simulation = scene(20);
  const Folder folder;
  const auto path = folder / "run.h5";
  for (int k = 0; k < 2; ++k) {
    simulation.run(10);
    write_restart(path, simulation.setup(), simulation.state());
  }
  const std::string good = read_bytes(path);
  write_bytes(path, good.substr(0, good.size() / 2));
  const LastGood found = read_last_good(path);
  EXPECT_EQ(found.restart.state.step, 10);
  EXPECT_EQ(found.from, previous_of(path));
  EXPECT_THAT(found.warning, HasSubstr("cut short"));
  EXPECT_THAT(found.warning, HasSubstr("run.h5.previous instead"));
  // A damaged one never takes the place of a good one.
  simulation.run(10);
  write_restart(path, simulation.setup(), simulation.state());
  EXPECT_EQ(read_restart(previous_of(path)).state.step, 10);
  EXPECT_EQ(read_restart(path).state.step, 30);
  // Neither is good.
  write_bytes(path, "x");
  write_bytes(previous_of(path), "");
  EXPECT_TRUE(has_restart(path));
  EXPECT_THROW(read_last_good(path), InputError);
}

TEST(Seal, RefusesWhatIsNone) {
  const Folder folder;
  const auto path = folder / "run.h5";
  EXPECT_THAT(file_refusal(path), HasSubstr("No such file"));
  EXPECT_THAT(file_refusal(folder.path()), HasSubstr("is a folder"));
  write_bytes(path, "");
  EXPECT_THAT(file_refusal(path), HasSubstr("is no soilbin restart"));
  write_bytes(path, "\x89HDF\r\n\x1a\n of another program");
  EXPECT_THAT(file_refusal(path), HasSubstr("give a restart that soilbin wrote"));
  write_sealed(path, {"frame", 1}, "x", Keep::nothing);
  EXPECT_THAT(file_refusal(path), HasSubstr("is a soilbin frame, not a restart"));
  write_sealed(path, {"restart", 3}, "x", Keep::nothing);
  EXPECT_THAT(file_refusal(path), HasSubstr("is of version 3, this soilbin reads version 2"));
  // A seal that fits, and no HDF5 under it; HDF5 of another program.
  write_sealed(path, {"restart", 2}, "no HDF5", Keep::nothing);
  EXPECT_THAT(file_refusal(path), HasSubstr("run.h5: can't be read"));
  hdf5::OutputFile other("other");
  other.root().create("particles");
  write_sealed(path, {"restart", 2}, other.finish(), Keep::nothing);
  EXPECT_THAT(file_refusal(path), HasSubstr("/soilbin: can't be read"));
}

TEST(Seal, RefusesEveryTruncation) {
  Simulation simulation = scene(12);
  simulation.run(200);
  const Folder folder;
  write_restart(folder / "good.h5", simulation.setup(), simulation.state());
  const std::string good = read_bytes(folder / "good.h5");
  std::mt19937 random(1);
  for (std::size_t length = 0; length < good.size(); length += 1 + random() % (length < 1000 ? 7 : 900)) {
    write_bytes(folder / "cut.h5", good.substr(0, length));
    ASSERT_NE(file_refusal(folder / "cut.h5"), "") << length << " bytes of " << good.size();
  }
  write_bytes(folder / "cut.h5", good + '\0');
  EXPECT_NE(file_refusal(folder / "cut.h5"), "");
}

TEST(Seal, RefusesEveryFlippedByte) {
  Simulation simulation = scene(12);
  simulation.run(200);
  const Folder folder;
  write_restart(folder / "good.h5", simulation.setup(), simulation.state());
  const std::string good = read_bytes(folder / "good.h5");
  ASSERT_EQ(file_refusal(folder / "good.h5"), "");
  std::mt19937 random(2);
  const auto try_flips = [&](std::size_t at, std::size_t count) {
    std::string bad = good;
    for (std::size_t k = 0; k < count; ++k)
      bad[(at + k * random()) % bad.size()] ^= static_cast<char>(1 + random() % 255);
    if (bad == good) return;
    write_bytes(folder / "bad.h5", bad);
    ASSERT_NE(file_refusal(folder / "bad.h5"), "") << count << " bytes from " << at;
  };
  for (std::size_t at = 0; at < 512; at += at < 130 ? 1 : 5) try_flips(at, 1);  // the seal
  for (int k = 0; k < 400; ++k) try_flips(random() % good.size(), 1 + random() % 3);
}

TEST(Seal, LeavesTheGoodOneWhereTheDiskIsFull) {
  Simulation simulation = scene(20);
  const Folder folder;
  const auto path = folder / "run.h5";
  simulation.run(10);
  write_restart(path, simulation.setup(), simulation.state());
  simulation.run(10);
  const std::string before = read_bytes(path);
  // A limit on the size of files stands for a full disk.
  struct rlimit old {};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &old), 0);
  struct rlimit low = old;
  low.rlim_cur = 2000;
  std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &low), 0);
  const std::string message =
      soilbin::test::error_of<std::runtime_error>([&] { write_restart(path, simulation.setup(), simulation.state()); });
  setrlimit(RLIMIT_FSIZE, &old);
  EXPECT_THAT(message, HasSubstr("run.h5: can't write: File too large"));
  EXPECT_TRUE(read_bytes(path) == before);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

}  // namespace
}  // namespace soilbin::dem
