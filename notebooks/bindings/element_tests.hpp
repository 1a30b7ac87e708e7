// What the bindings of element tests share.
#pragma once

#include "dem/element_tests/specimen.hpp"
#include "notebooks/bindings/keywords.hpp"

namespace soilbin::python {

/// How a test works: on so many threads, watched from Python.
dem::WorkOptions watched(Watch& watch, int threads);

/// Binds a test of a soil's grains; its settings are keyword arguments.
template <class Settings, class Test, class... Keywords>
void def_test(py::module_& module, const char* name, Test test, const char* doc, Keywords... keywords) {
  const auto run = [test](const GranularSoil& soil, const Settings& settings, int threads, const py::object& progress) {
    Watch watch(progress);
    const dem::WorkOptions how = watched(watch, threads);
    return unlocked([&] { return test(soil, settings, how); });
  };
  def_with_settings<GranularSoil, Settings>(module, name, run, doc, keywords...);
}

}  // namespace soilbin::python
