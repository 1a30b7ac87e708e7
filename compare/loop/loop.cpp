#include "compare/loop/loop.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "compare/attribution/candidates.hpp"
#include "compare/fit/thresholds.hpp"
#include "compare/measured/condition_views.hpp"
#include "scenario/errors.hpp"

namespace soilbin::compare {
namespace {

/// The effects of a candidate, with errors; p-values and cosines are those of proxies (1, none).
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

/// The effects of the best candidate, with the p-value and the cosines of each.
std::vector<AcceptedEffect> accepted_effects(const Attribution& found, const AttributionOptions& options) {
  std::vector<AcceptedEffect> effects = effects_of(found.best());
  for (std::size_t t = 0; t < effects.size(); ++t) {
    effects[t].p_value = p_beside_others(found, found.best(), static_cast<int>(t), options);
    effects[t].cosines = cosines(found.signatures.all, effects[t].choice.id);
  }
  return effects;
}

/// Each free soil value beside a model with effects and beside the base model.
std::vector<SoilShift> soil_shifts(const FittedModel& with, const FittedModel& without) {
  // the same soil parameters come first in both
  const Eigen::VectorXd error = with.errors_held_or_free(), base_error = without.errors_held_or_free(),
                        free_error = with.standard_errors();
  std::vector<SoilShift> shifts;
  for (int i = 0; i < without.predictor().soil_parameters(); ++i)
    shifts.push_back({with.predictor().parameters()[i].name,
                      {with.fit().theta[i], error[i]},
                      {without.fit().theta[i], base_error[i]},
                      with.predictor().parameters()[i].prior_sd,
                      free_error[i] == 0.0});
  return shifts;
}

/// How far the loop is, in hundredths: the attribution counts its pulses, the validation its folds.
class LoopProgress {
 public:
  explicit LoopProgress(const Progress& heard) : heard_(heard) {}

  void pulse() { say(validated_ ? all_steps - 1 : std::min(++pulses_ / pulses_a_step, attributed)); }
  Progress folds() {
    return [this](std::size_t done, std::size_t folds) { say(chosen + (all_steps - 1 - chosen) * done / folds); };
  }
  void choice_made() { say(chosen); }
  void validation_made() { validated_ = true; }
  void end() { say(all_steps); }

 private:
  static constexpr std::size_t all_steps = 100, attributed = 30, chosen = 40, pulses_a_step = 10;
  void say(std::size_t step) const {
    if (heard_) heard_(step, all_steps);
  }

  const Progress& heard_;
  std::size_t pulses_ = 0;
  bool validated_ = false;
};

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
struct Decided {
  Judgement judgement;
  std::optional<SecondAttribution> second;

