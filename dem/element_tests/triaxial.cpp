#include "dem/element_tests/triaxial.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace soilbin::dem {
namespace {

void check(const TriaxialSettings& s) {
  const Requirements require("triaxial");
  require(s.side >= 4 && s.height >= 4,
          "the specimen must be at least 4 grains wide and high\n  hint: 10 grains and more along each side are sound");
  require(!s.stresses.empty() && std::all_of(s.stresses.begin(), s.stresses.end(), [](double p) { return p > 0; }),
          "confining stresses must be above 0");
  require(s.strain > 0 && s.strain < 0.8, "the axial strain must lie in 0 .. 0.8");
  require(s.packings >= 1 && s.packings <= 10000 && s.samples >= 20, "1 to 10000 packings, 20 samples or more");
  require(s.inertial >= 1e-7 && s.inertial <= 1, "the inertial number must lie in 1e-7 .. 1");
  require(s.residual_share > 0 && s.residual_share <= 1, "residual_share must lie in 0 .. 1");
}

double& component(Vec3& a, int axis) { return axis == 0 ? a.x : axis == 1 ? a.y : a.z; }

/// A specimen between six walls: those of axis k are bodies 2 k (lower) and 2 k + 1 (upper).
class PressedSpecimen {
 public:
  PressedSpecimen(const SettledBed& bed, const TriaxialSettings& settings, double stress, const WorkOptions& how,
                  SteppedWork& work)
      : settings_(settings), soil_(bed.recipe.soil), stress_(stress), work_(work), simulation_(setup_for(bed, how)) {
    const double top = put_grains(simulation_, bed);
    add_walls({bed.recipe.size.length, bed.recipe.size.width, top});
  }
  TriaxialRun run();

 private:
  Setup setup_for(const SettledBed& bed, const WorkOptions& how) const;
  void add_walls(const Vec3& size);
  double side(int axis) const;
  double area(int axis) const { return side((axis + 1) % 3) * side((axis + 2) % 3); }
  double stress(int axis) const;
  void step();
  void expect_sides_to_yield(double rate);
  void consolidate(TriaxialRun& run);
  void compress(TriaxialRun& run);
  void summarise(TriaxialRun& run) const;
  double work_of_walls() const;

