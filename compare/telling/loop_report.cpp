// The loop's answer for its page and for a terminal: its tables, then all in its order.
#include "compare/telling/loop_report.hpp"

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "bekker_wong/effects/titles.hpp"
#include "bekker_wong/learned.hpp"
#include "compare/doubts/doubts.hpp"
#include "compare/measured/campaign.hpp"
#include "compare/measured/condition_views.hpp"
#include "compare/report/bars.hpp"
#include "compare/report/number_text.hpp"

namespace soilbin::compare {
namespace {

/// "1 : 132"; what is beyond a million is only counted so, its number in grey.
TableCell odds_to_the_first(double behind) {
  constexpr double million = 1e6;
  const double odds = std::exp(std::abs(behind));
  if (behind <= 0) return number(odds) + " : 1";
  if (odds > million) return {"< 1 : 1,000,000", fmt::format("1 : {:.2g}", odds)};
  return "1 : " + number(odds);
}

Tone tone_of(const HeldOutErrors& error) {
  constexpr double worth_a_colour = 0.95;
  return rises(error) ? Tone::bad : error.after < worth_a_colour * error.before ? Tone::good : Tone::none;
}

std::string change_of(const HeldOutErrors& error) {
  return error.before > 0 ? fmt::format("{:+.0f} %", 100 * (error.after / error.before - 1)) : "-";
}

}  // namespace

/// The rows of shape_series: what is set alike in all, then what varies.
Table series_table(const LoopAnswer& answer, const std::vector<OperatingCondition>& series) {
  const std::string varied = sure_dependences(answer).front().variable;
  const Limits conditions = ranges_of(answer.found().base.data().observations);
  MarkedTable table{fmt::format("The next runs, as rows of the campaign: the {} alone varies, all else is as in the "
                                "run that the model misses most",
                                condition_view(varied).title),
                    {}};
  for (std::size_t k = 0; k < series.size(); ++k) table.add({});
  for (const auto& [name, range] : conditions) {
    for (std::size_t k = 0; k < series.size(); ++k) {
      const auto [value, unit] = next_setting(answer, series[k], name);
      if (k == 0) table.header.push_back(heading(std::string(condition_view(name).title), unit.empty() ? "-" : unit));
      table.rows[k].push_back(value);
    }
  }
  table.header.emplace_back("runs");
  for (auto& row : table.rows) row.push_back("2");
  return table;
}

Table next_run_table(const LoopAnswer& answer) {
  if (const std::vector<OperatingCondition> series = shape_series(answer); !series.empty())
    return series_table(answer, series);
  if (!proposes_next(answer)) return {};
  const NextRun& next = *answer.next();
  const std::vector<std::string> unknown = beyond_what_is_known(next);
  MarkedTable table{"The next run, as a row of the campaign", {}};
  table.add({});
  for (const std::string& name : next.quantities) {
    const auto [value, unit] = next_setting(answer, next.at, name);
    if (value.empty()) continue;
    table.header.push_back(heading(std::string(condition_view(name).title), unit.empty() ? "-" : unit));
    const bool beyond = std::ranges::find(unknown, name) != unknown.end();
    table.rows[0].push_back({value, beyond ? "beyond what was run" : ""});
  }
  table.header.insert(table.header.end(), {"runs", "decides between"});
  table.rows[0].push_back(std::to_string(next.runs));
  table.rows[0].push_back(named_effects(next.separates.front()) + " | " + named_effects(next.separates.back()));
  table.text_columns.assign(table.header.size(), false);
  table.text_columns.back() = true;
  return table;
}

/// Errors of a model without effects: no column "after".
Table base_error_table(const LoopAnswer& answer) {
  Table table{
      "Cross-validated RMS error, the soil refitted; noise: scatter about any smooth function of the conditions",
      {"channel", "values", "error", "noise"}};
  for (std::size_t c = 0; c < channel_views.size(); ++c)
    if (const HeldOutErrors& e = answer.validation.channels[c]; e.cells > 0)
      table.add({std::string(channel_views[c].title), std::to_string(e.cells), in_unit(c, e.before),
                 in_unit(c, e.noise_floor)});
  if (const HeldOutErrors& all = answer.validation.overall; all.cells > 0)
    table.add({"all, in standard deviations of the noise", std::to_string(all.cells), number(all.before), "1"});
  return table;
}

Table error_table(const LoopAnswer& answer) {
  if (!answer.uses_effects()) return base_error_table(answer);
  MarkedTable table{
      "Cross-validated RMS error; before: soil refitted, no effect added; noise: scatter about any smooth function of "
      "the conditions",
      {"channel", "values", "before", "after", "change", "noise"}};
  for (std::size_t c = 0; c < channel_views.size(); ++c) {
    const HeldOutErrors& e = answer.validation.channels[c];
    if (e.cells == 0) continue;
    table.add({std::string(channel_views[c].title),
               std::to_string(e.cells),
               in_unit(c, e.before),
               {in_unit(c, e.after), "", tone_of(e)},
               change_of(e),
               in_unit(c, e.noise_floor)});
  }
  const HeldOutErrors& all = answer.validation.overall;
  if (all.cells > 0)
    table.add({"all, in standard deviations of the noise",
               std::to_string(all.cells),
               number(all.before),
               {number(all.after), "", tone_of(all)},
               change_of(all),
               "1"});
  return table;
}

Table candidates_table(const LoopAnswer& answer) {
  const std::string premise = !answer.second()           ? ""
                              : answer.second()->decides ? ", with a base model that may itself be wrong"
                                                         : ", the base model taken as exact";
  const std::string shares = answer.verdict() == Verdict::unknown_effect
                                 ? "; none explains the data, shares are among the nearest"
                                 : "; shares are of those not ruled out";
  MarkedTable table{"Candidates, each fitted in full" + premise + shares,
                    {"effects", "variant", "share", "odds to the first", "chi2", "values"},
                    {true, true}};
  const std::string values = std::to_string(answer.found().base.data().cells());
  const std::vector<const WeightedSet*> sets = sets_shown(answer);
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const WeightedSet& w = *sets[i];
    const CandidateModel& candidate = answer.found().candidates.models[w.best_candidate];
    table.add({{named_effects(w.ids), joined(w.ids) == named_effects(w.ids) ? "" : joined(w.ids)},
               fmt::format("{}", fmt::join(forms_in_order(candidate), " + ")),
               i < answer.ambiguity_set().size() ? share_words(w.weight) : "-",
               i == 0 ? TableCell("-") : odds_to_the_first(sets.front()->log_evidence - w.log_evidence),
               number(candidate.fit().chi2),
               values});
  }
  table.add({"none: the base model", "-", "-", "-", number(answer.found().base.fit().chi2), values});
  table.legend =
      "Odds to the first: how likely these data are with this set, beside the first one. chi2: the sum of the squared "
      "residuals, each in standard deviations of the noise; about the number of values where nothing is missing.";
  return table;
}

