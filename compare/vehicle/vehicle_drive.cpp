#include "compare/vehicle/vehicle_drive.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "bekker_wong/gsl.hpp"
#include "bekker_wong/transient/cvodes.hpp"
#include "compare/vehicle/steady_vehicle.hpp"
#include "scenario/soil.hpp"

namespace soilbin::compare {
namespace {

using bekker_wong::DrivenWheel;
using bekker_wong::Instant;
namespace wheel_state = bekker_wong;  // StatePlace of one wheel
namespace work = bekker_wong::work;

constexpr double heard_time = 0.05;    // [s] in which what effects read of a load follows that load: chosen
constexpr double turned_about = -0.9;  // rolled beyond which a wheel is the mirrored one: three lengths of rolling-in
constexpr double least_heard = 1e-6;   // of the weight: what effects read of a wheel that hangs in the air
constexpr double stuck_share = 0.01;   // of the speed that is held: 99 % of slip
constexpr double roll_back = 0.5;      // way behind the start over the wheelbase

/// Places of the state vector; rotors and axles follow.
enum VehiclePlace : std::size_t { at_x, at_speed, at_mean_speed, first_rotor };
enum RotorPlace : std::size_t { rotor_spin, rotor_error, rotor_places };
enum AxlePlace : std::size_t { axle_depth, axle_sinking, axle_rolled, axle_heard, axle_nodes };

/// An axle with one of its wheels.
struct RollingAxle {
  std::size_t axle = 0;   ///< of the case
  std::size_t wheel = 0;  ///< its first one
  double count = 1.0;     ///< wheels
  double ahead = 0.0;     ///< of the centre of gravity [m]
  std::size_t rotor = 0;  ///< what turns it
  double gear = 1.0;      ///< its spin over the rotor's
  double mass = 0.0;      ///< that heaves with one wheel [kg]
  std::size_t at = 0;     ///< of its states
  DrivenWheel in_soil;
};

/// What turns together: a drive line with its wheels, a motor's wheels, or the wheels of an axle that is not driven.
struct Rotor {
  double radius = 1.0;   ///< at which its spin is told as a rim speed [m]
  double inertia = 0.0;  ///< [kg m^2]
  bool driven = false;
  std::size_t first_axle = 0;
  Controller controller{};
  std::optional<double> power{};        ///< [W]
  std::optional<GearedMotor> geared{};  ///< of its wheels together
  std::optional<Motor> motor{};
};

/// The vehicle at one instant.
struct Look {
  std::vector<Instant> soil;       ///< of each axle, along travel
  std::vector<double> loads;       ///< of one wheel of each, normal to the ground [N]
  std::vector<double> torques;     ///< of each rotor [N m]
  std::vector<double> spin_rates;  ///< of each rotor
  Place place;
  double acceleration = 0.0;
  double standing = 0.0;  ///< how far what the axles carry acts from the nearer outer axle, inward [m]
};

/// How it stands on its axles.
struct Stance {
  double nose_down = 0.0;  ///< [rad]
  double normal = 0.0;     ///< that the axles carry together, normal to the ground [N]
  double pitch = 0.0;      ///< moment of all else about x = 0 on the ground, nose down [N m]
};

Controller controller_of(const VehicleCase& question) {
  if (question.drive.controller) return *question.drive.controller;
  Controller holds_speed;
  holds_speed.rim_speed = question.condition.speed;
  return holds_speed;
}

std::vector<Waypoint> way_of(const VehicleCase& question) {
  if (!question.drive.profile.empty()) return question.drive.profile;
  Waypoint throughout;
  throughout.longitudinal_incline = question.condition.slope, throughout.drawbar = question.condition.pull;
  return {throughout};
}

/// What it drives in time are wheels of one speed: across an axle both sides are alike, along it they are not.
void require_one_speed(const VehicleCase& question) {
  if (question.has_open_centre())
    throw InputError(
        "a vehicle is driven in time without an open centre differential: all driven axles turn together\n  hint: "
        "--centre-differential locked");
}

void require_both_sides_alike(const VehicleCase& question, const std::vector<VehicleWheel>& wheels) {
  const char* alike = "a vehicle driven in time is alike on both sides: ";
  if (question.condition.cross_slope != 0.0)
    throw InputError("a vehicle is driven in time straight up or down: it takes no cross slope");
  const auto beside = [&](double y) { return std::abs(y - question.centre_of_gravity.y) > in_one_place; };
  if (beside(question.hitch.at.y))
    throw InputError(alike + std::string("its hitch does not lie behind its centre of gravity"));
  for (const VehicleAxle& axle : question.axles)
    if (beside(axle.y)) throw InputError(alike + ("axle '" + axle.name + "' does not lie below its centre of gravity"));
  for (const VehicleWheel& wheel : wheels)
    for (const VehicleWheel& other : wheels)
      if (wheel.axle == other.axle && wheel.pass() != other.pass())
        throw InputError(alike + ("of axle '" + question.axles[wheel.axle].name + "' one wheel alone is in a rut"));
}

/// One vehicle under way.
class VehicleRide {
 public:
  VehicleRide(const VehicleCase& question, const std::vector<VehicleWheel>& wheels,
              const bekker_wong::DriveNumerics& numerics)
      : question_(question), way_(angles_along(way_of(question))), weight_(question.mass * gravity_of(question.soil)) {
    require_one_speed(question);
    require_both_sides_alike(question, wheels);
    build(wheels, numerics);
    start();
    integrator_.emplace(problem(numerics), 0.0, start_);
  }

