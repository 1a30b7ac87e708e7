#include <fmt/core.h>

#include "compare/calibrate/calibration_words.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/report/number_text.hpp"
#include "compare/sweep/result_json.hpp"
#include "compare/sweep/varying.hpp"
#include "scenario/nearest_word.hpp"

namespace soilbin::compare {
namespace {

constexpr OfChannels<const char*> wholes = {"W", "W r", "r", "W"};

bool is_measured(const Decision& decision, std::size_t channel) {
  for (const Setpoint& setpoint : decision.setpoints)
    if (setpoint.measured[channel]) return true;
  return false;
}

bool has_reruns(const Decision& decision) {
  for (const Setpoint& setpoint : decision.setpoints)
    for (const std::optional<Estimate>& measured : setpoint.measured)
      if (measured && measured->std_error > 0) return true;
  return false;
}

std::vector<std::string> tied_names(const Decision& decision, std::size_t but) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < decision.trials.size(); ++k)
    if (k != but && decision.trials[k].error && !decision.trials[k].apart) names.push_back(candidate_name(k));
  return names;
}

std::string error_text(const Estimate& error) { return number(error, 100) + " %"; }

std::string failure_of(const Trial& trial) {
  for (const Answer& answer : trial.answers)
    if (!answer.result) return fmt::format("at {}: {}", in_words(answer.at), answer.error);
  return "";
}

std::string verdict(const Decision& decision, std::size_t candidate) {
  const Trial& trial = decision.trials[candidate];
  if (!trial.error) return failure_of(trial);
  if (candidate == decision.chosen) return "chosen";
  if (trial.apart) return "farther off";
  return candidate == decision.nearest ? "nearest, not told apart" : "not told apart";
}

Json by_channel(const OfChannels<std::optional<Estimate>>& values) {
  Json json = Json::object();
  for (std::size_t c = 0; c < values.size(); ++c)
    if (values[c]) json[std::string(channel_views[c].name)] = estimate_json(*values[c]);
  return json;
}

Json json_of(const Trial& trial) {
  Json answers = Json::array();
  for (const Answer& answer : trial.answers) answers.push_back(to_json(answer));
  return {{"error", trial.error ? estimate_json(*trial.error) : Json(nullptr)},
          {"errors", by_channel(trial.errors)},
          {"apart", trial.apart},
          {"answers", answers}};
}

}  // namespace

std::string candidate_name(std::size_t candidate) {
  return fmt::format("({})", static_cast<char>('a' + static_cast<char>(candidate)));
}

std::vector<std::string> decision_sentences(const Decision& decision) {
  if (!decision.decided())
    return {
        fmt::format("In the soil bin no candidate had a result at all {} setpoints of {}: the likeliest is kept. {}.",
                    decision.setpoints.size(), decision.campaign, failure_of(decision.trials.front()))};
  std::vector<std::string> said;
  said.push_back(fmt::format("In the soil bin {} is nearest to {}: {} of the load off, over {} setpoint{}.",
                             candidate_name(decision.nearest), decision.campaign,
                             error_text(*decision.trials[decision.nearest].error), decision.setpoints.size(),
                             decision.setpoints.size() == 1 ? "" : "s"));
  if (decision.tied() > 1)
    said.push_back(fmt::format(
        "It is not told apart from {} by two standard errors: {}, the likeliest of these on the targets, is chosen.",
        listed(tied_names(decision, decision.nearest)), candidate_name(decision.chosen)));
  if (!has_reruns(decision))
    said.push_back(
        fmt::format("{} repeats no setpoint: its own scatter is not known and counts as none.", decision.campaign));
  if (decision.not_steady > 0)
    said.push_back(fmt::format("{} of the {} runs did not become steady.", decision.not_steady, decision.runs));
  return said;
}

std::vector<std::string> decision_columns(const Decision& decision) {
  std::vector<std::string> header;
  for (std::size_t c = 0; c < channel_views.size(); ++c)
    if (is_measured(decision, c)) header.push_back(fmt::format("{} off [% {}]", channel_views[c].title, wholes[c]));
  header.insert(header.end(), {"off [%]", "soil bin"});
  return header;
}

std::vector<std::string> decision_cells(const Decision& decision, std::size_t candidate) {
  const Trial& trial = decision.trials[candidate];
  std::vector<std::string> row;
  for (std::size_t c = 0; c < channel_views.size(); ++c)
    if (is_measured(decision, c)) row.push_back(trial.errors[c] ? number(*trial.errors[c], 100) : "-");
  row.push_back(trial.error ? number(*trial.error, 100) : "-");
  row.push_back(verdict(decision, candidate));
  return row;
}

nlohmann::ordered_json to_json(const Decision& decision) {
  Json setpoints = Json::array(), trials = Json::array();
  for (const Setpoint& setpoint : decision.setpoints)
    setpoints.push_back(
        {{"at", to_json(setpoint.at)}, {"runs", setpoint.runs}, {"measured", by_channel(setpoint.measured)}});
  for (const Trial& trial : decision.trials) trials.push_back(json_of(trial));
  return {{"campaign", decision.campaign},     {"decided", decision.decided()}, {"nearest", decision.nearest},
          {"chosen", decision.chosen},         {"tied", decision.tied()},       {"runs", decision.runs},
          {"not_steady", decision.not_steady}, {"setpoints", setpoints},        {"trials", trials}};
}

}  // namespace soilbin::compare
