#include "compare/attribution/candidates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "compare/fit/condition_functions.hpp"
#include "compare/fit/fitted_model.hpp"

namespace soilbin::compare {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// Starts a term at these values of its form's parameters, with a share of the amplitude: with next to none the fit
/// ends no higher than the one that it begins from, whose first step would else have to lead back there.
void put(VectorXd& start, const WheelPredictor& predictor, int term, const std::vector<double>& values, double share) {
  const Term& t = predictor.terms()[term];
  const Index first = predictor.amplitude_index(term);
  const double off_its_bound = share > 0.0 ? 1e-3 : 1e-6;
  for (std::size_t k = 0; k < t.free.size(); ++k) {
    const int i = t.free[k];
    const bekker_wong::EffectParameter& p = t.form->parameters[i];
    const double least = k == 0 ? p.lower + off_its_bound * (p.upper - p.lower) : p.lower;
    start[first + k] = std::clamp(k == 0 ? share * values[i] : values[i], least, p.upper);
  }
}

/// Soil values and earlier terms as known, then the estimated terms, their amplitudes halved until every run is
/// carried; and the balances there.
std::pair<VectorXd, BalanceMemory> start_of(const WheelPredictor& predictor, const CandidateStart& known, double share,
                                            const VectorXd& where) {
  VectorXd start = predictor.start(), prediction;
  start.head(where.size()) = where;
  for (const auto& [term, values] : known.estimated) put(start, predictor, term, values, share);
  BalanceMemory memory = known.from->balance;
  for (int halving = 0; halving < 6 && !predictor.predict(start, prediction, memory); ++halving)
    for (const auto& [term, values] : known.estimated) start[predictor.amplitude_index(term)] *= 0.5;
  return {std::move(start), std::move(memory)};
}

}  // namespace

std::optional<FittedModel> fit_terms(const FittedModel& base, const std::vector<Term>& terms,
                                     const CandidateStart& known) {
  const WheelPredictor predictor = base.predictor().with(terms);
  std::optional<FittedModel> best;
  const auto try_from = [&](double share, const VectorXd& where) {
    auto [start, near] = start_of(predictor, known, share, where);
    auto found = fitted(base.shared_data(), predictor, start, std::move(near));
    if (found && (!best || found->fit().chi2 < best->fit().chi2)) best = std::move(found);
  };
  const auto drops_by = [&](double drop) { return best && best->fit().chi2 < known.from->chi2 - drop; };
  for (const double share : {1.0, 0.3, 0.0})
    if (!drops_by(share > 0.0 ? 0.5 * known.expected_drop : 0.0)) try_from(share, known.from->restart);
  if (!drops_by(0.0)) try_from(0.0, known.from->theta);  // where the soil carries every run
  return best;
}

