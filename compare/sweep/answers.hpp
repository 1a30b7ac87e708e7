// Running a study: what each of its models answers at each of its conditions.
//
//   for (const ModelAnswers& model : run_study(question))
//     for (const Answer& answer : model.answers)
//       if (answer.result)
//         fmt::print("slip {:.2f}: {:.1f} N\n", answer.at.slip, answer.result->drawbar_pull.value);
//       else
//         fmt::print("slip {:.2f}: {}\n", answer.at.slip, answer.error);
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scenario/case.hpp"
#include "scenario/tractive_efficiency.hpp"

namespace soilbin::compare {

/// What a model says at one condition: a result, or why there is none.
struct Answer {
  OperatingCondition at;
  std::optional<TractionResult> result;
  std::string error;  ///< empty where there is a result
};

/// The answers of one of a study's models, in the order of the study's conditions.
struct ModelAnswers {
  ModelChoice choice;
  std::vector<Answer> answers;
};

/// Called after every condition with the number done and the number in all. May throw to stop the work.
using Progress = std::function<void(std::size_t done, std::size_t total)>;

/// The model behind a choice. Throws InputError for dem, which needs more than its name: who has a soil bin brings it.
std::unique_ptr<const Model> make_model(ModelKind kind);
using MakeModel = std::function<std::unique_ptr<const Model>(ModelKind)>;

/// One condition. A condition without solution, or one that the model refuses, becomes the answer's error.
Answer ask(const Model& model, const Scenario& scenario, const OperatingCondition& at);

/// Each condition in turn; one without solution carries its error, and the others still come.
std::vector<Answer> sweep(const Model& model, const Scenario& scenario,
                          const std::vector<OperatingCondition>& conditions, const Progress& progress = {});

/// Every model of the case's study at every condition. Throws what `make` throws.
std::vector<ModelAnswers> run_study(const Case& question, const Progress& progress = {},
                                    const MakeModel& make = make_model);

/// Leaves out a study's models of every other kind; where it has none of this one, it gets that without effects.
void keep_models(Study& study, ModelKind kind);

std::vector<OperatingCondition> conditions_of(const std::vector<Answer>& answers);

bool any_result(const std::vector<ModelAnswers>& study);

// Models as people call them, their effects by their titles (bekker_wong/effects/titles.hpp). Files, flags, JSON and
// CSV keep the ids.

/// "bekker_wong + slip_sinkage:ding" is "analytic wheel with slip sinkage (ding)", "dem" is "grains", "dem packing 2"
/// is "grains, bed sample 2". A label that somebody chose stays as it is, and so does one that is in words already.
std::string model_in_words(const std::string& label);

/// (name in words, label) of each label that a flag or a file spells otherwise than the page: once, where a reader
/// looks for what to type.
std::vector<std::pair<std::string, std::string>> names_and_ids(const std::vector<std::string>& labels);

}  // namespace soilbin::compare
