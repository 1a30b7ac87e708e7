// Proves that a redesign of the grain engine keeps every bit: prints a hash of the state for each scene below. Run it
// before and after, and compare the lines; same_answers.py does the same for the command's answers.
#include <fmt/core.h>

#include "dem/archive/restart.hpp"
#include "dem/element_tests/angle_of_repose.hpp"
#include "dem/element_tests/bevameter_tests.hpp"
#include "dem/element_tests/direct_shear.hpp"
#include "dem/element_tests/tilting_board.hpp"
#include "dem/element_tests/triaxial.hpp"
#include "tests/dem/archive_scene.hpp"
#include "tests/dem/small_bed.hpp"
#include "tests/dem/worlds.hpp"

namespace soilbin::dem {
namespace {

void print_bits(const std::string& name, const Simulation& simulation) {
  const EnergyBalance energy = simulation.energy();
  std::uint64_t hash = test::bits(simulation.state());
  test::mix(hash, &energy, sizeof(energy));
  for (const GrainNow& grain : simulation.grains()) test::mix(hash, &grain, sizeof(grain));
  for (const Contact& contact : simulation.contacts()) test::mix(hash, &contact.force, sizeof(contact.force));
  fmt::print("{} {:016x} asleep {:.4g}\n", name, hash, simulation.share_asleep());
}

/// Planes, a wheel of triangles on a servo, a falling block, a periodic side, the ledger.
void wheel_on_grains(int threads) {
  Simulation simulation = test::scene(220, threads);
  simulation.run(3000);
  print_bits(fmt::format("wheel, {} threads", threads), simulation);
  const test::Folder folder;
  write_restart(folder / "run.h5", simulation.setup(), simulation.state());
  Restart restart = read_restart(folder / "run.h5");
  Simulation resumed(std::move(restart.setup), std::move(restart.state));
  resumed.remove_grains([](const GrainNow& grain) { return grain.position.x > 0.5; });
  resumed.hold_grains([](const GrainNow& grain) { return grain.position.z < 0.02; });
  resumed.set_interaction(0, 1, {.sliding_friction = 0.1});
  resumed.run(500);
  Numerics numerics = resumed.setup().numerics;
  numerics.dt *= 0.8, numerics.ledger = false;
  resumed.set_numerics(numerics);
  resumed.run(500);
  print_bits(fmt::format("wheel resumed and changed, {} threads", threads), resumed);
}

void every_law(int threads, bool ledger) {
  for (const ContactLaws& laws : test::all_laws()) {
    Setup setup = test::soft_stone(laws);
    setup.numerics.threads = threads;
    setup.numerics.ledger = ledger;
    Simulation simulation(setup);
    simulation.set_gravity({0, 0, -9.81});
    simulation.add_body(test::box_of_planes({-0.02, -0.02, -0.02}, {0.12, 0.12, 0.12}));
    test::add(simulation, test::cloud(100, 5, 0.5));
    simulation.run(1000);
    print_bits(fmt::format("{}, ledger {}, {} threads", test::name_of(laws), ledger, threads), simulation);
  }
}

/// A long channel that falls asleep, and a plough that wakes a part of it.
void sleeping_channel(int threads, bool ledger) {
  static const SettledBed bed = settle_bed(test::small_recipe({0.8, 0.05, 0.05}), test::with_threads(1));
  Setup setup = bed.setup;
  setup.numerics.threads = threads, setup.numerics.ledger = ledger;
  setup.numerics.sleep = {0.01, 0.01};
  Simulation simulation(setup, bed.state);
  simulation.run(600);
  print_bits(fmt::format("asleep, ledger {}, {} threads", ledger, threads), simulation);
  simulation.remove_grains(
      [](const GrainNow& grain) { return std::abs(grain.position.x - 0.2) < 0.025 && grain.position.z > 0.025; });
  Body plough = test::mesh_body(box({0.02, 0.04, 0.05}));
  plough.position = {0.2, 0.03, 0.06};
  plough.velocity = {0.1, 0, 0};
  simulation.add_body(plough);
  simulation.run(2000);
  print_bits(fmt::format("ploughed, ledger {}, {} threads", ledger, threads), simulation);
}

template <class Sample>
void print_curve(const char* name, const std::vector<Sample>& curve) {
  std::uint64_t hash = 0;
  test::mix(hash, curve.data(), curve.size() * sizeof(Sample));
  fmt::print("{} {:016x}\n", name, hash);
}

/// Each element test, as small and as fast as it can be.
void element_tests() {
  const GranularSoil soil = test::soft_soil();
  const WorkOptions how = test::with_threads(1);
  DirectShearSettings box;
  box.length = 6, box.width = 4, box.height = 5, box.travel = 0.5, box.inertial = 1e-2, box.samples = 20;
  box.stresses = {5e3, 10e3}, box.ledger = true;
  const DirectShearResult shear = direct_shear(soil, box, how);
  for (const DirectShearRun& run : shear.runs) print_curve("direct shear", run.curve);
  fmt::print("phi {}, energy {}\n", shear.peak.friction_angle.value, shear.runs.front().energy_error);
  TriaxialSettings cube;
  cube.side = 5, cube.height = 6, cube.strain = 0.05, cube.inertial = 1e-2, cube.samples = 20;
  cube.stresses = {10e3, 20e3};
  const TriaxialResult pressed = triaxial(soil, cube, how);
  for (const TriaxialRun& run : pressed.runs) print_curve("triaxial", run.curve);
  fmt::print("phi {}\n", pressed.residual.friction_angle.value);
  TiltingBoardSettings board;
  board.across = 5, board.rate = 1;
  print_curve("tilting board", tilting_board(soil, board, how).curve);
  AngleOfReposeSettings heap;
  heap.radius = 3, heap.height = 4, heap.lift = 0.5, heap.sectors = 3;
  print_curve("angle of repose", angle_of_repose(soil, heap, how).profile);
  PlateSettings plate;
  plate.diameters = {5}, plate.bed.width = 1.6, plate.bed.depth = 0.6, plate.speed = 0.5, plate.sinkage = 0.5;
  print_curve("plate", plate_sinkage(soil, plate, how).front().curve);
  AnnulusSettings ring;
  ring.inner = 1, ring.outer = 6, ring.travel = 0.5, ring.speed = 0.5, ring.samples = 20;
  ring.bed.width = 1.4, ring.bed.depth = 0.3, ring.stresses = {5e3};
  print_curve("ring", annular_shear(soil, ring, how).front().curve);
}

}  // namespace
}  // namespace soilbin::dem

int main() {
  soilbin::dem::element_tests();
  for (const int threads : {1, 2}) {
    soilbin::dem::wheel_on_grains(threads);
    for (const bool ledger : {false, true})
      soilbin::dem::every_law(threads, ledger), soilbin::dem::sleeping_channel(threads, ledger);
  }
}
