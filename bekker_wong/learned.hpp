// Learned effects (id "learned"): a change that no effect of the catalogue makes, as a smooth function of one condition
// or of two. It has no known cause; the loop fits it to a campaign, and it holds within the conditions of that
// campaign. Source: effects/learned.cpp, since it uses effects/learned_joints.hpp.
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "bekker_wong/effect.hpp"
#include "scenario/estimate.hpp"

namespace soilbin::bekker_wong {

inline constexpr std::string_view learned_id = "learned";

/// A condition that a learned effect may follow.
struct LearnedVariable {
  std::string_view name;  ///< as in files: "slip", "load", "yaw", ...
  std::string_view unit;
  double (*value)(const OperatingCondition&);  ///< [SI]; of yaw the size; not a number where the condition doesn't tell
};

/// The conditions that there are forms for, by their keys in files.
inline constexpr std::array<LearnedVariable, 9> learned_variables = {{
    {"slip", "-", [](const OperatingCondition& at) { return at.slip; }},
    {"load", "N", [](const OperatingCondition& at) { return at.load; }},
    {"yaw", "deg", [](const OperatingCondition& at) { return std::abs(at.yaw); }},
    {"speed", "m/s", [](const OperatingCondition& at) { return at.speed; }},
    {"longitudinal_incline", "deg", [](const OperatingCondition& at) { return at.longitudinal_incline; }},
    {"transverse_incline", "deg", [](const OperatingCondition& at) { return at.transverse_incline; }},
    {"pass", "-", [](const OperatingCondition& at) { return static_cast<double>(at.pass); }},
    {"moisture", "-", [](const OperatingCondition& at) { return at.moisture.value_or(not_a_number); }},
    {"position", "m", [](const OperatingCondition& at) { return at.position.value_or(not_a_number); }},
}};

/// The function's parameters begin with its amplitude, "a" (0: the base model, to the bit), then for each variable the
/// range in which it was learned, "VARIABLE_from" and "VARIABLE_to"; "c0", "c1", ... weigh products of Legendre's
/// polynomials over that range, of total degree 4 (one variable) or 3 (two), the plainest first.
struct LearnedFunction {
  std::vector<LearnedVariable> variables;  ///< one or two
  std::vector<std::vector<int>> degrees;   ///< of each weight, a degree a variable
  std::size_t first_weight() const { return 1 + 2 * variables.size(); }
  static constexpr std::size_t from(std::size_t variable) { return 1 + 2 * variable; }
  static constexpr std::size_t to(std::size_t variable) { return 2 + 2 * variable; }
};

/// Forms JOINT_by_VARIABLE and JOINT_by_VARIABLE_and_VARIABLE. They are no part of effect_catalogue(): nobody proposes
/// one but who has learned it. find_form() and files know them.
///
/// With W_n the load normal to the ground, r the radius, g the function (held between -2 and 2):
///   drawbar_pull   a force W_n g along the wheel's plane
///   lateral_force  a force W_n g sin(yaw) to its left: none without yaw, and odd in it
///   torque         a driving torque W_n r g
///   sinkage        the measured sinkage times exp(g): none of none
///   stiffness      k_c and k_phi times exp(g)
///   strength       c and tan(phi) times exp(g)
const std::vector<EffectForm>& learned_forms();

/// What a learned form is a function of; empty variables for a form of the catalogue.
const LearnedFunction& learned_function(const EffectForm& form);

/// What each weight of a learned form multiplies at a condition, in their order: products of Legendre's polynomials;
/// zeros where the condition does not tell one of the variables. parameters: the form's.
std::vector<double> weighed_products(const LearnedFunction& function, const std::vector<double>& parameters,
                                     const OperatingCondition& at);

/// Where a condition lies outside the range that a learned effect was learned in: "slip"; empty inside, and for every
/// other effect. Outside, the function has the value of the nearest edge.
std::vector<std::string> outside_learned(const EffectChoice& choice, const OperatingCondition& at);

}  // namespace soilbin::bekker_wong
