// Stage 7 of the loop: the next run to make, where the candidates disagree most in units of what a run can tell.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "compare/attribution/choice.hpp"
#include "compare/test_design/rig_limits.hpp"

namespace soilbin::compare {

struct NextRun {
  OperatingCondition at;
  std::vector<std::string> quantities;  ///< names (ConditionView) of the conditions that matter: those that limits hold
  Limits given;                         ///< what the rig was said to reach; elsewhere the campaign bounds it
  std::vector<std::string> beyond;      ///< those of them that lie outside what the campaign has run
  std::vector<std::set<std::string>> separates;  ///< the best candidate, and the one that these runs bear most upon
  int runs = 0;           ///< until that one is expected to be out of the set, if the best is true
  double distance = 0.0;  ///< squared distance of the two predictions a run, in sd
};

/// The condition within limits that is expected to put most candidates out: sum over candidates i, by their weight, of
/// what one run would do against each other one j if i were true, min(1, d/d_needed). d is the squared distance between
/// their predictions over noise plus the predictions' own uncertainty and the tolerance of their forms (Buzzi-Ferraris
/// and Forzatti 1983, Chem. Eng. Sci. 38:225); a run adds d/2 to the ln evidence between them, and j is out where it
/// stands further behind than allowed. On a grid, then one condition after the other on a finer one.
/// The candidates are those that compete with the best one (competitors); where it stands by itself, the set that
/// stands next behind it (the base model where there is none), to be surer still, unless that one is excluded already
/// (is_settled): then nothing. limits: where nothing is given, what was run, and where no condition there decides in
/// thresholds::few_runs, limits_of the observations and the wheel; no condition leaves what was run where it
/// decides as much there. Nothing where no condition within limits sets them apart in thresholds::max_runs.
std::optional<NextRun> next_run(const Attribution& found, const Limits& limits);

}  // namespace soilbin::compare
