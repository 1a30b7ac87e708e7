#include "dem/surface/body.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "dem/surface/positive.hpp"
#include "dem/surface/turning.hpp"
#include "scenario/errors.hpp"

namespace soilbin::dem {
namespace {

bool is_unit(const Vec3& a) { return std::abs(squared(a) - 1) < 1e-6; }

Vec3 momentum_of(const Body& body, const Vec3& spin) { return angular_momentum(body.rotation, body.inertia, spin); }

double inertia_about_axis(const Body& body) { return dot(body.axis, momentum_of(body, body.axis)); }

std::string name_of_body(const Body& body) { return body.name.empty() ? "a body without a name" : "body " + body.name; }

void follow(const Servo& servo, Body& body) {
  const double wanted = servo.gain * (dot(body.force, servo.direction) - servo.target);
  const double speed = std::clamp(wanted, -servo.fastest, servo.fastest);
  body.velocity += (speed - dot(body.velocity, servo.direction)) * servo.direction;
}

}  // namespace

void check(const Body& body, int materials) {
  const auto require = [&](bool holds, const char* what) {
    if (!holds) throw InputError(fmt::format("{}: {}", name_of_body(body), what));
  };
  const Vec3& inertia = body.inertia;
  require(positive(body.mass) && positive(inertia.x) && positive(inertia.y) && positive(inertia.z),
          "mass and inertia must be above 0");
  for (const Surface& surface : body.surfaces) {
    if (surface.material < 0 || surface.material >= materials)
      throw InputError(fmt::format("{}: there is no material {}", name_of_body(body), surface.material));
    const auto* plane = std::get_if<Plane>(&surface.shape);
    require(plane || std::get<MeshSurface>(surface.shape).mesh, "a surface has no mesh");
    require(!plane || is_unit(plane->normal), "a plane's normal must have length 1");
  }
  require(std::isfinite(squared(body.position)), "the position must be finite");
  const Rotation& q = body.rotation;
  require(std::abs(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z - 1) < 1e-6, "the rotation must have length 1");
  require(body.turning != Turning::about_axis || is_unit(body.axis), "the axis must have length 1");
  if (!body.servo) return;
  require(is_unit(body.servo->direction), "the servo's direction must have length 1");
  require(where(body.free_translation, body.servo->direction) == Vec3{}, "the servo moves it where it is free");
}

double free_energy(const Body& body, const Vec3& velocity, const Vec3& spin) {
  const double straight = 0.5 * body.mass * squared(where(body.free_translation, velocity));
  if (body.turning == Turning::prescribed) return straight;
  return straight + 0.5 * dot(spin, momentum_of(body, spin));
}

Acceleration acceleration(const Body& body, const Vec3& force, const Vec3& torque, const Vec3& gravity) {
  const Vec3 pull = (force + body.applied_force) / body.mass + (body.weighs ? gravity : Vec3{});
  Acceleration out{where(body.free_translation, pull), {}};
  const Vec3 turn = torque + body.applied_torque;
  if (body.turning == Turning::free) out.spin = spin_rate(body.rotation, body.inertia, body.spin, turn);
  if (body.turning == Turning::about_axis) out.spin = dot(turn, body.axis) / inertia_about_axis(body) * body.axis;
  return out;
}

void advance(Body& body, const Vec3& gravity, double dt) {
  const Vec3 before = body.velocity, spin_before = body.spin;
  const Acceleration change = acceleration(body, body.force, body.torque, gravity);
  body.velocity += dt * change.velocity;
  if (body.servo) follow(*body.servo, body);
  if (body.turning == Turning::free)
    body.spin = spin_after(body.rotation, body.inertia, body.spin, body.torque + body.applied_torque, dt);
  if (body.turning == Turning::about_axis) body.spin = dot(body.spin + dt * change.spin, body.axis) * body.axis;

  const Vec3 velocity = 0.5 * (before + body.velocity), spin = 0.5 * (spin_before + body.spin);
  body.work -= dt * (dot(body.force, velocity) + dot(body.torque, spin));
  const Vec3 free = where(body.free_translation, velocity), driven = velocity - free;
  const bool turns = body.turning != Turning::prescribed;
  body.driven_work += dt * (dot(body.applied_force, free) - dot(body.force, driven) +
                            dot(turns ? body.applied_torque : -body.torque, spin));
  body.position += dt * body.velocity;
  body.rotation = turned(body.rotation, dt * body.spin);
}

double extent(const Body& body) {
  double farthest = 0;
  for (const Surface& surface : body.surfaces)
    if (const auto* mesh = std::get_if<MeshSurface>(&surface.shape))
      for (const Vec3& vertex : mesh->mesh->vertices()) farthest = std::max(farthest, length(vertex));
    else
      return -1;
  return farthest;
}

}  // namespace soilbin::dem