  VehicleDriveRecord run(int samples, const bekker_wong::DriveProgress& progress) {
    bekker_wong::go_through(
        {samples, question_.drive.duration, ramp_}, *integrator_, record_.end_time,
        [this](const sundials::Stop& stop) { return answer(stop); },
        [this] { record_.samples.push_back(sample(record_.end_time)); }, progress);
    tell_what_gave_out();
    return std::move(record_);
  }

 private:
  void build(const std::vector<VehicleWheel>& wheels, const bekker_wong::DriveNumerics& numerics);
  void add_rotors();
  std::vector<CarryingAxle> carrying(double nose_down) const;
  void start();
  double held(double displacement);
  void add_motors(double displacement);
  sundials::Problem problem(const bekker_wong::DriveNumerics& numerics);

  std::size_t nodes_of(const RollingAxle& axle) const { return axle.in_soil.state_size() - wheel_state::first_node; }
  std::size_t rotor_at(std::size_t rotor) const { return first_rotor + rotor_places * rotor; }
  double spin_of(const RollingAxle& axle, std::span<const double> y) const {
    return axle.gear * y[rotor_at(axle.rotor) + rotor_spin];
  }
  Place place_of(const RollingAxle& axle, double x, const Place& of_all) const;
  /// A wheel of the axle at the start, under a load on level ground [N]; a driven one pushed back so far [m].
  Instant resting(const RollingAxle& axle, double load, double displacement, std::vector<double>& state) const {
    return axle.in_soil.rest(place_of(axle, 0.0, way_.at(0.0)), load, rotors_[axle.rotor].driven ? displacement : 0.0,
                             state);
  }
  /// The drawbar's force along the ground, and what it presses the vehicle down with [N].
  double pull_along(const Place& place) const { return place.drawbar * std::cos(question_.hitch.angle); }
  double pull_down(const Place& place) const { return place.drawbar * std::sin(question_.hitch.angle); }
  Stance stance_of(const Place& place, const std::vector<VehiclePoint>& sunk, const std::vector<Instant>& soil,
                   const std::vector<double>& spin_rates, double acceleration) const;
  std::vector<double> wheel_state_of(std::size_t axle, std::span<const double> y) const;
  Instant touch(std::size_t axle, const Place& place, std::span<const double> y, std::span<double> node_rate) const;
  /// `rates`: of the whole state; its axles' nodes get theirs.
  Look look(double t, std::span<const double> y, std::span<double> rates) const;
  void rate(double t, std::span<const double> y, std::span<double> out) const;
  void watch(double t, std::span<const double> y, std::span<double> out) const;
  void powers(double t, std::span<const double> y, std::span<double> out) const;
  bool answer(const sundials::Stop& stop);
  void note(DriveEvent what, std::size_t axle) {
    record_.happenings.push_back({record_.end_time, integrator_->state()[at_x], what, axle});
  }
  VehicleDriveSample sample(double t) const;
  double in_motion(std::span<const double> y) const;
  double line_rim_speed(std::span<const double> y) const;
  void tell_what_gave_out();

  // Roots: four of the whole, two of each rotor, three of each axle.
  enum Root : std::size_t { root_goal, root_stuck, root_tips_over, root_roll_back, first_of_rotors };
  std::size_t rotor_root(std::size_t rotor) const { return first_of_rotors + 2 * rotor; }
  std::size_t axle_root(std::size_t axle) const { return first_of_rotors + 2 * rotors_.size() + 3 * axle; }

  const VehicleCase& question_;
  soilbin::Way way_;
  double weight_;
  double ramp_ = 0.0, wheelbase_ = 0.0, stuck_speed_ = 0.0;
  std::optional<Halt> halt_;
  double rear_ = 0.0, front_ = 0.0;  ///< of the outer axles [m]
  std::optional<double> rim_;        ///< rim speed that is held
  std::vector<RollingAxle> axles_;
  std::vector<Rotor> rotors_;
  bool rolls_back_ = false;      ///< too fast to be stuck
  std::vector<double> heading_;  ///< of each axle: 1, or -1 where its wheels are the mirrored ones
  std::vector<double> start_;
  std::vector<double> start_loads_;
  VehicleDriveRecord record_;
  std::optional<sundials::Integrator> integrator_;

