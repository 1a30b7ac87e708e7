// The next run to make: where the rivals disagree most, in units of what a run can tell.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "compare/loop/identify.hpp"

namespace soilbin::compare {

/// Closed ranges within which the rig can go, by condition name (slip, load, speed, yaw, pass, ...) [SI].
using Limits = std::map<std::string, std::pair<double, double>>;

/// The ranges that a campaign itself spans; slip reaches at least 0.05 .. 0.6.
Limits limits_of(const Observations& observations);

struct NextTest {
  OperatingCondition at;
  std::vector<std::string> quantities;           ///< names of the conditions that matter: those that limits hold
  std::vector<std::set<std::string>> separates;  ///< the rivals that it sets apart
  int runs = 0;           ///< until the weaker of them is expected to be twenty times less likely
  double distance = 0.0;  ///< squared distance of the rivals' predictions a run, in sd
};

/// The condition within limits with the largest sum over pairs of rivals of the squared distance between their
/// predictions, over noise plus the predictions' own uncertainty and the tolerance of their forms (Buzzi-Ferraris and
/// Forzatti 1983, Chem. Eng. Sci. 38:225), on a grid. A pair counts at most what decides between them.
/// rivals: indices of id.weights that compete. With a single one it competes against the base model. Nothing where no
/// condition within limits sets them apart in 50 runs.
std::optional<NextTest> next_test(const Campaign& campaign, const Identification& id,
                                  const std::vector<std::size_t>& rivals, const Limits& limits);

}  // namespace soilbin::compare
