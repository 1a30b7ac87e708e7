#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compare/attribution/choice.hpp"
#include "compare/fit/thresholds.hpp"
#include "compare/measured/channels.hpp"
#include "compare/measured/condition_views.hpp"
#include "compare/report/number_text.hpp"
#include "compare/telling/loop_report.hpp"

namespace soilbin::compare {
namespace {

std::string condition_words(const LoopAnswer& answer) {
  std::string text;
  for (const std::string& name : answer.next()->quantities) {
    const auto [value, unit] = next_setting(answer, answer.next()->at, name);
    if (value.empty()) continue;
    text += fmt::format("{}{} {}{}{}", text.empty() ? "" : ", ", condition_view(name).title, value,
                        unit.empty() ? "" : " ", unit);
  }
  return text;
}

/// What to do where no condition shows on which the rest depends.
std::vector<std::string> without_a_condition(const LoopAnswer& answer) {
  const UnnamedEvidence& unnamed = answer.found().unnamed;
  if (unnamed.gain > thresholds::unnamed_instead && unnamed.most_likely == Unnamed::misread_condition)
    return {"Before more runs, check how slip and load are measured, and at which conditions.",
            "The unexplained part looks like a misread slip or load."};
  if (answer.judgement()->before.serial.p_value <= thresholds::serial_level)
    return {"Measure one setpoint, repeated through the whole campaign.",
            "The unexplained part changes from run to run, not by chance."};
  return {"Vary one condition alone, each setting run twice.", "The cause of the unexplained part is not visible yet."};
}

/// What has no name predicts nothing; but where it shows can be said.
std::vector<std::string> to_show_its_shape(const LoopAnswer& answer) {
  const std::vector<Dependence> sure = sure_dependences(answer);
  if (sure.empty()) return without_a_condition(answer);
  const Dependence& on = sure.front();
  const std::string variable = spaced(condition_view(on.variable).title);
  return {on.variable == "run"
              ? "Measure one setpoint, repeated through the whole campaign."
              : fmt::format("Measure several settings of the {} alone, each one twice, all else kept.", variable),
          fmt::format("The unexplained part of the {} depends most on the {} (p = {:.2g}; false-discovery rate over {} "
                      "pairs of channel and variable: {}).",
                      channel_views[on.channel].title, variable, on.p_value, dependences_left(answer).size(),
                      share_words(on.false_discovery_rate))};
}

/// What stands next behind the best set.
std::string next_behind(const LoopAnswer& answer) {
  const WeightedSet* next = next_standing(answer.found().candidates, answer.found().best().ids);
  return named_effects(next ? next->ids : std::set<std::string>());
}

/// The run that sets the candidates apart: what to do, then why.
std::vector<std::string> to_set_apart(const LoopAnswer& answer) {
  const NextRun& next = *answer.next();
  const std::string ahead = named_effects(next.separates.front()), behind = named_effects(next.separates.back());
  std::vector<std::string> sentences;
  if (answer.verdict() == Verdict::unknown_effect)
    sentences = {fmt::format("To choose between the nearest known effects, measure {}.", condition_words(answer))};
  else if (answer.ambiguity_set().size() == 1)
    sentences = {fmt::format("To confirm, measure {}.", condition_words(answer)),
                 fmt::format("There it differs most from the next candidate, {}: by {:.1f} standard deviations of one "
                             "run.",
                             behind, std::sqrt(next.distance))};
  else
    sentences = {fmt::format("Measure {}.", condition_words(answer))};
  if (sentences.size() == 1)
    sentences.push_back(
        fmt::format("{} run{} there should decide: {} or {}.", next.runs, next.runs == 1 ? "" : "s", ahead, behind));
  std::vector<std::string> names, beyond = beyond_what_is_known(next);
  if (beyond.empty()) return sentences;
  for (const std::string& name : beyond) names.push_back(spaced(name));
  sentences.push_back(
      fmt::format("Its {} lie{} beyond the measured range; if your rig cannot reach it, give --limit {}=LOW..HIGH.",
                  joined_with_and(names), names.size() == 1 ? "s" : "", beyond.front()));
  return sentences;
}

}  // namespace

std::vector<std::string> what_next(const LoopAnswer& answer) {
  std::vector<std::string> sentences;
  if (answer.verdict() == Verdict::unknown_effect) {
    sentences = to_show_its_shape(answer);
  } else if (!proposes_next(answer)) {
    if (answer.verdict() == Verdict::effect_found && is_settled(answer.found().candidates))
      return {fmt::format("No further run is needed to choose the effect: the next candidate, {}, is {} less likely.",
                          next_behind(answer), times_likelier(lead(answer.found().candidates)))};
    if (answer.ambiguity_set().size() > 1)
      return {"No condition within the limits separates these candidates in 50 runs."};
    if (answer.verdict() == Verdict::effect_found && answer.ambiguity_set().size() == 1)
      return {"One candidate is left; no condition within the limits confirms it further in one run."};
  }
  if (proposes_next(answer))
    for (std::string& sentence : to_set_apart(answer)) sentences.push_back(std::move(sentence));
  return sentences;
}

std::string setting(double value) {
  if (std::abs(value) < 1e-9) return "0";
  return fmt::format("{:.10g}", three_digits(value));
}

std::pair<std::string, std::string> next_setting(const LoopAnswer& answer, const OperatingCondition& at,
                                                 const std::string& condition) {
  const auto [unit, per_si] = own_unit(answer.found().base.data().campaign->columns, condition_view(condition));
  const double set = rig_setting_of(answer, at, condition);
  return {std::isfinite(set) ? fmt::format("{:.6g}", per_si * set) : "", unit};
}

}  // namespace soilbin::compare
