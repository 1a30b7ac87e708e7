#include "compare/loop/loop.hpp"

#include <algorithm>

#include "compare/attribution/model_discrepancy.hpp"
#include "compare/fit/thresholds.hpp"
#include "compare/loop/answer_words.hpp"

namespace soilbin::compare {
namespace {

/// The effects of a candidate, with errors; p-values and cosines are those of effects that stand in (1, none).
std::vector<AcceptedEffect> effects_of(const CandidateModel& candidate) {
  constexpr double two_sided = 1.96;
  const WheelPredictor& predictor = candidate.model.predictor();
  const Eigen::VectorXd errors = candidate.model.standard_errors();
  const std::vector<EffectChoice> choices = predictor.choices(candidate.fit().theta);
  std::vector<AcceptedEffect> effects;
  for (std::size_t term = 0; term < candidate.terms().size(); ++term) {
    const Term& t = candidate.terms()[term];
    AcceptedEffect effect;
    effect.choice = choices[choices.size() - candidate.terms().size() + term];
    for (std::size_t k = 0; k < t.free.size(); ++k) {
      const Eigen::Index i = predictor.amplitude_index(static_cast<int>(term)) + k;
      const FreeParameter& bounds = predictor.parameters()[i];
      const bool held = errors[i] == 0.0;
      const double value = candidate.fit().theta[i], error = held ? candidate.model.held_error(i) : errors[i];
      effect.at_bound.push_back(held);
      effect.fitted.push_back(t.form->parameters[t.free[k]].name);
      effect.ci95.emplace_back(std::max(bounds.lower, value - two_sided * error),
                               std::min(bounds.upper, value + two_sided * error));
    }
    effects.push_back(std::move(effect));
  }
  return effects;
}

/// The same with the p-value and the cosines of each.
std::vector<AcceptedEffect> accepted_effects(const Attribution& found, const AttributionOptions& options) {
  std::vector<AcceptedEffect> effects = effects_of(found.best());
  for (std::size_t t = 0; t < effects.size(); ++t) {
    effects[t].p_value = p_beside_others(found, found.best(), static_cast<int>(t), options);
    effects[t].cosines = cosines(found.signatures.all, effects[t].choice.id);
  }
  return effects;
}

/// Of each free soil value, beside a model with effects and beside the base model.
std::vector<SoilShift> soil_shifts(const FittedModel& with, const FittedModel& without) {
  // the same soil parameters come first in both
  const Eigen::VectorXd error = with.standard_errors(), base_error = without.standard_errors();
  std::vector<SoilShift> shifts;
  for (int i = 0; i < without.predictor().soil_parameters(); ++i)
    shifts.push_back({with.predictor().parameters()[i].name,
                      {with.fit().theta[i], error[i]},
                      {without.fit().theta[i], base_error[i]}});
  return shifts;
}

/// Shares of the progress: until the attribution, the choice, and the validation are done.
constexpr std::size_t all_steps = 100, attributed = 30, chosen = 40, pulses_a_step = 10;

/// Effects of the catalogue, but for the declared ones, that no form of theirs would show.
std::vector<std::string> not_testable(const Attribution& found) {
  std::vector<std::string> hidden = bekker_wong::effect_ids();
  for (const Signature& s : found.signatures.all)
    if (s.testable) std::erase(hidden, s.term.form->id);
  const Campaign& campaign = *found.base.data().campaign;
  for (const EffectChoice& declared : campaign.effects) std::erase(hidden, declared.id);
  for (const std::string& id : campaign.impossible) std::erase(hidden, id);
  return hidden;
}

double evidence_of_best(const Attribution& found) { return found.candidates.weighed(found.best().ids).log_evidence; }

/// Whether the second attribution names effects and, the price of its freedom paid, explains the data better.
bool explains_better(const Attribution& second, const Attribution& first) {
  return second.candidates.best && (!first.candidates.best || evidence_of_best(second) > evidence_of_best(first));
}

/// The judgement of the attribution that decides, and the attribution beside it.
struct Decision {
  Judgement judgement;
  std::optional<SecondAttribution> second;
};

/// An unknown effect may be the base model's own form: then effects can stand out that nothing but a change with load
/// and slip, taken for another effect, had hidden. The attribution that explains the data better decides; the other is
/// a note.
Decision decide(Judgement first, const AttributionOptions& options) {
  if (first.verdict != Verdict::unknown_effect) return {std::move(first), std::nullopt};
  auto beside = attribute_with_model_discrepancy(first.found, options);
  if (!beside) return {std::move(first), std::nullopt};
  if (!explains_better(beside->found, first.found))
    return {std::move(first), SecondAttribution{false, beside->size, std::move(beside->found)}};
  return {judge_with_model_discrepancy(std::move(beside->found), options),
          SecondAttribution{true, beside->size, std::move(first.found)}};
}

/// The choice within a fold: fewer simulations, its outliers set aside by the whole.
AttributionOptions of_a_fold(AttributionOptions options) {
  options.simulations = std::max(500, options.simulations / 4);
  options.drop_outliers = false;
  return options;
}

/// The conclusion with every value kept: a choice by the rest must not be the doing of what was set aside.
WithOutliers keep_outliers(const Campaign& campaign, const Observations& observations, AttributionOptions options) {
  options.drop_outliers = false;
  const Judgement kept = judge(attribute(fit_base(campaign, observations, options), options), options);
  if (kept.verdict != Verdict::effect_found) return {kept.verdict, {}};
  return {kept.verdict, kept.found.best().ids};
}

/// What only the attribution that does not decide leaves. An exact base model's sets always: an effect of load and slip
/// alone looks like what the other one lets go. The other one's where it explains the data nearly as well.
std::vector<Weighted> noted_sets(const LoopAnswer& answer) {
  if (!answer.second || !answer.second->note.candidates.best) return {};
  const Attribution& note = answer.second->note;
  const double behind = evidence_of_best(answer.found()) - evidence_of_best(note);
  if (!answer.second->decides && behind > competitors(note.candidates).front().allowed) return {};
  std::vector<Weighted> noted = ambiguity_set(note.candidates);
  std::erase_if(noted, [&](const Weighted& w) {
    return std::ranges::any_of(answer.ambiguity_set, [&](const Weighted& decided) { return decided.ids == w.ids; });
  });
  for (Weighted& w : noted) w.weight = 0.0;
  return noted;
}

std::vector<Dependence> dependences_of(const FittedModel& model, std::uint64_t seed) {
  constexpr int permutations = 999;
  return dependences(model.data().observations, model.cell_residual(), permutations, seed);
}

/// What a decision says by itself: verdict, noise, soil.
LoopAnswer answer_of(const Campaign& campaign, Decision decision) {
  Judgement& judgement = decision.judgement;
  const Attribution& found = judgement.found;
  const bool takes_best = judgement.takes_best();
  const FittedModel& model = takes_best ? found.best().model : found.base;
  LoopAnswer answer;
  answer.campaign = campaign.name;
  answer.wheel = campaign.wheel;
  answer.verdict = judgement.verdict;
  answer.reason = judgement.reason;
  answer.noise = judgement.verdict == Verdict::effect_found ? noise_beside(model) : found.base.data().noise;
  answer.soil = model.soil();
  answer.dependences_before = dependences_of(found.base, 7);
  if (takes_best) {
    answer.soil_shifts = soil_shifts(model, found.base);
    answer.dependences_after = dependences_of(model, 11);
    if (judgement.verdict == Verdict::unknown_effect) answer.stand_in = effects_of(found.best());
  }
  const std::vector<bool>& outlier = found.base.data().outlier;
  answer.outliers = static_cast<int>(std::ranges::count(outlier, true));
  answer.second = std::move(decision.second);
  answer.judgement = std::move(judgement);
  return answer;
}

/// Learned effects for what named ones do not explain.
std::vector<LearnedEffect> learned_beside(const FittedModel& base, const Judgement& judgement,
                                          const AttributionOptions& options) {
  if (judgement.verdict != Verdict::unknown_effect) return {};
  return learn_effects(refitted_as_exact(base, judgement.takes_best() ? &judgement.found.best().model : nullptr),
                       options);
}

/// Whether the whole procedure, redone in each fold, predicts better with learned effects than without, and in no
/// channel clearly worse.
bool predicts_better(const CrossValidation& with_learned) {
  if (with_learned.overall.cells == 0) return true;  // not asked
  for (const ErrorPair& channel : with_learned.channels)
    if (channel.after > channel.named * (1 + thresholds::most_learned_loss)) return false;
  return with_learned.overall.after < with_learned.overall.named * (1 - thresholds::least_learned_gain);
}

/// Learned effects that predict better become a part of the model that is saved. They explain nothing: what is told to
/// be unexplained, and what that depends on, stays what the named effects leave.
void take_learned(std::vector<LearnedEffect> learned, const FittedModel& base, LoopAnswer& answer) {
  if (learned.empty()) return;
  if (!predicts_better(answer.validation)) {
    answer.validation = without_learned_effects(std::move(answer.validation), base.data().observations);
    return;
  }
  answer.learned = std::move(learned);
  answer.stand_in = effects_of(answer.learned.back().candidate);
  answer.soil = answer.model().soil();
  answer.soil_shifts = soil_shifts(answer.model(), base);
}

LoopAnswer too_small_to_judge(const Campaign& campaign, std::string reason) {
  LoopAnswer answer;
  answer.campaign = campaign.name;
  answer.wheel = campaign.wheel;
  answer.soil = campaign.soil;
  answer.reason = std::move(reason);
  return answer;
}

}  // namespace

std::set<std::string> ids_of(const std::vector<AcceptedEffect>& effects) {
  std::set<std::string> ids;
  for (const AcceptedEffect& effect : effects) ids.insert(effect.choice.id);
  return ids;
}

LoopAnswer run_loop(const Campaign& campaign, const LoopOptions& options) {
  const auto report = [&](std::size_t step) {
    if (options.progress) options.progress(step, all_steps);
  };
  AttributionOptions whole = options.attribution;
  std::size_t pulses = 0;
  whole.pool = {options.threads, [&] { report(std::min(++pulses / pulses_a_step, attributed)); }};

  const Observations observations = observe(campaign);
  if (auto reason = too_small(campaign, observations)) return too_small_to_judge(campaign, std::move(*reason));
  const FittedModel base = fit_base(campaign, observations, whole);
  Judgement first = judge(attribute(base, whole), whole);
  std::vector<std::string> hidden = not_testable(first.found);
  Decision decision = decide(std::move(first), whole);
  std::vector<LearnedEffect> learned = learned_beside(base, decision.judgement, whole);

  LoopAnswer answer = answer_of(campaign, std::move(decision));
  answer.not_testable = std::move(hidden);
  if (answer.verdict == Verdict::not_enough_data) return answer;
  report(chosen);
  if (options.validate)
    answer.validation = cross_validate(base.data(), answer.noise,
                                       {.attribution = of_a_fold(options.attribution),
                                        .with_model_discrepancy = answer.decided_with_model_discrepancy(),
                                        .learn = !learned.empty(),
                                        .folds = options.folds,
                                        .threads = options.threads,
                                        .progress = [&](std::size_t done, std::size_t folds) {
                                          report(chosen + (all_steps - 1 - chosen) * done / folds);
                                        }});
  take_learned(std::move(learned), base, answer);
  whole.pool.pulse = [&] { report(all_steps - 1); };
  if (!answer.learned.empty())
    answer.formula =
        find_formula(refitted_as_exact(base, answer.judgement->takes_best() ? &answer.found().best().model : nullptr),
                     answer.learned.front(), whole);
  if (answer.verdict == Verdict::effect_found) answer.effects = accepted_effects(answer.found(), whole);
  answer.reason += held_out_clause(answer);
  if (answer.verdict != Verdict::nothing_missing && answer.found().candidates.best) {
    answer.ambiguity_set = ambiguity_set(answer.found().candidates);
    answer.noted_sets = noted_sets(answer);
    answer.next = next_test(answer.found(), options.limits);
  }
  if (answer.outliers > 0) answer.with_outliers = keep_outliers(campaign, observations, whole);
  report(all_steps);
  return answer;
}

}  // namespace soilbin::compare
