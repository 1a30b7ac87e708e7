// A wheel as a unit of FMI 2.0: compiled, loaded and driven by a small importer. Steady it is its table; in time it is
// soilbin's own drive of that wheel; what it can't answer it says.
#include "compare/export/wheel_fmu.hpp"

#include <dlfcn.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <cstdarg>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>

#include "bekker_wong/transient/driving.hpp"
#include "compare/rover_fixture.hpp"
#include "compare/telling/reports.hpp"
#include "scenario/errors.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin::compare {
namespace {

using testing::AllOf;
using testing::HasSubstr;

Case rover_grid() {
  Case question = rover_on_dry_sand();
  for (const double load : {50.0, 65.0, 80.0})
    for (int percent = 0; percent <= 90; percent += 2)
      question.study.conditions.push_back({.load = load, .slip = percent / 100.0});
  return question;
}

const WheelFmu& rover_fmu() {
  static const WheelFmu fmu = wheel_fmu(force_table(rover_grid()), {.name = "rover", .version = "1"});
  return fmu;
}

enum Status { ok, warning, discard, error };
constexpr int co_simulation = 1;

/// What the unit said last.
std::string& last_message() {
  static std::string message;
  return message;
}

void keep_message(void*, const char*, int, const char* category, const char* format, ...) {
  std::va_list values;
  va_start(values, format);
  char text[1024];
  std::vsnprintf(text, sizeof text, format, values);
  va_end(values);
  last_message() = std::string(category) + ": " + text;
}

struct Callbacks {
  void (*logger)(void*, const char*, int, const char*, const char*, ...) = keep_message;
  void* (*allocate)(std::size_t, std::size_t) = nullptr;
  void (*free)(void*) = nullptr;
  void (*step_finished)(void*, int) = nullptr;
  void* environment = nullptr;
};

/// A unit's library, compiled and loaded.
class LoadedUnit {
 public:
  explicit LoadedUnit(const WheelFmu& fmu) : fmu_(fmu) {
    const CompiledC compiled = compiled_by_cc(files_in_c(fmu), fmu.name + ".c");
    EXPECT_TRUE(compiled.library) << compiled.why_not;
    const std::filesystem::path file =  // a name that was never loaded before
        std::filesystem::temp_directory_path() / ("soilbin-" + fmu.name + "-" + std::to_string(::getpid()) + ".so");
    std::ofstream(file, std::ios::binary) << compiled.library.value_or("");
    library_ = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    EXPECT_NE(library_, nullptr) << ::dlerror();
    std::filesystem::remove(file);
  }
  LoadedUnit(const LoadedUnit&) = delete;
  LoadedUnit& operator=(const LoadedUnit&) = delete;
  ~LoadedUnit() {
    if (library_ != nullptr) ::dlclose(library_);
  }

  template <class Result, class... Arguments>
  Result call(const char* name, Arguments... arguments) const {
    auto* function = reinterpret_cast<Result (*)(Arguments...)>(::dlsym(library_, name));
    if (function == nullptr) throw std::runtime_error(name);
    return function(arguments...);
  }
  unsigned reference(const std::string& name) const {
    if (name == "spin_is_given") return static_cast<unsigned>(fmu_.variables.size());
    if (name == "outside") return static_cast<unsigned>(fmu_.variables.size() + 1);
    return static_cast<unsigned>(std::ranges::find(fmu_.variables, name, &FmuVariable::name) - fmu_.variables.begin());
  }
  void* instantiate(int type, const std::string& guid) const {
    return call<void*>("fmi2Instantiate", "wheel", type, guid.c_str(), "file:///nowhere",
                       static_cast<const Callbacks*>(&callbacks_), 0, 0);
  }

 private:
  const WheelFmu& fmu_;
  void* library_ = nullptr;
  Callbacks callbacks_;
};

const LoadedUnit& rover_unit() {
  static const LoadedUnit unit(rover_fmu());
  return unit;
}

/// One wheel of the unit, on its way.
class RunningWheel {
 public:
  explicit RunningWheel(bool spin_is_given, const LoadedUnit& unit = rover_unit(),
                        const std::string& guid = rover_fmu().guid)
      : unit_(unit), wheel_(unit.instantiate(co_simulation, guid)) {
    const unsigned flag = unit_.reference("spin_is_given");
    const int given = spin_is_given ? 1 : 0;
    EXPECT_EQ(unit_.call<int>("fmi2SetupExperiment", wheel_, 0, 0.0, 0.0, 1, 10.0), ok);
    EXPECT_EQ(unit_.call<int>("fmi2SetBoolean", wheel_, &flag, std::size_t{1}, &given), ok);
  }
  RunningWheel(const RunningWheel&) = delete;
  RunningWheel& operator=(const RunningWheel&) = delete;
  ~RunningWheel() { unit_.call<void>("fmi2FreeInstance", wheel_); }

