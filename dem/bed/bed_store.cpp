#include "dem/bed/bed_store.hpp"

#include <fmt/core.h>

#include <optional>

#include "dem/archive/restart.hpp"
#include "dem/archive/sealed_file.hpp"
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

std::optional<SettledBed> read_bed(const std::filesystem::path& file, const BedRecipe& recipe, const WorkOptions& how) {
  if (!is_there(file)) return std::nullopt;
  try {
    Restart restart = read_restart(file);
    const auto text = restart.notes.find(recipe_note), time = restart.notes.find(time_note);
    if (text == restart.notes.end() || text->second != recipe_text(recipe) || time == restart.notes.end())
      return std::nullopt;
    const std::optional<double> seconds = read_number(time->second);
    if (!seconds) return std::nullopt;
    SettledBed bed{.recipe = recipe, .setup = restart.setup, .state = std::move(restart.state), .report = {}};
    bed.setup.numerics.threads = how.threads;
    bed.report = report_on(Simulation(bed.setup, bed.state), recipe.size);
    bed.report.settling_time = *seconds;
    return bed;
  } catch (const InputError&) {
    return std::nullopt;  // damaged, or of another version: settled anew
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
  add("density", soil.grain_density), add("young", soil.youngs_modulus), add("poisson", soil.poisson_ratio);
  add("restitution", soil.grain_grain.restitution);
  add("sliding", soil.grain_grain.sliding_friction), add("rolling", soil.grain_grain.rolling_friction);
  if (soil.shape != GrainShape::sphere)
    add("shape", static_cast<int>(soil.shape)), add("sphere_spacing", soil.sphere_spacing);
  if (soil.grain_grain.cohesion > 0) add("cohesion", soil.grain_grain.cohesion);  // keys of beds without it stay
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
