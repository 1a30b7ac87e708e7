#include "compare/loop/identify.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "scenario/errors.hpp"

namespace soilbin::compare {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Noise of 5 % of each channel's range: where the first fit starts.
NoiseFloor first_guess(const Observations& observations) {
  NoiseFloor guess;
  for (int channel = 0; channel < channel_count; ++channel) {
    double low = 0, high = 0;
    bool any = false;
    for (const Cell& cell : observations.cells) {
      if (cell.channel != channel) continue;
      low = any ? std::min(low, cell.value) : cell.value;
      high = any ? std::max(high, cell.value) : cell.value;
      any = true;
    }
    const double range = std::max({high - low, 0.1 * std::abs(high), 0.1 * std::abs(low), 1e-9});
    guess.channels[static_cast<std::size_t>(channel)] = {.measured = any, .floor = 0.05 * range};
  }
  return guess;
}

NoiseData noise_data(const WheelPredictor& predictor, const Observations& observations, const Fit& fit) {
  NoiseData data;
  data.prediction = fit.prediction;
  const Index soil = predictor.soil_parameters();
  data.soil_columns.resize(fit.prediction.size(), soil);
  VectorXd shift(soil);
  for (Index p = 0; p < soil; ++p) {
    const FreeParameter& parameter = predictor.parameters()[static_cast<std::size_t>(p)];
    data.soil_columns.col(p) = fit.jacobian.col(p) * parameter.prior_sd;
    shift[p] = (fit.theta[p] - parameter.prior) / parameter.prior_sd;
  }
  data.residual = observations.values() - fit.prediction + data.soil_columns * shift;
  return data;
}

Fit must_fit(const WheelPredictor& predictor, const Observations& observations, const Whitening& whitening,
             const VectorXd& start) {
  auto found = fit(predictor, observations.values(), whitening, start);
  if (!found) throw NoSolution("no soil near the declared one carries the wheel in every run of this campaign");
  return *found;
}

/// Base fit and noise, in turn until they agree; outliers set aside on the way.
void settle_base(const Campaign& campaign, const Observations& given, const IdentifyOptions& options,
                 Identification& id) {
  constexpr double outlier_limit = 5.0, most_outliers = 0.1;
  id.observations = given;
  id.outlier.assign(given.cells.size(), false);
  NoiseFloor noise = first_guess(given);
  VectorXd start = WheelPredictor(campaign, given).start();
  for (int round = 0; round < 4; ++round) {
    const WheelPredictor predictor(campaign, id.observations);
    const VectorXd about = round == 0 ? id.observations.values() : id.base.prediction;
    id.whitening = std::make_shared<Whitening>(id.observations, noise, about);
    id.base = must_fit(predictor, id.observations, *id.whitening, start);
    start = id.base.theta;
    if (round == 3) break;
    const NoiseEstimate estimate = estimate_noise(id.observations, noise_data(predictor, id.observations, id.base));
    noise = estimate.floor;
    id.noise = noise;
    if (!options.drop_outliers || round == 2) continue;
    std::vector<bool> drop(id.observations.cells.size());
    for (std::size_t i = 0; i < drop.size(); ++i) drop[i] = estimate.outlier_score[i] > outlier_limit;
    const auto count = std::count(drop.begin(), drop.end(), true);
    if (count == 0 || static_cast<double>(count) > most_outliers * static_cast<double>(drop.size())) continue;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < id.outlier.size(); ++i)
      if (!id.outlier[i]) id.outlier[i] = drop[kept++];
    id.observations = without_cells(given, id.outlier);
    VectorXd remaining(static_cast<Index>(id.observations.cells.size()));
    Index to = 0;
    for (std::size_t i = 0; i < drop.size(); ++i)
      if (!drop[i]) remaining[to++] = id.base.prediction[static_cast<Index>(i)];
    id.base.prediction = remaining;
  }
}

/// What the term adds to the cells at the fit.
VectorXd contribution_of(const WheelPredictor& predictor, const Fit& fit, int term) {
  VectorXd theta = fit.theta, without;
  theta[predictor.amplitude_index(term)] = 0.0;
  if (!predictor.predict(theta, without)) return VectorXd::Zero(fit.prediction.size());
  return fit.prediction - without;
}

/// Share of a contribution that the soil's values, as far as their priors let them, could not have made.
double share_kept(const Identification& id, const WheelPredictor& predictor, const Fit& fit,
                  const VectorXd& contribution) {
  std::vector<Index> soil;
  for (std::size_t c = 0; c < fit.column_parameter.size(); ++c)
    if (fit.column_parameter[c] < predictor.soil_parameters()) soil.push_back(static_cast<Index>(c));
  MatrixXd columns(fit.columns.rows(), static_cast<Index>(soil.size()));
  for (std::size_t c = 0; c < soil.size(); ++c) columns.col(static_cast<Index>(c)) = fit.columns.col(soil[c]);
  VectorXd whole = VectorXd::Zero(fit.columns.rows());
  whole.head(contribution.size()) = (*id.whitening)(contribution);
  const double size = whole.norm();
  return size > 0 ? Projector(columns).vector(whole).norm() / size : 0.0;
}

