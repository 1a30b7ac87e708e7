// The fast engine against the reference engine, which shares no code with it: random small systems, every law, walls,
// periodic boxes, several materials, every instruction set of this machine.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include "dem/bed/random.hpp"
#include "dem/engine/simulation.hpp"
#include "tests/dem/reference_engine.hpp"

namespace soilbin::dem {
namespace {

constexpr double radius = 0.01, side = 0.16;

/// A cloud of grains that bump into each other and into walls.
struct Cloud {
  Materials materials;
  ContactLaws laws;
  bool periodic = false;
  double dt = 1e-5;
  std::uint64_t seed = 1;
  int count = 150;
  int held = 0;  ///< the first so many
};

Materials sand_and_rubber(double cohesion) {
  Interaction c{.restitution = 0.6,
                .sliding_friction = 0.4,
                .rolling_friction = 0.2,
                .rolling_damping = 0.3,
                .rolling_stiffness = 500,
                .rolling_viscosity = 0.05,
                .cohesion = cohesion,
                .normal_stiffness = 2e4,
                .shear_stiffness = 8e3};
  Materials m;
  m.add({"sand", 2500, 5e6, 0.2}, c);
  c.restitution = 0.3;
  c.sliding_friction = 0.8;
  m.add({"rubber", 1200, 2e6, 0.45}, c);
  return m;
}

struct Both {
  Simulation fast;
  test::ReferenceEngine plain;
};

Both make(const Cloud& cloud, const std::string& instruction_set) {
  Setup setup{cloud.materials, cloud.laws, {}, {}};
  setup.domain = {{0, 0, 0}, {side, side, side}, {cloud.periodic, cloud.periodic, cloud.periodic}};
  setup.numerics.dt = cloud.dt;
  setup.numerics.deepest_overlap = 0.9;
  setup.numerics.instruction_set = instruction_set;
  setup.numerics.threads = 1;
  Both both{Simulation(setup), test::ReferenceEngine(cloud.materials, cloud.laws, cloud.dt)};
  both.fast.set_gravity({1, -2, -9});
  both.plain.gravity = {1, -2, -9};
  if (cloud.periodic) both.plain.box = {side, side, side};
  if (!cloud.periodic) {
    Body walls;
    const Vec3 normals[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
    for (const Vec3& n : normals) {
      const Vec3 point = dot(n, {1, 1, 1}) > 0 ? Vec3{} : Vec3{side, side, side};
      walls.surfaces.push_back({Plane{point, n}, 1});
      both.plain.add(test::ReferencePlane{point, n, {0.1, 0.2, 0.3}, 1});
    }
    walls.velocity = {0.1, 0.2, 0.3};
    both.fast.add_body(walls);
  }
  Random random(cloud.seed);
  const auto anywhere = [&](double low, double high) {
    const double x = random.uniform(low, high), y = random.uniform(low, high);
    return Vec3{x, y, random.uniform(low, high)};
  };
  std::vector<Vec3> places;
  while (static_cast<int>(places.size()) < cloud.count) {
    const Vec3 place = anywhere(radius, side - radius);
    bool free = true;
    // Some overlap from the start.
    for (const Vec3& other : places) free &= length(place - other) > 1.6 * radius;
    if (!free) continue;
    places.push_back(place);
    const double r = radius * random.uniform(0.7, 1);
    const bool held = static_cast<int>(places.size()) <= cloud.held;
    const Vec3 v = anywhere(-2, 2), w = anywhere(-50, 50);
    const int material = static_cast<int>(random.next() % cloud.materials.all.size());
    both.fast.add_grain(place, r, material, held ? Vec3{} : v, held ? Vec3{} : w);
    both.plain.add(test::ReferenceGrain{place, held ? Vec3{} : v, held ? Vec3{} : w, r, material, held});
    if (held) both.fast.hold_grains([](const GrainNow&) { return true; });
  }
  return both;
}

/// Largest relative difference of velocities and spins after some steps.
double difference_of_instructions(const Cloud& cloud, const std::string& instruction_set, long steps) {
  Both both = make(cloud, instruction_set);
  both.fast.run(steps);
  both.plain.step(steps);
  EXPECT_GT(both.plain.contacts().size(), 5u) << "nothing touches, so nothing is compared";
  double worst = 0;
  for (int k = 0; k < cloud.count; ++k) {
    const GrainNow now = both.fast.grain(static_cast<GrainId>(k));
    worst = std::max(worst, length(now.velocity - both.plain.velocity(k)) / 2);
    worst = std::max(worst, length(now.spin - both.plain.spin(k)) / 50);
  }
  return worst;
}

struct LawCase {
  const char* name;
  ContactLaws laws;
  double cohesion;
};

ContactLaws laws(NormalLaw normal, RollingLaw rolling, CohesionLaw cohesion, double tangential_damping = -1,
                 TwistingLaw twisting = TwistingLaw::none) {
  ContactLaws all;
  all.normal = normal;
  all.rolling = rolling;
  all.cohesion = cohesion;
  all.tangential_damping = tangential_damping;
  all.twisting = twisting;
  return all;
}

const LawCase law_cases[] = {
    {"hertz", laws(NormalLaw::hertz, RollingLaw::none, CohesionLaw::none), 0},
    {"hooke", laws(NormalLaw::hooke, RollingLaw::none, CohesionLaw::none), 0},
    {"lammps", laws(NormalLaw::hertz, RollingLaw::spring_slider, CohesionLaw::none, 1), 0},
    {"directional", laws(NormalLaw::hertz, RollingLaw::directional, CohesionLaw::none), 0},
    {"directional_with_twist", laws(NormalLaw::hertz, RollingLaw::directional_with_twist, CohesionLaw::none), 0},
    {"elastic_plastic", laws(NormalLaw::hertz, RollingLaw::elastic_plastic, CohesionLaw::none), 0},
    {"torsion_spring", laws(NormalLaw::hertz, RollingLaw::torsion_spring, CohesionLaw::none), 0},
    {"linear", laws(NormalLaw::hertz, RollingLaw::elastic_plastic, CohesionLaw::linear), 2e5},
    {"hooke_linear", laws(NormalLaw::hooke, RollingLaw::elastic_plastic, CohesionLaw::linear), 2e5},
    {"jkr", laws(NormalLaw::hertz, RollingLaw::elastic_plastic, CohesionLaw::jkr), 2.0},
    {"marshall", laws(NormalLaw::hertz, RollingLaw::elastic_plastic, CohesionLaw::none, -1, TwistingLaw::marshall), 0},
    {"hooke_marshall", laws(NormalLaw::hooke, RollingLaw::none, CohesionLaw::none, -1, TwistingLaw::marshall), 0},
    {"jkr_marshall", laws(NormalLaw::hertz, RollingLaw::none, CohesionLaw::jkr, -1, TwistingLaw::marshall), 2.0},
};

class Agreement : public testing::TestWithParam<LawCase> {};

TEST_P(Agreement, WallsAndTwoMaterials) {
  Cloud cloud{.materials = sand_and_rubber(GetParam().cohesion), .laws = GetParam().laws};
  for (const std::string_view set : instruction_sets())
    EXPECT_LT(difference_of_instructions(cloud, std::string(set), 300), 1e-9) << set;
}

TEST_P(Agreement, PeriodicWithOneMaterial) {
  Cloud cloud{.materials = sand_and_rubber(GetParam().cohesion), .laws = GetParam().laws, .periodic = true, .seed = 7};
  cloud.materials.all.resize(1);
  cloud.materials.interactions.resize(1);
  for (const std::string_view set : instruction_sets())
    EXPECT_LT(difference_of_instructions(cloud, std::string(set), 300), 1e-9) << set;
}

TEST_P(Agreement, SomeGrainsHeld) {
  Cloud cloud{.materials = sand_and_rubber(GetParam().cohesion), .laws = GetParam().laws, .seed = 11, .held = 40};
  for (const std::string_view set : instruction_sets())
    EXPECT_LT(difference_of_instructions(cloud, std::string(set), 300), 1e-9) << set;
}

INSTANTIATE_TEST_SUITE_P(Laws, Agreement, testing::ValuesIn(law_cases),
                         [](const auto& instance) { return std::string(instance.param.name); });

TEST(AgreementOverTime, ManySearchesChangeNothing) {
  Cloud cloud{.materials = sand_and_rubber(0), .laws = law_cases[5].laws, .seed = 3};
  EXPECT_LT(difference_of_instructions(cloud, "", 2000), 1e-6);  // differences of rounding grow with each bump
}

}  // namespace
}  // namespace soilbin::dem
