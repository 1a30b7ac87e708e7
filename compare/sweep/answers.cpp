#include "compare/sweep/answers.hpp"

#include <algorithm>
#include <stdexcept>

#include "bekker_wong/effects/titles.hpp"
#include "bekker_wong/model.hpp"
#include "compare/report/number_text.hpp"
#include "cone_index/model.hpp"
#include "resistive_force/model.hpp"
#include "scenario/errors.hpp"

namespace soilbin::compare {

std::unique_ptr<const Model> make_model(ModelKind kind) {
  switch (kind) {
    case ModelKind::bekker_wong:
      return std::make_unique<const bekker_wong::BekkerWong>();
    case ModelKind::rft:
      return std::make_unique<const resistive_force::ResistiveForce>();
    case ModelKind::cone_index:
      return std::make_unique<const cone_index::ConeIndex>();
    case ModelKind::dem:
      break;
  }
  throw InputError("the model 'dem' is run by 'soilbin run --model dem' alone; leave it out here");
}

Answer ask(const Model& model, const Scenario& scenario, const OperatingCondition& at) {
  Answer answer{at, std::nullopt, ""};
  try {
    answer.result = model.evaluate(scenario, at);
  } catch (const NoSolution& error) {
    answer.error = error.what();
  } catch (const InputError& error) {
    answer.error = error.what();
  } catch (const std::domain_error& error) {  // of the root finder: no sign change, or a value that is not finite
    answer.error = error.what();
  }
  return answer;
}

std::vector<Answer> sweep(const Model& model, const Scenario& scenario,
                          const std::vector<OperatingCondition>& conditions, const Progress& progress) {
  std::vector<Answer> answers;
  answers.reserve(conditions.size());
  for (const OperatingCondition& at : conditions) {
    answers.push_back(ask(model, scenario, at));
    if (progress) progress(answers.size(), conditions.size());
  }
  return answers;
}

std::vector<ModelAnswers> run_study(const Case& question, const Progress& progress, const MakeModel& make) {
  const std::size_t conditions = question.study.conditions.size();
  std::vector<std::unique_ptr<const Model>> models;
  for (const ModelChoice& choice : question.study.models) models.push_back(make(choice.model));
  std::vector<ModelAnswers> study;
  for (std::size_t i = 0; i < models.size(); ++i) {
    const Scenario scenario = seen_by(question.study.models[i], question.scenario);
    const auto part = [&](std::size_t done, std::size_t) {
      if (progress) progress(i * conditions + done, models.size() * conditions);
    };
    study.push_back({question.study.models[i], sweep(*models[i], scenario, question.study.conditions, part)});
  }
  return study;
}

void keep_models(Study& study, ModelKind kind) {
  std::erase_if(study.models, [&](const ModelChoice& choice) { return choice.model != kind; });
  if (study.models.empty()) study.models.push_back({kind, {}, ""});
  label_models(study.models);
}

std::vector<OperatingCondition> conditions_of(const std::vector<Answer>& answers) {
  std::vector<OperatingCondition> all;
  for (const Answer& answer : answers) all.push_back(answer.at);
  return all;
}

bool any_result(const std::vector<ModelAnswers>& study) {
  return std::ranges::any_of(study, [](const ModelAnswers& model) {
    return std::ranges::any_of(model.answers, [](const Answer& a) { return a.result.has_value(); });
  });
}

namespace {

std::string name_of_effect(const std::string& id) {
  try {
    return std::string(bekker_wong::effect_title(id).name);
  } catch (const std::out_of_range&) {
    return spaced(id);  // of a label that somebody chose
  }
}

/// "sidewall_bulldozing:passive_wedge" as "side-wall bulldozing (passive wedge)".
std::string effect_in_words(const std::string& id) {
  const std::size_t colon = id.find(':');
  return name_of_effect(id.substr(0, colon)) +
         (colon == std::string::npos ? "" : " (" + spaced(id.substr(colon + 1)) + ")");
}

std::vector<std::string> parts_of(const std::string& label) {
  const std::string plus = " + ";
  std::vector<std::string> parts;
  for (std::size_t begin = 0, end = 0; end != std::string::npos; begin = end + plus.size()) {
    end = label.find(plus, begin);
    parts.push_back(label.substr(begin, end == std::string::npos ? end : end - begin));
  }
  return parts;
}

}  // namespace

std::string model_in_words(const std::string& label) {
  if (label == "dem") return "grains";
  if (label == "rft") return "resistive force theory";
  if (label == "cone_index") return "cone index";
  if (label == "dem-lammps") return "grains (LAMMPS)";
  if (const std::string packing = "dem packing "; label.starts_with(packing))
    return "grains, bed sample " + label.substr(packing.size());
  const std::vector<std::string> parts = parts_of(label);
  if (parts.front() != "bekker_wong") return label;
  std::string words = "analytic wheel";
  for (std::size_t i = 1; i < parts.size(); ++i)
    words += (i == 1 ? " with " : i + 1 == parts.size() ? " and " : ", ") + effect_in_words(parts[i]);
  return words;
}

std::vector<std::pair<std::string, std::string>> names_and_ids(const std::vector<std::string>& labels) {
  std::vector<std::pair<std::string, std::string>> names;
  for (const std::string& label : labels)
    if (std::pair one{model_in_words(label), label}; one.first != label && std::ranges::find(names, one) == names.end())
      names.push_back(std::move(one));
  return names;
}

}  // namespace soilbin::compare
