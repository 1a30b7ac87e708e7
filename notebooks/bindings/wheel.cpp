// bekker_wong/: the wheel opened up, what it can do at best, closed forms.
#include <fmt/core.h>

#include "bekker_wong/closed_forms.hpp"
#include "bekker_wong/effect.hpp"
#include "bekker_wong/model.hpp"
#include "compare/report/number_text.hpp"
#include "compare/sweep/wheel_limits.hpp"
#include "notebooks/bindings/bindings.hpp"
#include "notebooks/bindings/scenario.hpp"
#include "scenario/errors.hpp"

namespace soilbin::python {
namespace {

using bekker_wong::ContactAngles;
using bekker_wong::ContactPatch;
using bekker_wong::RolledWheel;
using bekker_wong::RollingWheel;
using bekker_wong::WheelForces;

const SemiEmpiricalSoil& values_in(const Soil& soil) {
  if (!soil.semi_empirical) throw InputError("soil '" + soil.name + "' has no semi_empirical values");
  return *soil.semi_empirical;
}

RollingWheel wheel_of(const Scenario& scenario) {
  return {scenario.tire, bekker_wong::values_of(values_in(scenario.soil)), bekker_wong::make_effects(scenario.effects),
          scenario.bin};
}

/// Arrays over the nodes; each looks into the patch.
py::dict nodes_of(const py::object& self) {
  const ContactPatch& patch = self.cast<const RolledWheel&>().patch;
  const auto nodes = [&](const ContactPatch::Array& values) {
    py::array out(py::dtype::of<double>(), std::vector<py::ssize_t>{patch.count}, {}, values.data(), self);
    out.attr("setflags")(py::arg("write") = false);
    return out;
  };
  return dict_of({{"theta", nodes(patch.theta)},
                  {"arc", nodes(patch.arc)},
                  {"depth", nodes(patch.depth)},
                  {"sigma", nodes(patch.sigma)},
                  {"j_x", nodes(patch.j_x)},
                  {"j_y", nodes(patch.j_y)},
                  {"strength", nodes(patch.strength)},
                  {"tau_x", nodes(patch.tau_x)},
                  {"tau_y", nodes(patch.tau_y)}});
}

void bind_rolled(py::module_& module) {
  const auto angle = [](auto member) { return [member](const RolledWheel& w) { return w.patch.angles.*member; }; };
  const auto force = [](auto member) { return [member](const RolledWheel& w) { return w.forces.*member; }; };
  py::class_<RolledWheel>(module, "RolledWheel", "A wheel at one sinkage: contact and forces, in the wheel's axes.")
      .def_readonly("at", &RolledWheel::at)
      .def_readonly("sinkage", &RolledWheel::sinkage, "z [m]")
      .def_property_readonly("entry_angle", angle(&ContactAngles::entry), "theta_1 [rad]")
      .def_property_readonly("max_stress_angle", angle(&ContactAngles::max_stress), "theta_m [rad]")
      .def_property_readonly("exit_angle", angle(&ContactAngles::exit), "theta_2 [rad]")
      .def_property_readonly("nodes", &nodes_of,
                             "arrays of one shape (nodes,), the nodes of the quadrature, views: theta [rad], arc "
                             "(weight times arc length) "
                             "[m], depth [m], sigma, strength, tau_x, tau_y [Pa], j_x, j_y [m]")
      .def_property_readonly("thrust", force(&WheelForces::thrust), "[N]")
      .def_property_readonly("compaction", force(&WheelForces::compaction), "compaction resistance, negative [N]")
      .def_property_readonly("vertical", force(&WheelForces::vertical), "load that the contact carries [N]")
      .def_property_readonly("torque", force(&WheelForces::torque), "[N m]");
  py::class_<RollingWheel>(module, "RollingWheel", "The wheel of Wong and Reece (1967) on its soil, with effects.")
      .def(py::init(&wheel_of), py::arg("scenario"), "Raises InputError where a value is missing or out of range.")
      .def("roll", &RollingWheel::roll, py::arg("at"), "The balanced wheel. Raises InputError, NoSolution.")
      .def("at_entry_angle",
           py::overload_cast<const OperatingCondition&, double>(&RollingWheel::at_entry_angle, py::const_),
           py::arg("at"), py::arg("theta_1"),
           "The wheel at a given theta_1 [rad], balanced or not: `vertical` says what it carries.");
}

void bind_limits(py::module_& module) {
  using compare::LargestPull;
  py::class_<LargestPull>(module, "PullPeak", "The largest drawbar pull [N] and the slip that gives it.")
      .def_readonly("slip", &LargestPull::slip, "[-]")
      .def_property_readonly(
          "drawbar_pull", [](const LargestPull& p) { return p.drawbar_pull.value; }, "[N]")
      .def_property_readonly(
          "drawbar_pull_std_error", [](const LargestPull& p) { return p.drawbar_pull.std_error; },
          "[N], to first order from the soil's standard deviations")
      .def("__repr__", [](const LargestPull& p) {
        return fmt::format("PullPeak(slip={:.4g}, drawbar_pull={} N)", p.slip, compare::number(p.drawbar_pull));
      });
  module.def("largest_pull", &compare::largest_pull, py::arg("scenario"), py::arg("at"),
             "soilbin.bekker_wong.largest_pull tells the arguments.");
  module.def("slip_for_pull", &compare::slip_for_pull, py::arg("scenario"), py::arg("at"), py::arg("drawbar") = 0.0,
             "soilbin.bekker_wong.slip_for_pull tells the arguments.");
  module.def(
      "steepest_slope",
      [](const Scenario& scenario, const OperatingCondition& at, double drawbar) {
        return compare::steepest_slope(scenario, at, drawbar);
      },
      py::arg("scenario"), py::arg("at"), py::arg("drawbar") = 0.0,
      "soilbin.bekker_wong.steepest_slope tells the arguments.");
}

void bind_closed_forms(py::module_& module) {
  using Form = double (*)(const bekker_wong::SoilValues&, double, double, double);
  const auto form = [&](const char* name, Form of, const char* doc) {
    module.def(
        name,
        [of](const Scenario& scenario, double load) {
          const Tire& tire = scenario.tire;
          return of(bekker_wong::values_of(values_in(scenario.soil)), tire.radius, tire.width, load);
        },
        py::arg("scenario"), py::arg("load"), doc);
  };
  form("bekker_static_sinkage", &bekker_wong::bekker_static_sinkage,
       "Bekker's static sinkage of a towed rigid wheel [m] (Bekker 1956). load [N] >= 0.");
  form("rolling_resistance", &bekker_wong::rolling_resistance,
       "Bekker's rolling resistance of a towed rigid wheel [N] (Bekker 1956). load [N] >= 0.");
  form("critical_ground_pressure", &bekker_wong::critical_ground_pressure,
       "Wong's critical ground pressure [Pa]: a tire harder than this rolls as if rigid. load [N] >= 0.");
}

void bind_presumptions(py::module_& module) {
  py::class_<bekker_wong::Presumed>(module, "Presumed",
                                    "A value that an effect takes although the wheel does not declare it.")
      .def_readonly("key", &bekker_wong::Presumed::key, "as in a tire file: 'lugs.height'")
      .def_readonly("value", &bekker_wong::Presumed::value, "[SI]")
      .def_readonly("words", &bekker_wong::Presumed::words, "'lug height = 12.5 mm (5 % of the radius)'");
  module.def(
      "presumed",
      [](const EffectName& effect, const Tire& tire) {
        return bekker_wong::presumed(bekker_wong::find_form(effect_of(effect)), tire);
      },
      py::arg("effect"), py::arg("tire"),
      "What an effect takes for values that the tire does not declare; empty where the tire declares all that it "
      "reads. effect: 'lug_thrust', 'lug_thrust:FORM' or an EffectChoice.");
}

}  // namespace

void bind_wheel(py::module_& module) {
  bind_presumptions(module);
  bind_rolled(module);
  bind_limits(module);
  bind_closed_forms(module);
}

}  // namespace soilbin::python
