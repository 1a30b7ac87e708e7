// What a served page can move: condition, tire or vehicle, soil, effects and their parameters, each with where it
// stands and its limits.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "compare/vehicle/vehicle.hpp"
#include "scenario/case.hpp"

namespace soilbin::cli {

/// A key of a description as a flag without its dashes: "lug-height".
std::string key_of(const std::string& prefix, const char* key);

/// People read shares in percent: "%" for "-".
std::string shown_unit(const std::string& unit);

/// "4 kN" as "4kN".
std::string without_blanks(std::string text);

/// An effect as the flag --effect spells it; parameters at their defaults are left out.
std::string effect_word(const EffectChoice& choice, const Soil& soil);

/// The numbers of a question of one condition, each with group ("condition", "tire", "soil"), key (its flag), title,
/// meaning, unit, and in that unit its value (null: the tire declares none) and the limits and step of a slider. Those
/// of the soil have their standard deviation under "sd". Then pass, moisture, position and run, each with the "effects"
/// that hear of it: a page shows it with them. `force`: the unit of the load, N or kN.
nlohmann::ordered_json numbers_json(const Case& question, const std::string& force);

/// Whether a load [N] is so large that a page tells forces in kN.
bool is_told_in_kilonewtons(double load);

/// Flags, without their dashes, that say more of the tire, or of the soil, than its name.
bool is_tire_flag(const std::string& key);
bool is_soil_flag(const std::string& key);

/// The numbers of a vehicle's question, as numbers_json has those of a wheel's: groups "condition", "vehicle" and
/// "soil". `force`: the unit of the pull, N or kN.
nlohmann::ordered_json vehicle_numbers_json(const compare::VehicleCase& vehicle, const std::string& force);

/// By its weight the unit in which forces on a vehicle are told, N or kN.
std::string force_unit_of(const compare::VehicleCase& vehicle);

/// The catalogue, forms under their effects, each with its parameters as numbers_json has its numbers, at their
/// defaults; "on": how `effects`, on a soil, spell one that is among them, else null.
nlohmann::ordered_json effects_json(const std::vector<EffectChoice>& effects, const Soil& soil);

/// Effects that are on: id, form, and each parameter's key and value in the unit of effects_json.
nlohmann::ordered_json effect_values_json(const std::vector<EffectChoice>& effects);

}  // namespace soilbin::cli
