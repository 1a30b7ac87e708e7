// dem/rig: the virtual soil bin.
#include <fmt/core.h>

#include <algorithm>

#include "compare/experiments/soil_bin_runs.hpp"
#include "dem/rig/rig_settings.hpp"
#include "notebooks/bindings/vectors.hpp"
#include "scenario/case.hpp"
#include "scenario/errors.hpp"

namespace soilbin::python {
namespace {

using dem::DemSettings;
using dem::PowerBalance;
using dem::Rut;
using dem::SoilFlow;
using dem::WheelRun;
using dem::WheelSample;

/// A soil bin that keeps its beds between calls.
class SoilBin {
 public:
  explicit SoilBin(DemSettings settings) : settings_(watched(std::move(settings))), model_(settings_) {}

  WheelRun run(const Scenario& scenario, const OperatingCondition& at, const py::object& progress) {
    const AtWork alone(this);
    Watch watch(progress);
    WheelRun result;
    watch_ = &watch, result_ = &result;
    try {
      unlocked([&] { return model_.evaluate(scenario, at); });
    } catch (...) {
      watch_ = nullptr, result_ = nullptr;
      throw;
    }
    watch_ = nullptr, result_ = nullptr;
    return result;
  }

  compare::Inputs inputs(const Scenario& scenario) const { return compare::inputs_of(settings_, scenario); }

  /// Each condition of a case on each packing; what the file has isn't run again.
  compare::Record record(const Case& question, const std::filesystem::path& file, int packings,
                         const py::object& progress, bool half_step) const {
    if (packings < 1) throw InputError("packings: 1 or more");
    if (question.study.conditions.empty()) throw InputError("the case has no condition to run");
    const std::vector<compare::RunSpec> runs = compare::specs(question, settings_, packings, half_step);
    compare::check_runs(question, settings_);
    Watch watch(progress);
    std::size_t at_run = 0;
    DemSettings settings = settings_;
    settings.how.progress = [&](const dem::Progress& p) {
      watch((static_cast<double>(at_run) + std::min(p.done, 0.999)) / static_cast<double>(runs.size()),
            fmt::format("run {} of {}, {}", at_run + 1, runs.size(), p.stage));
    };
    const compare::RunKeeping keeping{.record = file, .version = SOILBIN_VERSION, .source = source_state()};
    unlocked([&] {
      compare::RunStore store = compare::store_of(settings, question, effect_vocabulary(), keeping);
      compare::SoilBinRuns bin(settings, keeping);
      for (; at_run < runs.size(); ++at_run) obtain(runs[at_run], question.scenario, store, bin);
    });
    return compare::read_record(file);
  }

 private:
  DemSettings watched(DemSettings settings) {
    settings.how.progress = [this](const dem::Progress& p) {
      if (watch_ != nullptr) (*watch_)(p.done, p.stage);
    };
    settings.on_run = [this](const WheelRun& run) { *result_ = run; };
    return settings;
  }

