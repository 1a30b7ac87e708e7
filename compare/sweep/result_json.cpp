#include "compare/sweep/result_json.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "compare/measured/channels.hpp"
#include "compare/measured/csv.hpp"
#include "compare/sweep/result_fields.hpp"
#include "scenario/mapping_writer.hpp"
#include "scenario/unit.hpp"

namespace soilbin::compare {
namespace {

/// The visitor of OperatingCondition's description that writes its members in SI.
class ConditionJson {
 public:
  using C = OperatingCondition;

  explicit ConditionJson(const C& at) : at_(at) {}
  Json document;

  void number(const char* key, double C::*member, const Measure&, Need, const char*) { document[key] = at_.*member; }
  void number(const char* key, std::optional<double> C::*member, const Measure&, Need, const char*) {
    if (at_.*member) document[key] = *(at_.*member);
  }
  void integer(const char* key, int C::*member, int, Need, const char*) { document[key] = at_.*member; }
  void integer(const char* key, std::optional<int> C::*member, int, Need, const char*) {
    if (at_.*member) document[key] = *(at_.*member);
  }
  template <class E>
  void choice(const char* key, E C::*member, Need, const char*) {
    document[key] = std::string(word_of(at_.*member));
  }

 private:
  const C& at_;
};

/// The visitor of OperatingCondition's description that reads what ConditionJson wrote.
class ConditionFromJson {
 public:
  using C = OperatingCondition;

  explicit ConditionFromJson(const ReadJson& from) : from_(from) {}
  C at;

  void number(const char* key, double C::*member, const Measure&, Need, const char*) { at.*member = number_at(key); }
  void number(const char* key, std::optional<double> C::*member, const Measure&, Need, const char*) {
    if (from_.has(key)) at.*member = number_at(key);
  }
  void integer(const char* key, int C::*member, int, Need, const char*) { at.*member = whole_at(key); }
  void integer(const char* key, std::optional<int> C::*member, int, Need, const char*) {
    if (from_.has(key)) at.*member = whole_at(key);
  }
  template <class E>
  void choice(const char* key, E C::*member, Need, const char*) {
    const Json& found = from_.at(key);
    const auto value = found.is_string() ? value_named<E>(found.get<std::string>()) : std::nullopt;
    if (!value) ReadJson::refuse(from_.below(key), "one of the words of a case file");
    at.*member = *value;
  }

 private:
  double number_at(const char* key) const {
    if (!from_.at(key).is_number()) ReadJson::refuse(from_.below(key), "a number");
    return from_.at(key).get<double>();
  }
  int whole_at(const char* key) const {
    if (!from_.at(key).is_number_integer()) ReadJson::refuse(from_.below(key), "a whole number");
    return from_.at(key).get<int>();
  }

  const ReadJson& from_;
};

/// The visitor that makes the schema of what ConditionJson writes.
class ConditionSchema {
 public:
  using C = OperatingCondition;

  Json properties = Json::object();

