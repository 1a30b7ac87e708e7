// dem/element_tests: the triaxial cell and the tilting board.
#include "dem/element_tests/tilting_board.hpp"
#include "dem/element_tests/triaxial.hpp"
#include "notebooks/bindings/element_tests.hpp"

namespace soilbin::python {
namespace {

using dem::TiltingBoardResult;
using dem::TiltSample;
using dem::TriaxialResult;
using dem::TriaxialRun;
using dem::TriaxialSample;

py::dict compression_of(const py::object& self) {
  const auto& rows = self.cast<const TriaxialRun&>().curve;
  return dict_of({{"strain", column(rows, &TriaxialSample::strain, self)},
                  {"volumetric", column(rows, &TriaxialSample::volumetric, self)},
                  {"axial", column(rows, &TriaxialSample::axial, self)},
                  {"lateral_x", column(rows, &TriaxialSample::lateral_x, self)},
                  {"lateral_y", column(rows, &TriaxialSample::lateral_y, self)}});
}

py::dict tilt_of(const py::object& self) {
  const auto& rows = self.cast<const TiltingBoardResult&>().curve;
  return dict_of({{"angle", column(rows, &TiltSample::angle, self)},
                  {"slide", column(rows, &TiltSample::slide, self)},
                  {"turn", column(rows, &TiltSample::turn, self)}});
}

void bind_triaxial_results(py::module_& module) {
  using R = TriaxialRun;
  py::class_<R>(module, "TriaxialRun", "One specimen under one confining stress.")
      .def_readonly("stress", &R::stress, "confining [Pa]")
      .def_readonly("packing", &R::packing, "seed")
      .def_readonly("void_ratio", &R::void_ratio, "after isotropic consolidation [-]")
      .def_readonly("isotropic_error", &R::isotropic_error, "after it, largest |stress/asked - 1| of the axes [-]")
      .def_readonly("confining_error", &R::confining_error, "during compression, of the mean lateral stresses [-]")
      .def_readonly("peak", &R::peak, "(s1 - s3)/(s1 + s3), the sine of the mobilised angle [-]")
      .def_readonly("residual", &R::residual, "the same at the end [-]")
      .def_readonly("peak_at", &R::peak_at, "axial strain [-]")
      .def_readonly("dilation_angle", &R::dilation_angle, "at the peak [rad]")
      .def_readonly("work", &R::work, "of the walls on the grains during compression [J]")
      .def_property_readonly("curve", &compression_of,
                             "arrays of one shape (samples,), views: strain, volumetric (compression positive) [-], "
                             "axial, lateral_x, lateral_y [Pa]");
  py::class_<TriaxialResult>(module, "TriaxialResult", "The triaxial cell's answer.")
      .def_readonly("runs", &TriaxialResult::runs)
      .def_readonly("peak", &TriaxialResult::peak, "points 0 with a single stress")
      .def_readonly("residual", &TriaxialResult::residual)
      .def_readonly("mean_diameter", &TriaxialResult::mean_diameter, "[m]");
}

void bind_triaxial(py::module_& module) {
  using S = dem::TriaxialSettings;
  def_test<S>(
      module, "triaxial",
      [](const auto& soil, const auto& settings, const auto& how) { return dem::triaxial(soil, settings, how); },
      "True triaxial compression between six smooth walls (docs/guide/element-tests.md). stresses: confining [Pa], at "
      "least two for c and phi. side, height: of the specimen, in mean diameters. strain: axial, at the end. inertial: "
      "number that sets the rate. Raises InputError, RunStopped.",
      keyword("stresses", &S::stresses), keyword("packings", &S::packings),
      keyword("packing", &S::specimen, &dem::SpecimenSettings::packing), keyword("side", &S::side),
      keyword("height", &S::height), keyword("strain", &S::strain),
      keyword("settling_friction", &S::specimen, &dem::SpecimenSettings::settling_friction),
      keyword("rolling", &S::specimen, &dem::SpecimenSettings::laws, &dem::ContactLaws::rolling),
      keyword("inertial", &S::inertial));
}

void bind_board(py::module_& module) {
  using R = TiltingBoardResult;
  py::class_<R>(module, "TiltingBoardResult", "A layer of grains on a board that was tilted.")
      .def_readonly("onset", &R::onset, "angle at which it began to slide [rad]")
      .def_readonly("gone", &R::gone, "angle at which it had slid by a diameter [rad]")
      .def_readonly("slid", &R::slid, "False: it held up to the steepest angle, and both angles are that")
      .def_readonly("grains", &R::grains)
      .def_readonly("mean_diameter", &R::mean_diameter, "[m]")
      .def_property_readonly("curve", &tilt_of,
                             "arrays of one shape (samples,), views: angle [rad], slide down the board [m], turn: how "
                             "far grains rolled [rad]");
  using S = dem::TiltingBoardSettings;
  def_test<S>(
      module, "tilting_board",
      [](const auto& soil, const auto& settings, const auto& how) { return dem::tilting_board(soil, settings, how); },
      "The friction test of Zhou, Gao, Li, Hu: sand on a board of the tire's material, tilted until it slides. across: "
      "grains along a side. layers: height in mean diameters. dt: time step [s]; 0: the longest that is safe, at which "
      "directional rolling resistance lets grains creep. Raises InputError, RunStopped.",
      keyword("packing", &S::packing), keyword("across", &S::across), keyword("layers", &S::layers),
      keyword("dt", &S::dt), keyword("rolling", &S::laws, &dem::ContactLaws::rolling));
}

}  // namespace

void bind_strength_tests(py::module_& module) {
  bind_triaxial_results(module);
  bind_triaxial(module);
  bind_board(module);
}

}  // namespace soilbin::python
