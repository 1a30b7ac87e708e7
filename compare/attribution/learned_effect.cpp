#include "compare/attribution/learned_effect.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "bekker_wong/learned.hpp"
#include "compare/attribution/choice.hpp"
#include "compare/fit/factorizations.hpp"
#include "compare/fit/fitted_model.hpp"
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

/// Forms with evidence among those that leave a trace and are not in the model yet, the most evidence first, over the
/// ranges of these observations. beside: fitted to them, or to them pooled.
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

using bekker_wong::FormulaTerm;

namespace {

using Combination = std::vector<int>;

/// Root mean square of a term over the runs; 0 where it has no value in some.
double usual_size(const FormulaTerm& term, const Observations& observations) {
  double sum = 0.0;
  for (const OperatingCondition& at : observations.rows) sum += std::pow(term.value(at), 2);
  return std::isfinite(sum) ? std::sqrt(sum / static_cast<double>(observations.rows.size())) : 0.0;
}

/// A formula as a term of a model: each weight free with such an sd that it moves g by `size`.
Term formula_term(const EffectForm& form, const std::vector<FormulaTerm>& terms, const Observations& observations,
                  double size) {
  Term term{.form = &form, .defaults = {1.0}, .free = {}, .spread = {0.0}};
  for (std::size_t k = 0; k < terms.size(); ++k) {
    term.defaults.push_back(0.0);
    term.free.push_back(static_cast<int>(k + 1));
    term.spread.push_back(size / usual_size(terms[k], observations));
  }
  term.basis_values = [terms](const OperatingCondition& at) {
    std::vector<double> values;
    for (const FormulaTerm& one : terms) values.push_back(one.value(at));
    return values;
  };
  return term;
}

/// The library's columns off what the model's own parameters absorb, as small matrices.
class TermLibrary {
 public:
  TermLibrary(const MatrixXd& columns, const LinearProblem& problem) {
    MatrixXd padded(problem.residual.size(), columns.cols());
    for (Index k = 0; k < columns.cols(); ++k) padded.col(k) = problem.padded(columns.col(k));
    const MatrixXd off = Projector(problem.nuisance)(padded);
    gram_ = off.transpose() * off, seen_ = off.transpose() * problem.residual;
  }

  /// ln evidence that these terms add, weights of one size.
  double gain(const Combination& terms, double size) const {
    MatrixXd m = gram_(terms, terms);
    const double narrowed = log_narrowing(m, VectorXd::Constant(m.rows(), size));
    m.diagonal().array() += 1 / (size * size);
    const VectorXd seen = seen_(terms);
    return 0.5 * seen.dot(Cholesky(m).solve(seen)) - narrowed;
  }
  /// The size of most evidence.
  double best_size(const Combination& terms) const {
    const auto& sizes = thresholds::learned_sizes;
    return *std::ranges::max_element(sizes, [&](double a, double b) { return gain(terms, a) < gain(terms, b); });
  }
  double evidence(const Combination& terms) const {
    std::vector<double> gains;
    for (const double size : thresholds::learned_sizes) gains.push_back(gain(terms, size));
    return log_mean_exp(gains);
  }
  int terms() const { return static_cast<int>(gram_.cols()); }

 private:
  MatrixXd gram_;
  VectorXd seen_;
};

/// Combinations, of most evidence first.
std::vector<Combination> sorted(std::vector<Combination> all, const TermLibrary& library) {
  std::vector<std::pair<double, Combination>> weighed;
  for (Combination& one : all) weighed.emplace_back(-library.evidence(one), std::move(one));
  std::ranges::sort(weighed);
  all.clear();
  for (auto& [evidence, one] : weighed) all.push_back(std::move(one));
  return all;
}

/// These with each further term of the library.
std::vector<Combination> wider(const std::vector<Combination>& some, const TermLibrary& library) {
  std::vector<Combination> all;
  for (const Combination& one : some)
    for (int k = 0; k < library.terms(); ++k) {
      if (std::ranges::find(one, k) != one.end()) continue;
      all.push_back(one);
      all.back().push_back(k);
      std::ranges::sort(all.back());
    }
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

/// Terms that have a value in every run.
std::vector<FormulaTerm> candidate_terms(const Term& learned, const Observations& observations) {
  std::vector<FormulaTerm> terms =
      bekker_wong::formula_terms(bekker_wong::learned_function(*learned.form), learned.defaults);
  std::erase_if(terms, [&](const FormulaTerm& term) { return !(usual_size(term, observations) > 0.0); });
  return terms;
}

/// Fitted in full and set beside the learned effect on conditions left out.
std::optional<LearnedFormula> tried(const FittedModel& beside, const LearnedEffect& learned,
                                    std::vector<FormulaTerm> terms, double size, const AttributionOptions& options) {
  const EffectForm form = bekker_wong::formula_form(*learned.candidate.terms().back().form, terms);
  const auto model = fitted_with_learned(beside, formula_term(form, terms, beside.data().observations, size));
  if (!model) return std::nullopt;
  LearnedFormula found{std::move(terms),
                       {},
                       bekker_wong::joint_equation(form),
                       predictive_gain(fold_densities(*model, options.seed, options.pool), learned.held_out)};
  const VectorXd errors = model->standard_errors();
  const Index first = model->predictor().amplitude_index(static_cast<int>(model->terms().size()) - 1);
  for (Index k = 0; k < std::ssize(found.terms); ++k)
    found.weights.push_back({model->fit().theta[first + k], errors[first + k]});
  return found;
}

}  // namespace

std::optional<LearnedFormula> find_formula(const FittedModel& beside, const LearnedEffect& learned,
                                           const AttributionOptions& options) {
  const Observations& observations = beside.data().observations;
  const std::vector<FormulaTerm> all = candidate_terms(learned.candidate.terms().back(), observations);
  const EffectForm whole = bekker_wong::formula_form(*learned.candidate.terms().back().form, all);
  const auto columns = columns_of_weights(beside, formula_term(whole, all, observations, 1.0));
  if (!columns) return std::nullopt;
  const TermLibrary library(*columns, problem_of(beside));
  std::vector<Combination> best = {{}};
  for (int count = 1; count <= thresholds::max_formula_terms; ++count) {
    best = sorted(wider(best, library), library);
    std::vector<FormulaTerm> terms;
    for (const int k : best.front()) terms.push_back(all[k]);
    auto found = tried(beside, learned, std::move(terms), library.best_size(best.front()), options);
    if (found && found->over_learned.mean >= -found->over_learned.std_error) return found;
    if (count == 2) best.resize(std::min<std::size_t>(best.size(), thresholds::best_pairs));
  }
  return std::nullopt;
}

}  // namespace soilbin::compare
