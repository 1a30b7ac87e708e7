// bekker_wong/transient: a wheel driven in time.
#include "compare/drives/drive.hpp"

#include <limits>

#include "bekker_wong/transient/driving.hpp"
#include "notebooks/bindings/bindings.hpp"
#include "scenario/errors.hpp"

namespace soilbin::python {
namespace {

using bekker_wong::DriveRecord;
using bekker_wong::DriveSample;
using bekker_wong::EnergyLedger;

template <auto part>
const double& energy(const DriveSample& sample) {
  return sample.energy.*part;
}

py::array slip_of(const DriveRecord& record) {
  py::array_t<double> out(static_cast<py::ssize_t>(record.samples.size()));
  double* to = out.mutable_data();
  for (const DriveSample& sample : record.samples)
    *to++ = sample.slip.value_or(std::numeric_limits<double>::quiet_NaN());
  return out;
}

py::dict drive_samples(const py::object& self) {
  const auto& record = self.cast<const DriveRecord&>();
  const auto of = [&](auto member) { return column(record.samples, member, self); };
  return dict_of({{"time", of(&DriveSample::time)},
                  {"travelled", of(&DriveSample::travelled)},
                  {"speed", of(&DriveSample::speed)},
                  {"rim_speed", of(&DriveSample::rim_speed)},
                  {"slip", slip_of(record)},
                  {"contact_slip", of(&DriveSample::contact_slip)},
                  {"sinkage", of(&DriveSample::sinkage)},
                  {"torque", of(&DriveSample::torque)},
                  {"forward", of(&DriveSample::forward)},
                  {"lateral", of(&DriveSample::lateral)},
                  {"drawbar", of(&DriveSample::drawbar)},
                  {"longitudinal_incline", of(&DriveSample::longitudinal_incline)},
                  {"motor_work", of(&energy<&EnergyLedger::motor>)},
                  {"kinetic", of(&energy<&EnergyLedger::kinetic>)},
                  {"height", of(&energy<&EnergyLedger::height>)},
                  {"drawbar_work", of(&energy<&EnergyLedger::drawbar>)},
                  {"compaction", of(&energy<&EnergyLedger::compaction>)},
                  {"shear", of(&energy<&EnergyLedger::shear>)},
                  {"added", of(&energy<&EnergyLedger::added>)},
                  {"damping", of(&energy<&EnergyLedger::damping>)}});
}

void bind_record(py::module_& module) {
  py::class_<EnergyLedger>(module, "EnergyLedger", "Where the motor's work went, from the start [J].")
      .def_readonly("motor", &EnergyLedger::motor, "Int M w dt")
      .def_readonly("kinetic", &EnergyLedger::kinetic)
      .def_readonly("height", &EnergyLedger::height, "gained against the load")
      .def_readonly("drawbar", &EnergyLedger::drawbar)
      .def_readonly("compaction", &EnergyLedger::compaction, "pressing the soil")
      .def_readonly("shear", &EnergyLedger::shear, "shearing it")
      .def_readonly("added", &EnergyLedger::added, "against the effects' added forces")
      .def_readonly("damping", &EnergyLedger::damping)
      .def_property_readonly("unaccounted", &EnergyLedger::unaccounted, "the integration's error");
  py::class_<DriveHappening>(module, "DriveHappening", "What happened on the way: time [s], travelled [m], what.")
      .def_readonly("time", &DriveHappening::time)
      .def_readonly("travelled", &DriveHappening::travelled)
      .def_property_readonly("what", [](const DriveHappening& h) { return std::string(word_of(h.what)); });
  py::enum_<DriveEnd>(module, "DriveEnd", "Why a drive ended.")
      .value("time_is_up", DriveEnd::time_is_up)
      .value("arrived", DriveEnd::arrived, "at Drive.distance")
      .value("stuck", DriveEnd::stuck, "the mean speed has fallen below Drive.stuck_speed")
      .value("buried", DriveEnd::buried, "deeper than the model answers for")
      .value("rolled_back", DriveEnd::rolled_back, "by half a radius behind the start")
      .value("bed_ends", DriveEnd::bed_ends, "of the virtual soil bin alone")
      .value("tips_over", DriveEnd::tips_over, "of a vehicle alone: one axle carries all of it");
  py::class_<DriveRecord>(module, "DriveRecord", "What came of a drive.")
      .def_readonly("end", &DriveRecord::end, "why it ended")
      .def_readonly("end_time", &DriveRecord::end_time, "[s]")
      .def_readonly("happenings", &DriveRecord::happenings)
      .def_property_readonly(
          "energy", [](const DriveRecord& r) { return r.samples.back().energy; }, "at the end")
      .def_property_readonly("samples", &drive_samples,
                             "arrays of one shape (samples,), SI and radians, views but for slip (NaN while the wheel "
                             "all but stands); works in J since the start");
}

}  // namespace

void bind_drive(py::module_& module) {
  bind_record(module);
  module.def(
      "drive_wheel",
      [](const Scenario& scenario, const Drive& drive, int samples, const py::object& progress) {
        if (samples < 1) throw InputError("samples: 1 or more");
        Watch watch(progress);
        return unlocked([&] {
          return bekker_wong::drive_wheel(scenario, drive, samples, {},
                                          [&watch](double time, double duration) { watch(time / duration); });
        });
      },
      py::arg("scenario"), py::arg("drive"), py::arg("samples") = 400, py::arg("progress") = py::none(),
      "soilbin.bekker_wong.drive_wheel tells the arguments.");
}

}  // namespace soilbin::python
