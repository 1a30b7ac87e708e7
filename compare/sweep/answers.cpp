#include "compare/sweep/answers.hpp"

#include <algorithm>

#include "bekker_wong/model.hpp"
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

}  // namespace soilbin::compare
