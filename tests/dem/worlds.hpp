// Small worlds that several tests of the engine share.
#pragma once

#include <cstring>
#include <string>
#include <vector>

#include "dem/bed/random.hpp"
#include "dem/engine/simulation.hpp"
#include "dem/surface/shapes.hpp"

namespace soilbin::dem::test {

/// Each combination of laws that the engine takes.
inline std::vector<ContactLaws> all_laws() {
  std::vector<ContactLaws> laws;
  for (const auto normal : {NormalLaw::hertz, NormalLaw::hooke})
    for (const auto rolling : {RollingLaw::none, RollingLaw::directional, RollingLaw::directional_with_twist,
                               RollingLaw::elastic_plastic, RollingLaw::spring_slider, RollingLaw::torsion_spring})
      for (const auto cohesion : {CohesionLaw::none, CohesionLaw::linear, CohesionLaw::jkr})
        if (normal == NormalLaw::hertz || cohesion != CohesionLaw::jkr)
          laws.push_back({{normal, rolling, cohesion}, -1});
  for (const auto cohesion : {CohesionLaw::none, CohesionLaw::linear, CohesionLaw::jkr})
    laws.push_back({{NormalLaw::hertz, RollingLaw::elastic_plastic, cohesion, TwistingLaw::marshall}, -1});
  for (const auto rolling : {RollingLaw::none, RollingLaw::spring_slider})
    laws.push_back({{NormalLaw::hooke, rolling, CohesionLaw::none, TwistingLaw::marshall}, -1});
  return laws;
}

inline std::string name_of(const LawFlags& laws) {
  const char* normal[] = {"hertz", "hooke"};
  const char* rolling[] = {"none",          "directional_with_twist", "elastic_plastic",
                           "spring_slider", "torsion_spring",         "directional"};
  const char* cohesion[] = {"none", "linear", "jkr"};
  return std::string(normal[static_cast<int>(laws.normal)]) + ' ' + rolling[static_cast<int>(laws.rolling)] + ' ' +
         cohesion[static_cast<int>(laws.cohesion)] + (laws.twisting == TwistingLaw::marshall ? " marshall" : "");
}

/// What every law needs, in one interaction; grains of about a centimetre.
inline Interaction every_law() {
  return {.restitution = 0.6,
          .sliding_friction = 0.4,
          .rolling_friction = 0.1,
          .rolling_damping = 0.3,
          .rolling_stiffness = 100,
          .rolling_viscosity = 0.1,
          .cohesion = 0.5,
          .normal_stiffness = 2e4,
          .shear_stiffness = 1e4};
}

inline Setup soft_stone(const ContactLaws& laws = {}, Interaction interaction = every_law()) {
  Setup setup;
  // As a torsion_spring's, 100 N m/rad would swing a grain faster than the time step can follow.
  if (laws.rolling == RollingLaw::torsion_spring) interaction.rolling_stiffness = 0.01;
  setup.materials.add({"stone", 2500, 5e6, 0.25}, interaction);
  setup.laws = laws;
  setup.numerics.dt = 1e-5;
  setup.numerics.deepest_overlap = 0.9;
  setup.numerics.threads = 1;
  return setup;
}

/// Six planes round the cuboid from `low` to `high`, as one body.
inline Body box_of_planes(const Vec3& low, const Vec3& high, int material = 0) {
  Body box;
  box.name = "box";
  const Vec3 normals[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const Vec3& normal : normals) {
    box.surfaces.push_back({Plane{low, normal}, material});
    box.surfaces.push_back({Plane{high, -normal}, material});
  }
  return box;
}

inline Body mesh_body(TriangleMesh mesh, int material = 0) {
  Body body;
  body.name = mesh.name();
  body.surfaces.push_back({MeshSurface{std::make_shared<TriangleMesh>(std::move(mesh)), nullptr}, material});
  return body;
}

struct Grain {
  Vec3 position, velocity, spin;
  double radius;
};

inline Vec3 any(Random& random, double size) {
  const double x = random.uniform(-size, size), y = random.uniform(-size, size);
  return {x, y, random.uniform(-size, size)};
}

/// `count` grains of several sizes on a cubic lattice of n x n x .. places, somewhat apart, thrown at random and toward
/// the middle.
inline std::vector<Grain> cloud(int count, int n, double speed, std::uint64_t seed = 1) {
  std::vector<Grain> grains;
  Random random(seed);
  const double place = 0.022;
  const Vec3 middle = 0.5 * place * Vec3{n - 1.0, n - 1.0, count / double(n * n) - 1};
  for (int k = 0; k < count; ++k) {
    const Vec3 at = place * Vec3{double(k % n), double(k / n % n), double(k / (n * n))};
    const double radius = random.uniform(0.007, 0.01);
    const Vec3 position = at + any(random, 0.001);
    const Vec3 inward = (middle - at) * (speed / (place * n));
    grains.push_back({position, inward + any(random, speed), any(random, 30 * speed), radius});
  }
  return grains;
}

inline void add(Simulation& simulation, const std::vector<Grain>& grains) {
  for (const Grain& g : grains) simulation.add_grain(g.position, g.radius, 0, g.velocity, g.spin);
}

inline void mix(std::uint64_t& hash, const void* data, std::size_t bytes) {
  for (std::size_t k = 0; k < bytes; ++k) {
    hash ^= static_cast<const unsigned char*>(data)[k];
    hash *= 0x100000001b3;
  }
}

/// FNV-1a over the bits of all that moves or is remembered.
inline std::uint64_t bits(const State& state) {
  std::uint64_t hash = 0xcbf29ce484222325;
  const auto take = [&](const auto& rows) { mix(hash, rows.data(), rows.size() * sizeof(rows[0])); };
  take(state.grains.motion);
  take(state.grains.spin);
  take(state.grains.id);
  take(state.pairs.first);
  take(state.pairs.memory);
  take(state.pairs.touching);
  for (const SurfaceContacts& slab : state.surfaces)
    for (const SurfaceContact& c : slab.made) {
      mix(hash, &c.normal, sizeof(c.normal));
      mix(hash, &c.memory, sizeof(c.memory));
    }
  for (const Body& body : state.bodies)
    for (const Vec3& v : {body.position, body.velocity, body.spin, body.force, body.torque}) mix(hash, &v, sizeof(v));
  take(state.calm);
  take(state.body_loads);
  mix(hash, &state.travel, sizeof(state.travel));
  mix(hash, &state.ledger, sizeof(state.ledger));
  return hash;
}

}  // namespace soilbin::dem::test
