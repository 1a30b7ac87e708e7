// What the files of the list of doubts (doubts.hpp) share; nobody else includes it.
#pragma once

#include <string>
#include <vector>

#include "compare/sweep/answers.hpp"

namespace soilbin::compare {

/// Whether answers stand beside the doubts: then what has none is told there, and grains that weren't asked are left
/// aside.
enum class Answered { no, yes };

/// doubts(question, study) without what changes nothing.
std::vector<std::string> doubts_but_unheard(const Case& question, const std::vector<ModelAnswers>& study,
                                            Answered answered);

/// The analytic models' answers without errors and stresses, which no doubt asks for.
std::vector<ModelAnswers> quick_answers(const Case& question);

}  // namespace soilbin::compare
