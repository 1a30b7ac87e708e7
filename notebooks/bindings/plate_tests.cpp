// dem/element_tests: the bevameter's plates and ring on grains.
#include "dem/element_tests/bevameter_tests.hpp"
#include "notebooks/bindings/element_tests.hpp"

namespace soilbin::python {
namespace {

using dem::AnnulusRun;
using dem::AnnulusSample;
using dem::PlateRun;
using dem::PlateSample;

py::dict pressed(const py::object& self) {
  const auto& rows = self.cast<const PlateRun&>().curve;
  return dict_of({{"sinkage", column(rows, &PlateSample::sinkage, self)},
                  {"pressure", column(rows, &PlateSample::pressure, self)}});
}

py::dict sheared(const py::object& self) {
  const auto& rows = self.cast<const AnnulusRun&>().curve;
  return dict_of({{"displacement", column(rows, &AnnulusSample::displacement, self)},
                  {"shear_stress", column(rows, &AnnulusSample::shear_stress, self)},
                  {"normal_stress", column(rows, &AnnulusSample::normal_stress, self)},
                  {"sinkage", column(rows, &AnnulusSample::sinkage, self)}});
}

void bind_runs(py::module_& module) {
  py::class_<PlateRun>(module, "PlateRun", "One plate pressed into the bed.")
      .def_readonly("diameter", &PlateRun::diameter, "[m]")
      .def_readonly("speed", &PlateRun::speed, "[m/s]")
      .def_readonly("grains", &PlateRun::grains, "in the bed")
      .def_readonly("void_ratio", &PlateRun::void_ratio, "of the bed [-]")
      .def_readonly("density", &PlateRun::density, "of the bed in bulk [kg/m^3]")
      .def_readonly("packing", &PlateRun::packing, "seed")
      .def_property_readonly("curve", &pressed, "arrays of one shape (samples,), views: sinkage [m], pressure [Pa]");
  py::class_<AnnulusRun>(module, "AnnulusRun", "The ring turned under one stress.")
      .def_readonly("stress", &AnnulusRun::stress, "asked for [Pa]")
      .def_readonly("speed", &AnnulusRun::speed, "at the mean radius [m/s]")
      .def_readonly("packing", &AnnulusRun::packing, "seed")
      .def_property_readonly(
          "curve", &sheared,
          "arrays of one shape (samples,), views: displacement, sinkage [m], shear_stress, normal_stress [Pa]");
}

void bind_plate(py::module_& module) {
  using S = dem::PlateSettings;
  def_test<S>(
      module, "plate_sinkage",
      [](const auto& soil, const auto& settings, const auto& how) { return dem::plate_sinkage(soil, settings, how); },
      "Round plates pressed into a bed of the grains, each into a fresh copy (docs/guide/element-tests.md). diameters, "
      "sinkage: in mean diameters of the grains. width, depth: of the bed, in diameters of the widest plate. Raises "
      "InputError for a plate under five grains wide, RunStopped.",
      keyword("diameters", &S::diameters), keyword("sinkage", &S::sinkage),
      keyword("width", &S::bed, &dem::TestBed::width), keyword("depth", &S::bed, &dem::TestBed::depth),
      keyword("packing", &S::bed, &dem::TestBed::specimen, &dem::SpecimenSettings::packing),
      keyword("settling_friction", &S::bed, &dem::TestBed::specimen, &dem::SpecimenSettings::settling_friction),
      keyword("rolling", &S::bed, &dem::TestBed::specimen, &dem::SpecimenSettings::laws, &dem::ContactLaws::rolling));
}

void bind_ring(py::module_& module) {
  using S = dem::AnnulusSettings;
  def_test<S>(
      module, "annular_shear",
      [](const auto& soil, const auto& settings, const auto& how) { return dem::annular_shear(soil, settings, how); },
      "A ring with grousers turned on a bed of the grains under each stress [Pa] (docs/guide/element-tests.md). inner, "
      "outer: its radii; travel: at the mean radius; all in mean diameters. width, depth: of the bed, in diameters of "
      "the ring. Raises InputError for a ring under five grains wide, RunStopped.",
      keyword("stresses", &S::stresses), keyword("inner", &S::inner), keyword("outer", &S::outer),
      keyword("travel", &S::travel), keyword("width", &S::bed, &dem::TestBed::width),
      keyword("depth", &S::bed, &dem::TestBed::depth),
      keyword("packing", &S::bed, &dem::TestBed::specimen, &dem::SpecimenSettings::packing),
      keyword("settling_friction", &S::bed, &dem::TestBed::specimen, &dem::SpecimenSettings::settling_friction),
      keyword("rolling", &S::bed, &dem::TestBed::specimen, &dem::SpecimenSettings::laws, &dem::ContactLaws::rolling));
}

}  // namespace

void bind_plate_tests(py::module_& module) {
  bind_runs(module);
  bind_plate(module);
  bind_ring(module);
}

}  // namespace soilbin::python
