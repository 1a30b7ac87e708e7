#include "compare/doubts/doubts.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "bekker_wong/closed_forms.hpp"
#include "bekker_wong/learned.hpp"
#include "bekker_wong/model.hpp"
#include "compare/doubts/answer_doubts.hpp"
#include "compare/doubts/grain_doubts.hpp"
#include "compare/sweep/varying.hpp"
#include "scenario/nearest_word.hpp"

namespace soilbin::compare {
namespace {

/// Grahn's power of the penetration speed under a tire that is flat, where nothing penetrates.
Doubts no_pressure_at_rest(const Case& question) {
  const auto jumps = [](const std::vector<EffectChoice>& effects) {
    return bekker_wong::is_flexible(effects) && std::ranges::any_of(effects, [](const EffectChoice& effect) {
             const bekker_wong::EffectForm& form = bekker_wong::find_form(effect);
             return form.id == "rate_dependence" && form.form == "grahn";
           });
  };
  const bool asked = std::ranges::any_of(question.study.models, jumps, [&](const ModelChoice& model) {
    return seen_by(model, question.scenario).effects;
  });
  if (!asked && !(question.drive && jumps(question.drive->effects))) return {};
  return {Doubt{DoubtKind::no_pressure_at_rest}};
}

/// A soil none of whose values has a standard deviation: then ± is that of c1 and c2 alone.
Doubts without_deviations(const Case& question) {
  const std::optional<SemiEmpiricalSoil>& soil = question.scenario.soil.semi_empirical;
  if (!soil || soil->assumed_sd || question.on_command_line.contains("no_assumed_sd")) return {};
  for (const Estimate& value :
       {soil->exponent, soil->k_c, soil->k_phi, soil->cohesion, soil->friction_angle, soil->shear_modulus})
    if (value.std_error > 0.0) return {};
  return {Doubt{DoubtKind::without_deviations}};
}

/// A drive asks the analytic wheel, with effects of its own.
Case as_study(Case question) {
  question.study.models = {{ModelKind::bekker_wong, question.drive->effects, ""}};
  OperatingCondition& at = question.study.conditions.emplace_back();
  at.load = question.drive->load, at.pass = question.drive->pass;
  return question;
}

/// The analytic models' answers without errors and stresses, which no doubt asks for.
std::vector<ModelAnswers> quick_answers(const Case& question) {
  Case analytic = question;
  std::erase_if(analytic.study.models, [](const ModelChoice& c) { return c.model != ModelKind::bekker_wong; });
  if (!question.scenario.soil.semi_empirical) return {};
  return run_study(analytic, {}, [](ModelKind) {
    return std::make_unique<const bekker_wong::BekkerWong>(bekker_wong::Detail{.errors = false, .patch = false});
  });
}

/// Whether an answer of the analytic models, at the first condition or the last, hangs on the soil's density.
bool weighs_soil(const Case& question) {
  Case asked = question;
  std::vector<OperatingCondition>& at = asked.study.conditions;
  if (at.size() > 2) at = {at.front(), at.back()};
  const std::vector<ModelAnswers> as_it_is = quick_answers(asked);
  asked.scenario.soil.semi_empirical->density = 1.01 * bulk_density(*question.scenario.soil.semi_empirical);
  const std::vector<ModelAnswers> heavier = quick_answers(asked);
  for (std::size_t m = 0; m < heavier.size(); ++m)
    for (std::size_t i = 0; i < heavier[m].answers.size(); ++i) {
      const auto &one = as_it_is[m].answers[i].result, &other = heavier[m].answers[i].result;
      if (one.has_value() != other.has_value()) return true;
      for (const TractionChannel& channel : traction_channels)
        if (one && (one.value().*channel.predicted).value != (other.value().*channel.predicted).value) return true;
    }
  return false;
}

/// Conditions beyond those that a learned effect was learned from.
Doubts doubts_of_learned(const Case& question) {
  Doubts all;
  for (const ModelChoice& model : question.study.models)
    for (const EffectChoice& effect : model.effects)
      for (const OperatingCondition& at : question.study.conditions)
        for (const std::string& name : bekker_wong::outside_learned(effect, at))
          all.push_back({DoubtKind::beyond_learned, {effect.form, name}, at});
  return once_each(all);
}

/// The tire at the condition that tells the least of its pressure.
Tire least_told(const Case& question) {
  const std::vector<OperatingCondition>& all = question.study.conditions;
  const auto silent = std::ranges::find_if(all, [](const auto& at) { return !at.inflation_pressure; });
  if (silent != all.end() || all.empty()) return question.scenario.tire;
  return tire_at(question.scenario.tire, all.front());
}

/// What is declared and has no influence, and what has influence and is not declared.
Doubts doubts_of_declarations(const Case& question) {
  Doubts all = unused_inputs(question);
  append(all, doubts_of_learned(question));
  std::vector<EffectChoice> effects;
  for (const ModelChoice& model : question.study.models)
    effects.insert(effects.end(), model.effects.begin(), model.effects.end());
  for (const std::string& presumed : bekker_wong::presumptions(effects, least_told(question)))
    all.push_back({DoubtKind::presumed, {presumed}});
  const std::optional<SemiEmpiricalSoil>& soil = question.scenario.soil.semi_empirical;
  const bool asks_wheel = asks(question.study, ModelKind::bekker_wong);
  const auto is_typed = [&](const char* value) { return soil && is_from_command_line(*soil, value); };
  if ((is_typed("gravity") || is_typed("density")) && asks_wheel && !question.drive && !weighs_soil(question))
    for (const char* value : {"gravity", "density"})
      if (is_typed(value) && !(value == std::string_view("density") && !question.scenario.soil.beds.empty()))
        all.push_back({DoubtKind::soil_weight_ignored, {value}});
  if (soil && !soil->density && !effects.empty() && weighs_soil(question))
    all.push_back({DoubtKind::density_assumed, {presumed_bulk_density}});
  return all;
}

/// Conditions that no motion has; a drive begins at rest.
Doubts doubts_of_speeds(const Case& question) {
  Doubts all;
  if (question.drive) return all;
  for (const OperatingCondition& at : question.study.conditions)
    if (at.speed == 0.0 && std::abs(at.slip) < 1.0) all.push_back({DoubtKind::standing_wheel, {}, at});
  return once_each(all);
}

/// Whether answers stand beside the doubts: then what has none is told there, and grains that weren't asked are left
/// aside.
enum class Answered { no, yes };

/// doubts(question, study) without what changes nothing.
Doubts doubts_but_unused_inputs(const Case& question, const std::vector<ModelAnswers>& study, Answered answered) {
  const Scenario& scenario = question.scenario;
  const bool open = answered == Answered::no;
  Doubts all;
  if (open || asks(question.study, ModelKind::bekker_wong) || !scenario.soil.semi_empirical)
    append(all, doubts(scenario.soil));
  append(all, doubts(scenario.tire, scenario.soil));
  if (asks(question.study, ModelKind::rft)) append(all, resistive_force_doubts(scenario.soil));
  if (asks(question.study, ModelKind::cone_index)) {
    append(all, cone_index_doubts(scenario, question.study.conditions));
    if (asks(question.study, ModelKind::bekker_wong)) all.push_back({DoubtKind::cone_index_beside_bekker});
  }
  append(all, doubts_of_speeds(question));
  if (asks(question.study, ModelKind::bekker_wong)) append(all, without_deviations(question));
  append(all, no_pressure_at_rest(question));
  append(all, doubts_of_answers(scenario, study, open));
  if (open || asks(question.study, ModelKind::dem))
    append(all, grain_doubts(scenario, question.study.conditions, study));
  return all;
}

/// A campaign's runs as questions to a model.
Case question_of(const Campaign& campaign, const Scenario& asked) {
  Case question = soilbin::question_of(asked);
  for (const Run& run : campaign.runs) question.study.conditions.push_back(run.at);
  return question;
}

/// Each row has a run, a place and a speed: so a campaign is told, whether or not its model asks for them.
bool only_tells_the_row(const Doubt& one) {
  return one.kind == DoubtKind::speed_ignored ||
         (one.kind == DoubtKind::condition_ignored && (one.says[0] == Said("run") || one.says[0] == Said("position")));
}

/// The campaign's model at other conditions.
AskAgain asked_again(const Case& question) {
  return [question](const std::vector<OperatingCondition>& conditions) {
    Case again = question;
    again.study.conditions = conditions;
    return quick_answers(again).front().answers;
  };
}

enum class NextIs { nothing, a_fit_for_effects };

Doubts doubts_of(const Campaign& campaign, const Case& question, const std::vector<ModelAnswers>& study,
                 Answered answered, NextIs next) {
  Doubts all = doubts_but_unused_inputs(question, study, answered);
  if (next == NextIs::nothing) {
    Doubts unused = unused_inputs(question, EffectsAre::of_a_campaign);
    std::erase_if(unused, only_tells_the_row);
    append(all, std::move(unused));
  }
  Doubts of_data = row_doubts(campaign);
  append(of_data, column_doubts(campaign, study.front().answers, asked_again(question)));
  append(all, once_each(of_data));
  return all;
}

/// A carcass pressure that a declared effect reads and no fit may move: nobody measures one.
void add_doubt_of_exact_carcass(const Campaign& campaign, Doubts& all) {
  const auto reads = std::ranges::find_if(campaign.effects, [](const EffectChoice& effect) {
    return depends_on(bekker_wong::find_form(effect), carcass_pressure_key);
  });
  if (reads == campaign.effects.end() || bekker_wong::errs_by_carcass(campaign.wheel, campaign.effects)) return;
  const double value = campaign.wheel.carcass_pressure.value_or(Estimate{}).value;
  all.push_back({DoubtKind::exact_carcass, {reads->id, value / 1000}});
}

Doubts doubts_as_declared(const Campaign& campaign, NextIs next) {
  const Case question = question_of(campaign, scenario_of(campaign));
  Doubts all = doubts_of(campaign, question, quick_answers(question), Answered::no, next);
  add_doubt_of_exact_carcass(campaign, all);
  if (!campaign.runs.empty() && std::ranges::none_of(campaign.runs, [](const Run& run) { return bool(run.sinkage); }))
    all.push_back({DoubtKind::no_sinkage});
  return all;
}

}  // namespace

std::string remark_on(const Scenario& scenario, const ModelChoice& model, const Answer& answer) {
  Doubts all = doubts_of_answers(scenario, {{model, {answer}}}, false);
  if (answer.result && !answer.result->without_error_of.empty())
    all.push_back({DoubtKind::errors_left_out, {listed(answer.result->without_error_of)}});
  return as_remark(all);
}

Remark remarks_about(const Scenario& scenario) {
  return [&scenario](const ModelChoice& model, const Answer& answer) { return remark_on(scenario, model, answer); };
}

std::vector<std::string> remarks_on(const Campaign& campaign, const Scenario& asked, const Prediction& prediction) {
  std::vector<std::string> remarks;
  std::map<int, std::size_t> of_line;
  const ModelChoice model{prediction.model, asked.effects, ""};
  for (const PredictedRun& run : prediction.runs) {
    of_line[campaign.runs[remarks.size()].csv_line] = remarks.size();
    remarks.push_back(remark_on(asked, model, run.predicted));
  }
  for (const Doubt& one : row_doubts(campaign))
    if (one.line) {
      std::string& remark = remarks[of_line.at(*one.line)];
      remark += (remark.empty() ? "" : "; ") + as_remark({one});
    }
  return remarks;
}

Doubts doubts(const Case& question, const std::vector<ModelAnswers>& study, const Doubts& of_models) {
  Doubts all = doubts_but_unused_inputs(question, study, Answered::yes);
  append(all, of_models);
  append(all, doubts_of_declarations(question));
  return all;
}

std::string tire_in_words(const Case& question) {
  const bool ignored = tell_of(unused_inputs(question), DoubtKind::lugs_ignored);
  return in_words(question.scenario.tire, !ignored                               ? ""
                                          : asks(question.study, ModelKind::dem) ? "; the analytic wheel ignores them"
                                          : question.study.models.size() == 1    ? "; this model ignores the lugs"
                                                                                 : "; these models ignore the lugs");
}

Doubts doubts(const Case& question) {
  Doubts all = doubts_but_unused_inputs(question, quick_answers(question), Answered::no);
  append(all,
         doubts_of_declarations(question.drive && question.study.conditions.empty() ? as_study(question) : question));
  return all;
}

Doubts doubts(const Campaign& campaign) { return doubts_as_declared(campaign, NextIs::nothing); }

Doubts doubts_before_fit(const Campaign& campaign) { return doubts_as_declared(campaign, NextIs::a_fit_for_effects); }

Doubts of_mistaken_columns(Doubts doubts) {
  std::erase_if(doubts, [](const Doubt& one) {
    const bool of_samples = one.kind == DoubtKind::rows_are_samples || one.kind == DoubtKind::several_wheels;
    return !of_samples && (one.kind < DoubtKind::flipped_sign || one.kind > DoubtKind::load_swapped);
  });
  return doubts;
}

Doubts doubts(const Campaign& campaign, const Scenario& asked, const Prediction& prediction) {
  const Case question = question_of(campaign, asked);
  ModelAnswers answers{question.study.models.front(), {}};
  for (const PredictedRun& run : prediction.runs) answers.answers.push_back(run.predicted);
  return doubts_of(campaign, question, {answers}, Answered::yes, NextIs::nothing);
}

}  // namespace soilbin::compare
