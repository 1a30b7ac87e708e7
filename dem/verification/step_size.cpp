// What must not depend on the time step: a grain that rolls, one that spins on the spot, a wheel in a small bin. Each
// at a step, a half and a quarter of it.
#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "dem/engine/laws/contact_law.hpp"
#include "dem/rig/wheel_run.hpp"
#include "dem/verification/cases.hpp"

namespace soilbin::dem {
namespace {

using std::numbers::pi;
using verification::closed_form;
using verification::g;

using StepRows = std::vector<VerificationRow>;

/// A stiff sphere of 10 mm radius on a rough floor.
struct OnFloor {
  static constexpr double radius = 0.01, density = 2500, young = 1e9, poisson = 0.25, mu = 0.8, mu_r = 0.1;
  ContactLaws laws;
  double restitution = 0.5;

  static double mass() { return sphere_mass(density, radius); }
  static double inertia() { return 0.4 * mass() * radius * radius; }
  static double overlap() {
    return std::pow(mass() * g / (4.0 / 3 * young / (2 * (1 - poisson * poisson)) * std::sqrt(radius)), 2.0 / 3);
  }
  std::unique_ptr<VerificationEngine> after(const StartEngine& start, const Vec3& velocity, const Vec3& spin,
                                            double time, double dt) const {
    VerificationSetup setup;
    Interaction contact;
    contact.restitution = restitution, contact.rolling_damping = 0.3;
    contact.sliding_friction = mu, contact.rolling_friction = mu_r;
    setup.materials.add({"stone", density, young, poisson}, contact);
    setup.laws = laws;
    setup.planes.push_back({{}, {0, 0, 1}, 0});
    setup.grains.push_back({{0, 0, radius - overlap()}, velocity, spin, radius, 0});
    setup.gravity = {0, 0, -g};
    setup.dt = dt;
    auto engine = start(setup);
    engine->step(std::lround(time / dt));
    return engine;
  }
};

constexpr double coarsest = 1e-5;  // a sixth of the sphere's Rayleigh time
constexpr int parts[] = {1, 2, 4};

std::string named(const std::string& what, int part) {
  return what + (part == 1 ? ", dt" : fmt::format(", dt/{}", part));
}

/// Rolls at v, is slowed by 5 mu_r g/7 and stands at v^2/(10 mu_r g/7); after Ai et al. 2011, a disc on a flat floor.
void rolling_grain(StepRows& rows, const StartEngine& start) {
  const double v = 0.3, slowing = 5.0 / 7 * OnFloor::mu_r * g, t = 0.5 * v / slowing;
  for (const auto& [name, law] :
       {std::pair{"elastic_plastic", RollingLaw::elastic_plastic}, std::pair{"directional", RollingLaw::directional}})
    for (const int part : parts) {
      const OnFloor floor{{{.rolling = law}, -1}};
      const auto at = [&](double time) {
        return floor.after(start, {v, 0, 0}, {0, v / OnFloor::radius, 0}, time, coarsest / part);
      };
      const auto rolls = at(t), stands = at(3 * v / slowing);
      const std::string rolling = fmt::format("a rolling grain, {}", name);
      rows.push_back({named(rolling + ": speed half way", part), v / 2, rolls->velocity(0).x, 4e-3, "m/s",
                      "closed form; after Ai et al. 2011"});
      rows.push_back({named(rolling + ": way to rest", part), v * v / (2 * slowing), stands->position(0).x, 2e-3, "m",
                      "closed form; after Ai et al. 2011"});
      rows.push_back({named(rolling + ": spin at rest", part), 0, stands->spin(0).y, 1e-3, "rad/s", closed_form});
    }
}

/// Spins about the contact's normal: only a law of twisting slows it.
void spinning_grain(StepRows& rows, const StartEngine& start) {
  const double w = 2, t = 0.05, a = std::sqrt(OnFloor::radius * OnFloor::overlap()), weight = OnFloor::mass() * g;
  // The spring is wound up to its limit first, without its dashpot: w cos(f t) until k sin(f t) w/f is the limit.
  const double limit = 2.0 / 3 * a * OnFloor::mu * weight, inertia = OnFloor::inertia();
  const double shear = OnFloor::young / (4 * (2 - OnFloor::poisson) * (1 + OnFloor::poisson));  // G* of equal materials
  const double stiffness = 0.5 * 8 * shear * a * a * a, f = std::sqrt(stiffness / inertia);
  const double wound = std::asin(limit * f / (stiffness * w)) / f;
  const double free = w, marshall = w * std::cos(f * wound) - limit * (t - wound) / inertia;
  const double directional = w - OnFloor::mu_r * OnFloor::radius * weight * t / OnFloor::inertia();
  const std::pair<const char*, LawFlags> cases[] = {
      {"no twisting law", {}},
      {"directional", {.rolling = RollingLaw::directional}},
      {"marshall", {.twisting = TwistingLaw::marshall}},
      {"directional_with_twist", {.rolling = RollingLaw::directional_with_twist}}};
  for (const auto& [name, flags] : cases)
    for (const int part : parts) {
      const bool twisting = flags.twisting == TwistingLaw::marshall;
      const double expected = twisting                                              ? marshall
                              : flags.rolling == RollingLaw::directional_with_twist ? std::max(directional, 0.0)
                                                                                    : free;
      const auto spins = OnFloor{{flags, -1}, twisting ? 1.0 : 0.5}.after(start, {}, {0, 0, w}, t, coarsest / part);
      rows.push_back({named(fmt::format("a spinning grain, {}: spin", name), part), expected, spins->spin(0).z,
                      twisting ? 2e-3 : 1e-6, "rad/s", closed_form});
    }
}

/// The shear force of two grains that spin about their normal as one body turns with them and keeps its size.
void spinning_pair(StepRows& rows) {
  LawConstants<double> stone{};
  stone.normal = 1e8, stone.shear = 1e8, stone.sliding = 0.5;
  const double turns = 0.7, w = 40;
  for (const int part : parts) {
    const double dt = 2e-4 / part;
    const long steps = std::lround(2 * pi * turns / w / dt);
    Memory<double> memory{{1e-7, 0, 0}, {}};
    Touch<double> touch{.normal = {0, 0, 1},
                        .overlap = 1e-5,
                        .radius = 0.005,
                        .mass = 0.005,
                        .velocity = {},
                        .rotation = {},
                        .inertia = 1e-7,
                        .turning = w,
                        .before = {0, 0, 1}};
    Response<double> does{};
    for (long k = 0; k < steps; ++k) does = contact_response<double>({}, stone, touch, memory, dt, nullptr);
    const double size = std::hypot(does.tangential.x, does.tangential.y);
    const double angle = w * dt * static_cast<double>(steps);
    const double along = -(does.tangential.x * std::cos(angle) + does.tangential.y * std::sin(angle));
    const double expected = stone.shear * std::sqrt(touch.radius * touch.overlap) * 1e-7;
    rows.push_back(
        {named("two grains spinning as one: shear force", part), expected, size, 1e-9 * expected, "N", closed_form});
    rows.push_back({named("two grains spinning as one: its part that turned with them", part), expected, along,
                    1e-7 * expected, "N", closed_form});
  }
}

/// A small smooth wheel in grains of 14 mm, soft so that a step is 0.2 ms: seconds for all three steps.
void wheel_in_small_bin(StepRows& rows) {
  GranularSoil sand;
  sand.radius_min = 0.006, sand.radius_max = 0.008, sand.grain_density = 2500, sand.youngs_modulus = 3e6;
  sand.grain_grain.rolling_friction = sand.grain_tire.rolling_friction = 0.2;
  Tire wheel;
  wheel.radius = 0.08, wheel.width = 0.06;
  BedRecipe recipe;
  recipe.soil = sand;
  recipe.size = {.length = 0.7, .width = 0.13, .depth = 0.08};
  recipe.settling_friction = 0.2;
  WorkOptions one_thread;
  one_thread.threads = 1;
  const SettledBed bed = settle_bed(recipe, one_thread);
  OperatingCondition at;
  at.load = 60, at.slip = 0.2, at.speed = 0.3;
  std::vector<TractionResult> found;
  for (const int part : parts) {
    Rig rig;
    rig.lowering = 0.1, rig.resting = 0.05, rig.starting = 0.05, rig.behind = 0.12, rig.ahead = 0.12;
    rig.dt = longest_step(sand) / part;
    found.push_back(run_wheel({bed, wheel, sand.grain_tire, rig}, at, one_thread).result);
  }
  const auto add = [&](const char* what, Estimate TractionResult::*channel, const char* unit, double per_si) {
    const Estimate& finest = found.back().*channel;
    for (int k = 0; k < 2; ++k) {
      const Estimate& one = found[k].*channel;
      rows.push_back({named(fmt::format("a wheel in a small bin: {}", what), parts[k]), finest.value * per_si,
                      one.value * per_si, 3 * std::hypot(one.std_error, finest.std_error) * per_si, unit,
                      "its own answer at dt/4; 3 standard errors"});
    }
  };
  add("pull", &TractionResult::drawbar_pull, "N", 1);
  add("torque", &TractionResult::torque, "N m", 1);
  add("sinkage", &TractionResult::sinkage, "mm", 1000);
}

}  // namespace

std::vector<VerificationCase> step_size_cases() {
  const auto on_the_engine = [](auto add) { return [add](StepRows& rows, const StartEngine&) { add(rows); }; };
  return {{{"a rolling grain"}, rolling_grain},
          {{"a spinning grain"}, spinning_grain},
          {{"two grains spinning as one"}, on_the_engine(spinning_pair)},
          {{"a wheel in a small bin"}, on_the_engine(wheel_in_small_bin)}};
}

}  // namespace soilbin::dem
