#include "compare/loop/identify.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "compare/loop/base_fit.hpp"
#include "compare/loop/candidate_fit.hpp"

namespace soilbin::compare {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// The strongest signatures, at most three forms an effect.
std::vector<const Signature*> contenders(const std::vector<Signature>& signatures, int most) {
  std::vector<const Signature*> order;
  for (const Signature& s : signatures)
    if (s.projected_norm > 0 && s.strength() > 1.0) order.push_back(&s);
  std::stable_sort(order.begin(), order.end(), [](auto a, auto b) { return a->strength() > b->strength(); });
  std::vector<const Signature*> chosen;
  std::map<std::string, int> forms;
  std::set<const bekker_wong::EffectForm*> taken;
  for (const Signature* s : order) {
    if (static_cast<int>(chosen.size()) >= most) break;
    if (taken.count(s->term.form) || forms[s->term.form->id] >= 3) continue;
    taken.insert(s->term.form);
    ++forms[s->term.form->id];
    chosen.push_back(s);
  }
  return chosen;
}

/// The form's parameters where the trace puts them.
std::vector<double> reach_of(const Signature& s) {
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

/// The pairs of largest gain, at most two a pair of effects.
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
      if (det < 0.02) continue;
      const double u = (a.score - c * b.score) / det, v = (b.score - c * a.score) / det;
      if ((a.one_sided && u < 0) || (b.one_sided && v < 0)) continue;
      pairs.push_back({u * a.score + v * b.score, &a, &b});
    }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const SignaturePair& x, const SignaturePair& y) { return x.gain > y.gain; });
  std::vector<SignaturePair> best;
  std::map<std::set<std::string>, int> sets;
  for (const SignaturePair& pair : pairs) {
    if (static_cast<int>(best.size()) >= most) break;
    if (sets[{pair.a->term.form->id, pair.b->term.form->id}]++ < 2) best.push_back(pair);
  }
  return best;
}

using FormSet = std::set<const bekker_wong::EffectForm*>;

FormSet forms_of(const std::vector<Term>& terms) {
  FormSet forms;
  for (const Term& term : terms) forms.insert(term.form);
  return forms;
}

/// Which of these forms leaves least alone; null where none was fitted.
const CandidateModel* best_alone(const Identification& id, const FormSet& forms) {
  const CandidateModel* best = nullptr;
  for (const CandidateModel& candidate : id.candidates)
    if (candidate.terms.size() == 1 && forms.count(candidate.terms.front().form) &&
        (!best || candidate.fit.chi2 < best->fit.chi2))
      best = &candidate;
  return best;
}

/// A pair from where the better of its members ended alone, if either was fitted; else both from the base model.
std::optional<CandidateModel> refit_pair(const Campaign& campaign, const Identification& id,
                                         const SignaturePair& pair) {
  const Signature *first = pair.a, *second = pair.b;
  const CandidateModel* alone = best_alone(id, {first->term.form, second->term.form});
  if (alone && alone->terms.front().form == second->term.form) std::swap(first, second);
  CandidateStart start{id.base.restart, id.base.chi2, {{1, reach_of(*second)}}, pair.gain};
  if (alone)
    start.known = alone->fit.restart, start.chi2 = alone->fit.chi2, start.promised -= id.base.chi2 - alone->fit.chi2;
  else
    start.traced[0] = reach_of(*first);
  return refit(
      campaign, id,
      {make_term(*first->term.form, id.observations, true), make_term(*second->term.form, id.observations, true)},
      start);
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
  constexpr double rarer = 3.5;  // several effects at once are thirty times rarer an effect
  return sum - rarer * static_cast<double>(terms.size() - 1);
}

