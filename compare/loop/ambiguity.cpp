#include "compare/loop/ambiguity.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace soilbin::compare {
namespace {

// Set once on the tuning sets of bench/loop (docs/loop.md), never on those reported.
constexpr double allowed_base = 4.0;      // ln evidence by which a set may stand behind the best one
constexpr double allowed_growth = 0.03;   // and more for each ln evidence that the best one gains
constexpr double few_cells = 200.0;       // measured values below which both grow, as their root,
constexpr double most_growth = 2.0;       // at most twofold
constexpr double superset_allowed = 2.0;  // the same for sets that hold the best one and more

double allowed_behind(const Identification& id, const Weighted& best, const std::set<std::string>& ids) {
  if (ids.size() > best.ids.size() && std::includes(ids.begin(), ids.end(), best.ids.begin(), best.ids.end()))
    return superset_allowed;
  const double cells = static_cast<double>(id.observations.cells.size());
  return std::clamp(std::sqrt(few_cells / cells), 1.0, most_growth) *
         (allowed_base + allowed_growth * std::max(0.0, best.log_evidence - id.base_log_evidence));
}

}  // namespace

const Weighted& weighed(const Identification& id, const std::set<std::string>& ids) {
  const auto found =
      std::find_if(id.weights.begin(), id.weights.end(), [&](const Weighted& w) { return w.ids == ids; });
  if (found == id.weights.end()) throw std::out_of_range("a set of effects that wasn't weighed");
  return *found;
}

std::vector<Competitor> competitors(const Identification& id) {
  const Weighted& best = weighed(id, id.candidates[*id.best].ids);
  std::vector<Competitor> all = {
      {static_cast<std::size_t>(&best - id.weights.data()), allowed_behind(id, best, best.ids)}};
  for (std::size_t i = 0; i < id.weights.size(); ++i) {
    const Weighted& w = id.weights[i];
    if (w.ids == best.ids || !(w.weight > 0)) continue;
    const double allowed = allowed_behind(id, best, w.ids);
    if (best.log_evidence - w.log_evidence <= allowed) all.push_back({i, allowed});
  }
  return all;
}

std::vector<Weighted> weighted_sets(const Identification& id, const std::vector<Competitor>& all) {
  std::vector<Weighted> sets;
  double total = 0.0;
  for (const Competitor& c : all) {
    sets.push_back(id.weights[c.weighted]);
    total += sets.back().weight;
  }
  for (Weighted& w : sets) w.weight /= total;
  return sets;
}

}  // namespace soilbin::compare
