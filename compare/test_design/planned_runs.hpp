// Which runs to make before any is made: the conditions that are expected to tell the effects apart best.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "compare/sweep/answers.hpp"
#include "compare/test_design/effect_shapes.hpp"
#include "compare/test_design/rig_limits.hpp"

namespace soilbin::compare {

struct DesignOptions {
  int runs = 24;
  Limits limits{};                     ///< of the rig, over what the campaign's runs span
  std::vector<std::string> effects{};  ///< ids to tell apart; empty: all that the conditions can show
  ExpectedNoise noise{};               ///< of one run; all empty: usual_noise
  std::uint64_t seed = 1;              ///< of the runs' order
  int threads = 1;                     ///< changes the time, never the answer
  Progress progress{};                 ///< may throw to stop
};

/// Runs and what they are expected to tell.
struct PlannedTest {
  std::vector<OperatingCondition> runs;
  std::vector<CandidatePair> candidate_pairs;
  double named_right = 0.5;  ///< share_named_right
};

struct TestDesign {
  std::string campaign;
  std::vector<Run> runs;             ///< to make, in a drawn order; no channel is measured yet
  std::vector<std::string> varied;   ///< names of the conditions that the rig can vary
  std::vector<std::string> effects;  ///< CandidatePair's places
  std::vector<std::string> not_shown;
  ExpectedNoise noise;
  std::map<std::string, DataColumn> columns;  ///< of the campaign, by quantity: names and units of its own
  std::size_t made = 0;                       ///< runs that the campaign holds; both plans count on them
  PlannedTest planned;
  PlannedTest swept;  ///< as many runs, one condition varied at a time, the others in the middle of their ranges
};

/// N conditions within the limits that maximise share_named_right, by exchange: from the sweep, and from the conditions
/// that add most, each run is moved to where it tells most until none moves (after Fedorov; Cook and Nachtsheim 1980,
/// Technometrics 22:315). No condition more than thresholds::max_repeats times, where there are enough; so a plan is
/// never below its sweep. Conditions at which the declared soil does not carry thresholds::spare_load times the load
/// are left out. Throws InputError for effects that are unknown, declared or not shown by what varies, and for limits
/// that leave nothing to choose.
///
///     const TestDesign design = design_test(campaign, {.runs = 24, .limits = {{"load", {60, 140}}}});
///     rows_to_fill_in(design);   // runs.csv
TestDesign design_test(const Campaign& campaign, const DesignOptions& options);

/// The rows as a CSV in the campaign's own columns and units, the channels to measure empty.
std::string rows_to_fill_in(const TestDesign& design);

}  // namespace soilbin::compare