/// The evidence of each set of effects, summed over the forms that were refitted.
void weigh(Identification& id) {
  std::map<std::set<std::string>, Weighted> by_set;
  const auto standing = [&](std::size_t i) {
    return id.candidates[i].log_evidence + log_prior(id.candidates[i].terms);
  };
  double top = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < id.candidates.size(); ++i) top = std::max(top, standing(i));
  std::set<FormSet> seen;
  double total = 0.0;
  for (std::size_t i = 0; i < id.candidates.size(); ++i) {
    const bool repeated = !seen.insert(forms_of(id.candidates[i].terms)).second;
    Weighted& w = by_set.try_emplace(id.candidates[i].ids, Weighted{.ids = id.candidates[i].ids, .best_candidate = i})
                      .first->second;
    const double share = repeated ? 0.0 : std::exp(standing(i) - top);
    w.weight += share;
    total += share;
    if (standing(i) > standing(w.best_candidate)) w.best_candidate = i;
  }
  id.weights.clear();
  for (const auto& [ids, w] : by_set) id.weights.push_back(w);
  for (Weighted& w : id.weights) {
    w.log_evidence = w.weight > 0 ? top + std::log(w.weight) : -std::numeric_limits<double>::infinity();
    w.weight /= total;
  }
  std::stable_sort(id.weights.begin(), id.weights.end(),
                   [](const Weighted& x, const Weighted& y) { return x.weight > y.weight; });
}

/// Fits what is asked for, several at once; the candidates whose fit balances join, in order.
template <class Asked, class Refit>
void join(Identification& id, const IdentifyOptions& options, const std::vector<Asked>& asked, const Refit& refit_one) {
  std::vector<std::optional<CandidateModel>> found(asked.size());
  options.pool.each(static_cast<int>(asked.size()), [&](int i, const Pulse& pulse) {
    pulse();
    found[static_cast<std::size_t>(i)] = refit_one(asked[static_cast<std::size_t>(i)]);
  });
  for (std::optional<CandidateModel>& candidate : found)
    if (candidate) id.candidates.push_back(std::move(*candidate));
}

double strongest(const std::vector<Signature>& signatures) {
  double most = 0.0;
  for (const Signature& s : signatures)
    if (s.projected_norm > 0) most = std::max(most, s.strength());
  return most;
}

/// Adds to a candidate the effects that a trace of its residual calls for: candidates with one effect more.
void extend(const Campaign& campaign, Identification& id, std::size_t index, const IdentifyOptions& options) {
  const CandidateModel from = id.candidates[index];
  const WheelPredictor predictor(campaign, id.observations, from.terms);
  const LinearProblem problem = problem_of(id, predictor, from.fit);
  const std::vector<Signature> signatures =
      residual_signatures({campaign, id.observations, *id.whitening, predictor, from.fit, problem}, options.pool);
  const double p = family_wise_p(signatures, strongest(signatures), id.noise.typical_freedom(), options.simulations / 2,
                                 options.seed + 17 * from.terms.size());
  if (p > options.level) return;
  const int added = static_cast<int>(from.terms.size());
  join(id, options, contenders(signatures, options.refits / 2), [&](const Signature* s) {
    std::vector<Term> terms = from.terms;
    terms.push_back(make_term(*s->term.form, id.observations, true));
    return refit(campaign, id, terms, {from.fit.restart, from.fit.chi2, {{added, reach_of(*s)}}, s->score * s->score});
  });
}

/// The candidate of largest evidence among those wanted.
template <class Wanted>
std::optional<std::size_t> strongest_candidate(const Identification& id, const Wanted& wanted) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < id.candidates.size(); ++i)
    if (wanted(id.candidates[i]) && (!best || id.candidates[i].log_evidence > id.candidates[*best].log_evidence))
      best = i;
  return best;
}

/// Where even the candidate that leaves least is far from the noise, all are weighed by what they leave from here on.
void judge_misfit(const Campaign& campaign, Identification& id) {
  id.none_near_noise = std::all_of(id.candidates.begin(), id.candidates.end(),
                                   [&](const CandidateModel& candidate) { return far_from_noise(id, candidate.fit); });
  if (!id.none_near_noise) return;
  id.base_log_evidence = evidence_of(id, WheelPredictor(campaign, id.observations), id.base);
  for (CandidateModel& candidate : id.candidates)
    candidate.log_evidence = evidence_of(id, WheelPredictor(campaign, id.observations, candidate.terms), candidate.fit);
}

const auto of_size = [](std::size_t n) { return [n](const CandidateModel& r) { return r.ids.size() == n; }; };

