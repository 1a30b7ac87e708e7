// Chung and Ooi 2011, Benchmark tests for verifying discrete element modelling codes at particle impact level, Granular
// Matter 13:643. Inputs as in the decks of YADE and Kratos; 'curve': points that Kratos read off the paper's figures
// (DEMApplication, test_examples/basic_benchmarks/paper_data). Each point has a tolerance of its own, chosen; the mean
// deviation of a curve is the measure of Kratos' tests.
#include <fmt/core.h>

#include <cmath>

#include "dem/verification/cases.hpp"
#include "dem/verification/impact.hpp"
#include "scenario/unit.hpp"

namespace soilbin::dem {
namespace {

using verification::first_plane;
using verification::hertz_overlap;
using verification::hertz_time;
using verification::impact;
using verification::Impact;
using verification::rigid;

constexpr double steps_an_impact = 2000;
constexpr const char* paper = "Chung and Ooi 2011";
constexpr const char* curve = "Chung and Ooi 2011, curve";

using Rows = std::vector<VerificationRow>;

/// A sphere that touches a wall at t = 0.
struct Shot {
  Material material;
  Interaction contact;
  double radius, speed;        ///< speed toward the wall
  double along = 0, spin = 0;  ///< velocity along x; spin about y
  double wall_young = rigid;
};

double reduced(const Shot& shot) {
  const double nu2 = 1 - shot.material.poisson * shot.material.poisson;
  return 1 / (nu2 / shot.material.young + nu2 / shot.wall_young);
}

Impact fire(const StartEngine& start, const Shot& shot) {
  VerificationSetup setup;
  const int sphere = setup.materials.add(shot.material, shot.contact);
  Material wall = shot.material;
  wall.young = shot.wall_young;
  const int hard = setup.materials.add(wall, shot.contact);
  setup.planes.push_back({{}, {0, 0, 1}, hard});
  setup.grains.push_back({.position = {0, 0, shot.radius},
                          .velocity = {shot.along, 0, -shot.speed},
                          .spin = {0, shot.spin, 0},
                          .radius = shot.radius,
                          .material = sphere});
  const double mass = sphere_mass(shot.material.density, shot.radius);
  setup.dt = hertz_time(mass, shot.radius, reduced(shot), shot.speed) / steps_an_impact;
  return impact(start, setup, first_plane, static_cast<long>(20 * steps_an_impact));
}

/// Two equal spheres that touch at t = 0, with opposite spins.
Impact fire_two(const StartEngine& start, const Shot& shot) {
  VerificationSetup setup;
  setup.materials.add(shot.material, shot.contact);
  for (const double side : {-1.0, 1.0})
    setup.grains.push_back({.position = {0, 0, side * shot.radius},
                            .velocity = {0, 0, -side * shot.speed},
                            .spin = {0, -side * shot.spin, 0},
                            .radius = shot.radius});
  const double mass = sphere_mass(shot.material.density, shot.radius) / 2;
  const double young = shot.material.young / (2 * (1 - shot.material.poisson * shot.material.poisson));
  setup.dt = hertz_time(mass, shot.radius / 2, young, 2 * shot.speed) / steps_an_impact;
  return impact(start, setup, 1, static_cast<long>(20 * steps_an_impact));
}

Interaction contact_of(double restitution, double friction) {
  Interaction contact;
  contact.restitution = restitution;
  contact.sliding_friction = friction;
  return contact;
}

/// Two bodies that meet, as Hertz's theory sees them: all but the speed reduced as of a sphere on a rigid wall.
struct Collision {
  double mass, radius, young, speed;
};

/// Greatest overlap and force and the duration against Hertz theory's.
void elastic_rows(Rows& rows, const std::string& name, const Impact& ours, const Collision& theory) {
  const auto& [mass, radius, young, speed] = theory;
  const double overlap = hertz_overlap(mass, radius, young, speed);
  const double force = 4.0 / 3 * young * std::sqrt(radius) * std::pow(overlap, 1.5);
  const double time = hertz_time(mass, radius, young, speed);
  const std::string source = std::string(paper) + "; Hertz theory";
  rows.push_back({name + ", greatest overlap", overlap * 1e6, ours.overlap * 1e6, overlap * 1e2, "um", source});
  rows.push_back({name + ", greatest force", force * 1e-3, ours.force * 1e-3, force * 1e-7, "kN", source});
  rows.push_back({name + ", duration", time * 1e6, ours.time * 1e6, time * 1e2, "us", source});
}

void test_1(Rows& rows, const StartEngine& start) {
  for (const auto& [name, material] : {std::pair{"glass", Material{"glass", 2800, 48e9, 0.20}},
                                       {"limestone", Material{"limestone", 2500, 20e9, 0.25}}}) {
    const Shot shot{material, contact_of(1, 0.35), 0.01, 10};
    const double young = material.young / (2 * (1 - material.poisson * material.poisson));
    elastic_rows(rows, fmt::format("T1 {}", name), fire_two(start, shot),
                 {sphere_mass(material.density, 0.01) / 2, 0.005, young, 20});
  }
}

void test_2(Rows& rows, const StartEngine& start) {
  for (const auto& [name, material] : {std::pair{"aluminium alloy", Material{"aluminium alloy", 2699, 70e9, 0.30}},
                                       {"magnesium alloy", Material{"magnesium alloy", 1800, 40e9, 0.35}}}) {
    const Shot shot{material, contact_of(1, 0), 0.1, 0.2};
    elastic_rows(rows, fmt::format("T2 {}", name), fire(start, shot),
                 {sphere_mass(material.density, 0.1), 0.1, reduced(shot), 0.2});
  }
}

void test_3(Rows& rows, const StartEngine& start) {
  for (const auto& [name, material] : {std::pair{"aluminium oxide", Material{"aluminium oxide", 4000, 380e9, 0.23}},
                                       {"cast iron", Material{"cast iron", 7000, 100e9, 0.25}}})
    for (const double e : {0.0, 0.2, 0.4, 0.6, 0.8, 1.0}) {
      const Impact out = fire(start, {material, contact_of(e, 0), 0.0025, 3.9});
      rows.push_back({fmt::format("T3 {}, e {}", name, e), e, out.velocity.z / 3.9, 1e-3, "-", paper});
    }
}

/// A point of a curve: abscissa, ordinate.
using Point = std::pair<double, double>;

const Material aluminium_oxide{"aluminium oxide", 4000, 380e9, 0.23};

Impact test_4_at(const StartEngine& start, double degrees) {
  const double angle = degrees * degree;
  return fire(start, {aluminium_oxide, contact_of(0.98, 0.092), 0.0025, 3.9 * std::cos(angle), 3.9 * std::sin(angle)});
}

/// A curve of the paper, and how near ours should come.
struct PublishedCurve {
  std::string name, abscissa;
  std::vector<Point> points;
  double tolerance;       ///< of a point, in the ordinate's unit
  double mean_tolerance;  ///< of the mean deviation, as a share of the ordinates' mean size
  std::string unit;       ///< of the ordinate
};

/// Rows of one curve, and of its mean deviation. `measure` gives ours at an abscissa.
template <class Measure>
void curve_rows(Rows& rows, const PublishedCurve& published, const Measure& measure) {
  const auto& [name, abscissa, points, tolerance, mean_tolerance, unit] = published;
  double off = 0, size = 0;
  for (const auto& [x, y] : points) {
    rows.push_back({fmt::format("{}, {} {:.4g}", name, abscissa, x), y, measure(x), tolerance, unit, curve});
    off += std::abs(rows.back().error());
    size += std::abs(y);
  }
  rows.push_back({name + ", mean deviation", 0, 100 * off / size, 100 * mean_tolerance, "%", curve});
}

/// Restitution along the wall, spin, and the angle at which the contact patch leaves, over the angle of incidence.
void test_4(Rows& rows, const StartEngine& start) {
  const double r = 0.0025, v = 3.9;
  const auto along = [&](double x) { return test_4_at(start, x).velocity.x / (v * std::sin(x * degree)); };
  const auto spin = [&](double x) { return -test_4_at(start, x).spin.y; };
  const auto patch = [&](double x) {
    const Impact out = test_4_at(start, x);
    return std::atan2(out.velocity.x - r * out.spin.y, out.velocity.z) / degree;
  };
  curve_rows(rows,
             {"T4 restitution along the wall",
              "deg",
              {{5, .9481},
               {10, .6870},
               {15, .6244},
               {20, .6161},
               {25, .6343},
               {30, .6837},
               {35, .7372},
               {40, .7809},
               {50, .8451},
               {60, .8929},
               {70, .9316},
               {80, .9662},
               {85, .9827}},
              0.016,
              0.016,
              "-"},
             along);
  curve_rows(rows,
             {"T4 spin",
              "deg",
              {{5, -19.27},
               {10, -213.0},
               {15, -377.8},
               {20, -510.6},
               {25, -599.4},
               {30, -616.5},
               {35, -582.3},
               {40, -544.8},
               {50, -457.0},
               {60, -357.5},
               {70, -246.2},
               {80, -126.3},
               {85, -63.15}},
              0.022 * 616.5,
              0.022,
              "rad/s"},
             spin);
  curve_rows(rows,
             {"T4 angle of the patch",
              "deg",
              {{5, 3.761},
               {10, -1.556},
               {15, -5.544},
               {20, -7.538},
               {25, -7.538},
               {30, -3.550},
               {35, 3.429},
               {40, 11.57},
               {50, 29.35},
               {60, 47.79},
               {70, 64.58},
               {80, 78.70},
               {85, 84.52}},
              0.025 * 84.52,
              0.025,
              "deg"},
             patch);
}

/// Where it slides throughout, as a rigid sphere does.
void test_4_sliding(Rows& rows, const StartEngine& start) {
  const double r = 0.0025, push = 0.092 * (1 + 0.98), v = 3.9;
  for (const double angle : {35.0, 50.0, 65.0, 80.0}) {
    const Impact out = test_4_at(start, angle);
    const double along = 1 - push / std::tan(angle * degree), spin = 2.5 * push * v * std::cos(angle * degree) / r;
    rows.push_back({fmt::format("T4 sliding, restitution along the wall, deg {}", angle), along,
                    out.velocity.x / (v * std::sin(angle * degree)), 1e-3, "-", "rigid sphere that slides throughout"});
    rows.push_back({fmt::format("T4 sliding, spin, deg {}", angle), -spin, -out.spin.y, 0.002 * spin, "rad/s",
                    "rigid sphere that slides throughout"});
  }
}

/// Over Psi1 = v_t/(mu v_n): that of the patch after the impact, Psi2, and the spin. Only where the sphere slides
/// throughout: below Psi1 of 6.2 the paper's curves belong to a contact half as stiff as Mindlin's, unlike those of
/// test 4.
void test_5(Rows& rows, const StartEngine& start) {
  const double r = 1e-5, v = 5, mu = 0.3;
  const Material steel{"steel", 7850, 208e9, 0.30};
  const auto shot = [&](double x) { return fire(start, {steel, contact_of(1, mu), r, v, x * mu * v}); };
  const auto patch = [&](double x) {
    const Impact out = shot(x);
    return (out.velocity.x - r * out.spin.y) / (mu * v);
  };
  const auto spin = [&](double x) { return -r * shot(x).spin.y / (mu * v); };
  curve_rows(rows, {"T5 Psi2", "Psi1", {{9.988, 3.013}, {12.96, 6.013}}, 0.05, 0.02, "-"}, patch);
  curve_rows(rows, {"T5 spin r/(mu v_n)", "Psi1", {{6.006, -5.006}, {10.01, -5.004}, {20., -4.991}}, 0.05, 0.02, "-"},
             spin);
  for (const double x : {6.3, 7.0, 10.0, 20.0}) {
    rows.push_back({fmt::format("T5 sliding, spin r/(mu v_n), Psi1 {}", x), -5, spin(x), 0.02, "-", paper});
    rows.push_back({fmt::format("T5 sliding, Psi2, Psi1 {}", x), x - 7, patch(x), 0.02, "-", paper});
  }
}

/// What a spinning sphere keeps: restitution of the patch, and the tangent of its angle. Only where the sphere slides
/// throughout: nearer to sticking the damping along the surface rules, which the paper leaves open. Friction follows
/// the pressing force alone, not the pull at the end of an impact, so its impulse is 3.3 % above mu times the normal
/// one; the tolerances here leave room for that (Kratos' are 3 % of the mean).
struct Spinner {
  static constexpr double r = 0.1, v = 0.2, mu = 0.4, e = 0.5, slides = 3.5 * mu * (1 + e);
  Material alloy{"aluminium alloy", 2700, 70e9, 0.33};
  static double restitution(const Impact& out, double speed) { return -(out.velocity.x - r * out.spin.y) / speed; }
};

void test_6(Rows& rows, const StartEngine& start) {
  using S = Spinner;
  const auto shot = [&](double speed) {
    return fire(start, {S{}.alloy, contact_of(S::e, S::mu), S::r, S::v, 0, -speed / S::r});
  };
  const auto back = [&](double x) { return S::restitution(shot(S::slides * S::v / x), S::slides * S::v / x); };
  const auto tangent = [&](double x) {
    const Impact out = shot(x * S::v);
    return (out.velocity.x - S::r * out.spin.y) / out.velocity.z;
  };
  curve_rows(rows,
             {"T6 restitution of the patch",
              "3.5 mu (1+e) v_n/v_t",
              {{.1762, -.8200}, {.3524, -.6335}, {.5507, -.4447}, {.7709, -.2428}, {.9692, -.0277}},
              0.04,
              0.05,
              "-"},
             back);
  curve_rows(rows,
             {"T6 tangent of recoil",
              "v_t/v_n",
              {{2.747, 1.272}, {3.733, 3.241}, {5.677, 7.127}, {6.106, 7.985}},
              0.2,
              0.03,
              "-"},
             tangent);
  for (const double x : {0.1, 0.3, 0.5, 0.7, 0.9})
    rows.push_back({fmt::format("T6 sliding, restitution of the patch, 3.5 mu (1+e) v_n/v_t {}", x), -1 + x, back(x),
                    0.04 * x, "-", paper});
}

/// Opposite spins: the two surfaces roll on each other, so nothing changes along them.
void test_7(Rows& rows, const StartEngine& start) {
  for (const double w : {0.175, 2.0, 7.464, 22.86}) {
    const Impact out = fire_two(start, {Spinner{}.alloy, contact_of(Spinner::e, Spinner::mu), 0.1, 0.2, 0, w});
    rows.push_back({fmt::format("T7 spin, {} rad/s", w), w, out.spin.y, 0.01 * w, "rad/s", curve});
    rows.push_back({fmt::format("T7 velocity along the surface, {} rad/s", w), 0, out.velocity.x, 1e-9, "m/s", curve});
  }
}

/// Test 6 on a sphere of another size, so heavy and stiff that it is a wall.
void test_8(Rows& rows, const StartEngine& start) {
  using S = Spinner;
  const auto back = [&](double x) {
    const double speed = S::slides * S::v / x;
    VerificationSetup setup;
    setup.materials.add(S{}.alloy, contact_of(S::e, S::mu));
    setup.materials.add({"heavy", 2.7e6, 70e12, 0.33}, contact_of(S::e, S::mu));
    setup.grains.push_back({{0, 0, S::r}, {0, 0, -S::v}, {0, -speed / S::r, 0}, S::r, 0});
    setup.grains.push_back({{0, 0, -5 * S::r}, {}, {}, 5 * S::r, 1});
    const double young = 70e9 / (1 - 0.33 * 0.33);
    setup.dt = hertz_time(sphere_mass(2700, S::r), S::r, young, S::v) / steps_an_impact;
    return S::restitution(impact(start, setup, 1, static_cast<long>(20 * steps_an_impact)), speed);
  };
  curve_rows(rows,
             {"T8 restitution of the patch",
              "3.5 mu (1+e) v_n/v_t",
              {{.1872, -.8152}, {.3583, -.6262}, {.5508, -.4394}, {.7647, -.2378}, {.9786, -.0173}},
              0.04,
              0.05,
              "-"},
             back);
}

}  // namespace

std::vector<VerificationCase> chung_ooi_cases() {
  return {{{"T1"}, test_1},
          {{"T2"}, test_2},
          {{"T3"}, test_3},
          {{"T4 restitution along the wall", "T4 spin", "T4 angle of the patch"}, test_4},
          {{"T4 sliding"}, test_4_sliding},
          {{"T5"}, test_5},
          {{"T6"}, test_6},
          {{"T7"}, test_7},
          {{"T8"}, test_8}};
}

}  // namespace soilbin::dem
