// compare/loop: what does the model lack?
#include <fmt/core.h>

#include "bekker_wong/effect.hpp"
#include "compare/sweep/result_json.hpp"
#include "compare/telling/loop_report.hpp"
#include "notebooks/bindings/bindings.hpp"
#include "scenario/errors.hpp"

namespace soilbin::python {
namespace {

using compare::AcceptedEffect;
using compare::Campaign;
using compare::LackOfFit;
using compare::LoopAnswer;
using compare::NextRun;
using compare::Verdict;
using compare::WeightedSet;

void bind_loop_parts(py::module_& module) {
  py::enum_<Verdict>(module, "Verdict", "What the loop says.")
      .value("effect_found", Verdict::effect_found)
      .value("nothing_missing", Verdict::nothing_missing)
      .value("unknown_effect", Verdict::unknown_effect)
      .value("not_enough_data", Verdict::not_enough_data);
  py::class_<AcceptedEffect>(module, "AcceptedEffect", "An effect that the loop accepts, in the form that fits best.")
      .def_readonly("choice", &AcceptedEffect::choice, "with fitted parameters [SI]")
      .def_readonly("fitted", &AcceptedEffect::fitted, "names of the parameters that were fitted")
      .def_readonly("ci95", &AcceptedEffect::ci95, "of each fitted parameter, cut off at its bounds")
      .def_readonly("at_bound", &AcceptedEffect::at_bound, "of each: the fit ended at a bound")
      .def_readonly("p_value", &AcceptedEffect::p_value, "family-wise, beside the other accepted effects")
      .def_readonly("cosines", &AcceptedEffect::cosines, "of its trace with each other effect's")
      .def("__repr__", [](const AcceptedEffect& e) {
        std::string fitted;
        for (const std::string& name : e.fitted)
          fitted += fmt::format(", {}={:.4g}", name, e.choice.parameters.at(name));
        return fmt::format("AcceptedEffect({}, form={}{}, p_value={:.2g})", e.choice.id, e.choice.form, fitted,
                           e.p_value);
      });
  py::class_<WeightedSet>(module, "Weighted", "A set of effects with its share of the evidence.")
      .def_readonly("ids", &WeightedSet::ids)
      .def_readonly("weight", &WeightedSet::weight);
  py::class_<LackOfFit>(module, "LackOfFit", "Residual mean square over the noise's, as an F test.")
      .def_readonly("f", &LackOfFit::f)
      .def_readonly("freedom", &LackOfFit::freedom)
      .def_readonly("noise_freedom", &LackOfFit::noise_freedom)
      .def_readonly("p_value", &LackOfFit::p_value);
  py::class_<NextRun>(module, "NextTest", "The run to make next.")
      .def_readonly("at", &NextRun::at)
      .def_readonly("quantities", &NextRun::quantities)
      .def_readonly("separates", &NextRun::separates)
      .def_readonly("runs", &NextRun::runs);
}

/// Names of the channels that are predicted worse with the effects of the model than without.
std::vector<std::string> worse(const LoopAnswer& answer) {
  std::vector<std::string> names;
  for (const int channel : compare::worse_channels(answer))
    names.emplace_back(compare::channel_views[static_cast<std::size_t>(channel)].name);
  return names;
}

/// What each effect of the answer's model takes for values that its wheel does not declare, by the effect's id.
std::map<std::string, std::vector<bekker_wong::Presumed>> presumes(const LoopAnswer& answer) {
  std::map<std::string, std::vector<bekker_wong::Presumed>> all;
  for (const AcceptedEffect& effect : answer.effects_in_model())
    all[effect.choice.id] = bekker_wong::presumed(bekker_wong::find_form(effect.choice), answer.wheel);
  return all;
}

py::dict held_out(const LoopAnswer& answer) {
  py::dict out;
  const auto row = [](const compare::HeldOutErrors& pair) {
    py::dict one;
    one["cells"] = pair.cells, one["before"] = pair.before, one["after"] = pair.after;
    one["noise_floor"] = pair.noise_floor;
    return one;
  };
  for (std::size_t i = 0; i < compare::channel_count; ++i)
    if (answer.validation.channels[i].cells > 0)
      out[py::str(std::string(compare::channel_views[i].name))] = row(answer.validation.channels[i]);
  if (answer.validation.overall.cells > 0) out["all"] = row(answer.validation.overall);
  return out;
}

void bind_answer(py::module_& module) {
  py::class_<LoopAnswer>(module, "LoopAnswer", "The loop's answer (docs/guide/loop.md).")
      .def_readonly("campaign", &LoopAnswer::campaign)
      .def_property_readonly("verdict", &LoopAnswer::verdict)
      .def_property_readonly("reason", py::overload_cast<const LoopAnswer&>(&compare::reason_words),
                             "one plain sentence")
      .def_property_readonly("effects", &LoopAnswer::effects)
      .def_property_readonly("stand_in", &LoopAnswer::proxy_effects,
                             "of an unknown effect: the best named ones, where they predict held-out conditions "
                             "better; they explain nothing")
      .def_property_readonly("ambiguity_set", &LoopAnswer::ambiguity_set, "best first; empty unless effects compete")
      .def_readonly("not_testable", &LoopAnswer::not_testable)
      .def_property_readonly("next", &LoopAnswer::next)
      .def_property_readonly(
          "before", [](const LoopAnswer& a) { return a.judgement() ? a.judgement()->before.lack_of_fit : LackOfFit(); })
      .def_property_readonly("after", [](const LoopAnswer& a) { return a.choice().after.lack_of_fit; })
      .def_readonly("soil", &LoopAnswer::soil, "refitted with the accepted effects, with standard errors")
      .def_property_readonly("outliers", &LoopAnswer::outliers, "number of values set aside")
      .def_property_readonly(
          "weights",
          [](const LoopAnswer& a) { return a.judgement() ? a.found().candidates.sets : std::vector<WeightedSet>(); },
          "over sets of effects, best first")
      .def_property_readonly("held_out", &held_out,
                             "root mean square errors on conditions that neither choice nor fit has seen, by channel "
                             "[SI] and 'all' [sigma]: cells, before, after, noise_floor; empty without validation")
      .def_property_readonly("worse", &worse,
                             "channels whose held-out error is larger with the effects of the model than without; "
                             "empty for a model without effects and without validation")
      .def_property_readonly("presumes", &presumes,
                             "of each effect of the model, by id: what it takes for values that the campaign's wheel "
                             "does not declare (lugs, inflation pressure); an empty list where it presumes nothing")
      .def_property_readonly("sentences", &compare::in_sentences,
                             "the verdict and what stands behind it, in plain words")
      .def(
          "json", [](const LoopAnswer& a) { return compare::json_text(compare::to_json(a)); }, "soilbin-loop/1")
      .def(
          "resolved_model", [](const LoopAnswer& a, const Campaign& c) { return compare::resolved_model(c, a); },
          py::arg("campaign"), "The campaign's wheel on the refitted soil with the accepted effects, as a Case.")
      .def("__repr__", [](const LoopAnswer& a) { return "LoopAnswer(" + compare::verdict_sentence(a) + ")"; });
}

}  // namespace

void bind_loop(py::module_& module) {
  bind_loop_parts(module);
  bind_answer(module);
  module.def(
      "run_loop",
      [](const Campaign& campaign, int folds, std::uint64_t seed, bool validate, int threads,
         const py::object& progress) {
        if (folds < 2 || folds > 50) throw InputError("folds: 2 .. 50");
        if (threads < 1) throw InputError("threads: 1 or more");
        compare::LoopOptions options;
        options.folds = folds, options.attribution.seed = seed, options.validate = validate, options.threads = threads;
        Watch watch(progress);
        options.progress = [&watch](std::size_t done, std::size_t total) {
          watch(static_cast<double>(done) / static_cast<double>(total));
        };
        return unlocked([&] { return compare::run_loop(campaign, options); });
      },
      py::arg("campaign"), py::arg("folds") = 5, py::arg("seed") = 1, py::arg("validate") = true,
      py::arg("threads") = 1, py::arg("progress") = py::none(), "soilbin.compare.run_loop tells the arguments.");
}

}  // namespace soilbin::python
