// compare/recorded: runs of the soil bin kept in a file.
#include <fmt/core.h>

#include "compare/recorded/recorded_model.hpp"
#include "notebooks/bindings/bindings.hpp"
#include "scenario/case.hpp"

namespace soilbin::python {

using compare::Record;
using compare::RecordedModel;
using compare::RecordedRun;

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
  py::class_<Record>(module, "Record", "What a soilbin-recorded/1 file holds (docs/recorded.md).")
      .def_readonly("soilbin", &Record::soilbin, "version that began it")
      .def_readonly("model", &Record::model)
      .def_readonly("inputs", &Record::inputs, "names and values that an answer follows from")
      .def_readonly("runs", &Record::runs)
      .def(
          "case",
          [](const Record& r) {
            return parse_case(make_source_text(r.question, "case of the record"), cases_library(), effect_vocabulary());
          },
          "The resolved question; of its conditions some may not have been run.")
      .def("__repr__", [](const Record& r) { return fmt::format("Record({} runs of {})", r.runs.size(), r.model); });
  py::class_<RecordedModel, Model>(module, "RecordedModel",
                                   "Answers from a record alone: means over packings. The scenario isn't looked at.")
      .def(py::init<Record>(), py::arg("record"))
      .def_property_readonly("record", &RecordedModel::record);
  module.def("read_record", &compare::read_record, py::arg("path"),
             "Reads a record. Raises InputError with file and place for everything that is none.");
}

}  // namespace soilbin::python
