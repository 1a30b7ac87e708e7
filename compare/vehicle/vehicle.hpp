// A vehicle as the soil meets it, and its file, soilbin-vehicle-case/1 (docs/guide/vehicle.md): axles with their tires,
// mass and where it is, drive line, hitch; on a soil, in a condition.
//
//   const VehicleCase truck = parse_vehicle_case(source, library, effects);
//   for (const VehicleWheel& wheel : wheels_of(truck)) fmt::print("{} at {:.2f} m\n", wheel.name, wheel.place.x);
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "compare/doubts/declared_tire.hpp"
#include "scenario/case.hpp"
#include "scenario/geared_motor.hpp"
#include "scenario/yes_no.hpp"

namespace soilbin::compare {

/// A point of the vehicle [m]: x forward, y to the left, z up from the plane below all wheels, where its tread bases
/// touch hard level ground.
struct VehiclePoint {
  double x = 0.0, y = 0.0, z = 0.0;
};

inline constexpr double in_one_place = 1e-9;  ///< [m] points that lie closer differ by rounding

/// How the engine's rotation reaches the driven wheels.
enum class DriveLine {
  locked,      ///< every driven wheel has the same rim speed, but for its axle's lead
  open_axles,  ///< the axles have the same mean rim speed; across an axle the torque is the same
  sides,       ///< the driven wheels of a side turn together; both sides alike straight on, unlike in a turn
  motors,      ///< a motor a wheel: one rim speed is asked of all, and each gives no more than its axle says
};

constexpr std::array<Word<DriveLine>, 4> words_of(std::type_identity<DriveLine>) {
  return {{{"locked", DriveLine::locked},
           {"open_axles", DriveLine::open_axles},
           {"sides", DriveLine::sides},
           {"motors", DriveLine::motors}}};
}

/// Why a drive line has no differentials; empty where it has.
std::string without_differentials(DriveLine line);

/// Whether two shafts that are driven together may turn unlike.
enum class Differential {
  locked,  ///< both have one speed
  open,    ///< one mean speed; the torque is shared
};

constexpr std::array<Word<Differential>, 2> words_of(std::type_identity<Differential>) {
  return {{{"locked", Differential::locked}, {"open", Differential::open}}};
}

/// Two wheels beside each other, or one.
struct VehicleAxle {
  std::string name{};
  double x = 0.0;                         ///< [m]
  double y = 0.0;                         ///< of its middle [m]
  std::optional<double> track{};          ///< between the middles of its two wheels [m], > 0; absent: it has one wheel
  YesNo driven = YesNo::yes;              ///< no: its wheels roll freely
  YesNo steered = YesNo::no;              ///< whether it may be turned to keep the vehicle on its line
  std::optional<double> largest_steer{};  ///< of its middle to either side [rad], > 0; absent: nothing stops it
  double lead = 0.0;                      ///< its rim speed over that of the drive line, less 1 [-], > -1
  std::optional<Differential> differential{};  ///< between its two wheels; absent: as the drive line has it
  std::optional<double> torque_share{};        ///< of an open centre differential, beside that of the other axle [-],
                                               ///< > 0; absent: 1
  std::optional<double> largest_torque{};      ///< of a wheel's motor [N m], > 0
  std::optional<GearedMotor> motor{};  ///< of each of its wheels; its gear ratio is over that wheel's revolutions
  std::optional<double> stiffness{};   ///< of a wheel's suspension and tire [N/m], > 0; absent: all are alike
  std::optional<double> inertia{};     ///< of a wheel and what spins with it [kg m^2], > 0; absent: a tenth of
                                       ///< the mass that it carries, times its radius squared
  Tire tire{};
};

inline bool is_steered(const VehicleAxle& axle) { return axle.steered == YesNo::yes; }

/// Where what is pulled is hooked on.
struct VehicleHitch {
  VehiclePoint at{};
  double angle = 0.0;  ///< of the pull below the ground's plane [rad]: positive presses the vehicle down
};

/// Where the vehicle is and what it is to do.
struct VehicleCondition {
  double slope = 0.0;        ///< [rad], uphill along its travel positive
  double cross_slope = 0.0;  ///< [rad], left side up positive
  double speed = 1.0;        ///< of travel [m/s], > 0
  double pull = 0.0;         ///< of the drawbar [N]: what the vehicle pulls behind it
  double curvature = 0.0;    ///< of the path of its centre of gravity [1/m], to the left positive; of no file
  bool on_the_spot = false;  ///< it turns to the left by its sides, one against the other: `speed` is that of its
                             ///< wheels along their planes, of no file
};

/// A stop on the way, and the start from it.
struct VehicleStop {
  double at = 0.0;     ///< it begins to brake by its drive line [s]
  double lasts = 3.0;  ///< between the ramps [s]
};

/// How the vehicle is driven in time, from rest: `drive` of a wheel's case, for the whole.
struct VehicleDrive {
  double duration = 30.0;               ///< [s]
  std::optional<double> distance{};     ///< it has arrived there [m]
  double damping = 0.2;                 ///< share of critical damping, of the soil under heave and of shear at rest [-]
  std::optional<double> stuck_speed{};  ///< mean speed of travel below which it is stuck [m/s]; absent: a hundredth
                                        ///< of the speed that is held, or 0.5 mm/s
  std::optional<VehicleStop> stop{};    ///< on the way
  std::optional<Controller> controller{};  ///< absent: holds the condition's speed; torques are of all driven wheels
  std::vector<Waypoint> profile{};         ///< rising in `at`; empty: the condition's slope and pull throughout
};

/// A vehicle on a soil.
struct VehicleCase {
  std::string name{}, source{};
  double mass = 0.0;  ///< [kg], > 0
  VehiclePoint centre_of_gravity{};
  DriveLine drive_line = DriveLine::locked;
  std::optional<Differential> centre_differential{};  ///< between its two driven axles; absent: locked
  std::optional<double> power{};                      ///< that reaches the wheels at most [W], > 0
  std::optional<GearedMotor> motor{};                 ///< of the drive line; its gear ratio is over line_radius
  std::vector<VehicleAxle> axles{};
  VehicleHitch hitch{};
  Soil soil{};
  std::vector<EffectChoice> effects{};
  VehicleCondition condition{};
  VehicleDrive drive{};

