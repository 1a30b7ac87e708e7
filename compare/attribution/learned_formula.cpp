#include "compare/attribution/learned_formula.hpp"

#include <algorithm>
#include <cmath>

#include "compare/fit/factorizations.hpp"
#include "compare/fit/thresholds.hpp"

namespace soilbin::compare {

using bekker_wong::EffectForm;
using bekker_wong::FormulaTerm;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

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
class Library {
 public:
  Library(const MatrixXd& columns, const LinearProblem& problem) {
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
std::vector<Combination> sorted(std::vector<Combination> all, const Library& library) {
  std::vector<std::pair<double, Combination>> weighed;
  for (Combination& one : all) weighed.emplace_back(-library.evidence(one), std::move(one));
  std::ranges::sort(weighed);
  all.clear();
  for (auto& [evidence, one] : weighed) all.push_back(std::move(one));
  return all;
}

/// These with each further term of the library.
std::vector<Combination> wider(const std::vector<Combination>& some, const Library& library) {
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
  const Library library(*columns, problem_of(beside));
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
