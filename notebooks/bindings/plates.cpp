// From plates and sheared rings to the values of the semi-empirical model.
#include <fmt/core.h>

#include "bekker_wong/plate_fit.hpp"
#include "compare/bevameter/bevameter.hpp"
#include "notebooks/bindings/bindings.hpp"
#include "scenario/errors.hpp"

namespace soilbin::python {
namespace {

using bekker_wong::PlateCurve;
using bekker_wong::PlateExponent;
using bekker_wong::PlateFit;
using bekker_wong::PlateTest;
using bekker_wong::PressureGrid;
using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

std::vector<double> numbers(const Numbers& array) {
  if (array.ndim() != 1)
    throw InputError("pressures, sinkages, displacements and stresses are one row of numbers each");
  return {array.data(), array.data() + array.size()};
}

template <class Plate>
void bind_plate(py::module_& module, const char* name, const char* doc) {
  py::class_<Plate>(module, name, doc)
      .def(py::init([](double radius, const Numbers& pressure, const Numbers& sinkage) {
             Plate plate{radius, numbers(pressure), numbers(sinkage)};
             if (plate.pressure.size() != plate.sinkage.size())
               throw InputError(
                   fmt::format("{} pressures for {} sinkages", plate.pressure.size(), plate.sinkage.size()));
             return plate;
           }),
           py::arg("radius"), py::arg("pressure"), py::arg("sinkage"),
           "radius [m]; pressure [Pa] and sinkage [m]: arrays of one shape (readings,).")
      .def_readonly("radius", &Plate::radius, "b [m]; of a strip its width")
      .def_property_readonly(
          "pressure", [](const py::object& self) { return view(self.cast<const Plate&>().pressure, self); },
          "[Pa], shape (readings,)")
      .def_property_readonly(
          "sinkage", [](const py::object& self) { return view(self.cast<const Plate&>().sinkage, self); },
          "[m], shape (readings,)");
}

void bind_fits(py::module_& module) {
  py::enum_<PlateExponent>(module, "PlateExponent", "How one exponent comes from several plates.")
      .value("mean_of_plates", PlateExponent::mean_of_plates, "each plate's own, averaged (Wong)")
      .value("common", PlateExponent::common, "one for all in one regression");
  py::class_<PlateFit>(module, "PlateFit", "n, k_c and k_phi of Bekker's p = (k_c/b + k_phi) z^n.")
      .def_readonly("exponent", &PlateFit::exponent, "n [-]")
      .def_readonly("k_c", &PlateFit::k_c, "[N/m^(n+1)]")
      .def_readonly("k_phi", &PlateFit::k_phi,
                    "[N/m^(n+2)]; may come out negative where the plates disagree with Bekker's form")
      .def_readonly("plate_exponents", &PlateFit::plate_exponents, "n of each plate by itself [-]")
      .def_readonly("plate_moduli", &PlateFit::plate_moduli, "k of each plate at the exponent [N/m^(n+2)]")
      .def("__repr__", [](const PlateFit& f) {
        return fmt::format("PlateFit(exponent={:.4g}, k_c={:.4g}, k_phi={:.4g})", f.exponent, f.k_c, f.k_phi);
      });
  module.def(
      "mean_curve",
      [](const std::vector<PlateTest>& repeats, double first, double step, double last) {
        return bekker_wong::mean_curve(repeats, {.first = first, .step = step, .last = last});
      },
      py::arg("repeats"), py::arg("first"), py::arg("step"), py::arg("last"),
      "Mean of repeats with one plate: sinkages by a cubic spline over pressure, at first, first + step, .., last "
      "[Pa]. Raises InputError for plates of different radii.");
  module.def(
      "fit_plates",
      [](const std::vector<PlateCurve>& curves, PlateExponent exponent) {
        return bekker_wong::fit_plates(curves, exponent);
      },
      py::arg("curves"), py::arg("exponent") = PlateExponent::mean_of_plates,
      "Least squares in logarithms with weights p^2 (Wong 1980), then k_c and k_phi by a line through the moduli over "
      "1/b. Raises InputError for fewer than two radii.");
  module.def(
      "fit_plates_at",
      [](const std::vector<PlateCurve>& curves, double exponent) {
        return bekker_wong::fit_plates_at(curves, exponent);
      },
      py::arg("curves"), py::arg("exponent"), "The same at a given exponent.");
}

void bind_janosi(py::module_& module) {
  using compare::JanosiFit;
  py::class_<JanosiFit>(module, "JanosiFit", "tau = tau_max (1 - exp(-j/K)) (Janosi and Hanamoto 1961).")
      .def_readonly("shear_max", &JanosiFit::shear_max, "tau_max [Pa]")
      .def_readonly("modulus", &JanosiFit::modulus, "K [m]")
      .def_readonly("rms", &JanosiFit::rms, "of what is left [Pa]");
  module.def(
      "fit_janosi",
      [](const Numbers& displacement, const Numbers& shear_stress) {
        return compare::fit_janosi({.displacement = numbers(displacement), .shear_stress = numbers(shear_stress)});
      },
      py::arg("displacement"), py::arg("shear_stress"),
      "Least squares in tau; displacements j > 0 [m] and stresses [Pa], arrays of one shape (readings,). Raises "
      "InputError for fewer than four points.");
}

}  // namespace

void bind_plates(py::module_& module) {
  bind_plate<PlateTest>(module, "PlateTest",
                        "One plate pressed in once: pressure [Pa] strictly increasing, sinkage [m].");
  bind_plate<PlateCurve>(module, "PlateCurve", "Sinkage [m] against pressure [Pa] of one plate; no zeros.");
  bind_fits(module);
  bind_janosi(module);
}

}  // namespace soilbin::python
