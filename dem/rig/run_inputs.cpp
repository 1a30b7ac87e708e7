#include "dem/rig/run_inputs.hpp"

#include <fmt/core.h>

#include <sstream>

#include "dem/bed/bed_store.hpp"
#include "dem/rig/step_criteria.hpp"

namespace soilbin::dem {
namespace {

using Inputs = std::vector<std::pair<std::string, std::string>>;

void add(Inputs& to, const std::string& name, double value) { to.emplace_back(name, fmt::format("{}", value)); }

void add_bed(Inputs& to, const BedRecipe& recipe) {
  std::istringstream lines(recipe_text(recipe));
  for (std::string line; std::getline(lines, line);) {
    const std::size_t blank = line.find(' ');
    const std::string name = line.substr(0, blank);
    if (name != "packing") to.emplace_back("bed." + name, line.substr(blank + 1));
  }
}

void add_tire(Inputs& to, const Tire& tire) {
  add(to, "tire.radius", tire.radius), add(to, "tire.width", tire.width);
  add(to, "tire.lug_height", tire.lugs.height);
  if (!is_lugged(tire)) return;
  add(to, "tire.lug_count", tire.lugs.count.value_or(0)),
      add(to, "tire.lug_thickness", tire.lugs.thickness.value_or(0));
  to.emplace_back("tire.lug_pattern", tire.lugs.pattern == LugPattern::chevron ? "chevron" : "straight");
}

void add_rig(Inputs& to, const Rig& rig) {
  add(to, "rig.mass", rig.mass), add(to, "rig.tilting", rig.tilting), add(to, "rig.lowering", rig.lowering);
  add(to, "rig.resting", rig.resting), add(to, "rig.starting", rig.starting), add(to, "rig.behind", rig.behind);
  add(to, "rig.ahead", rig.ahead), add(to, "rig.travel", rig.travel), add(to, "rig.sampling", rig.sampling);
  add(to, "rig.sectors", rig.sectors), add(to, "rig.inertia", rig.inertia);
  add(to, "rig.mesh_edge", rig.meshing.edge), add(to, "rig.chevron_angle", rig.meshing.chevron_angle);
  add(to, "rig.young", rig.young), add(to, "rig.poisson", rig.poisson), add(to, "rig.skin", rig.skin);
  add(to, "rig.deepest_overlap", rig.deepest_overlap), add(to, "rig.steady_drift", rig.steady_drift);
  add(to, "rig.sleep_speed", rig.sleep_speed);
  if (rig.sleep_speed > 0) add(to, "rig.sleep_time", rig.sleep_time);
  if (rig.drive_torque) add(to, "rig.drive_torque", *rig.drive_torque);
}

}  // namespace

Inputs run_inputs(const BedRecipe& recipe, const Tire& tire, const Rig& rig) {
  Inputs inputs;
  add_bed(inputs, recipe);
  add_tire(inputs, tire);
  const ContactPair& contact = recipe.soil.grain_tire;
  add(inputs, "soil.tire_restitution", contact.restitution), add(inputs, "soil.tire_sliding", contact.sliding_friction);
  add(inputs, "soil.tire_rolling", contact.rolling_friction);
  if (contact.rolling_stiffness > 0) add(inputs, "soil.tire_rolling_stiffness", contact.rolling_stiffness);
  add_rig(inputs, rig);
  add(inputs, "rig.time_step", step_of(recipe, rig));
  return inputs;
}

}  // namespace soilbin::dem