  bool has_open_centre() const { return centre_differential == Differential::open; }
  /// Whether the wheels of a driven axle of its, where they are two, turn unlike at the same torque.
  bool is_open(const VehicleAxle& axle) const {
    const bool by_line = drive_line == DriveLine::open_axles;
    return axle.differential ? axle.differential == Differential::open : by_line;
  }

  /// At which the spin of the drive line is told [m]: of the first driven axle's wheels.
  double line_radius() const {
    for (const VehicleAxle& axle : axles)
      if (axle.driven == YesNo::yes) return axle.tire.radius;
    return 1.0;
  }
};

void describe(auto& v, std::type_identity<VehiclePoint>) {
  v.number("x", &VehiclePoint::x, Measure{"m", any_value}, Need::optional, "forward");
  v.number("y", &VehiclePoint::y, Measure{"m", any_value}, Need::optional, "to the left of the vehicle's middle");
  v.number("z", &VehiclePoint::z, Measure{"m", zero_or_more}, Need::optional, "height over hard level ground");
}

void describe(auto& v, std::type_identity<VehicleAxle>) {
  using A = VehicleAxle;
  v.text("name", &A::name, Need::optional, "what to call the axle");
  v.number("x", &A::x, Measure{"m", any_value}, Need::required, "its place, forward");
  v.number("y", &A::y, Measure{"m", any_value}, Need::optional, "its middle, to the left");
  v.number("track", &A::track, Measure{"m", above_zero}, Need::optional,
           "between the middles of its two wheels; absent: it has one wheel");
  v.choice("driven", &A::driven, Need::optional, "no: its wheels roll freely");
  v.choice("steered", &A::steered, Need::optional, "whether it is turned to keep the vehicle on its line");
  v.number("largest_steer", &A::largest_steer,
           Measure{"deg", {.lower = 0.0, .upper = right_angle, .lower_open = true, .upper_open = true}}, Need::optional,
           "of the middle between its wheels, to either side; absent: nothing stops it");
  v.number("lead", &A::lead, Measure{"-", {.lower = -1.0, .lower_open = true}}, Need::optional,
           "by how much its rim is faster than the drive line's");
  v.choice("differential", &A::differential, Need::optional,
           "between its two wheels: one speed, or one torque; absent: as the drive line has it");
  v.number("torque_share", &A::torque_share, Measure{"-", above_zero}, Need::optional,
           "of an open centre differential, beside that of the other driven axle; absent: 1");
  v.number("largest_torque", &A::largest_torque, Measure{"N m", above_zero}, Need::optional,
           "of a wheel's motor, with the drive line 'motors'");
  v.group("motor", &A::motor, Need::optional, "of each wheel, in place of largest_torque: torque against speed");
  v.number("stiffness", &A::stiffness, Measure{"kN/m", above_zero}, Need::optional,
           "of a wheel's spring and tire; absent: all are alike");
  v.number("inertia", &A::inertia, Measure{"kg m^2", above_zero}, Need::optional,
           "of a wheel and what spins with it; absent: a tenth of the mass that it carries, times radius squared");
}

void describe(auto& v, std::type_identity<VehicleHitch>) {
  v.group("at", &VehicleHitch::at, Need::required, "the point where the pull acts");
  v.number("angle", &VehicleHitch::angle, Measure{"deg", inclines}, Need::optional,
           "of the pull below the ground's plane");
}

void describe(auto& v, std::type_identity<VehicleCondition>) {
  using C = VehicleCondition;
  v.number("slope", &C::slope, Measure{"deg", inclines}, Need::optional, "uphill positive");
  v.number("cross_slope", &C::cross_slope, Measure{"deg", inclines}, Need::optional, "left side up positive");
  v.number("speed", &C::speed, Measure{"m/s", above_zero}, Need::optional, "of travel");
  v.number("pull", &C::pull, Measure{"N", any_value}, Need::optional, "that the vehicle pulls behind it");
}

void describe(auto& v, std::type_identity<VehicleStop>) {
  v.number("at", &VehicleStop::at, Measure{"s", above_zero}, Need::required, "it begins to brake by its drive line");
  v.number("lasts", &VehicleStop::lasts, Measure{"s", zero_or_more}, Need::optional, "between the controller's ramps");
}

void describe(auto& v, std::type_identity<VehicleDrive>) {
  using D = VehicleDrive;
  v.number("duration", &D::duration, Measure{"s", above_zero}, Need::optional, "the drive ends then at the latest");
  v.number("distance", &D::distance, Measure{"m", above_zero}, Need::optional, "the vehicle has arrived there");
  v.number("damping", &D::damping, Measure{"-", fractions}, Need::optional,
           "share of critical damping, of the soil under heave and of shear at rest");
  v.number("stuck_speed", &D::stuck_speed, Measure{"m/s", above_zero}, Need::optional,
           "mean speed of travel below which it is stuck; absent: a hundredth of the speed that is held");
  v.group("stop", &D::stop, Need::optional, "a stop on the way, and the start from it");
  v.group("controller", &D::controller, Need::optional, "what turns the wheels; absent: holds the condition's speed");
  v.list("profile", &D::profile, Need::optional, "places along the way; absent: the condition's slope and pull");
}

std::string contradiction(const VehicleDrive& drive);

void describe(auto& v, std::type_identity<VehicleCase>) {
  using V = VehicleCase;
  v.text("name", &V::name, Need::required, "what to call the vehicle");
  v.text("source", &V::source, Need::optional, "where it is described");
  v.number("mass", &V::mass, Measure{"kg", above_zero}, Need::required, "of the whole vehicle, loaded");
  v.group("centre_of_gravity", &V::centre_of_gravity, Need::required, "where its weight acts");
  v.choice("drive_line", &V::drive_line, Need::optional, "how the wheels are driven");
  v.choice("centre_differential", &V::centre_differential, Need::optional,
           "between its two driven axles: one speed, or shares of the torque; absent: locked");
  v.number("power", &V::power, Measure{"kW", above_zero}, Need::optional, "that reaches the wheels at most");
  v.group("motor", &V::motor, Need::optional,
          "that turns the driven wheels, but for the drive line 'motors': torque against speed");
  v.group("hitch", &V::hitch, Need::optional,
          "where what is pulled is hooked on; absent: on the ground, at x = 0 and y = 0");
  v.group("condition", &V::condition, Need::optional, "slope, speed and pull");
}

std::string contradiction(const VehicleCase& vehicle);

inline constexpr const char* vehicle_case_format = "soilbin-vehicle-case/1";

/// Reads a vehicle on a soil. Tires and soil are named or written out as in a case. Throws InputError with file, line,
/// column and hint.
VehicleCase parse_vehicle_case(const SourceText& source, const Library& library, const EffectVocabulary& effects);
/// The file that parse_vehicle_case reads to the same bits, with tires and soil written out.
std::string write_vehicle_case(const VehicleCase& vehicle, const EffectVocabulary& effects);
/// A vehicle of the library by its name ("truck"), or of a file.
VehicleCase find_vehicle_case(const std::string& name, const Library& library, const EffectVocabulary& effects);

struct VehicleWheel {
  std::string name{};  ///< "front left"
  std::size_t axle = 0;
  VehiclePoint place{};  ///< its axle's end: z is the tire's radius
  Scenario scenario{};   ///< its tire on the soil, with the vehicle's effects and those that its tire declares
  std::vector<std::size_t> in_rut_of{};  ///< wheels that rolled in its rut before, from the front, by their place