  const TriaxialSettings& settings_;
  const GranularSoil& soil_;
  double stress_;
  SteppedWork& work_;
  Simulation simulation_;
  std::array<HeldForce, 6> held_;
};

Setup PressedSpecimen::setup_for(const SettledBed& bed, const WorkOptions& how) const {
  Setup setup = specimen_setup(bed, how);
  add_wall_material(setup, soil_, 0);
  setup.numerics.ledger = settings_.ledger;
  return setup;
}

void PressedSpecimen::add_walls(const Vec3& size) {
  static constexpr std::array<const char*, 6> names{"-x", "+x", "-y", "+y", "bottom", "top"};
  for (int wall = 0; wall < 6; ++wall) {
    Vec3 outward;
    component(outward, wall / 2) = wall % 2 == 0 ? -1 : 1;
    Body body;
    body.name = names[wall];
    body.surfaces.push_back({Plane{{}, -outward}, 1});
    Vec3 end = size;
    if (wall % 2 == 1) component(body.position, wall / 2) = component(end, wall / 2);
    simulation_.add_body(body);
  }
  for (int wall = 0; wall < 6; ++wall) {
    Vec3 outward;
    component(outward, wall / 2) = wall % 2 == 0 ? -1 : 1;
    if (wall != 4)  // the bottom stands
      simulation_.body(wall).servo = press(outward, stress_, area(wall / 2), soil_, simulation_.setup().numerics.dt);
  }
}

double PressedSpecimen::side(int axis) const {
  Vec3 across = simulation_.body(2 * axis + 1).position - simulation_.body(2 * axis).position;
  return component(across, axis);
}

double PressedSpecimen::stress(int axis) const {
  Vec3 low = simulation_.body(2 * axis).force, high = simulation_.body(2 * axis + 1).force;
  return (component(high, axis) - component(low, axis)) / (2 * area(axis));
}

/// One step, the servos aiming at the stress over the areas of now.
void PressedSpecimen::step() {
  for (int wall = 0; wall < 6; ++wall)
    if (auto& servo = simulation_.body(wall).servo) held_[wall].aim(*servo, stress_ * area(wall / 2));
  work_.step(simulation_);
  for (int wall = 0; wall < 6; ++wall)
    if (const auto& servo = simulation_.body(wall).servo)
      held_[wall].learn(dot(simulation_.body(wall).force, servo->direction));
}

/// The four sides give way as those of a specimen that keeps its volume, which is compressed at `rate` [1/s].
void PressedSpecimen::expect_sides_to_yield(double rate) {
  for (int wall = 0; wall < 4; ++wall) {
    Servo& servo = *simulation_.body(wall).servo;
    const double speed = rate / 4 * side(wall / 2);
    servo.fastest = std::max(servo.fastest, 4 * speed);
    held_[wall].expect(servo, speed);
  }
}

double PressedSpecimen::work_of_walls() const {
  double sum = 0;
  for (int wall = 0; wall < 6; ++wall) sum += simulation_.body(wall).work;
  return sum;
}

/// Until the mean stresses over 0.02 s are within 1 % three times in a row and no side changes by 1e-4 of itself.
void PressedSpecimen::consolidate(TriaxialRun& run) {
  work_.begin("consolidating");
  const auto steps = std::max<std::int64_t>(1, std::llround(0.02 / simulation_.setup().numerics.dt));
  const double begin = simulation_.time();
  for (int good = 0; good < 3;) {
    if (simulation_.time() - begin > 20)
      throw RunStopped(fmt::format("the specimen did not consolidate at {:.4g} Pa in 20 s: off by {:.2g}", stress_,
                                   run.isotropic_error));
    std::array<double, 3> mean{}, before{side(0), side(1), side(2)};
    for (std::int64_t k = 0; k < steps; ++k) {
      step();
      for (int axis = 0; axis < 3; ++axis) mean[axis] += stress(axis) / static_cast<double>(steps);
    }
    run.isotropic_error = 0;
    double moved = 0;
    for (int axis = 0; axis < 3; ++axis) {
      run.isotropic_error = std::max(run.isotropic_error, std::abs(mean[axis] / stress_ - 1));
      moved = std::max(moved, std::abs(side(axis) / before[axis] - 1));
    }
    good = run.isotropic_error < 0.01 && moved < 1e-4 ? good + 1 : 0;
  }
  const Vec3 low{simulation_.body(0).position.x, simulation_.body(2).position.y, 0};
  const double d = mean_diameter(soil_);
  const Vec3 margin{std::min(2 * d, side(0) / 4), std::min(2 * d, side(1) / 4), std::min(2 * d, side(2) / 4)};
  const Region core{low + margin, low + Vec3{side(0), side(1), side(2)} - margin};
  run.void_ratio = 1 / solid_fraction(simulation_.state().grains, core, d / 12) - 1;
}

void PressedSpecimen::compress(TriaxialRun& run) {
  work_.begin("compressing");
  const double dt = simulation_.setup().numerics.dt, height = side(2), volume = side(0) * side(1) * height;
  const double rate = shear_rate(settings_.inertial, stress_, soil_), speed = rate * height;
  expect_sides_to_yield(rate);
  simulation_.body(5).servo.reset();
  simulation_.body(5).velocity = {0, 0, -speed};
  const double way = height * (1 - std::exp(-settings_.strain)), before = work_of_walls();
  const double total = settings_.ledger ? simulation_.energy().total() : 0;
  const auto steps = steps_of_sample(way, speed * dt, settings_.samples);
  std::array<double, 2> lateral{};
  for (int k = 0; k < settings_.samples; ++k) {
    TriaxialSample sample;
    const std::array<double, 3> from{side(0), side(1), side(2)};
    const double volume_before = from[0] * from[1] * from[2];
    std::array<double, 3> mean{};
    for (std::int64_t i = 0; i < steps; ++i) {
      step();
      for (int axis = 0; axis < 3; ++axis) mean[axis] += stress(axis) / static_cast<double>(steps);
    }
    const double middle = std::sqrt(volume_before * side(0) * side(1) * side(2));
    for (int axis = 0; axis < 3; ++axis) run.work_of_stress += mean[axis] * std::log(from[axis] / side(axis)) * middle;
    sample.strain = std::log(height / std::sqrt(from[2] * side(2)));
    sample.volumetric = std::log(volume / middle);
    sample.lateral_x = mean[0], sample.lateral_y = mean[1], sample.axial = mean[2];
    lateral[0] += mean[0] / settings_.samples, lateral[1] += mean[1] / settings_.samples;
    run.curve.push_back(sample);
  }
  run.work = work_of_walls() - before;
  if (settings_.ledger) run.energy_error = (simulation_.energy().total() - total) / run.work;
  run.confining_error = std::max(std::abs(lateral[0] / stress_ - 1), std::abs(lateral[1] / stress_ - 1));
}

void PressedSpecimen::summarise(TriaxialRun& run) const {
  std::vector<double> strain, sine, confining;
  for (const TriaxialSample& sample : run.curve) {
    strain.push_back(sample.strain);
    sine.push_back(sample.sine());
    confining.push_back(sample.lateral());
  }
  const Mobilised found = peak_and_residual(strain, sine, settings_.peak_window, settings_.residual_share);
  run.peak = found.peak, run.residual = found.residual, run.peak_at = found.peak_at;
  run.confining = held_stress(confining, found, stress_);
  run.confining_error = std::max(run.confining_error, run.confining.error);
  // The rate of dilation is a slope, noisier than a mean: taken over five windows' width round the peak.
  const double half = 2.5 * settings_.peak_window;
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (const TriaxialSample& sample : run.curve)
    if (std::abs(sample.strain - run.peak_at) <= half) {
      const double x = sample.strain, y = sample.volumetric;
      n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
    }
  const double rate = (n * sxy - sx * sy) / (n * sxx - sx * sx);
  run.dilation_angle = n >= 2 ? std::asin(std::clamp(-rate / (2 - rate), -1.0, 1.0)) : 0;
}

TriaxialRun PressedSpecimen::run() {
  TriaxialRun out;
  out.stress = stress_;
  consolidate(out);
  compress(out);
  summarise(out);
  return out;
}

/// A line of Mohr's circles; none for a single stress. An error e of the sine is one of s e off the line, s = p/(1 -
/// sine), p the confining stress that was measured.
StrengthLine line_of(const std::vector<TriaxialRun>& runs, Estimate TriaxialRun::*strength, double HeldStress::*held) {
  std::vector<StrengthPoint> points;
  std::vector<std::uint64_t> packings;
  for (const TriaxialRun& run : runs) {
    packings.push_back(run.packing);
    const Estimate sine = run.*strength;
    const double s = run.confining.*held / (1 - sine.value);
    points.push_back({s, {s * sine.value, s * sine.std_error}});
  }
  return under_two_stresses(runs) ? fit_over_packings(points, packings, fit_circles) : StrengthLine{};
}

}  // namespace

TriaxialResult triaxial(const GranularSoil& soil, const TriaxialSettings& settings, const WorkOptions& how,
                        BedStore* beds) {
  check(settings);
  TriaxialResult result;
  const double d = result.mean_diameter = mean_diameter(soil);
  const BedSize size{settings.side * d, settings.side * d, settings.height * d};
  SteppedWork work(how);
  const double dt = settings.specimen.dt > 0 ? settings.specimen.dt : longest_step(soil);
  for (const double stress : settings.stresses)
    work.expect(settings.packings * (settings.strain / (shear_rate(settings.inertial, stress, soil) * dt) + 0.5 / dt));
  result.runs = on_packings(
      specimen_recipe(soil, size, settings.specimen), settings.packings, settings.stresses, how, beds,
      [&](const SettledBed& bed, double stress) { return PressedSpecimen(bed, settings, stress, how, work).run(); });
  result.peak = line_of(result.runs, &TriaxialRun::peak, &HeldStress::at_peak);
  result.residual = line_of(result.runs, &TriaxialRun::residual, &HeldStress::at_residual);
  return result;
}

}  // namespace soilbin::dem