  /// What an axle was last asked and answered: a Jacobian by differences asks most of them the same again.
  struct Known {
    std::vector<double> state;
    double load = 0.0;
    Instant soil;
    std::vector<double> node_rate;
  };
  mutable std::vector<Known> known_;
};

std::vector<CarryingAxle> VehicleRide::carrying(double nose_down) const {
  std::vector<CarryingAxle> all;
  for (const RollingAxle& axle : axles_) {
    const VehicleAxle& about = question_.axles[axle.axle];
    const VehiclePoint end = tilted({about.x, 0.0, about.tire.radius}, nose_down, 0.0);
    all.push_back({axle.count * about.stiffness.value_or(1.0), about.x, end.x});
  }
  return all;
}

void VehicleRide::build(const std::vector<VehicleWheel>& wheels, const bekker_wong::DriveNumerics& numerics) {
  const Controller controller = controller_of(question_);
  ramp_ = controller.ramp, rim_ = controller.rim_speed;
  stuck_speed_ = question_.drive.stuck_speed.value_or(rim_ ? stuck_share * *rim_ : Drive{}.stuck_speed);
  if (const auto& stop = question_.drive.stop) halt_ = Halt{stop->at, stop->lasts};
  const double gravity = gravity_of(question_.soil);
  // What each carries on level ground: as much mass heaves with it.
  std::vector<CarryingAxle> stand;
  std::vector<std::size_t> first, count;
  for (std::size_t axle = 0; axle < question_.axles.size(); ++axle) {
    const VehicleAxle& about = question_.axles[axle];
    const auto mine = [&](const VehicleWheel& wheel) { return wheel.axle == axle; };
    count.push_back(static_cast<std::size_t>(std::ranges::count_if(wheels, mine)));
    first.push_back(static_cast<std::size_t>(std::ranges::find_if(wheels, mine) - wheels.begin()));
    stand.push_back({static_cast<double>(count.back()) * about.stiffness.value_or(1.0), about.x, about.x});
  }
  const std::vector<double> level = axle_loads(stand, weight_, question_.centre_of_gravity.x * weight_);
  for (std::size_t axle = 0; axle < question_.axles.size(); ++axle) {
    const double load = std::max(level[axle] / static_cast<double>(count[axle]), least_heard * weight_);
    Scenario scenario = wheels[first[axle]].scenario;
    Drive drive;
    drive.effects = std::exchange(scenario.effects, {});
    drive.load = load, drive.mass = load / gravity, drive.pass = wheels[first[axle]].pass();
    drive.inertia = question_.axles[axle].inertia;
    drive.duration = question_.drive.duration, drive.damping = question_.drive.damping;
    drive.stuck_speed = stuck_speed_, drive.controller = controller;
    drive.profile = way_of(question_);
    axles_.push_back({axle, first[axle], static_cast<double>(count[axle]),
                      question_.axles[axle].x - question_.centre_of_gravity.x, 0, 1.0, load / gravity, 0,
                      DrivenWheel(scenario, drive, numerics)});
  }
  rear_ = HUGE_VAL, front_ = -HUGE_VAL;
  for (const VehicleAxle& axle : question_.axles) rear_ = std::min(rear_, axle.x), front_ = std::max(front_, axle.x);
  wheelbase_ = front_ - rear_;
  add_rotors();
  std::size_t next = rotor_at(rotors_.size());
  for (RollingAxle& axle : axles_) axle.at = next, next += axle_nodes + nodes_of(axle);
  start_.assign(next, 0.0);
  heading_.assign(axles_.size(), 1.0);
  known_.resize(axles_.size());
}

void VehicleRide::add_rotors() {
  const Controller asked = controller_of(question_);
  double driven_wheels = 0.0;
  for (const RollingAxle& axle : axles_)
    if (question_.axles[axle.axle].driven == YesNo::yes) driven_wheels += axle.count;
  std::optional<std::size_t> line;  // the drive line's, where all turn together
  for (std::size_t i = 0; i < axles_.size(); ++i) {
    RollingAxle& axle = axles_[i];
    const VehicleAxle& about = question_.axles[axle.axle];
    const bool driven = about.driven == YesNo::yes, motors = question_.drive_line == DriveLine::motors;
    if (driven && line) {
      axle.rotor = *line;
    } else {
      axle.rotor = rotors_.size();
      Rotor& rotor = rotors_.emplace_back();
      rotor.radius = about.tire.radius, rotor.driven = driven, rotor.first_axle = axle.axle;
      if (driven && !motors) line = axle.rotor;
      if (driven) {
        const double share = motors ? axle.count / driven_wheels : 1.0;
        rotor.controller = asked;
        for (auto torque : {&Controller::torque, &Controller::highest_torque})
          if (rotor.controller.*torque) *(rotor.controller.*torque) *= share;
        if (about.largest_torque)
          rotor.controller.highest_torque =
              std::min(rotor.controller.highest_torque.value_or(HUGE_VAL), axle.count * *about.largest_torque);
        if (question_.power) rotor.power = *question_.power * share;
        rotor.geared = motors ? about.motor : question_.motor;
        if (rotor.geared) {
          if (motors)
            for (TorquePoint& point : rotor.geared->torque_curve) point.torque *= axle.count;
          const double top = top_spin(*rotor.geared) * rotor.radius;
          for (auto rim : {&Controller::rim_speed, &Controller::highest_rim_speed})
            if (rotor.controller.*rim) rotor.controller.*rim = std::min(*(rotor.controller.*rim), top);
          if (rotor.controller.torque && !rotor.controller.highest_rim_speed) rotor.controller.highest_rim_speed = top;
        }
      }
    }
    const Rotor& rotor = rotors_[axle.rotor];
    axle.gear = (driven ? 1.0 + about.lead : 1.0) * rotor.radius / about.tire.radius;
    rotors_[axle.rotor].inertia += axle.count * axle.gear * axle.gear * axle.in_soil.inertia();
  }
}

Place VehicleRide::place_of(const RollingAxle& axle, double x, const Place& of_all) const {
  Place place = axle.in_soil.way().at(x + axle.ahead);  // its soils
  place.longitudinal_incline = of_all.longitudinal_incline, place.curvature = of_all.curvature;
  place.drawbar = 0.0;
  return place;
}

/// Lays the start's depths, shear and loads with the driven wheels pushed back by `displacement` [m]; what the soil
/// then holds too much [N].
double VehicleRide::held(double displacement) {
  constexpr int most_rounds = 100;
  constexpr double settled = 1e-13;
  const Place place = way_.at(0.0);
  const double up = std::cos(place.longitudinal_incline);
  const std::vector<double> at_rest(rotors_.size(), 0.0);
  double forward = 0.0;
  std::vector<double> loads = start_loads_;
  for (int round = 0; round < most_rounds; ++round) {
    std::vector<Instant> soil;
    std::vector<VehiclePoint> sunk;
    forward = 0.0;
    for (std::size_t i = 0; i < axles_.size(); ++i) {
      const RollingAxle& axle = axles_[i];
      std::vector<double> state = wheel_state_of(i, start_);
      const double load = std::max(loads[i] / axle.count, least_heard * weight_);
      try {
        soil.push_back(resting(axle, load / up, displacement, state));
      } catch (const NoSolution& error) {
        throw VehicleGaveOut(GaveOut::wheel, axle.wheel, error.what());
      }
      start_[axle.at + axle_depth] = state[wheel_state::depth], start_[axle.at + axle_heard] = load / up;
      std::copy(state.begin() + wheel_state::first_node, state.end(),
                start_.begin() + static_cast<std::ptrdiff_t>(axle.at + axle_nodes));
      forward += axle.count * soil.back().forward;
      for (double k = 0; k < axle.count; ++k)
        sunk.push_back({question_.axles[axle.axle].x, 0.0, state[wheel_state::depth] - soil.back().deflection});
    }
    const Stance stance = stance_of(place, sunk, soil, at_rest, 0.0);
    std::vector<double> next = axle_loads(carrying(stance.nose_down), stance.normal, stance.pitch);
    if (next.size() > 1 && std::ranges::count_if(next, [](double load) { return load > 0.0; }) < 2)
      throw VehicleGaveOut(GaveOut::tips_over, std::nullopt, "it tips over");
    double change = 0.0;
    for (std::size_t i = 0; i < loads.size(); ++i) change = std::max(change, std::abs(next[i] - loads[i]));
    loads = std::move(next);
    if (change <= settled * weight_) break;
    start_loads_ = loads;
  }
  return forward - weight_ * std::sin(place.longitudinal_incline) - pull_along(place);
}

/// Gives each motor the torque that holds the vehicle at the start, its driven wheels pushed back so far [m].
void VehicleRide::add_motors(double displacement) {
  std::vector<double> torque(rotors_.size(), 0.0), carried(rotors_.size(), 0.0);
  for (std::size_t i = 0; i < axles_.size(); ++i) {
    const RollingAxle& axle = axles_[i];
    std::vector<double> state = wheel_state_of(i, start_);
    torque[axle.rotor] +=
        axle.count * axle.gear * resting(axle, start_[axle.at + axle_heard], displacement, state).soil_torque;
    carried[axle.rotor] += axle.count * axle.mass;
  }
  for (std::size_t k = 0; k < rotors_.size(); ++k) {
    Rotor& rotor = rotors_[k];
    if (!rotor.driven) continue;
    const double moved = question_.drive_line == DriveLine::motors ? carried[k] : question_.mass;
    rotor.motor.emplace(rotor.controller, rotor.radius, rotor.inertia + moved * rotor.radius * rotor.radius, torque[k],
                        rotor.power, halt_, rotor.geared);
  }
}

/// At rest: the driven wheels have slid back together until they hold the vehicle.
void VehicleRide::start() {
  const Place place = way_.at(0.0);
  start_[at_mean_speed] = drive_limits::first_speed * stuck_speed_;
  start_loads_.clear();
  for (const RollingAxle& axle : axles_)
    start_loads_.push_back(axle.count * axle.mass * gravity_of(question_.soil) * std::cos(place.longitudinal_incline));
  const double pull = weight_ * std::sin(place.longitudinal_incline) + pull_along(place);
  if (pull == 0.0) {
    held(0.0);
    return add_motors(0.0);
  }
  const double modulus = std::copysign(axles_.front().in_soil.steady().soil().shear_modulus, pull);
  constexpr double most = 32.0;
  double share = 0.25;
  while (held(share * modulus) * pull < 0.0)
    if ((share *= 2) > most)
      throw VehicleGaveOut(GaveOut::hold, std::nullopt, "the soil can't hold it at rest by its driven wheels");
  const double far = share * modulus;
  const double root = gsl::bracketed_root([&](double d) { return held(d); }, std::min(0.0, far), std::max(0.0, far),
                                          1e-12, 1e-10 * std::abs(pull), "the shear that holds the vehicle at rest");
  held(root);
  add_motors(root);
  try {
    for (const Rotor& rotor : rotors_)
      if (rotor.motor) rotor.motor->require_hold();
  } catch (const NoSolution&) {
    throw VehicleGaveOut(GaveOut::hold, std::nullopt, "its motors' highest torque can't hold it at rest");
  }
}

std::vector<double> VehicleRide::wheel_state_of(std::size_t i, std::span<const double> y) const {
  const RollingAxle& axle = axles_[i];
  std::vector<double> state(axle.in_soil.state_size(), 0.0);
  const std::span<const double> own = y.subspan(axle.at);
  state[wheel_state::travelled] = y[at_x] + axle.ahead;
  state[wheel_state::speed] = heading_[i] * y[at_speed], state[wheel_state::spin] = heading_[i] * spin_of(axle, y);
  state[wheel_state::depth] = own[axle_depth], state[wheel_state::sinking] = own[axle_sinking];
  state[wheel_state::rolled] = own[axle_rolled];
  std::ranges::copy(own.subspan(axle_nodes, nodes_of(axle)), state.begin() + wheel_state::first_node);
  return state;
}

/// What the soil does to a wheel of the axle, along the vehicle's travel.
Instant VehicleRide::touch(std::size_t i, const Place& place, std::span<const double> y,
                           std::span<double> node_rate) const {
  Place own = place_of(axles_[i], y[at_x], place);
  own.longitudinal_incline *= heading_[i];
  std::vector<double> state = wheel_state_of(i, y);
  Known& known = known_[i];
  const double load = std::max(y[axles_[i].at + axle_heard], least_heard * weight_);
  state.push_back(own.longitudinal_incline), state.push_back(heading_[i]);
  if (known.state != state || known.load != load) {
    known.node_rate.resize(nodes_of(axles_[i]));
    known.soil = axles_[i].in_soil.touch(own, load, std::span(state).first(state.size() - 2), known.node_rate);
    known.soil.forward *= heading_[i], known.soil.soil_torque *= heading_[i];
    known.state = std::move(state), known.load = load;
  }
  std::ranges::copy(known.node_rate, node_rate.begin());
  return known.soil;
}

/// Quasi-static, with the inertia of travel at the centre of gravity and that of the spinning wheels.
Stance VehicleRide::stance_of(const Place& place, const std::vector<VehiclePoint>& sunk,
                              const std::vector<Instant>& soil, const std::vector<double>& spin_rates,
                              double acceleration) const {
  const double up = std::cos(place.longitudinal_incline), along = std::sin(place.longitudinal_incline);
  const double nose_down = sunk.empty() ? 0.0 : std::atan(plane_through(sunk).along);
  Wrench sum;
  sum.add(tilted(question_.centre_of_gravity, nose_down, 0.0), {-weight_ * along - question_.mass * acceleration, 0.0},
          -weight_ * up);
  sum.add(tilted(question_.hitch.at, nose_down, 0.0), {-pull_along(place), 0.0}, -pull_down(place));
  for (std::size_t i = 0; i < axles_.size(); ++i) {
    const RollingAxle& axle = axles_[i];
    const VehicleAxle& about = question_.axles[axle.axle];
    sum.add(tilted({about.x, 0.0, about.tire.radius}, nose_down, 0.0), {axle.count * soil[i].forward, 0.0}, 0.0);
    const double spinning = axle.in_soil.inertia() * axle.gear * spin_rates[axle.rotor];
    sum.pitch -= axle.count * (soil[i].soil_torque + spinning);
  }
  return {nose_down, weight_ * up + pull_down(place), sum.pitch};
}

Look VehicleRide::look(double t, std::span<const double> y, std::span<double> rates) const {
  Look now;
  const Place place = now.place = way_.at(y[at_x]);
  double forward = -weight_ * std::sin(place.longitudinal_incline) - pull_along(place);
  std::vector<double> against(rotors_.size(), 0.0);
  std::vector<VehiclePoint> sunk;
  for (std::size_t i = 0; i < axles_.size(); ++i) {
    const RollingAxle& axle = axles_[i];
    now.soil.push_back(touch(i, place, y, rates.subspan(axle.at + axle_nodes, nodes_of(axle))));
    const Instant& soil = now.soil.back();
    const double heave = y[axle.at + axle_sinking];
    forward += axle.count * (soil.forward - axle.mass * place.curvature * y[at_speed] * heave);
    against[axle.rotor] += axle.count * axle.gear * soil.soil_torque;
    if (y[axle.at + axle_depth] <= 0.0) continue;
    for (double k = 0; k < axle.count; ++k)
      sunk.push_back({question_.axles[axle.axle].x, 0.0, y[axle.at + axle_depth] - soil.deflection});
  }
  now.acceleration = forward / question_.mass;
  for (std::size_t k = 0; k < rotors_.size(); ++k) {
    const double spin = y[rotor_at(k) + rotor_spin], error = y[rotor_at(k) + rotor_error];
    now.torques.push_back(rotors_[k].motor ? rotors_[k].motor->torque(t, spin, error) : 0.0);
    now.spin_rates.push_back((now.torques.back() - against[k]) / rotors_[k].inertia);
  }
  const Stance stance = stance_of(place, sunk, now.soil, now.spin_rates, now.acceleration);
  now.loads = axle_loads(carrying(stance.nose_down), stance.normal, stance.pitch);
  for (std::size_t i = 0; i < axles_.size(); ++i) now.loads[i] /= axles_[i].count;
  now.standing = std::min(stance.pitch / stance.normal - rear_, front_ - stance.pitch / stance.normal);
  return now;
}

void VehicleRide::rate(double t, std::span<const double> y, std::span<double> out) const {
  const Look now = look(t, y, out);
  const double v = y[at_speed], up = std::cos(now.place.longitudinal_incline);
  out[at_x] = v, out[at_speed] = now.acceleration;
  const bool stops = halt_ && t > halt_->at && t < halt_->over(ramp_);
  out[at_mean_speed] = t < ramp_ || stops ? 0.0 : (v - y[at_mean_speed]) / drive_limits::memory;
  for (std::size_t k = 0; k < rotors_.size(); ++k) {
    const double spin = y[rotor_at(k) + rotor_spin], error = y[rotor_at(k) + rotor_error];
    out[rotor_at(k) + rotor_spin] = now.spin_rates[k];
    out[rotor_at(k) + rotor_error] = rotors_[k].motor ? rotors_[k].motor->integral_rate(t, spin, error) : 0.0;
  }
  for (std::size_t i = 0; i < axles_.size(); ++i) {
    const RollingAxle& axle = axles_[i];
    const std::span<double> own = out.subspan(axle.at);
    const double sinking = y[axle.at + axle_sinking];
    own[axle_depth] = sinking;
    own[axle_sinking] = (now.loads[i] - now.soil[i].upward) / axle.mass + now.place.curvature * v * v;
    own[axle_rolled] = axle.in_soil.rolled_rate(heading_[i] * v, y[axle.at + axle_rolled]);
    own[axle_heard] = (now.loads[i] / up - y[axle.at + axle_heard]) / heard_time;
  }
}

void VehicleRide::watch(double t, std::span<const double> y, std::span<double> out) const {
  std::vector<double> rates(y.size());
  const Look now = look(t, y, rates);
  out[root_goal] = question_.drive.distance ? y[at_x] - *question_.drive.distance : 1.0;
  out[root_stuck] = (rolls_back_ ? std::abs(y[at_mean_speed]) : y[at_mean_speed]) - stuck_speed_;
  out[root_tips_over] = wheelbase_ > 0.0 ? now.standing : 1.0;
  const double length = wheelbase_ > 0.0 ? wheelbase_ : axles_.front().in_soil.radius();
  out[root_roll_back] = y[at_x] + roll_back * length;
  for (std::size_t k = 0; k < rotors_.size(); ++k) {
    const double spin = y[rotor_at(k) + rotor_spin], error = y[rotor_at(k) + rotor_error];
    const std::array<double, 2> beyond =
        rotors_[k].motor ? rotors_[k].motor->beyond(t, spin, error) : std::array{-1.0, 1.0};
    out[rotor_root(k)] = beyond[0], out[rotor_root(k) + 1] = beyond[1];
  }
  for (std::size_t i = 0; i < axles_.size(); ++i) {
    const std::span<const double> own = y.subspan(axles_[i].at);
    out[axle_root(i)] = own[axle_depth];
    out[axle_root(i) + 1] = own[axle_depth] - drive_limits::deepest * axles_[i].in_soil.radius();
    out[axle_root(i) + 2] = own[axle_rolled] - turned_about;
  }
}

void VehicleRide::powers(double t, std::span<const double> y, std::span<double> out) const {
  std::vector<double> rates(y.size());
  const Look now = look(t, y, rates);
  const double along = std::sin(now.place.longitudinal_incline);
  std::ranges::fill(out, 0.0);
  for (std::size_t k = 0; k < rotors_.size(); ++k) out[work::motor] += now.torques[k] * y[rotor_at(k) + rotor_spin];
  out[work::height] = weight_ * along * y[at_speed];
  out[work::drawbar] = now.place.drawbar * std::cos(question_.hitch.angle) * y[at_speed];
  for (std::size_t i = 0; i < axles_.size(); ++i) {
    const double n = axles_[i].count;
    const Instant& soil = now.soil[i];
    out[work::height] -= n * now.loads[i] * y[axles_[i].at + axle_sinking];
    out[work::compaction] += n * soil.compaction, out[work::shear] += n * soil.shear,
        out[work::added] += n * soil.added;
    out[work::carcass] += n * soil.carcass, out[work::damping] += n * soil.damping;
  }
}

sundials::Problem VehicleRide::problem(const bekker_wong::DriveNumerics& numerics) {
  sundials::Problem p;
  p.rate = [this](double t, auto y, auto out) { rate(t, y, out); };
  p.roots = [this](double t, auto y, auto out) { watch(t, y, out); };
  p.root_count = static_cast<int>(axle_root(axles_.size()));
  p.summands = [this](double t, auto y, auto out) { powers(t, y, out); };
  p.sum_count = static_cast<int>(work::count);
  p.relative_tolerance = numerics.relative_tolerance;
  p.absolute_tolerances.assign(start_.size(), 0.0);
  double smallest = HUGE_VAL;
  for (const RollingAxle& axle : axles_) {
    const std::vector<double> wheel = axle.in_soil.tolerances(numerics.relative_tolerance);
    std::vector<double>& all = p.absolute_tolerances;
    if (axle.in_soil.radius() < smallest)
      all[at_x] = wheel[wheel_state::travelled], all[at_speed] = wheel[wheel_state::speed],
      all[at_mean_speed] = wheel[wheel_state::mean_speed];
    all[rotor_at(axle.rotor) + rotor_spin] = wheel[wheel_state::spin];
    all[rotor_at(axle.rotor) + rotor_error] = wheel[wheel_state::speed_error];
    all[axle.at + axle_depth] = wheel[wheel_state::depth], all[axle.at + axle_sinking] = wheel[wheel_state::sinking];
    all[axle.at + axle_rolled] = wheel[wheel_state::rolled];
    all[axle.at + axle_heard] = numerics.relative_tolerance * axle.in_soil.load();
    std::copy(wheel.begin() + wheel_state::first_node, wheel.end(),
              all.begin() + static_cast<std::ptrdiff_t>(axle.at + axle_nodes));
    smallest = std::min(smallest, axle.in_soil.radius());
  }
  p.sum_tolerance = numerics.relative_tolerance * weight_ * smallest;
  const Controller controller = controller_of(question_);
  const double rim = controller.rim_speed.value_or(controller.highest_rim_speed.value_or(0.0));
  p.longest_step = rim > 0.0 ? 0.5 * smallest / rim : 0.01 * question_.drive.duration;
  return p;
}

/// What a root means; true where the drive ends.
bool VehicleRide::answer(const sundials::Stop& stop) {
  const auto ends = [&](std::size_t place, int sign, DriveEnd end) {
    if (stop.signs[place] != sign) return false;
    record_.end = end;
    return true;
  };
  if (stop.signs[root_stuck] == -1 && !rolls_back_ &&
      integrator_->state()[at_speed] < -drive_limits::first_speed * stuck_speed_) {
    rolls_back_ = true;  // it does not stand: it goes on until it does, or has rolled back
    integrator_->restart();
    return false;
  }
  if (ends(root_goal, 1, DriveEnd::arrived) || ends(root_stuck, -1, DriveEnd::stuck) ||
      ends(root_tips_over, -1, DriveEnd::tips_over) || ends(root_roll_back, -1, DriveEnd::rolled_back))
    return true;
  for (std::size_t i = 0; i < axles_.size(); ++i)
    if (ends(axle_root(i) + 1, 1, DriveEnd::buried)) {
      record_.gave_out = axles_[i].axle;
      return true;
    }
  for (std::size_t k = 0; k < rotors_.size(); ++k) {
    const int upper = stop.signs[rotor_root(k)], lower = stop.signs[rotor_root(k) + 1];
    if (upper == 0 && lower == 0) continue;
    note(bekker_wong::limit_event(upper, lower, rotors_[k].controller), rotors_[k].first_axle);
  }
  bool turns = false;
  std::vector<double> y = integrator_->state();
  for (std::size_t i = 0; i < axles_.size(); ++i) {
    if (const int sign = stop.signs[axle_root(i)]; sign != 0)
      note(sign < 0 ? DriveEvent::lifts : DriveEvent::lands, axles_[i].axle);
    if (stop.signs[axle_root(i) + 2] >= 0) continue;
    heading_[i] = -heading_[i], turns = true;
    bekker_wong::turn_about(y[axles_[i].at + axle_rolled],
                            std::span(y).subspan(axles_[i].at + axle_nodes, nodes_of(axles_[i])));
  }
  if (turns) integrator_->restart(y);
  return false;
}

double VehicleRide::line_rim_speed(std::span<const double> y) const {
  double sum = 0.0, wheels = 0.0;
  for (const RollingAxle& axle : axles_) {
    const VehicleAxle& about = question_.axles[axle.axle];
    if (about.driven == YesNo::no) continue;
    sum += axle.count * spin_of(axle, y) * about.tire.radius / (1.0 + about.lead), wheels += axle.count;
  }
  return sum / wheels;
}

VehicleDriveSample VehicleRide::sample(double t) const {
  const std::vector<double>& y = integrator_->state();
  std::vector<double> rates(y.size());
  const Look now = look(t, y, rates);
  VehicleDriveSample s;
  s.time = t, s.travelled = y[at_x], s.speed = y[at_speed], s.acceleration = now.acceleration;
  s.rim_speed = line_rim_speed(y), s.slip = drive_slip(s.rim_speed, s.speed, rim_);
  for (const double torque : now.torques) s.torque += torque;
  s.pull = now.place.drawbar, s.slope = now.place.longitudinal_incline;
  for (std::size_t i = 0; i < axles_.size(); ++i) {
    const RollingAxle& axle = axles_[i];
    const Instant& soil = now.soil[i];
    DrivenAxle& a = s.axles.emplace_back();
    a.normal_load = now.loads[i], a.rim_speed = spin_of(axle, y) * axle.in_soil.radius();
    a.slip = drive_slip(a.rim_speed, s.speed, rim_), a.contact_slip = soil.contact_slip;
    a.sinkage = y[axle.at + axle_depth] - soil.deflection;
    a.torque = soil.soil_torque + axle.in_soil.inertia() * axle.gear * now.spin_rates[axle.rotor];
    a.forward = soil.forward;
  }
  s.energy = bekker_wong::ledger_of(integrator_->sums(), in_motion(y));
  return s;
}

double VehicleRide::in_motion(std::span<const double> y) const {
  double energy = 0.5 * question_.mass * y[at_speed] * y[at_speed];
  for (const RollingAxle& axle : axles_)
    energy += 0.5 * axle.count * axle.mass * y[axle.at + axle_sinking] * y[axle.at + axle_sinking];
  for (std::size_t k = 0; k < rotors_.size(); ++k)
    energy += 0.5 * rotors_[k].inertia * y[rotor_at(k) + rotor_spin] * y[rotor_at(k) + rotor_spin];
  return energy;
}

void VehicleRide::tell_what_gave_out() {
  const std::vector<double>& y = integrator_->state();
  for (std::size_t k = 0; k < rotors_.size(); ++k)
    if (rotors_[k].motor)
      record_.at_motors_limit |= rotors_[k].motor->beyond(record_.end_time, y[rotor_at(k) + rotor_spin],
                                                          y[rotor_at(k) + rotor_error])[0] >= 0.0;
  if (record_.end != DriveEnd::stuck && record_.end != DriveEnd::rolled_back) return;
  const std::vector<DrivenAxle>& axles = record_.samples.back().axles;
  const auto share = [](const DrivenAxle& axle) {
    return axle.normal_load > 0.0 ? axle.forward / axle.normal_load : HUGE_VAL;
  };
  record_.gave_out = axles_[static_cast<std::size_t>(std::ranges::min_element(axles, {}, share) - axles.begin())].axle;
}

}  // namespace

VehicleDriveRecord drive_vehicle(const VehicleCase& question, const std::vector<VehicleWheel>& wheels, int samples,
                                 const bekker_wong::DriveNumerics& numerics,
                                 const bekker_wong::DriveProgress& progress) {
  if (samples < 1) throw InputError("a drive has at least one sample");
  return VehicleRide(question, wheels, numerics).run(samples, progress);
}

VehicleCase mirrored(VehicleCase vehicle) {
  for (VehicleAxle& axle : vehicle.axles) axle.x = -axle.x;
  vehicle.centre_of_gravity.x = -vehicle.centre_of_gravity.x;
  vehicle.hitch.at.x = -vehicle.hitch.at.x;
  return vehicle;
}

}  // namespace soilbin::compare
