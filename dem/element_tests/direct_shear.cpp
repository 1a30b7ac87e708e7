#include "dem/element_tests/direct_shear.hpp"

#include <algorithm>
#include <cmath>

#include "dem/surface/shapes.hpp"

namespace soilbin::dem {
namespace {

void check(const DirectShearSettings& s) {
  const Requirements require("direct shear");
  require(s.length >= 4 && s.width >= 3 && s.height >= 4,
          "the box must be at least 4 x 3 x 4 grains\n  hint: 10 grains and more along each side are sound");
  require(!s.stresses.empty() && std::all_of(s.stresses.begin(), s.stresses.end(), [](double p) { return p > 0; }),
          "normal stresses must be above 0");
  require(s.travel > 0 && s.travel < s.length / 2, "the travel must be above 0 and less than half the box");
  require(s.packings >= 1 && s.packings <= 10000, "1 to 10000 packings");
  require(s.inertial >= 1e-7 && s.inertial <= 1, "the inertial number must lie in 1e-7 .. 1");
  require(s.residual_share > 0 && s.residual_share <= 1, "residual_share must lie in 0 .. 1");
  require(s.samples >= 20, "at least 20 samples");
}

/// One specimen in the box, under one stress.
class ShearBox {
 public:
  ShearBox(const SettledBed& bed, const DirectShearSettings& settings, double stress, const WorkOptions& how,
           SteppedWork& work)
      : settings_(settings),
        soil_(bed.recipe.soil),
        size_(bed.recipe.size),
        stress_(stress),
        d_(mean_diameter(soil_)),
        work_(work),
        simulation_(setup_for(bed, how)) {
    top_ = put_grains(simulation_, bed);
    add_bodies();
  }

  DirectShearRun run();

 private:
  Setup setup_for(const SettledBed& bed, const WorkOptions& how);
  void add_bodies();
  int add_half(const char* name, double low, double high);
  int add_planes(const char* name, const std::vector<Plane>& planes, int material);
  void step();
  double plane_area() const { return size_.width * (size_.length - simulation_.body(upper_).position.x); }
  ShearSample sample(std::int64_t steps, DirectShearRun& into);
  void summarise(DirectShearRun& run) const;
  Body& body(int index) { return simulation_.body(index); }

