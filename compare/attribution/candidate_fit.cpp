#include "compare/attribution/candidate_fit.hpp"

#include <algorithm>

namespace soilbin::compare {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// Starts a term at these values of its form's parameters, with a share of the amplitude: with next to none the fit
/// ends no higher than the one that it begins from, whose first step would else have to lead back there.
void put(VectorXd& start, const WheelPredictor& predictor, int term, const std::vector<double>& values, double share) {
  const Term& t = predictor.terms()[term];
  const Index first = predictor.amplitude_index(term);
  const double off_its_bound = share > 0.0 ? 1e-3 : 1e-6;
  for (std::size_t k = 0; k < t.free.size(); ++k) {
    const int i = t.free[k];
    const bekker_wong::EffectParameter& p = t.form->parameters[i];
    const double least = k == 0 ? p.lower + off_its_bound * (p.upper - p.lower) : p.lower;
    start[first + k] = std::clamp(k == 0 ? share * values[i] : values[i], least, p.upper);
  }
}

/// Soil values and earlier terms as known, then the estimated terms, their amplitudes halved until every run is
/// carried; and the balances there.
std::pair<VectorXd, BalanceMemory> start_of(const WheelPredictor& predictor, const CandidateStart& known, double share,
                                            const VectorXd& where) {
  VectorXd start = predictor.start(), prediction;
  start.head(where.size()) = where;
  for (const auto& [term, values] : known.estimated) put(start, predictor, term, values, share);
  BalanceMemory memory = known.from->balance;
  for (int halving = 0; halving < 6 && !predictor.predict(start, prediction, memory); ++halving)
    for (const auto& [term, values] : known.estimated) start[predictor.amplitude_index(term)] *= 0.5;
  return {std::move(start), std::move(memory)};
}

}  // namespace

std::optional<FittedModel> fit_terms(const FittedModel& base, const std::vector<Term>& terms,
                                     const CandidateStart& known) {
  const WheelPredictor predictor = base.predictor().with(terms);
  std::optional<FittedModel> best;
  const auto try_from = [&](double share, const VectorXd& where) {
    auto [start, near] = start_of(predictor, known, share, where);
    auto found = fitted(base.shared_data(), predictor, start, std::move(near));
    if (found && (!best || found->fit().chi2 < best->fit().chi2)) best = std::move(found);
  };
  const auto drops_by = [&](double drop) { return best && best->fit().chi2 < known.from->chi2 - drop; };
  for (const double share : {1.0, 0.3, 0.0})
    if (!drops_by(share > 0.0 ? 0.5 * known.expected_drop : 0.0)) try_from(share, known.from->restart);
  if (!drops_by(0.0)) try_from(0.0, known.from->theta);  // where the soil carries every run
  return best;
}

}  // namespace soilbin::compare
