#include "bekker_wong/learned.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "bekker_wong/effects/learned_joints.hpp"

namespace soilbin::bekker_wong {
namespace {

using At = const OperatingCondition&;

constexpr int degree_of_one = 4, degree_of_two = 3;
constexpr double largest_weight = 20.0, widest_range = 1e9;

LearnedFunction function_of(std::vector<LearnedVariable> of) {
  LearnedFunction function{std::move(of), {}};
  const int most = function.variables.size() == 1 ? degree_of_one : degree_of_two;
  for (int degree = 0; degree <= most; ++degree)
    if (function.variables.size() == 1)
      function.degrees.push_back({degree});
    else
      for (int first = degree; first >= 0; --first) function.degrees.push_back({first, degree - first});
  return function;
}

/// The function with its parameters.
class Smooth {
 public:
  Smooth(const LearnedFunction& function, const std::vector<double>& p) : function_(function), p_(p) {}
  double operator()(At at) const {
    const std::vector<double> products = weighed_products(function_, p_, at);
    double sum = 0.0;
    for (std::size_t k = 0; k < products.size(); ++k) sum += p_[function_.first_weight() + k] * products[k];
    return held_change(p_[0] * sum);
  }

 private:
  const LearnedFunction& function_;  // of learned_forms(), which stay
  std::vector<double> p_;
};

EffectForm form_of(const LearnedJoint& joint, const LearnedFunction& function) {
  EffectForm form{.id = std::string(learned_id),
                  .form = std::string(joint.name),
                  .equation = std::string(joint.equation) + ", g a sum of products of Legendre polynomials",
                  .source = "learned from a campaign",
                  .parameters = {{"a", "-", 1.0, 0.0, 1.0, "1 with the effect, 0 without"}},
                  .measurement = false,
                  .form_tolerance = 0.0,
                  .steady_only = "it was learned from steady runs",
                  .presumes = {},
                  .conditions = {},
                  .make = [&function, make = joint.make](const std::vector<double>& p) {
                    return make(p[0] == 0.0 ? LearnedChange() : Smooth(function, p));
                  }};
  for (std::size_t v = 0; v < function.variables.size(); ++v) {
    const LearnedVariable& variable = function.variables[v];
    const std::string name(variable.name), unit(variable.unit);
    form.conditions.push_back(name);
    form.form += (v == 0 ? "_by_" : "_and_") + name;
    form.parameters.push_back(
        {name + "_from", unit, 0.0, -widest_range, widest_range, "smallest value that it was learned from"});
    form.parameters.push_back(
        {name + "_to", unit, 0.0, -widest_range, widest_range, "largest value that it was learned from"});
  }
  for (std::size_t k = 0; k < function.degrees.size(); ++k) {
    std::string meaning = "weight of";
    for (std::size_t v = 0; v < function.variables.size(); ++v)
      meaning += " P" + std::to_string(function.degrees[k][v]) + "(" + std::string(function.variables[v].name) + ")";
    form.parameters.push_back({"c" + std::to_string(k), "-", 0.0, -largest_weight, largest_weight, meaning});
  }
  return form;
}

/// One of each variable, then slip with each other one, and yaw with load.
const std::vector<LearnedFunction>& functions() {
  static const std::vector<LearnedFunction> all = [] {
    std::vector<LearnedFunction> made;
    for (const LearnedVariable& variable : learned_variables) made.push_back(function_of({variable}));
    for (std::size_t v = 1; v < learned_variables.size(); ++v)
      made.push_back(function_of({learned_variables[0], learned_variables[v]}));
    made.push_back(function_of({learned_variables[1], learned_variables[2]}));
    return made;
  }();
  return all;
}

}  // namespace

const std::vector<EffectForm>& learned_forms() {
  static const std::vector<EffectForm> all = [] {
    std::vector<EffectForm> forms;
    for (const LearnedJoint& joint : learned_joints)
      for (const LearnedFunction& function : functions()) forms.push_back(form_of(joint, function));
    return forms;
  }();
  return all;
}

const LearnedFunction& learned_function(const EffectForm& form) {
  static const LearnedFunction none;
  static const std::map<std::string, const LearnedFunction*> by_name = [] {
    std::map<std::string, const LearnedFunction*> names;
    for (std::size_t i = 0; i < learned_forms().size(); ++i)
      names[learned_forms()[i].form] = &functions()[i % functions().size()];
    return names;
  }();
  return form.id == learned_id ? *by_name.at(form.form) : none;
}

std::vector<double> weighed_products(const LearnedFunction& function, const std::vector<double>& p, At at) {
  std::array<double, 2> x{};
  std::vector<double> products(function.degrees.size(), 0.0);
  for (std::size_t v = 0; v < function.variables.size(); ++v) {
    const double value = function.variables[v].value(at), from = p[LearnedFunction::from(v)],
                 to = p[LearnedFunction::to(v)];
    if (std::isnan(value)) return products;
    x[v] = to > from ? std::clamp(2 * (value - from) / (to - from) - 1, -1.0, 1.0) : 0.0;
  }
  for (std::size_t k = 0; k < products.size(); ++k) {
    products[k] = 1.0;
    for (std::size_t v = 0; v < function.variables.size(); ++v)
      products[k] *= std::legendre(static_cast<unsigned>(function.degrees[k][v]), x[v]);
  }
  return products;
}

std::vector<std::string> outside_learned(const EffectChoice& choice, const OperatingCondition& at) {
  std::vector<std::string> outside;
  if (choice.id != learned_id) return outside;
  constexpr double digits = 1e-6;  // of a range that a file tells
  for (const LearnedVariable& variable : learned_function(find_form(choice)).variables) {
    const std::string name(variable.name);
    const double from = choice.parameters.at(name + "_from"), to = choice.parameters.at(name + "_to");
    const double value = variable.value(at), room = digits * (to - from);
    if (!(value >= from - room && value <= to + room)) outside.push_back(name);
  }
  return outside;
}

}  // namespace soilbin::bekker_wong
