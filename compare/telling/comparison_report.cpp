#include "compare/telling/comparison_report.hpp"

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>

#include "compare/doubts/doubts.hpp"
#include "compare/report/number_text.hpp"
#include "compare/sweep/answers.hpp"
#include "compare/sweep/varying.hpp"
#include "compare/telling/loop_report.hpp"
#include "compare/telling/reports.hpp"

namespace soilbin::compare {
namespace {

std::string named(const std::string& curve) { return curve.empty() ? "all conditions" : curve; }

/// "the analytic wheel (bekker_wong), the same with effects, resistive force theory (rft), the cone index
/// (cone_index), grains (dem) and measurements".
std::string sides_in_words(const Comparison& comparison) {
  bool effects = false, rft = false, cone = false, grains = false, measured = false;
  for (const Side& side : comparison.sides) {
    rft = rft || is_by(side, ModelKind::rft);
    cone = cone || is_by(side, ModelKind::cone_index);
    effects = effects || (is_by(side, ModelKind::bekker_wong) && &side != comparison.sides.data());
    grains = grains || side.kind == SideKind::grains;
    measured = measured || side.kind == SideKind::measured;
  }
  std::vector<std::string> others;
  for (const auto& [there, name] : {std::pair{effects, "the same with effects"},
                                    {rft, "resistive force theory (rft)"},
                                    {cone, "the cone index (cone_index)"},
                                    {grains, "grains (dem)"},
                                    {measured, "measurements"}})
    if (there) others.emplace_back(name);
  std::string text = "the analytic wheel (bekker_wong)";
  for (const std::string& other : others) text += (&other == &others.back() ? " and " : ", ") + other;
  return others.empty() ? text : text + " side by side";
}

/// The place of a page where evidence stands.
const char* anchor_of(ClauseEvidence evidence) {
  constexpr std::array anchors = {"method", "tallies", "why",
                                  "loop",   "points",  "doubts"};  // in the order of its values
  return anchors[static_cast<std::size_t>(evidence)];
}

/// Links from a clause to the tables and sections that hold its rows.
std::vector<std::pair<std::string, std::string>> evidence_of(const Comparison& comparison, const Clause& clause) {
  std::vector<std::pair<std::string, std::string>> links;
  if (!clause.rows.empty()) {
    const Difference& first = comparison.differences[clause.rows.front()];
    links.emplace_back(rows_anchor(first), counted(clause.rows.size(), "row"));
  }
  for (const ClauseEvidence evidence : clause.evidence) {
    links.emplace_back(std::string(anchor_of(evidence)), std::string(word(evidence)));
  }
  return links;
}

std::vector<BackedSentence> backed(const Comparison& comparison, const std::vector<Clause>& clauses) {
  std::vector<BackedSentence> sentences;
  for (const Clause& clause : clauses)
    sentences.push_back({clause.about, clause.text, evidence_of(comparison, clause)});
  return sentences;
}

/// How each kind of side that is there is drawn, and what its errors are.
std::string curves_in_words(const Comparison& comparison) {
  const auto there = [&](SideKind kind) {
    return std::ranges::find(comparison.sides, kind, &Side::kind) != comparison.sides.end();
  };
  std::string text;
  if (there(SideKind::analytic))
    text += std::ranges::any_of(comparison.sides,
                                [](const Side& side) { return side.choice && !is_by(side, ModelKind::bekker_wong); })
                ? "Lines: the quick models, with one standard error of the soil's values. "
                : "Lines: the analytic wheel, with one standard error of the soil's values. ";
  if (there(SideKind::grains)) text += "Points on lines: grains, with one standard error of their runs. ";
  if (there(SideKind::measured)) text += "Points: measured, with one standard error of the measured runs. ";
  if (!text.empty()) text.pop_back();
  return text;
}

using Parts = std::vector<ReportPart>;

void add_curves(Report& report, const Comparison& comparison) {
  const std::vector<std::string>& names = comparison.curves.labels;
  const auto smooth = [&comparison, made = std::make_shared<std::optional<Comparison>>()]() -> const Comparison& {
    if (!*made) *made = smooth_sides(comparison);
    return **made;
  };
  const Difference* widest = widest_difference(comparison);
  Choices curves{
      "Curve", {}, widest != nullptr ? comparison.curves.curve_of[widest->condition] : (names.size() - 1) / 2};
  for (std::size_t c = 0; c < names.size(); ++c)
    curves.all.emplace_back(named(names[c]), [&comparison, smooth, c] {
      return Parts{{Figure(
          [&comparison, smooth, c] { return curve_sheet(comparison, c, grains_are_coarse(comparison), smooth()); },
          curves_in_words(comparison), fmt::format("curve-{}", c + 1))}};
    });
  if (names.size() > 1)
    curves.all.emplace_back("all curves at once", [&comparison, smooth] {
      return Parts{{Figure([&comparison, smooth] { return overview_sheet(comparison, smooth()); },
                           "A colour for each curve, a dash for each side. Bands: one standard error; where many would "
                           "hide each other, point at a name in the legend to see its own.",
                           "overview")}};
    });
  report.add("Curves", std::move(curves), Told::to_look_at, "curves", ReportPart::Heading::place);
}

/// The answer and the grains' limits in a sentence or two, the curves, what the soil explains of it, then all numbers.
void add_opening(Report& report, const Comparison& comparison) {
  std::vector<Clause> clauses = opening(comparison);
  const auto soil = std::ranges::stable_partition(clauses, [](const Clause& c) { return c.about != "The soil"; });
  if (clauses.empty()) report.add(Sentences(std::vector<std::string>{"There is nothing to compare: a single side."}));
  const std::vector<Clause> first(clauses.begin(), soil.begin()), then(soil.begin(), clauses.end());
  if (!first.empty()) report.add(Sentences(backed(comparison, first)));
  add_curves(report, comparison);
  if (!then.empty()) report.add(Sentences(backed(comparison, then)));
  std::vector<Table> matrix = matrix_tables(comparison);
  if (!matrix.empty()) report.add("Condition by condition", Prose{}, Told::to_look_at, "matrix");
  for (Table& table : matrix) report.add(std::move(table), Told::to_look_at);
}

void add_channels(Report& report, const Comparison& comparison) {
  if (comparison.tallies.empty()) return;
  Table tally = tally_table(comparison);
  tally.caption += ". Green, on a page: within what uncertainty explains";
  report.add("Channel by channel", std::move(tally), Told::on_screens, "tallies");
  const auto count = [&](DifferenceFinding finding) {
    return std::to_string(
        std::ranges::count_if(comparison.differences, [&](const Difference& d) { return d.finding == finding; }));
  };
  report.add(KeyFigures{{{std::to_string(comparison.question.study.conditions.size()), "conditions"},
                         {std::to_string(comparison.differences.size()), "numbers compared"},
                         {count(DifferenceFinding::difference), "differences"},
                         {count(DifferenceFinding::within_scatter), "within the scatter of a run"},
                         {count(DifferenceFinding::within_errors), "within the errors"},
                         {count(DifferenceFinding::not_judged), "not tested: same soil data"}}},
             Told::on_pages);
}

/// Parts of the pull and stresses at one condition.
Parts causes_at(const Comparison& comparison, std::size_t condition) {
  const auto [bars, side_colors] = budget_bars(comparison, condition);
  return {
      {Drawings{{bars_svg(bars, side_colors)}, "Parts that add up to the drawbar pull.", "budget"}},
      {budget_table(comparison, condition), Told::on_pages},
      {Figure([&comparison, condition] { return stress_sheet(comparison, condition); },
              "Normal and shear stress on the wheel along the contact, of each model at this condition.", "stresses")}};
}

void add_causes(Report& report, const Comparison& comparison) {
  std::vector<Clause> causes = cause_clauses(comparison);
  report.add(Sentences(backed(comparison, causes)), Told::on_terminals);
  for (Clause& cause : causes) cause.about.clear();  // the heading says it
  report.add("Why", Sentences(backed(comparison, causes)), Told::to_look_at, "why");
  report.add(Prose{{"Pull is the soil's thrust less its resistance. Stresses run from the exit angle (behind the axle, "
                    "negative) to the entry angle."}},
             Told::on_pages);
  Choices conditions{"Condition", {}, 0, false};
  const std::size_t first = condition_of_largest_difference(comparison);
  for (std::size_t i = 0; i < comparison.question.study.conditions.size(); ++i) {
    if (budget_at(comparison, i).rows.empty()) continue;
    if (i == first) conditions.first = conditions.all.size();
    conditions.all.emplace_back(in_words(comparison.question.study.conditions[i]),
                                [&comparison, i] { return causes_at(comparison, i); });
  }
  report.add(std::move(conditions), Told::to_look_at);
  const std::vector<std::string>& names = comparison.curves.labels;
  Choices contacts{"Curve", {}, (names.size() - 1) / 2};
  for (std::size_t c = 0; c < names.size(); ++c)
    contacts.all.emplace_back(named(names[c]), [&comparison, c] {
      return Parts{
          {Figure([&comparison, c] { return contact_sheet(comparison, c); },
                  "Entry and exit angles, and the sinkage that slip adds.", fmt::format("contact-{}", c + 1))}};
    });
  report.add("Contact and sinkage", std::move(contacts), Told::to_look_at, "", ReportPart::Heading::subsection);
  if (Table table = sinkage_table(comparison); !table.rows.empty()) report.add(std::move(table), Told::on_pages);
}

void add_loop(Report& report, const Comparison& comparison, const LoopOfComparison& loop) {
  report.add(Sentences(backed(comparison, missing_clauses(loop))), Told::in_text);
  report.add("What the analytic model lacks",
             Prose{{fmt::format("The loop takes the results of '{}' as measured: it refits the soil within its "
                                "declared uncertainty, tests every known effect, and judges by cross-validation.",
                                loop.answer.campaign)}},
             Told::on_pages, "loop");
  report.add(Sentences(headline(loop.answer, in_words(loop.mistaken_columns))), Told::on_pages);
  for (Table& table : std::array{next_run_table(loop.answer), error_table(loop.answer), parameters_table(loop.answer)})
    if (!table.rows.empty()) report.add(std::move(table), Told::on_pages);
  if (loop.answer.has_candidates()) report.add(candidates_table(loop.answer), Told::on_pages);
  report.add(Items{notes(loop.answer)}, Told::on_pages);
}

void add_differences(Report& report, const Comparison& comparison) {
  Drawings maps{
      {}, "Bold: a difference. Faint: within the scatter of a run, or covered by the errors.", "heat-map", true};
  for (const Tally& tally : comparison.tallies) maps.svgs.push_back(heat_map_svg(heat_map_of(comparison, tally)));
  report.add("Where they differ", std::move(maps), Told::to_look_at, "differ");
  for (const Tally& tally : comparison.tallies)
    report.add(Fold{fmt::format("Rows: {}, {} against {}", channel_views[tally.channel].title,
                                name_of(comparison.sides[tally.side]), name_of(comparison.sides[tally.reference])),
                    [&comparison, tally] { return Parts{{rows_table(comparison, tally)}}; }, rows_anchor(tally)});
}

void add_replay(Report& report, const ReplayFile& file) {
  std::string facts;
  for (const auto& [name, value] : file.facts) facts += fmt::format("; {} {}", name, value);
  report.add(
      "The grains at work",
      ReplayView{file.title, file.bytes,
                 fmt::format("{}: {} grains, {} frames over {:.2f} s{}. Drag to turn, Ctrl and the wheel to come "
                             "nearer.",
                             file.title, file.grains, file.frames, file.seconds, facts)},
      Told::on_pages, "replay");
}

void add_method(Report& report, const Comparison& comparison, const LoopOfComparison* loop) {
  report.add("Every point", Prose{}, Told::on_pages, "points");
  for (const Side& side : comparison.sides)
    report.add(Fold{name_of(side), [&comparison, &side] { return Parts{{points_table(comparison, side)}}; }});
  report.add("How it is judged", Sentences(backed(comparison, limits_of_the_comparison(comparison))), Told::everywhere,
             "method");
  if (!comparison.joint.empty()) report.add(joint_table(comparison), Told::on_pages);
  report.add(
      Items{
          {"A difference d with standard error u counts where |d| is above 2 u and above the scatter of one run; u is "
           "the root of both sides' variances. Where u rests on few re-runs, Student's t takes the place of 2.",
           "Analytic: the standard deviations of the soil's values, propagated to first order. They move all "
           "conditions together; the joint test takes that in. " +
               errors_in_words(comparison.question.scenario),
           "Grains: block averages of each run, or the scatter between bed samples where that is larger. With one bed "
           "sample that scatter is unknown, and its row says so.",
           "Convergence of the balance: 1e-14 of the load; of its quadrature 1e-9. Of grains with their size: by the "
           "study of grain sizes (docs/lab/grain-size.md), where it reaches; with the time step and the bed: not part "
           "of a comparison; see docs/guide/soil-bin.md.",
           "Measured: the noise of one run, pooled over all setpoints that were run twice or more, over the root of "
           "the number of runs near a condition. Slips and forces are turned to the study's definitions by each run's "
           "yaw."}},
      Told::on_pages);
  report.add(Fold{"The whole comparison in sentences",
                  [&comparison, loop] { return Parts{{Sentences(backed(comparison, summary(comparison, loop)))}}; }});
}

}  // namespace

Report report_on(const Comparison& comparison, const ComparisonAbout& about) {
  const Scenario& scenario = comparison.question.scenario;
  const std::string tire = scenario.tire.name.empty() ? "A wheel" : scenario.tire.name;
  std::string errors = errors_in_words(scenario);
  Report report{about.title, fmt::format("{} on {}: {}", tire, scenario.soil.name, sides_in_words(comparison)),
                fmt::format("{}: {} on {}{}{}", comparison.question.study.name, in_words(scenario.tire),
                            in_words(scenario.soil), errors.empty() ? "" : "\n", errors)};
  add_opening(report, comparison);
  add_channels(report, comparison);
  add_causes(report, comparison);
  if (about.loop) add_loop(report, comparison, *about.loop);
  report.add(WarningsHere());
  add_differences(report, comparison);
  if (about.replay) add_replay(report, *about.replay);
  add_method(report, comparison, about.loop ? &*about.loop : nullptr);
  std::vector<std::string> labels;
  for (const Side& side : comparison.sides) labels.push_back(side.label);
  report.made_of = names_and_ids(labels);
  report.made_of.insert(report.made_of.end(), about.facts.begin(), about.facts.end());
  report.resolved_case = about.resolved_case;
  report.data = [&] { return comparison_json(comparison, about); };
  report.csv = [&] { return differences_csv(comparison); };
  report.data_name = "comparison", report.csv_name = "differences";
  return report;
}

}  // namespace soilbin::compare
