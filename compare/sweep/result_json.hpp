// Results as JSON, with the names that every format of soilbin uses. A value that is not a number is written as null.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "compare/measured/campaign.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/sweep/answers.hpp"
#include "compare/sweep/prediction.hpp"

namespace soilbin::compare {

/// {"load": N, "slip": -, ...} in SI; speed, angles, pass and what else differs from nothing.
Json to_json(const OperatingCondition& at);

/// The channels' names at the top ("drawbar_pull", ..., "theta_1" [rad]), their standard errors under "std_error",
/// then efficiency (null unless has_efficiency), angles and budget; or {"error": "..."} beside the condition.
Json to_json(const Answer& answer);

/// Reads back what to_json wrote. `place` names the row in errors, such as "runs.json: rows[3]". Throws InputError.
OperatingCondition condition_from_json(const Json& row, const std::string& place);
Answer answer_from_json(const Json& row, const std::string& place);

/// "properties" of a JSON Schema for what to_json writes of a condition.
Json condition_schema();

/// Every answer of every model as a flat list; each row names its model, and has power [W] and energy a metre [J/m] of
/// the wheel.
Json rows_json(const Tire& tire, const std::vector<ModelAnswers>& study);

/// soilbin-run/1 with these rows, as yet without warnings.
Json run_json(const Case& question, Json rows);

/// soilbin-predict/1: of each run the number, what was predicted as of any answer, its condition, what was measured and
/// the residual; then the errors.
Json to_json(const Prediction& prediction, const std::string& campaign);

/// What to remark on an answer of a model; "" nothing (compare/doubts/doubts.hpp: remark_on).
using Remark = std::function<std::string(const ModelChoice&, const Answer&)>;

/// Answers as CSV: model, condition, four results with standard errors, angles, error, remark; SI, angles in degrees.
std::string study_csv(const std::vector<ModelAnswers>& study, const Remark& remark);

/// Runs as CSV: run, setpoint, condition, each channel as measured (empty: it wasn't), as predicted, and the
/// prediction's standard error; error, remark. SI, angles in degrees. `remarks`: one for each run.
std::string prediction_csv(const Prediction& prediction, const std::vector<std::string>& remarks);

// A result's members as JSON keys, for the visitors of json_fields.hpp. The names are those of the file formats.

/// Four results, their standard errors, efficiency, angles, budget. `result`: a TractionResult, const or not.
template <class Visitor, class Result>
void result_fields(Visitor& v, Result& result) {
  for (const ChannelView& channel : channel_views)
    v.number(channel.name, (result.*channel.predicted).value, channel.si_unit, channel.title.data());
  v.number("theta_1", result.entry_angle, "rad", "where soil meets the wheel, from the vertical");
  v.group("std_error", "standard errors", [&](auto& inner) {
    for (const ChannelView& channel : channel_views)
      inner.number(channel.name, (result.*channel.predicted).std_error, channel.si_unit, channel.title.data());
  });
  v.number("tractive_efficiency", result.tractive_efficiency, "-",
           "power at the drawbar over power put in; an efficiency from 0 to 1");
  v.number("theta_m", result.max_stress_angle, "rad", "where soil presses most");
  v.number("theta_2", result.exit_angle, "rad", "where soil lets go; negative behind the axle");
  v.list("budget", result.budget, "parts of the drawbar pull", [](auto& inner, auto& part) {
    inner.text("name", part.name, "what pulls");
    inner.number("force", part.force, "N", "its part");
  });
  v.added_group("budget_rest", "what the parts leave of the drawbar pull", [&](auto& inner) {
    inner.number("force", result.budget_rest.force, "N", "drawbar pull less the sum of the parts");
    inner.number("bound", result.budget_rest.bound, "N", "largest rest that is no sign of a fault; null: not known");
  });
}

/// Stresses under the wheel.
template <class Visitor, class Result>
void stress_fields(Visitor& v, Result& result) {
  v.list("patch", result.patch, "stresses under the wheel, from exit to entry", [](auto& inner, auto& at) {
    inner.number("theta", at.theta, "rad", "from the vertical, entry side positive");
    inner.number("normal", at.normal, "Pa", "pressing on the wheel");
    inner.number("shear", at.shear, "Pa", "in the wheel's plane, positive forward");
    inner.number("lateral_shear", at.lateral_shear, "Pa", "to the left");
  });
}

}  // namespace soilbin::compare
