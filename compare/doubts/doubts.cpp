#include "compare/doubts/doubts.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include "bekker_wong/closed_forms.hpp"
#include "bekker_wong/learned.hpp"
#include "bekker_wong/model.hpp"
#include "bekker_wong/rolling_wheel.hpp"
#include "compare/doubts/column_doubts.hpp"
#include "compare/doubts/declared_doubts.hpp"
#include "compare/doubts/grain_doubts.hpp"
#include "compare/doubts/row_doubts.hpp"
#include "compare/doubts/unused_inputs.hpp"
#include "compare/report/number_text.hpp"
#include "compare/sweep/declared_tire.hpp"
#include "compare/sweep/varying.hpp"
#include "scenario/nearest_word.hpp"

namespace soilbin::compare {
namespace {

using Warnings = std::vector<std::string>;

/// Doubts that differ in numbers alone, up to the condition or the line that they name, as one, with the number of the
/// others: "(and at 3 other conditions)".
Warnings once_each(const Warnings& warnings) {
  Warnings shown;
  std::vector<std::pair<std::string, std::size_t>> kinds;
  for (const std::string& warning : warnings) {
    std::string kind = warning.substr(0, warning.find(" at load"));
    std::erase_if(kind, [](unsigned char c) { return std::isdigit(c) || c == '.' || c == '-'; });
    const auto known = std::find_if(kinds.begin(), kinds.end(), [&](const auto& k) { return k.first == kind; });
    if (known != kinds.end()) {
      ++known->second;
      continue;
    }
    kinds.emplace_back(kind, 0);
    shown.push_back(warning);
  }
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const std::size_t others = kinds[i].second;
    if (others == 0) continue;
    const std::string what = shown[i].starts_with("line ") ? "line" : "condition";
    shown[i] += fmt::format(" (and at {} other {}{})", others, what, others > 1 ? "s" : "");
  }
  return shown;
}

/// Of the radius. The base model has no balance beyond 0.9; its stresses are tested up to about this.
constexpr double unreliable_sinkage_share = 0.5;

void append(Warnings& all, Warnings more) {
  all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

/// A wheel so deep that the stresses under it are a stretch, or none at all; "" where it isn't.
std::string too_deep(const Scenario& scenario, const Answer& answer) {
  const double share = answer.result->sinkage.value / scenario.tire.radius;
  if (share > bekker_wong::max_sinkage_share)
    return fmt::format("the wheel settles to {:.0f} % of its radius at {}: the stresses are unreliable above {:.0f} %",
                       100 * share, in_words(answer.at), 100 * bekker_wong::max_sinkage_share);
  if (!(share > unreliable_sinkage_share)) return "";
  return fmt::format("the wheel sinks {:.0f} % of its radius at {}: unreliable above {:.0f} %", 100 * share,
                     in_words(answer.at), 100 * unreliable_sinkage_share);
}

/// A steady wheel gives out no more than is put in; what instruments show may.
void add_power_doubt(const Answer& answer, Warnings& warnings) {
  if (answer.result->tractive_efficiency > 1.0)
    warnings.push_back(
        fmt::format("drawbar power exceeds the power put in at {}: an instrument error, or an effect that adds one; "
                    "no efficiency is given",
                    in_words(answer.at)));
}

/// A cross slope down which the load slides; "" where the soil can hold it beside the thrust. Along the way a pull
/// below 0 says the same.
std::string too_steep_across(const Scenario& scenario, const Answer& answer, double contact_length) {
  const OperatingCondition& at = answer.at;
  const bekker_wong::SoilValues soil = bekker_wong::values_of(*scenario.soil.semi_empirical);
  const double uphill = std::cos(at.longitudinal_incline),
               share = std::abs(at.load * uphill * std::sin(at.transverse_incline)),
               pressing = at.load * uphill * std::cos(at.transverse_incline),
               held = pressing * std::tan(soil.friction_angle) + soil.cohesion * scenario.tire.width * contact_length;
  const auto budget = std::ranges::find(answer.result->budget, "shear_thrust", &Contribution::name);
  const double thrust = budget == answer.result->budget.end() ? 0.0 : std::abs(budget->force);
  constexpr double hardly = 0.05;  // of what the soil holds: no slope to speak of
  if (!(share > hardly * held && std::hypot(share, thrust) > held)) return "";
  const std::string beside = share > held ? "" : fmt::format(", with a thrust of {}", newtons(thrust, 3));
  return fmt::format(
      "the wheel slides down the cross slope at {}: {} of the load act down it{}, and the soil shears at {} (c, phi)",
      in_words(at), newtons(share, 3), beside, newtons(held, 3));
}

/// A tire that flattens until its rim is near the ground.
std::string too_flat(const Scenario& scenario, const Answer& answer) {
  constexpr double most = 0.2;  // of the radius, chosen: half of a high section height
  const double radius = scenario.tire.radius;
  const double flattened = radius * (1 - std::cos(answer.result->entry_angle)) - answer.result->sinkage.value;
  if (!bekker_wong::is_flexible(scenario.effects) || !(flattened > most * radius))
    return "";  // nor of a drive, which has no angles
  return fmt::format(
      "the tire deflects by {:.3g} mm at {}, {:.0f} % of its radius: tires bear about 10 %, and {:.0f} % at the most. "
      "Raise the inflation pressure or lower the load",
      1000 * flattened, in_words(answer.at), 100 * flattened / radius, 100 * most);
}

/// A tire that is asked as a rigid wheel and would flatten: what the default form of tire_flexibility makes of it.
std::string taken_as_rigid(const Scenario& scenario, const Answer& answer) {
  constexpr double hardly = 0.01;  // of the load
  const Tire tire = tire_at(scenario.tire, answer.at);
  if (!tire.inflation_pressure || bekker_wong::is_flexible(scenario.effects)) return "";
  Scenario flexible = scenario;
  flexible.effects.push_back({"tire_flexibility", "", {}});
  const bekker_wong::BekkerWong model({.errors = false, .patch = false});
  const Answer asked = std::isfinite(answer.result->entry_angle) ? answer : ask(model, scenario, answer.at);
  if (!asked.result) return "";  // of a drive, where it is at no steady state
  const double rigid = asked.result->drawbar_pull.value;
  const std::string pressure =
      fmt::format("the tire flattens at {} ({})", in_words(answer.at), ground_pressure_in_words(tire));
  const Answer flattened = ask(model, flexible, answer.at);
  if (!flattened.result) return pressure + ", and carries no more there: " + flattened.error;
  const double pull = flattened.result->drawbar_pull.value;
  if (std::abs(pull - rigid) < hardly * answer.at.load) return "";
  return fmt::format("{}: as a rigid wheel it pulls {}, with --effect tire_flexibility {}", pressure, newtons(rigid),
                     newtons(pull));
}

/// A wheel that pulls more than 15 % of its load at a slip of up to 1 %, level or on a slope; "" where it doesn't. Even
/// without slip the model shears the soil by up to r (theta_1 - sin theta_1) under the wheel, and a large or deep one
/// by many times K. Wheels that pull slip.
std::string pull_without_slip(const Scenario& scenario, const Answer& answer) {
  constexpr double no_slip = 0.01, much = 0.15;  // chosen; the share is of the load
  const OperatingCondition& at = answer.at;
  const double beside_slope = answer.result->drawbar_pull.value + at.load * std::sin(at.longitudinal_incline);
  const double share = beside_slope / at.load, entry = answer.result->entry_angle;
  if (std::abs(at.slip) > no_slip || !(share > much) || !(entry > 0.0)) return "";
  return fmt::format(
      "the wheel pulls {:.2g} of its load at {}: even there the model shears the soil by up to {:.3g} mm under a "
      "radius "
      "of {:.4g} mm, and K is {:.3g} mm. A wheel that pulls slips: take pulls at less than 5 % slip as upper bounds",
      share, in_words(at), 1000 * scenario.tire.radius * (entry - std::sin(entry)), 1000 * scenario.tire.radius,
      1000 * scenario.soil.semi_empirical->shear_modulus.value);
}

/// What the analytic wheel answers at one condition.
void add_answer_doubts(const Scenario& scenario, const Answer& answer, Warnings& warnings) {
  const std::string at = " at " + in_words(answer.at);
  const Tire& tire = scenario.tire;
  const TractionResult& r = *answer.result;
  const double length = tire.radius * (r.entry_angle - r.exit_angle);
  const double pressure = answer.at.load / (tire.width * tire.radius * std::sin(r.entry_angle));
  if (pressure < 500.0 || pressure > 2e6)
    warnings.push_back(
        fmt::format("mean ground pressure {:.3g} kPa{}: usual are 0.5 .. 2000 kPa", pressure / 1000, at));
  const double arc = bekker_wong::contact_length(r.sinkage.value, tire.radius);
  if (std::string slides = too_steep_across(scenario, answer, std::fmax(length, arc)); !slides.empty())
    warnings.push_back(std::move(slides));
  if (std::string deep = too_deep(scenario, answer); !deep.empty()) warnings.push_back(std::move(deep));
  if (scenario.bin && r.sinkage.value > 0.5 * scenario.bin->depth)
    warnings.push_back(fmt::format(
        "the wheel sinks {:.0f} % of the bin's depth{}: its floor acts on the wheel; add --effect hard_layer",
        100 * r.sinkage.value / scenario.bin->depth, at));
  const double modulus = scenario.soil.semi_empirical->shear_modulus.value;
  if (modulus > length)
    warnings.push_back(fmt::format("K ({:.3g} mm) is longer than the contact ({:.3g} mm){}: shear hardly develops",
                                   1000 * modulus, 1000 * length, at));
  for (std::string words :
       {too_flat(scenario, answer), taken_as_rigid(scenario, answer), pull_without_slip(scenario, answer)})
    if (!words.empty()) warnings.push_back(std::move(words));
}

/// Of each answer, those alike once.
Warnings doubts_of_answers(const Scenario& scenario, const std::vector<ModelAnswers>& study, bool unsolved) {
  Warnings warnings;
  for (const ModelAnswers& model : study) {
    const Scenario asked = seen_by(model.choice, scenario);
    for (const Answer& answer : model.answers) {
      if (!answer.result) {
        if (unsolved) warnings.push_back("no solution at " + in_words(answer.at) + ": " + answer.error);
        continue;
      }
      add_power_doubt(answer, warnings);
      if (model.choice.model == ModelKind::bekker_wong && asked.soil.semi_empirical)
        add_answer_doubts(asked, answer, warnings);
    }
  }
  return once_each(warnings);
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
Warnings doubts_of_learned(const Case& question) {
  Warnings words;
  for (const ModelChoice& model : question.study.models)
    for (const EffectChoice& effect : model.effects)
      for (const OperatingCondition& at : question.study.conditions)
        for (const std::string& name : bekker_wong::outside_learned(effect, at))
          words.push_back(
              fmt::format("the learned effect ({}) knows no such {}: its value at the edge of what it was "
                          "learned from is taken at {}",
                          effect.form, name, in_words(at)));
  return once_each(words);
}

/// The tire at the condition that tells the least of its pressure.
Tire least_told(const Case& question) {
  const std::vector<OperatingCondition>& all = question.study.conditions;
  const auto silent = std::ranges::find_if(all, [](const auto& at) { return !at.inflation_pressure; });
  if (silent != all.end() || all.empty()) return question.scenario.tire;
  return tire_at(question.scenario.tire, all.front());
}

/// What is declared and has no influence, and what has influence and is not declared.
Warnings doubts_of_declarations(const Case& question) {
  Warnings words;
  for (UnusedInput& one : unused_inputs(question)) words.push_back(std::move(one.words));
  append(words, doubts_of_learned(question));
  std::vector<EffectChoice> effects;
  for (const ModelChoice& model : question.study.models)
    effects.insert(effects.end(), model.effects.begin(), model.effects.end());
  append(words, bekker_wong::presumptions(effects, least_told(question)));
  const std::optional<SemiEmpiricalSoil>& soil = question.scenario.soil.semi_empirical;
  const bool asks_wheel = asks(question.study, ModelKind::bekker_wong);
  const auto is_typed = [&](const char* value) { return soil && is_from_command_line(*soil, value); };
  if ((is_typed("gravity") || is_typed("density")) && asks_wheel && !question.drive && !weighs_soil(question))
    for (const char* value : {"gravity", "density"})
      if (is_typed(value))
        words.push_back(fmt::format(
            "the soil's {} is ignored: loads are forces, and only effects such as bulldozing weigh soil", value));
  if (soil && !soil->density && !effects.empty() && weighs_soil(question))
    words.push_back(fmt::format("the soil declares no density: {:g} kg/m^3 is assumed, and the answers depend on it",
                                presumed_bulk_density));
  return words;
}

/// Conditions that no motion has; a drive begins at rest.
Warnings doubts_of_speeds(const Case& question) {
  Warnings words;
  if (question.drive) return words;
  for (const OperatingCondition& at : question.study.conditions)
    if (at.speed == 0.0 && std::abs(at.slip) < 1.0)
      words.push_back(
          "at a speed of 0 a wheel stands still or slips by 100 %; the answer is that of a very slow wheel at " +
          in_words(at));
  return once_each(words);
}

/// Whether answers stand beside the doubts: then what has none is told there, and grains that weren't asked are left
/// aside.
enum class Answered { no, yes };

/// doubts(question, study) without what changes nothing.
Warnings doubts_but_unused_inputs(const Case& question, const std::vector<ModelAnswers>& study, Answered answered) {
  const Scenario& scenario = question.scenario;
  const bool open = answered == Answered::no;
  Warnings warnings;
  if (open || asks(question.study, ModelKind::bekker_wong) || !scenario.soil.semi_empirical)
    append(warnings, doubts(scenario.soil));
  append(warnings, doubts(scenario.tire, scenario.soil));
  append(warnings, doubts_of_speeds(question));
  append(warnings, doubts_of_answers(scenario, study, open));
  if (open || asks(question.study, ModelKind::dem))
    append(warnings, grain_doubts(scenario, question.study.conditions, study));
  for (const ModelAnswers& model : study) append(warnings, model.doubts);
  return warnings;
}

/// A campaign's runs as questions to a model.
Case question_of(const Campaign& campaign, const Scenario& asked) {
  Case question;
  question.scenario = asked;
  question.study.models = {{ModelKind::bekker_wong, asked.effects, ""}};
  question.scenario.effects.clear();
  for (const Run& run : campaign.runs) question.study.conditions.push_back(run.at);
  return question;
}

/// Each row has a run and a place: so a campaign is told, whether or not its model asks for them.
bool only_tells_the_row(const UnusedInput& one) { return one.key == "run" || one.key == "position"; }

/// The campaign's model at other conditions.
AskAgain asked_again(const Case& question) {
  return [question](const std::vector<OperatingCondition>& conditions) {
    Case again = question;
    again.study.conditions = conditions;
    return quick_answers(again).front().answers;
  };
}

enum class NextIs { nothing, a_fit_for_effects };

DoubtsBeforeFit doubts_of(const Campaign& campaign, const Case& question, const std::vector<ModelAnswers>& study,
                          Answered answered, NextIs next) {
  Warnings warnings = doubts_but_unused_inputs(question, study, answered);
  if (next == NextIs::nothing)
    for (UnusedInput& one : unused_inputs(question))
      if (!only_tells_the_row(one)) warnings.push_back(std::move(one.words));
  Warnings of_data, mistaken;
  for (const RowDoubt& one : row_doubts(campaign)) {
    of_data.push_back(one.line ? fmt::format("line {}: {}", *one.line, one.words) : one.words);
    if (one.no_runs) mistaken.push_back(one.words);
  }
  const Warnings columns = column_doubts(campaign, study.front().answers, asked_again(question));
  append(of_data, columns);
  append(mistaken, columns);
  append(warnings, once_each(of_data));
  return {warnings, mistaken};
}

/// A carcass pressure that a declared effect reads and no fit may move: nobody measures one.
void add_doubt_of_exact_carcass(const Campaign& campaign, Warnings& warnings) {
  const auto reads = std::ranges::find_if(campaign.effects, [](const EffectChoice& effect) {
    return depends_on(bekker_wong::find_form(effect), carcass_pressure_key);
  });
  if (reads == campaign.effects.end() || bekker_wong::errs_by_carcass(campaign.wheel, campaign.effects)) return;
  const double value = campaign.wheel.carcass_pressure.value_or(Estimate{}).value;
  warnings.push_back(
      fmt::format("effect {} reads the carcass pressure, and {:.4g} kPa count as exact: what that is off is blamed on "
                  "whatever looks like it; give it an sd, carcass_pressure: {{value: {:.4g} kPa, sd: ...}}",
                  reads->id, value / 1000, value / 1000));
}

DoubtsBeforeFit doubts_as_declared(const Campaign& campaign, NextIs next) {
  const Case question = question_of(campaign, scenario_of(campaign));
  DoubtsBeforeFit doubts = doubts_of(campaign, question, quick_answers(question), Answered::no, next);
  add_doubt_of_exact_carcass(campaign, doubts.all);
  return doubts;
}

}  // namespace

std::string remark_on(const Scenario& scenario, const ModelChoice& model, const Answer& answer) {
  std::string remark;
  const auto add = [&](const std::string& text) { remark += (remark.empty() ? "" : "; ") + text; };
  const std::string place = " at " + in_words(answer.at);
  for (std::string doubt : doubts_of_answers(scenario, {{model, {answer}, {}}}, false)) {
    if (const std::size_t at = doubt.find(place); at != std::string::npos) doubt.erase(at, place.size());
    add(doubt);
  }
  if (answer.result && !answer.result->without_error_of.empty())
    add("the standard errors leave out the soil's " + listed(answer.result->without_error_of));
  return remark;
}

Remark remarks_about(const Scenario& scenario) {
  return [&scenario](const ModelChoice& model, const Answer& answer) { return remark_on(scenario, model, answer); };
}

std::vector<std::string> remarks_on(const Campaign& campaign, const Scenario& asked, const Prediction& prediction) {
  std::vector<std::string> remarks;
  std::map<int, std::size_t> of_line;
  const ModelChoice model{ModelKind::bekker_wong, asked.effects, ""};
  for (const PredictedRun& run : prediction.runs) {
    of_line[campaign.runs[remarks.size()].csv_line] = remarks.size();
    remarks.push_back(remark_on(asked, model, run.predicted));
  }
  for (const RowDoubt& one : row_doubts(campaign))
    if (one.line) {
      std::string& remark = remarks[of_line.at(*one.line)];
      remark += (remark.empty() ? "" : "; ") + one.words;
    }
  return remarks;
}

Warnings doubts(const Case& question, const std::vector<ModelAnswers>& study) {
  Warnings warnings = doubts_but_unused_inputs(question, study, Answered::yes);
  append(warnings, doubts_of_declarations(question));
  return warnings;
}

std::string tire_in_words(const Case& question) {
  std::string words = in_words(question.scenario.tire);
  const std::vector<UnusedInput> unused = unused_inputs(question);
  if (std::ranges::find(unused, "lugs", &UnusedInput::key) == unused.end()) return words;
  words.pop_back();  // the closing bracket
  return words + (asks(question.study, ModelKind::dem) ? "; the analytic wheel ignores them)"
                  : question.study.models.size() == 1  ? "; this model ignores the lugs)"
                                                       : "; these models ignore the lugs)");
}

Warnings doubts(const Case& question) {
  Warnings warnings = doubts_but_unused_inputs(question, quick_answers(question), Answered::no);
  append(warnings,
         doubts_of_declarations(question.drive && question.study.conditions.empty() ? as_study(question) : question));
  return warnings;
}

Warnings doubts(const Campaign& campaign) { return doubts_as_declared(campaign, NextIs::nothing).all; }

DoubtsBeforeFit doubts_before_fit(const Campaign& campaign) {
  return doubts_as_declared(campaign, NextIs::a_fit_for_effects);
}

Warnings doubts(const Campaign& campaign, const Scenario& asked, const Prediction& prediction) {
  const Case question = question_of(campaign, asked);
  ModelAnswers answers{question.study.models.front(), {}};
  for (const PredictedRun& run : prediction.runs) answers.answers.push_back(run.predicted);
  return doubts_of(campaign, question, {answers}, Answered::yes, NextIs::nothing).all;
}

}  // namespace soilbin::compare
