#include "compare/loop/base_fit.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "scenario/errors.hpp"

namespace soilbin::compare {

using Eigen::Index;
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

/// The soil's columns, and those of the terms' parameters that may move: an amplitude has no prior, and may be anything
/// within ten of its standard errors.
NoiseData noise_data(const WheelPredictor& predictor, const Observations& observations, const Fit& fit) {
  constexpr double wide = 10.0;
  const VectorXd errors = standard_errors(fit, predictor);
  NoiseData data;
  data.prediction = fit.prediction;
  data.soil_columns = Eigen::MatrixXd::Zero(fit.prediction.size(), fit.theta.size());
  VectorXd shift = VectorXd::Zero(fit.theta.size());
  for (Index p = 0; p < fit.theta.size(); ++p) {
    const FreeParameter& parameter = predictor.parameters()[static_cast<std::size_t>(p)];
    const bool stated = std::isfinite(parameter.prior_sd);
    if (p >= predictor.soil_parameters() && errors[p] == 0.0) continue;  // held by a bound of its form
    data.soil_columns.col(p) = fit.jacobian.col(p) * (stated ? parameter.prior_sd : wide * errors[p]);
    if (stated) shift[p] = (fit.theta[p] - parameter.prior) / parameter.prior_sd;
  }
  data.residual = observations.values() - fit.prediction + data.soil_columns * shift;
  return data;
}

/// A soil drawn from the declared values' priors.
VectorXd drawn_soil(const WheelPredictor& predictor, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  VectorXd soil = predictor.start();
  for (Index i = 0; i < soil.size(); ++i) {
    const FreeParameter& p = predictor.parameters()[static_cast<std::size_t>(i)];
    soil[i] = p.prior + p.prior_sd * normal(random);
  }
  return predictor.within_bounds(std::move(soil));
}

/// The least chi2 of fits from `start` and from soils drawn about the declared one: as many as it takes until two have
/// ended there.
Fit fit_from_several(const WheelPredictor& predictor, const Observations& observations, const Whitening& whitening,
                     VectorXd start, std::uint64_t seed) {
  constexpr int most_starts = 8;
  constexpr double same_share = 1e-3, same = 2e-3;  // of chi2
  std::mt19937_64 random(seed);
  const VectorXd values = observations.values();
  std::optional<Fit> best;
  int ended_there = 0;
  for (int n = 0; n < most_starts && ended_there < 2; ++n, start = drawn_soil(predictor, random)) {
    auto found = fit(predictor, values, whitening, start);
    if (!found) continue;
    const double lower = best ? best->chi2 - found->chi2 : found->chi2, near = std::max(same, same_share * found->chi2);
    if (lower < -near) continue;
    ended_there = best && lower < near ? ended_there + 1 : 1;
    if (!best || lower > 0.0) best = std::move(found);
  }
  if (!best)
    throw NoSolution(
        "no soil near the declared one carries the wheel in every run of this campaign; free more of its values (sd), "
        "k_phi above all, or leave out the runs that `soilbin check` names");
  return *best;
}

}  // namespace

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
    id.base = fit_from_several(predictor, id.observations, *id.whitening, start, options.seed);
    start = id.base.restart;
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

NoiseFloor noise_beside(const Campaign& campaign, const Identification& id, const CandidateModel& candidate) {
  const WheelPredictor predictor(campaign, id.observations, candidate.terms);
  return estimate_noise(id.observations, noise_data(predictor, id.observations, candidate.fit)).floor;
}

}  // namespace soilbin::compare
