// compare/discrepancy: sides, differences, and what counts of them.
#include "compare/discrepancy/comparison.hpp"

#include "compare/telling/comparison_report.hpp"
#include "notebooks/bindings/scenario.hpp"

namespace soilbin::python {
namespace {

using compare::Campaign;
using compare::Clause;
using compare::Comparison;
using compare::Difference;
using compare::DifferenceFinding;
using compare::RecordedRun;
using compare::Side;
using compare::SideKind;

void bind_sides(py::module_& module) {
  py::enum_<SideKind>(module, "SideKind", "Where a side's numbers come from.")
      .value("analytic", SideKind::analytic)
      .value("grains", SideKind::grains)
      .value("measured", SideKind::measured);
  py::class_<Side>(module, "Side", "A model or the measurement, a point for each condition of a study.")
      .def_readonly("label", &Side::label)
      .def_readonly("kind", &Side::kind)
      .def_property_readonly(
          "results",
          [](const Side& side) {
            std::vector<std::optional<TractionResult>> all;
            for (const compare::SidePoint& point : side.points) all.push_back(point.result);
            return all;
          },
          "a result, or None, for each condition");
}

void bind_differences(py::module_& module) {
  py::enum_<DifferenceFinding>(module, "Finding", "What can be said of a difference (docs/theory/comparing.md).")
      .value("difference", DifferenceFinding::difference)
      .value("within_scatter", DifferenceFinding::within_scatter)
      .value("within_errors", DifferenceFinding::within_errors)
      .value("not_judged", DifferenceFinding::not_judged);
  using D = Difference;
  py::class_<D>(module, "Difference", "One side against another, one channel, one condition [SI].")
      .def_readonly("side", &D::side, "of Comparison.sides")
      .def_readonly("reference", &D::reference, "of Comparison.sides")
      .def_readonly("condition", &D::condition, "of the study")
      .def_property_readonly("channel",
                             [](const D& d) { return std::string(compare::channel_views.at(d.channel).name); })
      .def_readonly("value", &D::value)
      .def_readonly("reference_value", &D::reference_value)
      .def_readonly("scatter", &D::scatter, "of one run of the reference")
      .def_readonly("difference", &D::difference, "value less reference value")
      .def_readonly("std_error", &D::std_error)
      .def_readonly("freedom", &D::freedom, "degrees of freedom behind the standard error; infinite where it is known")
      .def_readonly("share", &D::share, "of the load: forces over W, torque over W r, sinkage over r")
      .def_readonly("finding", &D::finding);
  py::class_<Comparison>(module, "Comparison", "Models and measurements side by side.")
      .def_readonly("case", &Comparison::question)
      .def_readonly("sides", &Comparison::sides, "analytic first, then grains, then measured")
      .def_readonly("differences", &Comparison::differences, "by pair, channel, condition")
      .def_property_readonly(
          "not_compared",
          [](const Comparison& comparison) {
            std::vector<std::string> all;
            for (const compare::NotCompared& gap : comparison.not_compared)
              all.push_back(compare::in_words(comparison, gap));
            return all;
          },
          "pairs and conditions that are left out, and why")
      .def_property_readonly(
          "sentences",
          [](const Comparison& comparison) {
            std::vector<std::string> all;
            for (const Clause& clause : compare::summary(comparison))
              all.push_back((clause.about.empty() ? "" : clause.about + ": ") + clause.text);
            return all;
          },
          "the comparison in plain words");
}

/// The case's own analytic models (the base model where it has none), then grains, then measurements.
Comparison compare_case(const Case& question, const std::vector<EffectName>& effects,
                        const std::vector<RecordedRun>& runs, const Campaign* measured) {
  Case analytic = question;
  std::erase_if(analytic.study.models, [](const ModelChoice& c) { return c.model != ModelKind::bekker_wong; });
  if (analytic.study.models.empty()) analytic.study.models.push_back({ModelKind::bekker_wong, {}, "bekker_wong"});
  for (const EffectChoice& effect : effects_of(effects))
    analytic.study.models.push_back({ModelKind::bekker_wong, {effect}, "bekker_wong + " + effect.id});
  std::vector<Side> sides;
  if (question.scenario.soil.semi_empirical)
    for (const compare::ModelAnswers& answers : compare::run_study(analytic))
      sides.push_back(compare::side_of(answers));
  if (!runs.empty()) sides.push_back(compare::side_of("dem", runs, question.study.conditions));
  if (measured != nullptr) sides.push_back(compare::side_of(*measured, question));
  return compare::compare_sides(question, std::move(sides));
}

}  // namespace

void bind_comparison(py::module_& module) {
  bind_sides(module);
  bind_differences(module);
  module.def(
      "compare_case",
      [](const Case& question, const std::vector<EffectName>& effects, const std::vector<RecordedRun>& runs,
         const Campaign* measured) {
        return unlocked([&] { return compare_case(question, effects, runs, measured); });
      },
      py::arg("case"), py::arg("effects") = std::vector<EffectName>{}, py::arg("runs") = std::vector<RecordedRun>{},
      py::arg("measured") = nullptr, "soilbin.compare.compare_case tells the arguments.");
}

}  // namespace soilbin::python
