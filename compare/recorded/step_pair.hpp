// Whether the results of a record depend on the time step: the same condition on the same bed, run at the step and at
// half of it.
//
//   for (const StepPair& pair : step_pairs(record))
//     if (!agrees(pair)) fmt::print("{}\n", in_words(pair));  // the numbers belong to the step, not to the soil
#pragma once

#include <array>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "compare/doubts/doubt.hpp"
#include "compare/recorded/record.hpp"

namespace soilbin::compare {

/// One run and its like at half the step, which are two of the many motions that grains of one bed may take. Points
/// into the record.
struct StepPair {
  const RecordedRun *whole, *half;
  /// Half less whole, drawbar pull, torque, sinkage. Its error is that of both runs, widened by packing_factor
  /// (recorded_model.hpp) where the record has packings enough to know it, else by usual_packing_factor: a run's early
  /// errors don't hold what it shares from its start to its end, as how deep it dug. None where either run has no
  /// result.
  std::optional<std::array<Estimate, 3>> difference;
  bool widened = false;  ///< whether any of the errors is
};

/// Largest difference of alike channels [standard errors]: of three that are alike in truth, one exceeds it in one pair
/// of twenty (normal errors, Bonferroni).
inline constexpr double step_alike = 2.4;

std::vector<StepPair> step_pairs(const Record& record);

/// Whether no channel differs by more than step_alike standard errors. A pair without results is not.
bool agrees(const StepPair& pair);

/// "at 8 kN, slip 60 %, bed sample 1, half the step changes pull by 12 ± 30 N (0.4 errors), ...".
std::string in_words(const StepPair& pair);

/// The doubt in a record whose step nobody tested, or whose answers hang on it; none where a pair agrees and no other
/// doesn't.
Doubts step_doubts(const Record& record);

/// A pair that should be alike is not.
struct TimeStepMatters : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The condition of a study at which its step is tested: the largest load, of these the steepest, of these the most
/// yaw, of these the most slip. Throws InputError for none.
OperatingCondition hardest(const std::vector<OperatingCondition>& conditions);

}  // namespace soilbin::compare
