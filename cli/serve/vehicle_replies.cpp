#include "cli/serve/vehicle_replies.hpp"

#include <algorithm>

#include "bekker_wong/model.hpp"
#include "cli/command_words.hpp"
#include "cli/outputs.hpp"
#include "cli/progress.hpp"
#include "cli/serve/controls.hpp"
#include "cli/serve/served_answer.hpp"
#include "cli/vehicle_question.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/telling/reports.hpp"
#include "compare/vehicle/vehicle_answers.hpp"
#include "compare/vehicle/vehicle_doubts.hpp"
#include "scenario/csv.hpp"

namespace soilbin::cli {
namespace {

using Json = nlohmann::ordered_json;

/// The analytic wheel, as long as somebody waits for what is asked of it.
class WantedModel final : public Model {
 public:
  explicit WantedModel(const StillWanted& wanted) : wanted_(wanted) {}
  std::string name() const override { return model_.name(); }
  TractionResult evaluate(const Scenario& scenario, const OperatingCondition& at) const override {
    constexpr int between_looks = 100;
    if (++asked_ % between_looks == 0) look();
    return model_.evaluate(scenario, at);
  }
  /// Throws where Ctrl-C was pressed, or nobody waits.
  void look() const {
    if (interrupt_asked()) throw Interrupted();
    if (!wanted_()) throw GivenUp();
  }

 private:
  const bekker_wong::BekkerWong model_{{.errors = false, .patch = false}};
  const StillWanted& wanted_;
  mutable int asked_ = 0;
};

/// What a report says beside its figures, for a page: key figures, sentences, and tables as HTML below their headings.
class ToldParts {
 public:
  explicit ToldParts(const compare::Report& report) {
    for (const compare::ReportPart& part : report.parts) {
      if (!part.section.empty()) section_ = part.section;
      if (holds(part.told, compare::Told::on_pages)) std::visit([&](const auto& one) { tell(one); }, part.content);
    }
  }

  void add_to(Json& document) const {
    document["key_figures"] = key_figures_, document["sentences"] = sentences_, document["tables"] = tables_;
  }

 private:
  void tell(const compare::KeyFigures& figures) {
    for (const compare::KeyFigure& one : figures.all)
      key_figures_.push_back({{"value", one.value}, {"meaning", one.meaning}});
  }
  void tell(const compare::Sentences& sentences) {
    for (const compare::BackedSentence& one : sentences.all)
      sentences_.push_back({{"about", one.about}, {"text", one.text}});
  }
  void tell(const compare::Table& table) {
    if (!table.rows.empty())
      tables_.push_back({{"section", section_}, {"html", html_of(table)}, {"legend", table.legend}});
  }
  template <class Drawn>
  void tell(const Drawn&) {}

