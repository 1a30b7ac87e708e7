// soilbin limits: what a wheel can do at best in a steady state: the largest pull, the steepest slope, the slip for
// each.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

#include "bekker_wong/limits.hpp"
#include "bekker_wong/model.hpp"
#include "cli/commands.hpp"
#include "cli/described_flags.hpp"
#include "cli/outputs.hpp"
#include "cli/question.hpp"
#include "cli/text_output.hpp"
#include "compare/doubts/doubts.hpp"
#include "compare/measured/csv.hpp"
#include "compare/sweep/result_json.hpp"
#include "compare/sweep/varying.hpp"
#include "scenario/errors.hpp"
#include "scenario/unit.hpp"

namespace soilbin::cli {
namespace {

/// What a wheel can do on one slope.
struct SlopeRow {
  double slope = 0.0;          ///< [rad]
  std::optional<double> slip;  ///< at which it travels without a load behind it
  bekker_wong::PullPeak best;

  bool operator==(const SlopeRow& other) const {
    return slope == other.slope && slip == other.slip && best.slip == other.best.slip &&
           best.drawbar_pull == other.best.drawbar_pull;
  }
};

/// One model at one load.
struct LimitsAnswer {
  ModelChoice model;
  OperatingCondition at;
  std::optional<double> steepest;  ///< [rad]
  std::vector<SlopeRow> slopes;
  std::string error;
  bool at_every_speed = false;  ///< of the question's: the same answer
};

/// Slopes from level ground to the steepest one, at whole degrees that make about ten rows.
std::vector<double> slopes_up_to(double steepest) {
  double step = 1.0;
  for (const double wider : {2.0, 5.0, 10.0})
    if (steepest / degree / step > 10.0) step = wider;
  std::vector<double> slopes = {0.0};
  while ((static_cast<double>(slopes.size()) * step) * degree < steepest)
    slopes.push_back(static_cast<double>(slopes.size()) * step * degree);
  if (steepest > 0.0) slopes.push_back(steepest);
  return slopes;
}

LimitsAnswer limits_of(const Scenario& scenario, const ModelChoice& model, const OperatingCondition& at) {
  LimitsAnswer answer{model, at, {}, {}, "", false};
  if (model.model != ModelKind::bekker_wong) throw InputError("limits asks the model bekker_wong alone");
  const bekker_wong::RollingWheel wheel(scenario.tire, bekker_wong::values_of(*scenario.soil.semi_empirical),
                                        bekker_wong::make_effects(model.effects), scenario.bin);
  try {
    OperatingCondition there = at;
    there.longitudinal_incline = 0.0;
    answer.steepest = bekker_wong::steepest_slope(wheel, there);
    for (const double slope : slopes_up_to(answer.steepest.value_or(0.0))) {
      there.longitudinal_incline = slope;
      SlopeRow row{slope, bekker_wong::slip_for_pull(wheel, there), bekker_wong::largest_pull(wheel, there)};
      if (row.slip && std::abs(*row.slip) < 1e-9) row.slip = 0.0;  // closer than the root is found
      if (slope == answer.steepest)
        row.slip = row.best.slip, row.best.drawbar_pull = 0.0;  // that is what steepest means
      answer.slopes.push_back(row);
    }
  } catch (const NoSolution& error) {
    answer.error = error.what();
  }
  return answer;
}

/// Whether two answers differ in nothing but the speed at which they were asked: most models hear nothing of it.
bool same_but_speed(const LimitsAnswer& a, const LimitsAnswer& b) {
  OperatingCondition at = b.at;
  at.speed = a.at.speed;
  return a.model.label == b.model.label && compare::alike(a.at, at) && a.error == b.error && a.steepest == b.steepest &&
         a.slopes == b.slopes;
}

/// The conditions of a question, slip left aside, each once.
std::vector<OperatingCondition> without_slip(const std::vector<OperatingCondition>& conditions) {
  std::vector<OperatingCondition> kept;
  std::set<std::string> seen;
  for (OperatingCondition at : conditions) {
    at.slip = 0.0;
    at.longitudinal_incline = 0.0;
    if (seen.insert(compare::to_json(at).dump()).second) kept.push_back(at);
  }
  return kept;
}

std::string steepest_in_words(double steepest) {
  if (steepest >= 0.0) return fmt::format("The steepest slope that it climbs is {} deg.", number(steepest / degree));
  return fmt::format(
      "It climbs no slope and doesn't move on level ground: it needs a downhill slope of {} deg or more.",
      number(-steepest / degree));
}

std::string limits_text(const LimitsAnswer& answer) {
  std::string text = fmt::format("{}, load {:.6g} N\n", answer.model.label, answer.at.load);
  if (!answer.error.empty()) return text + "no solution: " + answer.error + "\n";
  TextTable table({"slope [deg]", "slip [%]", "largest pull [N]", "at slip [%]"});
  for (const SlopeRow& row : answer.slopes)
    table.add({number(row.slope / degree), row.slip ? number(100 * *row.slip) : "-", number(row.best.drawbar_pull),
               number(100 * row.best.slip)});
  text += table.text();
  if (!answer.steepest) return text + "The steepest slope lies beyond -60 .. 80 deg.\n";
  return text + steepest_in_words(*answer.steepest) + "\n";
}

nlohmann::ordered_json limits_json(const LimitsAnswer& answer) {
  nlohmann::ordered_json row = {{"label", answer.model.label}};
  row.update(compare::to_json(answer.at));
  row.erase("slip");
  row.erase("longitudinal_incline");
  if (answer.at_every_speed) row.erase("speed");
  if (!answer.error.empty()) {
    row["error"] = answer.error;
    return row;
  }
  const auto value = [](const std::optional<double>& x) {
    return x ? nlohmann::ordered_json(*x) : nlohmann::ordered_json(nullptr);
  };
  row["steepest_slope"] = value(answer.steepest);
  row["slopes"] = nlohmann::ordered_json::array();
  for (const SlopeRow& slope : answer.slopes)
    row["slopes"].push_back({{"longitudinal_incline", slope.slope},
                             {"slip", value(slope.slip)},
                             {"largest_pull", slope.best.drawbar_pull},
                             {"slip_of_largest_pull", slope.best.slip}});
  return row;
}

/// `at_limits`: what the models answer there (answers_at_the_limits).
std::string limits_csv(const Case& question, const std::vector<LimitsAnswer>& answers,
                       const std::vector<compare::ModelAnswers>& at_limits) {
  std::string text =
      "model,load_N,speed_m_s,transverse_incline_deg,yaw_deg,pass,slope_deg,slip,largest_pull_N,slip_of_largest_pull,"
      "error,remark\n";
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const LimitsAnswer& answer = answers[i];
    const OperatingCondition& at = answer.at;
    const std::string asked = fmt::format("{},{},{},{},{},{}", compare::csv_cell(answer.model.label), at.load,
                                          answer.at_every_speed ? "" : fmt::format("{}", at.speed),
                                          at.transverse_incline / degree, at.yaw / degree, at.pass);
    if (!answer.error.empty()) text += asked + ",,,,," + compare::csv_cell(answer.error) + ",\n";
    for (std::size_t k = 0; k < answer.slopes.size(); ++k) {
      const SlopeRow& row = answer.slopes[k];
      const std::string remark = compare::remark_on(question.scenario, answer.model, at_limits[i].answers[k]);
      text +=
          fmt::format("{},{},{},{},{},,{}\n", asked, row.slope / degree, row.slip ? fmt::format("{}", *row.slip) : "",
                      row.best.drawbar_pull, row.best.slip, compare::csv_cell(remark));
    }
  }
  return text;
}

/// Largest pull against the slope, and the slips: a colour for each model and load.
compare::Sheet limits_sheet(const Case& question, const std::vector<LimitsAnswer>& answers) {
  const compare::Axis slope{"slope [deg]"};
  const bool one_load = std::all_of(answers.begin(), answers.end(), [&](const LimitsAnswer& answer) {
    return answer.at.load == answers.front().at.load;
  });
  compare::Sheet sheet{
      fmt::format("{} on {}{}", question.scenario.tire.name, compare::in_words(question.scenario.soil),
                  one_load && !answers.empty() ? fmt::format(", load {:.6g} N", answers.front().at.load) : ""),
      {{"Largest pull [N]", slope, {}, {}}, {"Slip [%]", slope, {}, {}}}};
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const LimitsAnswer& answer = answers[i];
    const std::string which = answers.size() < 2 ? ""
                              : one_load         ? answer.model.label
                                                 : fmt::format("{}, {:.6g} N", answer.model.label, answer.at.load);
    const auto add = [&](std::size_t plot, const std::string& label, int dash, const auto& value) {
      compare::Series series{which.empty() ? label : which + (label.empty() ? "" : ": " + label)};
      series.mark = compare::Mark::line_and_points, series.color = static_cast<int>(i), series.dash = dash;
      for (const SlopeRow& row : answer.slopes) series.x.push_back(row.slope / degree), series.y.push_back(value(row));
      sheet.plots[plot].series.push_back(std::move(series));
    };
    add(0, "", 0, [](const SlopeRow& row) { return row.best.drawbar_pull; });
    add(1, "to climb this slope", 0, [](const SlopeRow& row) { return row.slip ? 100 * *row.slip : not_a_number; });
    add(1, "of the largest pull", 1, [](const SlopeRow& row) { return 100 * row.best.slip; });
  }
  return sheet;
}

