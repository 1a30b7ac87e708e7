// A vehicle that travels steadily on soil: the load, slip and forces of each wheel, the pull that is left at the hitch,
// and where the power goes.
//
//   const SteadyVehicles truck(question, wheels, bekker_wong::BekkerWong({.errors = false, .patch = false}));
//   const SteadyVehicle climbs = truck.pulling({.slope = 0.1, .speed = 2.0});       // [rad], [m/s]
//   climbs.slip, climbs.wheels[0].result.at.load                                    // [-], [N]
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compare/vehicle/vehicle.hpp"
#include "scenario/errors.hpp"
#include "scenario/yawed_frames.hpp"

namespace soilbin::compare {

// How a vehicle stands on its wheels: the tilt that their sinkages give it, moments of forces on it, and the loads of
// its axles. Steady and in time.

/// The plane a + b x + c y through the wheels' sinkages, by least squares; b and c are 0 where nothing tells them.
struct SinkagePlane {
  double along = 0.0, across = 0.0;
};

SinkagePlane plane_through(const std::vector<VehiclePoint>& points);

/// A point of the vehicle in axes along the ground, when it is tilted [rad].
VehiclePoint tilted(const VehiclePoint& p, double nose_down, double left_down);

/// Sums of forces along the vehicle and of their moments about a point.
struct Wrench {
  double pitch = 0.0, roll = 0.0, yaw = 0.0;  ///< nose down, right side down, nose to the left [N m]

  void add(const VehiclePoint& at, const GroundForce& along, double up) {
    pitch += at.z * along.forward - at.x * up;
    roll += at.y * up - at.z * along.left;
    yaw += at.x * along.left - at.y * along.forward;
  }
};

/// What carries a vehicle that is alike on both sides: an axle with its wheels.
struct CarryingAxle {
  double stiffness = 1.0;  ///< of its wheels together, in any unit
  double spring = 0.0;     ///< x of its spring on the frame [m]
  double place = 0.0;      ///< x of its axle along the ground, when the vehicle is tilted [m]
};

/// Loads of axles normal to the ground [N], none negative: a rigid frame on springs, k_i (a + b x_i), which carries
/// `normal` [N] and balances the moment `pitch` [N m] of all else about x = 0, nose down: Sum N_i place_i = pitch. An
/// axle that would pull is off the ground. One axle is held level as in a rig; where one is left of several, it carries
/// all, and the vehicle tips over.
std::vector<double> axle_loads(const std::vector<CarryingAxle>& axles, double normal, double pitch);

// Its balance.

/// What ended a vehicle's balance.
enum class GaveOut {
  wheel,        ///< the model has no answer for one of its wheels
  pull,         ///< all its wheels together pull less than is asked of them, at every slip
  torque,       ///< so do they where motors give no more
  hold,         ///< braked by its drive line it runs away downhill, at every slip
  tips_over,    ///< it stands on the wheels of one side alone
  slides,       ///< nothing balances the forces across its travel
  backward,     ///< a wheel of a turn would roll backward
  soil_slides,  ///< the slope itself comes down, vehicle or not
};

/// There is no steady vehicle.
class VehicleGaveOut : public NoSolution {
 public:
  VehicleGaveOut(GaveOut why, std::optional<std::size_t> wheel, const std::string& words)
      : NoSolution(words), why_(why), wheel_(wheel) {}
  GaveOut why() const { return why_; }
  std::optional<std::size_t> wheel() const { return wheel_; }  ///< which wheel, where it is one