namespace {

/// The strongest signatures, at most a few forms an effect.
std::vector<const Signature*> strongest_forms(const std::vector<Signature>& signatures, int most) {
  std::vector<const Signature*> order;
  for (const Signature& s : signatures)
    if (s.projected_norm > 0 && s.strength() > thresholds::min_strength) order.push_back(&s);
  std::ranges::stable_sort(order, [](auto a, auto b) { return a->strength() > b->strength(); });
  std::vector<const Signature*> chosen;
  std::map<std::string, int> forms;
  std::set<const bekker_wong::EffectForm*> taken;
  for (const Signature* s : order) {
    if (static_cast<int>(chosen.size()) >= most) break;
    if (taken.count(s->term.form) || forms[s->term.form->id] >= thresholds::forms_an_effect) continue;
    taken.insert(s->term.form);
    ++forms[s->term.form->id];
    chosen.push_back(s);
  }
  return chosen;
}

/// The form's parameters where the signature puts them.
std::vector<double> estimate_of(const Signature& s) {
  std::vector<double> values = s.term.defaults;
  const bekker_wong::EffectParameter& p = s.term.form->parameters.front();
  values.front() = std::clamp(s.amplitude, p.lower, p.upper);
  return values;
}

/// Two forms of different effects and what they gain together in chi2 of the linear problem.
struct SignaturePair {
  double gain = 0.0;
  const Signature* a = nullptr;
  const Signature* b = nullptr;
};

/// The pairs of largest gain, at most a few a pair of effects.
std::vector<SignaturePair> strongest_pairs(const std::vector<Signature>& signatures, int most) {
  std::vector<const Signature*> seen;
  for (const Signature& s : signatures)
    if (s.projected_norm > 0) seen.push_back(&s);
  std::vector<SignaturePair> pairs;
  for (std::size_t i = 0; i < seen.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Signature &a = *seen[i], &b = *seen[j];
      if (a.term.form->id == b.term.form->id) continue;
      const double c = a.direction.dot(b.direction), det = 1 - c * c;
      if (det < thresholds::min_pair_determinant) continue;
      const double u = (a.score - c * b.score) / det, v = (b.score - c * a.score) / det;
      if ((a.one_sided && u < 0) || (b.one_sided && v < 0)) continue;
      pairs.push_back({u * a.score + v * b.score, &a, &b});
    }
  std::ranges::stable_sort(pairs, [](const SignaturePair& x, const SignaturePair& y) { return x.gain > y.gain; });
  std::vector<SignaturePair> best;
  std::map<std::set<std::string>, int> sets;
  for (const SignaturePair& pair : pairs) {
    if (static_cast<int>(best.size()) >= most) break;
    if (sets[{pair.a->term.form->id, pair.b->term.form->id}]++ < thresholds::forms_a_pair) best.push_back(pair);
  }
  return best;
}

using FormSet = std::set<const bekker_wong::EffectForm*>;

FormSet forms_of(const std::vector<Term>& terms) {
  FormSet forms;
  for (const Term& term : terms) forms.insert(term.form);
  return forms;
}

/// ln prior of one candidate: an effect among about twenty, a form among the effect's, and, where physics fixes the
/// sign, half the amplitudes to choose from.
double log_prior(const std::vector<Term>& terms) {
  double sum = 0.0;
  for (const Term& term : terms) {
    double ids = 0.0, forms = 0.0;
    std::string last;
    for (const bekker_wong::EffectForm& form : bekker_wong::effect_catalogue()) {
      if (form.id == term.form->id) forms += 1;
      if (form.id != last) ids += 1;
      last = form.id;
    }
    const bool one_sided = term.form->parameters.front().lower >= 0.0;
    sum += -std::log(ids) - std::log(forms) + (one_sided ? std::log(2.0) : 0.0);
  }
  return sum - thresholds::price_of_another_effect * static_cast<double>(terms.size() - 1);
}

auto of_size(int n) {
  return [n](const CandidateModel& c) { return std::ssize(c.ids) == n; };
}

/// The candidates of a base model, found step by step: each step looks at what the steps before it have fitted.
class Search {
 public:
  /// all_runs: what terms are centred on, where the base model is one of pooled runs.
  Search(const FittedModel& base, const Observations& all_runs, const std::vector<Signature>& signatures,
         const AttributionOptions& options)
      : base_(base), all_runs_(all_runs), signatures_(signatures), options_(options) {
    found_.base_log_evidence = log_evidence(base, false);
  }

  void fit_singles() {
    fit_each(strongest_forms(signatures_, thresholds::max_refits), [&](const Signature* s) {
      return fit_terms(base_, {free_term(*s->term.form)}, {&base_.fit(), {{0, estimate_of(*s)}}, s->score * s->score});
    });
  }

  /// Pairs of forms that together follow the residual best.
  void fit_pairs() {
    fit_each(strongest_pairs(signatures_, thresholds::max_refits / 2),
             [&](const SignaturePair& pair) { return fit_pair(pair); });
  }

  /// Forward from the best single effect, then from each member of the best pair: another partner may suit it better.
  void extend_singles() {
    std::set<std::size_t> extended;
    const auto once = [&](std::optional<std::size_t> from) {
      if (from && extended.insert(*from).second) extend(*from);
    };
    once(strongest_candidate(of_size(1)));
    if (const auto pair = strongest_candidate(of_size(2)); pair) {
      const std::set<std::string> members = found_.models[*pair].ids;
      for (const std::string& member : members)
        once(strongest_candidate([&](const CandidateModel& c) { return c.ids == std::set<std::string>{member}; }));
    }
  }

