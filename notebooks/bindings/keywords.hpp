// Functions whose arguments are the members of a struct of settings, by keyword and with the struct's own defaults: so
// that no call counts positions.
//
//   def_with_settings<GranularSoil, dem::PlateSettings>(module, "plate_sinkage", run, "Round plates ...",
//                                                       keyword("sinkage", &dem::PlateSettings::sinkage));
//
// makes plate_sinkage(soil, sinkage=..., threads=0, progress=None), which calls run(soil, settings, threads, progress).
#pragma once

#include <tuple>
#include <type_traits>

#include "notebooks/bindings/bindings.hpp"

namespace soilbin::python {

/// A keyword argument, and the member of a test's settings that it is: a pointer to it, or a path of pointers through
/// members of members.
template <class... Members>
struct Keyword {
  const char* name;
  std::tuple<Members...> path;

  template <class Settings>
  auto& of(Settings& settings) const {
    return std::apply(
        [&](auto... member) -> auto& { return (settings.*....*member); }, path);
  }
};

template <class... Members>
Keyword<Members...> keyword(const char* name, Members... path) {
  return {name, {path...}};
}

template <class Soil, class Settings, class Run, class... Keywords>
void def_with_settings(py::module_& module, const char* name, Run run, const char* doc, Keywords... keywords) {
  Settings usual;
  module.def(
      name,
      [=](const Soil& soil, const std::remove_cvref_t<decltype(keywords.of(usual))>&... values, int threads,
          const py::object& progress) {
        Settings settings;
        ((keywords.of(settings) = values), ...);
        return run(soil, settings, threads, progress);
      },
      py::arg("soil"), (py::arg(keywords.name) = keywords.of(usual))..., py::arg("threads") = 0,
      py::arg("progress") = py::none(), doc);
}

}  // namespace soilbin::python
