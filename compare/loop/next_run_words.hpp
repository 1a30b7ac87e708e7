// What to measure next, in words and as rows: the run that sets the candidates apart (next_test), or where nothing has
// a name the runs that show how the unexplained part depends on a condition.
//
//   for (const std::string& sentence : what_next(answer)) fmt::print("{}\n", sentence);
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "compare/loop/loop.hpp"

namespace soilbin::compare {

/// What to measure next, or why no run is proposed: first what to do, then sentences on why. Empty where no question is
/// open.
std::vector<std::string> what_next(const LoopAnswer& answer);

/// Whether the run of LoopAnswer::next is worth making: not where the sets that it decides between are a hundred to one
/// apart already and neither explains the data.
bool proposes_next(const LoopAnswer& answer);

/// At an unknown effect: what the residual depends on (after the model's effects, where it takes any), surest first, as
/// many as keep the false-discovery rate at 5 %.
std::vector<Dependence> sure_dependences(const LoopAnswer& answer);

/// Of an unknown effect that depends on a condition (sure_dependences): runs that show how, with that condition alone
/// at five settings over the range that was run, all else as in the run that the model misses most. Empty where none is
/// known.
std::vector<OperatingCondition> shape_series(const LoopAnswer& answer);

/// A number in three digits.
std::string setting(double value);

/// A condition of a run to be made as the rig would be set to it (rig_setting) [SI]; not a number where it is not
/// known.
double rig_setting_of(const LoopAnswer& answer, const OperatingCondition& at, const std::string& condition);

/// A condition of a run to be made as the rig would be set to it (rig_setting), in the unit of the campaign's own
/// column, and that unit: ("10", "mm/s"). An empty value where the condition is not known.
std::pair<std::string, std::string> next_setting(const LoopAnswer& answer, const OperatingCondition& at,
                                                 const std::string& condition);

}  // namespace soilbin::compare