  void begin() {
    EXPECT_EQ(unit_.call<int>("fmi2EnterInitializationMode", wheel_), ok);
    EXPECT_EQ(unit_.call<int>("fmi2ExitInitializationMode", wheel_), ok) << last_message();
  }
  int set(const std::string& name, double value) {
    const unsigned reference = unit_.reference(name);
    return unit_.call<int>("fmi2SetReal", wheel_, &reference, std::size_t{1}, &value);
  }
  double get(const std::string& name) {
    const unsigned reference = unit_.reference(name);
    double value = 0.0;
    EXPECT_EQ(unit_.call<int>("fmi2GetReal", wheel_, &reference, std::size_t{1}, &value), ok);
    return value;
  }
  int outside() {
    const unsigned reference = unit_.reference("outside");
    int value = -1;
    EXPECT_EQ(unit_.call<int>("fmi2GetInteger", wheel_, &reference, std::size_t{1}, &value), ok);
    return value;
  }
  int step(double by) {
    const int status = unit_.call<int>("fmi2DoStep", wheel_, time_, by, 1);
    if (status <= warning) time_ += by;
    return status;
  }
  double time() const { return time_; }
  void* handle() const { return wheel_; }

 private:
  const LoadedUnit& unit_;
  void* wheel_;
  double time_ = 0.0;
};

LookedUp rover_table(double load, double slip) { return look_up(rover_fmu().table, {load, slip}).value(); }

/// Slip at which the table pulls so much, by bisection.
double slip_of_pull(double load, double pull) {
  double low = 0.0, high = 0.9;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (rover_table(load, middle).values[0] < pull ? low : high) = middle;
  }
  return low;
}

TEST(WheelFmu, EndsSteadyWhereItsTablePullsTheDrawbarLoad) {
  for (const double drawbar : {0.0, 2.0}) {
    RunningWheel wheel(true);
    wheel.set("load", 65.0), wheel.set("drawbar_load", drawbar), wheel.set("given_spin", 1.5);
    wheel.begin();
    for (int i = 0; i < 1000; ++i) ASSERT_EQ(wheel.step(0.01), ok) << last_message();
    const double slip = slip_of_pull(65.0, drawbar);
    EXPECT_NEAR(wheel.get("slip"), slip, 1e-6);
    EXPECT_NEAR(wheel.get("contact_slip"), slip, 1e-6);
    EXPECT_NEAR(wheel.get("speed"), 1.5 * 0.09 * (1 - slip), 1e-6);
    EXPECT_NEAR(wheel.get("torque"), rover_table(65.0, slip).values[1], 1e-6);
    EXPECT_NEAR(wheel.get("sinkage"), rover_table(65.0, slip).values[2], 1e-8);
    EXPECT_NEAR(wheel.get("drawbar_pull_std_error"), rover_table(65.0, slip).std_errors[0], 1e-5);
  }
}

// Motor torque that the table takes at a slip: there the wheel holds its speed, whatever that is.
TEST(WheelFmu, HoldsItsSpeedUnderTheTorqueOfItsSlip) {
  const double slip = slip_of_pull(65.0, 2.0), torque = rover_table(65.0, slip).values[1];
  RunningWheel wheel(false);
  wheel.set("load", 65.0), wheel.set("drawbar_load", 2.0), wheel.set("motor_torque", torque + 0.2);
  wheel.begin();
  while (wheel.get("speed") < 0.1) ASSERT_EQ(wheel.step(0.01), ok) << last_message();
  wheel.set("motor_torque", torque);
  for (int i = 0; i < 500; ++i) wheel.step(0.01);
  const double speed = wheel.get("speed");
  for (int i = 0; i < 500; ++i) wheel.step(0.01);
  EXPECT_NEAR(wheel.get("speed"), speed, 1e-5 * speed);
  EXPECT_NEAR(wheel.get("slip"), slip, 1e-5);
}