  /// Where even the candidate that leaves least is far from the noise, all are weighed by what they leave from here on.
  void judge_misfit() {
    found_.none_near_noise =
        std::ranges::all_of(found_.models, [](const CandidateModel& c) { return far_from_noise(c.model); });
    if (!found_.none_near_noise) return;
    found_.base_log_evidence = log_evidence(base_, true);
    for (CandidateModel& c : found_.models) c.log_evidence = log_evidence(c.model, true);
  }

  /// The few pairs that stand close to the best set so far in the other forms of their effects, so that they are
  /// weighed over as many forms as a single effect is, and a third effect joins the best of them. Far from the noise a
  /// signature says little about which form is near: more pairs, and what came out best once more.
  void complete_pairs() {
    const bool far = found_.none_near_noise;
    const double close = far ? std::numeric_limits<double>::infinity() : thresholds::completed_within;
    const int most = far ? thresholds::completed_pairs_far : thresholds::completed_pairs;
    std::set<FormSet> tried;
    for (const CandidateModel& c : found_.models) tried.insert(forms_of(c.terms()));
    for (int round = 0; round < (far ? thresholds::rounds_far : 1); ++round) {
      weigh();
      std::vector<CandidateModel> pairs;
      for (const WeightedSet& w : found_.sets)
        if (w.ids.size() == 2 && found_.sets.front().log_evidence - w.log_evidence < close && std::ssize(pairs) < most)
          pairs.push_back(found_.models[w.best_candidate]);
      for (const CandidateModel& pair : pairs) fit_other_forms(pair, tried);
    }
  }

  /// A further effect beside the best candidate of as many.
  void extend_best(int effects) {
    if (const auto best = strongest_candidate(of_size(effects))) extend(*best);
  }

  /// The evidence of each set of effects, summed over the forms that were fitted.
  void weigh();

  /// What others have found beside other runs of the base model, fitted beside these from where that ended.
  void fit_again(const Candidates& others) {
    fit_each(others.models, [&](const CandidateModel& c) {
      return fitted(base_.shared_data(), base_.predictor().with(c.terms()), c.fit().restart);
    });
  }

  bool empty() const { return found_.models.empty(); }
  Candidates result(bool any_may_stand) && {
    if (!empty()) weigh();
    if (any_may_stand) found_.best = found_.sets.front().best_candidate;
    return std::move(found_);
  }

 private:
  /// A pair with one of its effects in another form, and where its fit starts.
  struct OtherForm {
    std::vector<Term> terms;
    CandidateStart start;
  };

  Term free_term(const bekker_wong::EffectForm& form) const { return make_term(form, all_runs_, true); }

  /// Fits what is asked for, several at once; those that balance join, in order.
  template <class Asked, class Fitted>
  void fit_each(const std::vector<Asked>& asked, const Fitted& fit_one) {
    std::vector<std::optional<CandidateModel>> found(asked.size());
    options_.pool.each(static_cast<int>(asked.size()), [&](int i, const Pulse& pulse) {
      pulse();
      auto model = fit_one(asked[i]);
      if (!model) return;
      std::set<std::string> ids;
      for (const Term& term : model->terms()) ids.insert(term.form->id);
      const double evidence = log_evidence(*model, found_.none_near_noise);
      found[i] = CandidateModel{std::move(ids), std::move(*model), evidence};
    });
    for (std::optional<CandidateModel>& candidate : found)
      if (candidate) found_.models.push_back(std::move(*candidate));
  }

  /// The candidate of largest evidence among those wanted.
  std::optional<std::size_t> strongest_candidate(const auto& wanted) const {
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < found_.models.size(); ++i)
      if (wanted(found_.models[i]) && (!best || found_.models[i].log_evidence > found_.models[*best].log_evidence))
        best = i;
    return best;
  }

  /// Which of these forms, fitted without the others, leaves least; null where none was.
  const CandidateModel* best_single(const FormSet& forms) const {
    const CandidateModel* best = nullptr;
    for (const CandidateModel& c : found_.models)
      if (c.terms().size() == 1 && forms.count(c.terms().front().form) && (!best || c.fit().chi2 < best->fit().chi2))
        best = &c;
    return best;
  }

  std::optional<FittedModel> fit_pair(const SignaturePair& pair) const;
  void extend(std::size_t index);
  std::optional<FittedModel> fit_other_form(const OtherForm& other) const;
  void fit_other_forms(const CandidateModel& from, std::set<FormSet>& tried);

