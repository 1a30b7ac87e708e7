// What is doubtful in single answers: a part of the list of doubts (doubts.hpp).
#pragma once

#include <vector>

#include "compare/doubts/doubt.hpp"
#include "compare/sweep/answers.hpp"

namespace soilbin::compare {

/// Doubts of all answers, equal ones once; with `unsolved` also the conditions that have none.
Doubts doubts_of_answers(const Scenario& scenario, const std::vector<ModelAnswers>& study, bool unsolved);

/// Of an answer of the analytic wheel: a heavy tire on sand, whose other answer is told (as_in_grains); soil that is
/// carried along under a tire that sinks deeper, for its width, than any that grains have shown.
Doubts heavy_tire_doubts(const Scenario& scenario, const Answer& answer);

}  // namespace soilbin::compare
