// A campaign beside its prediction, as it is told; soilbin-predict/1.
#include <fmt/core.h>

#include <algorithm>

#include "compare/doubts/doubts.hpp"
#include "compare/measured/campaign.hpp"
#include "compare/report/number_text.hpp"
#include "compare/sweep/answer_sheets.hpp"
#include "compare/sweep/prediction.hpp"
#include "compare/sweep/result_json.hpp"
#include "compare/sweep/varying.hpp"
#include "compare/telling/reports.hpp"
#include "scenario/case.hpp"

namespace soilbin::compare {
namespace {

/// The runs of a campaign under their own labels, measured and predicted (± one standard error).
Table runs_table(const Prediction& prediction) {
  const Curves curves = curves_against_slip(conditions_of(prediction), Spread::measured);
  const bool labelled =
      std::ranges::any_of(prediction.runs, [](const PredictedRun& run) { return run.measured.setpoint.has_value(); });
  std::vector<std::string> header = {"run"};
  if (labelled) header.push_back("setpoint");
  if (!curves.varying.empty()) header.push_back("nominal " + curves.varying);
  header.insert(header.end(), {"load [N]", "slip [%]"});
  for (const ChannelError& error : prediction.errors) {
    const ChannelView& channel = channel_views[error.channel];
    header.push_back(heading(std::string(channel.title), std::string(channel.unit)));
    header.insert(header.end(), {"predicted", "predicted - measured"});
  }
  Table table{"", header};
  for (std::size_t i = 0; i < prediction.runs.size(); ++i) {
    const PredictedRun& run = prediction.runs[i];
    std::vector<TableCell> row = {std::to_string(run.run)};
    if (labelled) row.push_back(run.measured.setpoint.value_or("-"));
    if (!curves.varying.empty()) row.push_back(curves.labels[curves.curve_of[i]]);
    row.push_back(number(run.measured.at.load));
    row.push_back(fmt::format("{:.4g}", 100 * run.measured.at.slip));
    for (const ChannelError& error : prediction.errors) {
      const ChannelView& channel = channel_views[error.channel];
      const auto measured = run.measured.*channel.measured;
      const auto rest = residual(run, channel);
      row.push_back(measured ? number(*measured * channel.per_si) : "-");
      row.push_back(run.predicted.result ? number((*run.predicted.result).*channel.predicted, channel.per_si) : "-");
      row.push_back(rest ? number(*rest * channel.per_si) : "-");
    }
    table.add(std::move(row));
  }
  return table;
}

}  // namespace

Table channel_errors_table(const Prediction& prediction, std::string caption, std::vector<std::string> header) {
  Table table{std::move(caption), std::move(header)};
  for (const ChannelError& error : prediction.errors)
    table.add({std::string(channel_views[error.channel].title), std::to_string(error.runs),
               in_unit(error.channel, error.rmse), in_unit(error.channel, error.bias),
               in_unit(error.channel, error.range), number(100 * error.share_of_range)});
  return table;
}

Report report_on(const Prediction& prediction, const Campaign& campaign, const Scenario& asked,
                 const std::string& soil_from) {
  Case question;
  question.scenario = asked;
  question.study.models = {{prediction.model, asked.effects, "", asked.errors, asked.misfit}};
  Report report{campaign.name, "A measured campaign beside the model's prediction; nothing is fitted.",
                fmt::format("{}: {} runs of {}, predicted with {}\n{}", campaign.name, prediction.runs.size(),
                            in_words(campaign.wheel), soil_from, errors_in_words(question))};
  report.sheet = drawn_once([&] { return campaign_sheet(campaign, prediction); });
  report.add("Over slip", Figure{report.sheet, "Points: measured; lines: predicted."});
  report.add("Predicted against measured",
             Figure{[&] { return scatter_sheet(campaign, prediction); }, "On the line both agree."});
  report.add("Run by run", runs_table(prediction));
  std::vector<std::string> unsolved;
  for (const PredictedRun& run : prediction.runs)
    if (!run.predicted.result) unsolved.push_back(fmt::format("run {}: no solution: {}", run.run, run.predicted.error));
  if (!unsolved.empty()) report.add(Sentences(unsolved));
  report.add("How far off", channel_errors_table(prediction, "",
                                                 {"channel", "runs", "rms error", "bias (predicted - measured)",
                                                  "measured range", "rms/range [%]"}));
  report.data = [&] { return to_json(prediction, campaign.name); };
  report.csv = [&] { return prediction_csv(prediction, remarks_on(campaign, asked, prediction)); };
  return report;
}

}  // namespace soilbin::compare
