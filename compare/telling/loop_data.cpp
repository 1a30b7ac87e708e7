// LoopAnswer in the contract's form.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "bekker_wong/effect.hpp"
#include "bekker_wong/learned.hpp"
#include "compare/measured/condition_views.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/report/number_text.hpp"
#include "compare/telling/loop_report.hpp"
#include "scenario/quantity.hpp"

namespace soilbin::compare {
namespace {

/// What these forms take for values that the wheel does not declare [SI].
Json presumes_json(const std::vector<const bekker_wong::EffectForm*>& forms, const Tire& wheel) {
  Json list = Json::array();
  for (const bekker_wong::EffectForm* form : forms)
    for (const bekker_wong::Presumed& p : bekker_wong::presumed(*form, wheel))
      list.push_back({{"effect", form->id}, {"key", p.key}, {"value", p.value}, {"words", p.words}});
  return list;
}

Json effects_json(const std::vector<AcceptedEffect>& effects, const Tire& wheel) {
  return list_of(effects, [&](const AcceptedEffect& effect) {
    Json parameters = Json::object(), ci = Json::object(), bound = Json::array();
    for (const auto& [name, value] : effect.choice.parameters) parameters[name] = finite(value);
    for (std::size_t i = 0; i < effect.fitted.size(); ++i) {
      ci[effect.fitted[i]] = {finite(effect.ci95[i].first), finite(effect.ci95[i].second)};
      if (effect.at_bound[i]) bound.push_back(effect.fitted[i]);
    }
    return Json{
        {"id", effect.choice.id},    {"form", effect.choice.form},
        {"parameters", parameters},  {"ci95", ci},
        {"at_bound", bound},         {"p_value", finite(effect.p_value)},
        {"cosines", effect.cosines}, {"presumes", presumes_json({&bekker_wong::find_form(effect.choice)}, wheel)}};
  });
}

/// What leaving the accepted effects out does to the soil's values [SI].
Json soil_json(const LoopAnswer& answer) {
  Json soil = Json::object();
  for (const SoilShift& s : answer.with_candidates().soil_shifts)
    soil[s.name] = {{"value", finite(s.with.value)},
                    {"sd", finite(s.with.std_error)},
                    {"without", finite(s.without.value)},
                    {"bias", finite(s.without.value - s.with.value)},
                    {"at_bound", s.held}};
  return soil;
}

Json error_json(const LoopAnswer& answer) {
  Json error = Json::object();
  for (int c = 0; c < channel_count; ++c) {
    const ChannelView& channel = channel_views[c];
    const std::string name(channel.name);
    const HeldOutErrors& e = answer.validation.channels[c];
    error[name] = Json::object();
    if (e.cells == 0) continue;
    error[name] = {{"unit", channel.si_unit},
                   {"before", finite(e.before)},
                   {"after", finite(e.after)},
                   {"noise_floor", finite(e.noise_floor)},
                   {"kind", "held_out"}};
    if (!answer.learned().empty()) error[name]["without_learned"] = finite(e.named);
  }
  const HeldOutErrors& all = answer.validation.overall;
  error["overall"] = Json::object();
  if (all.cells > 0)
    error["overall"] = {{"unit", "sigma"},
                        {"before", finite(all.before)},
                        {"after", finite(all.after)},
                        {"gain", finite(answer.validation.gain)},
                        {"gain_std_error", finite(answer.validation.gain_error)},
                        {"kind", "held_out"}};
  if (all.cells > 0 && !answer.learned().empty()) error["overall"]["without_learned"] = finite(all.named);
  return error;
}

/// A condition by the names and units of a campaign's columns, in the numbers that the text says: those of a rig.
Json condition_json(const LoopAnswer& answer) {
  Json at = Json::object();
  for (const std::string& name : answer.next()->quantities) {
    const ConditionView& view = condition_view(name);
    const double value = rig_setting_of(answer, answer.next()->at, name) * per_unit(std::string(view.column_unit));
    if (std::isfinite(value))
      at[view.column] = view.whole ? Json(std::lround(value)) : Json(read_number(fmt::format("{:.6g}", value)).value());
  }
  return at;
}

Json next_json(const LoopAnswer& answer) {
  if (!answer.next()) return nullptr;
  return {{"condition", condition_json(answer)},
          {"separates",
           list_of(answer.next()->separates,
                   [](const auto& ids) { return ids.empty() ? "base" : fmt::format("{}", fmt::join(ids, "+")); })},
          {"runs", answer.next()->runs},
          {"beyond", answer.next()->beyond}};
}

/// Sets of effects with their shares, and what their best forms presume of the wheel.
Json sets_json(const Attribution& found, const std::vector<WeightedSet>& sets, const Tire& wheel) {
  return list_of(sets, [&](const WeightedSet& w) {
    std::vector<const bekker_wong::EffectForm*> forms;
    for (const Term& term : found.candidates.models[w.best_candidate].terms()) forms.push_back(term.form);
    return Json{{"effects", w.ids}, {"weight", finite(w.weight)}, {"presumes", presumes_json(forms, wheel)}};
  });
}

/// What stands out where the base model may be off by itself, and whether that decides what else is told.
Json model_discrepancy_json(const LoopAnswer& answer) {
  const SecondAttribution* second = answer.second();
  if (!second) return nullptr;
  const Attribution& found = second->decides ? answer.found() : second->alternative;
  Json effects = Json::array();
  if (found.candidates.best) effects = found.best().ids;
  return {{"effects", effects},
          {"p_value", finite(found.signatures.p_value)},
          {"size", finite(second->size)},
          {"decides", second->decides}};
}

/// What the data can't tell apart: the sets of the reading that decides, with their shares, then those that only the
/// other one leaves, without.
Json ambiguity_json(const LoopAnswer& answer) {
  if (answer.ambiguity_set().empty()) return Json::array();
  Json all = sets_json(answer.found(), answer.ambiguity_set(), answer.wheel);
  if (const SecondAttribution* second = answer.second())
    for (Json& set : sets_json(second->alternative, second->sets, answer.wheel)) {
      set["of_other_reading"] = true;
      all.push_back(std::move(set));
    }
  return all;
}

/// A formula that does as well as the learned effect.
Json formula_json(const std::optional<LearnedFormula>& formula) {
  if (!formula) return nullptr;
  Json terms = Json::array();
  for (std::size_t k = 0; k < formula->terms.size(); ++k)
    terms.push_back({{"term", formula->terms[k].text},
                     {"weight", finite(formula->weights[k].value)},
                     {"sd", finite(formula->weights[k].std_error)}});
  return {{"joint", formula->joint},
          {"words", formula_text(*formula)},
          {"terms", terms},
          {"gain_over_learned", finite(formula->over_learned.mean)},
          {"gain_std_error", finite(formula->over_learned.std_error)}};
}

/// A learned effect: where it joins the model, of which conditions, the ranges where it holds [SI].
Json learned_json(const LoopAnswer& answer, std::size_t k) {
  const LearnedEffect& learned = answer.learned()[k];
  const std::vector<AcceptedEffect>& proxies = answer.proxy_effects();  // learned ones are the last
  const EffectChoice& choice = proxies[proxies.size() - answer.learned().size() + k].choice;
  const bekker_wong::EffectForm& form = bekker_wong::find_form(choice);
  Json valid = Json::object();
  for (const bekker_wong::LearnedVariable& variable : bekker_wong::learned_function(form).variables) {
    const std::string name(variable.name);
    valid[name] = {finite(choice.parameters.at(name + "_from")), finite(choice.parameters.at(name + "_to"))};
  }
  return {{"form", form.form},
          {"equation", form.equation},
          {"valid", valid},
          {"log_evidence", finite(learned.log_evidence)},
          {"gain", finite(learned.gain.mean)},
          {"gain_std_error", finite(learned.gain.std_error)}};
}

/// The first one, with its formula; null where nothing is learned.
Json first_learned_json(const LoopAnswer& answer) {
  if (answer.learned().empty()) return nullptr;
  Json first = learned_json(answer, 0);
  first["formula"] = formula_json(answer.unknown()->formula);
  return first;
}

/// Learned effects after the first, in the order in which they were learned.
Json more_learned_json(const LoopAnswer& answer) {
  Json more = Json::array();
  for (std::size_t k = 1; k < answer.learned().size(); ++k) more.push_back(learned_json(answer, k));
  return more;
}

/// What the residual depends on, and how many of these may be false.
Json depends_json(const LoopAnswer& answer) {
  return list_of(sure_dependences(answer), [](const Dependence& d) {
    return Json{{"channel", channel_views[d.channel].name},
                {"variable", d.variable},
                {"share", finite(d.share)},
                {"p_value", finite(d.p_value)},
                {"false_discovery_rate", finite(d.false_discovery_rate)}};
  });
}

Json worse_json(const LoopAnswer& answer) {
  return list_of(worse_channels(answer), [](int channel) { return channel_views[channel].name; });
}

Json set_aside_json(const LoopAnswer& answer) {
  return list_of(answer.set_aside, [](const SetAside& one) {
    return Json{{"line", one.csv_line},
                {"channel", channel_views[one.channel].name},
                {"measured", one.measured},
                {"predicted", finite(one.predicted)}};
  });
}

Json with_outliers_json(const LoopAnswer& answer) {
  if (!answer.with_outliers) return nullptr;
  return {{"verdict", word(answer.with_outliers->verdict)}, {"effects", answer.with_outliers->effects}};
}

}  // namespace

Json to_json(const LoopAnswer& answer) {
  return {{"format", "soilbin-loop/1"},
          {"campaign", answer.campaign},
          {"verdict", word(answer.verdict())},
          {"reason", reason_words(answer)},
          {"effects", effects_json(answer.effects(), answer.wheel)},
          {"ambiguity_set", ambiguity_json(answer)},
          {"not_testable", answer.not_testable},
          {"error", error_json(answer)},
          {"next_test", next_json(answer)},
          {"soil", soil_json(answer)},
          {"outliers", answer.outliers()},
          {"set_aside", set_aside_json(answer)},
          {"with_outliers", with_outliers_json(answer)},
          {"stand_in", effects_json(answer.proxy_effects(), answer.wheel)},
          {"worse", worse_json(answer)},
          {"learned", first_learned_json(answer)},
          {"learned_more", more_learned_json(answer)},
          {"depends_on", depends_json(answer)},
          {"beside_inadequacy", model_discrepancy_json(answer)}};
}

Json details_json(const LoopAnswer& answer) {
  if (!answer.judgement())
    return {{"p_value", 1.0}, {"values", 0},         {"chi2_base", 0.0},         {"parameters_base", 0},
            {"sets", {}},     {"unnamed_gain", 0.0}, {"error_smooth_term", 0.0}, {"folds", {}}};
  const Attribution& found = answer.found();
  const Candidates& all = found.candidates;
  const ResidualTests &before = answer.judgement()->before, after = answer.choice().after;
  Json sets = Json::array();
  for (const WeightedSet& w : all.sets) {
    const CandidateModel& candidate = all.models[w.best_candidate];
    const std::vector<std::string> in_order = forms_in_order(candidate);
    Json forms = Json::array();
    auto form = in_order.begin();
    for (const std::string& effect : candidate.ids) forms.push_back(effect + "/" + *form++);
    const auto listed =
        std::ranges::find_if(answer.ambiguity_set(), [&](const WeightedSet& one) { return one.ids == w.ids; });
    sets.push_back({{"effects", w.ids},
                    {"forms", forms},
                    {"weight", finite(listed == answer.ambiguity_set().end() ? 0.0 : listed->weight)},
                    {"log_evidence", finite(candidate.log_evidence)},
                    {"set_log_evidence", finite(w.log_evidence)},
                    {"share", finite(w.weight)},
                    {"chi2", finite(candidate.fit().chi2)},
                    {"parameters", candidate.fit().theta.size()}});
  }
  return {{"p_value", finite(found.signatures.p_value)},
          {"values", found.base.data().cells()},
          {"chi2_base", finite(found.base.fit().chi2)},
          {"parameters_base", found.base.fit().theta.size()},
          {"log_evidence_base", finite(all.base_log_evidence)},
          {"unnamed_gain", finite(found.unnamed.gain)},
          {"residual_unnamed_gain", finite(answer.choice().unnamed.gain)},
          {"reruns",
           {{finite(before.reruns.p_value), finite(before.reruns.excess)},
            {finite(after.reruns.p_value), finite(after.reruns.excess)}}},
          {"serial_p", {finite(before.serial.p_value), finite(after.serial.p_value)}},
          {"lack_of_fit_p", {finite(before.lack_of_fit.p_value), finite(after.lack_of_fit.p_value)}},
          {"choice_gain", {finite(answer.choice().gain.mean), finite(answer.choice().gain.std_error)}},
          {"error_smooth_term", finite(answer.validation.overall.smooth)},
          {"sets", sets},
          {"folds", answer.validation.chosen}};
}

// The loop's answer as a case that other commands take.

namespace {

/// The conditions of a campaign's runs, each once. When and where a run was made, and how fast, counts where an effect
/// hears of it; else all have the median speed.
std::vector<OperatingCondition> asked_of(const Campaign& campaign, const std::vector<EffectChoice>& effects) {
  const auto heard = [&](const char* key) {
    return std::ranges::any_of(
        effects, [&](const EffectChoice& effect) { return depends_on(bekker_wong::find_form(effect), key); });
  };
  std::vector<double> speeds;
  for (const Run& run : campaign.runs) speeds.push_back(run.at.speed);
  std::sort(speeds.begin(), speeds.end());
  std::vector<OperatingCondition> conditions;
  std::set<OperatingCondition> seen;
  for (const Run& run : campaign.runs) {
    OperatingCondition at = run.at;
    if (!heard("run")) at.run.reset();
    if (!heard("position")) at.position.reset();
    if (!heard("inflation_pressure")) at.inflation_pressure.reset();
    if (!heard("speed")) at.speed = speeds[speeds.size() / 2];
    if (seen.insert(at).second) conditions.push_back(at);
  }
  return conditions;
}

/// What the model missed of conditions left out, where that is more than noise of so many values explains.
Misfit misfit_of(const CrossValidation& held_out) {
  constexpr double standard_errors = 2.0;
  Misfit misfit{};
  for (std::size_t c = 0; c < misfit.size(); ++c) {
    const HeldOutErrors& e = held_out.channels[c];
    if (e.cells == 0) continue;
    const double noise = e.noise_floor * e.noise_floor, excess = e.after * e.after - noise;
    if (excess > standard_errors * std::sqrt(2.0 / e.cells) * noise) misfit[c] = std::sqrt(excess);
  }
  return misfit;
}

}  // namespace

std::string source_of_fit(const std::string& campaign) { return "fitted to campaign " + campaign; }

Case resolved_model(const Campaign& campaign, const LoopAnswer& answer) {
  Case model;
  model.name = campaign.name + "-model";
  model.source = source_of_fit(campaign.name);
  model.scenario = scenario_of(campaign);
  model.scenario.effects.clear();
  if (answer.judgement()) model.scenario.tire = answer.model().wheel();
  model.scenario.tire.name = campaign.name + "-wheel";
  model.scenario.soil.name = campaign.name + "-soil";
  model.scenario.soil.semi_empirical = answer.soil;
  std::erase_if(model.scenario.soil.semi_empirical->sources,  // a value that was fitted is no usual one any more
                [&](const auto& from) { return answer.judgement() && from.second == usual_stress_angle_source; });
  model.study.name = model.name;
  ModelChoice choice;
  choice.effects = campaign.effects;
  for (const AcceptedEffect& effect : answer.effects_in_model()) choice.effects.push_back(effect.choice);
  model.description = "Made by soilbin loop: " + verdict_sentence(answer);
  if (const std::string proxies = proxy_sentence(answer); !proxies.empty()) model.description += " " + proxies;
  for (const std::string& sentence : bekker_wong::presumptions(choice.effects, answer.wheel))
    model.description += " " + sentence;
  choice.label = "fitted";
  if (answer.judgement()) choice.errors = answer.model().errors(), choice.misfit = misfit_of(answer.validation);
  model.study.models = {choice};
  model.study.conditions = asked_of(campaign, choice.effects);
  return model;
}

}  // namespace soilbin::compare