/// The wheel where it pulls most on each slope: what there is to doubt in the answer.
std::vector<compare::ModelAnswers> answers_at_the_limits(const Case& question,
                                                         const std::vector<LimitsAnswer>& answers) {
  const bekker_wong::BekkerWong model({.errors = false, .patch = false});
  std::vector<compare::ModelAnswers> study;
  for (const LimitsAnswer& answer : answers) {
    Scenario scenario = question.scenario;
    scenario.effects = answer.model.effects;
    study.push_back({answer.model, {}});
    for (const SlopeRow& row : answer.slopes) {
      OperatingCondition at = answer.at;
      at.longitudinal_incline = row.slope, at.slip = row.best.slip;
      study.back().answers.push_back(compare::ask(model, scenario, at));
    }
  }
  return study;
}

struct LimitsOptions {
  bool json = false;
  std::string csv, plot;
};

int limits(const Question& inputs, const LimitsOptions& options, const Session& session) {
  for (const char* key : {"slip", "longitudinal_incline"})
    if (inputs.given(key))
      throw InputError(
          fmt::format("{} is what limits looks for: leave it out\n  hint: soilbin estimate answers at a slip "
                      "and on a slope that are given",
                      flag_of("", key)));
  const Case question = inputs.ask(session.place);
  require_semi_empirical(question, session.place.library);
  std::vector<LimitsAnswer> answers;
  for (const ModelChoice& model : question.study.models)
    for (const OperatingCondition& at : without_slip(question.study.conditions)) {
      LimitsAnswer answer = limits_of(question.scenario, model, at);
      const auto known = std::find_if(answers.begin(), answers.end(),
                                      [&](const LimitsAnswer& other) { return same_but_speed(other, answer); });
      if (known == answers.end())
        answers.push_back(std::move(answer));
      else
        known->at_every_speed = true;
    }
  const std::vector<compare::ModelAnswers> at_limits = answers_at_the_limits(question, answers);
  const std::vector<std::string> doubts = compare::doubts(question, at_limits);
  print_warnings(doubts);
  Outputs outputs;
  outputs.file(options.csv, [&] { return limits_csv(question, answers, at_limits); });
  outputs.drawing(options.plot, [&] { return limits_sheet(question, answers); });
  if (options.json) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const LimitsAnswer& answer : answers) rows.push_back(limits_json(answer));
    print_json(document_of("soilbin-limits/1", question, rows), doubts);
  } else {
    fmt::print("{} on {}\n", in_words(question.scenario.tire), compare::in_words(question.scenario.soil));
    for (const LimitsAnswer& answer : answers) fmt::print("\n{}", limits_text(answer));
  }
  for (const LimitsAnswer& answer : answers)
    if (answer.error.empty()) return outputs.status(done);
  fmt::print(stderr, "soilbin: no solution: {}\n", answers.front().error);
  return failed;
}

}  // namespace

void add_limits(CLI::App& app, Session& session) {
  CLI::App* command = app.add_subcommand("limits", "the largest pull and the steepest slope, and the slip for each");
  const auto inputs = std::make_shared<Question>(*command, std::vector<std::string>{"load"});
  const auto options = std::make_shared<LimitsOptions>();
  add_plot(*command, options->plot, "draw the largest pull and the slips against the slope");
  add_file(*command, "--csv", options->csv, "FILE.csv", "save the table");
  command->add_flag("--json", options->json, "soilbin-limits/1, in SI");
  command->footer(
      "A load that has no solution is told in its place; the status is 1 where none has one.\n"
      "Example: soilbin limits --tire rover-wheel --soil dry-sand --load 64.68N");
  command->callback([=, &session] { session.action = [=, &session] { return limits(*inputs, *options, session); }; });
}

}  // namespace soilbin::cli