  const DirectShearSettings& settings_;
  const GranularSoil& soil_;
  const BedSize& size_;
  double stress_, d_, top_ = 0;
  int smooth_ = 0, rough_ = 0;
  SteppedWork& work_;
  Simulation simulation_;
  int floor_ = 0, sides_ = 0, lower_ = 0, upper_ = 0, lid_ = 0;
  HeldForce held_;
  double lid_before_ = 0;
  std::vector<double> imbalance_;
};

Setup ShearBox::setup_for(const SettledBed& bed, const WorkOptions& how) {
  Setup setup = specimen_setup(bed, how);
  smooth_ = add_wall_material(setup, soil_, 0);
  rough_ = add_gripping_material(setup, soil_);
  setup.numerics.ledger = settings_.ledger;
  return setup;
}

int ShearBox::add_planes(const char* name, const std::vector<Plane>& planes, int material) {
  Body out;
  out.name = name;
  for (const Plane& plane : planes) out.surfaces.push_back({plane, material});
  return simulation_.add_body(out);
}

/// Two end walls, so thick that their faces at the plane of shear stay under (or over) the other half's grains.
int ShearBox::add_half(const char* name, double low, double high) {
  const double thick = settings_.travel * d_ + 2 * d_;
  const TriangleMesh wall = box({thick, size_.width + 2 * d_, high - low});
  Body half;
  half.name = name;
  const double y = size_.width / 2, z = (low + high) / 2;
  half.surfaces.push_back({surface_at(wall, {-thick / 2, y, z}), smooth_});
  half.surfaces.push_back({surface_at(wall, {size_.length + thick / 2, y, z}), smooth_});
  return simulation_.add_body(half);
}

void ShearBox::add_bodies() {
  floor_ = add_planes("floor", {{{0, 0, 0}, {0, 0, 1}}}, rough_);
  sides_ = add_planes("sides", {{{0, 0, 0}, {0, 1, 0}}, {{0, size_.width, 0}, {0, -1, 0}}}, smooth_);
  lower_ = add_half("lower half", -d_, size_.depth / 2);
  upper_ = add_half("upper half", size_.depth / 2, top_ + 4 * d_);
  lid_ = add_planes("lid", {{{0, 0, 0}, {0, 0, -1}}}, rough_);
  simulation_.move_body(lid_, {0, 0, top_}, {});
  body(lid_).servo = press({0, 0, 1}, stress_, size_.length * size_.width, soil_, simulation_.setup().numerics.dt);
}

/// One step, the lid pressed so that what crosses the plane of shear is the stress on what is left of it.
void ShearBox::step() {
  held_.aim(*body(lid_).servo, stress_ * plane_area());
  work_.step(simulation_);
  held_.learn(body(lid_).force.z + body(lower_).force.z);
}

ShearSample ShearBox::sample(std::int64_t steps, DirectShearRun& into) {
  const double each = 1 / static_cast<double>(steps), dt = simulation_.setup().numerics.dt;
  const Vec3 lid_from = body(lid_).position;
  Vec3 on_lid, on_upper, on_lower, on_rest;
  for (std::int64_t k = 0; k < steps; ++k) {
    step();
    on_lid += each * body(lid_).force;
    on_upper += each * body(upper_).force;
    on_lower += each * body(lower_).force;
    on_rest += each * (body(floor_).force + body(sides_).force);
  }
  const double shear = -(on_lid.x + on_upper.x), normal = on_lid.z + on_lower.z;
  const double middle = body(upper_).position.x - 0.5 * static_cast<double>(steps) * dt * into.speed;
  const double area = size_.width * (size_.length - middle);
  into.work_of_stress +=
      shear * static_cast<double>(steps) * dt * into.speed - on_lid.z * (body(lid_).position.z - lid_from.z);
  imbalance_.push_back((on_lid + on_upper + on_lower + on_rest).x / shear);
  return {.displacement = middle,
          .shear_stress = shear / area,
          .normal_stress = normal / area,
          .dilation = (lid_from.z + body(lid_).position.z) / 2 - lid_before_};
}

DirectShearRun ShearBox::run() {
  DirectShearRun out;
  out.stress = stress_;
  work_.begin("pressing");
  work_.settle_wall(simulation_, lid_, size_.depth);
  lid_before_ = body(lid_).position.z;
  out.void_ratio = void_ratio_within(simulation_, size_, lid_before_);
  out.speed = shear_rate(settings_.inertial, stress_, soil_) * size_.depth;
  body(upper_).velocity.x = body(lid_).velocity.x = out.speed;

  work_.begin("shearing");
  const double before = settings_.ledger ? simulation_.energy().total() : 0;
  const double worked = body(lid_).work + body(upper_).work;
  const double dt = simulation_.setup().numerics.dt;
  const std::int64_t steps = steps_of_sample(settings_.travel * d_, out.speed * dt, settings_.samples);
  for (int k = 0; k < settings_.samples; ++k) out.curve.push_back(sample(steps, out));
  out.work = body(lid_).work + body(upper_).work - worked;
  if (settings_.ledger) out.energy_error = (simulation_.energy().total() - before) / out.work;
  summarise(out);
  return out;
}

void ShearBox::summarise(DirectShearRun& run) const {
  std::vector<double> ratio, way, normal;
  for (const ShearSample& sample : run.curve) {
    ratio.push_back(sample.shear_stress / sample.normal_stress);
    way.push_back(sample.displacement);
    normal.push_back(sample.normal_stress);
  }
  const Mobilised found = peak_and_residual(way, ratio, settings_.peak_window * d_, settings_.residual_share);
  run.peak = found.peak, run.residual = found.residual, run.peak_at = found.peak_at;
  run.normal = held_stress(normal, found, stress_);
  const auto from = static_cast<std::ptrdiff_t>(found.residual_from);
  double sum = 0;
  for (auto it = imbalance_.begin() + from; it != imbalance_.end(); ++it) sum += *it;
  run.imbalance = std::abs(sum) / static_cast<double>(imbalance_.end() - imbalance_.begin() - from);
}

/// A line through the strengths, at the normal stresses that were measured; none for a single stress.
StrengthLine line_of(const std::vector<DirectShearRun>& runs, Estimate DirectShearRun::*strength,
                     double HeldStress::*held) {
  std::vector<StrengthPoint> points;
  std::vector<std::uint64_t> packings;
  for (const DirectShearRun& run : runs) {
    packings.push_back(run.packing);
    const Estimate ratio = run.*strength;
    const double normal = run.normal.*held;
    points.push_back({normal, {normal * ratio.value, normal * ratio.std_error}});
  }
  return under_two_stresses(runs) ? fit_over_packings(points, packings, fit_strength) : StrengthLine{};
}

}  // namespace

DirectShearResult direct_shear(const GranularSoil& soil, const DirectShearSettings& settings, const WorkOptions& how,
                               BedStore* beds) {
  check(settings);
  DirectShearResult result;
  const double d = result.mean_diameter = mean_diameter(soil);
  const BedSize size{settings.length * d, settings.width * d, settings.height * d};
  SteppedWork work(how);
  const double dt = settings.specimen.dt > 0 ? settings.specimen.dt : longest_step(soil);
  for (const double stress : settings.stresses) {
    const double speed = shear_rate(settings.inertial, stress, soil) * size.depth;
    work.expect(settings.packings * (settings.travel * d / (speed * dt) + 0.5 / dt));
  }
  result.runs = on_packings(
      specimen_recipe(soil, size, settings.specimen), settings.packings, settings.stresses, how, beds,
      [&](const SettledBed& bed, double stress) { return ShearBox(bed, settings, stress, how, work).run(); });
  result.peak = line_of(result.runs, &DirectShearRun::peak, &HeldStress::at_peak);
  result.residual = line_of(result.runs, &DirectShearRun::residual, &HeldStress::at_residual);
  return result;
}

}  // namespace soilbin::dem