  template <class N>
  void number(const char* key, N C::*, const Measure&, Need, const char* meaning) {
    properties[key] = {{"type", "number"}, {"description", std::string(meaning) + " [SI]"}};
  }
  template <class N>
  void integer(const char* key, N C::*, int lowest, Need, const char* meaning) {
    properties[key] = {{"type", "integer"}, {"minimum", lowest}, {"description", meaning}};
  }
  template <class E>
  void choice(const char* key, E C::*, Need, const char* meaning) {
    properties[key] = {{"enum", all_words<E>()}, {"description", meaning}};
  }
};

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

Json run_json(const PredictedRun& run) {
  Json row = {{"run", run.run}};
  if (run.predicted.result) {
    const TractionResult& result = *run.predicted.result;
    for (const ChannelView& channel : channel_views)
      row[std::string(channel.name)] = finite((result.*channel.predicted).value);
    row["theta_1"] = finite(result.entry_angle);
  } else {
    row["error"] = run.predicted.error;
  }
  if (run.measured.setpoint) row["setpoint"] = *run.measured.setpoint;
  row["at"] = to_json(run.measured.at);
  for (const ChannelView& channel : channel_views) {
    const std::string name(channel.name);
    if (const auto& value = run.measured.*channel.measured) row["measured"][name] = finite(*value);
    if (const auto rest = residual(run, channel)) row["residual"][name] = finite(*rest);
  }
  return row;
}

constexpr const char* condition_columns =
    "load_N,slip,speed_m_s,longitudinal_incline_deg,transverse_incline_deg,yaw_deg,pass,";

std::string condition_cells(const OperatingCondition& at) {
  return fmt::format("{},{},{},{},{},{},{}", at.load, at.slip, at.speed, at.longitudinal_incline / degree,
                     at.transverse_incline / degree, at.yaw / degree, at.pass);
}

std::string csv_row(const std::string& model, const Answer& answer, const std::string& remark) {
  std::string row = csv_cell(model) + ',' + condition_cells(answer.at);
  if (!answer.result) return row + std::string(12, ',') + ',' + csv_cell(answer.error) + ',' + csv_cell(remark) + "\n";
  const TractionResult& r = *answer.result;
  for (const ChannelView& channel : channel_views)
    row += fmt::format(",{},{}", (r.*channel.predicted).value, (r.*channel.predicted).std_error);
  row += has_efficiency(r) ? fmt::format(",{}", reported_efficiency(r)) : std::string(",");
  return row + fmt::format(",{},{},{},,{}\n", r.entry_angle / degree, r.max_stress_angle / degree,
                           r.exit_angle / degree, csv_cell(remark));
}

/// Files from before budget_rest hold the rest of a run of grains as a part.
void take_rest_out(TractionResult& result) {
  const auto row = std::find_if(result.budget.begin(), result.budget.end(),
                                [](const Contribution& part) { return part.name == "between_samples"; });
  if (row == result.budget.end()) return;
  result.budget_rest.force = row->force;
  result.budget.erase(row);
}

}  // namespace

Json to_json(const OperatingCondition& at) {
  ConditionJson visitor(at);
  describe(visitor, std::type_identity<OperatingCondition>{});
  return visitor.document;
}

Json to_json(const Answer& answer) {
  Json row = to_json(answer.at);
  if (answer.result) {
    WriteJson visitor(row);
    result_fields(visitor, *answer.result);
    row["tractive_efficiency"] = finite(reported_efficiency(*answer.result));
    if (!answer.result->without_error_of.empty()) row["std_error_without"] = answer.result->without_error_of;
  } else {
    row["error"] = answer.error;
  }
  return row;
}

OperatingCondition condition_from_json(const Json& row, const std::string& place) {
  const ReadJson reader(row, place);
  ConditionFromJson visitor(reader);
  describe(visitor, std::type_identity<OperatingCondition>{});
  return visitor.at;
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
  ConditionSchema visitor;
  describe(visitor, std::type_identity<OperatingCondition>{});
  return visitor.properties;
}

Json rows_json(const std::vector<ModelAnswers>& study) {
  Json rows = Json::array();
  for (const ModelAnswers& model : study)
    for (const Answer& answer : model.answers) {
      Json row = {{"model", std::string(word_of(model.choice.model))}, {"label", model.choice.label}};
      row.update(to_json(answer));
      rows.push_back(std::move(row));
    }
  return rows;
}

Json to_json(const Prediction& prediction, const std::string& campaign) {
  Json document = {{"format", "soilbin-predict/1"}, {"campaign", campaign}, {"rows", Json::array()}};
  for (const PredictedRun& run : prediction.runs) document["rows"].push_back(run_json(run));
  document["error"] = errors_json(prediction.errors);
  return document;
}

std::string study_csv(const std::vector<ModelAnswers>& study, const Remark& remark) {
  std::string text = std::string("model,") + condition_columns;
  for (const TractionChannel& channel : traction_channels)
    text += column_of(channel) + "," + column_of(channel, "se") + ",";
  text += "tractive_efficiency,theta_1_deg,theta_m_deg,theta_2_deg,error,remark\n";
  for (const ModelAnswers& model : study)
    for (const Answer& answer : model.answers)
      text += csv_row(model.choice.label, answer, remark(model.choice, answer));
  return text;
}

std::string prediction_csv(const Prediction& prediction, const std::vector<std::string>& remarks) {
  std::string text = std::string("run,setpoint,") + condition_columns;
  for (const TractionChannel& channel : traction_channels)
    text += fmt::format("{},{},{},", column_of(channel, "measured"), column_of(channel, "predicted"),
                        column_of(channel, "se"));
  text += "error,remark\n";
  for (std::size_t i = 0; i < prediction.runs.size(); ++i) {
    const PredictedRun& run = prediction.runs[i];
    text += fmt::format("{},{},{},", run.run, csv_cell(run.measured.setpoint.value_or("")),
                        condition_cells(run.measured.at));
    for (const ChannelView& channel : channel_views) {
      const std::optional<double>& measured = run.measured.*channel.measured;
      text += (measured ? fmt::format("{}", *measured) : "") + ',';
      if (const auto& result = run.predicted.result) {
        const Estimate& predicted = (*result).*channel.predicted;
        text += fmt::format("{},{},", predicted.value, predicted.std_error);
      } else {
        text += ",,";
      }
    }
    text += csv_cell(run.predicted.error) + ',' + csv_cell(remarks.at(i)) + '\n';
  }
  return text;
}

}  // namespace soilbin::compare
