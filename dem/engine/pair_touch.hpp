// Two grains that touch, one pair at a time: the Touch that the laws take. The kernels fill the same in packs.
//
//   const Touch<double> touch = touch_of_grains({a, wa}, {b, wb}, a.position - b.position, dt);
//   const Response<double> does = contact_response<double>(laws, constants, touch, memory, dt, nullptr);
#pragma once

#include "dem/engine/kernels/grain_rows.hpp"
#include "dem/engine/surface_contacts.hpp"

namespace soilbin::dem {

/// One of the two.
struct GrainMotion {
  const Motion& motion;
  const Spin& spin;
};

/// `between`: from the second's centre to the first's, in periodic bins the shortest [m]. dt [s].
inline Touch<double> touch_of_grains(const GrainMotion& first, const GrainMotion& second, const Vec3& between,
                                     double dt) {
  const Motion &a = first.motion, &b = second.motion;
  const Spin &wa = first.spin, &wb = second.spin;
  const Vec3 normal = unit(between);
  const double overlap = a.radius + b.radius - length(between);
  const Vec3 turn = (a.radius - overlap / 2) * wa.rate + (b.radius - overlap / 2) * wb.rate;
  return {.normal = triple(normal),
          .overlap = overlap,
          .radius = a.radius * b.radius / (a.radius + b.radius),
          .mass = 1 / (a.inverse_mass + b.inverse_mass),
          .velocity = triple(a.velocity - b.velocity - cross(turn, normal)),
          .rotation = triple(wa.rate - wb.rate),
          .inertia = 1 / (wa.inverse_inertia + wb.inverse_inertia),
          .turning = 0.5 * dot(wa.rate + wb.rate, normal),
          .before = triple(unit(between - dt * (a.velocity - b.velocity)))};
}

}  // namespace soilbin::dem
