#include "compare/loop/candidate_fit.hpp"

#include <algorithm>
#include <cmath>

namespace soilbin::compare {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// Starts a term at these values of its form's parameters, with a share of the amplitude.
void put(VectorXd& start, const WheelPredictor& predictor, int term, const std::vector<double>& values, double share) {
  const Term& t = predictor.terms()[term];
  const Index first = predictor.amplitude_index(term);
  for (std::size_t k = 0; k < t.free.size(); ++k) {
    const int i = t.free[k];
    const bekker_wong::EffectParameter& p = t.form->parameters[i];
    const double least = k == 0 ? p.lower + 1e-3 * (p.upper - p.lower) : p.lower;
    start[first + k] = std::clamp(k == 0 ? share * values[i] : values[i], least, p.upper);
  }
}

/// Soil values and earlier terms as known, then the estimated terms, their amplitudes halved until every run is
/// carried.
VectorXd start_of(const WheelPredictor& predictor, const CandidateStart& from, double share) {
  VectorXd start = predictor.start(), prediction;
  start.head(from.known.size()) = from.known;
  for (const auto& [term, values] : from.estimated) put(start, predictor, term, values, share);
  BalanceMemory memory = giving_way();
  for (int halving = 0; halving < 6 && !predictor.predict(start, prediction, memory); ++halving)
    for (const auto& [term, values] : from.estimated) start[predictor.amplitude_index(term)] *= 0.5;
  return start;
}

}  // namespace

std::optional<FittedModel> fit_terms(const FittedModel& base, const std::vector<Term>& terms,
                                     const CandidateStart& from) {
  const WheelPredictor predictor = base.predictor().with(terms);
  std::optional<FittedModel> best;
  for (const double share : {1.0, 0.3, 0.0}) {
    if (best && best->fit().chi2 < from.chi2 - (share > 0.0 ? 0.5 * from.promised : 0.0)) break;
    auto found = fitted(base.shared_data(), predictor, start_of(predictor, from, share));
    if (found && (!best || found->fit().chi2 < best->fit().chi2)) best = std::move(found);
  }
  return best;
}

}  // namespace soilbin::compare
