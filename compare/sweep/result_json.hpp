// Results as JSON, with the contract's names. A value that is not a number is written as null.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "compare/report/json_fields.hpp"
#include "compare/sweep/answers.hpp"
#include "compare/sweep/prediction.hpp"

namespace soilbin::compare {

/// {"load": N, "slip": -, ...} in SI; speed, angles, pass and what else differs from nothing.
Json to_json(const OperatingCondition& at);

/// The contract's names at the top ("drawbar_pull", ..., "theta_1" [rad]), their standard errors under "std_error",
/// then efficiency (null unless has_efficiency), angles and budget; or {"error": "..."} beside the condition.
Json to_json(const Answer& answer);

/// Reads back what to_json wrote. `place` names the row in errors, such as "runs.json: rows[3]". Throws InputError.
OperatingCondition condition_from_json(const Json& row, const std::string& place);
Answer answer_from_json(const Json& row, const std::string& place);

/// "properties" of a JSON Schema for what to_json writes of a condition.
Json condition_schema();

/// Every answer of every model as a flat list; each row names its model.
Json rows_json(const std::vector<ModelAnswers>& study);

/// soilbin-predict/1.
Json to_json(const Prediction& prediction, const std::string& campaign);

/// What to remark on an answer of a model; "" nothing (compare/doubts/doubts.hpp: remark_on).
using Remark = std::function<std::string(const ModelChoice&, const Answer&)>;

/// Answers as CSV: model, condition, four results with standard errors, angles, error, remark; SI, angles in degrees.
std::string study_csv(const std::vector<ModelAnswers>& study, const Remark& remark);

/// Runs as CSV: run, setpoint, condition, each channel as measured (empty: it wasn't), as predicted, and the
/// prediction's standard error; error, remark. SI, angles in degrees. `remarks`: one for each run.
std::string prediction_csv(const Prediction& prediction, const std::vector<std::string>& remarks);

}  // namespace soilbin::compare
