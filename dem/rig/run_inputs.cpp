#include "dem/rig/run_inputs.hpp"

#include <fmt/core.h>

#include <sstream>

#include "dem/bed/bed_store.hpp"
#include "dem/rig/rig_settings.hpp"
#include "dem/rig/step_criteria.hpp"
#include "dem/surface/mesh_files.hpp"
#include "scenario/checksum.hpp"
#include "scenario/description.hpp"
#include "scenario/file_bytes.hpp"

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
  for (const Word<LugPattern>& word : words_of(std::type_identity<LugPattern>{}))
    if (word.value == tire.lugs.pattern) to.emplace_back("tire.lug_pattern", std::string(word.text));
  if (tire.lugs.angle) add(to, "tire.lug_angle", *tire.lugs.angle);
}

void add_rig(Inputs& to, const Rig& rig) {
  const auto is_read = [&](const std::string& key) {  // keys of runs without them stay
    if (key == "sleep_time") return rig.sleep_speed > 0;
    if (key == "until_error") return rig.patch && rig.travel == 0;
    return key != "ledger" && key != "time_step";  // added by whoever knows how they are taken
  };
  describe_rig(rig, [&](const std::string& key, const auto& member, const auto&...) {
    const std::string name = "rig." + (key == "sleep" ? "sleep_mean_speed" : key);
    using Member = std::decay_t<decltype(member)>;
    if (!is_read(key)) return;
    if constexpr (std::is_same_v<Member, std::string>) {
      if (!member.empty()) to.emplace_back(name, fnv1a_digits(read_bytes(member, largest_mesh)));
    } else if constexpr (std::is_same_v<Member, std::optional<double>>) {
      if (member) add(to, name, *member);
    } else if (!std::is_same_v<Member, bool> || member) {
      add(to, name, member);
    }
  });
}

/// To be raised when the same inputs give other bits, or a restart keeps something else.
constexpr int version = 5;

Inputs inputs_with_contact(BedRecipe recipe, const Tire& tire, const ContactPair& tire_contact, const Rig& rig) {
  recipe.soil.grain_tire = tire_contact;
  Inputs inputs = run_inputs(recipe, tire, rig);
  inputs.emplace_back("program", fmt::format("soilbin {}, runs {}", SOILBIN_VERSION, version));
  inputs.emplace_back("bed.packing", std::to_string(recipe.packing));
  inputs.emplace_back("rig.ledger", rig.ledger ? "told" : "not told");
  if (rig.onlooker.look) add(inputs, "rig.onlooker", rig.onlooker.every);
  return inputs;
}

std::string text_of(const Inputs& inputs) {
  std::string text;
  for (const auto& [name, value] : inputs) text += name + " " + value + "\n";
  return text;
}

}  // namespace

Inputs run_inputs(const BedRecipe& recipe, const Tire& tire, const Rig& rig) {
  Inputs inputs;
  add_bed(inputs, recipe);
  add_tire(inputs, tire);
  const ContactPair& contact = recipe.soil.grain_tire;
  add(inputs, "soil.tire_restitution", contact.restitution), add(inputs, "soil.tire_sliding", contact.sliding_friction);
  add(inputs, "soil.tire_rolling", contact.rolling_friction);
  if (recipe.laws.rolling == RollingLaw::elastic_plastic && contact.rolling_damping > 0)
    add(inputs, "soil.tire_rolling_damping", contact.rolling_damping);
  if (contact.rolling_stiffness > 0) add(inputs, "soil.tire_rolling_stiffness", contact.rolling_stiffness);
  if (contact.work_of_adhesion > 0) add(inputs, "soil.tire_work_of_adhesion", contact.work_of_adhesion);
  add_rig(inputs, rig);
  add(inputs, "rig.time_step", step_of(recipe, rig));
  return inputs;
}

std::string inputs_text(const BedRecipe& recipe, const Tire& tire, const ContactPair& tire_contact, const Rig& rig,
                        const OperatingCondition& at) {
  const auto& [load, slip, speed, longitudinal_incline, transverse_incline, yaw, pass, slip_by, force_frame, moisture,
               position, run, inflation_pressure, rut_load, rut_slip] = at;  // from moisture on: not of grains
  Inputs inputs = inputs_with_contact(recipe, tire, tire_contact, rig);
  add(inputs, "at.load", load), add(inputs, "at.slip", slip), add(inputs, "at.speed", speed);
  add(inputs, "at.longitudinal_incline", longitudinal_incline);
  add(inputs, "at.transverse_incline", transverse_incline), add(inputs, "at.yaw", yaw), add(inputs, "at.pass", pass);
  add(inputs, "at.slip_by", static_cast<int>(slip_by)), add(inputs, "at.force_frame", static_cast<int>(force_frame));
  return text_of(inputs);
}

std::string inputs_text(const BedRecipe& recipe, const Tire& tire, const ContactPair& tire_contact, const Rig& rig,
                        const Drive& drive, int samples) {
  Inputs inputs = inputs_with_contact(recipe, tire, tire_contact, rig);
  const auto& [load, mass, inertia, pass, duration, distance, damping, stuck_speed, controller, profile, effects,
               errors] = drive;  // damping, effects and their errors are the analytic wheel's
  const double gravity = gravity_of(recipe.soil);
  const auto& [rim_speed, torque, highest_torque, highest_rim_speed, ramp, response] = controller;
  add(inputs, "drive.load", load), add(inputs, "drive.mass", mass_of(drive, gravity));
  add(inputs, "drive.inertia", inertia_of(drive, tire.radius, gravity)), add(inputs, "drive.pass", pass);
  add(inputs, "drive.duration", duration), add(inputs, "drive.distance", distance.value_or(0));
  add(inputs, "drive.stuck_speed", stuck_speed), add(inputs, "motor.rim_speed", rim_speed.value_or(0));
  add(inputs, "motor.torque", torque.value_or(0)), add(inputs, "motor.highest_torque", highest_torque.value_or(0));
  add(inputs, "motor.highest_rim_speed", highest_rim_speed.value_or(0));
  add(inputs, "motor.ramp", ramp), add(inputs, "motor.response", response), add(inputs, "drive.samples", samples);
  for (const auto& [at, longitudinal_incline, transverse_incline, yaw, drawbar, soil] : profile)
    inputs.emplace_back("drive.place",
                        fmt::format("{} {} {} {} {}", at, longitudinal_incline, transverse_incline, yaw, drawbar));
  return text_of(inputs);
}

std::string key_of(const std::string& text) { return fnv1a_digits(text); }

}  // namespace soilbin::dem
