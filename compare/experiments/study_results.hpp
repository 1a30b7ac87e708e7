// The results of a study: each model's answers, by grains too, what is doubtful in them, and the grains' time step.
//
//   results.doubts = doubts_of(question, results, "runs.json");
//   fmt::print("{}", json_text(to_json(question, results)));
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "compare/experiments/soil_bin_runs.hpp"
#include "compare/report/json_fields.hpp"

namespace soilbin::compare {

struct StudyResults {
  std::vector<ModelAnswers> study;
  std::vector<std::string> doubts;
  std::optional<dem::StepCriteria> step;  ///< of grains
};

/// Of the question and its answers, and of the record that the runs are kept in, where it is there.
std::vector<std::string> doubts_of(const Case& question, const StudyResults& results,
                                   const std::filesystem::path& record);

/// soilbin-run/1; answers of grains with what the size of their grains does to them.
Json to_json(const Case& question, const StudyResults& results);

}  // namespace soilbin::compare