  const FittedModel& base_;
  const Observations& all_runs_;
  const std::vector<Signature>& signatures_;
  const AttributionOptions& options_;
  Candidates found_;
};

/// A pair from where the better of its members ended by itself, if either was fitted; else both from the base model.
std::optional<FittedModel> Search::fit_pair(const SignaturePair& pair) const {
  const Signature *first = pair.a, *second = pair.b;
  const CandidateModel* single = best_single({first->term.form, second->term.form});
  if (single && single->terms().front().form == second->term.form) std::swap(first, second);
  CandidateStart start{&base_.fit(), {{1, estimate_of(*second)}}, pair.gain};
  if (single)
    start.from = &single->fit(), start.expected_drop -= base_.fit().chi2 - single->fit().chi2;
  else
    start.estimated[0] = estimate_of(*first);
  return fit_terms(base_, {free_term(*first->term.form), free_term(*second->term.form)}, start);
}

/// Adds to a candidate the effects that the signatures in its residual call for: candidates with one effect more.
void Search::extend(std::size_t index) {
  const FittedModel from = found_.models[index].model;
  const std::vector<Signature> signatures = residual_signatures(from, problem_of(from), options_.pool);
  const double p = family_wise_p(signatures, strongest(signatures), from.data().noise.typical_freedom(),
                                 options_.simulations / 2, options_.seed + 17 * from.terms().size());
  if (p > thresholds::family_level) return;
  const int added = static_cast<int>(from.terms().size());
  fit_each(strongest_forms(signatures, thresholds::max_refits / 2), [&](const Signature* s) {
    std::vector<Term> terms = from.terms();
    terms.push_back(free_term(*s->term.form));
    return fit_terms(base_, terms, {&from.fit(), {{added, estimate_of(*s)}}, s->score * s->score});
  });
}

/// A pair leaves no more than either effect does by itself: where its fit ended above that, once more from there.
std::optional<FittedModel> Search::fit_other_form(const OtherForm& other) const {
  auto found = fit_terms(base_, other.terms, other.start);
  const CandidateModel* single = best_single(forms_of(other.terms));
  if (!single || (found && found->fit().chi2 <= single->fit().chi2)) return found;
  const int joins = other.terms.front().form == single->terms().front().form ? 1 : 0;
  auto beside = fit_terms(base_, {single->terms().front(), other.terms[joins]},
                          {&single->fit(), {{1, other.start.estimated.at(joins)}}, 0.0});
  return beside && (!found || beside->fit().chi2 < found->fit().chi2) ? beside : found;
}

/// Fits a pair with each of the other forms of its effects in turn.
void Search::fit_other_forms(const CandidateModel& from, std::set<FormSet>& tried) {
  FormSet done;
  std::vector<OtherForm> others;
  for (const Signature& s : signatures_)
    for (int m = 0; m < std::ssize(from.terms()); ++m) {
      if (s.term.form->id != from.terms()[m].form->id || !(s.projected_norm > 0) || !done.insert(s.term.form).second)
        continue;
      std::vector<Term> terms = from.terms();
      terms[m] = free_term(*s.term.form);
      if (!tried.insert(forms_of(terms)).second) continue;
      std::map<int, std::vector<double>> estimated;
      for (int t = 0; t < std::ssize(terms); ++t) {
        estimated[t] = terms[t].defaults;  // shapes that suited the other form may be far off
        estimated[t].front() = from.fit().theta[from.model.predictor().amplitude_index(t)];
      }
      estimated[m] = estimate_of(s);
      others.push_back({std::move(terms), {&base_.fit(), estimated, base_.fit().chi2 - from.fit().chi2}});
    }
  fit_each(others, [&](const OtherForm& other) { return fit_other_form(other); });
}

