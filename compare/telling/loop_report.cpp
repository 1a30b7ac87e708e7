#include "compare/telling/loop_report.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "compare/doubts/doubts.hpp"
#include "compare/measured/channels.hpp"
#include "compare/measured/condition_views.hpp"
#include "compare/report/bars.hpp"
#include "compare/report/number_text.hpp"

namespace soilbin::compare {
namespace {

Table dependence_table(const LoopAnswer& answer) {
  Table table{"Share of each channel's residual that a parabola in the variable explains, and its p by permutation",
              {"channel", "variable", "before [%]", "p", "after [%]", "p"},
              {true, true}};
  const std::vector<Dependence>& after = answer.with_candidates().dependences_after;
  for (std::size_t i = 0; i < answer.dependences_before.size(); ++i) {
    const Dependence& b = answer.dependences_before[i];
    std::vector<TableCell> row = {std::string(channel_views[b.channel].title),
                                  std::string(condition_view(b.variable).title),
                                  number(100 * b.share),
                                  number(b.p_value),
                                  "-",
                                  "-"};
    if (i < after.size()) {
      row[4] = number(100 * after[i].share);
      row[5] = number(after[i].p_value);
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

/// What the forms presume of the wheel, a paragraph each below their table.
Prose presumptions_of(const std::vector<const Signature*>& signatures, const Tire& wheel) {
  std::vector<EffectChoice> forms;
  for (const Signature* s : signatures) forms.push_back({s->term.form->id, s->term.form->form, {}});
  return Prose{bekker_wong::presumptions(forms, wheel)};
}

/// The effects whose signatures look most like an accepted one's.
Table likeness_table(const LoopAnswer& answer) {
  Table table{"What looks most like the accepted effects: cosine of the traces off what the soil's values absorb",
              {"effect", "p-value", "most alike", "cosine"},
              {true, false, true, false}};
  constexpr std::size_t most = 3;
  for (const AcceptedEffect& effect : answer.effects()) {
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
  if (!answer.uses_effects()) return noise + "The model's soil values are refitted to these runs.";
  return noise + fmt::format("Before: the soil refitted to these runs, no effect added. After: with {}{}.",
                             named_effects(ids_of(answer.effects_in_model())),
                             answer.effects().empty() ? " as an empirical correction" : "");
}

/// The candidates that the data do not rule out, by their share.
Bars candidate_bars(const LoopAnswer& answer) {
  Bars bars{"Candidates: share [%]", {"share"}, {}, "%"};
  for (const WeightedSet& set : answer.ambiguity_set())
    bars.groups.push_back({named_effects(set.ids), {std::round(100 * set.weight)}});
  return bars;
}

using LoopParts = std::vector<ReportPart>;
/// The variables of the campaign (variables_by_weight), which the parts of a report share.
using Variables = std::shared_ptr<const std::vector<Covariate>>;

/// The figure that answers: curves where the runs lie on curves, else what the base model misses.
void add_main_figure(Report& report, const LoopAnswer& answer, const Variables& variables) {
  report.add("Measured and modelled", Prose{}, Told::to_look_at, "figure");
  const auto curves = curves_of_the_fit(answer);
  if (curves.empty()) {
    if (variables->empty()) return;
    report.add(Figure([&answer, variables] { return gap_sheet(answer, variables->front()); },
                      "Each run's measured value and the model after, both less the model before: where the two lie "
                      "together, the effects explain what was missing. " +
                          caption_of_models(answer)),
               Told::to_look_at);
    return;
  }
  Choices choices{"Runs at", {}};
  std::vector<std::pair<std::string, std::function<Sheet()>>> sheets;
  for (const auto& [label, rows] : curves) {
    sheets.emplace_back(label, drawn_once([&answer, rows = rows] { return fit_sheet(answer, rows); }));
    choices.all.emplace_back(label, [&answer, sheet = sheets.back().second] {
      return LoopParts{{Figure(sheet, caption_of_models(answer) + " Curves: at the mean of these runs' conditions.")}};
    });
  }
  if (curves.size() > 1)
    choices.all.emplace_back("all of them", [&answer, sheets] {
      Sheet all{""};
      for (const auto& [label, sheet] : sheets)
        for (Plot plot : sheet().plots) {
          plot.title += ": " + label;
          all.plots.push_back(std::move(plot));
        }
      return LoopParts{{Figure(std::move(all), caption_of_models(answer))}};
    });
  report.add(std::move(choices), Told::to_look_at);
}

/// `told`: by whom; an answer that judges nothing keeps its errors from pages.
void add_tables(Report& report, const LoopAnswer& answer, Told told) {
  if (Table errors = error_table(answer); !errors.rows.empty())
    report.add("Error before and after", std::move(errors), told, "error");
  if (answer.uses_effects()) {
    report.add(answer.effects().empty() ? "Empirical correction" : "The effects and their size",
               parameters_table(answer), told, "effects");
    if (!answer.with_candidates().soil_shifts.empty()) report.add(soil_table(answer), Told::to_look_at);
  }
  if (!answer.has_candidates()) return;
  report.add("Candidates", Prose{}, told, "candidates");
  if (answer.ambiguity_set().size() > 1)
    report.add(Drawings{{bars_svg(candidate_bars(answer), {0})}, "Share of the evidence of each candidate.", "shares"},
               Told::to_look_at);
  report.add(candidates_table(answer), told);
}

void add_gaps(Report& report, const LoopAnswer& answer, const Variables& variables) {
  if (variables->empty()) return;
  Choices choices{"Over", {}};
  for (const Covariate& x : *variables)
    choices.all.emplace_back(std::string(condition_view(x.name).title), [&answer, variables, &x] {
      return LoopParts{{Figure([&answer, variables, &x] { return gap_sheet(answer, x); },
                               "Each run, less the model before. Runs of one setting are drawn side by side. " +
                                   caption_of_models(answer))}};
    });
  report.add("What the base model misses, over each variable", std::move(choices), Told::to_look_at, "gaps");
}

LoopParts residual_parts(const LoopAnswer& answer, const Variables& variables) {
  LoopParts parts;
  for (const Covariate& x : *variables)
    parts.push_back({Figure(residual_sheet(answer, x), "In standard deviations of the noise, before and after.")});
  parts.push_back({dependence_table(answer)});
  return parts;
}

LoopParts signature_parts(const LoopAnswer& answer, const Variables& variables) {
  LoopParts parts;
  if (answer.uses_effects() && !variables->empty())
    parts.push_back(
        {Figure(signature_sheet(answer, variables->front()),
                "Points: residuals of the refitted base model, and the effect's change of the prediction.")});
  const std::vector<const Signature*> signatures = strongest_signatures(answer);
  parts.push_back({signature_table(signatures)});
  parts.push_back({presumptions_of(signatures, answer.wheel)});
  if (!answer.effects().empty()) parts.push_back({likeness_table(answer)});
  return parts;
}

LoopParts noise_parts(const LoopAnswer& answer) {
  LoopParts parts{{noise_table(answer)}};
  if (answer.validation.overall.cells > 0 && answer.uses_effects())
    parts.push_back({Prose{{fmt::format("The cross-validated squared error falls by {} ± {} noise variances a value.",
                                        number(answer.validation.gain), number(answer.validation.gain_error))}}});
  return parts;
}

void add_appendix(Report& report, const LoopAnswer& answer, const Variables& variables) {
  report.add("Appendix",
             Fold{"Residuals against every variable, in standard deviations of the noise",
                  [&answer, variables] { return residual_parts(answer, variables); }},
             Told::on_pages, "appendix");
  report.add(Fold{"Signatures: what each effect would leave in the residual",
                  [&answer, variables] { return signature_parts(answer, variables); }});
  report.add(Fold{"Noise", [&answer] { return noise_parts(answer); }});
}

}  // namespace

Report report_on(const Campaign& campaign, const LoopAnswer& answer, const Doubts& doubts) {
  Report report{
      campaign.name + ": what the model lacks",
      fmt::format(
          "The analytic wheel against {} measured runs: what is missing, how sure that is, and what to measure next",
          campaign.runs.size()),
      answer.campaign};
  report.add(Headline{headline(answer, in_words(of_mistaken_columns(doubts)))});
  if (Table next = next_run_table(answer); !next.rows.empty()) report.add(std::move(next));
  const bool judged = answer.judgement() && (answer.verdict() != Verdict::not_enough_data || answer.has_candidates());
  const auto variables =
      std::make_shared<const std::vector<Covariate>>(judged ? variables_by_weight(answer) : std::vector<Covariate>());
  if (judged) add_main_figure(report, answer, variables);
  add_tables(report, answer, judged ? Told::everywhere : Told::in_text);
  if (judged) add_gaps(report, answer, variables);
  if (std::vector<std::string> more = notes(answer); !more.empty())
    report.add("Notes", Items{std::move(more)}, Told::everywhere, "notes");
  report.add(WarningsHere());
  if (judged) add_appendix(report, answer, variables);
  report.data = [&] {
    nlohmann::ordered_json document = to_json(answer);
    if (const Doubts columns = of_mistaken_columns(doubts); !columns.empty())
      document["column_doubts"] = in_words(columns);
    return document;
  };
  report.data_name = "loop";
  return report;
}

}  // namespace soilbin::compare
