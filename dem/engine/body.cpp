#include "dem/engine/body.hpp"

#include <algorithm>

namespace soilbin::dem {
namespace {

Vec3 times(const Vec3& a, const Vec3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
Vec3 over(const Vec3& a, const Vec3& b) { return {a.x / b.x, a.y / b.y, a.z / b.z}; }

/// Euler's equations in the body's frame.
Vec3 angular_acceleration(const Vec3& inertia, const Vec3& spin, const Vec3& torque) {
  return over(torque - cross(spin, times(inertia, spin)), inertia);
}

void turn_freely(Body& body, const Vec3& torque, double dt) {
  const Rotation back = body.rotation.inverse();
  const Vec3 spin = back(body.spin), moment = back(torque);
  const Vec3 middle = spin + (dt / 2) * angular_acceleration(body.inertia, spin, moment);
  body.spin = body.rotation(spin + dt * angular_acceleration(body.inertia, middle, moment));
}

void turn_about_axis(Body& body, const Vec3& torque, double dt) {
  const Vec3 axis = body.rotation.inverse()(body.axis);
  const double inertia = dot(axis, times(body.inertia, axis));
  body.spin = (dot(body.spin, body.axis) + dt * dot(torque, body.axis) / inertia) * body.axis;
}

void follow(const Servo& servo, Body& body) {
  const double wanted = servo.gain * (dot(body.force, servo.direction) - servo.target);
  const double speed = std::clamp(wanted, -servo.fastest, servo.fastest);
  body.velocity += (speed - dot(body.velocity, servo.direction)) * servo.direction;
}

}  // namespace

void advance(Body& body, const Vec3& gravity, double dt) {
  const Vec3 before = body.velocity, spin_before = body.spin;
  const Vec3 pull = body.force + body.applied_force + (body.weighs ? body.mass * gravity : Vec3{});
  const Vec3 change = (dt / body.mass) * pull;
  if (body.free_translation[0]) body.velocity.x += change.x;
  if (body.free_translation[1]) body.velocity.y += change.y;
  if (body.free_translation[2]) body.velocity.z += change.z;
  if (body.servo) follow(*body.servo, body);
  const Vec3 torque = body.torque + body.applied_torque;
  if (body.turning == Turning::free) turn_freely(body, torque, dt);
  if (body.turning == Turning::about_axis) turn_about_axis(body, torque, dt);

  body.work -=
      dt * (dot(body.force, 0.5 * (before + body.velocity)) + dot(body.torque, 0.5 * (spin_before + body.spin)));
  body.position += dt * body.velocity;
  if (body.spin != Vec3{}) {
    const Rotation q = rotation_by(dt * body.spin) * body.rotation;
    const double size = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    body.rotation = {q.w / size, q.x / size, q.y / size, q.z / size};
  }
}

double extent(const Body& body) {
  double farthest = 0;
  for (const Surface& surface : body.surfaces)
    if (const auto* mesh = std::get_if<MeshSurface>(&surface.shape))
      for (const Vec3& vertex : mesh->mesh->vertices()) farthest = std::max(farthest, length(vertex));
  return farthest;
}

}  // namespace soilbin::dem
