// The tables of the loop's answer, for its page and for a terminal.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bekker_wong/effects/titles.hpp"
#include "bekker_wong/learned.hpp"
#include "compare/measured/condition_views.hpp"
#include "compare/report/number_text.hpp"
#include "compare/telling/loop_report.hpp"
#include "scenario/soil_parameters.hpp"

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
      "Odds to the first: how likely these data are with this set, beside the first one. chi2: the sum of the "
      "squared residuals, each in standard deviations of the noise; about the number of values where nothing is "
      "missing.";
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
  MarkedTable table{"Soil values with and without the effects; bias: without less with",
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

}  // namespace soilbin::compare
