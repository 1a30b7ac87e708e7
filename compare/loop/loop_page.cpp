// The loop's report as one page: the answer, the figure that shows it, tables, and folded what stands behind them.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "compare/loop/answer_words.hpp"
#include "compare/loop/loop_figures.hpp"
#include "compare/measured/channels.hpp"
#include "compare/measured/condition_views.hpp"
#include "compare/report/bars.hpp"
#include "compare/report/number_text.hpp"
#include "compare/report/page.hpp"

namespace soilbin::compare {
namespace {

Table dependence_table(const LoopAnswer& answer) {
  Table table{"Share of each channel's residual that a parabola in the variable explains, and its p by permutation",
              {"channel", "variable", "before [%]", "p", "after [%]", "p"},
              {true, true}};
  for (std::size_t i = 0; i < answer.dependences_before.size(); ++i) {
    const Dependence& b = answer.dependences_before[i];
    std::vector<TableCell> row = {std::string(channel_views[b.channel].title),
                                  std::string(condition_view(b.variable).title),
                                  number(100 * b.share),
                                  number(b.p_value),
                                  "-",
                                  "-"};
    if (i < answer.dependences_after.size()) {
      row[4] = number(100 * answer.dependences_after[i].share);
      row[5] = number(answer.dependences_after[i].p_value);
    }
    table.add(std::move(row));
  }
  return table;
}

Table noise_table(const LoopAnswer& answer) {
  const bool unsteady =
      std::ranges::any_of(answer.noise.channels, [](const ChannelNoise& n) { return n.unsteady > 0.0; });
  Table table{unsteady
                  ? "Noise of one run that scattered by s in time, at a predicted value f: sqrt(a² + b² f² + q² s²)"
                  : "Noise of one run at a predicted value f: sqrt(a² + b² f²)",
              {"channel", "a", "b [%]", "degrees of freedom", "sd within re-runs"}};
  if (unsteady) table.header.insert(table.header.end(), {"q", "s (median)"});
  for (std::size_t c = 0; c < channel_views.size(); ++c) {
    const ChannelNoise& n = answer.noise.channels[c];
    if (!n.measured) continue;
    const ChannelView& view = channel_views[c];
    table.add({std::string(view.title), fmt::format("{} {}", number(n.floor * view.per_si), view.unit),
               number(100 * n.growth), number(n.freedom),
               n.rerun_sd > 0 ? fmt::format("{} {}", number(n.rerun_sd * view.per_si), view.unit) : "-"});
    if (unsteady)
      table.rows.back().insert(table.rows.back().end(),
                               {number(n.unsteady), fmt::format("{} {}", number(n.spread * view.per_si), view.unit)});
  }
  return table;
}

/// The strongest signature of each form, strongest first.
std::vector<const Signature*> strongest_signatures(const LoopAnswer& answer) {
  constexpr std::size_t most = 15;
  std::vector<const Signature*> order, strongest;
  for (const Signature& s : answer.found().signatures.all)
    if (s.projected_norm > 0) order.push_back(&s);
  std::ranges::stable_sort(order, [](auto a, auto b) { return a->strength() > b->strength(); });
  std::set<const bekker_wong::EffectForm*> shown;
  for (const Signature* s : order)
    if (strongest.size() < most && shown.insert(s->term.form).second) strongest.push_back(s);
  return strongest;
}

Table signature_table(const std::vector<const Signature*>& signatures) {
  Table table{"The strongest signatures against the base model; kept: the share that the soil's values cannot absorb",
              {"effect", "variant", "score [sd]", "amplitude [SI]", "kept [%]", "detectable from [SI]"},
              {true, true}};
  for (const Signature* s : signatures)
    table.add({s->term.form->id, s->term.form->form, number(s->score), number(Estimate{s->amplitude, s->std_error}),
               number(100 * s->share_kept), number(s->detectable)});
  return table;
}

/// What the forms presume of the wheel, a paragraph below their table.
void add_presumptions(Page& page, const std::vector<const Signature*>& signatures, const Tire& wheel) {
  std::vector<EffectChoice> forms;
  for (const Signature* s : signatures) forms.push_back({s->term.form->id, s->term.form->form, {}});
  for (const std::string& sentence : bekker_wong::presumptions(forms, wheel)) page.paragraph(sentence);
}

/// The effects whose signatures look most like an accepted one's.
Table likeness_table(const LoopAnswer& answer) {
  Table table{"What looks most like the accepted effects: cosine of the traces off what the soil's values absorb",
              {"effect", "p-value", "most alike", "cosine"},
              {true, false, true, false}};
  constexpr std::size_t most = 3;
  for (const AcceptedEffect& effect : answer.effects) {
    std::vector<std::pair<double, std::string>> order;
    for (const auto& [id, cosine] : effect.cosines) order.emplace_back(-cosine, id);
    std::ranges::sort(order);
    for (std::size_t i = 0; i < std::min(most, order.size()); ++i)
      table.add({effect.choice.id, number(effect.p_value), order[i].second, number(-order[i].first)});
  }
  return table;
}

std::string caption_of_models(const LoopAnswer& answer) {
  const std::string noise = "Bars: one standard deviation of a run's noise. ";
  if (!takes_effects(answer)) return noise + "The model's soil values are refitted to these runs.";
  return noise + fmt::format("Before: the soil refitted to these runs, no effect added. After: with {}{}.",
                             named_effects(ids_of(answer.taken())),
                             answer.effects.empty() ? " as an empirical correction" : "");
}

/// The figure that answers: curves where the runs lie on curves, else what the base model misses.
void add_main_figure(Page& page, const LoopAnswer& answer, const std::vector<Covariate>& variables) {
  page.section("Measured and modelled", "figure");
  const auto curves = curves_of_the_fit(answer);
  if (curves.empty()) {
    if (variables.empty()) return;
    page.figure(gap_sheet(answer, variables.front()),
                "Each run's measured value and the model after, both less the model before: where the two lie "
                "together, the effects explain what was missing. " +
                    caption_of_models(answer));
    return;
  }
  std::vector<Choice> parts;
  Sheet all{""};
  for (const auto& [label, sheet] : curves) {
    parts.push_back({label, [&page, &answer, &sheet = sheet] {
                       page.figure(sheet,
                                   caption_of_models(answer) + " Curves: at the mean of these runs' conditions.");
                     }});
    for (Plot plot : sheet.plots) {
      plot.title += ": " + label;
      all.plots.push_back(std::move(plot));
    }
  }
  if (curves.size() > 1)
    parts.push_back({"all of them", [&page, &answer, &all] { page.figure(all, caption_of_models(answer)); }});
  page.choices("Runs at", parts, 0);
}

/// The candidates that the data do not rule out, by their share.
Bars candidate_bars(const LoopAnswer& answer) {
  Bars bars{"Candidates: share [%]", {"share"}, {}, "%"};
  for (const WeightedSet& set : answer.ambiguity_set)
    bars.groups.push_back({named_effects(set.ids), {std::round(100 * set.weight)}});
  return bars;
}

void add_tables(Page& page, const LoopAnswer& answer) {
  if (answer.validation.overall.cells > 0) {
    page.section("Error before and after", "error");
    page.table(error_table(answer));
  }
  if (takes_effects(answer)) {
    page.section(answer.effects.empty() ? "Empirical correction" : "The effects and their size", "effects");
    page.table(parameters_table(answer));
    if (!answer.soil_shifts.empty()) page.table(soil_table(answer));
  }
  if (answer.has_candidates()) {
    page.section("Candidates", "candidates");
    if (answer.ambiguity_set.size() > 1)
      page.drawing(bars_svg(candidate_bars(answer), {0}), "Share of the evidence of each candidate.");
    page.table(candidates_table(answer));
    page.paragraph(candidates_columns_in_words());
  }
}

void add_gaps(Page& page, const LoopAnswer& answer, const std::vector<Covariate>& variables) {
  if (variables.empty()) return;
  page.section("What the base model misses, over each variable", "gaps");
  std::vector<Choice> parts;
  for (const Covariate& x : variables)
    parts.push_back({std::string(condition_view(x.name).title), [&page, &answer, &x] {
                       page.figure(gap_sheet(answer, x),
                                   "Each run, less the model before. Runs of one setting stand side by side. " +
                                       caption_of_models(answer));
                     }});
  page.choices("Over", parts, 0);
}

void add_appendix(Page& page, const LoopAnswer& answer, const std::vector<Covariate>& variables) {
  page.section("Appendix", "appendix");
  page.folded("Residuals against every variable, in standard deviations of the noise", [&] {
    for (const Covariate& x : variables)
      page.figure(residual_sheet(answer, x), "In standard deviations of the noise, before and after.");
    page.table(dependence_table(answer));
  });
  page.folded("Signatures: what each effect would leave in the residual", [&] {
    if (takes_effects(answer) && !variables.empty())
      page.figure(signature_sheet(answer, variables.front()),
                  "Points: what the base model, refitted, leaves; and what the effect changes in the prediction.");
    const std::vector<const Signature*> signatures = strongest_signatures(answer);
    page.table(signature_table(signatures));
    add_presumptions(page, signatures, answer.wheel);
    if (!answer.effects.empty()) page.table(likeness_table(answer));
  });
  page.folded("Noise", [&] {
    page.table(noise_table(answer));
    if (answer.validation.overall.cells > 0 && takes_effects(answer))
      page.paragraph(fmt::format("The cross-validated squared error falls by {} ± {} noise variances a value.",
                                 number(answer.validation.gain), number(answer.validation.gain_error)));
  });
}

}  // namespace

std::string loop_page(const Campaign& campaign, const LoopAnswer& answer, const std::vector<std::string>& doubts,
                      const std::vector<std::string>& column_doubts, const std::string& command) {
  Page page(
      campaign.name + ": what the model lacks",
      fmt::format(
          "The analytic wheel against {} measured runs: what is missing, how sure that is, and what to measure next",
          campaign.runs.size()));
  page.backed_summary(headline(answer, column_doubts));
  if (const Table next = next_run_table(answer); !next.rows.empty()) page.table(next);
  const bool judged = answer.judgement && (answer.verdict != Verdict::not_enough_data || answer.has_candidates());
  const std::vector<Covariate> variables = judged ? variables_by_weight(answer) : std::vector<Covariate>();
  if (judged) {
    add_main_figure(page, answer, variables);
    add_tables(page, answer);
    add_gaps(page, answer, variables);
  }
  if (const std::vector<std::string> more = notes(answer); !more.empty()) {
    page.section("Notes", "notes");
    page.list(more);
  }
  page.doubts(doubts);
  if (judged) add_appendix(page, answer, variables);
  page.section("How to repeat this", "repeat");
  page.code(command);
  return page.html();
}

}  // namespace soilbin::compare
