// The module soilbin._soilbin; the package soilbin sorts its names by floor and adds data frames.
#include <dlfcn.h>
#include <unistd.h>

#include <atomic>
#include <map>
#include <stdexcept>
#include <thread>

#include "notebooks/bindings/bindings.hpp"

namespace soilbin::python {
namespace {

std::atomic<bool> interpreter_ends = false;
std::atomic<int> at_work_unlocked = 0;

/// Guarded by the interpreter's lock.
std::map<const void*, std::thread::id>& objects_at_work() {
  static std::map<const void*, std::thread::id> all;
  return all;
}

void* refuse_without_value(std::size_t) {
  throw py::type_error(
      "this object has no value: __new__ alone made it; call its class, such as Tire(radius=0.1, width=0.1)");
}

}  // namespace

UnlockedWork::UnlockedWork() { ++at_work_unlocked; }

UnlockedWork::~UnlockedWork() {
  --at_work_unlocked;
  while (interpreter_ends) ::pause();  // until the process is gone
}

void end_unlocked_work() {
  interpreter_ends = true;
  const py::gil_scoped_release lock;
  constexpr std::chrono::milliseconds pause{5};
  for (int waited = 0; at_work_unlocked > 0 && waited < 2000; ++waited) std::this_thread::sleep_for(pause);
}

AtWork::AtWork(const void* object) : object_(object) {
  refuse_at_work(object, true);
  objects_at_work().emplace(object, std::this_thread::get_id());
}

AtWork::~AtWork() { objects_at_work().erase(object_); }

void refuse_at_work(const void* object, bool even_here) {
  const auto found = objects_at_work().find(object);
  if (found == objects_at_work().end() || (found->second == std::this_thread::get_id() && !even_here)) return;
  throw std::runtime_error(
      "this object is at work already, in another thread or in the call that told this progress; wait until it has "
      "finished, or give each thread an object of its own");
}

void refuse_objects_without_value(const py::module_& module) {
  for (const auto& [name, value] : module.attr("__dict__").cast<py::dict>())
    if (PyType_Check(value.ptr()) != 0)
      if (auto* info = py::detail::get_type_info(reinterpret_cast<PyTypeObject*>(value.ptr())))
        info->operator_new = refuse_without_value;
}

void Watch::operator()(double share, std::string_view stage) {
  if (interpreter_ends) throw InterpreterEnds();
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
  bind_loop(module);
  bind_comparison(module);
  bind_calibration(module);
  bind_exports(module);
  bind_vehicle(module);
  refuse_objects_without_value(module);
  py::module_::import("atexit").attr("register")(py::cpp_function(&end_unlocked_work));
}
