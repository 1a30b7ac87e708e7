// The module soilbin._soilbin; the package soilbin sorts its names by floor and adds data frames.
#include <dlfcn.h>

#include "notebooks/bindings/bindings.hpp"

namespace soilbin::python {

void Watch::operator()(double share, std::string_view stage) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point now = Clock::now();
  if (share < 1 && now - looked_ < std::chrono::milliseconds(50)) return;
  looked_ = now;
  const py::gil_scoped_acquire lock;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  if (!progress_.is_none()) progress_(share, py::str(stage.data(), stage.size()));
}

py::array view(const std::vector<double>& numbers, py::handle owner) {
  return column(
      numbers, [](const double& x) -> const double& { return x; }, owner);
}

py::array view(const std::vector<double>& numbers, py::ssize_t columns, py::handle owner) {
  const py::ssize_t rows = columns > 0 ? static_cast<py::ssize_t>(numbers.size()) / columns : 0;
  return view(numbers, owner).attr("reshape")(rows, columns);
}

py::dict dict_of(const Columns& columns) {
  py::dict out;
  for (const auto& [name, values] : columns) out[name] = values;
  return out;
}

std::vector<std::filesystem::path> cases_folders() {
  // .../lib/python3/dist-packages/soilbin/_soilbin.so -> .../share/soilbin/cases
  Dl_info library{};
  std::filesystem::path installed;
  if (dladdr(reinterpret_cast<void*>(&cases_folders), &library) != 0 && library.dli_fname != nullptr)
    installed = std::filesystem::path(library.dli_fname).parent_path() / "../../../../share/soilbin/cases";
  return case_folders(installed.lexically_normal(), SOILBIN_SOURCE_CASES);
}

Library cases_library() { return Library(cases_folders()); }

const bekker_wong::CatalogueVocabulary& effect_vocabulary() {
  static const bekker_wong::CatalogueVocabulary vocabulary;
  return vocabulary;
}

}  // namespace soilbin::python

PYBIND11_MODULE(_soilbin, module) {
  using namespace soilbin::python;
  module.doc() = "soilbin's C++ floors: scenario, bekker_wong, dem, compare. SI and radians throughout.";
  module.attr("__version__") = SOILBIN_VERSION;
  // pybind11 writes signatures as it goes: what is named in one comes first.
  bind_errors(module);
  bind_scenario(module);
  bind_results(module);
  bind_wheel(module);
  bind_drive(module);
  bind_plates(module);
  bind_grains(module);
  bind_run_parts(module);
  bind_measured(module);
  bind_recorded(module);
  bind_soil_bin(module);
  bind_element_tests(module);
  bind_strength_tests(module);
  bind_plate_tests(module);
  bind_loop(module);
  bind_comparison(module);
  bind_calibration(module);
}
