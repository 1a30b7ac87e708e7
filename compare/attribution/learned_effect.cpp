#include "compare/attribution/learned_effect.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "bekker_wong/learned.hpp"
#include "compare/attribution/choice.hpp"
#include "compare/fit/pooled_runs.hpp"
#include "compare/fit/thresholds.hpp"

namespace soilbin::compare {

using bekker_wong::EffectForm;
using bekker_wong::LearnedFunction;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// How free a weight is against the others: products that bend more are held nearer to 0.
double freedom_of_weight(const std::vector<int>& degrees) {
  return 1.0 / std::pow(1.0 + std::accumulate(degrees.begin(), degrees.end(), 0), thresholds::learned_bend_power);
}

/// A form over the ranges that were run, its weights free with sd of `size` and less; nothing where a variable stays.
std::optional<Term> learned_term(const EffectForm& form, const Observations& observations, double size) {
  const LearnedFunction& function = bekker_wong::learned_function(form);
  Term term{.form = &form, .defaults = {}, .free = {}, .spread = std::vector<double>(form.parameters.size(), 0.0)};
  for (const bekker_wong::EffectParameter& p : form.parameters) term.defaults.push_back(p.fallback);
  for (std::size_t v = 0; v < function.variables.size(); ++v) {
    double low = std::numeric_limits<double>::infinity(), high = -low, scale = 0.0;
    for (const OperatingCondition& at : observations.rows) {
      const double value = function.variables[v].value(at);
      if (std::isnan(value)) return std::nullopt;
      low = std::min(low, value), high = std::max(high, value), scale = std::max(scale, std::abs(value));
    }
    if (!(high - low > thresholds::min_learned_range * scale)) return std::nullopt;
    term.defaults[LearnedFunction::from(v)] = low, term.defaults[LearnedFunction::to(v)] = high;
  }
  for (std::size_t k = 0; k < function.degrees.size(); ++k) {
    const std::size_t i = function.first_weight() + k;
    term.free.push_back(static_cast<int>(i));
    term.spread[i] = size * freedom_of_weight(function.degrees[k]);
  }
  term.basis_values = [&function, ranges = term.defaults](const OperatingCondition& at) {
    return bekker_wong::weighed_products(function, ranges, at);
  };
  return term;
}

/// A form's part in the linear problem.
struct LearnedProspect {
  Term term;                  ///< free to the size of most evidence
  double log_evidence = 0.0;  ///< mean over the sizes; of those that are looked at, the choice among them paid
};

}  // namespace

std::optional<MatrixXd> columns_of_weights(const FittedModel& beside, const Term& term) {
  const WheelPredictor predictor = beside.predictor().with({term});
  const Index known = beside.fit().theta.size();
  VectorXd theta = predictor.start();
  theta.head(known) = beside.fit().theta;
  BalanceMemory memory = beside.fit().balance;
  VectorXd without, with;
  if (!predictor.predict(theta, without, memory)) return std::nullopt;
  MatrixXd columns(without.size(), term.free.size());
  for (Index k = 0; k < columns.cols(); ++k) {
    constexpr double step = 0.01;
    BalanceMemory own = memory;
    theta[known + k] = step;
    if (!predictor.predict(theta, with, own)) return std::nullopt;
    theta[known + k] = 0.0;
    columns.col(k) = (with - without) * (term.spread[term.free[k]] / step);
  }
  const MatrixXd white = beside.data().whitening(columns);
  return white.norm() > thresholds::min_signature ? std::optional(white) : std::nullopt;
}

