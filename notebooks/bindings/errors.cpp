// The library's errors as exceptions of Python.
#include "scenario/errors.hpp"

#include "dem/engine/simulation.hpp"
#include "notebooks/bindings/bindings.hpp"

namespace soilbin::python {
namespace {

/// Held for as long as the interpreter lives.
PyObject* input_error = nullptr;

void raise_input_error(const InputError& error) {
  py::object raised = py::reinterpret_borrow<py::object>(input_error)(error.what());
  const SourcePosition& at = error.position();
  const auto counted = [](int n) { return n > 0 ? py::object(py::int_(n)) : py::object(py::none()); };
  raised.attr("file") = at.file.empty() ? py::object(py::none()) : py::object(py::str(at.file));
  raised.attr("line") = counted(at.line);
  raised.attr("column") = counted(at.column);
  PyErr_SetObject(input_error, raised.ptr());
}

}  // namespace

void bind_errors(py::module_& module) {
  input_error = PyErr_NewExceptionWithDoc(
      "soilbin.InputError",
      "Input that is refused. The message reads 'file:line:column: message', then an excerpt and a hint where there "
      "are any.\n\nfile, line, column: where, None where the input is no file or the file is meant as a whole.",
      PyExc_ValueError, nullptr);
  py::object type = py::reinterpret_borrow<py::object>(input_error);
  for (const char* name : {"file", "line", "column"}) type.attr(name) = py::none();
  module.attr("InputError") = type;
  const auto exception = [&](auto& made, const char* doc) {
    made.attr("__doc__") = doc;
    made.attr("__module__") = "soilbin";
  };
  static py::exception<NoSolution> no_solution(module, "NoSolution", PyExc_RuntimeError);
  exception(no_solution,
            "A question that the model has no answer to: the wheel would bury itself, or no sinkage "
            "carries the load. Never answered with a zero.");
  static py::exception<dem::RunStopped> stopped(module, "RunStopped", PyExc_RuntimeError);
  exception(stopped, "A run of grains that can't go on: an overlap too deep, a grain lost.");
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const InputError& error) {
      raise_input_error(error);
    } catch (const NoSolution& error) {
      PyErr_SetString(no_solution.ptr(), error.what());
    } catch (const dem::RunStopped& error) {
      PyErr_SetString(stopped.ptr(), error.what());
    }
  });
}

}  // namespace soilbin::python
