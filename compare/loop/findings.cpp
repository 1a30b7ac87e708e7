// What an answer of the loop implies, as values: sets worth showing, channels that it makes worse, runs to make next.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "compare/attribution/choice.hpp"
#include "compare/fit/thresholds.hpp"
#include "compare/loop/loop.hpp"
#include "compare/measured/condition_views.hpp"

namespace soilbin::compare {
namespace {

constexpr double third_digit = 1.005;

/// The condition of the run that the saved model misses most in a channel.
OperatingCondition missed_most(const LoopAnswer& answer, int channel) {
  const Observations& observations = answer.found().base.data().observations;
  const Eigen::VectorXd residual = answer.model().cell_residual().cwiseAbs();
  const Cell* most = nullptr;
  double by = -1;
  for (std::size_t i = 0; i < observations.cells.size(); ++i)
    if (const Cell& cell = observations.cells[i]; cell.channel == channel && residual[i] > by)
      by = residual[i], most = &cell;
  return observations.rows[most == nullptr ? 0 : most->row];
}

}  // namespace

/// Dependences of what the model leaves.
const std::vector<Dependence>& dependences_left(const LoopAnswer& answer) {
  const std::vector<Dependence>& after = answer.with_candidates().dependences_after;
  return after.empty() ? answer.dependences_before : after;
}

std::vector<const WeightedSet*> sets_shown(const LoopAnswer& answer) {
  constexpr std::size_t most = 8;
  std::vector<const WeightedSet*> sets;
  for (const WeightedSet& w : answer.ambiguity_set()) sets.push_back(&w);
  const auto listed = [&](const WeightedSet& w) {
    return std::ranges::any_of(sets, [&](const WeightedSet* one) { return one->ids == w.ids; });
  };
  if (!answer.has_candidates()) return sets;
  for (const WeightedSet& w : answer.found().candidates.sets)
    if (sets.size() < most && !listed(w)) sets.push_back(&w);
  return sets;
}

std::vector<std::string> forms_in_order(const CandidateModel& candidate) {
  std::map<std::string, std::string> by_id;
  for (const Term& term : candidate.terms()) by_id[term.form->id] = term.form->form;
  std::vector<std::string> forms;
  for (const std::string& id : candidate.ids) forms.push_back(by_id.at(id));
  return forms;
}

bool rises(const HeldOutErrors& error) { return error.after > third_digit * error.before; }

bool falls(const HeldOutErrors& error) { return error.before > third_digit * error.after; }

std::vector<int> worse_channels(const LoopAnswer& answer) {
  std::vector<int> worse;
  if (!answer.uses_effects()) return worse;
  for (int c = 0; c < channel_count; ++c)
    if (rises(answer.validation.channels[c])) worse.push_back(c);
  return worse;
}

std::vector<std::string> beyond_what_is_known(const NextRun& next) {
  std::vector<std::string> names = next.beyond;
  std::erase_if(names, [&](const std::string& name) { return next.given.contains(name); });
  return names;
}

bool proposes_next(const LoopAnswer& answer) {
  if (!answer.next() || answer.verdict() != Verdict::unknown_effect) return answer.next().has_value();
  const std::vector<const WeightedSet*> sets = sets_shown(answer);
  const auto other =
      std::ranges::find_if(sets, [&](const WeightedSet* set) { return set->ids == answer.next()->separates.back(); });
  return other == sets.end() ||
         sets.front()->log_evidence - (*other)->log_evidence < std::log(thresholds::settled_odds);
}

std::vector<Dependence> sure_dependences(const LoopAnswer& answer) {
  if (answer.verdict() != Verdict::unknown_effect) return {};
  std::vector<Dependence> all = dependences_left(answer);
  std::erase_if(all, [](const Dependence& d) { return d.false_discovery_rate > thresholds::false_discovery_level; });
  std::ranges::stable_sort(all, [](const Dependence& a, const Dependence& b) {
    return std::pair(a.p_value, -a.share) < std::pair(b.p_value, -b.share);
  });
  return all;
}

std::vector<OperatingCondition> shape_series(const LoopAnswer& answer) {
  const std::vector<Dependence> sure = sure_dependences(answer);
  if (sure.empty() || sure.front().variable == "run") return {};
  const Observations& observations = answer.found().base.data().observations;
  constexpr int settings = 5;
  const std::string& variable = sure.front().variable;
  return combinations(missed_most(answer, sure.front().channel),
                      {{variable, evenly(ranges_of(observations).at(variable), settings)}});
}

double rig_setting_of(const LoopAnswer& answer, const OperatingCondition& at, const std::string& condition) {
  const ConditionView& view = condition_view(condition);
  const Dataset& data = answer.found().base.data();
  const double value = view.get(at);
  if (!std::isfinite(value)) return value;
  constexpr double anywhere = std::numeric_limits<double>::infinity();
  const Limits limits = answer.next() ? answer.next()->given : Limits{};
  const auto given = limits.find(condition);
  const std::pair<double, double> within = given != limits.end() ? given->second : std::pair(-anywhere, anywhere);
  return rig_setting(view, value, data.observations, within, own_unit(data.campaign->columns, view).second);
}

}  // namespace soilbin::compare