TEST(WheelFmu, StaysAtRestWhereNothingPushesIt) {
  RunningWheel wheel(false);
  wheel.begin();
  for (int i = 0; i < 100; ++i) ASSERT_EQ(wheel.step(0.1), ok);
  for (const char* name : {"travelled", "speed", "spin", "slip", "drawbar_pull", "torque", "power"})
    EXPECT_EQ(wheel.get(name), 0.0) << name;
}

// A heavy wheel pulls even without slip, by a torque; standing, it has neither.
TEST(WheelFmu, StaysAtRestWhereItsTablePullsWithoutSlip) {
  const Library library({SOILBIN_SOURCE_DIR "/cases"});
  Case question = rover_grid();
  question.scenario.tire = find_tire("truck-335-65r22", library);
  question.scenario.soil = find_soil("sandy-loam", library);
  for (OperatingCondition& at : question.study.conditions) at.load *= 400.0;  // 20 to 32 kN
  const WheelFmu fmu = wheel_fmu(force_table(std::move(question)), {.name = "truck", .version = "1"});
  ASSERT_GT(look_up(fmu.table, {26e3, 0.0}).value().values[0], 0.0);
  const LoadedUnit unit(fmu);
  RunningWheel wheel(false, unit, fmu.guid);
  wheel.begin();
  for (int i = 0; i < 100; ++i) ASSERT_EQ(wheel.step(0.1), ok) << last_message();
  EXPECT_NEAR(wheel.get("travelled"), 0.0, 1e-9);
  EXPECT_NEAR(wheel.get("drawbar_pull"), 0.0, 1e-6);
}

// Newton's second law over the way, from outputs at small steps; and the motor's work is what travel, spin and drawbar
// have, and what soil took, which is above 0.
TEST(WheelFmu, KeepsMomentumAndEnergy) {
  RunningWheel wheel(false);
  wheel.set("load", 65.0), wheel.set("drawbar_load", 1.0), wheel.set("motor_torque", 2.4);
  wheel.begin();
  const double mass = wheel.get("mass"), inertia = wheel.get("inertia"), h = 0.001;
  double impulse = 0.0, angular = 0.0, motor = 0.0, drawn = 0.0, soil = 0.0;
  const auto add = [&](double share) {
    const double pull = wheel.get("drawbar_pull"), torque = wheel.get("torque"), v = wheel.get("speed"),
                 w = wheel.get("spin");
    impulse += share * h * (pull - 1.0), angular += share * h * (2.4 - torque);
    motor += share * h * wheel.get("power"), drawn += share * h * v, soil += share * h * (torque * w - pull * v);
  };
  add(0.5);
  for (int i = 0; i < 3000; ++i) {
    ASSERT_EQ(wheel.step(h), ok) << last_message();
    add(i == 2999 ? 0.5 : 1.0);
  }
  const double v = wheel.get("speed"), w = wheel.get("spin");
  EXPECT_NEAR(impulse, mass * v, 1e-4 * mass * v);
  EXPECT_NEAR(angular, inertia * w, 1e-3 * inertia * w);
  EXPECT_NEAR(motor, 0.5 * mass * v * v + 0.5 * inertia * w * w + drawn + soil, 1e-3 * motor);
  EXPECT_GT(soil, 0.0);
}

TEST(WheelFmu, DoesNotDependOnTheStepsOfItsMaster) {
  double ends[2];
  for (int k = 0; k < 2; ++k) {
    RunningWheel wheel(false);
    wheel.set("load", 65.0), wheel.set("drawbar_load", 1.0), wheel.set("motor_torque", 2.0);
    wheel.begin();
    const double h = k == 0 ? 0.5 : 0.002;
    while (wheel.time() < 5.0 - 1e-9) ASSERT_LE(wheel.step(h), warning) << last_message();
    ends[k] = wheel.get("travelled");
  }
  EXPECT_NEAR(ends[0], ends[1], 1e-4 * ends[1]);
}

