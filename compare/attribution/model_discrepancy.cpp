#include "compare/attribution/model_discrepancy.hpp"

#include <cmath>
#include <limits>

#include "compare/attribution/unnamed.hpp"
#include "compare/fit/condition_functions.hpp"

namespace soilbin::compare {

using Eigen::MatrixXd;
using Eigen::VectorXd;

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
