// compare/vehicle: a vehicle on soil. Answers are the documents of the command's --json.
#include <optional>
#include <utility>
#include <variant>

#include "bekker_wong/model.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/telling/reports.hpp"
#include "compare/vehicle/vehicle_answers.hpp"
#include "compare/vehicle/vehicle_doubts.hpp"
#include "compare/vehicle/vehicle_measured.hpp"
#include "notebooks/bindings/fields.hpp"
#include "notebooks/bindings/scenario.hpp"
#include "scenario/csv.hpp"

namespace soilbin::python {
namespace {

using compare::Doubts;
using compare::VehicleAxle;
using compare::VehicleCase;

std::vector<compare::VehicleWheel> wheels_with_tires(const VehicleCase& vehicle) {
  if (vehicle.axles.empty()) throw InputError("the vehicle has no axles");
  for (std::size_t i = 0; i < vehicle.axles.size(); ++i)
    if (!(vehicle.axles[i].tire.radius > 0)) throw InputError(fmt::format("axles[{}] has no tire", i));
  const auto refuse = [](const std::string& wrong) {
    if (!wrong.empty()) throw InputError(wrong);
  };
  if (vehicle.motor) refuse(contradiction(*vehicle.motor));
  for (const VehicleAxle& axle : vehicle.axles)
    if (axle.motor) refuse(contradiction(*axle.motor));
  refuse(contradiction(vehicle));
  return wheels_of(vehicle);
}

compare::Report told(const auto& answers, const Doubts&) { return report_on(answers); }
compare::Report told(const compare::VehicleAnswers& answers, const Doubts& doubts) {
  return report_on(answers, not_decided(answers, doubts));
}

/// What `ask` answers of the wheels, with their tires as declared; and what is doubtful in it.
Document answered(const VehicleCase& question, const compare::TireLeftOut& left_out, const auto& ask) {
  return unlocked([&]() -> Document {
    std::vector<compare::VehicleWheel> wheels = wheels_with_tires(question);
    Doubts notes = declare_tires(wheels, left_out);
    const auto answers = ask(wheels, bekker_wong::BekkerWong({.errors = false, .patch = false}));
    const Doubts doubts = doubts_about(answers, std::move(notes));
    return {compare::json_text(told(answers, doubts).data()), compare::in_words(doubts)};
  });
}

Document vehicle_on_soil(const VehicleCase& question, int map_samples, bool rigid, bool no_lugs,
                         const py::object& progress) {
  Watch watch(progress);
  return answered(question, {.pressure = rigid, .lugs = no_lugs}, [&](const auto& wheels, const auto& model) {
    compare::VehicleAnswers answers = compare::answers_of(question, wheels, model);
    if (map_samples > 0)
      answers.map = compare::go_map(question, wheels, model, {.samples = map_samples, .progress = watch.of_steps()});
    return answers;
  });
}

Document turned_vehicle(const VehicleCase& question, std::optional<double> radius, std::optional<double> steer,
                        bool rigid, bool no_lugs) {
  if (radius && steer) throw InputError("give radius or steer, not both");
  return answered(question, {.pressure = rigid, .lugs = no_lugs}, [&](const auto& wheels, const auto& model) {
    return compare::turn_of(question, wheels, model, {radius, steer});
  });
}

Document beside_measured(const VehicleCase& question, const std::string& file, bool rigid, bool no_lugs) {
  return answered(question, {.pressure = rigid, .lugs = no_lugs}, [&](const auto& wheels, const auto& model) {
    return compare::beside_measured(question, wheels, model,
                                    compare::read_measured_vehicle(read_source_text(file, largest_csv)));
  });
}

Document driven(const VehicleCase& question, int samples, bool rigid, bool no_lugs, const py::object& progress) {
  if (samples < 1) throw InputError("samples: 1 or more");
  Watch watch(progress);
  return answered(question, {.pressure = rigid, .lugs = no_lugs}, [&](const auto& wheels, const auto& model) {
    return compare::driven_answers(question, wheels, model, samples,
                                   [&watch](double time, double duration) { watch(time / duration); });
  });
}

void bind_parts(py::module_& module) {
  bind_words<compare::DriveLine>(module, "DriveLine", "How the engine's rotation reaches the driven wheels.");
  bind_words<compare::Differential>(module, "Differential", "Whether two shafts that are driven together turn unlike.");
  bind_described<compare::VehiclePoint>(module, "VehiclePoint",
                                        "A point of the vehicle: x forward, y to the left, z up from the ground.");
  bind_described<TorquePoint>(module, "TorquePoint", "A point of a motor's torque curve.");
  bind_described<GearedMotor>(module, "GearedMotor", "A motor's largest torque against its speed, through its gear.");
  py::class_<VehicleAxle> axle(module, "VehicleAxle", "Two wheels beside each other, or one without a track.");
  axle.def_property(
      "tire", [](const VehicleAxle& a) { return a.tire; },
      [](VehicleAxle& a, const TireName& tire) { a.tire = tire_of(tire); },
      "a Tire, or its name in the library; assign another one to change it");
  described(axle, {"tire"});
  bind_described<compare::VehicleHitch>(module, "VehicleHitch", "Where what is pulled is hooked on.");
  bind_described<compare::VehicleCondition>(module, "VehicleCondition", "Where the vehicle is and what it is to do.");
  bind_described<compare::VehicleStop>(module, "VehicleStop", "A stop on the way, and the start from it.");
  bind_described<compare::VehicleDrive>(module, "VehicleDrive", "How the vehicle is driven in time, from rest.");
}

void bind_case(py::module_& module) {
  py::class_<VehicleCase> vehicle(module, "Vehicle", "A vehicle on a soil, in a condition (docs/guide/vehicle.md).");
  vehicle.def_readwrite("axles", &VehicleCase::axles, "VehicleAxle each; assign a new list to change them");
  vehicle.def_property(
      "soil", [](const VehicleCase& v) { return v.soil; },
      [](VehicleCase& v, const SoilName& soil) { v.soil = soil_of(soil); },
      "a Soil, or its name in the library; assign another one to change it");
  vehicle.def_property("effects", &effects_in<VehicleCase>, &set_effects<VehicleCase>, effects_meaning);
  vehicle.def_readwrite("drive", &VehicleCase::drive, "how drive_vehicle drives it");
  described(vehicle, {"axles", "soil", "effects", "drive"});
}

}  // namespace

void bind_vehicle(py::module_& module) {
  bind_parts(module);
  bind_case(module);
  module.def(
      "parse_vehicle",
      [](const std::string& text, const std::string& file) {
        return compare::parse_vehicle_case(make_source_text(text, file), cases_library(), effect_vocabulary());
      },
      py::arg("text"), py::arg("file") = "vehicle.yaml",
      "A vehicle from its YAML; `file` is what errors name. Raises InputError with line and column.");
  module.def(
      "find_vehicle",
      [](const std::string& name) { return compare::find_vehicle_case(name, cases_library(), effect_vocabulary()); },
      py::arg("name"), "A vehicle of the library, or of a YAML file. Raises InputError.");
  module.def("vehicle_on_soil", &vehicle_on_soil, py::arg("vehicle"), py::arg("map_samples"), py::arg("rigid"),
             py::arg("no_lugs"), py::arg("progress"), "Document and warnings; see soilbin.vehicle_on_soil.");
  module.def("turn_vehicle", &turned_vehicle, py::arg("vehicle"), py::arg("radius"), py::arg("steer"), py::arg("rigid"),
             py::arg("no_lugs"), "Document and warnings; see soilbin.turn_vehicle.");
  module.def("vehicle_beside_measured", &beside_measured, py::arg("vehicle"), py::arg("file"), py::arg("rigid"),
             py::arg("no_lugs"), "Document and warnings; see soilbin.vehicle_beside_measured.");
  module.def("drive_vehicle", &driven, py::arg("vehicle"), py::arg("samples"), py::arg("rigid"), py::arg("no_lugs"),
             py::arg("progress"), "Document and warnings; see soilbin.drive_vehicle.");
}

}  // namespace soilbin::python
