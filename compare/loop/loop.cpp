#include "compare/loop/loop.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "compare/loop/accepted_model.hpp"
#include "compare/loop/base_fit.hpp"
#include "compare/loop/held_out_words.hpp"
#include "compare/loop/verdict.hpp"
#include "scenario/errors.hpp"

namespace soilbin::compare {

std::string_view word(Verdict verdict) {
  switch (verdict) {
    case Verdict::effect_found:
      return "effect_found";
    case Verdict::nothing_missing:
      return "nothing_missing";
    case Verdict::unknown_effect:
      return "unknown_effect";
    case Verdict::not_enough_data:
      return "not_enough_data";
  }
  return "";
}

namespace {

constexpr double least_noise_freedom = 5.0;  // a channel; below it a residual can't be told from noise

std::vector<std::string> not_testable(const Campaign& campaign, const Identification& id) {
  std::map<std::string, bool> testable;
  for (const bekker_wong::EffectForm& form : bekker_wong::effect_catalogue()) testable[form.id] = false;
  for (const Signature& s : id.signatures)
    if (s.testable) testable[s.term.form->id] = true;
  for (const EffectChoice& declared : campaign.effects) testable.erase(declared.id);
  std::vector<std::string> hidden;
  for (const bekker_wong::EffectForm& form : bekker_wong::effect_catalogue())
    if (testable.count(form.id) && !testable[form.id] && (hidden.empty() || hidden.back() != form.id))
      hidden.push_back(form.id);
  return hidden;
}

bool too_small(const Campaign& campaign, const Observations& observations, std::string& reason) {
  const WheelPredictor base(campaign, observations);
  const int spare = static_cast<int>(observations.cells.size()) - base.soil_parameters();
  if (spare >= 6 && observations.conditions >= 6) return false;
  reason = fmt::format("{} measured values of {} conditions for {} soil values leave too little to judge by",
                       observations.cells.size(), observations.conditions, base.soil_parameters());
  return true;
}

/// Steps of the progress: what the identification and the choice take of all.
constexpr std::size_t all_steps = 100, identified = 30, chosen = 40, pulses_a_step = 10;

/// What the reading that decides finds before any effect is judged.
void describe_base(const Campaign& campaign, LoopAnswer& answer) {
  const Identification& id = answer.details;
  const Eigen::Index cells = static_cast<Eigen::Index>(id.observations.cells.size());
  answer.noise = id.noise;
  answer.before = lack_of_fit(id.base, id.noise, cells);
  answer.reruns_before = rerun_test(id.observations, id.noise, id.base);
  answer.dependences_before = dependences(id.observations, id.base.residual.head(cells), 999, 7);
  answer.soil = fitted_soil(campaign, WheelPredictor(campaign, id.observations), id.base);
}

/// Whether the data allow to judge any effect; else the reason.
bool judgeable(LoopAnswer& answer) {
  const Identification& id = answer.details;
  if (id.noise.typical_freedom() < least_noise_freedom) {
    answer.reason = fmt::format("the noise of a channel rests on {:.1f} degrees of freedom only, too few to judge by",
                                id.noise.typical_freedom());
    return false;
  }
  if (std::none_of(id.signatures.begin(), id.signatures.end(), [](const Signature& s) { return s.testable; })) {
    answer.reason = "no effect of the catalogue would show in these data, whatever its size";
    return false;
  }
  return true;
}

/// The run that would best set the competing sets of a reading apart.
std::optional<NextTest> proposed(const Campaign& campaign, const Identification& id, const Limits& limits) {
  Limits reach = limits;  // what is given comes before what the campaign spans
  reach.merge(limits_of(id.observations));
  return next_test(campaign, id, competitors(id), reach);
}

double evidence_of_best(const Identification& id) { return weighed(id, id.candidates[*id.best].ids).log_evidence; }

/// Whether the second reading names effects and, the price of its freedom paid, explains the data better.
bool explains_better(const Identification& second, const Identification& first) {
  return second.best && (!first.best || evidence_of_best(second) > evidence_of_best(first));
}

/// What only the reading that does not decide leaves. An exact base model's sets always: an effect of load and slip
/// alone looks like what the other one lets go. The other one's where it explains the data nearly as well.
std::vector<Weighted> noted_sets(const LoopAnswer& answer) {
  if (!answer.second || !answer.second->note.best) return {};
  const Identification& note = answer.second->note;
  const std::vector<Competitor> all = competitors(note);
  const double behind = evidence_of_best(answer.details) - evidence_of_best(note);
  if (!answer.second->decides && behind > all.front().allowed) return {};
  std::vector<Weighted> noted = weighted_sets(note, all);
  std::erase_if(noted, [&](const Weighted& w) {
    return std::any_of(answer.ambiguity_set.begin(), answer.ambiguity_set.end(),
                       [&](const Weighted& decided) { return decided.ids == w.ids; });
  });
  for (Weighted& w : noted) w.weight = 0.0;
  return noted;
}

/// An unknown effect may be the base model's own form: then effects can stand out that nothing but a change with load
/// and slip, taken for another effect, had hidden. The reading that explains the data better decides all that is told;
/// the other is a note.
void read_again(const Campaign& campaign, LoopAnswer& answer, const IdentifyOptions& options) {
  auto beside = read_with_model_discrepancy(campaign, answer.details, options);
  if (!beside) return;
  const bool decides = explains_better(beside->identification, answer.details);
  answer.second = SecondReading{decides, beside->size, std::move(beside->identification)};
  if (!decides) return;
  std::swap(answer.details, answer.second->note);
  describe_base(campaign, answer);
  confirm(campaign, answer, options);
  decide_with_model_discrepancy(campaign, answer);
}

/// The choice within a fold: fewer simulations, its outliers set aside by the whole.
IdentifyOptions of_a_fold(IdentifyOptions options) {
  options.simulations = std::max(500, options.simulations / 4);
  options.drop_outliers = false;
  return options;
}

/// Noise to verdict on these observations, the base model taken as exact; false where they are too few, with the
/// reason.
bool judge(const Campaign& campaign, const Observations& observations, const IdentifyOptions& options,
           LoopAnswer& answer) {
  answer.details = identify(campaign, observations, options);
  const Identification& id = answer.details;
  answer.outliers = static_cast<int>(std::count(id.outlier.begin(), id.outlier.end(), true));
  answer.not_testable = not_testable(campaign, id);
  describe_base(campaign, answer);
  if (!judgeable(answer)) return false;
  if (id.best) {
    confirm(campaign, answer, options);
    if (explains_all(answer)) answer.noise = noise_beside(campaign, id, id.candidates[*id.best]);
  }
  decide(campaign, answer);
  return true;
}

/// The conclusion with every value kept: a choice by the rest must not be the doing of what was set aside.
WithOutliers keep_outliers(const Campaign& campaign, const Observations& observations, IdentifyOptions options) {
  options.drop_outliers = false;
  LoopAnswer answer;
  judge(campaign, observations, options, answer);
  return {answer.verdict, ids_of(answer.effects)};
}

/// What the effects gain on conditions left out, and where they lose, goes into the verdict.
void tell_errors(LoopAnswer& answer) {
  if (answer.validation.overall.cells == 0) return;
  const std::string words = held_out_words(answer.validation);
  if (!answer.effects.empty()) answer.reason += "; " + words;
  if (!answer.stand_in.empty()) answer.reason += "; with the model that is saved, " + words;
}

}  // namespace

std::set<std::string> ids_of(const std::vector<AcceptedEffect>& effects) {
  std::set<std::string> ids;
  for (const AcceptedEffect& effect : effects) ids.insert(effect.choice.id);
  return ids;
}

bool decided_with_model_discrepancy(const LoopAnswer& answer) { return answer.second && answer.second->decides; }

const Identification* with_model_discrepancy(const LoopAnswer& answer) {
  if (!answer.second) return nullptr;
  return answer.second->decides ? &answer.details : &answer.second->note;
}

LoopAnswer run_loop(const Campaign& campaign, const LoopOptions& options) {
  const auto say = [&](std::size_t step) {
    if (options.progress) options.progress(step, all_steps);
  };
  LoopAnswer answer;
  answer.campaign = campaign.name;
  answer.wheel = campaign.wheel;
  answer.soil = campaign.soil;
  const Observations observations = observe(campaign);
  if (too_small(campaign, observations, answer.reason)) return answer;
  IdentifyOptions whole = options.identify;
  std::size_t pulses = 0;
  whole.pool = {options.threads, [&] { say(std::min(++pulses / pulses_a_step, identified)); }};
  if (!judge(campaign, observations, whole, answer)) return answer;
  if (answer.verdict == Verdict::unknown_effect) read_again(campaign, answer, whole);
  say(chosen);
  const IdentifyOptions inner = of_a_fold(options.identify);
  if (options.validate)
    answer.validation = cross_validate(campaign, answer.details, answer.noise, decided_with_model_discrepancy(answer),
                                       inner, options.folds, options.threads, [&](std::size_t done, std::size_t folds) {
                                         say(chosen + (all_steps - 1 - chosen) * done / folds);
                                       });
  tell_errors(answer);
  whole.pool.pulse = [&] { say(all_steps - 1); };
  describe_effects(campaign, answer, whole);
  const bool compete = answer.verdict == Verdict::effect_found || answer.verdict == Verdict::unknown_effect;
  if (compete && answer.details.best) {
    answer.ambiguity_set = weighted_sets(answer.details, competitors(answer.details));
    answer.noted_sets = noted_sets(answer);
    answer.next = proposed(campaign, answer.details, options.limits);
  }
  if (answer.outliers > 0) answer.with_outliers = keep_outliers(campaign, observations, whole);
  say(all_steps);
  return answer;
}

}  // namespace soilbin::compare
