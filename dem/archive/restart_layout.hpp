// What a restart holds, said once: Saver writes by it, Loader reads by it. Each struct is taken apart by all its
// members, so one that gets another member doesn't compile until it is described here.
#pragma once

#include <span>
#include <string>

#include "dem/archive/save_load.hpp"
#include "dem/engine/simulation.hpp"

namespace soilbin::dem {

inline constexpr std::array normal_names{"hertz", "hooke"};
inline constexpr std::array rolling_names{"none",          "directional_with_twist", "elastic_plastic",
                                          "spring_slider", "torsion_spring",         "directional"};
inline constexpr std::array twisting_names{"none", "marshall"};
inline constexpr std::array cohesion_names{"none", "linear", "jkr"};
inline constexpr std::array turning_names{"prescribed", "about_axis", "free"};

template <class Archive, class T>
void describe_numerics(const Archive& a, T& numerics) {
  auto& [dt, skin, deepest_overlap, safe_share, force_step, threads, instruction_set, ledger, sleep] = numerics;
  a.value("dt", dt);
  a.value("skin", skin);
  a.value("deepest_overlap", deepest_overlap);
  a.value("safe_share", safe_share);
  a.value("force_step", force_step);
  a.value("threads", threads);
  a.text("instruction_set", instruction_set);
  a.value("ledger", ledger);
  auto& [speed, time] = sleep;
  a.value("sleep_speed", speed);
  a.value("sleep_time", time);
}

template <class Archive, class T>
void describe_material(const Archive& a, T& material) {
  auto& [name, density, young, poisson] = material;
  a.text("name", name);
  a.value("density", density);
  a.value("young", young);
  a.value("poisson", poisson);
}

template <class Archive, class T>
void describe_interaction(const Archive& a, T& interaction) {
  auto& [restitution, sliding_friction, rolling_friction, rolling_damping, rolling_stiffness, rolling_viscosity,
         cohesion, normal_stiffness, shear_stiffness] = interaction;
  a.value("restitution", restitution);
  a.value("sliding_friction", sliding_friction);
  a.value("rolling_friction", rolling_friction);
  a.value("rolling_damping", rolling_damping);
  a.value("rolling_stiffness", rolling_stiffness);
  a.value("rolling_viscosity", rolling_viscosity);
  a.value("cohesion", cohesion);
  a.value("normal_stiffness", normal_stiffness);
  a.value("shear_stiffness", shear_stiffness);
}

template <class Archive, class T>
void describe_setup(const Archive& a, T& setup) {
  auto& [materials, laws, domain, numerics] = setup;
  auto& [all, interactions] = materials;
  const auto of_materials = a.inner("materials");
  of_materials.length("count", all);
  for (std::size_t k = 0; k < all.size(); ++k) describe_material(of_materials.inner(std::to_string(k)), all[k]);
  const auto of_pairs = a.inner("interactions");
  of_pairs.length("count", interactions);
  for (std::size_t k = 0; k < interactions.size(); ++k)
    describe_interaction(of_pairs.inner(std::to_string(k)), interactions[k]);

  static_assert(sizeof(ContactLaws) == 16 && sizeof(LawFlags) == 4);
  const auto of_laws = a.inner("laws");
  of_laws.choice("normal", laws.normal, normal_names);
  of_laws.choice("rolling", laws.rolling, rolling_names);
  of_laws.choice("cohesion", laws.cohesion, cohesion_names);
  of_laws.choice("twisting", laws.twisting, twisting_names);
  of_laws.value("tangential_damping", laws.tangential_damping);

  auto& [lower, upper, periodic] = domain;
  const auto of_domain = a.inner("domain");
  of_domain.value("lower", lower);
  of_domain.value("upper", upper);
  of_domain.value("periodic", periodic);
  describe_numerics(a.inner("numerics"), numerics);
}

/// What H5MD knows of grains. Velocities are those of the half step before, and so is their time. `rows` of each array
/// are grains.
template <class Archive, class T>
void describe_particles(const Archive& a, T& grains, std::int64_t step, double time, double dt) {
  const std::span motion(grains.motion.data(), grains.count());
  a.element(
      "position", motion, [](auto& row) -> auto& { return row.position; }, step, time, "m");
  a.element(
      "velocity", motion, [](auto& row) -> auto& { return row.velocity; }, step, time - dt / 2, "m s-1");
  a.element(
      "radius", motion, [](auto& row) -> auto& { return row.radius; }, step, time, "m");
  a.element("id", grains.id, itself, step, time);
  a.element("species", grains.material, itself, step, time);
}

template <class Archive, class T>
void describe_grains(const Archive& a, T& grains) {
  auto& [motion, spin, load, id, material, clump] = grains;  // clump: with the clumps, where there are any
  static_assert(sizeof(Motion) == 64 && sizeof(Spin) == 32);
  const std::span motions(motion.data(), id.size()), spins(spin.data(), id.size()), loads(load.data(), id.size());
  a.column(
      "inverse_mass", motions, [](auto& row) -> auto& { return row.inverse_mass; }, "kg-1");
  a.column(
      "rate", spins, [](auto& row) -> auto& { return row.rate; }, "rad s-1");
  a.column(
      "inverse_inertia", spins, [](auto& row) -> auto& { return row.inverse_inertia; }, "kg-1 m-2");
  a.column(
      "force", loads, [](auto& row) -> auto& { return row.force; }, "N");
  a.column(
      "torque", loads, [](auto& row) -> auto& { return row.torque; }, "N m");
}

template <class Archive, class T>
void describe_pairs(const Archive& a, T& pairs) {
  auto& [first, second, kind, memory, touching, slab_begin] = pairs;
  a.length("pairs", first, "first");
  a.length("second", second, "second");
  a.length("kinds", kind, "kind");
  a.length("numbers", memory, "memory");
  a.length("batches", touching, "touching");
  a.length("slabs", slab_begin, "slab_begin");
  a.column("first", first, itself);
  a.column("second", second, itself);
  a.column("kind", kind, itself);
  a.column("memory", memory, itself);
  a.column("touching", touching, itself);
  a.column("slab_begin", slab_begin, itself);
}

/// SurfaceContacts of all slabs, one after the other.
struct FlatSurfaces {
  std::vector<std::uint32_t> near_begin, made_begin;  ///< of each slab, and the end
  std::vector<NearSurface> near;
  std::vector<SurfaceContact> made;
};

template <class Archive, class Rows, class Project>
void describe_who(const Archive& a, Rows& rows, const Project& who) {
  static_assert(sizeof(NearSurface) == 8);
  a.column(
      "grain", rows, [&](auto& row) -> auto& { return who(row).grain; });
  a.column(
      "body", rows, [&](auto& row) -> auto& { return who(row).body; });
  a.column(
      "surface", rows, [&](auto& row) -> auto& { return who(row).surface; });
}

template <class Archive, class T>
void describe_surfaces(const Archive& a, T& flat) {
  auto& [near_begin, made_begin, near, made] = flat;
  a.length("slabs", near_begin, "near_begin");
  a.length("slabs_made", made_begin, "made_begin");
  a.length("count_near", near, "near/grain");
  a.length("count_made", made, "made/grain");
  a.column("near_begin", near_begin, itself);
  a.column("made_begin", made_begin, itself);
  describe_who(a.inner("near"), near, itself);
  const auto of_made = a.inner("made");
  static_assert(sizeof(SurfaceContact) == 88);
  describe_who(
      of_made, made, [](auto& row) -> auto& { return row.who; });
  of_made.column(
      "triangle", made, [](auto& row) -> auto& { return row.triangle; });
  of_made.column(
      "normal", made, [](auto& row) -> auto& { return row.normal; });
  of_made.column(
      "slide", made, [](auto& row) -> auto& { return row.memory.slide; }, "m");
  of_made.column(
      "roll", made, [](auto& row) -> auto& { return row.memory.roll; }, "rad");
}

/// A surface with its mesh by number: -1 for a plane.
struct FlatSurface {
  Plane plane;
  std::int32_t mesh = -1, material = 0;
};

template <class Archive, class T>
void describe_flat(const Archive& a, T& surfaces) {
  static_assert(sizeof(FlatSurface) == 56 && sizeof(Plane) == 48);
  a.length("count", surfaces, "point");
  a.column(
      "point", surfaces, [](auto& row) -> auto& { return row.plane.point; }, "m");
  a.column(
      "normal", surfaces, [](auto& row) -> auto& { return row.plane.normal; });
  a.column(
      "mesh", surfaces, [](auto& row) -> auto& { return row.mesh; });
  a.column(
      "material", surfaces, [](auto& row) -> auto& { return row.material; });
}

template <class Archive, class T>
void describe_servo(const Archive& a, T& servo) {
  auto& [direction, target, gain, fastest] = servo;
  a.value("direction", direction);
  a.value("target", target);
  a.value("gain", gain);
  a.value("fastest", fastest);
}

/// All but its surfaces.
template <class Archive, class T>
void describe_body(const Archive& a, T& body) {
  auto& [name, surfaces, mass, inertia, free_translation, turning, axis, weighs, servo, applied_force, applied_torque,
         position, rotation, velocity, spin, force, torque, work, driven_work, travel] = body;
  a.text("name", name);
  a.value("mass", mass);
  a.value("inertia", inertia);
  a.value("free_translation", free_translation);
  a.choice("turning", turning, turning_names);
  a.value("axis", axis);
  a.value("weighs", weighs);
  bool driven = servo.has_value();
  a.value("driven_by_servo", driven);
  if constexpr (Archive::loads)
    if (driven) servo.emplace();
  if (driven) describe_servo(a.inner("servo"), *servo);
  a.value("applied_force", applied_force);
  a.value("applied_torque", applied_torque);
  a.value("position", position);
  a.value("rotation", rotation);
  a.value("velocity", velocity);
  a.value("spin", spin);
  a.value("force", force);
  a.value("torque", torque);
  a.value("work", work);
  a.value("driven_work", driven_work);
  a.value("travel", travel);
}

template <class Archive, class T>
void describe_ledger(const Archive& a, T& ledger) {
  auto& [damping, shear_damping, sliding, into_slide, into_roll, adhesion, added] = ledger;
  a.value("damping", damping);
  a.value("shear_damping", shear_damping);
  a.value("sliding", sliding);
  a.value("into_slide", into_slide);
  a.value("into_roll", into_roll);
  a.value("adhesion", adhesion);
  a.value("added", added);
}

/// Written where there are any, with the clump of each grain.
template <class Archive, class C, class G>
void describe_clumps(const Archive& a, C& clumps, G& clump_of_grain) {
  auto& [all, members] = clumps;
  static_assert(sizeof(Clump) == 144 && sizeof(ClumpMember) == 40);
  a.column("of_grain", clump_of_grain, itself);
  a.length("count", all, "mass");
  a.length("spheres", members, "id");
  a.column(
      "mass", all, [](auto& row) -> auto& { return row.mass; }, "kg");
  a.column(
      "inertia", all, [](auto& row) -> auto& { return row.inertia; }, "kg m2");
  a.column(
      "position", all, [](auto& row) -> auto& { return row.motion.position; }, "m");
  a.column(
      "rotation", all, [](auto& row) -> auto& { return row.motion.rotation; });
  a.column(
      "velocity", all, [](auto& row) -> auto& { return row.motion.velocity; }, "m s-1");
  a.column(
      "spin", all, [](auto& row) -> auto& { return row.motion.spin; }, "rad s-1");
  a.column(
      "first", all, [](auto& row) -> auto& { return row.first; });
  a.column(
      "spheres_of", all, [](auto& row) -> auto& { return row.count; });
  a.column(
      "id", members, [](auto& row) -> auto& { return row.id; });
  a.column(
      "arm", members, [](auto& row) -> auto& { return row.arm; }, "m");
  a.column(
      "row", members, [](auto& row) -> auto& { return row.row; });
}

/// All but particles, bodies, surfaces and clumps.
template <class Archive, class T>
void describe_state(const Archive& a, T& state) {
  auto& [step, time, gravity, grains, bodies, pairs, slab_rows, surfaces, calm, body_loads, searched_at, travel,
         next_id, new_grains, ledger, clumps] = state;
  a.value("step", step);
  a.value("time", time);
  a.value("gravity", gravity);
  a.value("travel", travel);
  a.value("next_id", next_id);
  a.length("bodies", bodies);
  a.length("searched", searched_at, "searched_at");
  a.length("slabs", slab_rows, "slab_rows");
  a.length("fresh", new_grains, "new_grains");
  a.column("searched_at", searched_at, itself, "m");
  a.column("slab_rows", slab_rows, itself);
  a.column("new_grains", new_grains, itself);
  a.length("slabs_calm", calm, "calm");
  a.length("body_loads", body_loads, "body_loads_by_slab/force");
  a.column("calm", calm, itself);
  static_assert(sizeof(BodyLoad) == 48);
  const auto of_loads = a.inner("body_loads_by_slab");
  of_loads.column(
      "force", body_loads, [](auto& row) -> auto& { return row.force; }, "N");
  of_loads.column(
      "torque", body_loads, [](auto& row) -> auto& { return row.torque; }, "N m");
  describe_pairs(a.inner("pairs"), pairs);
  describe_ledger(a.inner("ledger"), ledger);
}

}  // namespace soilbin::dem
