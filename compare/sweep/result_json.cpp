#include "compare/sweep/result_json.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "compare/report/number_text.hpp"
#include "compare/sweep/wheel_power.hpp"
#include "scenario/csv.hpp"
#include "scenario/mapping_writer.hpp"
#include "scenario/unit.hpp"

namespace soilbin::compare {
namespace {

template <class T>
constexpr bool may_be_absent = false;
template <class T>
constexpr bool may_be_absent<std::optional<T>> = true;

/// A member of a condition, read back as it was written.
template <class N>
void read_member(const ReadJson& from, const char* key, N& into) {
  if constexpr (may_be_absent<N>) {
    if (from.has(key)) read_member(from, key, into.emplace());
  } else if constexpr (std::is_enum_v<N>) {
    const Json& found = from.at(key);
    const auto value = found.is_string() ? value_named<N>(found.get<std::string>()) : std::nullopt;
    if (!value) ReadJson::refuse(from.below(key), "one of the words of a case file");
    into = *value;
  } else {
    constexpr bool whole = std::is_integral_v<N>;
    if (!(whole ? from.at(key).is_number_integer() : from.at(key).is_number()))
      ReadJson::refuse(from.below(key), whole ? "a whole number" : "a number");
    into = from.at(key).get<N>();
  }
}

Json errors_json(const std::vector<ChannelError>& errors) {
  Json all = Json::object();
  for (const ChannelError& error : errors) {
    const ChannelView& channel = channel_views[error.channel];
    all[std::string(channel.name)] = {{"unit", channel.si_unit},      {"runs", error.runs},
                                      {"rmse", finite(error.rmse)},   {"bias", finite(error.bias)},
                                      {"range", finite(error.range)}, {"share_of_range", finite(error.share_of_range)}};
  }
  return all;
}

/// What to_json says of an answer beside its condition.
void write_result(Json& row, const Answer& answer) {
  if (!answer.result) {
    row["error"] = answer.error;
    return;
  }
  WriteJson visitor(row);
  result_fields(visitor, *answer.result);
  row["tractive_efficiency"] = finite(reported_efficiency(*answer.result));
  if (std::isfinite(answer.result->contact_area)) row["contact_area"] = answer.result->contact_area;
  if (!answer.result->without_error_of.empty()) row["std_error_without"] = answer.result->without_error_of;
}

Json run_json(const PredictedRun& run) {
  Json row = {{"run", run.run}};
  write_result(row, run.predicted);
  if (run.measured.setpoint) row["setpoint"] = *run.measured.setpoint;
  row["at"] = to_json(run.measured.at);
  for (const ChannelView& channel : channel_views) {
    const std::string name(channel.name);
    if (const auto& value = run.measured.*channel.measured) row["measured"][name] = finite(*value);
    if (const auto rest = residual(run, channel)) row["residual"][name] = finite(*rest);
  }
  return row;
}

/// The columns of a condition; that of the inflation pressure where any condition tells one.
std::string condition_columns(bool with_pressure) {
  return std::string("load_N,slip,speed_m_s,longitudinal_incline_deg,transverse_incline_deg,yaw_deg,pass,") +
         (with_pressure ? "inflation_pressure_kPa," : "");
}

std::string condition_cells(const OperatingCondition& at, bool with_pressure) {
  const std::string pressure = at.inflation_pressure ? csv_number(*at.inflation_pressure / 1000) : "";
  return fmt::format("{},{},{},{},{},{},{}", csv_number(at.load), csv_number(at.slip), csv_number(at.speed),
                     csv_number(at.longitudinal_incline / degree), csv_number(at.transverse_incline / degree),
                     csv_number(at.yaw / degree), at.pass) +
         (with_pressure ? "," + pressure : "");
}

std::string csv_row(const std::string& model, const Answer& answer, const std::string& remark, bool with_pressure) {
  std::string row = csv_cell(model) + ',' + condition_cells(answer.at, with_pressure);
  if (!answer.result) return row + std::string(12, ',') + ',' + csv_cell(answer.error) + ',' + csv_cell(remark) + "\n";
  const TractionResult& r = *answer.result;
  for (const ChannelView& channel : channel_views)
    row += "," + csv_number((r.*channel.predicted).value) + "," + csv_number((r.*channel.predicted).std_error);
  row += "," + (has_efficiency(r) ? csv_number(reported_efficiency(r)) : "");
  return row + fmt::format(",{},{},{},,{}\n", csv_number(r.entry_angle / degree),
                           csv_number(r.max_stress_angle / degree), csv_number(r.exit_angle / degree),
                           csv_cell(remark));
}

/// Files from before budget_rest hold the rest of a run of grains as a part.
void take_rest_out(TractionResult& result) {
  const auto row =
      std::ranges::find_if(result.budget, [](const Contribution& part) { return part.name == "between_samples"; });
  if (row == result.budget.end()) return;
  result.budget_rest.force = row->force;
  result.budget.erase(row);
}

}  // namespace

Json to_json(const OperatingCondition& at) {
  Json document;
  each_member<OperatingCondition>([&](const char* key, auto member, const auto&, const char*) {
    const auto& value = at.*member;
    if constexpr (may_be_absent<std::decay_t<decltype(value)>>) {
      if (value) document[key] = *value;
    } else if constexpr (std::is_enum_v<std::decay_t<decltype(value)>>) {
      document[key] = std::string(word_of(value));
    } else {
      document[key] = value;
    }
  });
  return document;
}

Json to_json(const Answer& answer) {
  Json row = to_json(answer.at);
  write_result(row, answer);
  return row;
}

OperatingCondition condition_from_json(const Json& row, const std::string& place) {
  const ReadJson reader(row, place);
  OperatingCondition at;
  each_member<OperatingCondition>(
      [&](const char* key, auto member, const auto&, const char*) { read_member(reader, key, at.*member); });
  return at;
}

Answer answer_from_json(const Json& row, const std::string& place) {
  Answer answer{condition_from_json(row, place), std::nullopt, ""};
  ReadJson visitor(row, place);
  if (visitor.has("error")) {
    visitor.text("error", answer.error, "");
  } else {
    result_fields(visitor, answer.result.emplace());
    take_rest_out(*answer.result);
    answer.result->at = answer.at;
  }
  return answer;
}

Json condition_schema() {
  Json properties = Json::object();
  each_member<OperatingCondition>([&](const char* key, auto member, const auto& limits, const char* meaning) {
    using Limits = std::decay_t<decltype(limits)>;
    if constexpr (std::is_same_v<Limits, Measure>)
      properties[key] = {{"type", "number"}, {"description", std::string(meaning) + " [SI]"}};
    else if constexpr (std::is_same_v<Limits, int>)
      properties[key] = {{"type", "integer"}, {"minimum", limits}, {"description", meaning}};
    else
      properties[key] = {{"enum", all_words<std::decay_t<decltype(OperatingCondition().*member)>>()},
                         {"description", meaning}};
  });
  return properties;
}

Json rows_json(const Tire& tire, const std::vector<ModelAnswers>& study) {
  Json rows = Json::array();
  for (const ModelAnswers& model : study)
    for (const Answer& answer : model.answers) {
      Json row = {{"model", std::string(word_of(model.choice.model))}, {"label", model.choice.label}};
      row.update(to_json(answer));
      if (answer.result)
        if (const auto taken = power_of(tire, *answer.result))
          row["power"] = taken->power.value, row["energy_per_metre"] = taken->energy.value;
      rows.push_back(std::move(row));
    }
  return rows;
}

Json run_json(const Case& question, Json rows) {
  return {{"format", "soilbin-run/1"},
          {"study", question.study.name},
          {"tire", question.scenario.tire.name},
          {"soil", question.scenario.soil.name},
          {"rows", std::move(rows)}};
}

Json to_json(const Prediction& prediction, const std::string& campaign) {
  Json document = {{"format", "soilbin-predict/1"}, {"campaign", campaign}, {"rows", Json::array()}};
  for (const PredictedRun& run : prediction.runs) document["rows"].push_back(run_json(run));
  document["error"] = errors_json(prediction.errors);
  return document;
}

std::string study_csv(const std::vector<ModelAnswers>& study, const Remark& remark) {
  const bool with_pressure = std::ranges::any_of(study, [](const ModelAnswers& model) {
    return std::ranges::any_of(model.answers, [](const Answer& a) { return a.at.inflation_pressure.has_value(); });
  });
  std::string text = std::string("model,") + condition_columns(with_pressure);
  for (const TractionChannel& channel : traction_channels)
    text += column_of(channel) + "," + column_of(channel, "se") + ",";
  text += "tractive_efficiency,theta_1_deg,theta_m_deg,theta_2_deg,error,remark\n";
  for (const ModelAnswers& model : study)
    for (const Answer& answer : model.answers)
      text += csv_row(model.choice.label, answer, remark(model.choice, answer), with_pressure);
  return text;
}

std::string prediction_csv(const Prediction& prediction, const std::vector<std::string>& remarks) {
  constexpr int digits = 15;  // of what was measured and is set against it: a residual may be small beside both
  const bool with_pressure = std::ranges::any_of(
      prediction.runs, [](const PredictedRun& run) { return run.measured.at.inflation_pressure.has_value(); });
  std::string text = std::string("run,setpoint,") + condition_columns(with_pressure);
  for (const TractionChannel& channel : traction_channels)
    text += fmt::format("{},{},{},", column_of(channel, "measured"), column_of(channel, "predicted"),
                        column_of(channel, "se"));
  text += "error,remark\n";
  for (std::size_t i = 0; i < prediction.runs.size(); ++i) {
    const PredictedRun& run = prediction.runs[i];
    text += fmt::format("{},{},{},", run.run, csv_cell(run.measured.setpoint.value_or("")),
                        condition_cells(run.measured.at, with_pressure));
    for (const ChannelView& channel : channel_views) {
      const std::optional<double>& measured = run.measured.*channel.measured;
      text += (measured ? csv_number(*measured, digits) : "") + ',';
      if (const auto& result = run.predicted.result) {
        const Estimate& predicted = (*result).*channel.predicted;
        text += csv_number(predicted.value, digits) + ',' + csv_number(predicted.std_error, digits) + ',';
      } else {
        text += ",,";
      }
    }
    text += csv_cell(run.predicted.error) + ',' + csv_cell(remarks.at(i)) + '\n';
  }
  return text;
}

}  // namespace soilbin::compare
