// End states that MercuryDPM keeps for its own tests: Drivers/Papers/OSBenchmark, OSHertzSelfTest and
// OSMindlinSelfTest.

#include "dem/verification/cases.hpp"

namespace soilbin::dem {
namespace {

constexpr double dt = 5e-7, sphere_radius = 0.001;

/// A sphere of the first material above a wall of the second; M1 and steel of the benchmark.
VerificationSetup sphere_on(const Material& sphere, const Material& wall, double height, double speed) {
  VerificationSetup setup;
  Interaction contact;
  contact.restitution = 0.4;
  contact.sliding_friction = 0.2;
  setup.materials.add(sphere, contact);
  setup.materials.add(wall, contact);
  setup.planes.push_back({{}, {0, 0, 1}, 1});
  setup.grains.push_back({{0, 0, height}, {0, 0, speed}, {}, sphere_radius, 0});
  setup.dt = dt;
  return setup;
}

const Material m1{"M1", 2500, 1e9, 0.2}, steel{"steel", 7200, 210e9, 0.2};

void impact_on_steel(std::vector<VerificationRow>& rows, const StartEngine& start) {
  // The sphere touches after 20 steps to the last bit, so rounding decides whether step 20 counts: 3e-6 in the speed.
  auto setup = sphere_on(m1, steel, 0.00101, -1);
  auto engine = start(setup);
  engine->step(121);
  const char* hertz = "MercuryDPM OSHertzSelfTest";
  rows.push_back({"impact on steel, 60.5 us: speed", 0.40107538, engine->velocity(0).z, 5e-6, "m/s", hertz});
  rows.push_back({"impact on steel, 60.5 us: height", 1.00724022, engine->position(0).z * 1e3, 2e-7, "mm", hertz});
  for (const int finer : {10, 100}) {
    setup.dt = dt / finer;
    engine = start(setup);
    engine->step(121 * finer);
    rows.push_back({"impact on steel, step of " + std::string(finer == 10 ? "50" : "5") + " ns: speed", 0.4,
                    engine->velocity(0).z, 4e-3 / finer, "m/s", "restitution"});
  }
}

void starts_to_slide(std::vector<VerificationRow>& rows, const StartEngine& start) {
  // MercuryDPM's shear stiffness is 2/3 of ours (Di Maio and Di Renzo 2005), which moves the last two digits.
  auto setup = sphere_on(steel, m1, sphere_radius, 0);
  setup.gravity = {5, 0, -5};
  setup.laws.tangential_damping = 0;
  const auto engine = start(setup);
  engine->step(10001);
  const char* mindlin = "MercuryDPM OSMindlinSelfTest";
  rows.push_back({"steel starts to slide, 5.0005 ms: speed", 0.0200031, engine->velocity(0).x, 1e-6, "m/s", mindlin});
  rows.push_back({"steel starts to slide, 5.0005 ms: spin", 12.49832, engine->spin(0).y, 2e-3, "rad/s", mindlin});
}

}  // namespace

std::vector<VerificationCase> mercury_cases() {
  return {{{"impact on steel"}, impact_on_steel}, {{"steel starts to slide"}, starts_to_slide}};
}

}  // namespace soilbin::dem