/// Form tolerance of every term, shrunk by the root of the share that the soil's values could not have made: a form
/// that is almost a change of soil would else be free to be anything. (Root: found best on the tuning sets among 0,
/// 1/2, 1.)
MatrixXd tolerance_of(const Identification& id, const WheelPredictor& predictor, const Fit& fit) {
  MatrixXd all(fit.prediction.size(), 0);
  for (int t = 0; t < static_cast<int>(predictor.terms().size()); ++t) {
    const VectorXd contribution = contribution_of(predictor, fit, t);
    const double tolerance = predictor.terms()[static_cast<std::size_t>(t)].form->form_tolerance *
                             std::sqrt(share_kept(id, predictor, fit, contribution));
    const MatrixXd more = form_columns(id.observations, *id.whitening, contribution, tolerance);
    MatrixXd joined(all.rows(), all.cols() + more.cols());
    joined << all, more;
    all = joined;
  }
  return all;
}

LinearProblem problem_of(const Identification& id, const WheelPredictor& predictor, const Fit& fit) {
  return linear_problem(predictor, fit, static_cast<Index>(id.observations.cells.size()),
                        tolerance_of(id, predictor, fit));
}

/// Fits the terms in full, from the amplitudes as traced; from smaller ones as well where that gained less than half
/// of what the trace promised (expected_gain, in chi2).
std::optional<Rival> refit(const Campaign& campaign, const Identification& id, const std::vector<Term>& terms,
                           const std::vector<double>& amplitudes, double expected_gain) {
  const WheelPredictor predictor(campaign, id.observations, terms);
  std::optional<Rival> best;
  for (const double share : {1.0, 0.3}) {
    VectorXd start = predictor.start();
    start.head(predictor.soil_parameters()) = id.base.theta.head(predictor.soil_parameters());
    for (std::size_t t = 0; t < terms.size(); ++t) {
      const bekker_wong::EffectParameter& p = terms[t].form->parameters.front();
      start[predictor.amplitude_index(static_cast<int>(t))] =
          std::clamp(share * amplitudes[t], p.lower + 1e-3 * (p.upper - p.lower), p.upper);
    }
    VectorXd prediction;
    for (int halving = 0; halving < 6 && !predictor.predict(start, prediction); ++halving)
      for (std::size_t t = 0; t < terms.size(); ++t) start[predictor.amplitude_index(static_cast<int>(t))] *= 0.5;
    auto found = fit(predictor, id.observations.values(), *id.whitening, start);
    if (!found || (best && found->chi2 >= best->fit.chi2)) continue;
    const bool enough = found->chi2 < id.base.chi2 - 0.5 * expected_gain;
    Rival rival{.ids = {}, .terms = terms, .fit = std::move(*found), .log_evidence = 0.0};
    for (const Term& term : terms) rival.ids.insert(term.form->id);
    best = std::move(rival);
    if (enough) break;
  }
  if (best) best->log_evidence = log_evidence(problem_of(id, predictor, best->fit), static_cast<int>(terms.size()));
  return best;
}

/// The strongest signatures, at most two forms an effect, within reach of the strongest of all.
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

double reach_of(const Signature& s) {
  const bekker_wong::EffectParameter& p = s.term.form->parameters.front();
  return std::clamp(s.amplitude, p.lower, p.upper);
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

/// ln prior of one rival: an effect among about twenty, a form among the effect's, and, where physics fixes the sign,
/// half the amplitudes to choose from.
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
  const auto standing = [&](std::size_t i) { return id.rivals[i].log_evidence + log_prior(id.rivals[i].terms); };
  double top = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < id.rivals.size(); ++i) top = std::max(top, standing(i));
  std::set<std::vector<const bekker_wong::EffectForm*>> seen;
  double total = 0.0;
  for (std::size_t i = 0; i < id.rivals.size(); ++i) {
    std::vector<const bekker_wong::EffectForm*> forms;
    for (const Term& term : id.rivals[i].terms) forms.push_back(term.form);
    std::sort(forms.begin(), forms.end());
    const bool repeated = !seen.insert(forms).second;
    Weighted& w = by_set.try_emplace(id.rivals[i].ids, Weighted{id.rivals[i].ids, 0.0, i}).first->second;
    const double share = repeated ? 0.0 : std::exp(standing(i) - top);
    w.weight += share;
    total += share;
    if (standing(i) > standing(w.best_rival)) w.best_rival = i;
  }
  id.weights.clear();
  for (const auto& [ids, w] : by_set) id.weights.push_back(w);
  for (Weighted& w : id.weights) w.weight /= total;
  std::stable_sort(id.weights.begin(), id.weights.end(),
                   [](const Weighted& x, const Weighted& y) { return x.weight > y.weight; });
}

