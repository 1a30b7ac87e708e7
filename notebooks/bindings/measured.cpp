// compare/measured and predictions beside measurements.
#include <fmt/core.h>

#include "compare/doubts/doubts.hpp"
#include "compare/measured/campaign.hpp"
#include "compare/sweep/prediction.hpp"
#include "notebooks/bindings/bindings.hpp"

namespace soilbin::python {
namespace {

using compare::Campaign;
using compare::ChannelError;
using compare::PredictedRun;
using compare::Prediction;
using compare::Run;

void bind_campaign(py::module_& module) {
  py::class_<Run> run(module, "Run",
                      "The steady-state mean of one independent run; None where a channel wasn't measured.");
  run.def_readonly("at", &Run::at);
  run.def_readonly("setpoint", &Run::setpoint, "runs with the same label are re-runs of one setpoint");
  for (const compare::ChannelView& channel : compare::channel_views)
    run.def_readonly(channel.name.data(), channel.measured, fmt::format("[{}]", channel.si_unit).c_str());
  run.def_readonly("csv_line", &Run::csv_line);
  py::class_<Campaign>(module, "Campaign",
                       "What was measured, and what is known beforehand (docs/reference/campaigns.md).")
      .def_readonly("name", &Campaign::name)
      .def_readonly("wheel", &Campaign::wheel)
      .def_readonly("soil", &Campaign::soil, "declared, with what plate and shear tests leave open")
      .def_readonly("bin", &Campaign::bin)
      .def_readonly("effects", &Campaign::effects, "declared")
      .def_readonly("runs", &Campaign::runs)
      .def(
          "scenario", [](const Campaign& c) { return compare::scenario_of(c); },
          "Wheel, declared soil and effects, for a model.")
      .def(
          "doubts", [](const Campaign& c) { return compare::in_words(compare::doubts(c)); },
          "What is possible, but hardly meant: sentences. No verdict of run_loop holds beside a column that looks "
          "mistaken.")
      .def("__repr__", [](const Campaign& c) { return fmt::format("Campaign('{}', {} runs)", c.name, c.runs.size()); });
  module.def(
      "find_campaign",
      [](const std::string& name) {
        return compare::read_campaign(find_file(cases_library(), Shelf::measured, name), cases_library(),
                                      effect_vocabulary());
      },
      py::arg("name"),
      "A campaign of the library, its folder, or its campaign.yaml. Raises InputError with file, line "
      "and the nearest right word.");
}

void bind_prediction(py::module_& module) {
  py::class_<PredictedRun>(module, "PredictedRun", "What was measured, and what the model says there.")
      .def_readonly("run", &PredictedRun::run)
      .def_readonly("measured", &PredictedRun::measured)
      .def_readonly("predicted", &PredictedRun::predicted);
  py::class_<ChannelError>(module, "ChannelError", "How far a channel's predictions lie from the measurements [SI].")
      .def_property_readonly(
          "channel", [](const ChannelError& e) { return std::string(compare::channel_views.at(e.channel).name); })
      .def_readonly("runs", &ChannelError::runs)
      .def_readonly("rmse", &ChannelError::rmse)
      .def_readonly("bias", &ChannelError::bias, "mean of predicted - measured")
      .def_readonly("range", &ChannelError::range, "of the measured values")
      .def_readonly("share_of_range", &ChannelError::share_of_range, "rmse/range; NaN where the range is 0");
  py::class_<Prediction>(module, "Prediction", "A campaign as a model predicts it, row by row, nothing fitted.")
      .def_readonly("runs", &Prediction::runs)
      .def_readonly("errors", &Prediction::errors, "a channel that was measured each")
      .def_readonly("unsolved", &Prediction::unsolved, "runs to which the model has no solution");
  module.def(
      "predictions",
      [](const Model& model, const Scenario& scenario, const Campaign& campaign, const py::object& progress) {
        Watch watch(progress);
        return unlocked([&] { return compare::predict(model, scenario, campaign, watch.of_steps()); });
      },
      py::arg("model"), py::arg("scenario"), py::arg("campaign"), py::arg("progress") = py::none(),
      "Predicts every run at its own load, slip, angles, ... with the scenario's soil and effects.");
}

}  // namespace

void bind_measured(py::module_& module) {
  bind_campaign(module);
  bind_prediction(module);
}

}  // namespace soilbin::python
