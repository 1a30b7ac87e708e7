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
  return {"1", "1.0", [](At) { return 1.0; }};
}

/// "x^2" of "slip" or of "(load/100 N)".
FormulaTerm squared(const FormulaTerm& x) {
  return {x.text + "^2", fmt::format("std::pow({}, 2)", x.code), [v = x.value](At at) { return v(at) * v(at); }};
}
FormulaTerm driven(const FormulaTerm& x) {
  return {fmt::format("max(0, {})", x.text), fmt::format("std::max(0.0, {})", x.code),
          [v = x.value](At at) { return std::max(0.0, v(at)); }};
}
FormulaTerm logarithm(const FormulaTerm& x) {
  const std::string of = x.text.starts_with("(") ? x.text : "(" + x.text + ")";
  return {"ln" + of, fmt::format("std::log({})", x.code), [v = x.value](At at) { return std::log(v(at)); }};
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
    const std::string code = name == "yaw" ? "std::sin(std::abs(at.yaw))" : fmt::format("std::sin(at.{})", name);
    const FormulaTerm sine{fmt::format("sin({})", name == "yaw" ? "|yaw|" : name), code,
                           [value](At at) { return std::sin(value(at)); }};
    if (name == "yaw") return {sine, squared(sine)};
    return {sine, squared(sine), driven(sine)};
  }
  if (name == "slip") {
    const FormulaTerm slip{name, "at.slip", value};
    return {slip, squared(slip), driven(slip), squared(driven(slip))};
  }
  if (name == "pass") {
    const FormulaTerm pass{name, "at.pass", value};
    return {{"(pass - 1)", "(at.pass - 1)", [value](At at) { return value(at) - 1; }}, logarithm(pass)};
  }
  if (name == "moisture") {
    const FormulaTerm share{name, "at.moisture.value_or(0.0)", value};
    return {share, squared(share)};
  }
  if (name == "position") {
    const FormulaTerm place{"(position/m)", "at.position.value_or(0.0)", value};
    return {place, squared(place)};
  }
  const double usual = round_middle(from, to);
  const FormulaTerm ratio{fmt::format("({}/{:.4g} {})", name, usual, unit),
                          fmt::format("(at.{} / {:.4g})", name, usual),
                          [value, usual](At at) { return value(at) / usual; }};
  if (!(from > 0.0)) return {ratio, squared(ratio)};
  return {ratio, squared(ratio), logarithm(ratio)};
}

FormulaTerm product(const FormulaTerm& a, const FormulaTerm& b) {
  return {a.text + " " + b.text, a.code + " * " + b.code, [x = a.value, y = b.value](At at) { return x(at) * y(at); }};
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

std::string proposed_entry(const EffectForm& learned, const std::vector<FormulaTerm>& terms,
                           const std::vector<double>& weights, const std::vector<std::string>& about) {
  const LearnedJoint& joint = joint_of(learned);
  std::string comment, sum, parameters;
  for (const std::string& line : about) comment += "// " + line + "\n";
  for (std::size_t k = 0; k < terms.size(); ++k) {
    sum += fmt::format("{}p_[{}] * {}", k == 0 ? "" : " + ", k + 1, terms[k].code);
    const double limit = 10 * std::abs(weights[k]);
    parameters += fmt::format(",\n                      {{\"c{}\", \"-\", {:.6g}, {:.6g}, {:.6g}, \"weight of {}\"}}",
                              k, weights[k], -limit, limit, terms[k].text);
  }
  return fmt::format(R"(// {0}: a proposal, learned from runs. Nobody has derived it.
//
{1}//
// To make it an effect of the catalogue: give it a name and its cause; put this file beside the others, a line into
// forms.hpp, catalogue.cpp and titles.cpp, one into docs/reference/effects.md, and a test of its trace, of its limit
// (a = 0 is the base model) and of its derivative there.
#include <algorithm>
#include <cmath>

#include "bekker_wong/effects/forms.hpp"
#include "bekker_wong/effects/scaled_soil.hpp"

namespace soilbin::bekker_wong {{
namespace {{

class Proposed_{0} final : public Effect {{
 public:
  explicit Proposed_{0}(const std::vector<double>& p) : p_(p) {{}}
{2}

 private:
  double g(const OperatingCondition& at) const {{
    return p_[0] * ({3});
  }}
  std::vector<double> p_;
}};

}}  // namespace

std::vector<EffectForm> {0}_forms() {{
  return {{
      {{.id = "{0}",
       .form = "learned",
       .equation = "{4}",
       .source = "learned from a campaign: see above",
       .parameters = {{{{"a", "-", 1.0, -3.0, 3.0, "1: as learned"}}{5}}},
       .make = maker<Proposed_{0}>()}},
  }};
}}

}}  // namespace soilbin::bekker_wong
)",
                     learned.form, comment, joint.code, sum, formula_form(learned, terms).equation, parameters);
}

}  // namespace soilbin::bekker_wong
