#include "compare/experiments/study_results.hpp"

#include <filesystem>

#include "compare/doubts/doubts.hpp"
#include "compare/doubts/grain_resolution.hpp"
#include "compare/recorded/step_pair.hpp"
#include "compare/sweep/result_json.hpp"

namespace soilbin::compare {
namespace {

/// rows_json, with what the size of the grains does to their answers.
Json rows_with_resolution(const Case& question, const StudyResults& results) {
  Json rows = rows_json(results.study);
  auto row = rows.begin();
  for (const ModelAnswers& model : results.study)
    for (const Answer& answer : model.answers) {
      if (model.choice.model == ModelKind::dem && answer.result)
        (*row)["resolution_error"] =
            to_json(resolution_error(question.scenario, answer.at, answer.result->sinkage.value));
      ++row;
    }
  return rows;
}

}  // namespace

std::vector<std::string> doubts_of(const Case& question, const StudyResults& results,
                                   const std::filesystem::path& record) {
  std::vector<std::string> all = doubts(question, results.study);
  if (std::filesystem::exists(record))
    for (std::string& doubt : step_doubts(read_record(record))) all.push_back(std::move(doubt));
  return all;
}

Json to_json(const Case& question, const StudyResults& results) {
  Json document = {{"format", "soilbin-run/1"},
                   {"study", question.study.name},
                   {"tire", question.scenario.tire.name},
                   {"soil", question.scenario.soil.name},
                   {"rows", rows_with_resolution(question, results)}};
  add_warnings(document, results.doubts);
  if (results.step) document["dem"] = to_json(*results.step);
  return document;
}

}  // namespace soilbin::compare
