#include "cli/serve/setup.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <optional>

#include "cli/question.hpp"
#include "cli/serve/controls.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/sweep/answers.hpp"
#include "compare/sweep/varying.hpp"
#include "scenario/mapping_writer.hpp"
#include "scenario/quantity.hpp"

namespace soilbin::cli {
namespace {

using Json = nlohmann::ordered_json;

/// The largest number of values in a query, of which one is to be left.
constexpr std::size_t most_asked_at_once = 100;

constexpr double usual_slip = 0.2;  ///< where a page starts, as near as the case allows

/// Each member that has a value as a flag.
std::vector<Flag> as_flags(const OperatingCondition& at) {
  std::vector<Flag> flags;
  each_member<OperatingCondition>([&](const char* key, auto member, const auto& limits, const char*) {
    const auto& value = at.*member;
    using Value = std::decay_t<decltype(value)>;
    const std::string flag = key_of("", key);
    if constexpr (std::is_same_v<Value, double>)
      flags.emplace_back(flag, without_blanks(write_quantity(value, shown_unit(limits.unit))));
    else if constexpr (std::is_same_v<Value, std::optional<double>>) {
      if (value) flags.emplace_back(flag, without_blanks(write_quantity(*value, limits.unit)));
    } else if constexpr (std::is_same_v<Value, std::optional<int>>) {
      if (value) flags.emplace_back(flag, std::to_string(*value));
    } else if constexpr (std::is_same_v<Value, int>)
      flags.emplace_back(flag, std::to_string(value));
    else
      flags.emplace_back(flag, word_of(value));
  });
  return flags;
}

/// The flags of one condition that tell it from the others.
std::vector<Flag> telling(const OperatingCondition& one, const std::vector<OperatingCondition>& all) {
  std::vector<Flag> same = as_flags(one), flags;
  for (const OperatingCondition& at : all) {
    const std::vector<Flag> other = as_flags(at);
    const auto differs = std::stable_partition(
        same.begin(), same.end(), [&](const Flag& flag) { return std::ranges::find(other, flag) != other.end(); });
    flags.insert(flags.end(), differs, same.end());
    same.erase(differs, same.end());
  }
  return flags;
}

/// Whether the flags name a model that takes no effects.
bool names_other_model(const std::vector<Flag>& flags) {
  return std::ranges::any_of(
      flags, [](const Flag& flag) { return flag.first == "model" && flag.second != word_of(ModelKind::bekker_wong); });
}

/// The models that answer while a slider moves.
Json models_json() {
  return compare::list_of(quick_models, [](ModelKind kind) {
    const std::string name(word_of(kind));
    return Json{{"name", name}, {"title", compare::model_in_words(name)}};
  });
}

}  // namespace

Json soils_json(const Library& library) {
  Json names = Json::array();
  for (const std::string& name : library.names(Shelf::soils)) {
    try {
      if (find_soil(name, library).semi_empirical) names.push_back(name);
    } catch (const InputError&) {  // told by `soilbin list soils`
    }
  }
  return names;
}

std::string model_of(const Case& question) {
  return compare::model_in_words(std::string(word_of(question.study.models.front().model)));
}

Setup::Setup(const Workplace& place, std::string case_name, std::vector<Flag> flags)
    : place_(place), case_name_(std::move(case_name)), start_(std::move(flags)) {
  const Case question = put_together({}).question;
  const std::vector<OperatingCondition>& all = question.study.conditions;
  const auto first = std::ranges::min_element(
      all, [](const auto& a, const auto& b) { return std::abs(a.slip - usual_slip) < std::abs(b.slip - usual_slip); });
  const std::vector<std::optional<double>>& rotations = question.study.rotations;
  const bool turns = !rotations.empty() && rotations[first - all.begin()].has_value();
  for (const Flag& flag : telling(*first, all))
    if (!holds(start_, flag.first) && !(turns && flag.first == "speed")) start_.push_back(flag);  // its speed follows
  const ModelChoice& model = question.study.models.front();
  if (!holds(start_, "effect") && !names_other_model(start_) &&
      (question.study.models.size() > 1 || model.model != ModelKind::bekker_wong)) {
    for (const EffectChoice& choice : model.effects)
      start_.emplace_back("effect", effect_word(choice, question.scenario.soil));
    if (model.effects.empty()) start_.emplace_back("effect", "declared");
  }
  if (is_told_in_kilonewtons(ask({}).question.study.conditions.front().load)) force_unit_ = "kN";
}

Asked Setup::put_together(const std::vector<Flag>& query) const {
  Asked asked;
  const bool other_tire = holds(query, "tire"), other_soil = holds(query, "soil");
  const bool other_model = names_other_model(query);
  asked.words = words_of("estimate", case_name_, start_, query, [&](const Flag& flag) {
    return (other_tire && is_tire_flag(flag.first)) || (other_soil && is_soil_flag(flag.first)) ||
           (other_model && flag.first == "effect");
  });
  CLI::App app("", asked.words.front());
  app.set_help_flag("");
  Question question(app);
  TireFlags tire;
  tire.add_to(app);
  QuickModelFlag model;
  model.add_to(app);
  if (!query.empty()) question.allow_conditions(most_asked_at_once);  // a server is not kept busy by one address
  read_words(app, asked.words);
  asked.question = question.ask(place_);
  model.apply(asked.question, question.names_effects());
  asked.base_model = question.switches_effects_off();
  asked.tire = tire;
  return asked;
}

Asked Setup::ask(const std::vector<Flag>& query) const {
  refuse_files(query, place_.library);
  Asked asked = put_together(query);
  if (const std::size_t conditions = asked.question.study.conditions.size(); conditions != 1)
    throw InputError(
        fmt::format("{} conditions are left, where one is asked for\n  hint: give those that the case varies: load, "
                    "slip, pass, moisture, ...",
                    conditions));
  return asked;
}

Json Setup::document() const {
  const Case question = ask({}).question;
  const ModelChoice& model = question.study.models.front();
  return {{"format", "soilbin-serve/1"},
          {"tire", in_words(question.scenario.tire)},
          {"tire_name", question.scenario.tire.name},
          {"soil", compare::in_words(question.scenario.soil)},
          {"tires", place_.library.names(Shelf::tires)},
          {"soils", soils_json(place_.library)},
          {"models", models_json()},
          {"model", word_of(model.model)},
          {"numbers", numbers_json(question, force_unit_)},
          {"effects", effects_json(model.effects, question.scenario.soil)}};
}

}  // namespace soilbin::cli
