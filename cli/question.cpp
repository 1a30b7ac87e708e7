#include "cli/question.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "compare/report/result_json.hpp"
#include "compare/sweep/alike.hpp"
#include "scenario/mapping_writer.hpp"

namespace soilbin::cli {
namespace {

const EffectFormWords& pick_form(const std::string& id, const std::string& form,
                                 const std::vector<EffectFormWords>& forms) {
  std::vector<std::string> names;
  for (const EffectFormWords& f : forms) {
    if (form.empty() || f.form == form) return f;
    names.push_back(f.form);
  }
  throw InputError(fmt::format("--effect: '{}' has no form '{}'{}\n  hint: its forms are {}", id, clipped(form),
                               did_you_mean(form, names), listed(names)));
}

void set_parameter(const std::string& text, const EffectFormWords& form, double n, EffectChoice& choice) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos)
    throw InputError(fmt::format("--effect {}: expected parameter=value, not '{}'", choice.id, clipped(text)));
  const std::string name = text.substr(0, equals);
  std::vector<std::string> names;
  for (const EffectParameterWords& parameter : form.parameters) {
    names.push_back(parameter.name);
    if (parameter.name != name) continue;
    const Measure measure{parameter.unit, {.lower = parameter.lower, .upper = parameter.upper}};
    try {
      choice.parameters[name] = read_quantity(text.substr(equals + 1), measure, n);
    } catch (const InputError& error) {
      throw InputError(fmt::format("--effect {}: {}: {}", choice.id, name, error.what()));
    }
    return;
  }
  throw InputError(fmt::format("--effect: '{}' ({}) has no parameter '{}'{}\n  hint: its parameters are {}", choice.id,
                               choice.form, clipped(name), did_you_mean(name, names), listed(names)));
}

double exponent_of(const Soil& soil) { return soil.semi_empirical ? soil.semi_empirical->exponent.value : 1.0; }

}  // namespace

EffectChoice parse_effect(const std::string& text, const EffectVocabulary& vocabulary, double n) {
  if (text.empty()) throw InputError("--effect: expected id[:form][,parameter=value...]");
  const std::vector<std::string> parts = split(text, ",");
  const std::size_t colon = parts.front().find(':');
  EffectChoice choice;
  choice.id = parts.front().substr(0, colon);
  const std::vector<EffectFormWords> forms = vocabulary.forms(choice.id);
  if (forms.empty())
    throw InputError(fmt::format("--effect: unknown effect '{}'{}\n  hint: see soilbin list effects",
                                 clipped(choice.id), did_you_mean(choice.id, vocabulary.ids())));
  const EffectFormWords& form =
      pick_form(choice.id, colon == std::string::npos ? "" : parts.front().substr(colon + 1), forms);
  choice.form = form.form;
  for (const EffectParameterWords& parameter : form.parameters) choice.parameters[parameter.name] = parameter.fallback;
  for (std::size_t i = 1; i < parts.size(); ++i) set_parameter(parts[i], form, n, choice);
  return choice;
}

std::vector<OperatingCondition> ConditionFlags::pick(const std::vector<OperatingCondition>& conditions) const {
  if (!flags_.any_given()) return conditions;
  std::vector<OperatingCondition> kept, changed;
  std::set<std::string> seen;
  for (const OperatingCondition& at : conditions) {
    OperatingCondition asked = at;
    flags_.apply(asked);
    if (compare::alike(asked, at)) kept.push_back(at);
    if (seen.insert(compare::to_json(asked).dump()).second) changed.push_back(asked);
  }
  return kept.empty() ? changed : kept;
}

Question::Question(CLI::App& app, std::vector<std::string> needed) : needed_(std::move(needed)) {
  app.add_option("case", case_name_, "a case file, or a study of the library")->type_name("CASE");
  app.add_option("--soil", soil_, "of the library, or a YAML file")->type_name("NAME|FILE")->group("Tire and soil");
  app.add_option("--tire", tire_, "of the library, or a YAML file")->type_name("NAME|FILE")->group("Tire and soil");
  wheel_.add_to(app, "Tire and soil");
  lugs_.add_to(app, "Tire and soil", "lug-");
  bin_.add_to(app, "Tire and soil", "bin-");
  condition_.add_to(app);
  app.add_option("--effect", effects_, "switch an effect on; may be given again; none: the case's off")
      ->type_name("ID[:FORM][,PARAMETER=VALUE...]")
      ->allow_extra_args(false)
      ->group("Model");
}

void Question::override_tire(Tire& tire, const Workplace& place) const {
  if (!tire_.empty()) tire = find_tire(tire_, place.library);
  wheel_.apply(tire);
  lugs_.apply(tire.lugs);
  if (tire.name.empty()) tire.name = "wheel";
}

Case Question::from_flags(const Workplace& place) const {
  if (soil_.empty())
    throw InputError("which soil? --soil NAME or a file\n  hint: there are " +
                     listed(place.library.names(Shelf::soils)));
  if (tire_.empty() && !(wheel_.given("radius") && wheel_.given("width")))
    throw InputError(
        "which wheel? --radius and --width (such as --radius 110mm --width 100mm), or --tire NAME\n"
        "  hint: there are " +
        listed(place.library.names(Shelf::tires)));
  for (const std::string& key : needed_)
    if (!condition_.given(key)) throw InputError(fmt::format("--{} is missing (such as --load 80N --slip 20%)", key));
  Case question;
  question.name = "estimate";
  override_tire(question.scenario.tire, place);
  question.scenario.soil = find_soil(soil_, place.library);
  question.study.name = question.name;
  question.study.conditions.emplace_back();
  condition_.apply(question.study.conditions.back());
  question.study.models.push_back({ModelKind::bekker_wong, {}, "bekker_wong"});
  return question;
}

Case Question::ask(const Workplace& place) const {
  Case question = case_name_.empty() ? from_flags(place) : find_study(place, case_name_);
  if (!case_name_.empty()) {
    override_tire(question.scenario.tire, place);
    if (!soil_.empty()) question.scenario.soil = find_soil(soil_, place.library);
    question.study.conditions = condition_.pick(question.study.conditions);
  }
  if (bin_.any_given()) {
    if (!question.scenario.bin) question.scenario.bin.emplace();
    bin_.apply(*question.scenario.bin);
    if (!(question.scenario.bin->depth > 0.0 && question.scenario.bin->width > 0.0))
      throw InputError("a bin needs both --bin-depth and --bin-width");
  }
  if (effects_.empty()) return question;
  ModelChoice choice{ModelKind::bekker_wong, {}, "bekker_wong"};
  const bool none = std::find(effects_.begin(), effects_.end(), "none") != effects_.end();
  if (none && effects_.size() > 1) throw InputError("--effect none stands alone: it switches every effect off");
  for (const std::string& text : none ? std::vector<std::string>{} : effects_) {
    choice.effects.push_back(parse_effect(text, place.effects, exponent_of(question.scenario.soil)));
    choice.label += " + " + choice.effects.back().id;
  }
  question.study.models = {choice};
  return question;
}

nlohmann::ordered_json answers_json(const Case& question, const std::vector<compare::ModelAnswers>& study) {
  return {{"format", "soilbin-estimate/1"},
          {"tire", question.scenario.tire.name},
          {"soil", question.scenario.soil.name},
          {"rows", compare::rows_json(study)}};
}

}  // namespace soilbin::cli
