// Bodies: driven, free, steered by a force; what grains do to them.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/dem/worlds.hpp"

namespace soilbin::dem {
namespace {

using test::box_of_planes;
using test::mesh_body;
using test::soft_stone;

using std::numbers::pi;

constexpr double g = 9.81;

Body cuboid(double mass, const Vec3& size) {
  Body body = mesh_body(box(size));
  body.mass = mass;
  body.inertia =
      mass / 12 *
      Vec3{size.y * size.y + size.z * size.z, size.z * size.z + size.x * size.x, size.x * size.x + size.y * size.y};
  return body;
}

Simulation empty(double dt) {
  auto setup = soft_stone();
  setup.numerics.dt = dt;
  return Simulation(setup);
}

Vec3 angular_momentum(const Body& body) {
  const Vec3 w = body.rotation.inverse()(body.spin);
  return body.rotation(Vec3{body.inertia.x * w.x, body.inertia.y * w.y, body.inertia.z * w.z});
}

TEST(DrivenBody, KeepsItsVelocityAndSpin) {
  Simulation simulation = empty(1e-3);
  Body body = cuboid(1, {1, 1, 1});
  body.position = {1, 2, 3};
  body.velocity = {0.1, -0.2, 0.3};
  body.spin = {0, 0, 2};
  body.applied_force = {100, 100, 100};  // what drives it takes that up
  body.applied_torque = {100, 100, 100};
  simulation.add_body(body);
  simulation.run(1000);
  const Body& now = simulation.body(0);
  EXPECT_LT(length(now.position - Vec3{1.1, 1.8, 3.3}), 1e-12);
  const Vec3 turned = now.rotation({1, 0, 0});
  EXPECT_LT(length(turned - Vec3{std::cos(2.0), std::sin(2.0), 0}), 1e-12);
  EXPECT_EQ(now.velocity, body.velocity);
  EXPECT_EQ(now.spin, body.spin);
}

constexpr double moved_overlap = 1e-4;  // [m]

/// What a grain of 10 mm presses with on a body that overlaps it: (4/3) E* sqrt(R*) delta^1.5, E* = E/(2 (1 - nu^2)).
double pressing_force() {
  return 4.0 / 3 * 5e6 / (2 * (1 - 0.25 * 0.25)) * std::sqrt(0.01) * std::pow(moved_overlap, 1.5);
}

/// A grain at the origin and a body far below it, after some steps, so that pairs have been searched for.
Simulation grain_above(Body body, bool ledger = false) {
  Setup setup = soft_stone();
  setup.numerics.ledger = ledger;
  Simulation simulation(setup);
  simulation.add_grain({0, 0, 0}, 0.01, 0);
  body.position = {0, 0, -1};
  simulation.add_body(body);
  simulation.run(10);
  return simulation;
}

Body floor_plane() {
  Body floor;
  floor.surfaces.push_back({Plane{}, 0});
  return floor;
}

TEST(MovedBody, PressesOnTheGrainsAtItsNewPlaceAtOnce) {
  const double half = 0.005;  // of the plate's height
  Simulation plate = grain_above(cuboid(1, {0.1, 0.1, 2 * half})), plane = grain_above(floor_plane());
  plate.move_body(0, {0, 0, -0.01 - half + moved_overlap}, {});
  plane.move_body(0, {0.3, 0, -0.01 + moved_overlap}, {});
  for (Simulation* each : {&plate, &plane}) {
    EXPECT_EQ(each->contacts().size(), 1u);
    each->run(1);
    EXPECT_NEAR(each->body(0).force.z, -pressing_force(), 1e-10 * pressing_force());
  }
  plate.move_body(0, {0, 0, -1}, {});
  plate.run(1);
  EXPECT_EQ(plate.body(0).force, Vec3{});
}

TEST(MovedBody, IsFeltWhereItTurnedOnTheSpot) {
  // On end, a plate of 100 mm reaches 50 mm up; lying, 5 mm.
  Simulation plate = grain_above(cuboid(1, {0.1, 0.1, 0.01}));
  plate.move_body(0, {0, 0, -0.06 + moved_overlap}, {});
  plate.run(10);
  EXPECT_EQ(plate.body(0).force, Vec3{});
  plate.move_body(0, plate.body(0).position, rotation_by({0, pi / 2, 0}));
  plate.run(1);
  EXPECT_NEAR(plate.body(0).force.z, -pressing_force(), 1e-10 * pressing_force());

  // A plane through (0.3, 0) that rises by 0.1 a metre toward -x: below the grain's lowest point, then in it.
  const double slope = 0.1, length_of_normal = std::sqrt(1 + slope * slope);
  Simulation plane = grain_above(floor_plane());
  plane.move_body(0, {0.3, 0, -0.01 * length_of_normal - 0.3 * slope + moved_overlap * length_of_normal}, {});
  plane.run(10);
  EXPECT_EQ(plane.body(0).force, Vec3{});
  plane.move_body(0, plane.body(0).position, rotation_by({0, std::atan(slope), 0}));
  plane.run(1);
  EXPECT_NEAR(length(plane.body(0).force), pressing_force(), 1e-9 * pressing_force());
}

TEST(MovedBody, IsFeltThoughEachMoveIsSmall) {
  // Steps of a tenth of the search's margin, a fifth of the radius.
  Simulation plate = grain_above(cuboid(1, {0.1, 0.1, 0.01}));
  const double last = -0.015 + moved_overlap;
  plate.move_body(0, {0, 0, last - 30 * 2e-4}, {});
  for (int k = 29; k >= 0; --k) {
    plate.move_body(0, {0, 0, last - k * 2e-4}, {});
    plate.run(1);
    EXPECT_EQ(plate.body(0).force.z == 0, k > 0);
  }
  EXPECT_NEAR(plate.body(0).force.z, -pressing_force(), 1e-10 * pressing_force());
}

TEST(MovedBody, BringsTheEnergyOfTheContactsThatItMakes) {
  Simulation plate = grain_above(cuboid(1, {0.1, 0.1, 0.01}), true);
  plate.move_body(0, {0, 0, -0.015 + moved_overlap}, {});
  const EnergyBalance now = plate.energy();
  EXPECT_NEAR(now.elastic, 0.4 * pressing_force() * moved_overlap, 1e-10 * now.elastic);
  EXPECT_NEAR(now.total(), 0, 1e-12 * now.elastic) << "all of it is counted as brought in";
}

TEST(FreeBody, FallsWhereItIsFree) {
  Simulation simulation = empty(1e-3);
  simulation.set_gravity({1, 2, -g});
  Body body = cuboid(2, {1, 1, 1});
  body.velocity = {0.5, 0.5, 0.5};
  body.free_translation = {false, true, true};
  body.weighs = true;
  body.applied_force = {5, 6, 0};
  simulation.add_body(body);
  simulation.run(1000);
  // v of leapfrog after n steps is v0 + n dt a exactly; x is v0 t + a dt^2 n(n + 1)/2.
  const Vec3 a{0, 2 + 6.0 / 2, -g};
  const Body& now = simulation.body(0);
  EXPECT_LT(length(now.velocity - (body.velocity + a)), 1e-12);
  EXPECT_LT(length(now.position - (body.velocity + 0.5 * 1.001 * a)), 1e-12);
}

TEST(FreeBody, TurnsAboutAnAxisUnderATorque) {
  Simulation simulation = empty(1e-3);
  Body body = cuboid(12, {1, 2, 3});  // inertia 13, 10, 5
  body.turning = Turning::about_axis;
  body.axis = unit({1, 0, 1});
  body.applied_torque = {3, 7, 0};
  simulation.add_body(body);
  simulation.run(100);
  const double inertia = (13 + 5) / 2.0, torque = 3 / std::sqrt(2.0);
  EXPECT_LT(length(simulation.body(0).spin - 0.1 * torque / inertia * body.axis), 1e-12);
  EXPECT_LT(length(simulation.body(0).rotation(body.axis) - body.axis), 1e-14);
}

/// A symmetric top: in space its spin goes round the angular momentum L at the rate L/A (Euler).
double precession_error(double dt) {
  Simulation simulation = empty(dt);
  Body top;
  top.inertia = {2, 2, 3};
  top.turning = Turning::free;
  top.spin = {1, 0, 4};
  simulation.add_body(top);
  const double time = 3;
  simulation.run(std::lround(time / dt));
  // The body lies straight at t = 0, its spin is that of half a step earlier, when it lay turned back.
  const Vec3 momentum = rotation_by(-dt / 2 * top.spin)(Vec3{2, 0, 12});
  EXPECT_LT(length(rotation_by(-dt / 2 * simulation.body(0).spin)(angular_momentum(simulation.body(0))) - momentum),
            1e-12 * length(momentum));
  return length(simulation.body(0).spin - rotation_by(time / 2 * momentum)(top.spin));
}

TEST(FreeBody, PrecessesAsEulerSays) {
  const double coarse = precession_error(2e-3), fine = precession_error(1e-3);
  EXPECT_LT(fine, 1e-4);
  EXPECT_LT(precession_error(2e-2), 1e-2) << "turns of 0.04 rad at a half step are no series any more";
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.05);
}

TEST(FreeBody, KeepsAngularMomentumAndEnergyAsItTumbles) {
  // About the axis of middle inertia a body tumbles: the hardest case.
  Simulation simulation = empty(1e-3);
  Body body;
  body.inertia = {1, 2, 3};
  body.turning = Turning::free;
  body.spin = {0.01, 5, 0.01};
  simulation.add_body(body);
  const auto momentum = [&] {
    const Body& now = simulation.body(0);
    return rotation_by(-5e-4 * now.spin)(angular_momentum(now));
  };
  const auto energy = [&] { return 0.5 * dot(simulation.body(0).spin, angular_momentum(simulation.body(0))); };
  const Vec3 before = momentum();
  const double energy_before = energy();
  double least = 5, worst = 0;
  for (int k = 0; k < 1000; ++k) {
    simulation.run(100);
    const Body& now = simulation.body(0);
    least = std::min(least, now.rotation.inverse()(now.spin).y);
    worst = std::max(worst, std::abs(energy() / energy_before - 1));
  }
  EXPECT_LT(least, -4.5) << "it has not tumbled";
  EXPECT_LT(length(momentum() - before), 1e-10 * length(before));
  EXPECT_LT(worst, 1e-5);  // (w dt)^2 is 2.5e-5
}

/// A layer of grains in a box, well damped.
Simulation layer(const ContactLaws& laws = {}) {
  Interaction contact = test::every_law();
  contact.restitution = 0.1;
  auto setup = soft_stone(laws, contact);
  setup.numerics.dt = 2e-5;
  Simulation simulation(setup);
  simulation.set_gravity({0, 0, -g});
  simulation.add_body(box_of_planes({-0.015, -0.015, -0.015}, {0.08, 0.08, 1}));
  test::add(simulation, test::cloud(48, 4, 0.1));
  simulation.run(10000);
  return simulation;
}

double weight_of_grains(const Simulation& simulation) {
  double sum = 0;
  for (std::size_t k = 0; k < simulation.state().grains.count(); ++k)
    sum += g / simulation.state().grains.motion[k].inverse_mass;
  return sum;
}

TEST(SlowFreeBody, IsCarriedByTheGrainsItLandsOn) {
  Simulation simulation = layer({{NormalLaw::hertz, RollingLaw::elastic_plastic, CohesionLaw::none}, -1});
  // The gap to the walls is too narrow for a grain.
  Body body = cuboid(0.3, {0.085, 0.085, 0.02});
  body.position = {0.0325, 0.0325, 0.05};
  body.free_translation = {false, false, true};
  body.weighs = true;
  simulation.add_body(body);
  simulation.run(100000);
  const Body &lies = simulation.body(1), &walls = simulation.body(0);
  EXPECT_LT(length(lies.velocity), 1e-4);
  EXPECT_NEAR(lies.force.z, 0.3 * g, 1e-3 * g);
  EXPECT_NEAR(walls.force.z, -(0.3 * g + weight_of_grains(simulation)), 1e-3 * g);
  // Across, what the walls take is what the guides of the box give.
  EXPECT_NEAR(walls.force.x, -lies.force.x, 1e-3 * g);
  EXPECT_NEAR(walls.force.y, -lies.force.y, 1e-3 * g);
}

TEST(SlowServo, PressesWithTheForceItIsTold) {
  Simulation simulation = layer();
  Body plate = cuboid(1, {0.085, 0.085, 0.02});
  plate.position = {0.0325, 0.0325, 0.05};
  plate.servo = Servo{.direction = {0, 0, 1}, .target = 20, .gain = 1e-3, .fastest = 0.2};
  simulation.add_body(plate);
  simulation.run(50);
  EXPECT_DOUBLE_EQ(simulation.body(1).velocity.z, -0.02) << "gain times the whole target, where nothing pushes";
  simulation.run(80000);
  EXPECT_NEAR(simulation.body(1).force.z, 20, 0.02);
  EXPECT_LT(length(simulation.body(1).velocity), 1e-4);
  EXPECT_NEAR(simulation.body(0).force.z, -(20 + weight_of_grains(simulation)), 0.02);
}

TEST(SlowBody, FeelsWhatItsContactsSay) {
  for (const ContactLaws& laws : test::all_laws()) {
    Simulation simulation = layer(laws);
    Body paddle = cuboid(1, {0.03, 0.03, 0.03});
    paddle.position = {0.03, 0.03, 0.02};
    paddle.velocity = {0.1, 0, -0.2};
    paddle.spin = {1, -2, 3};
    simulation.remove_grains([&](const GrainNow& grain) { return length(grain.position - paddle.position) < 0.035; });
    simulation.add_body(paddle);
    simulation.run(4000);
    Vec3 force[2], torque[2];
    for (const Contact& c : simulation.contacts()) {
      if (c.second >= 0) continue;
      const auto body = -1 - c.second;
      force[body] -= c.force;
      torque[body] -= c.couple + cross(c.point - simulation.body(static_cast<int>(body)).position, c.force);
    }
    simulation.run(1);
    EXPECT_GT(length(simulation.body(1).force), 1e-3) << "it touches nothing";
    for (int body = 0; body < 2; ++body) {
      EXPECT_LT(length(simulation.body(body).force - force[body]), 1e-10) << test::name_of(laws);
      EXPECT_LT(length(simulation.body(body).torque - torque[body]), 1e-11) << test::name_of(laws);
    }
  }
}

TEST(Body, CarriesAGrainAlongOnABelt) {
  // Friction's impulse J gives v = J/m to the grain and w = J l/I to its spin until v + w l is the belt's u.
  auto setup = soft_stone({{.rolling = RollingLaw::none}, -1});
  setup.numerics.dt = 5e-6;
  Simulation simulation(setup);
  simulation.set_gravity({0, 0, -g});
  Body belt = mesh_body(plate(2, 0.2, 40, 4));
  belt.velocity = {0.35, 0.07, 0.2};
  simulation.add_body(belt);
  simulation.add_grain({0, 0.01, 0.0099}, 0.01, 0, {0, 0, 0.2});
  simulation.run(200000);
  ASSERT_EQ(simulation.contacts().size(), 1u);
  const double lever = 0.01 - simulation.contacts()[0].overlap / 2, inertia = 0.4 * 0.01 * 0.01;
  const double share = inertia / (inertia + lever * lever);  // 2/7 but for the overlap
  EXPECT_NEAR(simulation.grain(0).velocity.x, 0.35 * share, 1e-4);
  EXPECT_NEAR(simulation.grain(0).velocity.y, 0.07 * share, 1e-4);
  EXPECT_NEAR(simulation.grain(0).velocity.z, 0.2, 1e-5);
}

TEST(Body, FindsGrainsFarOutOnAPlaneThatTilts) {
  // At 1 m from the axis the floor rises 5 mm, more than the skin, while no grain moves.
  auto setup = soft_stone();
  setup.numerics.skin = 0.002;
  Simulation simulation(setup);
  Body floor;
  floor.surfaces.push_back({Plane{}, 0});
  floor.spin = {0, -0.05, 0};
  simulation.add_body(floor);
  simulation.add_grain({1, 0, 0.01 + 0.0045}, 0.01, 0);
  simulation.run(10000);
  // The floor comes up at 0.05 m/s and throws it up at (1 + e) times that.
  EXPECT_NEAR(simulation.grain(0).velocity.z, 1.6 * 0.05, 1e-3);
}

// A grain without friction slides to and fro in a valley of two planes 0.1 rad apart, one contact in the mesh. Where
// the normal jumped from one plane's to the other's it lost 4 % of its energy in the same time.
TEST(SlowGrainOnAMesh, GoesThroughAShallowValleyWithoutLoss) {
  const double slope = 0.05, radius = 0.01, start = -0.02;
  std::vector<Vec3> vertices;
  for (const double y : {-1.0, 1.0})
    for (const double x : {-1.0, 0.0, 1.0}) vertices.push_back({x, y, std::abs(x) * std::tan(slope)});
  dem::Setup setup;
  setup.materials.add({"stone", 2500, 1e8, 0.25}, {.restitution = 0.5, .sliding_friction = 0});
  setup.laws.rolling = RollingLaw::none;
  setup.numerics.dt = 5e-6;
  setup.numerics.threads = 1;
  Simulation simulation(std::move(setup));
  simulation.set_gravity({0, 0, -g});
  simulation.add_body(mesh_body({vertices, {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}}}));
  simulation.add_grain({start, 0.1, -start * std::tan(slope) + radius / std::cos(slope)}, radius, 0);
  simulation.run(40000);  // it is put down without overlap, and comes to rest on its plane first
  double first = 0, before = start;
  int crossed = 0;
  for (int k = 0; k < 12; ++k) {
    const GrainNow now = simulation.grain(0);
    const double energy = (now.position.z - radius) / radius + squared(now.velocity) / (2 * g * radius);
    if (k == 0) first = energy;
    EXPECT_NEAR(energy, first, 0.01 * first) << simulation.time();
    crossed += before * now.position.x < 0, before = now.position.x;
    simulation.run(40000);
  }
  EXPECT_GE(crossed, 4);
}

}  // namespace
}  // namespace soilbin::dem
