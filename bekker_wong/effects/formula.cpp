#include "bekker_wong/formula.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "bekker_wong/effects/learned_joints.hpp"

namespace soilbin::bekker_wong {
namespace {

using At = const OperatingCondition&;

const LearnedJoint& joint_of(const EffectForm& learned) {
  return *std::find_if(learned_joints.begin(), learned_joints.end(), [&](const LearnedJoint& joint) {
    return learned.form.starts_with(std::string(joint.name) + "_by_");
  });
}

FormulaTerm one() {
  return {"1", [](At) { return 1.0; }};
}

/// "x^2" of "slip" or of "(load/100 N)".
FormulaTerm squared(const FormulaTerm& x) {
  return {x.text + "^2", [v = x.value](At at) { return v(at) * v(at); }};
}
FormulaTerm driven(const FormulaTerm& x) {
  return {fmt::format("max(0, {})", x.text), [v = x.value](At at) { return std::max(0.0, v(at)); }};
}
FormulaTerm logarithm(const FormulaTerm& x) {
  const std::string of = x.text.starts_with("(") ? x.text : "(" + x.text + ")";
  return {"ln" + of, [v = x.value](At at) { return std::log(v(at)); }};
}

/// A middle to one digit.
double round_middle(double from, double to) {
  const double middle = 0.5 * (std::abs(from) + std::abs(to));
  if (!(middle > 0.0)) return 1.0;
  const double digit = std::pow(10.0, std::floor(std::log10(middle)));
  return std::round(middle / digit) * digit;
}

/// Plain functions of a condition over its range, without 1.
std::vector<FormulaTerm> plain_functions(const LearnedVariable& variable, double from, double to) {
  const std::string name(variable.name), unit(variable.unit);
  const auto value = variable.value;
  if (unit == "deg") {
    const FormulaTerm sine{fmt::format("sin({})", name == "yaw" ? "|yaw|" : name),
                           [value](At at) { return std::sin(value(at)); }};
    if (name == "yaw") return {sine, squared(sine)};
    return {sine, squared(sine), driven(sine)};
  }
  if (name == "slip") {
    const FormulaTerm slip{name, value};
    return {slip, squared(slip), driven(slip), squared(driven(slip))};
  }
  if (name == "pass") {
    const FormulaTerm pass{name, value};
    return {{"(pass - 1)", [value](At at) { return value(at) - 1; }}, logarithm(pass)};
  }
  if (name == "moisture") {
    const FormulaTerm share{name, value};
    return {share, squared(share)};
  }
  if (name == "position") {
    const FormulaTerm place{"(position/m)", value};
    return {place, squared(place)};
  }
  const double usual = round_middle(from, to);
  const FormulaTerm ratio{fmt::format("({}/{:.4g} {})", name, usual, unit),
                          [value, usual](At at) { return value(at) / usual; }};
  if (!(from > 0.0)) return {ratio, squared(ratio)};
  return {ratio, squared(ratio), logarithm(ratio)};
}

FormulaTerm product(const FormulaTerm& a, const FormulaTerm& b) {
  return {a.text + " " + b.text, [x = a.value, y = b.value](At at) { return x(at) * y(at); }};
}

}  // namespace

std::vector<FormulaTerm> formula_terms(const LearnedFunction& function, const std::vector<double>& parameters) {
  std::vector<std::vector<FormulaTerm>> of;
  std::vector<FormulaTerm> terms = {one()};
  for (std::size_t v = 0; v < function.variables.size(); ++v) {
    of.push_back(plain_functions(function.variables[v], parameters[LearnedFunction::from(v)],
                                 parameters[LearnedFunction::to(v)]));
    terms.insert(terms.end(), of.back().begin(), of.back().end());
  }
  if (of.size() == 2)
    for (const FormulaTerm& a : of[0])
      for (const FormulaTerm& b : of[1]) terms.push_back(product(a, b));
  return terms;
}

EffectForm formula_form(const EffectForm& learned, const std::vector<FormulaTerm>& terms) {
  const LearnedJoint& joint = joint_of(learned);
  EffectForm form = learned;
  form.parameters = {learned.parameters.front()};
  form.form += "_formula";
  form.equation = std::string(joint.equation) + ", g =";
  for (std::size_t k = 0; k < terms.size(); ++k) {
    constexpr double largest = 1e3;
    form.parameters.push_back({fmt::format("c{}", k), "-", 0.0, -largest, largest, "weight of " + terms[k].text});
    form.equation += fmt::format("{} c{} {}", k == 0 ? "" : " +", k, terms[k].text);
  }
  form.make = [terms, make = joint.make](const std::vector<double>& p) {
    if (p[0] == 0.0) return make({});
    return make([terms, p](At at) {
      double sum = 0.0;
      for (std::size_t k = 0; k < terms.size(); ++k) sum += p[k + 1] * terms[k].value(at);
      return std::isnan(sum) ? 0.0 : held_change(p[0] * sum);
    });
  };
  return form;
}

std::string joint_equation(const EffectForm& learned) {
  std::string text(joint_of(learned).equation);
  return text.replace(text.find("a g"), 3, "g");
}

}  // namespace soilbin::bekker_wong