  const Attribution& found() const { return judgement.found; }
  /// The chosen candidate's model where its effects are used, or the base model.
  const FittedModel& model(bool with_candidate) const { return with_candidate ? found().best().model : found().base; }
  const FittedModel& model() const { return model(judgement.may_use_candidate()); }
  /// That model fitted to the data of the base model taken as exact.
  FittedModel exact_model(const FittedModel& base) const {
    return refitted_as_exact(base, judgement.may_use_candidate() ? &model() : nullptr);
  }
  /// The noise in whose unit errors are told: beside accepted effects where there are any.
  NoiseFloor noise() const {
    return judgement.verdict() == Verdict::effect_found ? noise_beside(model()) : found().base.data().noise;
  }
};

/// An unknown effect may be the base model's own form: then effects can stand out that nothing but a change with load
/// and slip, taken for another effect, had hidden. The attribution that explains the data better decides; the other is
/// a note.
Decided decide(Judgement first, const AttributionOptions& options) {
  if (first.verdict() != Verdict::unknown_effect) return {std::move(first), std::nullopt};
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
  if (kept.verdict() != Verdict::effect_found) return {kept.verdict(), {}};
  return {kept.verdict(), kept.found.best().ids};
}

/// What only the attribution that does not decide leaves. An exact base model's sets always: an effect of load and slip
/// alone looks like what the other one lets go. The other one's where it explains the data nearly as well.
std::vector<WeightedSet> alternative_sets(const Decided& decision, const std::vector<WeightedSet>& listed) {
  const std::optional<SecondAttribution>& second = decision.second;
  if (!decision.found().candidates.best || !second->alternative.candidates.best) return {};
  const double behind = evidence_of_best(decision.found()) - evidence_of_best(second->alternative);
  if (!second->decides && behind > competitors(second->alternative.candidates).front().allowed) return {};
  std::vector<WeightedSet> noted = ambiguity_set(second->alternative.candidates);
  std::erase_if(noted, [&](const WeightedSet& w) {
    return std::ranges::any_of(listed, [&](const WeightedSet& other) { return other.ids == w.ids; });
  });
  for (WeightedSet& w : noted) w.weight = 0.0;
  return noted;
}

std::vector<Dependence> dependences_of(const FittedModel& model, std::uint64_t seed) {
  constexpr int permutations = 999;
  return dependences(model.data().observations, model.cell_residual(), permutations, seed);
}

/// Learned effects for what named ones do not explain.
std::vector<LearnedEffect> learned_beside(const FittedModel& base, const Decided& decision,
                                          const AttributionOptions& options) {
  if (decision.judgement.verdict() != Verdict::unknown_effect) return {};
  return learn_effects(decision.exact_model(base), options);
}

bool was_asked(const CrossValidation& errors) { return errors.overall.cells > 0; }

/// Whether the procedure, redone in each fold, predicts conditions left out no better with effects than without.
bool is_no_better(const CrossValidation& errors) {
  return was_asked(errors) && !(errors.overall.after < errors.overall.before);
}

/// Whether named effects do not stand before conditions left out. Where folds, which have fewer conditions, choose none
/// or do worse, an effect of overwhelming evidence is named all the same, and its error told.
bool is_refuted(const Judgement& judgement, const CrossValidation& errors) {
  return judgement.verdict() == Verdict::effect_found && was_asked(errors) &&
         errors.overall.after > errors.overall.before && judgement.found.signatures.p_value > thresholds::sure_level;
}

/// Whether the whole procedure, redone in each fold, predicts better with learned effects than without them, and in no
/// channel clearly worse.
bool predicts_better(const CrossValidation& with_learned) {
  if (!was_asked(with_learned)) return true;
  if (is_no_better(with_learned)) return false;
  for (const HeldOutErrors& channel : with_learned.channels)
    if (channel.after > channel.named * (1 + thresholds::max_learned_loss)) return false;
  return with_learned.overall.after < with_learned.overall.named * (1 - thresholds::min_learned_gain);
}

/// A decision redone on conditions left out, and the learned effects that predict those better. They become a part of
/// the model that is saved and explain nothing: what is told to be unexplained, and what that depends on, stays what
/// the named effects leave.
struct Validated {
  NoiseFloor noise;        ///< in whose unit errors are told
  CrossValidation errors;  ///< after: with the effects that are used
  std::vector<LearnedEffect> learned;
  bool keeps_candidate = false;  ///< its effects are accepted, or proxies that predict better
};

Validated validate(const FittedModel& base, const Decided& decision, std::vector<LearnedEffect> learned,
                   const LoopOptions& options, LoopProgress& progress) {
  NoiseFloor noise = decision.noise();
  CrossValidation errors;
  if (options.validate)
    errors = cross_validate(base.data(), noise,
                            {.attribution = of_a_fold(options.attribution),
                             .with_model_discrepancy = decision.second && decision.second->decides,
                             .use_candidate = decision.judgement.may_use_candidate(),
                             .learn = !learned.empty(),
                             .folds = options.folds,
                             .threads = options.threads,
                             .progress = progress.folds()});
  const Observations& all = base.data().observations;
  if (!learned.empty() && !predicts_better(errors))
    learned.clear(), errors = errors_without_learned(std::move(errors), all);
  const Judgement& judgement = decision.judgement;
  const bool refused = judgement.verdict() == Verdict::unknown_effect && is_no_better(errors);
  const bool keeps_candidate = judgement.may_use_candidate() && !refused;
  if (!keeps_candidate && learned.empty()) errors = errors_of_base_alone(std::move(errors), all);
  return {std::move(noise), std::move(errors), std::move(learned), keeps_candidate};
}

Validated learn_and_validate(const FittedModel& base, const Decided& decision, const LoopOptions& options,
                             const AttributionOptions& whole, LoopProgress& progress) {
  std::vector<LearnedEffect> learned = learned_beside(base, decision, whole);
  progress.choice_made();
  return validate(base, decision, std::move(learned), options, progress);
}

std::vector<SetAside> set_aside_by(const FittedModel& base, const Observations& given) {
  std::vector<SetAside> all;
  const Dataset& data = base.data();
  for (std::size_t i = 0; i < given.cells.size(); ++i) {
    if (!data.outlier[i]) continue;
    const Cell& cell = given.cells[i];
    SetAside one{data.campaign->runs[given.source_row[cell.row]].csv_line, cell.channel, cell.value, not_a_number};
    try {
      one.predicted = channel_of(base.predictor().reading(base.fit().theta, given.rows[cell.row]), cell.channel);
    } catch (const NoSolution&) {}
    all.push_back(one);
  }
  return all;
}

/// The campaign's wheel, with a pressure of the runs where each of them tells one: what an effect need not presume.
Tire as_run(const Campaign& campaign) {
  const bool told =
      std::ranges::all_of(campaign.runs, [](const Run& r) { return r.at.inflation_pressure.has_value(); });
  return told && !campaign.runs.empty() ? tire_at(campaign.wheel, campaign.runs.front().at) : campaign.wheel;
}

/// What every answer says of its campaign.
LoopAnswer answer_on(const Campaign& campaign) {
  LoopAnswer answer;
  answer.campaign = campaign.name;
  answer.wheel = as_run(campaign);
  answer.soil = campaign.soil;
  return answer;
}

/// What every answer says of a campaign that was fitted.
LoopAnswer answer_on(const FittedModel& base, const Observations& given, std::vector<std::string> not_testable) {
  LoopAnswer answer = answer_on(*base.data().campaign);
  answer.not_testable = std::move(not_testable);
  answer.dependences_before = dependences_of(base, 7);
  answer.noise = base.data().noise;
  answer.soil = base.soil();
  answer.set_aside = set_aside_by(base, given);
  return answer;
}

/// What the stages made, from which the answer is put together.
struct Stages {
  const Observations& given;
  const FittedModel& base;
  std::vector<std::string> not_testable;
  Decided decision;
  Validated validated;
};

/// What the candidates add, and the model that is saved.
WithCandidates what_candidates_add(const Stages& made, const FittedModel& saved, const Limits& limits) {
  const Attribution& found = made.decision.found();
  const Validated& validated = made.validated;
  WithCandidates with;
  if (found.candidates.best) {
    with.ambiguity_set = ambiguity_set(found.candidates);
    with.next = next_run(found, limits);
  }
  if (validated.keeps_candidate) with.dependences_after = dependences_of(found.best().model, 11);
  if (validated.keeps_candidate || !validated.learned.empty())
    with.soil_shifts = soil_shifts(saved, validated.learned.empty() ? found.base : made.base);
  return with;
}

UnknownEffect unknown_effect(Stages& made, WithCandidates with, const AttributionOptions& options) {
  std::optional<SecondAttribution>& second = made.decision.second;
  if (second) second->sets = alternative_sets(made.decision, with.ambiguity_set);
  UnknownEffect unknown{std::move(with), {}, std::move(made.validated.learned), {}, std::move(second)};
  if (!unknown.learned.empty()) {
    unknown.proxy_effects = effects_of(unknown.learned.back().candidate);
    unknown.formula = find_formula(made.decision.exact_model(made.base), unknown.learned.front(), options);
  } else if (made.validated.keeps_candidate) {
    unknown.proxy_effects = effects_of(made.decision.found().best());
  }
  return unknown;
}

LoopAnswer answer_of(Stages made, const AttributionOptions& options, const Limits& limits) {
  const Attribution& found = made.decision.found();
  const std::vector<LearnedEffect>& learned = made.validated.learned;
  const FittedModel& saved =
      learned.empty() ? made.decision.model(made.validated.keeps_candidate) : learned.back().candidate.model;
  LoopAnswer answer = answer_on(found.base, made.given, std::move(made.not_testable));
  answer.noise = made.validated.noise;
  answer.soil = saved.soil();
  if (!answer.set_aside.empty()) answer.with_outliers = keep_outliers(*made.base.data().campaign, made.given, options);
  answer.validation = std::move(made.validated.errors);
  const Verdict verdict = made.decision.judgement.verdict();
  if (verdict == Verdict::effect_found)
    answer.outcome = EffectFound{what_candidates_add(made, saved, limits), accepted_effects(found, options)};
  else if (verdict == Verdict::unknown_effect)
    answer.outcome = unknown_effect(made, what_candidates_add(made, saved, limits), options);
  else
    answer.outcome = NothingMissing{};
  answer.judged = std::move(made.decision.judgement);
  return answer;
}

}  // namespace

const WithCandidates& LoopAnswer::with_candidates() const {
  static const WithCandidates none;
  if (const auto* found = std::get_if<EffectFound>(&outcome)) return *found;
  return unknown() ? *unknown() : none;
}

std::set<std::string> ids_of(const std::vector<AcceptedEffect>& effects) {
  std::set<std::string> ids;
  for (const AcceptedEffect& effect : effects) ids.insert(effect.choice.id);
  return ids;
}

LoopAnswer run_loop(const Campaign& campaign, const LoopOptions& options) {
  LoopProgress progress(options.progress);
  AttributionOptions whole = options.attribution;
  whole.pool = {options.threads, [&] { progress.pulse(); }};

  const Observations observations = observe(campaign);
  if (const auto few = too_small(campaign, observations)) {
    LoopAnswer answer = answer_on(campaign);
    answer.judged = *few;
    return answer;
  }
  const FittedModel base = fit_base(campaign, observations, whole);
  Judgement first = judge(attribute(base, whole), whole);
  std::vector<std::string> hidden = not_testable(first.found);
  Decided decision = decide(std::move(first), whole);
  if (decision.judgement.verdict() == Verdict::not_enough_data) {
    LoopAnswer answer = answer_on(decision.found().base, observations, std::move(hidden));
    answer.judged = std::move(decision.judgement);
    return answer;
  }
  Validated validated = learn_and_validate(base, decision, options, whole, progress);
  if (is_refuted(decision.judgement, validated.errors)) {
    const Refuted refuted{validated.errors.overall.before, validated.errors.overall.after};
    decision = decide(refuted_by(std::move(decision.judgement), refuted), whole);
    validated = learn_and_validate(base, decision, options, whole, progress);
  }
  progress.validation_made();
  LoopAnswer answer = answer_of({observations, base, std::move(hidden), std::move(decision), std::move(validated)},
                                whole, options.limits);
  progress.end();
  return answer;
}

// What an answer of the loop implies, as values: sets worth showing, channels that it makes worse, runs to make next.

namespace {

constexpr double third_digit = 1.005;

/// The condition of the run that the saved model misses most in a channel.
OperatingCondition missed_most(const LoopAnswer& answer, int channel) {
  const Observations& observations = answer.found().base.data().observations;
  const Eigen::VectorXd residual = answer.model().cell_residual().cwiseAbs();
  const Cell* most = nullptr;
  double by = -1;
  for (std::size_t i = 0; i < observations.cells.size(); ++i)
    if (const Cell& cell = observations.cells[i]; cell.channel == channel && residual[i] > by)
      by = residual[i], most = &cell;
  return observations.rows[most == nullptr ? 0 : most->row];
}

}  // namespace

/// Dependences of what the model leaves.
const std::vector<Dependence>& dependences_left(const LoopAnswer& answer) {
  const std::vector<Dependence>& after = answer.with_candidates().dependences_after;
  return after.empty() ? answer.dependences_before : after;
}

std::vector<const WeightedSet*> sets_shown(const LoopAnswer& answer) {
  constexpr std::size_t most = 8;
  std::vector<const WeightedSet*> sets;
  for (const WeightedSet& w : answer.ambiguity_set()) sets.push_back(&w);
  const auto listed = [&](const WeightedSet& w) {
    return std::ranges::any_of(sets, [&](const WeightedSet* one) { return one->ids == w.ids; });
  };
  if (!answer.has_candidates()) return sets;
  for (const WeightedSet& w : answer.found().candidates.sets)
    if (sets.size() < most && !listed(w)) sets.push_back(&w);
  return sets;
}

std::vector<std::string> forms_in_order(const CandidateModel& candidate) {
  std::map<std::string, std::string> by_id;
  for (const Term& term : candidate.terms()) by_id[term.form->id] = term.form->form;
  std::vector<std::string> forms;
  for (const std::string& id : candidate.ids) forms.push_back(by_id.at(id));
  return forms;
}

bool rises(const HeldOutErrors& error) { return error.after > third_digit * error.before; }

bool falls(const HeldOutErrors& error) { return error.before > third_digit * error.after; }

std::vector<int> worse_channels(const LoopAnswer& answer) {
  std::vector<int> worse;
  if (!answer.uses_effects()) return worse;
  for (int c = 0; c < channel_count; ++c)
    if (rises(answer.validation.channels[c])) worse.push_back(c);
  return worse;
}

std::vector<std::string> beyond_what_is_known(const NextRun& next) {
  std::vector<std::string> names = next.beyond;
  std::erase_if(names, [&](const std::string& name) { return next.given.contains(name); });
  return names;
}

bool proposes_next(const LoopAnswer& answer) {
  if (!answer.next() || answer.verdict() != Verdict::unknown_effect) return answer.next().has_value();
  const std::vector<const WeightedSet*> sets = sets_shown(answer);
  const auto other =
      std::ranges::find_if(sets, [&](const WeightedSet* set) { return set->ids == answer.next()->separates.back(); });
  return other == sets.end() ||
         sets.front()->log_evidence - (*other)->log_evidence < std::log(thresholds::settled_odds);
}

std::vector<Dependence> sure_dependences(const LoopAnswer& answer) {
  if (answer.verdict() != Verdict::unknown_effect) return {};
  std::vector<Dependence> all = dependences_left(answer);
  std::erase_if(all, [](const Dependence& d) { return d.false_discovery_rate > thresholds::false_discovery_level; });
  std::ranges::stable_sort(all, [](const Dependence& a, const Dependence& b) {
    return std::pair(a.p_value, -a.share) < std::pair(b.p_value, -b.share);
  });
  return all;
}

std::vector<OperatingCondition> shape_series(const LoopAnswer& answer) {
  const std::vector<Dependence> sure = sure_dependences(answer);
  if (sure.empty() || sure.front().variable == "run") return {};
  const Observations& observations = answer.found().base.data().observations;
  constexpr int settings = 5;
  const std::string& variable = sure.front().variable;
  return combinations(missed_most(answer, sure.front().channel),
                      {{variable, evenly(ranges_of(observations).at(variable), settings)}});
}

double rig_setting_of(const LoopAnswer& answer, const OperatingCondition& at, const std::string& condition) {
  const ConditionView& view = condition_view(condition);
  const Dataset& data = answer.found().base.data();
  const double value = view.get(at);
  if (!std::isfinite(value)) return value;
  constexpr double anywhere = std::numeric_limits<double>::infinity();
  const Limits limits = answer.next() ? answer.next()->given : Limits{};
  const auto given = limits.find(condition);
  const std::pair<double, double> within = given != limits.end() ? given->second : std::pair(-anywhere, anywhere);
  return rig_setting(view, value, data.observations, within, own_unit(data.campaign->columns, view).second);
}

}  // namespace soilbin::compare
