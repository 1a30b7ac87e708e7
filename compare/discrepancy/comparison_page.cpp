#include "compare/discrepancy/comparison_page.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "compare/discrepancy/causes.hpp"
#include "compare/discrepancy/comparison_sheets.hpp"
#include "compare/discrepancy/comparison_tables.hpp"
#include "compare/discrepancy/summary.hpp"
#include "compare/doubts/doubts.hpp"
#include "compare/loop/answer_words.hpp"
#include "compare/report/page.hpp"
#include "compare/sweep/model_names.hpp"
#include "compare/sweep/varying.hpp"

namespace soilbin::compare {
namespace {

std::string named(const std::string& curve) { return curve.empty() ? "all conditions" : curve; }

/// "the analytic wheel (bekker_wong), the same with effects, grains (dem) and measurements".
std::string sides_in_words(const Comparison& comparison) {
  bool effects = false, grains = false, measured = false;
  for (const Side& side : comparison.sides) {
    effects = effects || (side.kind == SideKind::analytic && &side != comparison.sides.data());
    grains = grains || side.kind == SideKind::grains;
    measured = measured || side.kind == SideKind::measured;
  }
  std::vector<std::string> others;
  for (const auto& [there, name] :
       {std::pair{effects, "the same with effects"}, {grains, "grains (dem)"}, {measured, "measurements"}})
    if (there) others.emplace_back(name);
  std::string text = "the analytic wheel (bekker_wong)";
  for (const std::string& other : others) text += (&other == &others.back() ? " and " : ", ") + other;
  return others.empty() ? text : text + " side by side";
}

/// Links from a clause to the tables and sections that hold its rows.
std::vector<std::pair<std::string, std::string>> evidence_of(const Comparison& comparison, const Clause& clause) {
  std::vector<std::pair<std::string, std::string>> links;
  if (!clause.rows.empty()) {
    const Difference& first = comparison.differences[clause.rows.front()];
    links.emplace_back(rows_anchor({.side = first.side, .reference = first.reference, .channel = first.channel}),
                       fmt::format("{} row{}", clause.rows.size(), clause.rows.size() == 1 ? "" : "s"));
  }
  for (const std::string& evidence : clause.evidence) {
    const std::string anchor = evidence == "budget"            ? "why"
                               : evidence == "the loop"        ? "loop"
                               : evidence == "rule"            ? "method"
                               : evidence == "table of points" ? "points"
                               : evidence == "warnings"        ? "doubts"
                                                               : "tallies";
    links.emplace_back(anchor, evidence);
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
  if (there(SideKind::analytic)) text += "Lines: the analytic wheel, with one standard error of the soil's values. ";
  if (there(SideKind::grains)) text += "Points on lines: grains, with one standard error of their runs. ";
  if (there(SideKind::measured)) text += "Points: measured, with one standard error of the measured runs. ";
  if (!text.empty()) text.pop_back();
  return text;
}

void add_curves(Page& page, const Comparison& comparison, bool coarse_grains) {
  page.place("Curves", "curves");
  const std::vector<std::string>& names = comparison.curves.labels;
  const Comparison smooth = smooth_sides(comparison);
  std::vector<Choice> parts;
  for (std::size_t c = 0; c < names.size(); ++c)
    parts.push_back({named(names[c]), [&page, &comparison, &smooth, c, coarse_grains] {
                       page.figure(curve_sheet(comparison, c, coarse_grains, smooth), curves_in_words(comparison));
                     }});
  if (names.size() > 1)
    parts.push_back(
        {"all curves at once", [&page, &comparison, &smooth] {
           page.figure(
               overview_sheet(comparison, smooth),
               "A colour for each curve, a dash for each side. Bands: one standard error; where many would hide each "
               "other, point at a name in the legend to see its own.");
         }});
  const Difference* widest = widest_difference(comparison);
  page.choices("Curve", parts,
               widest != nullptr ? comparison.curves.curve_of[widest->condition] : (names.size() - 1) / 2);
}

/// The answer and the grains' limits in a sentence or two, the curves, what the soil explains of it, then all numbers.
void add_opening(Page& page, const Comparison& comparison, bool coarse_grains) {
  std::vector<Clause> clauses = opening(comparison);
  const auto soil = std::ranges::stable_partition(clauses, [](const Clause& c) { return c.about != "The soil"; });
  if (clauses.empty()) page.sentences({"There is nothing to compare: a single side."});
  const std::vector<Clause> first(clauses.begin(), soil.begin()), then(soil.begin(), clauses.end());
  if (!first.empty()) page.backed_summary(backed(comparison, first));
  add_curves(page, comparison, coarse_grains);
  if (!then.empty()) page.backed_summary(backed(comparison, then));
  if (const Table matrix = matrix_table(comparison); !matrix.rows.empty()) {
    page.section("Condition by condition", "matrix");
    page.table(matrix);
  }
}

void add_channels(Page& page, const Comparison& comparison) {
  if (comparison.tallies.empty()) return;
  page.section("Channel by channel", "tallies");
  Table tally = tally_table(comparison);
  tally.caption += ". Green: within what uncertainty explains";
  page.table(tally);
  const auto count = [&](DifferenceFinding finding) {
    return std::to_string(
        std::ranges::count_if(comparison.differences, [&](const Difference& d) { return d.finding == finding; }));
  };
  page.figures_at_a_glance({{std::to_string(comparison.question.study.conditions.size()), "conditions"},
                            {std::to_string(comparison.differences.size()), "numbers compared"},
                            {count(DifferenceFinding::difference), "differences"},
                            {count(DifferenceFinding::within_scatter), "within the scatter of a run"},
                            {count(DifferenceFinding::within_errors), "within the errors"},
                            {count(DifferenceFinding::not_judged), "not tested: same soil data"}});
}

void add_differences(Page& page, const Comparison& comparison) {
  page.section("Where they differ", "differ");
  std::vector<std::string> maps;
  for (const Tally& tally : comparison.tallies) maps.push_back(heat_map_svg(heat_map_of(comparison, tally)));
  page.heat_maps(maps, "Bold: a difference. Faint: within the scatter of a run, or covered by the errors.");
  for (const Tally& tally : comparison.tallies)
    page.folded(
        fmt::format("Rows: {}, {} against {}", channel_views[tally.channel].title, comparison.sides[tally.side].label,
                    comparison.sides[tally.reference].label),
        [&] { page.table(rows_table(comparison, tally)); }, rows_anchor(tally));
}

void add_causes(Page& page, const Comparison& comparison) {
  page.section("Why", "why");
  if (std::vector<Clause> causes = cause_clauses(comparison); !causes.empty()) {
    for (Clause& cause : causes) cause.about.clear();  // the heading says it
    page.backed_summary(backed(comparison, causes));
  }
  page.paragraph(
      "Pull is the soil's thrust less its resistance. Stresses run from the exit angle (behind the axle, negative) to "
      "the "
      "entry angle.");
  std::vector<Choice> parts;
  const auto& conditions = comparison.question.study.conditions;
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    if (budget_at(comparison, i).rows.empty()) continue;
    parts.push_back({in_words(conditions[i]), [&page, &comparison, i] {
                       const auto [bars, side_colors] = budget_bars(comparison, i);
                       page.drawing(bars_svg(bars, side_colors), "Parts that add up to the drawbar pull.");
                       page.table(budget_table(comparison, i));
                       const Sheet stresses = stress_sheet(comparison, i);
                       if (!stresses.plots.empty())
                         page.figure(stresses,
                                     "Normal and shear stress on the wheel along the contact, of each model at this "
                                     "condition.");
                     }});
  }
  const std::string telling = in_words(conditions[condition_of_largest_difference(comparison)]);
  const auto first = std::ranges::find_if(parts, [&](const Choice& c) { return c.name == telling; });
  page.choices("Condition", parts, first == parts.end() ? 0 : static_cast<std::size_t>(first - parts.begin()));
  page.subsection("Contact and sinkage");
  const std::vector<std::string>& names = comparison.curves.labels;
  std::vector<Choice> contacts;
  for (std::size_t c = 0; c < names.size(); ++c)
    contacts.push_back({named(names[c]), [&page, &comparison, c] {
                          page.figure(contact_sheet(comparison, c),
                                      "Entry and exit angles, and the sinkage that slip adds.");
                        }});
  page.choices("Curve", contacts, (names.size() - 1) / 2);
  if (const Table table = sinkage_table(comparison); !table.rows.empty()) page.table(table);
}

void add_loop(Page& page, const ComparisonAbout& about) {
  if (!about.loop) return;
  page.section("What the analytic model lacks", "loop");
  page.paragraph(fmt::format(
      "The loop takes the results of '{}' as measured: it refits the soil within its declared uncertainty, tests every "
      "known effect, and judges by cross-validation.",
      about.loop->campaign));
  page.backed_summary(headline(*about.loop, about.mistaken_columns));
  if (const Table next = next_run_table(*about.loop); !next.rows.empty()) page.table(next);
  for (const Table& table : {error_table(*about.loop), parameters_table(*about.loop)})
    if (!table.rows.empty()) page.table(table);
  if (about.loop->has_candidates()) {
    page.table(candidates_table(*about.loop));
    page.paragraph(candidates_columns_in_words());
  }
  page.list(notes(*about.loop));
}

void add_replay(Page& page, const ComparisonAbout& about) {
  if (!about.replay) return;
  const ReplayFile& file = *about.replay;
  page.section("The grains at work", "replay");
  std::string facts;
  for (const auto& [name, value] : file.facts) facts += fmt::format("; {} {}", name, value);
  page.replay(file.title, file.bytes,
              fmt::format("{}: {} grains, {} frames over {:.2f} s{}. Drag to turn, Ctrl and the wheel to come nearer.",
                          file.title, file.grains, file.frames, file.seconds, facts));
}

/// `ids`: what flags and files call the sides.
void add_method(Page& page, const Comparison& comparison, const ComparisonAbout& about,
                const std::vector<std::pair<std::string, std::string>>& ids) {
  page.section("Every point", "points");
  for (const Side& side : comparison.sides)
    page.folded(side.label, [&] { page.table(points_table(comparison, side)); });
  page.section("How it is judged", "method");
  if (const std::vector<Clause> limits = limits_of_the_comparison(comparison); !limits.empty())
    page.backed_summary(backed(comparison, limits));
  if (!comparison.joint.empty()) page.table(joint_table(comparison));
  page.list(
      {"A difference d with standard error u counts where |d| is above 2 u and above the scatter of one run; u is the "
       "root of both sides' variances. Where u rests on few re-runs, Student's t takes the place of 2.",
       "Analytic: the standard deviations of the soil's values, propagated to first order. They move all conditions "
       "together; the joint test takes that in. " +
           errors_in_words(comparison.question.scenario),
       "Grains: block averages of each run, or the scatter between bed samples where that is larger. With one bed "
       "sample that scatter is unknown, and its row says so.",
       "Convergence of the balance: 1e-14 of the load; of its quadrature 1e-9. Of grains with their size: by the study "
       "of grain sizes (docs/lab/grain-size.md), where it reaches; with the time step and the bed: not part of a "
       "comparison; see docs/guide/soil-bin.md.",
       "Measured: the noise of one run, pooled over all setpoints that were run twice or more, over the root of the "
       "number of runs near a condition. Slips and forces are turned to the study's definitions by each run's yaw."});
  page.folded("The whole comparison in sentences", [&] {
    page.backed_summary(backed(comparison, summary(comparison, about.loop ? &*about.loop : nullptr)));
  });
  page.section("How to repeat this", "repeat");
  page.code(about.page.command);
  page.facts({"part", ""}, {&ids, &about.page.versions, &about.facts});
  page.folded("The resolved case", [&] { page.code(about.resolved_case); });
}

}  // namespace

void ask_loop(const Comparison& comparison, const LoopOptions& options, ComparisonAbout& about) {
  const Side& reference = comparison.sides.back();
  if (reference.kind == SideKind::analytic) return;
  const Campaign campaign = as_campaign(reference, comparison.question);
  if (reference.kind == SideKind::measured) about.mistaken_columns = doubts_before_fit(campaign).columns;
  about.loop = run_loop(campaign, options);
}

std::string comparison_page(const Comparison& answered, const ComparisonAbout& about) {
  Comparison comparison = answered;  // with its sides called as people call them
  const std::vector<std::string> labels = label_sides_in_words(comparison);
  const Scenario& scenario = comparison.question.scenario;
  Page page(about.page.title, fmt::format("{} on {}: {}", scenario.tire.name.empty() ? "A wheel" : scenario.tire.name,
                                          scenario.soil.name, sides_in_words(comparison)));
  if (!page.libraries().missing.empty())
    page.raw(
        fmt::format("<p class=\"warning\" role=\"note\">Made without {}: the figures that need it are plain drawings. "
                    "Install it and make the page again.</p>\n",
                    escaped(fmt::format("{}", fmt::join(page.libraries().missing, ", ")))));
  add_opening(page, comparison, grains_are_coarse(comparison));
  add_channels(page, comparison);
  add_causes(page, comparison);
  add_loop(page, about);
  page.doubts(about.page.doubts);
  add_differences(page, comparison);
  add_replay(page, about);
  add_method(page, comparison, about, names_and_ids(labels));
  return page.html();
}

}  // namespace soilbin::compare
