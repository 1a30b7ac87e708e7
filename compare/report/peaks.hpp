// What matters of a curve against slip: where it pulls most, where it is most efficient, where it ends.
#pragma once

#include <string>
#include <vector>

#include "compare/sweep/answers.hpp"

namespace soilbin::compare {

/// One curve of a model; the pointers go into the answers and are null where no condition has such a result.
struct Peak {
  std::string label;                           ///< of the curve: "4 kN"; "" for the only one
  const TractionResult* pull = nullptr;        ///< largest drawbar pull
  const TractionResult* efficiency = nullptr;  ///< largest tractive efficiency while driving and pulling
  const TractionResult* last = nullptr;        ///< at the largest slip
  std::size_t unsolved = 0;
};

/// A peak for each curve of a model's answers, in the order of curves_against_slip.
std::vector<Peak> peaks(const ModelAnswers& model);

}  // namespace soilbin::compare