/// Forward from the best single effect, then from each member of the best pair: another partner may suit it better.
void extend_singles(const Campaign& campaign, Identification& id, const IdentifyOptions& options) {
  std::set<std::size_t> extended;
  const auto once = [&](std::optional<std::size_t> from) {
    if (from && extended.insert(*from).second) extend(campaign, id, *from, options);
  };
  once(strongest_candidate(id, of_size(1)));
  if (const auto pair = strongest_candidate(id, of_size(2)); pair) {
    const std::set<std::string> members = id.candidates[*pair].ids;
    for (const std::string& member : members)
      once(strongest_candidate(id, [&](const CandidateModel& r) { return r.ids == std::set<std::string>{member}; }));
  }
}

/// A pair with one of its effects in another form, and where its fit starts.
struct OtherForm {
  std::vector<Term> terms;
  CandidateStart start;
};

/// It leaves no more than either effect does alone: where its fit ended above that, once more from there.
std::optional<CandidateModel> refit_in_other_form(const Campaign& campaign, const Identification& id,
                                                  const OtherForm& other) {
  auto found = refit(campaign, id, other.terms, other.start);
  const CandidateModel* alone = best_alone(id, forms_of(other.terms));
  if (!alone || (found && found->fit.chi2 <= alone->fit.chi2)) return found;
  const int joins = other.terms.front().form == alone->terms.front().form ? 1 : 0;
  const std::vector<Term> terms = {alone->terms.front(), other.terms[static_cast<std::size_t>(joins)]};
  auto beside =
      refit(campaign, id, terms, {alone->fit.restart, alone->fit.chi2, {{1, other.start.traced.at(joins)}}, 0.0});
  return beside && (!found || beside->fit.chi2 < found->fit.chi2) ? beside : found;
}

/// Refits a pair with each of the other forms of its effects in turn.
void other_forms(const Campaign& campaign, Identification& id, const CandidateModel& from, std::set<FormSet>& fitted,
                 const IdentifyOptions& options) {
  const WheelPredictor predictor(campaign, id.observations, from.terms);
  std::set<const bekker_wong::EffectForm*> done;
  std::vector<OtherForm> others;
  for (const Signature& s : id.signatures)
    for (std::size_t m = 0; m < from.terms.size(); ++m) {
      if (s.term.form->id != from.terms[m].form->id || !(s.projected_norm > 0) || !done.insert(s.term.form).second)
        continue;
      std::vector<Term> terms = from.terms;
      terms[m] = make_term(*s.term.form, id.observations, true);
      if (!fitted.insert(forms_of(terms)).second) continue;
      std::map<int, std::vector<double>> traced;
      for (int t = 0; t < static_cast<int>(terms.size()); ++t) {
        traced[t] = terms[static_cast<std::size_t>(t)].defaults;  // shapes that suited the other form may be far off
        traced[t].front() = from.fit.theta[predictor.amplitude_index(t)];
      }
      traced[static_cast<int>(m)] = reach_of(s);
      others.push_back({std::move(terms), {id.base.restart, id.base.chi2, traced, id.base.chi2 - from.fit.chi2}});
    }
  join(id, options, others, [&](const OtherForm& other) { return refit_in_other_form(campaign, id, other); });
}

/// The same for the few pairs that stand close to the best set so far, so that they are weighed over as many forms as a
/// single effect is, and a third effect joins the best of them. Far from the noise a trace says little about which form
/// is near: more pairs, and what came out best once more.
void complete_pairs(const Campaign& campaign, Identification& id, const IdentifyOptions& options) {
  const double close =
      id.none_near_noise ? std::numeric_limits<double>::infinity() : 15.0;  // ln evidence: what forms may add
  const int most = id.none_near_noise ? 5 : 3, rounds = id.none_near_noise ? 2 : 1;
  std::set<FormSet> fitted;
  for (const CandidateModel& candidate : id.candidates) fitted.insert(forms_of(candidate.terms));
  for (int round = 0; round < rounds; ++round) {
    weigh(id);
    std::vector<CandidateModel> pairs;
    for (const Weighted& w : id.weights)
      if (w.ids.size() == 2 && id.weights.front().log_evidence - w.log_evidence < close &&
          static_cast<int>(pairs.size()) < most)
        pairs.push_back(id.candidates[w.best_candidate]);
    for (const CandidateModel& pair : pairs) other_forms(campaign, id, pair, fitted, options);
  }
}

}  // namespace

