// dem/element_tests: grains in the laboratory.
#include "notebooks/bindings/element_tests.hpp"

#include <fmt/core.h>

#include "dem/element_tests/angle_of_repose.hpp"
#include "dem/element_tests/direct_shear.hpp"
#include "scenario/errors.hpp"

namespace soilbin::python {
namespace {

using dem::AngleOfReposeResult;
using dem::DirectShearResult;
using dem::DirectShearRun;
using dem::HeapProfile;
using dem::ShearSample;
using dem::StrengthLine;

py::dict curve_of(const py::object& self) {
  const auto& rows = self.cast<const DirectShearRun&>().curve;
  return dict_of({{"displacement", column(rows, &ShearSample::displacement, self)},
                  {"shear_stress", column(rows, &ShearSample::shear_stress, self)},
                  {"normal_stress", column(rows, &ShearSample::normal_stress, self)},
                  {"dilation", column(rows, &ShearSample::dilation, self)}});
}

py::dict profile_of(const py::object& self) {
  const auto& rows = self.cast<const AngleOfReposeResult&>().profile;
  return dict_of(
      {{"radius", column(rows, &HeapProfile::radius, self)}, {"height", column(rows, &HeapProfile::height, self)}});
}

void bind_shear_results(py::module_& module) {
  py::class_<StrengthLine>(module, "StrengthLine", "tau = c + sigma tan(phi), fitted.")
      .def_readonly("cohesion", &StrengthLine::cohesion, "c [Pa]; may come out below 0")
      .def_readonly("friction_angle", &StrengthLine::friction_angle, "phi [rad]")
      .def_readonly("covariance", &StrengthLine::covariance, "of c and phi [Pa rad]")
      .def_readonly("chi2", &StrengthLine::chi2)
      .def_readonly("points", &StrengthLine::points)
      .def_readonly("friction_angle_without_cohesion", &StrengthLine::friction_angle_without_cohesion,
                    "of the line through the origin [rad]");
  using R = DirectShearRun;
  py::class_<R>(module, "DirectShearRun", "One specimen under one stress.")
      .def_readonly("stress", &R::stress, "asked for on the plane of shear [Pa]")
      .def_readonly("packing", &R::packing, "seed")
      .def_readonly("void_ratio", &R::void_ratio, "before the shear [-]")
      .def_readonly("peak", &R::peak, "shear over normal stress [-]")
      .def_readonly("residual", &R::residual, "shear over normal stress [-]")
      .def_readonly("peak_at", &R::peak_at, "displacement [m]")
      .def_property_readonly(
          "normal", [](const R& run) { return run.normal.at_peak; },
          "normal stress at the peak, as it was measured [Pa]")
      .def_readonly("work", &R::work, "done on the grains by lid and box [J]")
      .def_readonly("work_of_stress", &R::work_of_stress, "the same by the curve's stresses [J]")
      .def_property_readonly(
          "curve", &curve_of,
          "arrays of one shape (samples,), views: displacement, dilation [m], shear_stress, normal_stress [Pa]");
  py::class_<DirectShearResult>(module, "DirectShearResult", "The shear box's answer.")
      .def_readonly("runs", &DirectShearResult::runs)
      .def_readonly("peak", &DirectShearResult::peak, "points 0 with a single stress")
      .def_readonly("residual", &DirectShearResult::residual)
      .def_readonly("mean_diameter", &DirectShearResult::mean_diameter, "[m]");
}

void bind_shear_box(py::module_& module) {
  using S = dem::DirectShearSettings;
  def_test<S>(
      module, "direct_shear",
      [](const auto& soil, const auto& settings, const auto& how) { return dem::direct_shear(soil, settings, how); },
      "The shear box (docs/guide/element-tests.md). stresses: normal, on the plane of shear [Pa], at least two for c "
      "and phi. packings: specimens, of seeds packing, +1, ... length, width, height, travel: in mean diameters. "
      "settling_friction: 0 (densest) .. 1 (loose). inertial: number that sets the speed. Same settings, same bits, "
      "for any number of threads. Raises InputError, RunStopped.",
      keyword("stresses", &S::stresses), keyword("packings", &S::packings),
      keyword("packing", &S::specimen, &dem::SpecimenSettings::packing), keyword("length", &S::length),
      keyword("width", &S::width), keyword("height", &S::height), keyword("travel", &S::travel),
      keyword("settling_friction", &S::specimen, &dem::SpecimenSettings::settling_friction),
      keyword("rolling", &S::specimen, &dem::SpecimenSettings::laws, &dem::ContactLaws::rolling),
      keyword("inertial", &S::inertial));
}

void bind_heap(py::module_& module) {
  using R = AngleOfReposeResult;
  py::class_<R>(module, "AngleOfReposeResult", "A heap at rest.")
      .def_readonly("angle", &R::angle, "of the slope [rad]")
      .def_readonly("by_sector", &R::by_sector, "[rad]")
      .def_readonly("height", &R::height, "of the heap [m]")
      .def_readonly("base", &R::base, "its radius where the fitted line meets the floor [m]")
      .def_readonly("grains", &R::grains)
      .def_readonly("settling_time", &R::settling_time, "from the start of the lift until rest [s]")
      .def_readonly("mean_diameter", &R::mean_diameter, "[m]")
      .def_property_readonly("profile", &profile_of, "arrays of one shape (rings,), views: radius, height [m]");
  using S = dem::AngleOfReposeSettings;
  def_test<S>(
      module, "angle_of_repose",
      [](const auto& soil, const auto& settings, const auto& how) { return dem::angle_of_repose(soil, settings, how); },
      "A cylinder of grains (radius and height in mean diameters) on a floor is lifted; the heap's slope, with its "
      "error by eight sectors. Raises InputError, RunStopped where no rest is found.",
      keyword("packing", &S::packing), keyword("radius", &S::radius), keyword("height", &S::height),
      keyword("rolling", &S::laws, &dem::ContactLaws::rolling));
}

}  // namespace

dem::WorkOptions watched(Watch& watch, int threads) {
  if (threads < 0) throw InputError("threads: 0 (one a core) or more");
  dem::WorkOptions how;
  how.threads = threads;
  how.progress = [&watch](const dem::Progress& p) { watch(p.done, p.stage); };
  return how;
}

void bind_element_tests(py::module_& module) {
  bind_shear_results(module);
  bind_shear_box(module);
  bind_heap(module);
}

}  // namespace soilbin::python
