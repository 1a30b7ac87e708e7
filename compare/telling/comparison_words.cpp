#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "compare/discrepancy/comparison.hpp"
#include "compare/doubts/grain_resolution.hpp"
#include "compare/report/number_text.hpp"
#include "compare/sweep/answers.hpp"
#include "compare/sweep/varying.hpp"
#include "compare/telling/comparison_report.hpp"
#include "compare/telling/loop_report.hpp"
#include "scenario/estimate.hpp"

namespace soilbin::compare {
namespace {

constexpr std::string_view unlike_tires = "The tires differ: flexible here, rigid in the grains.";
constexpr double chance_level = 0.05;  // share of rows beyond counting_errors where nothing differs

std::vector<std::size_t> rows_of(const Comparison& comparison, const Tally& tally) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < comparison.differences.size(); ++i)
    if (comparison.differences[i].is_of(tally)) rows.push_back(i);
  return rows;
}

/// "3 of 28 conditions differ significantly, 20 within the scatter of a run. "; "" where none is tested.
std::string counts(const Tally& t) {
  if (t.unknown == t.values) return "";
  std::string text = fmt::format("{} of {} conditions differ significantly", t.differ, t.values);
  if (t.in_scatter > 0) text += fmt::format(", {} within the scatter of a run", t.in_scatter);
  if (t.in_errors > 0) text += fmt::format(", {} within the errors", t.in_errors);
  return text + ". ";
}

Clause tally_clause(const Comparison& comparison, const Tally& t) {
  const Difference& worst = comparison.differences[t.worst];
  Clause clause{std::string(channel_views[t.channel].title), "", {}, rows_of(comparison, t)};
  clause.text = fmt::format("{}: {}", less_in_words(comparison, t), counts(t));
  if (tires_differ(comparison, t.side, t.reference)) clause.text += std::string(unlike_tires) + " ";
  const std::string expected =
      t.expected_rms > 0.0 ? fmt::format("; expected from uncertainty: {}", in_unit(t.channel, t.expected_rms)) : "";
  clause.text +=
      fmt::format("RMS difference {} ({} of {}{}), mean {}. Largest at {}: {} against {}.", in_unit(t.channel, t.rms),
                  percent(t.rms_share), measure_of(t), expected, in_unit(t.channel, t.bias),
                  in_words(comparison.question.study.conditions[worst.condition]),
                  in_unit(t.channel, worst.value.value), in_unit(t.channel, worst.reference_value.value));
  return clause;
}

/// "the analytic wheel", "the grains", "the measurement": a side as the owner of a value.
std::string in_a_sentence(const Side& side) {
  if (side.kind == SideKind::measured) return "the measurement";
  const std::string name = name_of(side);
  return name.starts_with("analytic wheel") || name.starts_with("grains") ? "the " + name : name;
}

/// "6.3 kN", "11.2 mm": to two or three digits.
std::string amount(std::size_t channel, double value) {
  const ChannelView& view = channel_views[channel];
  const bool kilo = view.unit.starts_with("N") && value >= 1000.0;
  return fmt::format("{:.3g} {}{}", value * view.per_si / (kilo ? 1000.0 : 1.0), kilo ? "k" : "", view.unit);
}

/// "4 kN and 20 % slip".
std::string where_of(const Comparison& comparison, std::size_t condition) {
  const std::string &curve = comparison.curves.labels[comparison.curves.curve_of[condition]],
                    slip = fmt::format("{:.4g} % slip", 100 * comparison.question.study.conditions[condition].slip);
  return curve.empty() ? slip : curve + " and " + slip;
}

/// Share of the squared difference that other soil values within their declared uncertainty would take away.
double taken_by_the_soil(const JointTest& test) { return 1.0 - test.chi2 / test.chi2_soil_exact; }

/// What is left of the differences under the best of these soil values, root mean square, in their own errors.
double left_by_the_soil(const JointTest& test) { return std::sqrt(test.chi2 / static_cast<double>(test.values)); }
constexpr double explained = 2.0;  // errors that may be left where the soil is said to explain differences

std::string left_in_words(double errors) {
  return fmt::format("what is left is {:.2g} times its standard errors (root mean square)", errors);
}

const char* rest_called(JointVerdict verdict) {
  constexpr std::array words = {"significant", "noise", "not decided (too few re-runs)"};
  return words[static_cast<std::size_t>(verdict)];
}

