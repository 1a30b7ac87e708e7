// What the C++ files of the Python package share. Each file binds one topic: its classes and functions are added to the
// module by the functions below, which module.cpp calls.
#pragma once

#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <chrono>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bekker_wong/effect_vocabulary.hpp"
#include "scenario/library.hpp"

namespace soilbin::python {

namespace py = pybind11;

void bind_errors(py::module_& module);
void bind_scenario(py::module_& module);
void bind_results(py::module_& module);
void bind_wheel(py::module_& module);
void bind_drive(py::module_& module);
void bind_plates(py::module_& module);
void bind_grains(py::module_& module);
void bind_run_parts(py::module_& module);
void bind_soil_bin(py::module_& module);
void bind_element_tests(py::module_& module);
void bind_measured(py::module_& module);
void bind_loop(py::module_& module);
void bind_comparison(py::module_& module);
void bind_recorded(py::module_& module);
void bind_calibration(py::module_& module);
void bind_exports(py::module_& module);
void bind_vehicle(py::module_& module);

/// A document as JSON, and what the command would warn of.
using Document = std::pair<std::string, std::vector<std::string>>;

/// Where cases lie: $SOILBIN_CASES, the installation's, the source tree's.
std::vector<std::filesystem::path> cases_folders();
Library cases_library();
const bekker_wong::CatalogueVocabulary& effect_vocabulary();

/// State of the sources that the extension was built from, as the command tells it.
std::string source_state();

/// Long work, watched from Python. Called from the thread that gave up the interpreter's lock; a few times a second it
/// takes the lock back, lets Python see to signals, and calls `progress`, a callable of (share done, stage) or None.
/// What Python raises (KeyboardInterrupt) goes through the library as an exception and stops the work.
class Watch {
 public:
  explicit Watch(py::object progress) : progress_(std::move(progress)) {}
  void operator()(double share, std::string_view stage = "");
  /// Progress of work that counts its steps; refers to this.
  auto of_steps() {
    return [this](std::size_t done, std::size_t total) {
      (*this)(static_cast<double>(done) / static_cast<double>(total));
    };
  }

 private:
  py::object progress_;
  std::chrono::steady_clock::time_point looked_ = std::chrono::steady_clock::now();
};

/// Thrown through work that a thread does while the interpreter ends: nobody is left to whom it could answer.
struct InterpreterEnds {};

/// Work that is done without the interpreter's lock: counted, so that an interpreter that ends can stop it and wait. A
/// thread whose work ends then never comes back: to take the lock would end the process.
class UnlockedWork {
 public:
  UnlockedWork();
  ~UnlockedWork();
  UnlockedWork(const UnlockedWork&) = delete;
  UnlockedWork& operator=(const UnlockedWork&) = delete;
};

/// Stops what works without the lock and waits for it, ten seconds at most; called before the interpreter ends.
void end_unlocked_work();

/// Does work without the interpreter's lock.
auto unlocked(const auto& work) {
  const py::gil_scoped_release lock;
  const UnlockedWork counted;
  return work();
}

/// An object at work without the interpreter's lock, for as long as this lives, which is made and ended with the lock.
/// Throws std::runtime_error where another thread, or this one further out, has it at work already.
class AtWork {
 public:
  explicit AtWork(const void* object);
  ~AtWork();
  AtWork(const AtWork&) = delete;
  AtWork& operator=(const AtWork&) = delete;

 private:
  const void* object_;
};
/// Throws std::runtime_error where another thread has the object at work; `even_here`: where this one has, too.
void refuse_at_work(const void* object, bool even_here);

/// Makes an object that __new__ alone made, which has no value, an error of type TypeError in place of raw memory.
void refuse_objects_without_value(const py::module_& module);

/// One number of each row as a numpy array that looks into the rows: no copy; `owner` keeps them alive. Not writable.
/// `member` is a pointer to a data member or a function from a row to a reference.
template <class Row, class Member>
py::array column(const std::vector<Row>& rows, const Member& member, py::handle owner) {
  using Value = std::remove_cvref_t<std::invoke_result_t<Member, const Row&>>;
  if (rows.empty()) return py::array_t<Value>(0);
  py::array out(py::dtype::of<Value>(), std::vector<py::ssize_t>{static_cast<py::ssize_t>(rows.size())},
                std::vector<py::ssize_t>{sizeof(Row)}, &std::invoke(member, rows.front()), owner);
  out.attr("setflags")(py::arg("write") = false);
  return out;
}

/// A vector of numbers as an array that looks into it.
py::array view(const std::vector<double>& numbers, py::handle owner);

/// A view of rows of `columns` numbers each.
py::array view(const std::vector<double>& numbers, py::ssize_t columns, py::handle owner);

/// A dictionary of columns, in the order given.
using Columns = std::vector<std::pair<const char*, py::array>>;
py::dict dict_of(const Columns& columns);

/// The getter of a dictionary of arrays, a number of each row under its name; they look into the rows.
template <class T, class Row>
auto columns_of(std::vector<Row> T::*rows,
                std::vector<std::pair<const char*, double std::type_identity_t<Row>::*>> members) {
  return [rows, members = std::move(members)](const py::object& self) {
    py::dict out;
    for (const auto& [name, member] : members) out[name] = column(self.cast<const T&>().*rows, member, self);
    return out;
  };
}

}  // namespace soilbin::python