Table parameters_table(const LoopAnswer& answer) {
  MarkedTable table{answer.effects().empty() ? "Empirical correction: fitted parameters" : "Effects: fitted parameters",
                    {"effect", "parameter", "value", "95 %", "allowed", "determined?"},
                    {true, true, false, false, false, true}};
  for (const AcceptedEffect& effect : answer.effects_in_model()) {
    const bekker_wong::EffectForm& form = bekker_wong::find_form(effect.choice);
    if (form.id == bekker_wong::learned_id) {  // its weights mean nothing one by one
      table.add({{std::string(bekker_wong::effect_title(form.id).name), form.id},
                 {form.equation, "variant " + form.form},
                 std::to_string(effect.fitted.size()) + " weights",
                 "-",
                 "-",
                 "-"});
      continue;
    }
    for (std::size_t i = 0; i < effect.fitted.size(); ++i) {
      const auto& p = bekker_wong::find_parameter(form, effect.fitted[i]);
      const double scale = per_unit(p.unit);
      const std::string unit = unit_behind(p.unit);
      const auto& [low, high] = effect.ci95[i];
      table.add(
          {i == 0 ? TableCell(std::string(bekker_wong::effect_title(form.id).name), form.id + ", variant " + form.form)
                  : TableCell{},
           {p.meaning, p.name},
           number(scale * effect.choice.parameters.at(p.name)) + unit,
           fmt::format("{} to {}{}", number(scale * low), number(scale * high), unit),
           fmt::format("{:.4g} to {:.4g}{}", scale * p.lower, scale * p.upper, unit),
           effect.at_bound[i] ? TableCell("no: at its bound", "", Tone::bad) : TableCell("yes")});
    }
  }
  return table;
}

Table soil_table(const LoopAnswer& answer) {
  MarkedTable table{"Soil values with and without the effects; bias: without - with",
                    {"value", "with", "without", "bias", "unit", "determined?"},
                    {true, false, false, false, true, true}};
  constexpr double hardly_less = 0.9;  // of the declared standard deviation: the data tell next to nothing
  for (const SoilShift& s : answer.with_candidates().soil_shifts) {
    const DeclaredValueWords p = words_of_declared(s.name);
    const bool held = s.held;
    const bool as_declared = s.declared_sd > 0 && s.with.std_error > hardly_less * s.declared_sd;
    table.add({{p.title, p.meaning},
               number(s.with, p.per_si),
               number(s.without, p.per_si),
               number(p.per_si * (s.without.value - s.with.value)),
               p.unit,
               held          ? TableCell("no: at its bound", "", Tone::bad)
               : as_declared ? TableCell("no: as declared", "", Tone::bad)
                             : TableCell("yes")});
  }
  return table;
}

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
                      "Each run's measured value and the model after, both minus the model before: where the two lie "
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
                               "Each run minus the model before. Runs of one setting are drawn side by side. " +
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
    parts.push_back(
        {Prose{{fmt::format("The cross-validated squared error {} by {} ± {} noise variances a value.",
                            answer.validation.gain < 0 ? "rises" : "falls", number(std::abs(answer.validation.gain)),
                            number(answer.validation.gain_error))}}});
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
