#include "compare/sweep/declared_flexibility.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <limits>

#include "bekker_wong/effect.hpp"
#include "scenario/errors.hpp"

namespace soilbin::compare {
namespace {

constexpr const char* flexibility = "tire_flexibility";
constexpr const char* form = "flat_section";

bool names_flexibility(const ModelChoice& choice) {
  return std::ranges::find(choice.effects, flexibility, &EffectChoice::id) != choice.effects.end();
}

bool has_pressure(const Tire& tire, const OperatingCondition& at) {
  return declared_ground_pressure(tire_at(tire, at)).value_or(0.0) > 0.0;
}

/// "270 kPa" or "100 .. 300 kPa": inflation and carcass together.
std::string pressures_in_words(const Tire& tire, const std::vector<OperatingCondition>& conditions) {
  double least = std::numeric_limits<double>::infinity(), most = 0.0;
  for (const OperatingCondition& at : conditions) {
    const double pressure = *declared_ground_pressure(tire_at(tire, at));
    least = std::min(least, pressure), most = std::max(most, pressure);
  }
  return least == most ? fmt::format("{:.4g} kPa", least / 1000)
                       : fmt::format("{:.4g} .. {:.4g} kPa", least / 1000, most / 1000);
}

}  // namespace

std::vector<std::string> flexible_where_declared(Case& question) {
  const std::vector<OperatingCondition>& conditions = question.study.conditions;
  std::vector<ModelChoice>& models = question.study.models;
  const Tire& tire = question.scenario.tire;
  const auto pumped = [&](const OperatingCondition& at) { return has_pressure(tire, at); };
  if (!question.scenario.soil.semi_empirical || conditions.empty() || !std::ranges::all_of(conditions, pumped) ||
      std::ranges::any_of(models, names_flexibility))
    return {};
  bool any = false;
  for (ModelChoice& choice : models) {
    if (choice.model != ModelKind::bekker_wong || is_fitted(choice)) continue;
    EffectChoice effect{flexibility, form, {}};
    for (const bekker_wong::EffectParameter& p : bekker_wong::find_form(effect).parameters)
      effect.parameters[p.name] = p.fallback;
    std::vector<ModelChoice> before = {{choice.model, choice.effects, ""}};
    label_models(before);
    if (choice.label == before.front().label) choice.label.clear();  // nobody gave it
    choice.effects.push_back(std::move(effect));
    any = true;
  }
  label_models(models);
  if (!any) return {};
  return {
      fmt::format("the tire is taken as flexible where the soil presses with more than its {} of inflation and "
                  "carcass (effect {}, form {}); --rigid for the rigid wheel",
                  pressures_in_words(tire, conditions), flexibility, form)};
}

std::vector<std::string> make_rigid(Case& question) {
  if (std::ranges::any_of(question.study.models, names_flexibility))
    throw InputError(
        "--rigid: a model of the question has the effect tire_flexibility\n  hint: leave one of the two out");
  if (std::ranges::any_of(question.study.conditions, [](const auto& at) { return at.inflation_pressure.has_value(); }))
    throw InputError("--rigid: a rigid wheel has no inflation pressure, and a condition tells one");
  std::optional<double>& pressure = question.scenario.tire.inflation_pressure;
  if (!pressure) return {"--rigid is ignored: the tire declares no inflation pressure and is rigid"};
  pressure.reset();
  return {};
}

}  // namespace soilbin::compare