namespace {

std::optional<LearnedProspect> learned_prospect(const FittedModel& beside, const LinearProblem& problem,
                                                const EffectForm& form, const Observations& observations) {
  const auto term = learned_term(form, observations, 1.0);
  if (!term) return std::nullopt;
  const auto columns = columns_of_weights(beside, *term);
  if (!columns) return std::nullopt;
  const JoinedColumns joined(problem, *columns);
  std::vector<double> gains;
  for (const double size : thresholds::learned_sizes) gains.push_back(joined.gain(size));
  const auto best = std::ranges::max_element(gains) - gains.begin();
  return LearnedProspect{*learned_term(form, observations, thresholds::learned_sizes.at(best)), log_mean_exp(gains)};
}

/// Of the forms that leave a trace and are not there yet those with evidence, of most first, over the ranges of these
/// observations. beside: fitted to them, or to them pooled.
std::vector<LearnedProspect> learned_prospects(const FittedModel& beside, const Observations& observations,
                                               const ThreadPool& pool) {
  const std::vector<EffectForm>& forms = bekker_wong::learned_forms();
  const LinearProblem problem = problem_of(beside);
  std::vector<std::optional<LearnedProspect>> found(forms.size());
  pool.each(static_cast<int>(forms.size()), [&](int i, const Pulse& pulse) {
    pulse();
    const auto is_this = [&](const Term& term) { return term.form == &forms[i]; };
    if (std::ranges::none_of(beside.terms(), is_this))
      found[i] = learned_prospect(beside, problem, forms[i], observations);
  });
  std::vector<LearnedProspect> prospects;
  for (std::optional<LearnedProspect>& one : found)
    if (one) prospects.push_back(std::move(*one));
  const double choice = std::log(static_cast<double>(std::max<std::size_t>(1, prospects.size())));
  for (LearnedProspect& one : prospects) one.log_evidence -= choice;
  std::erase_if(prospects, [](const LearnedProspect& one) { return one.log_evidence <= 0.0; });
  std::ranges::stable_sort(
      prospects, [](const LearnedProspect& a, const LearnedProspect& b) { return a.log_evidence > b.log_evidence; });
  return prospects;
}

}  // namespace

std::optional<FittedModel> fitted_with_learned(const FittedModel& beside, const Term& term) {
  const WheelPredictor predictor = beside.predictor().with({term});
  VectorXd start = predictor.start();
  start.head(beside.fit().restart.size()) = beside.fit().restart;
  return fitted(beside.shared_data(), predictor, start, beside.fit().balance);
}

FittedModel refitted_as_exact(const FittedModel& base, const FittedModel* chosen) {
  if (!chosen) return base;
  if (chosen->shared_data() == base.shared_data()) return *chosen;
  const auto again = fitted(base.shared_data(), base.predictor().with(chosen->terms()), chosen->fit().restart);
  return again ? *again : base;
}

namespace {

/// The next learned effect, beside a model that gives these densities to conditions left out; nothing where none
/// stands.
std::optional<LearnedEffect> learn_next(const FittedModel& beside, const std::vector<FoldDensity>& without,
                                        const std::vector<LearnedProspect>& prospects, std::size_t refits,
                                        const AttributionOptions& options) {
  std::optional<LearnedEffect> best;
  for (std::size_t i = 0; i < prospects.size() && i < refits; ++i) {
    const double evidence = prospects[i].log_evidence;
    auto model = fitted_with_learned(beside, prospects[i].term);
    if (!model) continue;
    auto held_out = fold_densities(*model, options.seed, options.pool);
    const PredictiveGain gain = predictive_gain(held_out, without);
    if (best && gain.mean <= best->gain.mean) continue;
    std::set<std::string> ids;
    for (const Term& term : model->terms()) ids.insert(term.form->id);
    best = LearnedEffect{{std::move(ids), std::move(*model), evidence}, evidence, std::move(held_out), gain};
  }
  return best && earns_its_place(best->gain, best->log_evidence) ? best : std::nullopt;
}

}  // namespace

std::vector<LearnedEffect> learn_effects(const FittedModel& beside, const AttributionOptions& options) {
  const Observations& runs = beside.data().observations;
  const bool few_runs = runs.rows.size() <= thresholds::max_searched_rows;
  std::vector<LearnedEffect> learned;
  std::vector<FoldDensity> held_out_baseline;
  while (learned.size() < thresholds::max_learned) {
    const bool first = learned.empty();
    const FittedModel& model = first ? beside : learned.back().candidate.model;
    const auto small = few_runs ? std::nullopt : pooled(model, thresholds::max_searched_rows);
    const std::vector<LearnedProspect> prospects = learned_prospects(small ? *small : model, runs, options.pool);
    if (prospects.empty()) break;
    if (first) held_out_baseline = fold_densities(beside, options.seed, options.pool);
    auto next = learn_next(model, first ? held_out_baseline : learned.back().held_out, prospects,
                           first && few_runs ? thresholds::learned_refits : thresholds::later_refits, options);
    if (!next) break;
    learned.push_back(std::move(*next));
  }
  return learned;
}

}  // namespace soilbin::compare
