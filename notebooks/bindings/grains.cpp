// dem/engine: a handful of grains, to look at the laws of contact.
#include <fmt/core.h>

#include <algorithm>

#include "dem/engine/rayleigh_time.hpp"
#include "dem/engine/simulation.hpp"
#include "notebooks/bindings/vectors.hpp"
#include "scenario/errors.hpp"

namespace soilbin::python {
namespace {

using dem::Interaction;
using dem::Material;
using dem::Simulation;
using dem::Vec3;

/// Steps between two looks at signals.
constexpr std::int64_t steps_between_looks = 200;

template <class E>
void bind_law(py::module_& module, const char* name, std::initializer_list<std::pair<const char*, E>> words) {
  py::enum_<E> bound(module, name, "Which law acts at the contacts (docs/theory/dem-laws.md).");
  for (const auto& [word, value] : words) bound.value(word, value);
}

void bind_laws(py::module_& module) {
  bind_law<dem::NormalLaw>(module, "NormalLaw", {{"hertz", dem::NormalLaw::hertz}, {"hooke", dem::NormalLaw::hooke}});
  bind_law<dem::RollingLaw>(module, "RollingLaw",
                            {{"none", dem::RollingLaw::none},
                             {"elastic_plastic", dem::RollingLaw::elastic_plastic},
                             {"directional", dem::RollingLaw::directional},
                             {"directional_with_twist", dem::RollingLaw::directional_with_twist},
                             {"spring_slider", dem::RollingLaw::spring_slider},
                             {"torsion_spring", dem::RollingLaw::torsion_spring}});
  bind_law<dem::CohesionLaw>(
      module, "CohesionLaw",
      {{"none", dem::CohesionLaw::none}, {"linear", dem::CohesionLaw::linear}, {"jkr", dem::CohesionLaw::jkr}});
}

void bind_materials(py::module_& module) {
  py::class_<Material>(module, "Material", "What grains are made of.")
      .def(py::init([](double density, double young, double poisson) {
             return Material{"grain", density, young, poisson};
           }),
           py::arg("density") = 2500.0, py::arg("young") = 1e7, py::arg("poisson") = 0.25)
      .def_readonly("density", &Material::density, "[kg/m^3], above 0")
      .def_readonly("young", &Material::young, "Young's modulus [Pa], above 0")
      .def_readonly("poisson", &Material::poisson, "Poisson's ratio [-], in (-1, 0.5]");
  py::class_<Interaction>(module, "Interaction", "What two materials do at a contact beyond their elastic constants.")
      .def(py::init([](double restitution, double sliding_friction, double rolling_friction, double cohesion) {
             Interaction out;
             out.restitution = restitution, out.sliding_friction = sliding_friction;
             out.rolling_friction = rolling_friction, out.cohesion = cohesion;
             return out;
           }),
           py::arg("restitution") = 0.5, py::arg("sliding_friction") = 0.5, py::arg("rolling_friction") = 0.0,
           py::arg("cohesion") = 0.0)
      .def_readwrite("restitution", &Interaction::restitution, "e [-], 0 .. 1")
      .def_readwrite("sliding_friction", &Interaction::sliding_friction, "mu [-], at least 0")
      .def_readwrite("rolling_friction", &Interaction::rolling_friction, "mu_r [-], at least 0")
      .def_readwrite("rolling_damping", &Interaction::rolling_damping,
                     "of elastic_plastic, share of critical; 0 until set, where a soil's grains have 0.3")
      .def_readwrite("rolling_stiffness", &Interaction::rolling_stiffness,
                     "spring_slider [N/m], torsion_spring [N m/rad]")
      .def_readwrite("cohesion", &Interaction::cohesion, "linear: [J/m^3]; jkr: work of adhesion [J/m^2]")
      .def_readwrite("normal_stiffness", &Interaction::normal_stiffness, "hooke [N/m]")
      .def_readwrite("shear_stiffness", &Interaction::shear_stiffness, "hooke [N/m]");
}

void bind_states(py::module_& module) {
  using dem::Contact;
  using dem::EnergyBalance;
  using dem::GrainNow;
  py::class_<GrainNow>(module, "GrainNow", "Motion of a grain at a whole step.")
      .def_property_readonly("position", array_in(&GrainNow::position), "shape (3,), [m]")
      .def_property_readonly("velocity", array_in(&GrainNow::velocity), "shape (3,), [m/s]")
      .def_property_readonly("spin", array_in(&GrainNow::spin), "shape (3,), [rad/s]")
      .def_readonly("radius", &GrainNow::radius, "[m]");
  py::class_<Contact>(module, "Contact", "A contact as it is now.")
      .def_readonly("first", &Contact::first, "id of a grain")
      .def_readonly("second", &Contact::second, "id of a grain, or -1 - index of a body")
      .def_readonly("overlap", &Contact::overlap, "[m]")
      .def_readonly("pressing", &Contact::pressing, "F_N [N]")
      .def_property_readonly("point", array_in(&Contact::point), "shape (3,), [m]")
      .def_property_readonly("normal", array_in(&Contact::normal), "shape (3,), toward `first`")
      .def_property_readonly("force", array_in(&Contact::force), "shape (3,), on `first` [N]")
      .def_property_readonly("couple", array_in(&Contact::couple), "shape (3,), on `first` [N m]");
  py::class_<EnergyBalance>(module, "EnergyBalance", "Where the energy is [J].")
      .def_readonly("kinetic", &EnergyBalance::kinetic)
      .def_readonly("potential", &EnergyBalance::potential)
      .def_readonly("elastic", &EnergyBalance::elastic, "of normal springs, cohesion included")
      .def_readonly("tangential", &EnergyBalance::tangential)
      .def_readonly("rolling", &EnergyBalance::rolling)
      .def_property_readonly(
          "damping", [](const EnergyBalance& e) { return e.ledger.damping; }, "lost in dashpots")
      .def_property_readonly(
          "into_slide", [](const EnergyBalance& e) { return e.ledger.into_slide; },
          "taken by tangential springs, dashpots and sliders")
      .def_property_readonly("into_roll", [](const EnergyBalance& e) { return e.ledger.into_roll; })
      .def_property_readonly("total", &EnergyBalance::total, "zero but for the error of the time step");
}

/// The simulation to look at: not while another thread has it at work.
const Simulation& seen(const Simulation& simulation) {
  refuse_at_work(&simulation, false);
  return simulation;
}

/// The simulation to change: not while it is at work.
Simulation& idle(Simulation& simulation) {
  refuse_at_work(&simulation, true);
  return simulation;
}

/// All grains in the order of their ids, a number or three of each.
py::array_t<double> each_grain(const Simulation& simulation, py::ssize_t width, const auto& of) {
  const std::vector<dem::GrainNow> now = seen(simulation).grains();
  const std::vector<dem::GrainId>& ids = simulation.state().grains.id;
  std::vector<std::size_t> row(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) row[i] = i;
  std::sort(row.begin(), row.end(), [&](std::size_t a, std::size_t b) { return ids[a] < ids[b]; });
  const auto count = static_cast<py::ssize_t>(row.size());
  py::array_t<double> out(width == 1 ? std::vector<py::ssize_t>{count} : std::vector<py::ssize_t>{count, width});
  double* to = out.mutable_data();
  for (const std::size_t i : row) of(now[i], to), to += width;
  return out;
}

void put(const Vec3& v, double* to) { to[0] = v.x, to[1] = v.y, to[2] = v.z; }

/// Eight parameters, since each is a keyword of Python's Simulation(...).
std::unique_ptr<Simulation> make_simulation(const Material& material, const Interaction& interaction, double dt,
                                            const Triple& gravity, dem::NormalLaw normal, dem::RollingLaw rolling,
                                            dem::CohesionLaw cohesion, int threads) {
  dem::Setup setup;
  setup.materials.add(material, interaction);
  setup.laws.normal = normal, setup.laws.rolling = rolling, setup.laws.cohesion = cohesion;
  setup.numerics.dt = dt, setup.numerics.threads = threads, setup.numerics.ledger = true;
  auto made = std::make_unique<Simulation>(setup);
  made->set_gravity(vec3_of(gravity));
  return made;
}

void run(Simulation& simulation, std::int64_t steps, const py::object& progress) {
  if (steps < 0) throw InputError("steps: 0 or more");
  const AtWork alone(&simulation);
  Watch watch(progress);
  unlocked([&] {
    for (std::int64_t done = 0; done < steps;) {
      const std::int64_t some = std::min(steps_between_looks, steps - done);
      simulation.run(some);
      done += some;
      watch(static_cast<double>(done) / static_cast<double>(steps));
    }
  });
}

}  // namespace

void bind_grains(py::module_& module) {
  bind_laws(module);
  bind_materials(module);
  bind_states(module);
  using dem::NormalLaw, dem::RollingLaw, dem::CohesionLaw;
  py::class_<Simulation>(
      module, "Simulation",
      "Spheres of one material and what they do to each other, step by step (docs/theory/dem-laws.md). One thread at a "
      "time: while it runs, other threads get a RuntimeError; its own progress may look at it.")
      .def(py::init(&make_simulation), py::arg("material"), py::arg("interaction"), py::arg("dt"),
           py::arg("gravity") = Triple{0, 0, 0}, py::arg("normal") = NormalLaw::hertz,
           py::arg("rolling") = RollingLaw::none, py::arg("cohesion") = CohesionLaw::none, py::arg("threads") = 1,
           "dt [s], gravity [m/s^2], threads 0: one a core or fewer (no number of them changes a bit). Raises "
           "InputError for what makes no sense.")
      .def(
          "add_grain",
          [](Simulation& s, const Triple& position, double radius, const Triple& velocity, const Triple& spin) {
            return idle(s).add_grain(vec3_of(position), radius, 0, vec3_of(velocity), vec3_of(spin));
          },
          py::arg("position"), py::arg("radius"), py::arg("velocity") = Triple{0, 0, 0},
          py::arg("spin") = Triple{0, 0, 0}, "[m], [m/s], [rad/s]; gives the grain's id.")
      .def(
          "add_plane",
          [](Simulation& s, const Triple& point, const Triple& normal) {
            dem::Body body;
            body.name = "plane";
            body.surfaces.push_back({dem::Plane{vec3_of(point), dem::unit(vec3_of(normal))}, 0});
            return idle(s).add_body(body);
          },
          py::arg("point"), py::arg("normal"), "A plane that stands still, grains on the side of its normal.")
      .def("run", &run, py::arg("steps"), py::arg("progress") = py::none(),
           "Raises RunStopped where an overlap is too deep or a grain is lost, InputError for a step that is too long.")
      .def_property_readonly(
          "time", [](const Simulation& s) { return seen(s).time(); }, "[s]")
      .def_property_readonly(
          "dt", [](const Simulation& s) { return s.setup().numerics.dt; }, "[s]")
      .def_property_readonly(
          "rayleigh_time",
          [](const Simulation& s) { return dem::rayleigh_time(seen(s).setup().materials, s.state().grains); },
          "smallest over all grains [s]; a step is at most a fifth of it")
      .def(
          "grain", [](const Simulation& s, dem::GrainId id) { return seen(s).grain(id); }, py::arg("id"))
      .def_property_readonly(
          "positions",
          [](const Simulation& s) { return each_grain(s, 3, [](const auto& g, double* to) { put(g.position, to); }); },
          "of all grains, in the order of their ids [m]; a copy: grains change their places in memory")
      .def_property_readonly(
          "velocities",
          [](const Simulation& s) { return each_grain(s, 3, [](const auto& g, double* to) { put(g.velocity, to); }); },
          "[m/s]; a copy")
      .def_property_readonly(
          "radii",
          [](const Simulation& s) { return each_grain(s, 1, [](const auto& g, double* to) { *to = g.radius; }); },
          "[m]; a copy")
      .def(
          "contacts", [](const Simulation& s) { return seen(s).contacts(); }, "All contacts now, in a fixed order.")
      .def(
          "energy", [](const Simulation& s) { return seen(s).energy(); }, "What is where; see EnergyBalance.");
}

}  // namespace soilbin::python