  int pass() const { return 1 + static_cast<int>(in_rut_of.size()); }
};

/// Its wheels from the front to the rear, the left one first. A wheel is in the rut of one before it where less than
/// half of its width lies beside that one's.
std::vector<VehicleWheel> wheels_of(const VehicleCase& vehicle);

/// Effects that the tires declare, as `estimate` takes them, and what is told of it. The effects are of the wheels.
Doubts declare_tires(std::vector<VehicleWheel>& wheels, const TireLeftOut& left_out = {});

// The numbers of a vehicle's wheels that have a standard deviation, soil and carcass pressures, as values that can be
// moved: for standard errors and for the chance to go.

/// A number of the wheels' scenarios that has a standard deviation.
struct DoubtfulNumber {
  double value = 0.0, sd = 0.0;  ///< [SI]
  Range range{};
  std::function<void(Scenario&, double)> set{};
  std::string title{};  ///< for people: "friction angle"

  /// The wheels with this number set to a value.
  std::vector<VehicleWheel> in(std::vector<VehicleWheel> wheels, double to) const {
    for (VehicleWheel& wheel : wheels) set(wheel.scenario, to);
    return wheels;
  }
};

/// The soil's values, which are one for all wheels, and doubtful_carcasses.
std::vector<DoubtfulNumber> doubtful_numbers(const std::vector<VehicleWheel>& wheels);
/// Those of a soil that has semi_empirical values.
std::vector<DoubtfulNumber> doubtful_numbers(const Soil& soil);
/// A carcass pressure once for all wheels whose tires have name, size and carcass in common; inflations may differ.
std::vector<DoubtfulNumber> doubtful_carcasses(const std::vector<VehicleWheel>& wheels);

}  // namespace soilbin::compare