double strongest(const std::vector<Signature>& signatures) {
  double most = 0.0;
  for (const Signature& s : signatures)
    if (s.projected_norm > 0) most = std::max(most, s.strength());
  return most;
}

/// Adds to a rival the effects that a trace of its residual calls for: rivals with one effect more.
void extend(const Campaign& campaign, Identification& id, std::size_t index, const IdentifyOptions& options) {
  const Rival from = id.rivals[index];
  const WheelPredictor predictor(campaign, id.observations, from.terms);
  const LinearProblem problem = problem_of(id, predictor, from.fit);
  const std::vector<Signature> signatures =
      trace({campaign, id.observations, *id.whitening, predictor, from.fit, problem});
  const double p = family_wise_p(signatures, strongest(signatures), id.noise.typical_freedom(), options.simulations / 2,
                                 options.seed + 17 * from.terms.size());
  if (p > options.level) return;
  for (const Signature* s : contenders(signatures, options.refits / 3)) {
    std::vector<Term> terms = from.terms;
    terms.push_back(make_term(*s->term.form, id.observations, true));
    std::vector<double> amplitudes;
    for (int t = 0; t < static_cast<int>(from.terms.size()); ++t)
      amplitudes.push_back(from.fit.theta[predictor.amplitude_index(t)]);
    amplitudes.push_back(reach_of(*s));
    const double expected = id.base.chi2 - from.fit.chi2 + s->score * s->score;
    if (auto rival = refit(campaign, id, terms, amplitudes, expected)) id.rivals.push_back(std::move(*rival));
  }
}

}  // namespace

Identification identify(const Campaign& campaign, const Observations& observations, const IdentifyOptions& options) {
  Identification id;
  settle_base(campaign, observations, options, id);
  const WheelPredictor base(campaign, id.observations);
  const LinearProblem problem = problem_of(id, base, id.base);
  id.base_log_evidence = log_evidence(problem, 0);
  id.unnamed_gain =
      unnamed_gain(problem, unnamed_families(id.observations, id.noise, *id.whitening, id.base.prediction));
  id.signatures = trace({campaign, id.observations, *id.whitening, base, id.base, problem});
  id.p_value = family_wise_p(id.signatures, strongest(id.signatures), id.noise.typical_freedom(), options.simulations,
                             options.seed);
  for (const Signature* s : contenders(id.signatures, options.refits))
    if (auto rival =
            refit(campaign, id, {make_term(*s->term.form, id.observations, true)}, {reach_of(*s)}, s->score * s->score))
      id.rivals.push_back(std::move(*rival));
  if (id.p_value > options.level || id.rivals.empty()) {
    if (!id.rivals.empty()) weigh(id);
    return id;
  }
  for (const SignaturePair& pair : strongest_pairs(id.signatures, options.refits / 2))
    if (auto rival = refit(campaign, id,
                           {make_term(*pair.a->term.form, id.observations, true),
                            make_term(*pair.b->term.form, id.observations, true)},
                           {reach_of(*pair.a), reach_of(*pair.b)}, pair.gain))
      id.rivals.push_back(std::move(*rival));
  for (int effects = 1; effects < options.most_effects; ++effects) {
    std::size_t best = id.rivals.size();
    for (std::size_t i = 0; i < id.rivals.size(); ++i)
      if (static_cast<int>(id.rivals[i].ids.size()) == effects &&
          (best == id.rivals.size() || id.rivals[i].log_evidence > id.rivals[best].log_evidence))
        best = i;
    if (best < id.rivals.size()) extend(campaign, id, best, options);
  }
  weigh(id);
  prefer(campaign, id, id.weights.front().best_rival);
  return id;
}

std::optional<std::size_t> best_subset(const Identification& id, std::size_t rival) {
  const std::set<std::string>& all = id.rivals[rival].ids;
  for (const Weighted& w : id.weights)
    if (w.ids.size() + 1 == all.size() && std::includes(all.begin(), all.end(), w.ids.begin(), w.ids.end()))
      return w.best_rival;
  return std::nullopt;
}

void prefer(const Campaign& campaign, Identification& id, std::size_t rival) {
  id.best = rival;
  const Rival& best = id.rivals[rival];
  const WheelPredictor predictor(campaign, id.observations, best.terms);
  const LinearProblem after = problem_of(id, predictor, best.fit);
  id.residual_unnamed_gain =
      unnamed_gain(after, unnamed_families(id.observations, id.noise, *id.whitening, id.base.prediction));
}

}  // namespace soilbin::compare
