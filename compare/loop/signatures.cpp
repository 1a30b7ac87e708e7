#include "compare/loop/signatures.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <random>

namespace soilbin::compare {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// theta of a model with one more term at the given amplitude.
VectorXd extended(const VectorXd& theta, const Term& term, double amplitude) {
  VectorXd longer(theta.size() + static_cast<Index>(term.free.size()));
  longer.head(theta.size()) = theta;
  longer[theta.size()] = amplitude;
  return longer;
}

/// Change of the cells by the term at this amplitude, halved until the soil carries every row or nearly does: a fit may
/// stand where the least push makes it give way.
bool secant(const TracedModel& model, const Term& term, double& amplitude, VectorXd& change) {
  std::vector<Term> terms = model.predictor.terms();
  terms.push_back(term);
  const WheelPredictor predictor(model.campaign, model.observations, terms);
  BalanceMemory memory = giving_way();
  for (int attempt = 0; attempt < 8; ++attempt, amplitude *= 0.5) {
    if (!predictor.predict(extended(model.fit.theta, term, amplitude), change, memory)) continue;
    change -= model.fit.prediction;
    if (change.allFinite()) return true;
  }
  return false;
}

Signature signature_of(const TracedModel& model, const Projector& off, const Term& term, double amplitude,
                       const VectorXd& change) {
  Signature s;
  s.term = term;
  s.at_amplitude = amplitude;
  const bekker_wong::EffectParameter& p = term.form->parameters.front();
  s.one_sided = p.lower >= 0.0;
  s.white = model.whitening(VectorXd(change / amplitude));
  const VectorXd rest = off.vector(model.problem.padded(s.white));
  const double whole = s.white.norm();
  s.projected_norm = rest.norm();
  s.share_kept = whole > 0 ? s.projected_norm / whole : 0.0;
  constexpr double trace_sd = 1e-3;  // a whole-range effect that moves the cells by less than this leaves no trace
  const double reach = std::max(std::abs(p.lower), std::abs(p.upper));
  if (!(s.projected_norm * reach > trace_sd) || !(s.share_kept > 1e-4)) {
    s.projected_norm = 0.0;
    return s;
  }
  s.direction = rest / s.projected_norm;
  s.score = s.direction.dot(model.problem.residual);
  s.amplitude = s.score / s.projected_norm;
  s.std_error = 1.0 / s.projected_norm;
  s.detectable = std::sqrt(detectable_noncentrality) / s.projected_norm;
  s.testable = s.detectable <= reach;
  return s;
}

bool named_already(const TracedModel& model, const std::string& id) {
  const auto& terms = model.predictor.terms();
  const auto& declared = model.campaign.effects;
  return std::any_of(terms.begin(), terms.end(), [&](const Term& t) { return t.form->id == id; }) ||
         std::any_of(declared.begin(), declared.end(), [&](const EffectChoice& c) { return c.id == id; });
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

/// Two secants of a term: one near 0, one where it moves the cells by about `target` sd off the soil's values.
void add_signatures(const TracedModel& model, const Projector& off, const Term& term,
                    std::vector<Signature>& signatures) {
  const bekker_wong::EffectParameter& p = term.form->parameters.front();
  constexpr double near = 0.05, target = 10.0;
  const double typical = p.fallback != 0.0 ? p.fallback : 0.1 * p.upper;
  VectorXd change;
  double amplitude = near * typical;
  if (!secant(model, term, amplitude, change)) return;
  signatures.push_back(signature_of(model, off, term, amplitude, change));
  const Signature& small = signatures.back();
  double sign = small.one_sided || small.score > 0 ? 1.0 : -1.0;
  amplitude = small.projected_norm > 0 ? target / small.projected_norm : std::abs(typical);
  amplitude = sign * std::clamp(amplitude, std::abs(near * typical), sign > 0 ? p.upper : -p.lower);
  if (!secant(model, term, amplitude, change)) return;
  const Signature large = signature_of(model, off, term, amplitude, change);
  if (large.projected_norm > 0) signatures.push_back(large);
}

}  // namespace

std::vector<Signature> residual_signatures(const TracedModel& model, const ThreadPool& pool) {
  const Projector off(model.problem.nuisance);
  std::vector<Term> terms;
  for (const bekker_wong::EffectForm& form : bekker_wong::effect_catalogue())
    if (!named_already(model, form.id))
      for (Term& term : placed(form, model.observations)) terms.push_back(std::move(term));
  std::vector<std::vector<Signature>> of_term(terms.size());
  pool.each(static_cast<int>(terms.size()), [&](int t, const Pulse& pulse) {
    pulse();
    add_signatures(model, off, terms[static_cast<std::size_t>(t)], of_term[static_cast<std::size_t>(t)]);
  });
  std::vector<Signature> signatures;
  for (std::vector<Signature>& found : of_term) std::move(found.begin(), found.end(), std::back_inserter(signatures));
  return signatures;
}

double family_wise_p(const std::vector<Signature>& signatures, double observed, double freedom, int simulations,
                     std::uint64_t seed) {
  std::vector<const Signature*> seen;
  for (const Signature& s : signatures)
    if (s.projected_norm > 0) seen.push_back(&s);
  if (seen.empty()) return 1.0;
  const Index n = static_cast<Index>(seen.size());
  MatrixXd directions(seen.front()->direction.size(), n);
  for (Index i = 0; i < n; ++i) directions.col(i) = seen[static_cast<std::size_t>(i)]->direction;
  MatrixXd gram = directions.transpose() * directions;
  gram.diagonal().array() += 1e-8;
  const MatrixXd factor = gram.llt().matrixL();
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::chi_squared_distribution<double> scale(std::max(1.0, freedom));
  int reached = 0;
  VectorXd z(n);
  for (int k = 0; k < simulations; ++k) {
    for (Index i = 0; i < n; ++i) z[i] = normal(random);
    const VectorXd t = factor.triangularView<Eigen::Lower>() * z;
    double most = 0.0;
    for (Index i = 0; i < n; ++i)
      most = std::max(most, seen[static_cast<std::size_t>(i)]->one_sided ? t[i] : std::abs(t[i]));
    if (most / std::sqrt(scale(random) / std::max(1.0, freedom)) >= observed) ++reached;
  }
  return (reached + 1.0) / (simulations + 1.0);
}

}  // namespace soilbin::compare
