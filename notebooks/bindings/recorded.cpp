// compare/recorded: runs of the soil bin kept in a file.
#include <fmt/core.h>

#include "compare/recorded/campaign_of_records.hpp"
#include "compare/recorded/recorded_model.hpp"
#include "notebooks/bindings/bindings.hpp"
#include "notebooks/bindings/scenario.hpp"
#include "scenario/case.hpp"
#include "scenario/errors.hpp"

namespace soilbin::python {

using compare::Record;
using compare::RecordedModel;
using compare::RecordedRun;

namespace {

Case case_of(const Record& record) {
  return parse_case(make_source_text(record.question, "case of the record"), cases_library(), effect_vocabulary());
}

}  // namespace

void bind_recorded(py::module_& module) {
  py::class_<RecordedRun>(module, "RecordedRun", "A run of the soil bin: a condition on one packing.")
      .def_readonly("answer", &RecordedRun::answer)
      .def_readonly("packing", &RecordedRun::packing, "seed of the bed")
      .def_readonly("source", &RecordedRun::source, "state of the sources of the program that ran it")
      .def_readonly("seconds", &RecordedRun::seconds, "that it took on the clock on the wall")
      .def_readonly("steady", &RecordedRun::steady)
      .def_readonly("drift", &RecordedRun::drift)
      .def_readonly("power", &RecordedRun::power)
      .def_readonly("rut", &RecordedRun::rut)
      .def_readonly("flow", &RecordedRun::flow);
  py::class_<Record>(module, "Record", "What a soilbin-recorded/1 file holds (docs/guide/recorded.md).")
      .def_readonly("soilbin", &Record::soilbin, "version that began it")
      .def_readonly("model", &Record::model)
      .def_readonly("inputs", &Record::inputs, "names and values that an answer follows from")
      .def_readonly("runs", &Record::runs)
      .def("case", &case_of, "The resolved question; of its conditions some may not have been run.")
      .def("__repr__", [](const Record& r) { return fmt::format("Record({} runs of {})", r.runs.size(), r.model); });
  py::class_<RecordedModel, Model>(module, "RecordedModel",
                                   "Answers from a record alone: means over packings. The scenario isn't looked at.")
      .def(py::init<Record>(), py::arg("record"))
      .def_property_readonly("record", &RecordedModel::record);
  // Seven parameters, since each is a keyword of Python's tell_campaign(...).
  module.def(
      "tell_campaign",
      [](const std::vector<Record>& records, const std::vector<std::string>& hide,
         const std::vector<EffectName>& effects, const std::optional<Soil>& soil, const std::string& name,
         bool only_steady, std::uint64_t seed) {
        if (records.empty()) throw InputError("records: at least one");
        std::vector<compare::NamedRecord> named;
        for (const Record& record : records) named.push_back({fmt::format("record {}", named.size() + 1), record});
        Scenario scenario = case_of(records.front()).scenario;
        if (soil) scenario.soil = *soil;
        const compare::CampaignOptions told{name, {hide.begin(), hide.end()}, effects_of(effects), only_steady, seed};
        return compare::campaign_from_runs(scenario, compare::joined_runs(named), told).campaign;
      },
      py::arg("records"), py::arg("hide") = std::vector<std::string>{}, py::arg("effects") = std::vector<EffectName>{},
      py::arg("soil") = py::none(), py::arg("name") = "told", py::arg("only_steady") = false, py::arg("seed") = 1,
      "Runs as a measured campaign: soilbin.compare.tell_campaign tells the arguments.");
  module.def(
      "write_campaign",
      [](const compare::Campaign& campaign, const std::filesystem::path& folder) {
        compare::write_campaign(folder, campaign, effect_vocabulary());
      },
      py::arg("campaign"), py::arg("folder"),
      "Writes campaign.yaml and its data into a folder, made where it is missing; find_campaign reads it back.");
  module.def("read_record", &compare::read_record, py::arg("path"),
             "Reads a record. Raises InputError with file and place for everything that is none.");
}

}  // namespace soilbin::python