void Search::weigh() {
  std::map<std::set<std::string>, WeightedSet> by_set;
  const std::vector<CandidateModel>& models = found_.models;
  const auto standing = [&](std::size_t i) { return models[i].log_evidence + log_prior(models[i].terms()); };
  double top = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < models.size(); ++i) top = std::max(top, standing(i));
  std::set<FormSet> seen;
  double total = 0.0;
  for (std::size_t i = 0; i < models.size(); ++i) {
    const bool repeated = !seen.insert(forms_of(models[i].terms())).second;
    WeightedSet& w =
        by_set.try_emplace(models[i].ids, WeightedSet{.ids = models[i].ids, .best_candidate = i}).first->second;
    const double share = repeated ? 0.0 : std::exp(standing(i) - top);
    w.weight += share;
    total += share;
    if (standing(i) > standing(w.best_candidate)) w.best_candidate = i;
  }
  found_.sets.clear();
  for (const auto& [ids, w] : by_set) found_.sets.push_back(w);
  for (WeightedSet& w : found_.sets) {
    w.log_evidence = w.weight > 0 ? top + std::log(w.weight) : -std::numeric_limits<double>::infinity();
    w.weight /= total;
  }
  std::ranges::stable_sort(found_.sets, [](const WeightedSet& x, const WeightedSet& y) { return x.weight > y.weight; });
}

/// From the strongest signatures to sets of up to three effects. further: beyond single effects, and one may stand.
Candidates search_beside(const FittedModel& base, const Observations& all_runs,
                         const std::vector<Signature>& signatures, bool further, const AttributionOptions& options) {
  Search search(base, all_runs, signatures, options);
  search.fit_singles();
  const bool stands_out = further && !search.empty();
  if (stands_out) {
    search.fit_pairs();
    search.extend_singles();
    search.judge_misfit();
    search.complete_pairs();
    for (int effects = 2; effects < thresholds::max_effects; ++effects) search.extend_best(effects);
  }
  return std::move(search).result(stands_out);
}

/// Candidates that a fit of all runs may still bring to the front: the models of the sets with the most weight, and
/// those of one effect, or of effects of the best set, whatever they leave.
Candidates worth_fitting_again(Candidates found) {
  if (found.models.empty()) return found;
  const std::set<std::string> best = found.models[found.sets.front().best_candidate].ids;
  std::set<std::size_t> kept;
  const auto keep_set = [&](const WeightedSet& w) {
    std::vector<std::size_t> forms;
    for (std::size_t i = 0; i < found.models.size(); ++i)
      if (found.models[i].ids == w.ids) forms.push_back(i);
    std::ranges::stable_sort(forms, [&](std::size_t a, std::size_t b) {
      return found.models[a].log_evidence > found.models[b].log_evidence;
    });
    for (std::size_t k = 0; k < forms.size() && k < thresholds::forms_fitted_again; ++k) kept.insert(forms[k]);
  };
  for (std::size_t s = 0; s < found.sets.size(); ++s)
    if (const WeightedSet& w = found.sets[s];
        s < thresholds::sets_fitted_again || std::includes(best.begin(), best.end(), w.ids.begin(), w.ids.end()))
      keep_set(w);
  std::vector<CandidateModel> models;
  for (const std::size_t i : kept) models.push_back(std::move(found.models[i]));
  found.models = std::move(models);
  return found;
}

/// On large campaigns the search is made beside pooled runs, and what it finds is fitted to all of them.
Candidates candidates_of(const FittedModel& base, const std::vector<Signature>& signatures, bool stands_out,
                         const AttributionOptions& options) {
  const Observations& all_runs = base.data().observations;
  const bool large = std::ssize(all_runs.rows) > thresholds::max_searched_rows;
  const auto few = large ? pooled(base, thresholds::max_searched_rows) : std::nullopt;
  if (!few) return search_beside(base, all_runs, signatures, stands_out, options);
  const Candidates rough = worth_fitting_again(search_beside(*few, all_runs, signatures, stands_out, options));
  Search search(base, all_runs, signatures, options);
  search.fit_again(rough);
  const bool any = stands_out && !search.empty();
  if (any) search.judge_misfit();
  return std::move(search).result(any);
}

}  // namespace

const WeightedSet& Candidates::weighed(const std::set<std::string>& ids) const {
  const auto found = std::ranges::find_if(sets, [&](const WeightedSet& w) { return w.ids == ids; });
  if (found == sets.end()) throw std::out_of_range("a set of effects that wasn't weighed");
  return *found;
}

