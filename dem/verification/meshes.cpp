// Surfaces of triangles on the engine: a plate meshed in any way is a plane, also to a grain that slides, rolls and
// bounces over faces, edges and vertices; ridges, corners; closed forms of a grain on bodies that turn.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dem/engine/simulation.hpp"
#include "dem/surface/mass_properties.hpp"
#include "dem/surface/shapes.hpp"
#include "dem/verification/cases.hpp"

namespace soilbin::dem {
namespace {

using std::numbers::pi;
using verification::closed_form;
using verification::g;

using Rows = std::vector<VerificationRow>;
constexpr double grain_radius = 0.01, side = 0.6;
constexpr const char* as_plane = "the analytic plane, same engine";

struct Meshing {
  const char* name;
  TriangleMesh mesh;
};

/// Four triangles round a vertex in the path of the grain.
TriangleMesh fan() {
  const double h = side / 2;
  return {{{-h, -h, 0}, {h, -h, 0}, {h, h, 0}, {-h, h, 0}, {0.03, 0, 0}}, {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}};
}

std::vector<Meshing> meshings() {
  return {{"two triangles", plate(side, side, 1, 1)},
          {"four triangles", fan()},
          {"cells of 0.1 m", plate(side, side, 6, 6)},
          {"cells of 10 mm", plate(side, side, 60, 60)}};
}

Body body_of(TriangleMesh mesh) {
  Body body;
  body.name = mesh.name();
  body.surfaces.push_back({MeshSurface{std::make_shared<TriangleMesh>(std::move(mesh)), nullptr}, 0});
  return body;
}

Body plane_body() {
  Body body;
  body.surfaces.push_back({Plane{}, 0});
  return body;
}

Simulation start(const Body& floor, const ContactLaws& laws = {}, double friction = 0.4, double rolling = 0) {
  Setup setup;
  setup.materials.add(
      {"stone", 2500, 1e8, 0.25},
      {.restitution = 0.7, .sliding_friction = friction, .rolling_friction = rolling, .rolling_damping = 0.3});
  setup.laws = laws;
  setup.numerics.dt = 5e-6;
  setup.numerics.threads = 1;
  Simulation simulation(std::move(setup));
  simulation.set_gravity({0, 0, -g});
  simulation.add_body(floor);
  return simulation;
}

double weight() { return sphere_mass(2500, grain_radius) * g; }

/// Overlap that carries `force` between a grain and a surface of stone.
double overlap_under(double force) {
  const double young = 1e8 / (2 * (1 - 0.25 * 0.25));
  return std::pow(force / (4.0 / 3 * young * std::sqrt(grain_radius)), 2.0 / 3);
}

/// A way of moving over the plate, from x < 0 to x > 0. Along y = 0 lie edges and vertices of all meshings but the
/// first.
struct Trial {
  const char* name;
  Vec3 position, velocity, spin;
  RollingLaw law;
  double rolling, time;
};

std::vector<Trial> trials() {
  const double z = grain_radius - overlap_under(weight());
  return {{"slides, then rolls along edges", {-0.15, 0, z}, {1, 0, 0}, {}, RollingLaw::none, 0, 0.3},
          {"slides, then rolls across", {-0.15, -0.07, z}, {1, 0.4, 0}, {0, 0, 30}, RollingLaw::none, 0, 0.3},
          {"rolls to rest", {-0.05, -0.012, z}, {0.4, 0.1, 0}, {-10, 40, 0}, RollingLaw::elastic_plastic, 0.2, 0.4},
          {"bounces", {-0.15, -0.05, 0.03}, {1, 0.3, -0.5}, {0, -50, 20}, RollingLaw::directional, 0.1, 0.3}};
}

/// Runs the trial on a floor that is turned out of the axes, so that no number is round.
Simulation after(Body floor, const Trial& trial) {
  const Rotation tilt = rotation_by({0.3, -0.4, 0.2});
  floor.rotation = tilt;
  ContactLaws laws;
  laws.rolling = trial.law;
  Simulation simulation = start(floor, laws, 0.4, trial.rolling);
  simulation.set_gravity(tilt({0, 0, -g}));
  simulation.add_grain(tilt(trial.position), grain_radius, 0, tilt(trial.velocity), tilt(trial.spin));
  simulation.run(std::lround(trial.time / simulation.setup().numerics.dt));
  return simulation;
}

void plates(Rows& rows) {
  const auto ways = meshings();
  for (const Trial& trial : trials()) {
    const GrainNow on_plane = after(plane_body(), trial).grain(0);
    const double start_speed = length(trial.velocity), path = 0.1;
    for (const Meshing& way : ways) {
      const GrainNow now = after(body_of(way.mesh), trial).grain(0);
      const auto row = [&](const char* what, const Vec3& expected, const Vec3& ours, double scale, const char* unit) {
        rows.push_back({fmt::format("plate of {}: {}: {}", way.name, trial.name, what), 0, length(ours - expected),
                        1e-6 * scale, unit, as_plane});
      };
      row("difference in place", on_plane.position, now.position, path, "m");
      row("difference in velocity", on_plane.velocity, now.velocity, start_speed, "m/s");
      row("difference in spin", on_plane.spin, now.spin, start_speed / grain_radius, "rad/s");
    }
  }
  const Vec3 places[] = {{0.1, 0.2, 0}, {0.05, 0, 0}, {0.1, 0.1, 0}};
  const char* on[] = {"a face", "an edge", "a vertex"};
  for (int k = 0; k < 3; ++k) {
    Simulation rests = start(body_of(plate(side, side, 6, 6)));
    rests.add_grain(places[k] + Vec3{0, 0, grain_radius - overlap_under(weight())}, grain_radius, 0);
    rests.run(0);
    const auto contacts = rests.contacts();
    rows.push_back({fmt::format("rests on {}: force", on[k]), weight(), contacts.empty() ? 0 : contacts[0].force.z,
                    1e-6 * weight(), "N", closed_form});
    rows.push_back(
        {fmt::format("rests on {}: contacts", on[k]), 1, static_cast<double>(contacts.size()), 0, "", closed_form});
  }
}

/// A roof: two planes that meet at x = 0 at an outer angle `alpha` each, ridge along y at z = 0; upside down a valley.
TriangleMesh roof(double alpha, int cells) {
  const double x = 0.1 * std::cos(alpha), z = -0.1 * std::sin(alpha);
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Corners> triangles;
  for (int j = 0; j <= cells; ++j) {
    const double y = -0.1 + 0.2 * j / cells;
    for (const Vec3& v : {Vec3{-x, y, z}, Vec3{0, y, 0}, Vec3{x, y, z}}) vertices.push_back(v);
  }
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < 2; ++i) {
      const int a = 3 * j + i;
      triangles.push_back({a, a + 1, a + 4});
      triangles.push_back({a, a + 4, a + 3});
    }
  return {vertices, triangles};
}

/// Over a ridge the force turns with the line from the edge to the centre, not at once.
void ridge(Rows& rows) {
  const double alpha = 0.6, near = 0.98 * grain_radius;  // the centre goes round the ridge at this distance
  const Body body = body_of(roof(alpha, 5));
  double worst_direction = 0, worst_overlap = 0;
  for (int k = -400; k <= 400; ++k) {
    const double angle = k * 0.0025, turned = std::clamp(angle, -alpha, alpha);
    // Over the ridge a circle about it, over the slopes straight on.
    const double beyond = (angle - turned) * near;
    const Vec3 centre{near * std::sin(turned) + beyond * std::cos(turned), 0.013,
                      near * std::cos(turned) - beyond * std::sin(turned)};
    Simulation simulation = start(body, {}, 0);
    simulation.add_grain(centre, grain_radius, 0);
    simulation.run(0);
    const auto contacts = simulation.contacts();
    if (contacts.size() != 1) {
      worst_direction = worst_overlap = 1;
      continue;
    }
    const Vec3 direction = unit(contacts[0].force);
    worst_direction = std::max(worst_direction, length(direction - Vec3{std::sin(turned), 0, std::cos(turned)}));
    worst_overlap = std::max(worst_overlap, std::abs(contacts[0].overlap - (grain_radius - near)));
  }
  rows.push_back(
      {"convex ridge: greatest error of the force's direction", 0, worst_direction, 1e-6, "rad", closed_form});
  rows.push_back(
      {"convex ridge: greatest error of the overlap", 0, worst_overlap, 1e-6 * grain_radius, "m", closed_form});
}

/// A grain comes to rest in a valley of two planes without friction, and in the corner of a box.
void corners(Rows& rows) {
  const double alpha = 0.6;
  Body valley = body_of(roof(alpha, 5));
  valley.rotation = {0, 0, 1, 0};  // half a turn about y
  Simulation simulation = start(valley, {}, 0);
  const double pressing = weight() / (2 * std::cos(alpha));
  simulation.add_grain({0, 0.003, (grain_radius - overlap_under(pressing)) / std::cos(alpha)}, grain_radius, 0);
  simulation.run(0);
  auto contacts = simulation.contacts();
  rows.push_back({"valley of two planes: contacts", 2, static_cast<double>(contacts.size()), 0, "", closed_form});
  for (const Contact& c : contacts)
    rows.push_back(
        {"valley of two planes: force of one", pressing, length(c.force), 1e-6 * pressing, "N", closed_form});

  const double half = 0.05;
  TriangleMesh from = box({2 * half, 2 * half, 2 * half}, 0.03);
  Simulation in_box = start(body_of(TriangleMesh(from.vertices(), from.triangles())), {}, 0);  // a sheet: both sides
  in_box.set_gravity(g / std::sqrt(3.0) * Vec3{1, 1, -1});
  const double at = half - (grain_radius - overlap_under(weight() / std::sqrt(3.0)));
  in_box.add_grain({at, at, -at}, grain_radius, 0);
  in_box.run(0);
  contacts = in_box.contacts();
  rows.push_back({"corner of three planes: contacts", 3, static_cast<double>(contacts.size()), 0, "", closed_form});
  for (const Contact& c : contacts)
    rows.push_back({"corner of three planes: force of one", weight() / std::sqrt(3.0), length(c.force), 1e-6 * weight(),
                    "N", closed_form});
}

/// A ball that rolls on a turntable goes round a circle at 2/7 of the table's rate, wherever it starts (Weckesser 1997,
/// Am. J. Phys. 65:736): after 7/2 turns of the table it is back.
void turntable(Rows& rows, const Meshing& way) {
  const double rate = 20, v = 0.4;
  Body table = body_of(way.mesh);
  table.spin = {0, 0, rate};
  Simulation simulation = start(table, {}, 0.8);
  const Vec3 from{0.05, -0.03, grain_radius - overlap_under(weight())};
  // Rolling: v + w x (-r z) is the table's velocity at the contact.
  const Vec3 spin{(rate * from.x) / grain_radius, (v + rate * from.y) / grain_radius, 0};
  simulation.add_grain(from, grain_radius, 0, {v, 0, 0}, spin);
  const double turn = 2 * pi / (2.0 / 7 * rate), radius = v / (2.0 / 7 * rate);
  const auto half = std::lround(turn / 2 / simulation.setup().numerics.dt);
  simulation.run(half);
  const Vec3 across = simulation.grain(0).position;
  simulation.run(half);
  const Vec3 back = simulation.grain(0).position;
  rows.push_back({fmt::format("turntable of {}: way across the circle", way.name), 2 * radius * 1e3,
                  length(across - from) * 1e3, 2 * radius * 1e3 * 2e-3, "mm", closed_form});
  rows.push_back({fmt::format("turntable of {}: off the start after a circle", way.name), 0, length(back - from) * 1e3,
                  2 * radius * 1e3 * 1e-2, "mm", closed_form});
}

/// A grain in a drum is carried up to the slope whose tangent is its rolling friction: there the moment of the wall's
/// friction, m g sin(a) r, is the rolling resistance, mu_r r m g cos(a).
void drum(Rows& rows) {
  const double mu_r = 0.3, radius = 0.1;
  const TriangleMesh wheel = smooth_wheel(radius, 0.1, 360);
  Body body = body_of(TriangleMesh(wheel.vertices(), wheel.triangles()));  // a sheet: its inside counts
  body.spin = {0, 3, 0};
  ContactLaws laws;
  laws.rolling = RollingLaw::directional;
  Simulation simulation = start(body, laws, 0.8, mu_r);
  const double slope = std::atan(mu_r);
  // A grain swings about its place like a pendulum, undamped: begin there, and take the mean of whole swings.
  const Vec3 down{-std::sin(slope), 0, -std::cos(slope)};
  simulation.add_grain((radius - grain_radius) * down + Vec3{0, 0.004, 0}, grain_radius, 0, {},
                       {0, body.spin.y * radius / grain_radius, 0});
  const double swing = 2 * pi * std::sqrt(7.0 / 5 * (radius - grain_radius) * std::cos(slope) / g);
  const auto part = std::lround(swing / simulation.setup().numerics.dt / 500);
  Vec3 sum;
  for (int k = 0; k < 1000; ++k) {
    simulation.run(part);
    sum += simulation.grain(0).position;
  }
  const double angle = std::atan2(std::abs(sum.x), -sum.z);
  rows.push_back({"carried by a drum of 360 facets: angle", std::atan(mu_r) * 180 / pi, angle * 180 / pi, 0.5, "deg",
                  closed_form});
}

}  // namespace

std::vector<VerificationCase> mesh_cases() {
  const auto turntables = [](Rows& rows) {
    for (const Meshing& way : meshings()) turntable(rows, way);
  };
  const auto on_the_engine = [](auto add) { return [add](Rows& rows, const StartEngine&) { add(rows); }; };
  return {{{"plate of", "rests on"}, on_the_engine(plates)},
          {{"convex ridge"}, on_the_engine(ridge)},
          {{"valley of two planes", "corner of three planes"}, on_the_engine(corners)},
          {{"turntable"}, on_the_engine(turntables)},
          {{"carried by a drum"}, on_the_engine(drum)}};
}

}  // namespace soilbin::dem
