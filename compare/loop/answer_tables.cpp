// The tables of the loop's answer, for its page and for a terminal.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bekker_wong/effects/titles.hpp"
#include "bekker_wong/learned.hpp"
#include "compare/loop/answer_words.hpp"
#include "compare/measured/condition_views.hpp"
#include "compare/report/number_text.hpp"
#include "scenario/soil_parameters.hpp"

namespace soilbin::compare {
namespace {

/// "1 : 132"; what is beyond a million is only counted so, its number in grey.
MarkedCell odds_to_the_first(double behind) {
  constexpr double million = 1e6;
  const double odds = std::exp(std::abs(behind));
  if (behind <= 0) return {.text = number(odds) + " : 1"};
  if (odds > million) return {.text = "< 1 : 1,000,000", .note = fmt::format("1 : {:.2g}", odds)};
  return {.text = "1 : " + number(odds)};
}

Tone tone_of(const ErrorPair& error) {
  constexpr double worth_a_colour = 0.95;
  return rises(error) ? Tone::bad : error.after < worth_a_colour * error.before ? Tone::good : Tone::none;
}

std::string change_of(const ErrorPair& error) {
  return error.before > 0 ? fmt::format("{:+.0f} %", 100 * (error.after / error.before - 1)) : "-";
}

}  // namespace

MarkedTable next_run_table(const LoopAnswer& answer) {
  if (!answer.next) return {};
  const NextTest& next = *answer.next;
  MarkedTable table{"The next run, as a row of the campaign", {}, {}, {{}}};
  for (const std::string& name : next.quantities) {
    const auto [value, unit] = next_setting(answer, name);
    if (value.empty()) continue;
    table.header.push_back(heading(std::string(condition_view(name).title), unit.empty() ? "-" : unit));
    const bool beyond = std::find(next.beyond.begin(), next.beyond.end(), name) != next.beyond.end();
    table.rows[0].push_back({.text = value, .note = beyond ? "beyond what was run" : ""});
  }
  table.header.insert(table.header.end(), {"runs", "decides between"});
  table.rows[0].push_back({.text = std::to_string(next.runs)});
  table.rows[0].push_back(
      {.text = named_effects(next.separates.front()) + " | " + named_effects(next.separates.back())});
  table.text_columns.assign(table.header.size(), false);
  table.text_columns.back() = true;
  return table;
}

MarkedTable error_table(const LoopAnswer& answer) {
  MarkedTable table{
      "Root mean square error on conditions that neither choice nor fit has seen; before: soil refitted, "
      "no effect added",
      {"channel", "values", "before", "after", "change", "noise alone"}};
  for (std::size_t c = 0; c < channel_views.size(); ++c) {
    const ErrorPair& e = answer.validation.channels[c];
    if (e.cells == 0) continue;
    table.rows.push_back({{.text = std::string(channel_views[c].title)},
                          {.text = std::to_string(e.cells)},
                          {.text = in_unit(c, e.before)},
                          {.text = in_unit(c, e.after), .tone = tone_of(e)},
                          {.text = change_of(e)},
                          {.text = in_unit(c, e.noise_floor)}});
  }
  const ErrorPair& all = answer.validation.overall;
  if (all.cells > 0)
    table.rows.push_back({{.text = "all, in standard deviations of the noise"},
                          {.text = std::to_string(all.cells)},
                          {.text = number(all.before)},
                          {.text = number(all.after), .tone = tone_of(all)},
                          {.text = change_of(all)},
                          {.text = "1"}});
  return table;
}

MarkedTable candidates_table(const LoopAnswer& answer) {
  const std::string premise = !answer.second           ? ""
                              : answer.second->decides ? ", beside a base model that may be off by itself"
                                                       : ", the base model taken as exact";
  MarkedTable table{
      "Candidates, each fitted in full" + premise + "; shares are of those that these data do not rule out",
      {"effects", "form", "share", "odds to the first", "chi2", "values"},
      {true, true}};
  const std::string values = std::to_string(answer.found().base.data().cells());
  const std::vector<const Weighted*> sets = sets_shown(answer);
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const Weighted& w = *sets[i];
    const CandidateModel& candidate = answer.found().candidates.models[w.best_candidate];
    table.rows.push_back(
        {{.text = named_effects(w.ids), .note = joined(w.ids) == named_effects(w.ids) ? "" : joined(w.ids)},
         {.text = fmt::format("{}", fmt::join(forms_in_order(candidate), " + "))},
         {.text = i < answer.ambiguity_set.size() ? share_words(w.weight) : "-"},
         i == 0 ? MarkedCell{.text = "-"} : odds_to_the_first(sets.front()->log_evidence - w.log_evidence),
         {.text = number(candidate.fit().chi2)},
         {.text = values}});
  }
  table.rows.push_back({{.text = "none: the base model"},
                        {.text = "-"},
                        {.text = "-"},
                        {.text = "-"},
                        {.text = number(answer.found().base.fit().chi2)},
                        {.text = values}});
  return table;
}

