#include "dem/rig/wheel_in_bin.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "dem/rig/rut.hpp"
#include "scenario/errors.hpp"

namespace soilbin::dem {

WheelInBin::WheelInBin(const WheelOnBed& on, const OperatingCondition& at, const WorkOptions& how,
                       const Checkpoints& checkpoints, std::string inputs)
    : bed_(on.bed),
      tire_(on.tire),
      at_(at),
      rig_(on.rig),
      stance_(wheel_stance(at)),
      run_(checkpoints, std::move(inputs), how,
           [&] { return Simulation(setup_for(on.contact, how.threads), bed_.state); }) {
  run_.keep("bin", *this);
}

double WheelInBin::tilting() const {
  return at_.longitudinal_incline != 0 || at_.transverse_incline != 0 ? rig_.tilting : 0;
}

std::int64_t WheelInBin::steps_of(double time) const { return std::llround(time / simulation().setup().numerics.dt); }

Setup WheelInBin::setup_for(const ContactPair& tire_contact, int threads) const {
  Setup setup = bed_.setup;
  const int tire = setup.materials.add({"tire", 1100, rig_.young, rig_.poisson});
  setup.materials.set(grain_material, tire, interaction_of(tire_contact));
  setup.laws = with_cohesion_of(tire_contact, setup.laws);
  if (rig_.dt > 0) setup.numerics.dt = rig_.dt;
  setup.numerics.skin = rig_.skin * bed_.recipe.soil.radius_max;
  setup.numerics.threads = threads;
  setup.numerics.deepest_overlap = rig_.deepest_overlap;
  setup.numerics.ledger = rig_.ledger;
  const double g = bed_.recipe.gravity, d = mean_diameter(bed_.recipe.soil);
  setup.numerics.sleep = {rig_.sleep_speed * std::sqrt(g * d), rig_.sleep_time * std::sqrt(d / g)};
  return setup;
}

double way_in_bin(const BedSize& size, const Tire& tire, const Rig& rig) {
  const double room = size.length - rig.behind - rig.ahead;
  const double way = rig.travel > 0 ? std::min(rig.travel, room) : room;
  if (way <= 0)
    throw InputError(
        fmt::format("a bed of {:.4g} m leaves the wheel no way: "
                    "{:.4g} m behind and {:.4g} m ahead are kept"
                    "\n  hint: a longer bed",
                    size.length, rig.behind, rig.ahead));
  if (size.width < 1.4999 * tire.width)  // 150 mm is 1.5 times 100 mm, whatever rounding says
    throw InputError(
        fmt::format("a bed {:.4g} m wide is too narrow for a tire "
                    "of {:.4g} m: at least 1.5 times its width",
                    size.width, tire.width));
  return way;
}

void WheelInBin::tilt() {
  const std::int64_t steps = steps_of(tilting());
  run_.steps("tilting", steps, [&](std::int64_t k) {
    const double share = std::min(1.0, 1.5 * static_cast<double>(k + 1) / static_cast<double>(steps));
    OperatingCondition part = at_;
    part.longitudinal_incline *= share, part.transverse_incline *= share;
    simulation().set_gravity(-bed_.recipe.gravity * wheel_stance(part).up);
    step();
  });
}

double WheelInBin::free_height() const {
  const double rim = tire_.radius + tire_.lugs.height, y = bed_.recipe.size.width / 2;
  double z = 0;
  for (std::size_t k = 0; k < simulation().state().grains.count(); ++k) {
    const Vec3 from = simulation().state().grains.motion[k].position - Vec3{rig_.behind, y, 0};
    const double x = dot(from, stance_.heading), apart = rim + simulation().state().grains.motion[k].radius + wheel_gap;
    if (std::abs(dot(from, stance_.axle)) > tire_.width || std::abs(x) >= apart) continue;
    z = std::max(z, from.z + std::sqrt(apart * apart - x * x));
  }
  return z;
}

void WheelInBin::put_wheel() {
  run_.once([&] { put_body(); });
}

void WheelInBin::put_body() {
  const Grains& grains = simulation().state().grains;
  const double y = bed_.recipe.size.width / 2, radius = bed_.recipe.soil.radius_min;
  const Footprint track{rig_.behind, rig_.behind + way(), y - tire_.width / 2, y + tire_.width / 2};
  surface_ = surface_height(grains, track, radius / 4).mean();
  before_ = bed_surface(grains, bed_.recipe.size, radius);

  Body body;
  body.name = "wheel";
  body.surfaces.push_back({MeshSurface{std::make_shared<TriangleMesh>(tire_surface(tire_, rig_.meshing)), nullptr},
                           static_cast<int>(simulation().setup().materials.all.size()) - 1});
  body.mass = rig_.mass > 0 ? rig_.mass : at_.load / bed_.recipe.gravity;
  const double inertia = rig_.inertia > 0 ? rig_.inertia : body.mass * tire_.radius * tire_.radius / 2;
  body.inertia = {inertia, inertia, inertia};
  body.free_translation = {false, false, true};
  body.axis = stance_.axle;
  body.rotation = rotation_by({0, 0, at_.yaw});
  body.position = {rig_.behind, y, free_height()};
  wheel_ = simulation().add_body(body);
}

void WheelInBin::lower(const Vec3& force) {
  const std::int64_t ramp = steps_of(rig_.lowering), steps = ramp + steps_of(rig_.resting);
  const std::int64_t from = ramp + (steps - ramp) / 2;
  run_.once([&] { next_look_ = begin(), moment_at_rest_ = {}; });
  run_.steps("lowering", steps, [&](std::int64_t k) {
    const double share = k < ramp ? static_cast<double>(k + 1) / static_cast<double>(ramp) : 1.0;
    wheel().applied_force = share * force;
    step();
    if (k >= from) moment_at_rest_ += 1 / static_cast<double>(steps - from) * wheel().torque;
  });
}

void WheelInBin::begin_sample(std::int64_t steps) {
  show();
  sample_ = {
      .sum = {}, .steps = steps, .taken = 0, .begun = simulation().time(), .travel = travel(), .work = wheel().work};
}

void WheelInBin::step() {
  run_.step();
  if (!is_sampling()) return;
  ++sample_.taken;
  const double each = 1 / static_cast<double>(sample_.steps);
  WheelSample& sum = sample_.sum;
  const Body& now = wheel();
  sum.force += each * now.force;
  sum.moment += each * now.torque;
  sum.sinkage += each * sinkage();
  sum.speed += each * now.velocity.x;
  sum.heave += each * now.velocity.z;
  sum.rotation += each * dot(now.spin, stance_.axle);
}

WheelSample WheelInBin::end_sample() {
  WheelSample out = sample_.sum;
  if (!is_full()) {
    const double more = static_cast<double>(sample_.steps) / static_cast<double>(sample_.taken);
    out.force = more * out.force, out.moment = more * out.moment;
    for (double* mean : {&out.sinkage, &out.speed, &out.heave, &out.rotation}) *mean *= more;
  }
  out.time = simulation().time();
  out.travel = travel();
  out.into_soil = (wheel().work - sample_.work) / (out.time - sample_.begun);
  sample_ = {};
  return out;
}

void WheelInBin::show() {
  if (!rig_.onlooker.look || wheel().position.x < next_look_) return;
  rig_.onlooker.look(simulation(), wheel_, surface_);
  next_look_ += rig_.onlooker.every;
}

}  // namespace soilbin::dem
