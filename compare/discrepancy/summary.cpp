#include "compare/discrepancy/summary.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "compare/discrepancy/causes.hpp"
#include "compare/loop/answer_words.hpp"
#include "compare/report/number_text.hpp"
#include "compare/sweep/varying.hpp"

namespace soilbin::compare {
namespace {

constexpr double chance_level = 0.05;  // share of rows beyond counting_errors where nothing differs

std::vector<std::size_t> rows_of(const Comparison& comparison, const Tally& tally) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < comparison.differences.size(); ++i) {
    const Difference& d = comparison.differences[i];
    if (d.side == tally.side && d.reference == tally.reference && d.channel == tally.channel) rows.push_back(i);
  }
  return rows;
}

/// "3 of 28 conditions differ beyond errors and scatter, 20 lie within one run's scatter, ...".
std::string counts(const Tally& t) {
  if (t.unknown == t.values)
    return "both rest on the same soil values or state no doubt, so the rows are numbers without a verdict";
  std::string text = fmt::format("{} of {} condition{} differ{} beyond the errors and the scatter", t.differ, t.values,
                                 t.values == 1 ? "" : "s", t.differ == 1 ? "s" : "");
  if (t.in_scatter > 0)
    text += fmt::format(", {} lie{} within the scatter of a single run and {} no difference", t.in_scatter,
                        t.in_scatter == 1 ? "s" : "", t.in_scatter == 1 ? "is" : "are");
  if (t.in_errors > 0)
    text += fmt::format(", {} {} covered by the standard errors", t.in_errors, t.in_errors == 1 ? "is" : "are");
  return text;
}

/// What a tally's shares are shares of.
std::string measure_of(const Tally& t) {
  if (channel_views[t.channel].name == "torque") return "load x radius";
  return channel_views[t.channel].name == "sinkage" ? "the radius" : "the load";
}

Clause tally_clause(const Comparison& comparison, const Tally& t) {
  const Difference& worst = comparison.differences[t.worst];
  const std::string side = comparison.sides[t.side].label, reference = comparison.sides[t.reference].label;
  Clause clause{std::string(channel_views[t.channel].title), "", rows_of(comparison, t), {}};
  clause.text = fmt::format("{} against {}: {}. ", side, reference, counts(t));
  const std::string alone =
      t.expected_rms > 0.0 ? fmt::format("; the stated errors alone would give {}", in_unit(t.channel, t.expected_rms))
                           : "";
  clause.text += fmt::format(
      "The root mean square is {} ({} of {}), on average {} is {} {}{}. Widest at {}: {} against {}.",
      in_unit(t.channel, t.rms), percent(t.rms_share), measure_of(t), side, in_unit(t.channel, std::abs(t.bias)),
      t.bias < 0 ? "lower" : "higher", alone, in_words(comparison.question.study.conditions[worst.condition]),
      in_unit(t.channel, worst.value.value), in_unit(t.channel, worst.reference_value.value));
  return clause;
}

/// How many rows differ at all, and where the sides are widest apart.
Clause headline(const Comparison& comparison, const Tally& widest) {
  Clause clause{"in short", "", {}, {}};
  std::size_t judged = 0;
  for (std::size_t i = 0; i < comparison.differences.size(); ++i) {
    judged += comparison.differences[i].finding != DifferenceFinding::not_judged;
    if (comparison.differences[i].finding == DifferenceFinding::difference) clause.rows.push_back(i);
  }
  if (judged > 0)
    clause.text =
        fmt::format("{} of {} numbers differ by more than errors and scatter explain. ", clause.rows.size(), judged);
  clause.text += fmt::format("Widest apart is the {}, of {} and {}: {} of {}, root mean square.",
                             channel_views[widest.channel].title, comparison.sides[widest.side].label,
                             comparison.sides[widest.reference].label, percent(widest.rms_share), measure_of(widest));
  clause.rows.push_back(widest.worst);
  return clause;
}

Clause joint_clause(const Comparison& comparison, const JointTest& test) {
  const std::string side = comparison.sides[test.side].label, reference = comparison.sides[test.reference].label;
  const double taken = 1.0 - test.chi2 / test.chi2_soil_exact;
  Clause clause{"all together", "", {}, {"joint test"}};
  const std::string p = test.p_value < 1e-300 ? "p < 1e-300" : fmt::format("p = {:.2g}", test.p_value);
  const std::string errors =
      std::isinf(test.freedom) ? "" : fmt::format("; the noise rests on {:.0f} degrees of freedom", test.freedom);
  clause.text = fmt::format(
      "{} and {} {}: chi2 = {} for {} values ({}{}). The soil values' doubt, which moves all conditions together, "
      "accounts for {:.0f} % of the squared difference.",
      side, reference,
      test.p_value < 0.01 ? "differ by more than soil values and noise explain"
                          : "agree within what soil values and noise leave open",
      number(test.chi2), test.values, p, errors, 100 * taken);
  return clause;
}

