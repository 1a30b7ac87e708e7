// Answers and soils as other programs read them: the documents of the command's --json, and its files.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "compare/doubts/doubts.hpp"
#include "compare/experiments/force_table_file.hpp"
#include "compare/export/wheel_fmu.hpp"
#include "compare/export/wheel_slip.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/telling/reports.hpp"
#include "notebooks/bindings/scenario.hpp"
#include "scenario/atomic_file.hpp"
#include "scenario/errors.hpp"

namespace soilbin::python {
namespace {

using compare::Answer;
using compare::Report;
using File = std::optional<std::filesystem::path>;

/// The document of a report about these answers.
Document exported(const Report& report, const Case& question, const std::vector<compare::ModelAnswers>& answers) {
  return {compare::json_text(report.data()), compare::in_words(compare::doubts(question, answers))};
}

Case export_question(const Scenario& scenario, const std::vector<OperatingCondition>& at, ModelKind model) {
  Case question = question_of(scenario);
  question.study.conditions = at;
  if (model != ModelKind::bekker_wong) {
    question.study.models = {{model, {}, ""}};
    label_models(question.study.models);
  }
  return question;
}

std::string case_text(const Case& question) { return write_case(question, effect_vocabulary()); }

/// Writes a file that was named, in a folder that is made where it is missing.
void write_where_named(const File& file, const auto& content) {
  if (file) write_file_atomically(*file, content());
}

Document export_table(const Scenario& scenario, const std::vector<OperatingCondition>& at, ModelKind model,
                      const File& header, const File& csv, const File& hdf5, const py::object& progress) {
  Watch watch(progress);
  return unlocked([&] {
    const compare::ForceTable table = compare::force_table(export_question(scenario, at, model), watch.of_steps());
    write_where_named(header, [&] {
      return compare::c_header_of(table, {.name = compare::c_name_of(header->string()), .version = SOILBIN_VERSION});
    });
    write_where_named(csv, [&] { return compare::csv_of(table); });
    write_where_named(hdf5, [&] {
      return compare::hdf5_of(
          table, {.name = hdf5->string(), .version = SOILBIN_VERSION, .resolved_case = case_text(table.question)});
    });
    return exported(report_on(table), table.question, {table.nodes});
  });
}

Document export_fmi(const Scenario& scenario, const std::vector<OperatingCondition>& at, ModelKind model,
                    const std::filesystem::path& output, const py::object& progress) {
  Watch watch(progress);
  return unlocked([&] {
    const std::string name = compare::c_name_of(output.string());
    const compare::WheelFmu fmu =
        compare::wheel_fmu(compare::force_table(export_question(scenario, at, model), watch.of_steps()),
                           {.name = name, .version = SOILBIN_VERSION});
    const compare::CompiledC compiled = compiled_by_cc(files_in_c(fmu), name + ".c");
    watch(1);  // Ctrl-C ends the compiler, too
    write_file_atomically(output, packed_fmu(fmu, compiled.library, case_text(fmu.table.question)));
    return exported(report_on(fmu, compiled), fmu.table.question, {fmu.table.nodes});
  });
}

Document export_gazebo(const Scenario& scenario, const OperatingCondition& at, const File& map,
                       const std::vector<Soil>& soils, double size) {
  return unlocked([&] {
    const compare::WheelSlipFit fit = compare::wheel_slip_of(export_question(scenario, {at}, ModelKind::bekker_wong));
    if (!map && soils.empty()) return exported(report_on(fit), fit.question, fit.answers);
    const compare::SlipMap made = slip_map(fit, soils, {.size = size});
    write_where_named(map, [&] { return compare::rgb_png(compare::picture_of(made)); });
    return exported(report_on(fit, made, map.value_or("slip_map.png").string()), fit.question, fit.answers);
  });
}

Document export_scm(const Soil& soil, const File& output) {
  if (!soil.semi_empirical)
    throw InputError("soil '" + soil.name + "' has no semi_empirical values, which SCM is made of");
  const std::string text = compare::json_text(compare::report_on_scm(soil, SOILBIN_VERSION).data());
  write_where_named(output, [&] { return text; });
  return {text, compare::in_words(compare::doubts(soil))};
}

}  // namespace

void bind_exports(py::module_& module) {
  module.def("export_table", &export_table, py::arg("scenario"), py::arg("at"), py::arg("model"), py::arg("header"),
             py::arg("csv"), py::arg("hdf5"), py::arg("progress") = py::none(),
             "soilbin-force-table/1 as JSON, and what the command would warn of; soilbin.export_table tells more.");
  module.def("export_fmi", &export_fmi, py::arg("scenario"), py::arg("at"), py::arg("model"), py::arg("output"),
             py::arg("progress") = py::none(),
             "soilbin-fmu/1 as JSON, and what the command would warn of; soilbin.export_fmi tells more.");
  module.def("export_gazebo", &export_gazebo, py::arg("scenario"), py::arg("at"), py::arg("map"), py::arg("soils"),
             py::arg("size"),
             "soilbin-wheel-slip/1 as JSON, and what the command would warn of; soilbin.export_gazebo tells more.");
  module.def("export_scm", &export_scm, py::arg("soil"), py::arg("output"),
             "The file for Chrono as JSON, and what the command would warn of; soilbin.export_scm tells more.");
}

}  // namespace soilbin::python
