// The comparison in plain words; each clause knows the rows that it rests on.
#pragma once

#include <string>
#include <vector>

#include "compare/discrepancy/comparison.hpp"
#include "compare/loop/loop.hpp"

namespace soilbin::compare {

/// A sentence and what stands behind it.
struct Clause {
  std::string about;                  ///< "drawbar pull"; "" for what concerns all
  std::string text;                   ///< whole sentences
  std::vector<std::size_t> rows;      ///< of Comparison::differences
  std::vector<std::string> evidence;  ///< what is not a row: "joint test", "budget", "the loop"
};

/// How far each pair is apart, channel by channel, largest first; what of it counts; where it comes from; what the
/// loop, where it was run, says is missing; and what the comparison can't tell.
std::vector<Clause> summary(const Comparison& comparison, const LoopAnswer* loop = nullptr);

/// "12.3 N", "4.1 mm" of a channel's number in SI.
std::string in_unit(std::size_t channel, double si);

}  // namespace soilbin::compare
