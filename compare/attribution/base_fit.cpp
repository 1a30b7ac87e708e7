#include "compare/attribution/base_fit.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "compare/fit/thresholds.hpp"
#include "compare/measured/outliers.hpp"
#include "scenario/errors.hpp"

namespace soilbin::compare {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// Noise as a share of each channel's range: where the first fit starts.
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
    guess.channels[channel] = {.measured = any, .floor = thresholds::first_noise_share * range};
  }
  return guess;
}

/// The soil's columns, and those of the terms' parameters that may move: an amplitude has no prior, and may be anything
/// within ten of its standard errors.
NoiseData noise_data(const FittedModel& model) {
  constexpr double wide = 10.0;
  const Fit& fit = model.fit();
  const VectorXd errors = model.standard_errors();
  NoiseData data;
  data.prediction = fit.prediction;
  data.soil_columns = Eigen::MatrixXd::Zero(fit.prediction.size(), fit.theta.size());
  VectorXd shift = VectorXd::Zero(fit.theta.size());
  for (Index p = 0; p < fit.theta.size(); ++p) {
    const FreeParameter& parameter = model.predictor().parameters()[p];
    const bool stated = std::isfinite(parameter.prior_sd);
    if (p >= model.predictor().soil_parameters() && errors[p] == 0.0) continue;  // held by a bound of its form
    data.soil_columns.col(p) = fit.jacobian.col(p) * (stated ? parameter.prior_sd : wide * errors[p]);
    if (stated) shift[p] = (fit.theta[p] - parameter.prior) / parameter.prior_sd;
  }
  data.residual = model.data().observations.values() - fit.prediction + data.soil_columns * shift;
  return data;
}

/// A soil drawn from the declared values' priors.
VectorXd drawn_soil(const WheelPredictor& predictor, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  VectorXd soil = predictor.start();
  for (Index i = 0; i < soil.size(); ++i) {
    const FreeParameter& p = predictor.parameters()[i];
    soil[i] = p.prior + p.prior_sd * normal(random);
  }
  return predictor.within_bounds(std::move(soil));
}

/// The least chi2 of fits from `start` and from soils drawn about the declared one: as many as it takes until two have
/// ended there.
FittedModel fit_from_several(Dataset made, std::optional<VectorXd> start, std::uint64_t seed) {
  const auto data = std::make_shared<const Dataset>(std::move(made));
  const WheelPredictor predictor = data->declared_model();
  std::mt19937_64 random(seed);
  std::optional<FittedModel> best;
  int ended_there = 0;
  VectorXd from = start ? std::move(*start) : predictor.start();
  for (int n = 0; n < thresholds::max_starts && ended_there < 2; ++n, from = drawn_soil(predictor, random)) {
    auto found = fitted(data, predictor, from);
    if (!found) continue;
    const double chi2 = found->fit().chi2, lower = best ? best->fit().chi2 - chi2 : chi2,
                 near = std::max(thresholds::same_chi2, thresholds::same_chi2_share * chi2);
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

/// The data with a new estimate of their noise about a fit; cells too far off it are set aside, unless they are many.
Dataset with_noise(const FittedModel& model, const NoiseEstimate& estimate, bool drop_outliers) {
  const Dataset& data = model.data();
  std::vector<bool> drop = outliers(estimate.chance);
  const auto count = static_cast<double>(std::ranges::count(drop, true));
  if (!drop_outliers || count == 0 || count > thresholds::max_outlier_share * static_cast<double>(drop.size()))
    drop.assign(drop.size(), false);
  std::vector<bool> outlier = data.outlier;
  std::vector<Index> kept;
  for (std::size_t i = 0, cell = 0; i < outlier.size(); ++i) {
    if (outlier[i]) continue;
    if (!drop[cell]) kept.push_back(cell);
    outlier[i] = drop[cell++];
  }
  const Observations observations = without_cells(data.observations, drop);
  const Whitening whitening(observations, estimate.floor, model.fit().prediction(kept));
  return {data.campaign, observations, std::move(outlier), estimate.floor, whitening};
}

}  // namespace

FittedModel fit_base(const Campaign& campaign, const Observations& given, const AttributionOptions& options) {
  constexpr int rounds = 3, rounds_that_drop = 2;
  const NoiseFloor guess = first_guess(given);
  FittedModel model = fit_from_several({.campaign = std::make_shared<const Campaign>(campaign),
                                        .observations = given,
                                        .outlier = std::vector<bool>(given.cells.size(), false),
                                        .noise = guess,
                                        .whitening = Whitening(given, guess, given.values())},
                                       std::nullopt, options.seed);
  for (int round = 0; round < rounds; ++round) {
    const NoiseEstimate estimate = estimate_noise(model.data().observations, noise_data(model));
    model = fit_from_several(with_noise(model, estimate, options.drop_outliers && round < rounds_that_drop),
                             model.fit().restart, options.seed);
  }
  return model;
}

NoiseFloor noise_beside(const FittedModel& model) {
  return estimate_noise(model.data().observations, noise_data(model)).floor;
}

}  // namespace soilbin::compare