Clause joint_clause(const Comparison& comparison, const JointTest& test) {
  const std::string side = name_of(comparison.sides[test.side]), reference = name_of(comparison.sides[test.reference]);
  Clause clause{"All together", "", {ClauseEvidence::joint_test}};
  const std::string p = test.p_value < 1e-300 ? "p < 1e-300" : fmt::format("p = {:.2g}", test.p_value);
  const std::string errors =
      std::isinf(test.freedom) ? "" : fmt::format("; noise with {:.0f} degrees of freedom", test.freedom);
  clause.text = fmt::format(
      "Other soil values within their declared uncertainty would take away {:.0f} % of the squared difference between "
      "{} "
      "and {}; {}: {}, chi2 = {} for {} values ({}{}).",
      100 * taken_by_the_soil(test), side, reference, left_in_words(left_by_the_soil(test)),
      rest_called(test.verdict()), number(test.chi2), test.values, p, errors);
  return clause;
}

/// One sentence on what a better known soil could explain, of all pairs together.
std::optional<Clause> soil_clause(const Comparison& comparison) {
  if (comparison.joint.empty()) return std::nullopt;
  double least = 1.0, most = 0.0, left = 0.0;
  std::set<JointVerdict> verdicts;
  for (const JointTest& test : comparison.joint) {
    least = std::min(least, taken_by_the_soil(test)), most = std::max(most, taken_by_the_soil(test));
    left = std::max(left, left_by_the_soil(test));
    verdicts.insert(test.verdict());
  }
  std::vector<std::string> rest;
  for (const JointVerdict verdict : verdicts) rest.push_back(rest_called(verdict));
  std::string share = fmt::format("{:.0f} %", 100 * most);
  if (std::lround(100 * least) != std::lround(100 * most)) share = fmt::format("{:.0f} to {}", 100 * least, share);
  const std::string found = fmt::format("{}{}", fmt::join(rest, " or "), rest.size() > 1 ? ", by side" : "");
  return Clause{"The soil",
                left > explained
                    ? fmt::format("Other soil values within their declared uncertainty do not explain the differences: "
                                  "they would take away {} of the squared difference; {}, {}.",
                                  share, left_in_words(left), found)
                    : fmt::format("Other soil values within their declared uncertainty would take away {} of the "
                                  "squared difference. The rest is {}.",
                                  share, found),
                {ClauseEvidence::joint_test}};
}

/// What the size of the grains does to their own pull, where the study of it tells; nothing where that is little.
std::optional<Clause> grains_clause(const Comparison& comparison) {
  constexpr double worth_a_line = 0.01;  // of the load (chosen)
  const Scenario& scenario = comparison.question.scenario;
  if (!scenario.soil.granular) return std::nullopt;
  double sum = 0.0, squares = 0.0, squared_errors = 0.0;
  std::size_t known = 0, with_result = 0;
  for (const Side& side : comparison.sides)
    for (std::size_t i = 0; i < side.points.size(); ++i) {
      if (side.kind != SideKind::grains || !side.points[i].result) continue;
      ++with_result;
      const OperatingCondition& at = comparison.question.study.conditions[i];
      const ResolutionError error = resolution_error(scenario, at, side.points[i]);
      if (!error.known()) continue;
      const double share = error.drawbar_pull.value / at.load;
      const double its_error = error.drawbar_pull.std_error / at.load;
      ++known, sum += share, squares += share * share, squared_errors += its_error * its_error;
    }
  if (known == 0) return std::nullopt;
  const auto n = static_cast<double>(known);
  const Estimate rms{std::sqrt(squares / n), std::sqrt(squared_errors / n)};
  if (rms.value < worth_a_line) return std::nullopt;
  return Clause{"The grains",
                fmt::format("Grains of {:.3g} mm are coarse for this wheel: their own pull is too {} by about {} % of "
                            "the load (RMS of {} of {} points; the others are not studied).",
                            1000 * mean_diameter(*scenario.soil.granular), sum > 0 ? "large" : "small",
                            number(rms, 100), known, with_result),
                {ClauseEvidence::warnings}};
}

/// The rule, and how many rows it would let pass by chance.
Clause chance_clause(const Comparison& comparison) {
  std::size_t counted = 0;
  double fewest = std::numeric_limits<double>::infinity();
  for (const Difference& d : comparison.differences)
    if (d.finding != DifferenceFinding::not_judged) ++counted, fewest = std::min(fewest, d.freedom);
  const std::string student = std::isinf(fewest) ? ""
                                                 : fmt::format(
                                                       " With few re-runs Student's t counts: {:.3g} standard "
                                                       "errors at {:.3g} degrees of freedom, the fewest here.",
                                                       counting_errors(fewest), fewest);
  return {"How sure",
          fmt::format("A difference is significant above two standard errors of both sides together and above the "
                      "scatter of one run.{} By chance about {:.0f} of {} rows exceed two standard errors.",
                      student, std::ceil(chance_level * static_cast<double>(counted)), counted),
          {ClauseEvidence::rule}};
}

