// dem/element_tests: grains in the laboratory.
#include <fmt/core.h>

#include "dem/element_tests/angle_of_repose.hpp"
#include "dem/element_tests/bevameter_tests.hpp"
#include "dem/element_tests/direct_shear.hpp"
#include "dem/element_tests/tilting_board.hpp"
#include "dem/element_tests/triaxial.hpp"
#include "notebooks/bindings/keywords.hpp"
#include "scenario/errors.hpp"

namespace soilbin::python {
namespace {

using dem::AngleOfReposeResult;
using dem::AnnulusRun;
using dem::AnnulusSample;
using dem::DirectShearResult;
using dem::DirectShearRun;
using dem::HeapProfile;
using dem::PlateRun;
using dem::PlateSample;
using dem::ShearSample;
using dem::StrengthLine;
using dem::TiltingBoardResult;
using dem::TiltSample;
using dem::TriaxialResult;
using dem::TriaxialRun;
using dem::TriaxialSample;

/// Binds a test of a soil's grains; its settings are keyword arguments.
template <class Settings, class Test, class... Keywords>
void def_test(py::module_& module, const char* name, Test test, const char* doc, Keywords... keywords) {
  const auto run = [test](const GranularSoil& soil, const Settings& settings, int threads, const py::object& progress) {
    if (threads < 0) throw InputError("threads: 0 (one a core) or more");
    Watch watch(progress);
    dem::WorkOptions how;
    how.threads = threads;
    how.progress = [&watch](const dem::Progress& p) { watch(p.done, p.stage); };
    return unlocked([&] {
      if constexpr (std::is_invocable_v<Test, GranularSoil, Settings, dem::WorkOptions>)
        return test(soil, settings, how);
      else
        return test(soil, settings, how, nullptr);
    });
  };
  def_with_settings<GranularSoil, Settings>(module, name, run, doc, keywords...);
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
          "curve",
          columns_of(&DirectShearRun::curve, {{"displacement", &ShearSample::displacement},
                                              {"shear_stress", &ShearSample::shear_stress},
                                              {"normal_stress", &ShearSample::normal_stress},
                                              {"dilation", &ShearSample::dilation}}),
          "arrays of one shape (samples,), views: displacement, dilation [m], shear_stress, normal_stress [Pa]");
  py::class_<DirectShearResult>(module, "DirectShearResult", "The shear box's answer.")
      .def_readonly("runs", &DirectShearResult::runs)
      .def_readonly("peak", &DirectShearResult::peak, "points 0 with a single stress")
      .def_readonly("residual", &DirectShearResult::residual)
      .def_readonly("mean_diameter", &DirectShearResult::mean_diameter, "[m]");
}

void bind_shear_box(py::module_& module) {
  using S = dem::DirectShearSettings;
  def_test<S>(module, "direct_shear", &dem::direct_shear, "soilbin.dem.direct_shear tells the arguments.",
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
      .def_property_readonly("profile",
                             columns_of(&AngleOfReposeResult::profile,
                                        {{"radius", &HeapProfile::radius}, {"height", &HeapProfile::height}}),
                             "arrays of one shape (rings,), views: radius, height [m]");
  using S = dem::AngleOfReposeSettings;
  def_test<S>(module, "angle_of_repose", &dem::angle_of_repose, "soilbin.dem.angle_of_repose tells the arguments.",
              keyword("packing", &S::packing), keyword("radius", &S::radius), keyword("height", &S::height),
              keyword("rolling", &S::laws, &dem::ContactLaws::rolling));
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
      .def_property_readonly("curve",
                             columns_of(&TriaxialRun::curve, {{"strain", &TriaxialSample::strain},
                                                              {"volumetric", &TriaxialSample::volumetric},
                                                              {"axial", &TriaxialSample::axial},
                                                              {"lateral_x", &TriaxialSample::lateral_x},
                                                              {"lateral_y", &TriaxialSample::lateral_y}}),
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
  def_test<S>(module, "triaxial", &dem::triaxial, "soilbin.dem.triaxial tells the arguments.",
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
      .def_property_readonly(
          "curve",
          columns_of(&TiltingBoardResult::curve,
                     {{"angle", &TiltSample::angle}, {"slide", &TiltSample::slide}, {"turn", &TiltSample::turn}}),
          "arrays of one shape (samples,), views: angle [rad], slide down the board [m], turn: how "
          "far grains rolled [rad]");
  using S = dem::TiltingBoardSettings;
  def_test<S>(module, "tilting_board", &dem::tilting_board, "soilbin.dem.tilting_board tells the arguments.",
              keyword("packing", &S::packing), keyword("across", &S::across), keyword("layers", &S::layers),
              keyword("dt", &S::dt), keyword("rolling", &S::laws, &dem::ContactLaws::rolling));
}

void bind_plate_results(py::module_& module) {
  py::class_<PlateRun>(module, "PlateRun", "One plate pressed into the bed.")
      .def_readonly("diameter", &PlateRun::diameter, "[m]")
      .def_readonly("speed", &PlateRun::speed, "[m/s]")
      .def_readonly("grains", &PlateRun::grains, "in the bed")
      .def_readonly("void_ratio", &PlateRun::void_ratio, "of the bed [-]")
      .def_readonly("density", &PlateRun::density, "of the bed in bulk [kg/m^3]")
      .def_readonly("packing", &PlateRun::packing, "seed")
      .def_property_readonly(
          "curve",
          columns_of(&PlateRun::curve, {{"sinkage", &PlateSample::sinkage}, {"pressure", &PlateSample::pressure}}),
          "arrays of one shape (samples,), views: sinkage [m], pressure [Pa]");
  py::class_<AnnulusRun>(module, "AnnulusRun", "The ring turned under one stress.")
      .def_readonly("stress", &AnnulusRun::stress, "asked for [Pa]")
      .def_readonly("speed", &AnnulusRun::speed, "at the mean radius [m/s]")
      .def_readonly("packing", &AnnulusRun::packing, "seed")
      .def_property_readonly(
          "curve",
          columns_of(&AnnulusRun::curve, {{"displacement", &AnnulusSample::displacement},
                                          {"shear_stress", &AnnulusSample::shear_stress},
                                          {"normal_stress", &AnnulusSample::normal_stress},
                                          {"sinkage", &AnnulusSample::sinkage}}),
          "arrays of one shape (samples,), views: displacement, sinkage [m], shear_stress, normal_stress [Pa]");
}

void bind_plate(py::module_& module) {
  using S = dem::PlateSettings;
  def_test<S>(
      module, "plate_sinkage", &dem::plate_sinkage, "soilbin.dem.plate_sinkage tells the arguments.",
      keyword("diameters", &S::diameters), keyword("sinkage", &S::sinkage),
      keyword("width", &S::bed, &dem::TestBed::width), keyword("depth", &S::bed, &dem::TestBed::depth),
      keyword("packing", &S::bed, &dem::TestBed::specimen, &dem::SpecimenSettings::packing),
      keyword("settling_friction", &S::bed, &dem::TestBed::specimen, &dem::SpecimenSettings::settling_friction),
      keyword("rolling", &S::bed, &dem::TestBed::specimen, &dem::SpecimenSettings::laws, &dem::ContactLaws::rolling));
}

void bind_ring(py::module_& module) {
  using S = dem::AnnulusSettings;
  def_test<S>(
      module, "annular_shear", &dem::annular_shear, "soilbin.dem.annular_shear tells the arguments.",
      keyword("stresses", &S::stresses), keyword("inner", &S::inner), keyword("outer", &S::outer),
      keyword("travel", &S::travel), keyword("width", &S::bed, &dem::TestBed::width),
      keyword("depth", &S::bed, &dem::TestBed::depth),
      keyword("packing", &S::bed, &dem::TestBed::specimen, &dem::SpecimenSettings::packing),
      keyword("settling_friction", &S::bed, &dem::TestBed::specimen, &dem::SpecimenSettings::settling_friction),
      keyword("rolling", &S::bed, &dem::TestBed::specimen, &dem::SpecimenSettings::laws, &dem::ContactLaws::rolling));
}

}  // namespace

void bind_element_tests(py::module_& module) {
  bind_shear_results(module);
  bind_shear_box(module);
  bind_heap(module);
  bind_triaxial_results(module);
  bind_triaxial(module);
  bind_board(module);
  bind_plate_results(module);
  bind_plate(module);
  bind_ring(module);
}

}  // namespace soilbin::python