void name_effects(const Campaign& campaign, const IdentifyOptions& options, Identification& id) {
  const WheelPredictor base(campaign, id.observations);
  const LinearProblem problem = problem_of(id, base, id.base);
  id.base_log_evidence = log_evidence(problem, {});
  id.unnamed_gain =
      unnamed_gain(problem, unnamed_families(id.observations, id.noise, *id.whitening, id.base.prediction));
  id.signatures = residual_signatures({campaign, id.observations, *id.whitening, base, id.base, problem}, options.pool);
  id.p_value = family_wise_p(id.signatures, strongest(id.signatures), id.noise.typical_freedom(), options.simulations,
                             options.seed);
  join(id, options, contenders(id.signatures, options.refits), [&](const Signature* s) {
    return refit(campaign, id, {make_term(*s->term.form, id.observations, true)},
                 {id.base.restart, id.base.chi2, {{0, reach_of(*s)}}, s->score * s->score});
  });
  if (id.p_value > options.level || id.candidates.empty()) {
    if (!id.candidates.empty()) weigh(id);
    return;
  }
  join(id, options, strongest_pairs(id.signatures, options.refits / 2),
       [&](const SignaturePair& pair) { return refit_pair(campaign, id, pair); });
  extend_singles(campaign, id, options);
  judge_misfit(campaign, id);
  complete_pairs(campaign, id, options);
  for (int effects = 2; effects < options.most_effects; ++effects)
    if (const auto best = strongest_candidate(id, of_size(static_cast<std::size_t>(effects))))
      extend(campaign, id, *best, options);
  weigh(id);
  prefer(campaign, id, id.weights.front().best_candidate);
}

Identification identify(const Campaign& campaign, const Observations& observations, const IdentifyOptions& options) {
  Identification id;
  settle_base(campaign, observations, options, id);
  name_effects(campaign, options, id);
  return id;
}

double p_beside_others(const Campaign& campaign, const Identification& id, const CandidateModel& candidate,
                       std::size_t term, const IdentifyOptions& options) {
  std::vector<Term> others = candidate.terms;
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(term));
  const WheelPredictor predictor(campaign, id.observations, others), whole(campaign, id.observations, candidate.terms);
  const Index first = whole.amplitude_index(static_cast<int>(term));
  const Index gone = static_cast<Index>(candidate.terms[term].free.size()),
              last = candidate.fit.theta.size() - first - gone;
  VectorXd start(candidate.fit.theta.size() - gone);
  start << candidate.fit.restart.head(first), candidate.fit.restart.tail(last);
  const auto without = fit(predictor, id.observations.values(), *id.whitening, start);
  if (!without) return 1.0;
  const LinearProblem problem = problem_of(id, predictor, *without);
  const std::vector<Signature> signatures =
      residual_signatures({campaign, id.observations, *id.whitening, predictor, *without, problem}, options.pool);
  std::vector<Signature> own;
  for (const Signature& s : signatures)
    if (s.term.form->id == candidate.terms[term].form->id) own.push_back(s);
  return family_wise_p(signatures, strongest(own), id.noise.typical_freedom(), options.simulations, options.seed);
}

std::map<std::string, double> cosines(const Identification& id, const std::string& effect) {
  std::map<std::string, double> most;
  for (const Signature& a : id.signatures)
    for (const Signature& b : id.signatures) {
      if (a.term.form->id != effect || b.term.form->id == effect || !(a.projected_norm > 0) || !(b.projected_norm > 0))
        continue;
      double& c = most[b.term.form->id];
      c = std::max(c, std::abs(a.direction.dot(b.direction)));
    }
  return most;
}

std::optional<std::size_t> best_subset(const Identification& id, std::size_t candidate) {
  const std::set<std::string>& all = id.candidates[candidate].ids;
  for (const Weighted& w : id.weights)
    if (w.ids.size() + 1 == all.size() && std::includes(all.begin(), all.end(), w.ids.begin(), w.ids.end()))
      return w.best_candidate;
  return std::nullopt;
}

void prefer(const Campaign& campaign, Identification& id, std::size_t candidate) {
  id.best = candidate;
  const CandidateModel& best = id.candidates[candidate];
  const WheelPredictor predictor(campaign, id.observations, best.terms);
  const LinearProblem after = problem_of(id, predictor, best.fit);
  id.residual_unnamed_gain =
      unnamed_gain(after, unnamed_families(id.observations, id.noise, *id.whitening, id.base.prediction));
}

}  // namespace soilbin::compare
