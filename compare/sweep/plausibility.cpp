#include "compare/sweep/plausibility.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "bekker_wong/closed_forms.hpp"
#include "bekker_wong/contact_stages.hpp"
#include "bekker_wong/model.hpp"
#include "bekker_wong/rolling_wheel.hpp"
#include "compare/sweep/answers.hpp"
#include "compare/sweep/varying.hpp"
#include "scenario/unit.hpp"

namespace soilbin::compare {
namespace {

using Warnings = std::vector<std::string>;

/// "n = 0.12 is outside 0.3 .. 1.6, ..." where it is.
void expect(Warnings& warnings, const char* name, double value, double lower, double upper, const char* unit,
            const char* why) {
  if (value < lower || value > upper)
    warnings.push_back(fmt::format("{} = {:.4g}{}{} is outside {:.4g} .. {:.4g}: {}", name, value, *unit ? " " : "",
                                   unit, lower, upper, why));
}

/// What a wheel and a soil say together, before any condition.
void add_wheel_doubts(const Tire& tire, const SemiEmpiricalSoil& soil, Warnings& warnings) {
  expect(warnings, "the wheel's radius", tire.radius * 1000, 20, 2000, "mm", "the model is tested from 50 mm to 2 m");
  if (tire.width > 2 * tire.radius)
    warnings.push_back(fmt::format("the wheel is wider ({:.4g} mm) than its diameter ({:.4g} mm)", 1000 * tire.width,
                                   2000 * tire.radius));
  if (is_lugged(tire) && tire.lugs.height > 0.3 * tire.radius)
    warnings.push_back(fmt::format("the lugs ({:.4g} mm) are higher than 30 % of the radius", 1000 * tire.lugs.height));
  if (!(bekker_wong::values_of(soil).pressure_modulus(tire.width) > 0.0))
    warnings.push_back("k_c/b + k_phi is not positive for this width: the soil carries nothing");
}

/// What to say of a wheel that an effect settles deeper than the base model balances one; "" where it doesn't.
std::string too_deep(const Tire& tire, const Answer& answer) {
  if (!answer.result) return "";
  const double share = answer.result->sinkage.value / tire.radius;
  if (!(share > bekker_wong::max_sinkage_share)) return "";
  return fmt::format(
      "the wheel settles to {:.0f} % of its radius at {}: the stresses are not meant for more than {:.0f} %",
      100 * share, in_words(answer.at), 100 * bekker_wong::max_sinkage_share);
}

/// The wheel at one condition of the base model.
void add_condition_doubts(const Scenario& scenario, const Answer& answer, Warnings& warnings) {
  const std::string at = " at " + in_words(answer.at);
  const Tire& tire = scenario.tire;
  if (!answer.result) return warnings.push_back("no solution" + at + ": " + answer.error);
  const TractionResult& r = *answer.result;
  const double length = tire.radius * (r.entry_angle - r.exit_angle);
  const double pressure = answer.at.load / (tire.width * tire.radius * std::sin(r.entry_angle));
  if (pressure < 500.0 || pressure > 2e6)
    warnings.push_back(fmt::format("mean ground pressure {:.3g} kPa{}: wheels on soil press with 0.5 .. 2000 kPa",
                                   pressure / 1000, at));
  if (const std::string deep = too_deep(tire, answer); !deep.empty())
    warnings.push_back(deep);
  else if (r.sinkage.value > 0.5 * tire.radius)
    warnings.push_back(
        fmt::format("the wheel sinks {:.0f} % of its radius{}: the model's rigid outline is a stretch there",
                    100 * r.sinkage.value / tire.radius, at));
  if (scenario.bin && r.sinkage.value > 0.5 * scenario.bin->depth)
    warnings.push_back(
        fmt::format("the wheel sinks {:.0f} % of the bin's depth{}: its floor will be felt (effect hard_layer)",
                    100 * r.sinkage.value / scenario.bin->depth, at));
  const double modulus = scenario.soil.semi_empirical->shear_modulus.value;
  if (modulus > length)
    warnings.push_back(fmt::format("K ({:.3g} mm) is longer than the contact ({:.3g} mm){}: shear hardly develops",
                                   1000 * modulus, 1000 * length, at));
  if (tire.inflation_pressure) {
    const double carried = *tire.inflation_pressure + tire.carcass_pressure.value_or(0.0);
    const double critical = bekker_wong::critical_ground_pressure(bekker_wong::values_of(*scenario.soil.semi_empirical),
                                                                  tire.radius, tire.width, answer.at.load);
    const bool flexible = std::any_of(scenario.effects.begin(), scenario.effects.end(),
                                      [](const EffectChoice& e) { return e.id == "tire_flexibility"; });
    if (carried < critical && !flexible)
      warnings.push_back(
          fmt::format("inflation {:.3g} kPa lies under the critical ground pressure {:.3g} kPa{}: the tire "
                      "flattens (effect tire_flexibility)",
                      carried / 1000, critical / 1000, at));
  }
}

}  // namespace

/// The same kind of warning is one that differs in numbers alone, up to the condition or the line that it tells.
Warnings once_each(const Warnings& warnings) {
  Warnings shown;
  std::vector<std::pair<std::string, std::size_t>> kinds;
  for (const std::string& warning : warnings) {
    std::string kind = warning.substr(0, warning.find(" at load"));
    std::erase_if(kind, [](unsigned char c) { return std::isdigit(c) || c == '.' || c == '-'; });
    const auto known = std::find_if(kinds.begin(), kinds.end(), [&](const auto& k) { return k.first == kind; });
    if (known != kinds.end()) {
      ++known->second;
      continue;
    }
    kinds.emplace_back(kind, 0);
    shown.push_back(warning);
  }
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const std::size_t others = kinds[i].second;
    if (others == 0) continue;
    const std::string what = shown[i].starts_with("line ") ? "line" : "condition";
    shown[i] += fmt::format(" (and at {} other {}{})", others, what, others > 1 ? "s" : "");
  }
  return shown;
}

