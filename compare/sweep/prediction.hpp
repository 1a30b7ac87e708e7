// A measured campaign as a model predicts it, run by run, without fitting anything.
//
//   const Prediction prediction = predict(bekker_wong::BekkerWong(), scenario_of(campaign), campaign);
//   for (const ChannelError& e : prediction.errors)
//     fmt::print("{}: {:.3g} {}\n", channel_views[e.channel].title, e.rmse, channel_views[e.channel].si_unit);
#pragma once

#include <vector>

#include "compare/measured/campaign.hpp"
#include "compare/sweep/answers.hpp"

namespace soilbin::compare {

/// One run: what was measured, and what the model says at the same condition.
struct PredictedRun {
  int run = 0;  ///< the campaign's number of the run or, where it has none, of the row (from 1)
  Run measured;
  Answer predicted;
};

/// How far a channel's predictions lie from what was measured, over the runs that have both [SI].
struct ChannelError {
  std::size_t channel = 0;  ///< of channel_views
  std::size_t runs = 0;
  double rmse = 0.0;
  double bias = 0.0;            ///< mean of predicted less measured
  double range = 0.0;           ///< of the measured values
  double share_of_range = 0.0;  ///< rmse/range; NaN where the range is 0
};

struct Prediction {
  std::vector<PredictedRun> runs;    ///< in the order of the campaign
  std::vector<ChannelError> errors;  ///< a channel that was measured each
  std::size_t unsolved = 0;          ///< runs to which the model has no solution
  ModelKind model = ModelKind::bekker_wong;
};

/// Predicts every run of a campaign at its own load, slip, angles, ... with the scenario's soil and effects.
Prediction predict(const Model& model, const Scenario& scenario, const Campaign& campaign,
                   const Progress& progress = {});

std::vector<OperatingCondition> conditions_of(const Prediction& prediction);

/// Predicted less measured, or no value where either is absent [SI].
std::optional<double> residual(const PredictedRun& run, const ChannelView& channel);

}  // namespace soilbin::compare