/// The analytic wheel's own drive, and the unit with what its motor does. They part in the first second, where the
/// shear displacement of the drive grows from the entry and the unit has one slip for the whole contact; then they have
/// the same slip.
void compare_with_drive(const Drive& drive, bool spin_is_given, double of_way, double of_slip) {
  const Case question = rover_grid();
  const int samples = 1000;
  const bekker_wong::DriveRecord record = bekker_wong::drive_wheel(question.scenario, drive, samples);
  ASSERT_EQ(record.end, DriveEnd::time_is_up);
  RunningWheel wheel(spin_is_given);
  wheel.set("load", drive.load), wheel.set("drawbar_load", drive.profile.front().drawbar);
  wheel.set("mass", mass_of(drive, gravity_of(question.scenario.soil)));
  wheel.begin();
  const double radius = question.scenario.tire.radius;
  for (int i = 1; i <= samples; ++i) {
    const DriveState &before = record.samples[static_cast<std::size_t>(i - 1)],
                     &after = record.samples[static_cast<std::size_t>(i)];
    wheel.set("given_spin", 0.5 * (before.rim_speed + after.rim_speed) / radius);
    wheel.set("motor_torque", 0.5 * (before.torque + after.torque));
    ASSERT_LE(wheel.step(after.time - before.time), warning) << last_message();
  }
  const DriveState& end = record.samples.back();
  EXPECT_NEAR(wheel.get("travelled"), end.travelled, of_way * end.travelled);
  EXPECT_NEAR(wheel.get("slip"), end.slip.value(), of_slip);
  EXPECT_NEAR(wheel.get("sinkage"), end.sinkage, 1e-3 * end.sinkage);
}

TEST(WheelFmu, TravelsAsTheDriveOfAMotorThatHoldsASpeed) {
  Drive drive{.load = 65.0, .duration = 10.0};
  drive.controller.rim_speed = 0.1;
  drive.profile = {{.at = 0.0, .drawbar = 2.0}};
  compare_with_drive(drive, true, 0.015, 5e-4);
}

TEST(WheelFmu, TravelsAsTheDriveOfATorque) {
  Drive drive{.load = 65.0, .duration = 10.0};
  drive.controller.torque = 1.9;
  drive.profile = {{.at = 0.0, .drawbar = 1.0}};
  compare_with_drive(drive, false, 0.02, 5e-4);
}

TEST(WheelFmu, WarnsOutsideItsTableAndUsesItsEdge) {
  RunningWheel wheel(true);
  wheel.set("load", 65.0), wheel.set("given_spin", 1.0);
  wheel.begin();
  for (int i = 0; i < 500; ++i) ASSERT_EQ(wheel.step(0.01), ok);
  EXPECT_EQ(wheel.outside(), 0);
  wheel.set("load", 1000.0);
  for (int i = 0; i < 500; ++i) ASSERT_EQ(wheel.step(0.01), warning);
  EXPECT_THAT(last_message(), AllOf(HasSubstr("logStatusWarning"), HasSubstr("outside the table"),
                                    HasSubstr("load not within 50 .. 80")));
  EXPECT_EQ(wheel.outside(), 1);
  EXPECT_NEAR(wheel.get("slip"), slip_of_pull(80.0, 0.0), 1e-5);
  wheel.set("load", 65.0);
  EXPECT_EQ(wheel.step(0.01), ok);
  wheel.set("drawbar_load", 60.0);  // more than it pulls at any slip: it is dragged back
  int status = ok;
  for (int i = 0; i < 200; ++i) status = wheel.step(0.01);
  EXPECT_EQ(status, warning);
  EXPECT_THAT(last_message(), AllOf(HasSubstr("slip not within 0 .. 0.9"), HasSubstr("rolls backward")));
}

TEST(WheelFmu, StopsWhereItsTableHasNoAnswer) {
  Case question = rover_grid();
  std::erase_if(question.study.conditions, [](const OperatingCondition& at) { return at.load == 80.0; });
  for (int percent = 0; percent <= 90; percent += 2)
    question.study.conditions.push_back({.load = 2000.0, .slip = percent / 100.0});
  const WheelFmu fmu = wheel_fmu(force_table(std::move(question)), {.name = "gap", .version = "1"});
  ASSERT_GT(fmu.table.without_answer, 0U);
  const LoadedUnit unit(fmu);
  RunningWheel wheel(true, unit, fmu.guid);
  wheel.set("load", 65.0), wheel.set("given_spin", 1.0);
  wheel.begin();
  ASSERT_EQ(wheel.step(1.0), ok);
  const double travelled = wheel.get("travelled");
  wheel.set("load", 500.0);
  EXPECT_EQ(wheel.step(1.0), error);
  EXPECT_THAT(last_message(), AllOf(HasSubstr("no answer"), HasSubstr("load 500")));
  EXPECT_EQ(wheel.get("travelled"), travelled);
  wheel.set("load", 65.0);
  EXPECT_EQ(wheel.step(1.0), ok) << "it stayed as it was, and goes on";
}

