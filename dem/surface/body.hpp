// Rigid bodies: tire, plates, boxes, the floor. Each carries surfaces, is driven on some degrees of freedom and free on
// the others, and feels the grains.
//
//   Body plate{.name = "plate"};
//   plate.surfaces = {{MeshSurface{std::make_shared<TriangleMesh>(box({0.1, 0.1, 0.01})), nullptr}, 0}};  // [m]
//   plate.position = {0.5, 0.4, 0.35};   // [m]
//   plate.velocity = {0, 0, -0.01};      // [m/s]: pressed down at 10 mm/s, whatever the grains do
//   const int index = simulation.add_body(plate);
//   simulation.body(index).force.z       // [N] of the grains, after a run
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "dem/surface/triangle_grid.hpp"
#include "dem/surface/vec3.hpp"

namespace soilbin::dem {

/// An infinite plane in the body's frame; grains are on the side that `normal` (unit) points to.
struct Plane {
  Vec3 point, normal{0, 0, 1};
};

/// A mesh with its spatial index, shared by all who use it.
struct MeshSurface {
  std::shared_ptr<const TriangleMesh> mesh;
  std::shared_ptr<const TriangleGrid> grid;
};

struct Surface {
  std::variant<Plane, MeshSurface> shape;
  int material = 0;
};

/// How a body turns.
enum class Turning : std::uint8_t {
  prescribed,  ///< at `spin`, whatever acts on it
  about_axis,  ///< freely about `axis`, not about others
  free,        ///< freely
};

/// Moves a body along `direction` so that the grains' force on it there comes to `target`.
struct Servo {
  Vec3 direction{0, 0, 1};  ///< unit, from the grains toward the body
  double target = 0;        ///< force of the grains on the body along direction [N]
  double gain = 1e-6;       ///< speed a newton of error [m/(s N)]
  double fastest = 0.1;     ///< [m/s]
};

struct Body {
  std::string name;
  std::vector<Surface> surfaces;

  double mass = 1;        ///< [kg]; read where a translation is free
  Vec3 inertia{1, 1, 1};  ///< about the principal axes, the body's own x, y, z [kg m^2]
  std::array<bool, 3> free_translation{false, false, false};  ///< along x, y, z; else `velocity` is kept
  Turning turning = Turning::prescribed;
  Vec3 axis{0, 1, 0};   ///< unit, in the frame of the bin; of about_axis
  bool weighs = false;  ///< whether gravity pulls it
  std::optional<Servo> servo;
  Vec3 applied_force, applied_torque;  ///< on top of what the grains do [N], [N m]

  Vec3 position;  ///< of the origin of its frame, taken as its centre of mass [m]; in a run: Simulation::move_body
  Rotation rotation;
  Vec3 velocity, spin;     ///< at the half step [m/s], [rad/s]
  Vec3 force, torque;      ///< of the grains at the last step, torque about position
  double work = 0;         ///< done by this body on the grains since the start [J]
  double driven_work = 0;  ///< done on this body by what drives it and by what is applied, since the start [J]
  double travel = 0;       ///< bound on the way of its points since the last search [m]

  Vec3 to_body(const Vec3& point) const { return rotation.inverse()(point - position); }
  Vec3 to_bin(const Vec3& point) const { return position + rotation(point); }
  /// Velocity of the body's point that is now at `point` of the bin.
  Vec3 velocity_at(const Vec3& point) const { return velocity + cross(spin, point - position); }
};

/// `a` along the axes marked, zero along the others.
constexpr Vec3 where(const std::array<bool, 3>& yes, const Vec3& a) {
  return {yes[0] ? a.x : 0, yes[1] ? a.y : 0, yes[2] ? a.z : 0};
}

/// Throws InputError for what makes no sense: no mesh, directions that are not units, an unknown material of so many, a
/// mass or inertia that isn't positive, a place that is not finite, a servo along a direction that is free.
void check(const Body& body, int materials);

/// Kinetic energy of its free motion, of these velocities [J].
double free_energy(const Body& body, const Vec3& velocity, const Vec3& spin);

/// How its velocity and spin would change in a second under these loads and gravity, where they are free.
struct Acceleration {
  Vec3 velocity, spin;
};
Acceleration acceleration(const Body& body, const Vec3& force, const Vec3& torque, const Vec3& gravity);

/// One step of motion under body.force, body.torque, what is applied, and gravity.
void advance(Body& body, const Vec3& gravity, double dt);

/// Farthest distance of any of its mesh points from its position [m]; 0 without meshes, -1 with a plane, which has no
/// end.
double extent(const Body& body);

}  // namespace soilbin::dem
