// A small bed with everything in it that a restart has to keep, and all bits of a state.
#pragma once

#include <bit>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "dem/bed/insertion.hpp"
#include "dem/engine/simulation.hpp"
#include "dem/surface/shapes.hpp"
#include "tests/folder.hpp"

namespace soilbin::dem::test {

using soilbin::test::Folder;

inline std::string read_bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

inline Body floor_and_walls(const Vec3& size) {
  Body bin;
  bin.name = "bin";
  bin.surfaces = {
      {Plane{{0, 0, 0}, {0, 0, 1}}, 1}, {Plane{{0, 0, 0}, {1, 0, 0}}, 1}, {Plane{{size.x, 0, 0}, {-1, 0, 0}}, 1}};
  return bin;
}

/// Two materials, history in sliding and rolling, a side that is periodic, a bin of planes, a wheel that turns and is
/// pressed down by a servo, and a block of the same mesh that falls.
inline Simulation scene(int grains = 220, int threads = 1) {
  Setup setup;
  setup.materials.add({"sand", 2500, 5e6, 0.2}, {.restitution = 0.5,
                                                 .sliding_friction = 0.5,
                                                 .rolling_friction = 0.1,
                                                 .rolling_stiffness = 500,
                                                 .rolling_viscosity = 0.1});
  setup.materials.add({"rubber \xc3\xa9", 1100, 2e6, 0.45}, {.restitution = 0.3, .sliding_friction = 0.8});
  setup.laws.rolling = RollingLaw::spring_slider;
  setup.domain = {{-0.1, 0, -0.1}, {0.7, 0.3, 1.2}, {false, true, false}};
  setup.numerics.dt = 2e-5;
  setup.numerics.threads = threads;
  setup.numerics.ledger = true;
  setup.numerics.deepest_overlap = 0.5;
  setup.numerics.safe_share = 0.5;
  Simulation simulation(setup);
  simulation.set_gravity({0.3, 0, -9.81});
  simulation.add_body(floor_and_walls({0.6, 0.3, 1}));
  const auto mesh = std::make_shared<const TriangleMesh>(smooth_wheel(0.08, 0.2, 12));
  Body wheel;
  wheel.name = "wheel";
  wheel.surfaces = {{MeshSurface{mesh, nullptr}, 1}};
  wheel.position = {0.3, 0.15, 0.42};
  wheel.velocity = {0.2, 0, 0};
  wheel.spin = {0, 3, 0};
  wheel.servo = Servo{{0, 0, 1}, 5, 1e-4, 0.5};
  simulation.add_body(wheel);
  Body block = wheel;
  block.name = "block";
  block.servo.reset();
  block.position = {0.12, 0.15, 0.6};
  block.mass = 2;
  block.inertia = {0.01, 0.02, 0.01};
  block.free_translation = {true, true, true};
  block.turning = Turning::free;
  block.weighs = true;
  simulation.add_body(block);
  insert_loosely(simulation, {{0.0, 0.0, 0.0}, {0.6, 0.3, 0.32}}, {0.012, 0.02}, 0, grains, 7);
  simulation.add_grain({0.3, 0.1, 0.7}, 0.02, 1, {0.1, 0.2, -1}, {1, 2, 3});
  return simulation;
}

/// Every number of a state, in order.
class Bits {
 public:
  explicit Bits(const State& s) {
    add(s.step, s.time, s.gravity, s.travel, s.next_id);
    add_grains(s.grains);
    add_all(s.searched_at);
    add_all(s.slab_rows);
    add_all(s.new_grains);
    const PairList& p = s.pairs;
    add_all(p.first), add_all(p.second), add_all(p.kind), add_all(p.memory), add_all(p.touching), add_all(p.slab_begin);
    add(s.surfaces.size());
    for (const SurfaceContacts& slab : s.surfaces) add_surfaces(slab);
    for (const Body& body : s.bodies) add_body(body);
    const EnergyLosses& l = s.ledger;
    add(l.damping, l.shear_damping, l.sliding, l.into_slide, l.into_roll, l.adhesion, l.added);
  }
  bool operator==(const Bits&) const = default;
  std::size_t size() const { return bits_.size(); }

 private:
  void one(double a) { bits_.push_back(std::bit_cast<std::uint64_t>(a)); }
  void one(const Vec3& a) { one(a.x), one(a.y), one(a.z); }
  void one(const Triple<double>& a) { one(a.x), one(a.y), one(a.z); }
  template <class T>
  requires std::is_integral_v<T>
  void one(T a) { bits_.push_back(static_cast<std::uint64_t>(a)); }
  void one(const std::string& text) {
    for (const char c : text) one(static_cast<unsigned char>(c));
    one(text.size());
  }
  template <class... T>
  void add(const T&... all) {
    (one(all), ...);
  }
  void add_all(const auto& rows) {
    for (const auto& row : rows) one(row);
    one(rows.size());
  }
  void add_grains(const Grains& g) {
    for (const Motion& m : g.motion) add(m.position, m.radius, m.velocity, m.inverse_mass);  // idle rows too
    for (const Spin& w : g.spin) add(w.rate, w.inverse_inertia);
    for (const Load& l : g.load) add(l.force, l.torque);
    add_all(g.id), add_all(g.material);
    add(g.motion.size(), g.spin.size(), g.load.size());
  }
  void add_surfaces(const SurfaceContacts& slab) {
    for (const NearSurface& n : slab.near) add(n.grain, n.body, n.surface);
    for (const SurfaceContact& c : slab.made)
      add(c.who.grain, c.who.body, c.who.surface, c.triangle, c.normal, c.memory.slide, c.memory.roll);
    add(slab.near.size(), slab.made.size());
  }
  void add_body(const Body& b) {
    add(b.name, b.mass, b.inertia, b.free_translation[0], b.free_translation[1], b.free_translation[2],
        static_cast<int>(b.turning), b.axis, b.weighs, b.applied_force, b.applied_torque, b.position, b.velocity,
        b.spin, b.force, b.torque, b.work, b.driven_work, b.travel, b.servo.has_value());
    add(b.rotation.w, b.rotation.x, b.rotation.y, b.rotation.z);
    if (b.servo) add(b.servo->direction, b.servo->target, b.servo->gain, b.servo->fastest);
    for (const Surface& surface : b.surfaces) {
      add(surface.material, surface.shape.index());
      if (const auto* plane = std::get_if<Plane>(&surface.shape)) add(plane->point, plane->normal);
      if (const auto* mesh = std::get_if<MeshSurface>(&surface.shape)) {
        add(mesh->mesh->closed(), mesh->mesh->name());
        add_all(mesh->mesh->vertices());
        for (const auto& corners : mesh->mesh->triangles()) add(corners[0], corners[1], corners[2]);
      }
    }
  }

  std::vector<std::uint64_t> bits_;
};

}  // namespace soilbin::dem::test
