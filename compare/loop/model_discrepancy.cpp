#include "compare/loop/model_discrepancy.hpp"

#include <cmath>
#include <limits>

#include "compare/loop/candidate_fit.hpp"
#include "compare/loop/condition_functions.hpp"

namespace soilbin::compare {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd model_discrepancy_columns(const Identification& id) {
  constexpr int most = 9;  // up to the third order in slip, the second in load, and their products
  Observations own = id.observations;
  for (OperatingCondition& at : own.rows) {
    OperatingCondition bare;
    bare.load = at.load, bare.slip = at.slip;
    at = bare;
  }
  const MatrixXd functions = with_constant(smooth_basis(own, most));
  return in_every_channel(id.observations, id.noise, *id.whitening, id.base.prediction, functions);
}

namespace {

/// The size at which the columns, together with whichever set of effects suits them, explain the data best.
double best_size(const Campaign& campaign, const Identification& id, const MatrixXd& columns) {
  double best = term_sizes.front(), most = -std::numeric_limits<double>::infinity();
  const auto weigh = [&](double log_evidence, const std::vector<Term>& terms, const Fit& fit) {
    const WheelPredictor predictor(campaign, id.observations, terms);
    const JoinedColumns joined(problem_of(id, predictor, fit), columns);
    for (const double size : term_sizes)
      if (const double sum = log_evidence + joined.gain(size); sum > most) most = sum, best = size;
  };
  weigh(id.base_log_evidence, {}, id.base);
  for (const Weighted& w : id.weights)
    weigh(w.log_evidence, id.candidates[w.best_candidate].terms, id.candidates[w.best_candidate].fit);
  return best;
}

void lower_evidence(Identification& id, double by) {
  id.base_log_evidence -= by;
  for (CandidateModel& candidate : id.candidates) candidate.log_evidence -= by;
  for (Weighted& w : id.weights) w.log_evidence -= by;
}

}  // namespace

std::optional<DiscrepancyReading> read_with_model_discrepancy(const Campaign& campaign, const Identification& first,
                                                              const IdentifyOptions& options) {
  if (first.none_near_noise) return std::nullopt;
  MatrixXd columns = model_discrepancy_columns(first);
  DiscrepancyReading reading;
  reading.size = best_size(campaign, first, columns);
  columns *= reading.size;
  Identification& id = reading.identification;
  id.observations = first.observations;
  id.outlier = first.outlier;
  id.noise = first.noise;
  id.whitening = std::make_shared<Whitening>(first.whitening->beside(columns));
  const WheelPredictor base(campaign, id.observations);
  auto found = fit(base, id.observations.values(), *id.whitening, first.base.restart);
  if (!found) return std::nullopt;
  id.base = std::move(*found);
  name_effects(campaign, options, id);
  if (id.none_near_noise) return std::nullopt;
  const double narrowed = log_narrowing(columns.transpose() * columns, VectorXd::Ones(columns.cols()));
  lower_evidence(id, narrowed + std::log(static_cast<double>(term_sizes.size())));
  return reading;
}

}  // namespace soilbin::compare
