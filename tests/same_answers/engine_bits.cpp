// Proves that a redesign of the grain engine keeps every bit: prints a hash of the state for each scene below. Run it
// before and after, and compare the lines; same_answers.py does the same for the command's answers.
#include <fmt/core.h>

#include "dem/archive/restart.hpp"
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

}  // namespace
}  // namespace soilbin::dem

int main() {
  for (const int threads : {1, 2}) {
    soilbin::dem::wheel_on_grains(threads);
    for (const bool ledger : {false, true})
      soilbin::dem::every_law(threads, ledger), soilbin::dem::sleeping_channel(threads, ledger);
  }
}
