#include "dem/verification/incline.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "dem/bed/insertion.hpp"
#include "scenario/errors.hpp"
#include "scenario/mean_value.hpp"
#include "scenario/unit.hpp"

namespace soilbin::dem {
namespace {

using std::numbers::pi;

constexpr double r = 0.5, normal_stiffness = 2e5, dashpot = 25;
enum : int { loose, base };  ///< materials

/// e of a linear spring k_n beside a dashpot [m sqrt(g/d)], for a reduced mass [m].
double restitution(double reduced_mass) {
  const double decay = dashpot / (2 * reduced_mass);
  return std::exp(-pi * decay / std::sqrt(normal_stiffness / reduced_mass - decay * decay));
}

void check(const InclineLayer& layer) {
  if (!(layer.angle > 0 && layer.angle < pi / 2)) throw InputError("an incline lies between 0 and 90 deg");
  if (!(layer.layers > 0 && layer.length > 2 && layer.width > 2 && layer.base_from >= 3 && layer.longest > 0))
    throw InputError("a layer needs grains, time, a box of more than 2 d and a base from at least 3 d");
}

Simulation empty(const InclineLayer& layer) {
  Interaction contact{.restitution = restitution(0.5),
                      .sliding_friction = 0.5,
                      .normal_stiffness = normal_stiffness,
                      .shear_stiffness = normal_stiffness * 2 / 7};
  Setup setup;
  setup.materials.add({"loose", 6 / pi}, contact);
  setup.materials.add({"base", 6 / pi}, contact);
  contact.restitution = restitution(1);  // the same dashpot, on a grain that is held
  setup.materials.set(loose, base, contact);
  setup.laws.normal = NormalLaw::hooke, setup.laws.rolling = RollingLaw::none;
  setup.laws.tangential_damping = 1;
  setup.domain = {
      {0, 0, -1}, {layer.length, layer.width, 4 * (layer.base_from + layer.layers) + 20}, {true, true, false}};
  setup.numerics.dt = layer.dt;
  setup.numerics.force_step = true;  // the Rayleigh time is that of Hertz's law
  setup.numerics.threads = layer.threads;
  return Simulation(std::move(setup));
}

/// Adds grains above `from` [d], so many a d^2.
void pour(Simulation& simulation, const InclineLayer& layer, int material, double from, double layers,
          std::uint64_t seed) {
  const auto count = static_cast<int>(std::lround(layers * layer.length * layer.width));
  Region region{{0, 0, from}, {layer.length, layer.width, from}};
  while (room_for(region, {r, r}) < count) region.upper.z += 2 * r;
  insert_loosely(simulation, region, {r, r}, material, count, seed);
}

void run_for(Simulation& simulation, double time) {
  simulation.run(std::lround(time / simulation.setup().numerics.dt));
}

/// Until the kinetic energy falls below 1e-5 of that of the springs, no sooner than `shortest`, or until `longest`;
/// each sqrt(d/g) `look` is called. Whether it fell so far.
template <class Look>
bool rests_within(Simulation& simulation, double shortest, double longest, const Look& look) {
  for (double t = 0; t < longest; t += 1) {
    run_for(simulation, 1);
    look();
    const EnergyBalance energy = simulation.energy();
    if (t + 1 > shortest && energy.kinetic < 1e-5 * (energy.elastic + energy.tangential)) return true;
  }
  return false;
}

/// Height of the uppermost base grain's centre [d].
double make_base(Simulation& simulation, const InclineLayer& layer) {
  constexpr double slice = 1.7, solid = 0.6;
  Body floor;
  floor.surfaces.push_back({Plane{}, base});
  simulation.add_body(floor);
  simulation.set_gravity({0, 0, -1});
  pour(simulation, layer, base, 0, (layer.base_from + 1.5) * solid * 6 / pi, layer.seed);
  rests_within(simulation, 5, 60, [] {});
  simulation.remove_grains([&](const GrainNow& grain) {
    return grain.position.z > layer.base_from || grain.position.z <= layer.base_from - slice;
  });
  double top = 0;
  for (const GrainNow& grain : simulation.grains()) top = std::max(top, grain.position.z);
  simulation.hold_grains([](const GrainNow&) { return true; });
  return top;
}

/// The thickness that holds 98 % of the weight, over 0.98: each sphere's mass is spread over its height.
double thickness(const Simulation& simulation) {
  constexpr double cell = 0.02, kept_out = 0.01;
  std::vector<double> z;
  for (const Motion& grain : simulation.state().grains.motion)
    if (grain.radius > 0 && !grain.held()) z.push_back(grain.position.z);
  const auto [low, high] = std::minmax_element(z.begin(), z.end());
  const auto weight_above = [&](double at) {
    double sum = 0;
    for (const double middle : z) {
      const double t = std::clamp((at - middle) / r, -1.0, 1.0);
      sum += (1 - t) * (1 - t) * (2 + t) / 4;
    }
    return sum / static_cast<double>(z.size());
  };
  double bottom = *low - r, top = *high + r;
  while (weight_above(bottom) > 1 - kept_out) bottom += cell;
  while (weight_above(top) < kept_out) top -= cell;
  return (top - bottom) / (1 - 2 * kept_out);
}

double mean_speed(const Simulation& simulation) {
  double sum = 0;
  int count = 0;
  for (const Motion& grain : simulation.state().grains.motion)
    if (grain.radius > 0 && !grain.held()) sum += grain.velocity.x, ++count;
  return sum / count;
}

const double tan_1 = std::tan(17.561 * degree), tan_2 = std::tan(32.257 * degree);
constexpr double fitted_length = 3.836;

}  // namespace

InclineOutcome run_incline(const InclineLayer& layer) {
  check(layer);
  Simulation simulation = empty(layer);
  const double top = make_base(simulation, layer);
  pour(simulation, layer, loose, top + r, layer.layers, layer.seed + 1);
  simulation.set_gravity({std::sin(layer.angle), 0, -std::cos(layer.angle)});
  const double start = simulation.time();
  std::vector<double> thicknesses;
  InclineOutcome out;
  out.rests = rests_within(simulation, 10, layer.longest, [&] {
    out.speeds.push_back(mean_speed(simulation));
    thicknesses.push_back(thickness(simulation));
    if (layer.watch) layer.watch((simulation.time() - start) / layer.longest);
  });
  out.time = simulation.time() - start;
  if (out.rests) {
    out.thickness = thicknesses.back();
    return out;
  }
  const SteadyPart steady = steady_part({out.speeds});
  const auto tail = [&](const std::vector<double>& series) { return std::span(series).subspan(steady.from); };
  out.speed = mean_with_error(tail(out.speeds));
  out.thickness = mean_with_error(tail(thicknesses)).value;
  out.drift = steady.drift;
  return out;
}

AngleOfRest angle_of_rest(InclineLayer layer, double rests, double flows, double step) {
  AngleOfRest out{rests, flows};
  const auto rests_at = [&](double angle) {
    layer.angle = angle;
    const InclineOutcome now = run_incline(layer);
    if (now.rests) out.thickness = now.thickness;
    return now.rests;
  };
  if (!rests_at(rests) || rests_at(flows))
    throw InputError("the layer must rest at the lower angle, flow at the other");
  for (auto steps = std::lround((flows - rests) / step); steps > 1;) {
    const long half = steps / 2;
    const double middle = out.rests + static_cast<double>(half) * step;
    const bool lower = rests_at(middle);
    (lower ? out.rests : out.flows) = middle;
    steps = lower ? steps - half : half;
  }
  return out;
}

double stopping_angle(double thickness) { return std::atan(tan_1 + (tan_2 - tan_1) / (thickness / fitted_length + 1)); }

std::vector<VerificationRow> incline_rows(std::uint64_t seed, const std::function<void(const Progress&)>& progress) {
  struct Bracket {
    double layers, rests, flows;  // [deg]
  };
  std::vector<VerificationRow> rows;
  // Four or five layers a bracket, of which a layer that flows takes all its time and one that rests a tenth.
  constexpr double layers_in_all = 10;
  const auto began = std::chrono::steady_clock::now();
  double finished = 0, before = 0;
  const auto watch = [&](double share) {
    if (share < before) finished += 1;
    before = share;
    const double done = std::min(0.99, (finished + share) / layers_in_all);
    const double spent = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    if (progress) progress({"layers on a rough incline", done, spent * (1 - done) / done});
  };
  for (const Bracket& at : {Bracket{6, 22, 25}, Bracket{10, 20, 24}}) {
    InclineLayer layer;
    layer.watch = watch;
    layer.layers = at.layers;
    layer.seed = seed;
    layer.base_from = 5;
    const AngleOfRest found = angle_of_rest(layer, at.rests * degree, at.flows * degree, 0.5 * degree);
    rows.push_back({fmt::format("rough incline, {} layers, {:.3g} d thick: angle of rest", at.layers, found.thickness),
                    stopping_angle(found.thickness) / degree, (found.rests + found.flows) / 2 / degree, 0.75, "deg",
                    "Weinhart et al. 2012"});
  }
  return rows;
}

}  // namespace soilbin::dem