/// Where the widest gap in pull comes from.
std::vector<Clause> cause_clauses(const Comparison& comparison) {
  std::vector<Clause> clauses;
  for (const Tally& t : comparison.tallies) {
    if (channel_views[t.channel].name != "drawbar_pull" || t.differ == 0) continue;
    const Difference& worst = comparison.differences[t.worst];
    const auto part = widest_part(comparison, t.side, t.reference, worst.condition);
    if (!part) continue;
    clauses.push_back(
        {"why",
         fmt::format("At {} the pull of {} and {} is {} apart; the widest part of that is the {}: {} N "
                     "against {} N.",
                     in_words(comparison.question.study.conditions[worst.condition]), comparison.sides[t.side].label,
                     comparison.sides[t.reference].label, in_unit(t.channel, std::abs(worst.difference)),
                     part_in_words(part->name), number(part->side), number(part->reference)),
         {t.worst},
         {"budget"}});
  }
  return clauses;
}

/// The rule, and how many rows it would let pass by chance.
Clause chance_clause(const Comparison& comparison) {
  std::size_t counted = 0;
  double fewest = std::numeric_limits<double>::infinity();
  for (const Difference& d : comparison.differences)
    if (d.finding != DifferenceFinding::not_judged) ++counted, fewest = std::min(fewest, d.freedom);
  const std::string student = std::isinf(fewest)
                                  ? ""
                                  : fmt::format(
                                        " Errors that rest on few re-runs count more (Student's t): {:.3g} of them at "
                                        "{:.3g} degrees of freedom, the fewest here.",
                                        counting_errors(fewest), fewest);
  return {"how sure",
          fmt::format("A row counts as a difference beyond two standard errors of both sides together and beyond the "
                      "scatter of one run.{} Of {} rows about {:.0f} would pass the errors by chance alone.",
                      student, counted, std::ceil(chance_level * static_cast<double>(counted))),
          {},
          {"rule"}};
}

/// Each doubt once, with how many points share it.
std::vector<Clause> doubt_clauses(const Comparison& comparison) {
  std::vector<Clause> clauses;
  for (const Side& side : comparison.sides) {
    std::size_t doubted = 0, with_result = 0;
    std::set<std::string> told;
    std::string first;
    for (const SidePoint& point : side.points) {
      with_result += point.result.has_value();
      doubted += point.result && !point.doubts.empty();
      for (const std::string& doubt : point.doubts)
        if (told.insert(doubt).second && first.empty()) first = doubt;
    }
    if (doubted == 0) continue;
    clauses.push_back({"limits",
                       fmt::format("{}: {} of {} points carry a doubt ({}{}).", side.label, doubted, with_result, first,
                                   told.size() > 1 ? fmt::format("; and {} more, in the table", told.size() - 1) : ""),
                       {},
                       {"table of points"}});
  }
  return clauses;
}

}  // namespace

std::string in_unit(std::size_t channel, double si) {
  return fmt::format("{} {}", number(si * channel_views[channel].per_si), channel_views[channel].unit);
}

std::vector<Clause> summary(const Comparison& comparison, const LoopAnswer* loop) {
  std::vector<Clause> clauses;
  std::vector<const Tally*> order;
  for (const Tally& t : comparison.tallies) order.push_back(&t);
  std::stable_sort(order.begin(), order.end(),
                   [](const Tally* a, const Tally* b) { return a->rms_share > b->rms_share; });
  if (!order.empty()) clauses.push_back(headline(comparison, *order.front()));
  for (const Tally* t : order) clauses.push_back(tally_clause(comparison, *t));
  for (const JointTest& test : comparison.joint) clauses.push_back(joint_clause(comparison, test));
  for (Clause& clause : cause_clauses(comparison)) clauses.push_back(std::move(clause));
  if (loop != nullptr) {
    std::string text = verdict_sentence(*loop);
    for (const std::string& sentence : explanation(*loop)) text += " " + sentence;
    clauses.push_back({"what is missing", text, {}, {"the loop"}});
  }
  const bool judged = std::any_of(comparison.differences.begin(), comparison.differences.end(),
                                  [](const Difference& d) { return d.finding != DifferenceFinding::not_judged; });
  if (judged) clauses.push_back(chance_clause(comparison));
  for (Clause& clause : doubt_clauses(comparison)) clauses.push_back(std::move(clause));
  for (const std::string& gap : comparison.not_compared) clauses.push_back({"not compared", gap + ".", {}, {}});
  return clauses;
}

}  // namespace soilbin::compare
