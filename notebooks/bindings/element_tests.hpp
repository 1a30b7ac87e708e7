// What the bindings of element tests share.
#pragma once

#include "dem/element_tests/specimen.hpp"
#include "notebooks/bindings/bindings.hpp"

namespace soilbin::python {

/// How a test works: on so many threads, watched from Python.
dem::WorkOptions watched(Watch& watch, int threads);

/// The specimen's settings that tests are given from Python.
dem::SpecimenSettings specimen_of(std::uint64_t packing, double settling_friction, dem::RollingLaw rolling);

/// Does a test, watched, without the interpreter's lock: run(how) gives its result.
template <class Run>
auto tested(int threads, const py::object& progress, const Run& run) {
  Watch watch(progress);
  const dem::WorkOptions how = watched(watch, threads);
  return unlocked([&] { return run(how); });
}

}  // namespace soilbin::python