MarkedTable parameters_table(const LoopAnswer& answer) {
  MarkedTable table{answer.effects.empty() ? "The stand-in of the saved model: its fitted parameters"
                                           : "The effects of the saved model: their fitted parameters",
                    {"effect", "parameter", "value", "95 %", "the form allows", "determined?"},
                    {true, true, false, false, false, true}};
  for (const std::vector<AcceptedEffect>* effects : {&answer.effects, &answer.stand_in})
    for (const AcceptedEffect& effect : *effects) {
      const bekker_wong::EffectForm& form = bekker_wong::find_form(effect.choice);
      if (form.id == bekker_wong::learned_id) {  // its weights mean nothing one by one
        table.rows.push_back({{.text = std::string(bekker_wong::effect_title(form.id).name), .note = form.id},
                              {.text = form.equation, .note = "form " + form.form},
                              {.text = std::to_string(effect.fitted.size()) + " weights"},
                              {.text = "-"},
                              {.text = "-"},
                              {.text = "-"}});
        continue;
      }
      for (std::size_t i = 0; i < effect.fitted.size(); ++i) {
        const auto p = std::find_if(form.parameters.begin(), form.parameters.end(),
                                    [&](const auto& one) { return one.name == effect.fitted[i]; });
        const double scale = per_unit(p->unit);
        const std::string unit = p->unit == "-" ? "" : " " + p->unit;
        const auto& [low, high] = effect.ci95[i];
        table.rows.push_back({i == 0 ? MarkedCell{.text = std::string(bekker_wong::effect_title(form.id).name),
                                                  .note = form.id + ", form " + form.form}
                                     : MarkedCell{},
                              {.text = p->meaning, .note = p->name},
                              {.text = number(scale * effect.choice.parameters.at(p->name)) + unit},
                              {.text = fmt::format("{} to {}{}", number(scale * low), number(scale * high), unit)},
                              {.text = fmt::format("{:.4g} to {:.4g}{}", scale * p->lower, scale * p->upper, unit)},
                              effect.at_bound[i] ? MarkedCell{.text = "no: at its bound", .tone = Tone::bad}
                                                 : MarkedCell{.text = "yes"}});
      }
    }
  return table;
}

HtmlTable soil_table(const LoopAnswer& answer) {
  HtmlTable table{"The soil's values, and the bias that leaving the effects out puts into them",
                  {"value", "with", "without", "bias", "unit"},
                  {true, false, false, false, true}};
  for (const SoilShift& s : answer.soil_shifts) {
    const SoilParameter& p = soil_parameter(s.name);
    table.rows.push_back({p.title, number(s.with, p.per_si), number(s.without, p.per_si),
                          number(p.per_si * (s.without.value - s.with.value)), p.unit});
  }
  return table;
}

}  // namespace soilbin::compare
