#include "dem/bed/bed_store.hpp"

#include <fmt/core.h>

#include <cmath>
#include <optional>
#include <variant>

#include "dem/archive/restart.hpp"
#include "dem/archive/sealed_file.hpp"
#include "dem/bed/grain_shape.hpp"
#include "dem/surface/mass_properties.hpp"
#include "dem/surface/positive.hpp"
#include "scenario/checksum.hpp"
#include "scenario/errors.hpp"
#include "scenario/file_bytes.hpp"
#include "scenario/quantity.hpp"

namespace soilbin::dem {
namespace {

/// To be raised when the same recipe gives another bed than before.
constexpr int version = 2;
constexpr int graded_version = 2;  // 1: small grains were put in more often than large ones

constexpr const char* recipe_note = "bed_recipe";
constexpr const char* time_note = "settling_time";

[[noreturn]] void refuse_bed(const std::filesystem::path& file, const char* why) {
  throw InputError({file.string(), 0, 0}, why);
}

/// Whether the state is one of grains of the recipe, at rest in its bin.
bool is_bed_of(const State& state, const BedRecipe& recipe, const Setup& setup) {
  const GrainProportions of = proportions_of(recipe.soil);
  constexpr double rounding = 1e-9;
  const bool lone_spheres = recipe.soil.shape == GrainShape::sphere;
  const double smallest = of.sphere * recipe.soil.radius_min * (1 - rounding),
               largest = of.sphere * recipe.grading.factor * recipe.soil.radius_max * (1 + rounding);
  const double spheres = static_cast<double>(state.grains.count()) / spheres_of(recipe.soil.shape);
  if (state.grains.count() == 0 || spheres > 1.1 * expected_grains(recipe) + 100) return false;
  Domain room = setup.domain;
  if (recipe.periodic)  // a grain is brought back by the other side at the next search
    room.lower.x -= largest, room.upper.x += largest;
  for (std::size_t k = 0; k < state.grains.count(); ++k) {
    const Motion& grain = state.grains.motion[k];
    if (!room.contains(grain.position) || grain.radius < smallest || grain.radius > largest ||
        (lone_spheres &&
         !(std::abs(grain.inverse_mass * sphere_mass(recipe.soil.grain_density, grain.radius) - 1) < rounding)) ||
        !is_finite(grain.velocity) || !is_finite(state.grains.spin[k].rate))
      return false;
  }
  const Body bin = bin_of(recipe.size, recipe.periodic);
  if (state.bodies.size() != 1 || state.bodies[bin_body].surfaces.size() != bin.surfaces.size()) return false;
  for (std::size_t k = 0; k < bin.surfaces.size(); ++k) {
    const auto* plane = std::get_if<Plane>(&state.bodies[bin_body].surfaces[k].shape);
    const Plane& right = std::get<Plane>(bin.surfaces[k].shape);
    if (plane == nullptr || plane->point != right.point || plane->normal != right.normal) return false;
  }
  return state.gravity == Vec3{0, 0, -recipe.gravity};
}

/// The bed in a file. Its setup follows from the recipe, whatever the file says. Throws InputError where it isn't the
/// recipe's.
SettledBed bed_in(const std::filesystem::path& file, const BedRecipe& recipe, const WorkOptions& how) {
  Restart restart = read_restart(file);
  const auto text = restart.notes.find(recipe_note), time = restart.notes.find(time_note);
  if (text == restart.notes.end() || text->second != recipe_text(recipe) || time == restart.notes.end())
    refuse_bed(file, "is the bed of another recipe");
  const std::optional<double> seconds = read_number(time->second);
  SettledBed bed{
      .recipe = recipe, .setup = setup_of(recipe, how.threads), .state = std::move(restart.state), .report = {}};
  if (!seconds || !(*seconds >= 0) || restart.setup.numerics.dt != bed.setup.numerics.dt ||
      restart.setup.domain != bed.setup.domain || !is_bed_of(bed.state, recipe, bed.setup))
    refuse_bed(file, "is not the bed that its recipe gives");
  bed.report = report_on(Simulation(bed.setup, bed.state), recipe.size);
  bed.report.settling_time = *seconds;
  return bed;
}

std::optional<SettledBed> read_bed(const std::filesystem::path& file, const BedRecipe& recipe, const WorkOptions& how) {
  if (!is_there(file)) return std::nullopt;
  try {
    return bed_in(file, recipe, how);
  } catch (const InputError& error) {  // damaged, of another version, or made by somebody else
    if (how.tell) how.tell(fmt::format("note: {}\n  the bed is settled anew", error.what()));
    return std::nullopt;
  }
}

std::string zones_in_words(const SettledBed& bed) {
  const Grading& graded = bed.recipe.grading;
  const double mm = 1000 * mean_diameter(bed.recipe.soil);
  return fmt::format(
      "note: a graded bed of {} grains: {:.3g} mm on average to {:.3g} mm below the surface and {:.3g} mm to both "
      "sides of the middle; {:.3g} mm from {:.3g} mm beyond",
      bed.report.grains, mm, 1000 * graded.depth, 1000 * graded.half_width, graded.factor * mm,
      1000 * graded.transition);
}

}  // namespace

std::string recipe_text(const BedRecipe& recipe) {
  std::string text = fmt::format("version {}\n", version);
  const auto add = [&](const char* name, double value) { text += fmt::format("{} {}\n", name, value); };
  const GranularSoil& soil = recipe.soil;
  add("radius_min", soil.radius_min), add("radius_max", soil.radius_max);
  if (!soil.sizes.empty()) {  // keys of beds without them stay
    text += "sizes";
    for (const GrainFraction& fraction : soil.sizes) text += fmt::format(" {} {}", fraction.radius, fraction.share);
    text += "\n";
  }
  add("density", soil.grain_density), add("young", soil.youngs_modulus), add("poisson", soil.poisson_ratio);
  add("restitution", soil.grain_grain.restitution);
  add("sliding", soil.grain_grain.sliding_friction), add("rolling", soil.grain_grain.rolling_friction);
  if (soil.shape != GrainShape::sphere)
    add("shape", static_cast<int>(soil.shape)), add("sphere_spacing", soil.sphere_spacing);
  if (soil.grain_grain.cohesion > 0) add("cohesion", soil.grain_grain.cohesion);  // keys of beds without it stay
  if (soil.grain_grain.work_of_adhesion > 0) add("work_of_adhesion", soil.grain_grain.work_of_adhesion);
  add("length", recipe.size.length), add("width", recipe.size.width), add("depth", recipe.size.depth);
  text += fmt::format("packing {}\n", recipe.packing);
  if (const Grading& graded = recipe.grading; graded.factor > 1) {
    add("graded", graded.factor), add("graded_version", graded_version);
    add("fine_half_width", graded.half_width), add("fine_depth", graded.depth), add("transition", graded.transition);
  }
  add("settling_friction", recipe.settling_friction), add("gravity", recipe.gravity), add("dt", recipe.dt);
  text += fmt::format("laws {} {} {}\n", static_cast<int>(recipe.laws.normal), static_cast<int>(recipe.laws.rolling),
                      static_cast<int>(recipe.laws.cohesion));
  add("tangential_damping", recipe.laws.tangential_damping);
  if (recipe.laws.rolling == RollingLaw::elastic_plastic && soil.grain_grain.rolling_damping > 0)
    add("rolling_damping", soil.grain_grain.rolling_damping);  // keys of beds without it stay
  if (recipe.laws.twisting != TwistingLaw::none) add("twisting", static_cast<int>(recipe.laws.twisting));
  if (soil.grain_grain.rolling_stiffness > 0) add("rolling_stiffness", soil.grain_grain.rolling_stiffness);
  if (recipe.settled_by == SettledBy::lammps) text += "settled_by lammps\n";
  if (recipe.periodic) add("periodic", 1);
  add("kinetic", recipe.rest.kinetic), add("unbalanced", recipe.rest.unbalanced), add("every", recipe.rest.every);
  return text;
}

std::string content_key(const BedRecipe& recipe) { return fnv1a_digits(recipe_text(recipe)); }

std::shared_ptr<const SettledBed> BedStore::bed(const BedRecipe& recipe, const WorkOptions& how) {
  const std::lock_guard lock(guard_);
  const std::string text = recipe_text(recipe);
  for (const auto& [known, bed] : kept_)
    if (known == text) return bed;
  std::optional<SettledBed> found;
  if (!folder_.empty()) found = read_bed(file(recipe), recipe, how);
  if (!found) {
    found = settle_bed(recipe, how);
    if (!folder_.empty()) keep(*found, text, how);
  }
  if (recipe.grading.factor > 1 && how.tell) how.tell(zones_in_words(*found));
  kept_.emplace_back(text, std::make_shared<const SettledBed>(std::move(*found)));
  return kept_.back().second;
}

void BedStore::keep(const SettledBed& bed, const std::string& text, const WorkOptions& how) const {
  try {
    write_restart(file(bed.recipe), bed.setup, bed.state,
                  {{recipe_note, text}, {time_note, fmt::format("{}", bed.report.settling_time)}}, Keep::nothing);
  } catch (const std::runtime_error& error) {
    if (how.tell)
      how.tell(fmt::format("warning: {}\n  the bed isn't kept: the next run settles it anew", error.what()));
  }
}

}  // namespace soilbin::dem
