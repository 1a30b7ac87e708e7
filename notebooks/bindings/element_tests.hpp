// What the bindings of element tests share: a test as a function of the soil, of its settings by keyword, and of how it
// works.
//
//   def_test<dem::PlateSettings>(module, "plate_sinkage", dem::plate_sinkage, "Round plates ...",
//                                keyword("sinkage", &dem::PlateSettings::sinkage));
//
// makes plate_sinkage(soil, sinkage=..., threads=0, progress=None), with the settings' own defaults.
#pragma once

#include <tuple>

#include "dem/element_tests/specimen.hpp"
#include "notebooks/bindings/bindings.hpp"

namespace soilbin::python {

/// How a test works: on so many threads, watched from Python.
dem::WorkOptions watched(Watch& watch, int threads);

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

template <class Settings, class Run, class... Keywords>
void def_test(py::module_& module, const char* name, Run run, const char* doc, Keywords... keywords) {
  Settings usual;
  module.def(
      name,
      [=](const GranularSoil& soil, const std::remove_cvref_t<decltype(keywords.of(usual))>&... values, int threads,
          const py::object& progress) {
        Settings settings;
        ((keywords.of(settings) = values), ...);
        Watch watch(progress);
        const dem::WorkOptions how = watched(watch, threads);
        return unlocked([&] { return run(soil, settings, how); });
      },
      py::arg("soil"), (py::arg(keywords.name) = keywords.of(usual))..., py::arg("threads") = 0,
      py::arg("progress") = py::none(), doc);
}

}  // namespace soilbin::python
