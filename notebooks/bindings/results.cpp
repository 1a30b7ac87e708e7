// Results and the models that give them.
#include <fmt/core.h>

#include "bekker_wong/model.hpp"
#include "compare/doubts/declared_tire.hpp"
#include "compare/doubts/doubts.hpp"
#include "compare/report/number_text.hpp"
#include "compare/sweep/answers.hpp"
#include "compare/sweep/varying.hpp"
#include "compare/telling/answer_report.hpp"
#include "cone_index/model.hpp"
#include "notebooks/bindings/scenario.hpp"
#include "resistive_force/model.hpp"
#include "scenario/case.hpp"
#include "scenario/nearest_word.hpp"
#include "scenario/traction_channels.hpp"

namespace soilbin::python {
namespace {

using compare::Answer;

py::dict budget_of(const TractionResult& result) {
  py::dict out;
  for (const Contribution& part : result.budget) out[py::str(part.name)] = part.force;
  return out;
}

void bind_result(py::module_& module) {
  using R = TractionResult;
  py::class_<R> result(module, "TractionResult",
                       "The answer of a model or of a measurement at one condition; the four channels are Estimates, "
                       "value and std_error.");
  result.def_readonly("at", &R::at);
  for (const TractionChannel& channel : traction_channels)
    result.def_readonly(channel.name.data(), channel.predicted, channel.meaning);
  result
      .def_property_readonly(
          "tractive_efficiency", &reported_efficiency,
          "power at the drawbar over power put in [-]; NaN unless the wheel is driven and pulls along its travel")
      .def_readonly("entry_angle", &R::entry_angle, "theta_1 [rad]")
      .def_readonly("max_stress_angle", &R::max_stress_angle, "theta_m [rad]")
      .def_readonly("exit_angle", &R::exit_angle, "theta_2 [rad]; negative behind the axle")
      .def_property_readonly("budget", &budget_of,
                             "named parts [N] that add up to the drawbar pull, but for budget_rest")
      .def_property_readonly(
          "budget_rest",
          [](const R& r) {
            return py::dict(py::arg("force") = r.budget_rest.force, py::arg("bound") = r.budget_rest.bound);
          },
          "force [N]: the drawbar pull less the sum of its parts; bound [N]: the largest that is no sign of a fault, "
          "NaN where it isn't known")
      .def_property_readonly("patch",
                             columns_of(&R::patch, {{"theta", &StressSample::theta},
                                                    {"normal", &StressSample::normal},
                                                    {"shear", &StressSample::shear},
                                                    {"lateral_shear", &StressSample::lateral_shear}}),
                             "stresses under the wheel, from exit to entry: arrays of one shape (nodes,): theta [rad], "
                             "normal, shear, lateral_shear [Pa]; views of the result, not copies")
      .def_readonly("without_error_of", &R::without_error_of,
                    "parameters of the soil that the standard errors leave out: the results have no derivative by them")
      .def("__repr__", [](const R& r) {
        return "TractionResult(drawbar_pull=" + compare::number(r.drawbar_pull) +
               " N, torque=" + compare::number(r.torque) + " N m, sinkage=" + compare::number(r.sinkage) +
               " m, lateral_force=" + compare::number(r.lateral_force) + " N)";
      });
  module.def(
      "channels",
      [] {
        std::vector<std::string> names;
        for (const TractionChannel& channel : traction_channels) names.emplace_back(channel.name);
        return names;
      },
      "Names of the four channels, in the order of every table.");
  py::class_<Answer>(module, "Answer", "What a model says at one condition: a result, or why there is none.")
      .def_readonly("at", &Answer::at)
      .def_readonly("result", &Answer::result, "None where there is none")
      .def_readonly("error", &Answer::error, "'' where there is a result");
  module.def(
      "answer_of",
      [](const TractionResult& told) {
        return Answer{told.at, told, ""};
      },
      py::arg("result"), "The result as an Answer.");
}

void bind_models(py::module_& module) {
  py::class_<Model>(module, "Model", "One way of answering.")
      .def_property_readonly("name", &Model::name)
      .def(
          "evaluate",
          [](const Model& model, const Scenario& scenario, const OperatingCondition& at) {
            return unlocked([&] { return model.evaluate(scenario, at); });
          },
          py::arg("scenario"), py::arg("at"),
          "The answer at one condition, a TractionResult [SI]. Raises InputError where the scenario lacks what the "
          "model needs, NoSolution where it has no answer.");
  using bekker_wong::BekkerWong;
  py::class_<BekkerWong, Model>(module, "BekkerWong", "The Bekker / Wong-Reece model (docs/reference/conventions.md).")
      .def(py::init([](bool errors, bool patch) { return BekkerWong({.errors = errors, .patch = patch}); }),
           py::arg("errors") = true, py::arg("patch") = true,
           "errors: standard errors from the soil's standard deviations, to first order. patch: stresses under the "
           "wheel. Without them it is several times as fast.");
  using resistive_force::ResistiveForce;
  py::class_<ResistiveForce, Model>(
      module, "ResistiveForce",
      "Three-dimensional granular resistive force theory (docs/theory/resistive-force.md): "
      "the tread as drawn, in milliseconds. Without a Soil.resistive_force it takes the "
      "soil's density and friction angle. It knows no effects.")
      .def(py::init<>());
  py::class_<cone_index::ConeIndex, Model>(
      module, "ConeIndex",
      "Pull and torque of a driven pneumatic tire by its soil's cone index (docs/theory/cone-index.md): Brixius's "
      "relation where Soil.cone_index is declared, Turnage's where Soil.cone_index_gradient is. Sinkage, stresses and "
      "angles are NaN. It knows no effects.")
      .def(py::init<>());
  module.def(
      "answers",
      [](const Model& model, const Scenario& scenario, const std::vector<OperatingCondition>& conditions,
         const py::object& progress) {
        Watch watch(progress);
        return unlocked([&] { return compare::sweep(model, scenario, conditions, watch.of_steps()); });
      },
      py::arg("model"), py::arg("scenario"), py::arg("conditions"), py::arg("progress") = py::none(),
      "A list of Answers, one for each condition, in their order; one without solution carries its error. progress: "
      "called with (share done 0 .. 1, stage).");
}

void bind_as_asked(py::module_& module) {
  module.def(
      "as_asked",
      [](const Scenario& scenario, const std::vector<OperatingCondition>& at, bool rigid, bool no_lugs) {
        Case question = question_of(scenario);
        question.study.conditions = at;
        std::vector<std::string> notes =
            compare::in_words(compare::as_declared(question, {.pressure = rigid, .lugs = no_lugs}));
        Scenario asked = scenario;
        asked.tire = question.scenario.tire;
        asked.effects = question.study.models.front().effects;
        return std::pair(asked, notes);
      },
      py::arg("scenario"), py::arg("at"), py::arg("rigid") = false, py::arg("no_lugs") = false,
      "The scenario as the commands ask it at these conditions, and what they say of that: with the effects of what "
      "the tire declares, its inflation pressure (not where `rigid`) and its lugs (not where `no_lugs`).");
  module.def(
      "study_as_asked",
      [](const Case& given, bool rigid, bool no_lugs) {
        Case question = given;
        std::vector<std::string> notes =
            compare::in_words(compare::as_declared(question, {.pressure = rigid, .lugs = no_lugs}));
        return std::pair(question, notes);
      },
      py::arg("case"), py::arg("rigid") = false, py::arg("no_lugs") = false,
      "A case as the commands ask its study: as_asked of all its conditions.");
}

void bind_explanation(py::module_& module) {
  using compare::Explanation;
  using compare::Step;
  py::class_<Step>(module, "Step", "One equation, in symbols and in numbers.")
      .def_readonly("name", &Step::name)
      .def_readonly("equation", &Step::equation)
      .def_readonly("numbers", &Step::numbers)
      .def_readonly("value", &Step::value, "in `unit`")
      .def_readonly("unit", &Step::unit)
      .def_readonly("remark", &Step::remark)
      .def("__repr__", [](const Step& s) {
        return fmt::format("{}: {} = {} = {:.4g} {}", s.name, s.equation, s.numbers, s.value, s.unit);
      });
  py::class_<Explanation>(module, "Explanation", "Why the semi-empirical answer is what it is.")
      .def_readonly("result", &Explanation::result)
      .def_readonly("steps", &Explanation::steps, "of the model, in the order in which it takes them")
      .def_readonly("effects", &Explanation::effects)
      .def_readonly("cross_checks", &Explanation::cross_checks, "closed forms that need no balance")
      .def(
          "__str__", [](const Explanation& e) { return compare::equations_text(e); },
          "The equations with their values, as the command explain prints them.")
      .def("__repr__", [](const Explanation& e) {
        std::vector<std::string> names;
        for (const std::vector<Step>& steps : {e.steps, e.effects, e.cross_checks})
          for (const Step& step : steps) names.push_back(step.name);
        return fmt::format("Explanation of a drawbar pull of {} N; print() shows its steps: {}",
                           compare::number(e.result.drawbar_pull), listed(names));
      });
  module.def("explain", py::overload_cast<const Scenario&, const OperatingCondition&>(&compare::explain),
             py::arg("scenario"), py::arg("at"),
             "The model's equations with their values. Raises InputError and NoSolution as the model does.");
  module.def(
      "doubts", [](const Case& question) { return compare::in_words(compare::doubts(question)); }, py::arg("case"),
      "What is possible in a case, but hardly meant: sentences.");
  module.def(
      "doubts_of",
      [](const Scenario& scenario, const std::vector<Answer>& answers) {
        Case question = question_of(scenario);
        for (const Answer& answer : answers) question.study.conditions.push_back(answer.at);
        return compare::in_words(compare::doubts(question, {{question.study.models.front(), answers}}));
      },
      py::arg("scenario"), py::arg("answers"),
      "What the command would warn of beside these answers of the analytic model: sentences.");
  module.def("in_words", py::overload_cast<const OperatingCondition&>(&compare::in_words), py::arg("at"),
             "A condition in words, without what is at its default.");
}

}  // namespace

void bind_results(py::module_& module) {
  bind_result(module);
  bind_models(module);
  bind_as_asked(module);
  bind_explanation(module);
}

}  // namespace soilbin::python
