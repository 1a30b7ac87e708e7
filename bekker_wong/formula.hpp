// A learned effect as people would write it: the same change g at the same joint, a sum of a few plain terms. Source:
// effects/formula.cpp, since it uses effects/learned_joints.hpp.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bekker_wong/learned.hpp"

namespace soilbin::bekker_wong {

/// A term of g, such as slip^2 (load/100 N): a plain function of one condition, or a product of one of each. Plain
/// functions: 1; x and x^2 (x: slip, load/W, speed/v, pass - 1, moisture, position/m; of angles the sine); of slip and
/// inclines max(0, x) too; of load, speed and pass ln x. W and v: the middle of the range, to one digit.
struct FormulaTerm {
  std::string text;  ///< for people, units in it
  std::function<double(const OperatingCondition&)> value;
};

/// Every term over a learned effect's conditions and ranges; 1 among them.
std::vector<FormulaTerm> formula_terms(const LearnedFunction& function, const std::vector<double>& parameters);

/// The learned form's joint with g = c0 term_0 + c1 term_1 + ...: parameters a (1: with it), c0, c1, ... [-]. No part
/// of any catalogue; what it makes holds what it needs.
EffectForm formula_form(const EffectForm& learned, const std::vector<FormulaTerm>& terms);

/// Where g joins a learned form's model, in words: "force W_n g along the wheel's plane".
std::string joint_equation(const EffectForm& learned);

}  // namespace soilbin::bekker_wong