/// Each doubt once, with how many points share it.
std::vector<Clause> doubt_clauses(const Comparison& comparison) {
  std::vector<Clause> clauses;
  for (const Side& side : comparison.sides) {
    std::size_t doubted = 0, with_result = 0;
    std::vector<std::string> told;  // two drifts that round alike are one remark in the table
    for (const SidePoint& point : side.points) {
      with_result += point.result.has_value();
      doubted += point.result && !point.doubts.empty();
      for (std::string& remark : in_words(point.doubts))
        if (std::ranges::find(told, remark) == told.end()) told.push_back(std::move(remark));
    }
    if (doubted == 0) continue;
    clauses.push_back(
        {"Limits",
         fmt::format("{}: warnings at {} of {} points ({}{}).", name_of(side), doubted, with_result, told.front(),
                     told.size() > 1 ? fmt::format("; {} more in the table", told.size() - 1) : ""),
         {ClauseEvidence::points}});
  }
  return clauses;
}

}  // namespace

const char* word(ClauseEvidence evidence) {
  constexpr std::array words = {"rule", "joint test", "budget", "the loop", "table of points", "warnings"};
  return words[static_cast<std::size_t>(evidence)];
}

std::string measure_of(const Tally& t) {
  const ChannelView& channel = channel_views[t.channel];
  return (channel.scale == ChannelScale::load_times_radius ? "" : "the ") + std::string(scale_in_words(channel));
}

/// Where along the contact two sides shear the soil otherwise; "" where one has no stresses there.
static std::string told_shear(const Comparison& comparison, const Tally& t, std::size_t condition) {
  const auto side = shear_ratios(comparison, t.side, condition);
  const auto reference = shear_ratios(comparison, t.reference, condition);
  if (!side || !reference) return "";
  return fmt::format(
      " Shear over normal stress ahead of the largest pressure and behind it: {:.2f} and {:.2f} by {}, {:.2f} and "
      "{:.2f} by {}.",
      side->ahead, side->behind, name_of(comparison.sides[t.side]), reference->ahead, reference->behind,
      name_of(comparison.sides[t.reference]));
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
        {"Why",
         fmt::format("At {} the pulls of {} and {} differ by {}. Largest part: {}, {} N against {} N.{}",
                     in_words(comparison.question.study.conditions[worst.condition]), name_of(comparison.sides[t.side]),
                     name_of(comparison.sides[t.reference]), in_unit(t.channel, std::abs(worst.difference)),
                     part_in_words(part->name), number(part->side), number(part->reference),
                     part->name == "shear_thrust" ? told_shear(comparison, t, worst.condition) : ""),
         {ClauseEvidence::budget},
         {t.worst}});
  }
  return clauses;
}

std::vector<const Tally*> widest_first(const Comparison& comparison) {
  std::vector<const Tally*> order;
  for (const Tally& t : comparison.tallies) order.push_back(&t);
  const auto unlike = [&](const Tally* t) { return tires_differ(comparison, t->side, t->reference); };
  std::ranges::stable_sort(order, [&](const Tally* a, const Tally* b) {
    return unlike(a) != unlike(b) ? unlike(b) : a->rms_share > b->rms_share;
  });
  return order;
}

/// What the headline is about: the pull, of the pair that is widest apart in it; where none is compared, the widest.
static const Tally& headline_tally(const Comparison& comparison) {
  const std::vector<const Tally*> order = widest_first(comparison);
  const auto pull =
      std::ranges::find_if(order, [](const Tally* t) { return channel_views[t->channel].name == "drawbar_pull"; });
  return pull == order.end() ? *order.front() : **pull;
}

const Difference* widest_difference(const Comparison& comparison) {
  if (comparison.tallies.empty()) return nullptr;
  return &comparison.differences[headline_tally(comparison).worst];
}

std::string name_of(const Side& side) { return model_in_words(side.label); }

std::string less_in_words(const Comparison& comparison, const ComparedChannel& of) {
  return name_of(comparison.sides[of.side]) + " - " + name_of(comparison.sides[of.reference]);
}