  Watch* watch_ = nullptr;
  WheelRun* result_ = nullptr;
  DemSettings settings_;
  dem::DemModel model_;
};

/// Calls on(keyword, number, meaning) for each number of the settings.
void each_keyword(DemSettings& settings, const auto& on) {
  on("settling_friction", settings.settling_friction, "share of friction while the bed settles, 0 (densest) .. 1");
  dem::each_setting(
      settings, [&](const std::string& key, double& number, const Measure& measure, auto, const char* meaning) {
        const std::string keyword = key == "time_step" ? "dt" : key.starts_with("bed_") ? key.substr(4) : key;
        on(keyword, number, fmt::format(fmt::runtime(meaning), number) + " [" + measure.unit + "]");
      });
}

/// Where settled beds are kept, if anywhere.
using Beds = std::optional<std::filesystem::path>;

DemSettings settings_of(const py::kwargs& numbers, std::uint64_t packing, const Beds& beds, bool ledger, int threads,
                        bool patch) {
  DemSettings out;
  for (const auto& [key, value] : numbers) {
    bool known = false;
    each_keyword(out, [&](const std::string& keyword, double& number, const std::string&) {
      if (key.cast<std::string>() == keyword) number = value.cast<double>(), known = true;
    });
    if (!known) throw py::type_error("SoilBin has no setting '" + key.cast<std::string>() + "'");
  }
  if (threads < 0) throw InputError("threads: 0 (one a core) or more");
  out.packing = packing, out.beds = beds.value_or(""), out.checkpoints.restart = out.beds;
  out.rig.ledger = ledger, out.how.threads = threads, out.rig.patch = patch;
  return out;
}

std::string settings_doc() {
  std::string doc =
      "packing: seed of the bed. beds: folder that keeps settled beds, and runs that are stopped, which then go on; "
      "None: neither is kept. ledger: tells where the power goes. threads: 0, one a core or fewer; changes no bit. "
      "patch: a moving patch: only the soil from behind to ahead of the axle, on a bed that repeats itself every "
      "length. By keywords:";
  DemSettings defaults;
  each_keyword(defaults, [&](const std::string& keyword, double&, const std::string& meaning) {
    doc += "\n  " + keyword + ": " + meaning;
  });
  return doc;
}

py::dict wheel_samples(const py::object& self) {
  const auto& rows = self.cast<const WheelRun&>().samples;
  const auto of = [&](double WheelSample::*member) { return column(rows, member, self); };
  return dict_of({{"time", of(&WheelSample::time)},
                  {"travel", of(&WheelSample::travel)},
                  {"sinkage", of(&WheelSample::sinkage)},
                  {"speed", of(&WheelSample::speed)},
                  {"heave", of(&WheelSample::heave)},
                  {"rotation", of(&WheelSample::rotation)},
                  {"into_soil", of(&WheelSample::into_soil)},
                  {"force", vectors(rows, &WheelSample::force, self)},
                  {"moment", vectors(rows, &WheelSample::moment, self)}});
}

void bind_powers_and_marks(py::module_& module) {
  py::class_<PowerBalance>(module, "PowerBalance", "Powers, means over the steady part [W].")
      .def_readonly("drive", &PowerBalance::drive, "M w")
      .def_readonly("pull", &PowerBalance::pull, "F_DP v")
      .def_readonly("climb", &PowerBalance::climb)
      .def_readonly("heave", &PowerBalance::heave)
      .def_readonly("into_soil", &PowerBalance::into_soil)
      .def_readonly("rest", &PowerBalance::rest, "drive less all these");
  const auto array = [](auto member) {
    return [member](const py::object& self) { return view(self.cast<const Rut&>().*member, self); };
  };
  py::class_<Rut>(module, "Rut", "Change of the bed's surface, seen from above. Arrays are views.")
      .def_property_readonly("y", array(&Rut::y), "from the middle of the track to the left, shape (ny,) [m]")
      .def_property_readonly("across", array(&Rut::across), "change of height at each y, shape (ny,) [m]")
      .def_property_readonly("x", array(&Rut::x), "along the bin, shape (nx,) [m]")
      .def_property_readonly("along", array(&Rut::along), "change of height at each x, shape (nx,) [m]")
      .def_readonly("axle", &Rut::axle, "where the axle stood at the end [m]")
      .def_readonly("volume", &Rut::volume, "[m^3] = heaped - dug")
      .def_readonly("heaped", &Rut::heaped, "[m^3]")
      .def_readonly("dug", &Rut::dug, "[m^3]");
  const auto grid = [](auto member) {
    return [member](const py::object& self) {
      const auto& flow = self.cast<const SoilFlow&>();
      return view(flow.*member, flow.nx, self);
    };
  };
  py::class_<SoilFlow>(module, "SoilFlow",
                       "Mean velocity of the soil round the wheel in its middle plane; grids of nz x nx, views.")
      .def_readonly("cell", &SoilFlow::cell, "side of a cell [m]")
      .def_readonly("nx", &SoilFlow::nx)
      .def_readonly("nz", &SoilFlow::nz)
      .def_readonly("x", &SoilFlow::x, "lower corner of the first cell, from the axle [m]")
      .def_readonly("z", &SoilFlow::z, "lower corner of the first cell, from the axle [m]")
      .def_property_readonly("vx", grid(&SoilFlow::vx), "forward [m/s]; NaN where no grain came")
      .def_property_readonly("vz", grid(&SoilFlow::vz), "upward [m/s]")
      .def_property_readonly("solid", grid(&SoilFlow::solid), "share of a cell that is grain [-]");
}

}  // namespace

void bind_run_parts(py::module_& module) {
  bind_powers_and_marks(module);
  py::class_<dem::PatchReport>(module, "PatchReport", "Of a run on a moving patch.")
      .def_readonly("grains", &dem::PatchReport::grains, "in it at once; 0: the bed stood still")
      .def_readonly("disturbed", &dem::PatchReport::disturbed,
                    "how far the soil at the front had moved when it was let go, largest mean of a slab [m]")
      .def_readonly("thrown", &dem::PatchReport::thrown, "grains that were thrown over its front end");
}

void bind_soil_bin(py::module_& module) {
  py::class_<WheelRun>(module, "WheelRun", "What a run of the soil bin tells.")
      .def_readonly("result", &WheelRun::result)
      .def_readonly("power", &WheelRun::power)
      .def_readonly("steady", &WheelRun::steady, "whether the run became steady (docs/theory/soil-bin.md)")
      .def_readonly("drift", &WheelRun::drift, "largest difference of halves over its standard error")
      .def_readonly("steady_from", &WheelRun::steady_from, "first sample that counts")
      .def_readonly("patch", &WheelRun::patch)
      .def_readonly("rut", &WheelRun::rut)
      .def_readonly("flow", &WheelRun::flow)
      .def_property_readonly("samples", &wheel_samples,
                             "arrays of one shape (samples,) from the start of the motion on, views: time [s], travel, "
                             "sinkage [m], force [N] and moment [N m] of the soil on the wheel (three columns), ...");
  py::class_<SoilBin>(module, "SoilBin",
                      "A virtual soil bin: a case's tire over a settled bed of its grains. Keeps its beds.")
      .def(py::init([](std::uint64_t packing, const Beds& beds, bool ledger, int threads, bool patch,
                       const py::kwargs& numbers) {
             return std::make_unique<SoilBin>(settings_of(numbers, packing, beds, ledger, threads, patch));
           }),
           py::arg("packing") = 1, py::arg("beds") = py::none(), py::arg("ledger") = false, py::arg("threads") = 0,
           py::arg("patch") = false, settings_doc().c_str())
      .def("run", &SoilBin::run, py::arg("scenario"), py::arg("at"), py::arg("progress") = py::none(),
           "One run. progress: called with (share done, stage). Raises InputError for a bed too small and for what "
           "grains can't do (effects, a second pass), NoSolution where the wheel digs itself in, RunStopped.")
      .def("record", &SoilBin::record, py::arg("case"), py::arg("file"), py::arg("packings") = 1,
           py::arg("progress") = py::none(), py::arg("half_step") = false,
           "Runs the conditions of a case's study, each on so many packings from the bin's on, and keeps each run in "
           "the file as it is finished; what is there isn't run again. half_step: first the hardest condition also at "
           "half the time step, as soilbin run --half-step yes does. Gives the record. What grains can't answer is a "
           "run with its error. Raises InputError for a file of other inputs, which it names, and RuntimeError where "
           "the half step's answer differs.")
      .def("inputs", &SoilBin::inputs, py::arg("scenario"),
           "Everything that a run follows from beside condition and packing, as names and values.");
}

}  // namespace soilbin::python