TEST(WheelFmu, GoesBackToAStateThatWasKept) {
  const LoadedUnit& unit = rover_unit();
  RunningWheel wheel(false);
  wheel.set("motor_torque", 2.5);
  wheel.begin();
  wheel.step(1.0);
  void* kept = nullptr;
  std::size_t size = 0;
  ASSERT_EQ(unit.call<int>("fmi2GetFMUstate", wheel.handle(), &kept), ok);
  ASSERT_EQ(unit.call<int>("fmi2SerializedFMUstateSize", wheel.handle(), kept, &size), ok);
  std::string bytes(size, '\0');
  ASSERT_EQ(unit.call<int>("fmi2SerializeFMUstate", wheel.handle(), kept, bytes.data(), size), ok);
  wheel.step(0.5);
  const double first = wheel.get("travelled");
  ASSERT_EQ(unit.call<int>("fmi2FreeFMUstate", wheel.handle(), &kept), ok);
  ASSERT_EQ(
      unit.call<int>("fmi2DeSerializeFMUstate", wheel.handle(), static_cast<const char*>(bytes.data()), size, &kept),
      ok);
  ASSERT_EQ(unit.call<int>("fmi2SetFMUstate", wheel.handle(), kept), ok);
  unit.call<int>("fmi2FreeFMUstate", wheel.handle(), &kept);
  wheel.step(0.5);
  EXPECT_EQ(wheel.get("travelled"), first);
  EXPECT_EQ(unit.call<int>("fmi2Terminate", wheel.handle()), ok);
  EXPECT_EQ(wheel.step(0.5), error);
  EXPECT_THAT(last_message(), HasSubstr("fmi2DoStep is not allowed now"));
  EXPECT_EQ(unit.call<int>("fmi2Reset", wheel.handle()), ok);
  wheel.begin();
  EXPECT_EQ(wheel.get("travelled"), 0.0);
}

TEST(WheelFmu, RefusesWhatItIsNotMadeFor) {
  const LoadedUnit& unit = rover_unit();
  constexpr int model_exchange = 0;
  EXPECT_EQ(unit.instantiate(co_simulation, "{another}"), nullptr);
  EXPECT_THAT(last_message(), HasSubstr("GUID"));
  EXPECT_EQ(unit.instantiate(model_exchange, rover_fmu().guid), nullptr);
  EXPECT_EQ(std::string(unit.call<const char*>("fmi2GetVersion")), "2.0");
  RunningWheel wheel(false);
  EXPECT_EQ(wheel.set("speed", 1.0), error);
  EXPECT_EQ(wheel.set("load", not_a_number), error);
  wheel.begin();
  EXPECT_EQ(wheel.set("mass", 1.0), error);
  EXPECT_THAT(last_message(), HasSubstr("a parameter is fixed by now"));
}

/// Values of an attribute, in order.
std::vector<std::string> attributes(const std::string& xml, const std::string& element, const std::string& name) {
  std::vector<std::string> found;
  const std::regex pattern("<" + element + " [^>]*?\\b" + name + "=\"([^\"]*)\"");
  for (std::sregex_iterator at(xml.begin(), xml.end(), pattern), end; at != end; ++at) found.push_back((*at)[1]);
  return found;
}

