// soilbin predict: a measured campaign, row by row, as the model predicts it. Nothing is fitted.
#include <fmt/core.h>

#include <memory>

#include "cli/commands.hpp"
#include "cli/flag_values.hpp"
#include "cli/outputs.hpp"
#include "cli/progress.hpp"
#include "compare/doubts/doubts.hpp"
#include "compare/measured/campaign.hpp"
#include "compare/sweep/prediction.hpp"
#include "compare/telling/loop_report.hpp"
#include "compare/telling/reports.hpp"
#include "cone_index/model.hpp"
#include "resistive_force/model.hpp"
#include "scenario/errors.hpp"

namespace soilbin::cli {
namespace {

struct PredictOptions {
  std::string campaign, model;
  OutputFlags outputs;
};

/// A wheel to predict with, and where its soil and effects come from.
struct Predictor {
  ModelKind kind = ModelKind::bekker_wong;
  Scenario scenario;
  std::string from;
};

/// The campaign's wheel and bin with its declared soil and effects, or those of a resolved model file; or its wheel by
/// resistive force theory or by its soil's cone index.
Predictor predictor_for(const PredictOptions& options, const compare::Campaign& campaign, const Workplace& place) {
  Scenario scenario = compare::scenario_of(campaign);
  if (options.model.empty()) return {ModelKind::bekker_wong, std::move(scenario), "the declared soil and not fitted"};
  if (options.model == resistive_force::model_name) {
    scenario.effects.clear();
    return {ModelKind::rft, std::move(scenario), "the declared soil, by resistive force theory, and not fitted"};
  }
  if (options.model == cone_index::model_name) {
    if (!campaign.cone_index && !campaign.cone_index_gradient)
      throw InputError(options.campaign +
                       ": --model cone_index needs the campaign's cone_index or, of sand, its cone_index_gradient");
    scenario.effects.clear();
    return {ModelKind::cone_index, std::move(scenario), "the declared cone index, and not fitted"};
  }
  const Case fitted = find_study(place, options.model);
  if (fitted.study.models.size() != 1 || fitted.study.models.front().model != ModelKind::bekker_wong)
    throw InputError(options.model + ": a model file for predict holds one model, bekker_wong");
  scenario.soil = fitted.scenario.soil;
  const bool to_these = fitted.source == compare::source_of_fit(campaign.name);
  return {
      ModelKind::bekker_wong, seen_by(fitted.study.models.front(), std::move(scenario)),
      options.model + (to_these ? ", which was fitted to these runs: the loop reports its error on conditions left out"
                                : " and not fitted")};
}

compare::Doubts doubts_of(const Predictor& predictor, const compare::Campaign& campaign,
                          const compare::Prediction& prediction) {
  if (predictor.kind == ModelKind::bekker_wong) return compare::doubts(campaign, predictor.scenario, prediction);
  if (predictor.kind == ModelKind::rft) return compare::resistive_force_doubts(predictor.scenario.soil);
  return compare::cone_index_doubts(predictor.scenario, conditions_of(prediction));
}

int predict(const PredictOptions& options, const Session& session) {
  const compare::Campaign campaign = find_campaign(session.place, options.campaign);
  const Predictor predictor = predictor_for(options, campaign, session.place);
  const auto model = compare::make_model(predictor.kind);
  const compare::Prediction prediction = compare::predict(*model, predictor.scenario, campaign, shown_progress());
  const Outputs outputs = publish(compare::report_on(prediction, campaign, predictor.scenario, predictor.from),
                                  options.outputs, doubts_of(predictor, campaign, prediction), session);
  if (prediction.unsolved < prediction.runs.size()) return outputs.status(done);
  fmt::print(stderr, "soilbin: no run of the campaign has a solution\n");
  return failed;
}

}  // namespace

void add_predict(CLI::App& app, Session& session) {
  CLI::App* command =
      app.add_subcommand("predict", "each run of a measured campaign beside its prediction, nothing fitted");
  const auto options = std::make_shared<PredictOptions>();
  add_value(*command, "campaign", options->campaign, "CAMPAIGN", "a campaign of the library, or its folder")
      ->required();
  add_value(*command, "--model", options->model, "FILE|rft|cone_index",
            "a resolved model (soilbin-case/1) in place of the declared soil and effects; or rft, or cone_index");
  options->outputs.add_to(*command, {.json = "soilbin-predict/1, in SI",
                                     .plot = "draw measured and predicted against slip",
                                     .csv = "save each run as measured and as predicted"});
  command->footer("Example: soilbin predict cmu-smooth --plot predicted.svg");
  command->callback([=, &session] { session.action = [=, &session] { return predict(*options, session); }; });
}

}  // namespace soilbin::cli