  std::string section_;
  Json key_figures_ = Json::array(), sentences_ = Json::array(), tables_ = Json::array();
};

/// Where wheels, centre of gravity and hitch are, for a drawing from the side.
Json places_json(const compare::VehicleCase& vehicle) {
  const compare::VehiclePoint &centre = vehicle.centre_of_gravity, &hitch = vehicle.hitch.at;
  return {{"axles", compare::list_of(vehicle.axles,
                                     [](const compare::VehicleAxle& axle) {
                                       return Json{{"name", axle.name},
                                                   {"x", axle.x},
                                                   {"wheels", axle.track ? 2 : 1},
                                                   {"radius", axle.tire.radius},
                                                   {"lug_height", axle.tire.lugs.height},
                                                   {"lug_count", axle.tire.lugs.count.value_or(0)},
                                                   {"driven", axle.driven == YesNo::yes}};
                                     })},
          {"centre_of_gravity", {{"x", centre.x}, {"z", centre.z}}},
          {"hitch", {{"x", hitch.x}, {"z", hitch.z}, {"angle", vehicle.hitch.angle}}},
          {"weight", vehicle.mass * gravity_of(vehicle.soil)}};
}

/// The slope, and what the wheels do in a steady state, for that drawing; without one they carry nothing.
Json state_json(const compare::VehicleAnswers& answers) {
  Json wheels = Json::array();
  for (std::size_t i = 0; i < answers.wheels.size(); ++i) {
    const compare::VehicleWheel& about = answers.wheels[i];
    Json one = {{"name", about.name}, {"axle", about.axle}, {"load", 0.0}, {"slip", nullptr}, {"sinkage", 0.0}};
    if (answers.steady && !answers.steady->wheels[i].lifted) {
      const compare::SteadyWheel& wheel = answers.steady->wheels[i];
      one["load"] = wheel.normal_load, one["slip"] = wheel.result.at.slip, one["sinkage"] = wheel.result.sinkage.value;
    }
    wheels.push_back(std::move(one));
  }
  return {{"goes", answers.steady.has_value()},
          {"slope", answers.question.condition.slope},
          {"pull", answers.steady ? answers.steady->pull : 0.0},
          {"wheels", std::move(wheels)}};
}

/// Effects that some wheel has, the vehicle's and those that its tires declare.
std::vector<EffectChoice> effects_of(const std::vector<compare::VehicleWheel>& wheels) {
  std::vector<EffectChoice> all;
  for (const compare::VehicleWheel& wheel : wheels)
    for (const EffectChoice& effect : wheel.scenario.effects)
      if (std::ranges::find(all, effect.id, &EffectChoice::id) == all.end()) all.push_back(effect);
  return all;
}

/// Pull and sinkages against slip, the present point marked.
compare::Sheet pulls_sheet(const compare::Report& report, const compare::VehicleAnswers& answers) {
  compare::Sheet sheet = report.sheet();
  if (answers.steady)
    sheet.plots.front().series.push_back({.label = "this point",
                                          .x = {100 * answers.steady->slip},
                                          .y = {answers.steady->pull},
                                          .mark = compare::Mark::points,
                                          .color = 1});
  return sheet;
}

/// Adds to a document the question and what a report says of its answer, as all answers have them.
void add_told(Json& document, const compare::Report& report, const AskedVehicle& asked, const compare::Doubts& doubts) {
  compare::add_warnings(document, doubts);
  document["command"] = command_line(asked.words);
  document["in_words"] = report.heading;
  document["title"] = report.title;
  document["no_answer"] = report.no_answer.empty() ? Json() : Json(report.no_answer);
  document["places"] = places_json(asked.question);
  ToldParts(report).add_to(document);
}

Json sheet_json(compare::Sheet sheet, const VehicleSetup& setup) {
  if (setup.force_unit() == "kN") in_kilonewtons(sheet);
  return compare::to_json(sheet);
}

using AnswersOf = compare::VehicleAnswers (*)(const compare::VehicleCase&, const std::vector<compare::VehicleWheel>&,
                                              const Model&);

Reply vehicle_reply(const VehicleSetup& setup, const std::string& query, const StillWanted& wanted,
                    AnswersOf answers_to) {
  const AskedVehicle asked = setup.ask(flags_of(query));
  const compare::VehicleAnswers answers = answers_to(asked.question, asked.wheels, WantedModel(wanted));
  const compare::Doubts doubts = doubts_about(answers, asked.notes);
  const compare::Report report = compare::report_on(answers, not_decided(answers, doubts));
  Json document = answers.in_full ? report.data() : Json::object();
  document["in_full"] = answers.in_full;
  add_told(document, report, asked, doubts);
  document["numbers"] = vehicle_numbers_json(asked.question, setup.force_unit());
  document["effects"] = effect_values_json(effects_of(asked.wheels));
  document["curves"] = sheet_json(pulls_sheet(report, answers), setup);
  document["state"] = state_json(answers);
  return json_reply(document);
}

Reply drive_reply(const VehicleSetup& setup, const std::string& query, const StillWanted& wanted) {
  const AskedVehicle asked = setup.ask(flags_of(query), AskedOf::drive);
  const WantedModel model(wanted);
  const compare::DrivenAnswers answers = compare::driven_answers(asked.question, asked.wheels, model, drive_intervals,
                                                                 [&](double, double) { model.look(); });
  const compare::Report report = compare::report_on(answers);
  Json document = report.data();
  add_told(document, report, asked, doubts_about(answers, asked.notes));
  document["curves"] = answers.record ? sheet_json(report.sheet(), setup) : Json();
  return json_reply(document);
}

Reply file_reply(const VehicleSetup& setup, const std::string& query) {
  return {200, "application/yaml", write_vehicle_case(setup.ask(flags_of(query)).question, setup.place().effects)};
}

Reply pulls_reply(const VehicleSetup& setup, const std::string& query, const StillWanted& wanted) {
  std::vector<Flag> flags = flags_of(query);
  const bool commas = take(flags, "decimal-comma").has_value();
  const AskedVehicle asked = setup.ask(flags);
  const compare::VehicleAnswers answers = compare::answers_of(asked.question, asked.wheels, WantedModel(wanted));
  const std::string csv = compare::report_on(answers).csv();
  return {200, "text/csv; charset=utf-8", commas ? with_decimal_commas(csv) : csv};
}

}  // namespace

Reply reply_to(const VehicleSetup& setup, std::string_view target, const StillWanted& wanted) {
  const Answers answers = {
      {"/",
       [&](const std::string&) {
         return page_reply("Vehicle: " + setup.ask({}).question.name,
                           "The answers of soilbin vehicle: move a number, and everything follows.",
                           {"vehicle.html", {"drawing.js", "vehicle.js", "vehicle_page.js"}});
       }},
      {"/case",
       [&](const std::string&) {
         return Reply{200, "application/json", compare::json_text(setup.document())};
       }},
      {"/vehicle", [&](const std::string& query) { return vehicle_reply(setup, query, wanted, compare::answers_of); }},
      {"/state", [&](const std::string& query) { return vehicle_reply(setup, query, wanted, compare::state_of); }},
      {"/drive", [&](const std::string& query) { return drive_reply(setup, query, wanted); }},
      {"/vehicle.yaml", [&](const std::string& query) { return file_reply(setup, query); }},
      {"/pulls.csv", [&](const std::string& query) { return pulls_reply(setup, query, wanted); }}};
  return answered(answers, target,
                  "there are /, /case, /vehicle?slope=5deg, /state, /drive, /vehicle.yaml and /pulls.csv");
}

}  // namespace soilbin::cli
