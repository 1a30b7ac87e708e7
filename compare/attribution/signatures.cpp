#include "compare/attribution/signatures.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <random>

#include "compare/fit/factorizations.hpp"

namespace soilbin::compare {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// theta of a model with one more term at the given amplitude.
VectorXd extended(const VectorXd& theta, const Term& term, double amplitude) {
  VectorXd longer(theta.size() + term.free.size());
  longer.head(theta.size()) = theta;
  longer[theta.size()] = amplitude;
  return longer;
}

/// Change of the cells by the term at this amplitude, halved until the soil carries every row or nearly does: a fit may
/// stand where the least push makes it give way.
bool secant(const FittedModel& model, const Term& term, double& amplitude, VectorXd& change) {
  const WheelPredictor predictor = model.predictor().with({term});
  BalanceMemory memory = model.fit().balance;
  for (int attempt = 0; attempt < 8; ++attempt, amplitude *= 0.5) {
    if (!predictor.predict(extended(model.fit().theta, term, amplitude), change, memory)) continue;
    change -= model.fit().prediction;
    if (change.allFinite()) return true;
  }
  return false;
}

/// What signatures are taken of: a model, the linear problem about its fit, and the projector off that.
struct Base {
  const FittedModel& model;
  const LinearProblem& problem;
  Projector off;
};

Signature signature_of(const Base& base, const Term& term, double amplitude, const VectorXd& change) {
  Signature s;
  s.term = term;
  const bekker_wong::EffectParameter& p = term.form->parameters.front();
  s.one_sided = p.lower >= 0.0;
  s.white = base.model.data().whitening(VectorXd(change / amplitude));
  const VectorXd rest = base.off.vector(base.problem.padded(s.white));
  const double whole = s.white.norm();
  s.projected_norm = rest.norm();
  s.share_kept = whole > 0 ? s.projected_norm / whole : 0.0;
  const double reach = std::max(std::abs(p.lower), std::abs(p.upper));
  if (!(s.projected_norm * reach > thresholds::min_signature) || !(s.share_kept > thresholds::min_share_kept)) {
    s.projected_norm = 0.0;
    return s;
  }
  s.direction = rest / s.projected_norm;
  s.score = s.direction.dot(base.problem.residual);
  s.amplitude = s.score / s.projected_norm;
  s.std_error = 1.0 / s.projected_norm;
  s.detectable = std::sqrt(thresholds::detectable_noncentrality) / s.projected_norm;
  s.testable = s.detectable <= reach;
  return s;
}

/// Declared, fitted already, or not in data that were made so.
bool is_no_candidate(const FittedModel& model, const std::string& id) {
  if (model.data().campaign->impossible.contains(id)) return true;
  const auto& terms = model.terms();
  const auto& declared = model.data().campaign->effects;
  return std::ranges::any_of(terms, [&](const Term& t) { return t.form->id == id; }) ||
         std::ranges::any_of(declared, [&](const EffectChoice& c) { return c.id == id; });
}

/// A form as its reference values may lie: at the observations' mean, and by a standard deviation to either side.
/// About its mean a drift leaves little that an instrument zeroed before the first run would show.
std::vector<Term> placed(const bekker_wong::EffectForm& form, const Observations& observations) {
  std::vector<Term> terms = {make_term(form, observations, false)};
  for (std::size_t i = 1; i < form.parameters.size(); ++i)
    for (const double side : {-1.0, 1.0}) {
      if (form.parameters[i].centred_on.empty() || !(terms.front().spread[i] > 0.0)) continue;
      Term term = terms.front();
      term.defaults[i] =
          std::clamp(term.defaults[i] + side * term.spread[i], form.parameters[i].lower, form.parameters[i].upper);
      terms.push_back(std::move(term));
    }
  return terms;
}

/// Two secants of a term: one near 0, one where it moves the cells by some sd off the soil's values.
void add_signatures(const Base& base, const Term& term, std::vector<Signature>& signatures) {
  const bekker_wong::EffectParameter& p = term.form->parameters.front();
  const double typical = p.fallback != 0.0 ? p.fallback : 0.1 * p.upper;
  VectorXd change;
  double amplitude = thresholds::small_secant * typical;
  if (!secant(base.model, term, amplitude, change)) return;
  signatures.push_back(signature_of(base, term, amplitude, change));
  const Signature& small = signatures.back();
  const double sign = small.one_sided || small.score > 0 ? 1.0 : -1.0;
  amplitude = small.projected_norm > 0 ? thresholds::large_secant / small.projected_norm : std::abs(typical);
  amplitude = sign * std::clamp(amplitude, std::abs(thresholds::small_secant * typical), sign > 0 ? p.upper : -p.lower);
  if (!secant(base.model, term, amplitude, change)) return;
  const Signature large = signature_of(base, term, amplitude, change);
  if (large.projected_norm > 0) signatures.push_back(large);
}

}  // namespace

std::vector<Signature> residual_signatures(const FittedModel& model, const LinearProblem& problem,
                                           const ThreadPool& pool) {
  const Base base{model, problem, Projector(problem.nuisance)};
  std::vector<Term> terms;
  for (const bekker_wong::EffectForm& form : bekker_wong::effect_catalogue())
    if (!is_no_candidate(model, form.id))
      for (Term& term : placed(form, model.data().observations)) terms.push_back(std::move(term));
  std::vector<std::vector<Signature>> of_term(terms.size());
  pool.each(static_cast<int>(terms.size()), [&](int t, const Pulse& pulse) {
    pulse();
    add_signatures(base, terms[t], of_term[t]);
  });
  std::vector<Signature> signatures;
  for (std::vector<Signature>& found : of_term) std::move(found.begin(), found.end(), std::back_inserter(signatures));
  return signatures;
}

double strongest(const std::vector<Signature>& signatures) {
  double most = 0.0;
  for (const Signature& s : signatures)
    if (s.projected_norm > 0) most = std::max(most, s.strength());
  return most;
}

double family_wise_p(const std::vector<Signature>& signatures, double observed, double freedom, int simulations,
                     std::uint64_t seed) {
  std::vector<const Signature*> seen;
  for (const Signature& s : signatures)
    if (s.projected_norm > 0) seen.push_back(&s);
  if (seen.empty()) return 1.0;
  const Index n = seen.size();
  MatrixXd directions(seen.front()->direction.size(), n);
  for (Index i = 0; i < n; ++i) directions.col(i) = seen[i]->direction;
  const Cholesky factor(gram_matrix(directions, 1e-8));
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::chi_squared_distribution<double> scale(std::max(1.0, freedom));
  int reached = 0;
  VectorXd z(n);
  for (int k = 0; k < simulations; ++k) {
    for (Index i = 0; i < n; ++i) z[i] = normal(random);
    const VectorXd t = factor.half_times(z);
    double most = 0.0;
    for (Index i = 0; i < n; ++i) most = std::max(most, seen[i]->one_sided ? t[i] : std::abs(t[i]));
    if (most / std::sqrt(scale(random) / std::max(1.0, freedom)) >= observed) ++reached;
  }
  return (reached + 1.0) / (simulations + 1.0);
}

std::map<std::string, double> cosines(const std::vector<Signature>& signatures, const std::string& effect) {
  std::map<std::string, double> most;
  for (const Signature& a : signatures)
    for (const Signature& b : signatures) {
      if (a.term.form->id != effect || b.term.form->id == effect || !(a.projected_norm > 0) || !(b.projected_norm > 0))
        continue;
      double& c = most[b.term.form->id];
      c = std::max(c, std::abs(a.direction.dot(b.direction)));
    }
  return most;
}

}  // namespace soilbin::compare
