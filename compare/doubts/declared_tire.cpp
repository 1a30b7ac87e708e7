#include "compare/doubts/declared_tire.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "bekker_wong/effect.hpp"
#include "scenario/errors.hpp"
#include "scenario/tire_size.hpp"

namespace soilbin::compare {
namespace {

bool names(const Case& question, const char* effect) {
  return std::ranges::any_of(question.study.models, [&](const ModelChoice& choice) {
    return std::ranges::find(choice.effects, effect, &EffectChoice::id) != choice.effects.end();
  });
}

/// The lowest of inflation and carcass together over the conditions [kPa], and the highest where that is another.
std::vector<Said> pressures_of(const Tire& tire, const std::vector<OperatingCondition>& conditions) {
  double least = std::numeric_limits<double>::infinity(), most = 0.0;
  for (const OperatingCondition& at : conditions) {
    const double pressure = *declared_ground_pressure(tire_at(tire, at));
    least = std::min(least, pressure), most = std::max(most, pressure);
  }
  return {least / 1000, least == most ? Said("") : Said(most / 1000)};
}

/// Something that a tire may declare, the effect and the form that make it felt, and what to tell of it.
struct DeclaredByTire {
  const char* effect;
  const char* form;
  bool (*is_there)(const Case&);
  DoubtKind kind;
  std::vector<Said> (*says)(const Case&);  ///< before effect and form
};

bool has_pressures(const Case& question) {
  return std::ranges::all_of(question.study.conditions, [&](const OperatingCondition& at) {
    return declared_ground_pressure(tire_at(question.scenario.tire, at)).value_or(0.0) > 0.0;
  });
}

/// What a tire declares and the effect that it adds; of several rows with one effect the first that applies counts.
constexpr std::array<DeclaredByTire, 3> declared_by_tires = {{
    {"tire_flexibility", "carcass_spring",
     [](const Case& question) { return question.scenario.tire.deflection && has_pressures(question); },
     DoubtKind::taken_by_table, [](const Case&) { return std::vector<Said>(); }},
    {"tire_flexibility", "flat_section", has_pressures, DoubtKind::taken_as_flexible,
     [](const Case& question) { return pressures_of(question.scenario.tire, question.study.conditions); }},
    {"lug_thrust", "passive_blade",
     [](const Case& question) { return is_lugged(question.scenario.tire) && question.study.models.size() == 1; },
     DoubtKind::taken_with_lugs, [](const Case&) { return std::vector<Said>(); }},
}};

/// The effect with its defaults, in the analytic models that no fit made; whether there is any.
bool add_effect(const DeclaredByTire& declared, std::vector<ModelChoice>& models) {
  bool any = false;
  for (ModelChoice& choice : models) {
    if (choice.model != ModelKind::bekker_wong || is_fitted(choice)) continue;
    EffectChoice effect{declared.effect, declared.form, {}};
    for (const bekker_wong::EffectParameter& p : bekker_wong::find_form(effect).parameters)
      effect.parameters[p.name] = p.fallback;
    std::vector<ModelChoice> before = {{choice.model, choice.effects, ""}};
    label_models(before);
    if (choice.label == before.front().label) choice.label.clear();  // nobody gave it
    choice.effects.push_back(std::move(effect));
    any = true;
  }
  label_models(models);
  return any;
}

void make_rigid(Case& question, Doubts& notes) {
  if (names(question, "tire_flexibility"))
    throw InputError(
        "--rigid: a model of the question has the effect tire_flexibility\n  hint: leave one of the two out");
  if (std::ranges::any_of(question.study.conditions, [](const auto& at) { return at.inflation_pressure.has_value(); }))
    throw InputError(
        "--rigid: a rigid wheel has no inflation pressure, and a condition gives one\n  hint: leave one of the two "
        "out");
  std::optional<double>& pressure = question.scenario.tire.inflation_pressure;
  if (!pressure) notes.push_back({DoubtKind::rigid_already});
  pressure.reset();
  question.scenario.tire.deflection.reset();
}

void make_smooth(Case& question, Doubts& notes) {
  if (names(question, "lug_thrust"))
    throw InputError("--no-lugs: a model of the question has the effect lug_thrust\n  hint: leave one of the two out");
  Tire& tire = question.scenario.tire;
  if (!is_lugged(tire)) {
    notes.push_back({DoubtKind::smooth_already});
    return;
  }
  if (asks(question.study, ModelKind::dem))
    throw InputError(
        "--no-lugs: grains meet the tire with its lugs\n  hint: --model bekker_wong, or a tire without lugs");
  tire.lugs = {};
  std::erase_if(tire.sources, [](const auto& source) { return source.first.starts_with("lugs"); });
}

/// A tire that nobody described, only named by its size; not where radius or width are given beside it.
void tell_of_size(const Tire& tire, Doubts& notes) {
  if (tire.source.starts_with(by_size_alone) && !tire.sources.contains("radius") && !tire.sources.contains("width"))
    notes.push_back({DoubtKind::known_by_size, {tire.name, tire.source}});
}

}  // namespace

Doubts as_declared(Case& question, const TireLeftOut& left_out) {
  Doubts notes;
  tell_of_size(question.scenario.tire, notes);
  if (left_out.pressure) make_rigid(question, notes);
  if (left_out.lugs) make_smooth(question, notes);
  if (left_out.effects || !question.scenario.soil.semi_empirical || question.study.conditions.empty()) return notes;
  for (const DeclaredByTire& declared : declared_by_tires)
    if (declared.is_there(question) && !names(question, declared.effect) &&
        add_effect(declared, question.study.models)) {
      Doubt note{declared.kind, declared.says(question)};
      note.says.emplace_back(declared.effect), note.says.emplace_back(declared.form);
      notes.push_back(std::move(note));
    }
  return notes;
}

}  // namespace soilbin::compare