 private:
  GaveOut why_;
  std::optional<std::size_t> wheel_;
};

struct SteadyWheel {
  TractionResult result{};         ///< as the model answers; `at` holds its load, slip, yaw and pass
  double steer = 0.0;              ///< its plane, to the left of the vehicle [rad]
  double normal_load = 0.0;        ///< normal to the ground [N]
  double rim_speed = 0.0;          ///< r w [m/s]
  double power_in = 0.0;           ///< M w [W]
  double slip_loss = 0.0;          ///< (M/r) (r w - v) [W], v: its speed in its own plane
  double soil_loss = 0.0;          ///< (M/r) v less what pushes the vehicle along its travel, times its speed [W]
  bool backward = false;           ///< rolls backward; its result is that of the wheel turned round
  bool lifted = false;             ///< off the ground: no forces
  bool at_largest_torque = false;  ///< its motor gives no more, or turns no faster
};

/// Powers add up: into the wheels = drawbar + climbing + slip loss + soil loss.
struct VehiclePower {
  double into_wheels = 0.0;  ///< [W]
  double drawbar = 0.0;      ///< pull times speed [W]
  double climbing = 0.0;     ///< against gravity [W]; negative downhill
  double slip_loss = 0.0;    ///< [W]
  double soil_loss = 0.0;    ///< sinkage, bulldozing, drift of a wheel that stands across its travel [W]
};

struct SteadyVehicle {
  VehicleCondition at{};  ///< its pull: what is asked, where that was asked
  double slip = 0.0;      ///< of the drive line: by its mean rim speed
  double pull = 0.0;  ///< left at the hitch, along travel [N]; on the spot what is left to turn it, at the mean half
                      ///< track
  double crab = 0.0;  ///< by which the vehicle points to the left of its travel [rad]
  double steering = 0.0;    ///< of the steered axles, to the left of the vehicle [rad]; in a turn of the middle of the
                            ///< one farthest from the axles that are not
  double yaw_moment = 0.0;  ///< that nothing balances: a driver's hand must [N m], to the left positive
  double nose_down = 0.0;   ///< of the vehicle against the ground, by its wheels' sinkages [rad]
  double left_down = 0.0;   ///< [rad]
  std::vector<SteadyWheel> wheels{};
  VehiclePower power{};
};

/// A vehicle's steady states. A rigid frame on springs alike, or of the stiffness that the axles declare, so that the
/// loads lie in a plane over the wheels' places,
///
///   L_i = k_i (a + b x_i + c y_i) [N],  L_i >= 0,
///
/// with a, b, c from the balance of forces and moments. On the vehicle act its weight at the centre of gravity, the
/// pull at the hitch, and from the soil the model's answer for each wheel: at the axle's end the load, the force in the
/// wheel's plane and the couple -M_i, at the tread's lowest point the force across the wheel. So resistance and sinkage
/// shift loads by what they do to torque and pull, and unlike sinkages tilt the vehicle. The moment of the soil about a
/// wheel's upright (self-aligning) is left out. Of two axles with wheels on both sides this gives the textbook's loads
/// (Wong, Theory of Ground Vehicles, ch. 3). On a cross slope the vehicle crabs, and steered axles turn, until nothing
/// is left across its travel. In a turn each wheel travels as its place on the body does, steered wheels stand square
/// to one centre (Ackermann), where no axle is steered the sides' rim speeds differ, and the balance across holds the
/// centrifugal force too. On the spot the sides turn against each other about the centre at which nothing is left along
/// and across the vehicle; wheels that roll backward are turned round, and the pull is what is left to turn it, at the
/// mean half track. An open differential's two sides turn about their mean speed, each with its share of the torque:
///
///   M_1/s_1 = M_2/s_2,  s_1 w_1 + s_2 w_2 = w of what drives it,  s_1 + s_2 = 1,
///
/// s = 1/2 across an axle; at the centre by what the axles declare, M and w at shafts that turn alike where the rims
/// do but for their leads. Wheels in one axle alone keep their pitch as in a rig, and those in one track their roll.
/// Solved by gsl::system_root for each slip of the drive line.
class SteadyVehicles {
 public:
  /// What is referred to must outlive this. `model` answers for one wheel.
  SteadyVehicles(const VehicleCase& vehicle, const std::vector<VehicleWheel>& wheels, const Model& model)
      : vehicle_(vehicle), wheels_(wheels), model_(model) {}

