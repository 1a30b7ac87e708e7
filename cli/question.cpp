#include "cli/question.hpp"

#include <fmt/core.h>

#include <cmath>

#include "cli/flag_values.hpp"
#include "compare/doubts/doubts.hpp"
#include "compare/sweep/result_json.hpp"
#include "compare/sweep/varying.hpp"
#include "scenario/beds.hpp"
#include "scenario/condition_axes.hpp"
#include "scenario/mapping_writer.hpp"
#include "scenario/soil_parameters.hpp"
#include "scenario/source_text.hpp"

namespace soilbin::cli {

namespace {

const EffectFormWords& pick_form(const std::string& id, const std::string& form,
                                 const std::vector<EffectFormWords>& forms) {
  std::vector<std::string> names;
  for (const EffectFormWords& f : forms) {
    if (form.empty() || f.form == form) return f;
    names.push_back(f.form);
  }
  throw InputError(fmt::format("--effect: '{}' has no variant '{}'{}\n  hint: its variants are {}", id, clipped(form),
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

/// A condition, and the rotation [rad/s] from which it got its speed, if any.
struct AskedCondition {
  OperatingCondition at;
  std::optional<double> rotation;
};

std::vector<AskedCondition> with_rotations(const Study& study) {
  std::vector<AskedCondition> all;
  for (const OperatingCondition& at : study.conditions)
    all.push_back({at, all.size() < study.rotations.size() ? study.rotations[all.size()] : std::nullopt});
  return all;
}

double implied_speed(const AskedCondition& one, const Tire& tire) {
  try {
    return speed_at_rotation(one.at, *one.rotation, tire);
  } catch (const InputError& error) {
    throw InputError(fmt::format(
        "{}\n  hint: the case gives 'rotation', from which no speed follows here; give --speed too", error.what()));
  }
}

/// A soil that lacks what a model needs, beside those of the library that have it.
[[noreturn]] void refuse_soil(const Soil& soil, const char* lacks, const Library& library, bool (*has)(const Soil&)) {
  std::vector<std::string> right;
  for (const std::string& name : library.names(Shelf::soils))
    if (has(find_soil(name, library))) right.push_back(name);
  throw InputError(
      fmt::format("soil '{}' has no {}\n  hint: these have: {}", clipped(soil.name), lacks, listed(right)));
}

/// Some names of a shelf, one a kind, where the library has them; else all that it has.
std::string some_of(Shelf shelf, std::initializer_list<const char*> one_a_kind, const Library& library) {
  std::vector<std::string> some;
  for (const char* name : one_a_kind)
    if (library.find(shelf, name)) some.emplace_back(name);
  if (some.empty()) return "there are " + listed(library.names(shelf));
  return fmt::format("such as {}; soilbin list {} has them all", listed(some), folder_of(shelf));
}

/// A value without a deviation keeps the one that it had; an assumed share stays a share.
void set_value(const SoilParameter& p, const std::string& text, SemiEmpiricalSoil& soil) {
  const auto [value, deviation] = value_and_deviation(text);
  const double n = soil.exponent.value;
  Estimate& into = soil.*p.value;
  const bool assumed = has_assumed_sd(soil, into);
  try {
    into.value = read_quantity(value, p.measure(), n);
    if (assumed) into.std_error = *soil.assumed_sd * std::abs(into.value);
    if (!deviation.empty()) into.std_error = read_quantity(deviation, {p.unit, zero_or_more}, n);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", flag_of("", p.name), error.what()));
  }
}

EffectChoice parse_effect(const std::string& text, const EffectVocabulary& vocabulary, const Soil& soil) {
  if (text.empty()) throw InputError("--effect: expected id[:form][,parameter=value...]");
  const std::vector<std::string> parts = split(text, ",");
  const std::size_t colon = parts.front().find(':');
  EffectChoice choice;
  choice.id = parts.front().substr(0, colon);
  const std::vector<EffectFormWords> forms = vocabulary.forms(choice.id);
  if (forms.empty())
    throw InputError(fmt::format("--effect: unknown effect '{}'{}\n  hint: see soilbin list effects",
                                 clipped(choice.id), did_you_mean(choice.id, vocabulary.ids())));
  const std::string named = colon == std::string::npos ? "" : parts.front().substr(colon + 1);
  const EffectFormWords& form = pick_form(choice.id, named, forms);
  choice.form = form.form;
  for (const EffectParameterWords& parameter : form.parameters) choice.parameters[parameter.name] = parameter.fallback;
  for (std::size_t i = 1; i < parts.size(); ++i) set_parameter(parts[i], form, exponent_of(soil), choice);
  return choice;
}

}  // namespace

compare::Doubts joined_doubts(compare::Doubts notes, const Case& question,
                              const std::vector<compare::ModelAnswers>& study) {
  append(notes, compare::doubts(question, study));
  return notes;
}

AnalyticSoil::AnalyticSoil(const std::string& named, const Library& library, Soil& soil) : own_(soil.name) {
  if (named.empty()) return;
  const Soil given = find_soil(named, library);
  soil.semi_empirical = given.semi_empirical, soil.beds = given.beds, soil.bed_density = given.bed_density;
  values_of_ = given.name.empty() ? named : given.name;
}

std::string AnalyticSoil::title(bool grains) const {
  if (values_of_.empty() || values_of_ == own_) return own_;
  return grains ? fmt::format("{}, analytic values of {}", own_, values_of_) : values_of_;
}

void add_effect(std::vector<EffectChoice>& effects, const std::string& text, const EffectVocabulary& vocabulary,
                const Soil& soil) {
  EffectChoice effect = parse_effect(text, vocabulary, soil);
  for (const EffectChoice& known : effects)
    if (known.id == effect.id)
      throw InputError(
          fmt::format("--effect: '{}' is given twice ({} and {}): its variants describe the same physics\n"
                      "  hint: give one variant; a case file can set models with different variants side by side",
                      effect.id, known.form, effect.form));
  effects.push_back(std::move(effect));
}

std::vector<EffectChoice> effects_named(const std::vector<std::string>& texts, const EffectVocabulary& vocabulary,
                                        const Soil& soil) {
  std::vector<EffectChoice> effects;
  for (const auto& [word, does] : {std::pair{"none", "it switches every effect off"},
                                   {"declared", "it leaves those that the tire itself declares"}}) {
    if (std::ranges::find(texts, word) == texts.end()) continue;
    if (texts.size() > 1) throw InputError(fmt::format("--effect {} excludes all others: {}", word, does));
    return effects;
  }
  for (const std::string& text : texts) add_effect(effects, text, vocabulary, soil);
  return effects;
}

std::vector<OperatingCondition> ConditionFlags::conditions() const {
  std::vector<OperatingCondition> all;
  for (const Flags& flags : combinations()) flags.apply(all.emplace_back());
  return all;
}

void ConditionFlags::pick(Case& question) const {
  const Study study = question.study;
  Study& all = question.study;
  all.conditions.clear(), all.rotations.clear();
  for (const Flags& flags : combinations()) {
    const Study some = picked(flags, study, question.scenario.tire);
    all.conditions.insert(all.conditions.end(), some.conditions.begin(), some.conditions.end());
    all.rotations.insert(all.rotations.end(), some.rotations.begin(), some.rotations.end());
  }
  question.on_command_line.merge(given_keys());
}

std::set<std::string> ConditionFlags::given_keys() const {
  const std::vector<std::string> keys = flags_.given_keys();
  return {keys.begin(), keys.end()};
}

void ErrorFlag::apply(Case& question) const {
  if (!exact_) return;
  std::optional<SemiEmpiricalSoil>& soil = question.scenario.soil.semi_empirical;
  const bool any = soil && std::ranges::any_of(soil_parameters, [&](const SoilParameter& p) {
                     return has_assumed_sd(*soil, (*soil).*p.value);
                   });
  if (any)
    soil = without_assumed_sd(*soil);
  else
    question.on_command_line.insert("no_assumed_sd");
}

void QuickModelFlag::apply(Case& question, bool names_effects) const {
  if (model_.empty()) return;
  if (model_ == word_of(ModelKind::dem))
    throw InputError("--model dem: grains are run, not estimated\n  hint: soilbin run CASE --model dem");
  std::vector<std::string> names;
  for (const ModelKind kind : quick_models) names.emplace_back(word_of(kind));
  check_model(model_, names);
  const ModelKind kind = read_word<ModelKind>("--model", model_);
  if (names_effects && kind != ModelKind::bekker_wong)
    throw InputError(fmt::format("--effect means nothing to --model {}\n  hint: leave one of them out", model_));
  compare::keep_models(question.study, kind);
}

Study ConditionFlags::picked(const Flags& flags, const Study& study, const Tire& tire) {
  std::vector<AskedCondition> asked = with_rotations(study);
  bool overridden = false;
  for (const std::string& key : flags.given_keys()) {
    std::vector<AskedCondition> agreeing, changed = asked;
    for (std::size_t i = 0; i < asked.size(); ++i) {
      flags.apply(changed[i].at, key);
      if (key == "speed") asked[i].rotation.reset(), changed[i].rotation.reset();
      if (compare::alike(changed[i].at, asked[i].at)) agreeing.push_back(asked[i]);
    }
    overridden = overridden || agreeing.empty();
    asked = agreeing.empty() ? changed : agreeing;
  }
  Study kept = {study.name, study.models, {}, {}};
  std::set<std::string> seen;
  for (AskedCondition& one : asked) {
    if (one.rotation) one.at.speed = implied_speed(one, tire);
    if (overridden && !seen.insert(compare::to_json(one.at).dump()).second) continue;
    kept.conditions.push_back(one.at);
    kept.rotations.push_back(one.rotation);
  }
  return kept;
}

void pick_bed(Soil& soil, const std::string& density) {
  const double asked = read_flag("--density", density, {"kg/m^3", above_zero});
  try {
    set_density(soil, asked);
  } catch (const InputError& error) {
    throw InputError(fmt::format("--density: {}", error.what()));
  }
}

void SoilFlags::add_to(CLI::App& app, const std::string& heading) {
  const auto add = [&](const char* key, const std::string& unit, const char* meaning) {
    add_value(app, flag_of("", key), texts_[key], unit, meaning)->group(heading);
  };
  for (const SoilParameter& p : soil_parameters)
    add(p.name, std::string(p.unit) == "-" ? "NUMBER[+-SD]" : std::string(p.unit) + "[+-SD]", p.meaning);
  for (const ExactSoilValue& exact : exact_soil_values) add(exact.name, exact.unit, exact.meaning);
}

bool SoilFlags::any_given() const {
  return std::ranges::any_of(texts_, [](const auto& entry) { return !entry.second.empty(); });
}

void SoilFlags::apply(Soil& soil) const {
  if (!any_given()) return;
  if (!soil.semi_empirical)
    throw InputError(
        fmt::format("soil '{}' has values for grains alone: a flag such as --friction-angle has nothing to change\n"
                    "  hint: begin with another --soil",
                    clipped(soil.name)));
  put_exact_values(soil);
  SemiEmpiricalSoil& values = *soil.semi_empirical;
  bool changed = soil.beds.empty() || !texts_.at("gravity").empty();
  for (const SoilParameter& p : soil_parameters)  // n first: the units of k_c and k_phi depend on it
    if (const std::string& text = texts_.at(p.name); !text.empty()) {
      const double before = (values.*p.value).value;
      set_value(p, text, values);
      changed = true;
      if (p.value != &SemiEmpiricalSoil::exponent || values.exponent.value != before)  // a doubt asks whether n changed
        values.sources[p.name] = command_line_source;
    }
  if (!texts_.at("reference_sinkage").empty() && !(values.exponent.std_error > 0.0))
    throw InputError(
        "--reference-sinkage says about which sinkage n errs, and n has no standard deviation\n"
        "  hint: such as --exponent 1.1+-0.1");
  if (soil.granular) soil.granular->gravity = values.gravity;
  if (changed) soil.name += ", changed";
}

void SoilFlags::put_exact_values(Soil& soil) const {
  for (const ExactSoilValue& exact : exact_soil_values) {
    const std::string& text = texts_.at(exact.name);
    if (text.empty()) continue;
    if (!value_and_deviation(text).second.empty())
      throw InputError(fmt::format("--{0}: a {0} has no standard deviation here\n  hint: such as --{0} {1}", exact.name,
                                   exact.example));
    const double value = read_flag(flag_of("", exact.name), text, exact.measure());
    if (exact.value == &SemiEmpiricalSoil::density && !soil.beds.empty()) pick_bed(soil, text);
    (*soil.semi_empirical).*exact.value = value;
    soil.semi_empirical->sources[exact.name] = command_line_source;
  }
}

Question::Question(CLI::App& app, std::vector<std::string> needed, const std::vector<std::string>& without)
    : needed_(std::move(needed)) {
  add_value(app, "case", case_name_, "CASE", "a case file, or a study of the library");
  add_value(app, "--soil", soil_, "NAME|FILE", "a soil of the library, or a YAML file")->group("Tire and soil");
  add_value(app, "--tire", tire_, "NAME|FILE", "a tire of the library, its size (600/65R28), or a YAML file")
      ->group("Tire and soil");
  wheel_.add_to(app, "Tire and soil", "", {"inflation_pressure"});  // a condition's
  lugs_.add_to(app, "Tire and soil", "lug-");
  bin_.add_to(app, "Tire and soil", "bin-");
  soil_values_.add_to(app, "Values of the soil, in place of its own");
  condition_.add_to(app, without);
  errors_.add_to(app);
  add_repeatable(
      app, "--effect", effects_, "ID[:FORM][,PARAMETER=VALUE...]",
      "switch an effect on; may be given again; none: all off; declared: the case's off, what the tire declares on")
      ->group("Model");
}

void Question::override_tire(Tire& tire, const Workplace& place) const {
  if (!tire_.empty()) tire = find_tire(tire_, place.library);
  wheel_.apply(tire);
  lugs_.apply(tire.lugs);
  if (const std::string why = why_no_gaps(tire); !why.empty())
    throw InputError(why + "\n  hint: fewer or thinner lugs");
  const std::vector<std::string> of_wheel = wheel_.given_keys(), of_lugs = lugs_.given_keys();
  for (const std::string& key : of_wheel) tire.sources[key] = command_line_source;
  for (const std::string& key : of_lugs) tire.sources["lugs." + key] = command_line_source;
  if (tire.name.empty())
    tire.name = "wheel";
  else if (!of_wheel.empty() || !of_lugs.empty())
    tire.name += ", changed";
}

Case Question::from_flags(const Workplace& place) const {
  if (soil_.empty())
    throw InputError(
        "which soil? --soil NAME or a file\n  hint: " +
        some_of(Shelf::soils, {"dry-sand", "sandy-loam", "clayey-soil", "snow", "lunar-regolith"}, place.library));
  if (tire_.empty() && !(wheel_.given("radius") && wheel_.given("width")))
    throw InputError(
        "which wheel? --radius and --width (such as --radius 110mm --width 100mm), or --tire NAME, or its size "
        "(540/65R30)\n"
        "  hint: " +
        some_of(Shelf::tires, {"14.00R20", "18.4-38", "hmmwv", "passenger-205-55r16", "curiosity"}, place.library));
  for (const std::string& key : needed_)
    if (!condition_.given(key))
      throw InputError(
          fmt::format("--{} is missing\n  hint: such as --{}", key, key == "slip" ? "slip 20%" : "load 80N"));
  Case question;
  question.name = "estimate";
  override_tire(question.scenario.tire, place);
  question.scenario.soil = find_soil(soil_, place.library);
  question.study.name = question.name;
  question.study.conditions = condition_.conditions();
  question.on_command_line = condition_.given_keys();
  question.study.models.push_back({ModelKind::bekker_wong, {}, "bekker_wong"});
  return question;
}

Case Question::ask(const Workplace& place) const {
  Case question = case_name_.empty() ? from_flags(place) : find_study(place, case_name_);
  if (!case_name_.empty()) {
    override_tire(question.scenario.tire, place);
    if (!soil_.empty()) {
      question.scenario.soil = find_soil(soil_, place.library);
      for (ModelChoice& choice : question.study.models)
        choice.errors.clear(), choice.misfit = {};  // of the soil that was fitted
    }
    condition_.pick(question);
  }
  errors_.apply(question);
  soil_values_.apply(question.scenario.soil);
  if (bin_.any_given()) {
    if (!question.scenario.bin) question.scenario.bin.emplace();
    bin_.apply(*question.scenario.bin);
    question.on_command_line.insert("bin");
    if (!(question.scenario.bin->depth > 0.0 && question.scenario.bin->width > 0.0))
      throw InputError("a bin needs both --bin-depth and --bin-width");
  }
  if (effects_.empty()) return question;
  ModelChoice choice;
  choice.effects = effects_named(effects_, place.effects, question.scenario.soil);
  question.study.models = {choice};
  label_models(question.study.models);
  return question;
}

nlohmann::ordered_json document_of(const char* format, const Case& question, nlohmann::ordered_json rows,
                                   const EffectVocabulary& effects) {
  return {{"format", format},
          {"tire", question.scenario.tire.name},
          {"soil", question.scenario.soil.name},
          {"case", write_case(question, effects)},
          {"rows", std::move(rows)}};
}

void require_semi_empirical(const Case& question, const Library& library) {
  if (question.scenario.soil.semi_empirical || !asks(question.study, ModelKind::bekker_wong)) return;
  refuse_soil(question.scenario.soil, "semi_empirical values, which bekker_wong needs", library,
              [](const Soil& soil) { return soil.semi_empirical.has_value(); });
}

void require_grains(const Case& question, const Library& library) {
  if (question.scenario.soil.granular || !asks(question.study, ModelKind::dem)) return;
  refuse_soil(question.scenario.soil, "values of grains (granular:), which the model dem needs", library,
              [](const Soil& soil) { return soil.granular.has_value(); });
}

}  // namespace soilbin::cli