std::string in_words(const Comparison& comparison, const NotCompared& gap) {
  const std::string side = name_of(comparison.sides[gap.side]);
  if (gap.what == NotCompared::What::no_result)
    return fmt::format("{} has no result at {} of {} conditions ({}: {})", side, gap.conditions.size(),
                       comparison.question.study.conditions.size(),
                       in_words(comparison.question.study.conditions[gap.conditions.front()]), gap.why);
  const std::string pair = side + " and " + name_of(comparison.sides[gap.reference]);
  return gap.what == NotCompared::What::no_joint_test ? pair + " have no test of all values at once: " + gap.why
                                                      : pair + " share no condition with a result";
}

std::optional<Clause> headline(const Comparison& comparison) {
  if (comparison.tallies.empty()) return std::nullopt;
  const Tally& widest = headline_tally(comparison);
  const Difference& worst = comparison.differences[widest.worst];
  Clause clause{"In short", "", {}, rows_of(comparison, widest)};
  clause.text =
      fmt::format("The {} of {} is {} ({} of {}) {} that of {}, at {}", channel_views[worst.channel].title,
                  in_a_sentence(comparison.sides[worst.side]), amount(worst.channel, std::abs(worst.difference)),
                  percent(std::abs(worst.share)), measure_of(widest), worst.difference < 0.0 ? "below" : "above",
                  in_a_sentence(comparison.sides[worst.reference]), where_of(comparison, worst.condition));
  clause.text += worst.finding == DifferenceFinding::difference       ? ": significant."
                 : worst.finding == DifferenceFinding::within_scatter ? ": within the scatter of a run."
                 : worst.finding == DifferenceFinding::within_errors  ? ": within the errors."
                                                                      : ".";
  if (tires_differ(comparison, widest.side, widest.reference)) clause.text += " " + std::string(unlike_tires);
  const auto count = [&](DifferenceFinding finding) {
    return std::ranges::count(comparison.differences, finding, &Difference::finding);
  };
  const auto all = std::ssize(comparison.differences), untested = count(DifferenceFinding::not_judged);
  if (untested < all)
    clause.text +=
        fmt::format(" {} of {} differences are significant.", count(DifferenceFinding::difference), all - untested);
  if (untested > 0)
    clause.text += untested < all ? " The others share their soil data and are not tested."
                                  : " Same soil data: no significance test.";
  return clause;
}

std::vector<Clause> opening(const Comparison& comparison) {
  std::vector<Clause> clauses;
  if (std::optional<Clause> first = headline(comparison)) clauses.push_back(std::move(*first));
  if (auto soil = soil_clause(comparison)) clauses.push_back(std::move(*soil));
  if (auto grains = grains_clause(comparison)) clauses.push_back(std::move(*grains));
  return clauses;
}

std::vector<Clause> missing_clauses(const LoopOfComparison& loop) {
  std::vector<Clause> clauses;
  for (const BackedSentence& said : headline(loop.answer, in_words(loop.mistaken_columns)))
    clauses.push_back({said.about, said.text + (said.detail.empty() ? "" : " " + said.detail), {ClauseEvidence::loop}});
  return clauses;
}

std::vector<Clause> limits_of_the_comparison(const Comparison& comparison) {
  std::vector<Clause> clauses;
  const bool judged = std::ranges::any_of(
      comparison.differences, [](const Difference& d) { return d.finding != DifferenceFinding::not_judged; });
  if (judged) clauses.push_back(chance_clause(comparison));
  for (Clause& clause : doubt_clauses(comparison)) clauses.push_back(std::move(clause));
  for (const NotCompared& gap : comparison.not_compared)
    clauses.push_back({"not compared", in_words(comparison, gap) + "."});
  return clauses;
}

std::vector<Clause> summary(const Comparison& comparison, const LoopOfComparison* loop) {
  std::vector<Clause> clauses = opening(comparison);
  for (const Tally* t : widest_first(comparison)) clauses.push_back(tally_clause(comparison, *t));
  for (const JointTest& test : comparison.joint) clauses.push_back(joint_clause(comparison, test));
  for (Clause& clause : cause_clauses(comparison)) clauses.push_back(std::move(clause));
  if (loop != nullptr)
    for (Clause& clause : missing_clauses(*loop)) clauses.push_back(std::move(clause));
  for (Clause& clause : limits_of_the_comparison(comparison)) clauses.push_back(std::move(clause));
  return clauses;
}

}  // namespace soilbin::compare