Warnings doubts(const Tire& tire, const std::vector<ModelAnswers>& study) {
  Warnings warnings;
  for (const ModelAnswers& model : study) {
    if (model.choice.model != ModelKind::bekker_wong) continue;
    for (const Answer& answer : model.answers)
      if (std::string deep = too_deep(tire, answer); !deep.empty()) warnings.push_back(std::move(deep));
  }
  return once_each(warnings);
}

Warnings doubts(const SemiEmpiricalSoil& soil) {
  Warnings warnings;
  if (!(soil.k_c.value > 0.0) && !(soil.k_phi.value > 0.0))
    warnings.emplace_back("neither k_c nor k_phi is positive: this soil carries nothing, at any width of wheel");
  const double phi = soil.friction_angle.value / degree, c = soil.cohesion.value / 1000;
  expect(warnings, "n", soil.exponent.value, 0.3, 1.8, "", "plate tests give 0.5 .. 1.6");
  expect(warnings, "c", c, 0, 100, "kPa", "soft soils have 0 .. 70 kPa");
  expect(warnings, "phi", phi, 0, 50, "deg", "the densest sand has some 45 deg");
  expect(warnings, "K", 1000 * soil.shear_modulus.value, 0.5, 120, "mm", "6 mm in firm clay, 25 mm in loose sand");
  expect(warnings, "density", soil.density, 200, 2400, "kg/m^3", "fresh snow has some 250, dense gravel 2200");
  if (c == 0.0 && phi == 0.0)
    warnings.push_back("c and phi are both 0: this soil has no strength and gives no traction");
  const double most = soil.stress_angle_c1.value + std::max(0.0, soil.stress_angle_c2.value);
  if (most > bekker_wong::max_stress_share)
    warnings.push_back(fmt::format("c1 + c2 = {:.3g}: at full slip theta_m would pass {} theta_1 and is held there",
                                   most, bekker_wong::max_stress_share));
  if (soil.stress_angle_c1.value + std::min(0.0, soil.stress_angle_c2.value) < 0.0)
    warnings.push_back("c1 + c2 is negative: at full slip the largest stress would lie behind the axle");
  for (const auto& [name, value] :
       {std::pair{"n", soil.exponent}, {"phi", soil.friction_angle}, {"K", soil.shear_modulus}})
    if (value.std_error > 0.6 * value.value)
      warnings.push_back((value.value > 0.0
                              ? fmt::format("the standard deviation of {} is {:.0f} % of its value", name,
                                            100 * value.std_error / value.value)
                              : fmt::format("{} is 0 with a standard deviation, and can only be larger", name)) +
                         ": errors propagated to first order are a rough guide");
  return warnings;
}

Warnings doubts_but_unheard(const Case& question) {
  if (!question.scenario.soil.semi_empirical) return {};
  const SemiEmpiricalSoil& soil = *question.scenario.soil.semi_empirical;
  Warnings warnings = doubts(soil), at_conditions;
  add_wheel_doubts(question.scenario.tire, soil, warnings);
  const bekker_wong::BekkerWong model({.errors = false, .patch = false});
  for (const ModelChoice& choice : question.study.models) {
    if (choice.model != ModelKind::bekker_wong) continue;
    Scenario scenario = question.scenario;
    scenario.effects = choice.effects;
    for (const Answer& answer : sweep(model, scenario, question.study.conditions))
      add_condition_doubts(scenario, answer, at_conditions);
  }
  for (std::string& warning : once_each(at_conditions)) warnings.push_back(std::move(warning));
  return warnings;
}

Warnings doubts(const Case& question) {
  Warnings warnings = doubts_but_unheard(question);
  for (Unheard& one : unheard(question)) warnings.push_back(std::move(one.words));
  return warnings;
}

}  // namespace soilbin::compare