Attribution attribute(const FittedModel& base, const AttributionOptions& options) {
  const LinearProblem problem = problem_of(base);
  std::vector<UnnamedKind> kinds = unnamed_kinds(base);
  const UnnamedEvidence unnamed = unnamed_evidence(problem, kinds);
  ResidualSignatures signatures{residual_signatures(base, problem, options.pool)};
  signatures.p_value = family_wise_p(signatures.all, strongest(signatures.all), base.data().noise.typical_freedom(),
                                     options.simulations, options.seed);
  signatures.simulations = options.simulations;
  const bool stands_out = signatures.p_value <= thresholds::family_level;
  Candidates candidates = candidates_of(base, signatures.all, stands_out, options);
  return {base, std::move(signatures), std::move(kinds), unnamed, std::move(candidates)};
}

double p_beside_others(const Attribution& found, const CandidateModel& candidate, int term,
                       const AttributionOptions& options) {
  std::vector<Term> others = candidate.terms();
  others.erase(others.begin() + term);
  const Index first = candidate.model.predictor().amplitude_index(term);
  const Index gone = candidate.terms()[term].free.size(), last = candidate.fit().theta.size() - first - gone;
  VectorXd start(first + last);
  start << candidate.fit().restart.head(first), candidate.fit().restart.tail(last);
  const auto without = fitted(found.base.shared_data(), found.base.predictor().with(others), start);
  if (!without) return 1.0;
  const std::vector<Signature> signatures = residual_signatures(*without, problem_of(*without), options.pool);
  std::vector<Signature> own;
  for (const Signature& s : signatures)
    if (s.term.form->id == candidate.terms()[term].form->id) own.push_back(s);
  return family_wise_p(signatures, strongest(own), found.base.data().noise.typical_freedom(), options.simulations,
                       options.seed);
}

using Eigen::MatrixXd;

MatrixXd model_discrepancy_columns(const FittedModel& base) {
  Observations own = base.data().observations;
  for (OperatingCondition& at : own.rows) {
    OperatingCondition bare;
    bare.load = at.load, bare.slip = at.slip;
    at = bare;
  }
  const MatrixXd functions = with_constant(smooth_basis(own, thresholds::discrepancy_functions));
  return in_every_channel(base.data(), base.fit().prediction, functions);
}

namespace {

/// The size at which the columns, together with whichever set of effects suits them, explain the data best.
double best_size(const Attribution& found, const MatrixXd& columns) {
  double best = thresholds::term_sizes.front(), most = -std::numeric_limits<double>::infinity();
  const auto weigh = [&](double log_evidence, const FittedModel& model) {
    const JoinedColumns joined(problem_of(model), columns);
    for (const double size : thresholds::term_sizes)
      if (const double sum = log_evidence + joined.gain(size); sum > most) most = sum, best = size;
  };
  weigh(found.candidates.base_log_evidence, found.base);
  for (const WeightedSet& w : found.candidates.sets)
    weigh(w.log_evidence, found.candidates.models[w.best_candidate].model);
  return best;
}

Candidates with_lower_evidence(Candidates candidates, double by) {
  candidates.base_log_evidence -= by;
  for (CandidateModel& c : candidates.models) c.log_evidence -= by;
  for (WeightedSet& w : candidates.sets) w.log_evidence -= by;
  return candidates;
}

}  // namespace

std::optional<DiscrepancyAttribution> attribute_with_model_discrepancy(const Attribution& first,
                                                                       const AttributionOptions& options) {
  if (first.candidates.none_near_noise) return std::nullopt;
  MatrixXd columns = model_discrepancy_columns(first.base);
  const double size = best_size(first, columns);
  columns *= size;
  Dataset data = first.base.data();
  data.whitening = data.whitening.beside(columns);
  const auto shared = std::make_shared<const Dataset>(std::move(data));
  const auto base = fitted(shared, first.base.predictor().over(shared->observations), first.base.fit().restart);
  if (!base) return std::nullopt;
  Attribution found = attribute(*base, options);
  if (found.candidates.none_near_noise) return std::nullopt;
  const double narrowed = log_narrowing(columns.transpose() * columns, VectorXd::Ones(columns.cols()));
  const double price = narrowed + std::log(static_cast<double>(thresholds::term_sizes.size()));
  found.candidates = with_lower_evidence(std::move(found.candidates), price);
  return DiscrepancyAttribution{size, std::move(found)};
}

}  // namespace soilbin::compare
