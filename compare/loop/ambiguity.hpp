// Which sets of effects the data can't tell apart.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "compare/loop/identify.hpp"

namespace soilbin::compare {

/// A set of effects that competes.
struct Competitor {
  std::size_t weighted = 0;  ///< index of Identification::weights
  double allowed = 0.0;      ///< ln evidence by which it may stand behind and still competes
};

/// A set's weight by its effects; it must have been weighed.
const Weighted& weighed(const Identification& id, const std::set<std::string>& ids);

/// The sets that the data can't tell from the best one (Identification::best, which must be there), itself first. How
/// far behind a set may stand grows with what the best one explains: the more there is to explain, the more a form
/// that nature does not share costs. It is wider on small designs, where a few values decide, and narrower for sets
/// that hold the best one and more.
std::vector<Competitor> competitors(const Identification& id);

/// The same as an answer lists them, with weights that sum to 1.
std::vector<Weighted> weighted_sets(const Identification& id, const std::vector<Competitor>& all);

}  // namespace soilbin::compare