  /// At a slip of the drive line, -1 < slip <= 1: the pull is what is left; that of the condition isn't read. Throws
  /// VehicleGaveOut.
  SteadyVehicle at_slip(const VehicleCondition& at, double slip) const;

  /// The smallest slip at which it pulls what the condition asks; braked by its drive line where it would run away.
  /// Throws VehicleGaveOut.
  SteadyVehicle pulling(const VehicleCondition& at) const;

  /// Where it pulls most, or, `braked`, least: of all slips, or, where one is given, on the hill at a slip `about`, or
  /// at the first slip with a balance where it has none there. Slips without a balance are passed over; throws what the
  /// first said where there is no other.
  SteadyVehicle at_most(const VehicleCondition& at, bool braked = false, const std::optional<double>& about = {}) const;

  /// Weight on the soil's gravity [N].
  double weight() const;
  /// Mean distance of the wheels from their middle line [m].
  double half_track() const;

 private:
  struct Trial;
  struct Modes;
  struct Turning;
  /// Rim speeds that are asked of the wheels over that of the drive line, which travels so fast [m/s].
  struct Rims {
    double travel = 0.0;
    std::vector<double> asked{};
  };
  /// Where the last search for a wheel's own slip, or for the speeds of a differential, ended.
  struct FoundRoot {
    double at = 0.0;
    double rise = 0.0;  ///< there, of what is missing; 0: none was found yet
  };
  struct Found {
    std::vector<FoundRoot> wheels, axles;
    FoundRoot centre;
  };
  Turning turn(const VehicleCondition& at, const Modes& modes, SteadyVehicle& vehicle) const;
  Turning turn_on_the_spot(const VehicleCondition& at, const Modes& modes, SteadyVehicle& vehicle) const;
  Modes modes(const VehicleCondition& at) const;
  /// The largest slip that is looked at. At 100 % a drive line turns without end: across an open differential nothing
  /// could then turn slower than the other side.
  double fastest() const;
  Trial trial(const VehicleCondition& at, double slip, const Modes& modes, std::span<const double> x,
              Found& found) const;
  SteadyWheel rolled(std::size_t wheel, const OperatingCondition& at) const;
  /// The wheel at the slip at which its torque is that of `torque(slip)`: from where the last search for it ended, as
  /// long as secants come much closer; else the one next to `from`, upward where its torque is less there, else
  /// downward.
  SteadyWheel free(std::size_t wheel, OperatingCondition at, const std::function<double(double)>& torque, double from,
                   FoundRoot& found) const;
  /// All axles, from the front: a rut is what the wheels before have made of it.
  void roll_axles(double slip, const Rims& rims, std::vector<OperatingCondition>& at, std::vector<SteadyWheel>& wheels,
                  Found& found) const;
  /// Turns the sides of a differential unlike until nothing is left of `unlike(x)`, what the first takes less what the
  /// second does, where the first is the faster the larger x is: 0. From where the last search ended, where `found`
  /// says so; else outward from equal speeds, 0. An x that is not answered (not a number) is approached in shorter
  /// steps. Where something is left up to `most` to either side: 1 where the first side runs away, else -1.
  static int balance_differential(const std::function<double(double)>& unlike, double most, double f_tol,
                                  FoundRoot* found);
  void roll_axle(std::size_t axle, double slip, const Rims& rims, std::vector<OperatingCondition>& at,
                 std::vector<SteadyWheel>& wheels, Found& found) const;

  const VehicleCase& vehicle_;
  const std::vector<VehicleWheel>& wheels_;
  const Model& model_;
};

/// The wheel that gives least for its load: the one to look at where the pull of all is too little.
std::size_t weakest_wheel(const SteadyVehicle& vehicle);

/// Why a vehicle that pulls most (braked: least) like this doesn't pull what is asked.
GaveOut why_too_little(const SteadyVehicle& most, bool braked);

}  // namespace soilbin::compare
