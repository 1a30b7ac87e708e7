// A few grains in LAMMPS and in the engine: the same motion, step by step.
#include <gtest/gtest.h>

#include <map>
#include <memory>

#include "dem/engine/simulation.hpp"
#include "dem/surface/shapes.hpp"
#include "dem/worker_lammps/lammps_simulation.hpp"
#include "scenario/errors.hpp"
#include "scenario/tire.hpp"
#include "tests/dem/worlds.hpp"

namespace soilbin::dem {
namespace {

constexpr double grain_radius = 0.01;

Setup setup_of(const Interaction& interaction) {
  Setup setup;
  setup.materials.add({"grains", 2500, 5e6, 0.2}, interaction);
  setup.materials.add({"wheel", 1100, 1e9, 0.3}, interaction);
  setup.domain = {{-1, -1, -1}, {1, 1, 1}, {false, false, false}};
  setup.numerics.dt = 1e-5, setup.numerics.threads = 1;
  return setup;
}

Interaction rough() {
  Interaction out;
  out.restitution = 0.5, out.sliding_friction = 0.5, out.rolling_friction = 0.1, out.rolling_damping = 0.3;
  return out;
}

struct GrainState {
  Vec3 position, velocity, spin;
};

/// Of all processes, by id.
std::map<GrainId, GrainState> grains_of(const LammpsSimulation& simulation) {
  const auto count = static_cast<std::size_t>(simulation.grain_count());
  std::vector<double> numbers(9 * count);
  const Grains& own = own_grains(simulation);
  for (std::size_t k = 0; k < own.count(); ++k) {
    const Vec3 parts[] = {own.motion[k].position, own.motion[k].velocity, own.spin[k].rate};
    std::copy_n(&parts[0].x, 9, &numbers[9 * own.id[k]]);
  }
  join_sums(simulation, numbers);
  std::map<GrainId, GrainState> out;
  for (std::size_t id = 0; id < count; ++id) {
    const double* n = &numbers[9 * id];
    out[static_cast<GrainId>(id)] = {{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, {n[6], n[7], n[8]}};
  }
  return out;
}

/// Largest differences of the motions of any grain at the present time.
struct Apart {
  double position = 0, velocity = 0, spin = 0;
};

Apart apart(const LammpsSimulation& lammps, const Simulation& engine) {
  Apart out;
  for (const auto& [id, there] : grains_of(lammps)) {
    const GrainNow here = engine.grain(id);
    out.position = std::max(out.position, length(there.position - here.position));
    out.velocity = std::max(out.velocity, length(there.velocity - here.velocity));
    out.spin = std::max(out.spin, length(there.spin - here.spin));
  }
  return out;
}

/// Two grains that meet at the origin; the first comes from below with this velocity and spin.
Simulation two_grains(const Setup& setup, const Vec3& velocity, const Vec3& spin = {}) {
  Simulation simulation(setup);
  simulation.add_grain({0, 0, -1.001 * grain_radius}, grain_radius, 0, velocity, spin);
  simulation.add_grain({0, 0, 1.001 * grain_radius}, grain_radius, 0, -velocity, {});
  return simulation;
}

TEST(LammpsGrains, MeetHeadOnAsInTheEngine) {
  for (const double restitution : {0.2, 0.5, 0.9}) {
    Interaction interaction = rough();
    interaction.restitution = restitution;
    Simulation engine = two_grains(setup_of(interaction), {0, 0, 0.5});
    LammpsSimulation lammps(MPI_COMM_WORLD, engine.setup(), engine.state());
    double farthest = 0, fastest = 0;
    for (int k = 0; k < 60; ++k) {
      engine.run(20), lammps.run(20);
      farthest = std::max(farthest, apart(lammps, engine).position);
      fastest = std::max(fastest, apart(lammps, engine).velocity);
    }
    EXPECT_LT(engine.grain(0).velocity.z, -0.5 * 0.5 * restitution);  // they have parted
    EXPECT_LT(farthest, 1e-9 * grain_radius) << restitution;
    EXPECT_LT(fastest, 1e-9 * 0.5) << restitution;
  }
}

/// Sticking, sliding, rolling and twisting, by every law that has no adhesion beyond the contact.
TEST(LammpsGrains, MeetObliquelyAsInTheEngineByEachLaw) {
  for (const ContactLaws& laws : test::all_laws()) {
    if (laws.cohesion == CohesionLaw::jkr) continue;
    dem::Setup setup = test::soft_stone(laws);
    setup.domain = {{-1, -1, -1}, {1, 1, 1}, {false, false, false}};
    Simulation engine = two_grains(setup, {0.1, 0.02, 0.3}, {3, -20, 10});
    LammpsSimulation lammps(MPI_COMM_WORLD, engine.setup(), engine.state());
    for (int k = 0; k < 10; ++k) {
      engine.run(60), lammps.run(60);
      const Apart now = apart(lammps, engine);
      ASSERT_LT(now.velocity, 1e-9 * 0.3) << test::name_of(laws) << ", " << k;
      ASSERT_LT(now.spin, 1e-9 * 20) << test::name_of(laws) << ", " << k;
    }
    EXPECT_GT(length(engine.grain(0).spin - Vec3{3, -20, 10}), 0.2) << test::name_of(laws);  // they have met
  }
}

TEST(LammpsGrains, PullOnEachOtherByLinearCohesionAsInTheEngine) {
  Interaction sticky = rough();
  sticky.cohesion = 1e5;  // a pull of a tenth of Hertz's push at 1 mm
  dem::Setup setup = setup_of(sticky);
  setup.laws.cohesion = CohesionLaw::linear;
  Simulation engine = two_grains(setup, {0, 0, 0.5});
  LammpsSimulation lammps(MPI_COMM_WORLD, engine.setup(), engine.state());
  engine.run(1000), lammps.run(1000);
  EXPECT_LT(engine.grain(0).velocity.z, -0.05);  // they have parted
  EXPECT_LT(apart(lammps, engine).velocity, 1e-9 * 0.5);
}

/// A grain that the wheel rolls over on a floor, with friction, rolling resistance and cohesion: search, memory and law
/// are one code.
TEST(LammpsGrains, RollOnMeshAndFloorAsInTheEngine) {
  Interaction sticky = rough();
  sticky.cohesion = 1e4;
  dem::Setup setup = setup_of(sticky);
  setup.laws.cohesion = CohesionLaw::linear;
  Simulation engine(setup);
  engine.set_gravity({0, 0, -9.81});
  Body floor;
  floor.name = "floor";
  floor.surfaces.push_back({Plane{{0, 0, 0}, {0, 0, 1}}, 0});
  engine.add_body(floor);
  for (int k = 0; k < 5; ++k) engine.add_grain({0.03 * k - 0.05, 0.001 * k, grain_radius}, grain_radius, 0, {}, {});
  LammpsSimulation lammps(MPI_COMM_WORLD, engine.setup(), engine.state());
  Tire tire;
  tire.radius = 0.1, tire.width = 0.08, tire.lugs = {.height = 0.01, .count = 12, .thickness = 0.01};
  Body wheel;
  wheel.name = "wheel", wheel.mass = 2, wheel.free_translation = {false, false, true};
  wheel.surfaces.push_back({MeshSurface{std::make_shared<TriangleMesh>(tire_surface(tire)), nullptr}, 1});
  wheel.position = {-0.1, 0, 0.13}, wheel.velocity = {0.2, 0, 0}, wheel.spin = {0, 2.5, 0};
  wheel.applied_force = {0, 0, -5};
  const int index = engine.add_body(wheel);
  ASSERT_EQ(lammps.add_body(wheel), index);
  double pressed = 0;
  for (int k = 0; k < 150; ++k) {
    engine.run(100), lammps.run(k == 0 ? 99 : 100);  // LAMMPS has computed the forces of its first step before it moves
    const Body &here = engine.body(index), &there = lammps.body(index);
    pressed = std::max(pressed, length(here.force));
    ASSERT_LT(length(here.force - there.force), 1e-9 * std::max(pressed, 5.0)) << k;
    ASSERT_LT(length(here.torque - there.torque), 1e-9 * std::max(pressed, 5.0) * tire.radius) << k;
    ASSERT_LT(length(here.position - there.position), 1e-9 * grain_radius) << k;
  }
  EXPECT_GT(pressed, 10);
}

TEST(LammpsGrains, RefuseAdhesionBeyondContact) {
  dem::Setup setup = setup_of(rough());
  setup.laws.cohesion = CohesionLaw::jkr;
  Simulation engine = two_grains(setup, {});
  EXPECT_THROW(LammpsSimulation(MPI_COMM_WORLD, engine.setup(), engine.state()), InputError);
}

TEST(LammpsGrains, SayWhichOneLeavesTheBin) {
  dem::Setup setup = setup_of(rough());
  setup.domain = {{-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}, {false, false, false}};
  Simulation engine(setup);
  engine.add_grain({-0.05, 0, 0}, grain_radius, 0, {}, {});
  engine.add_grain({0.05, 0, 0}, grain_radius, 0, {1, 0, 0}, {});
  LammpsSimulation lammps(MPI_COMM_WORLD, engine.setup(), engine.state());
  try {
    lammps.run(10000);
    FAIL() << "it went on";
  } catch (const RunStopped& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with("grain 1 has left the bin at (0.1, 0, 0) m")) << error.what();
  }
}

}  // namespace
}  // namespace soilbin::dem