// Section 2.2 of the standard. The schema itself is checked where it lies at hand; this is what it can't say, too.
TEST(WheelFmu, DescribesItselfAsTheStandardAsks) {
  const WheelFmu& fmu = rover_fmu();
  const std::string& xml = fmu.description;
  EXPECT_THAT(attributes(xml, "fmiModelDescription", "fmiVersion"), testing::ElementsAre("2.0"));
  EXPECT_THAT(attributes(xml, "fmiModelDescription", "guid"), testing::ElementsAre(fmu.guid));
  EXPECT_THAT(fmu.source, HasSubstr("#define FMU_GUID \"" + fmu.guid + "\""));
  EXPECT_THAT(fmu.guid, testing::MatchesRegex("\\{[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}\\}"));
  EXPECT_THAT(attributes(xml, "CoSimulation", "modelIdentifier"), testing::ElementsAre("rover"));
  EXPECT_THAT(attributes(xml, "File", "name"), testing::ElementsAre("rover.c"));
  const std::vector<std::string> names = attributes(xml, "ScalarVariable", "name"),
                                 references = attributes(xml, "ScalarVariable", "valueReference"),
                                 causality = attributes(xml, "ScalarVariable", "causality");
  EXPECT_EQ(std::set(names.begin(), names.end()).size(), names.size());
  EXPECT_EQ(std::set(references.begin(), references.end()).size(), references.size());
  std::vector<std::string> outputs;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (causality[i] == "output") outputs.push_back(std::to_string(i + 1));
  std::vector<std::string> listed = outputs;
  listed.insert(listed.end(), outputs.begin(), outputs.end());
  EXPECT_EQ(attributes(xml, "Unknown", "index"), listed) << "each in Outputs, and in InitialUnknowns";
  const std::vector<std::string> units = attributes(xml, "Unit", "name");
  for (const std::string& unit : attributes(xml, "Real", "unit")) EXPECT_THAT(units, testing::Contains(unit));
  EXPECT_EQ(attributes(xml, "Real", "start").size() + 1 + outputs.size(), names.size())
      << "each input and parameter has a start; spin_is_given has it as a Boolean";
}

TEST(WheelFmu, HasAGuidOfWhatIsInIt) {
  const WheelFmu again = wheel_fmu(force_table(rover_grid()), {.name = "rover", .version = "1"});
  EXPECT_EQ(again.guid, rover_fmu().guid);
  EXPECT_EQ(packed_fmu(again, std::nullopt, "case"), packed_fmu(rover_fmu(), std::nullopt, "case"));
  Case firmer = rover_grid();
  firmer.scenario.soil.semi_empirical->cohesion.value += 1.0;
  EXPECT_NE(wheel_fmu(force_table(firmer), {.name = "rover", .version = "1"}).guid, again.guid);
}

TEST(WheelFmu, IsItsSourceWhereThereIsNoCompiler) {
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", "/nowhere", 1);
  const CompiledC compiled = compiled_by_cc(files_in_c(rover_fmu()), "rover.c");
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_FALSE(compiled.library);
  EXPECT_THAT(text_of(report_on(rover_fmu(), compiled)),
              AllOf(HasSubstr("Not compiled"), HasSubstr("there is no compiler 'cc' here"), HasSubstr("motor_torque")));
  const char* const temporary = std::getenv("TMPDIR");
  const std::string folder = temporary == nullptr ? "" : temporary;
  ::setenv("TMPDIR", "/nowhere", 1);
  EXPECT_THAT(compiled_by_cc(files_in_c(rover_fmu()), "rover.c").why_not, HasSubstr("TMPDIR"));
  temporary == nullptr ? ::unsetenv("TMPDIR") : ::setenv("TMPDIR", folder.c_str(), 1);
  EXPECT_THAT(compiled_by_cc({{"a.c", "no C"}}, "a.c").why_not, HasSubstr("'cc' failed with status 1"));
}

TEST(WheelFmu, NeedsSlipsFromRestOn) {
  const auto refusal = [](Case question) -> std::string {
    return soilbin::test::error_of(
        [&] { wheel_fmu(force_table(std::move(question)), {.name = "rover", .version = "1"}); });
  };
  Case question = rover_grid();
  for (OperatingCondition& at : question.study.conditions) at.force_frame = ForceFrame::wheel;
  EXPECT_THAT(refusal(question), HasSubstr("along its travel"));
  question = rover_grid();
  std::erase_if(question.study.conditions, [](const OperatingCondition& at) { return at.slip < 0.01; });
  EXPECT_THAT(refusal(question), AllOf(HasSubstr("begin at 0 %"), HasSubstr("hint")));
  std::erase_if(question.study.conditions, [](const OperatingCondition& at) { return at.slip > 0.03; });
  EXPECT_THAT(refusal(question), HasSubstr("runs over slip"));
}

}  // namespace
}  // namespace soilbin::compare
