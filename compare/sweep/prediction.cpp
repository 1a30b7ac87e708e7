#include "compare/sweep/prediction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scenario/estimate.hpp"

namespace soilbin::compare {
namespace {

ChannelError error_of(const std::vector<PredictedRun>& runs, std::size_t channel) {
  const ChannelView& view = channel_views[channel];
  ChannelError error{.channel = channel};
  double sum = 0.0, squares = 0.0;
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for (const PredictedRun& run : runs) {
    const std::optional<double> rest = residual(run, view);
    if (!rest) continue;
    ++error.runs;
    sum += *rest, squares += *rest * *rest;
    lowest = std::min(lowest, *(run.measured.*view.measured));
    highest = std::max(highest, *(run.measured.*view.measured));
  }
  const auto count = static_cast<double>(error.runs);
  error.rmse = std::sqrt(squares / count);
  error.bias = sum / count;
  error.range = error.runs > 0 ? highest - lowest : not_a_number;
  error.share_of_range = error.range > 0.0 ? error.rmse / error.range : not_a_number;
  return error;
}

}  // namespace

std::optional<double> residual(const PredictedRun& run, const ChannelView& channel) {
  const std::optional<double>& measured = run.measured.*channel.measured;
  if (!measured || !run.predicted.result) return std::nullopt;
  const double predicted = ((*run.predicted.result).*channel.predicted).value;
  if (std::isnan(predicted)) return std::nullopt;  // a channel that the model doesn't know
  return predicted - *measured;
}

std::vector<OperatingCondition> conditions_of(const Prediction& prediction) {
  std::vector<OperatingCondition> all;
  for (const PredictedRun& run : prediction.runs) all.push_back(run.measured.at);
  return all;
}

Prediction predict(const Model& model, const Scenario& scenario, const Campaign& campaign, const Progress& progress) {
  Prediction prediction;
  prediction.model = value_named<ModelKind>(model.name()).value_or(ModelKind::bekker_wong);
  for (const Run& run : campaign.runs) {
    const int row = static_cast<int>(prediction.runs.size()) + 1;
    prediction.runs.push_back({run.at.run.value_or(row), run, ask(model, scenario, run.at)});
    if (!prediction.runs.back().predicted.result) ++prediction.unsolved;
    if (progress) progress(prediction.runs.size(), campaign.runs.size());
  }
  for (std::size_t channel = 0; channel < channel_views.size(); ++channel) {
    const auto holds = [&](const Run& run) { return (run.*channel_views[channel].measured).has_value(); };
    if (std::ranges::any_of(campaign.runs, holds)) prediction.errors.push_back(error_of(prediction.runs, channel));
  }
  return prediction;
}

}  // namespace soilbin::compare
