#include "compare/vehicle/steady_vehicle.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "bekker_wong/gsl.hpp"
#include "bekker_wong/gsl_systems.hpp"
#include "scenario/soil.hpp"

namespace soilbin::compare {
namespace {

constexpr double aimed_residual = 1e-13;  // what the search for a balance aims at, as a share of the weight
constexpr double good_residual = 1e-9;    // what counts as one
constexpr double lifts = 1e-9;            // share of the weight below which a wheel is off the ground
constexpr double most_braked = -0.95;     // a locked wheel has no speed ratio
constexpr double scanned_slip = 0.05;
constexpr double half_turn = std::numbers::pi;
constexpr double across = 1.5;  // [rad] 86 deg: a wheel that stands farther across its travel is about to roll backward

/// An angle within 40 deg of straight on, from an unknown that has no bounds: two of them stay below 90 deg.
double turn_of(double unknown) {
  constexpr double most = 0.7;
  return most * std::tanh(unknown / most);
}

constexpr double nearly_all = 0.999;  // of its speed, that a side of a differential loses

}  // namespace

/// The unknowns of a balance: which of them there are, and their scales.
struct SteadyVehicles::Modes {
  double stiffness = 0.0;            ///< of all wheels
  double x0 = 0.0, y0 = 0.0;         ///< middle of the springs [m]
  double length = 0.0, width = 0.0;  ///< the farthest wheel from it [m]; 0: held as in a rig
  bool pitches = false, rolls = false, crabs = false, steers = false;
  // In a turn:
  double middle = 0.0;      ///< x of the line across the vehicle on which the turn's centre lies, without side slip [m]
  double lever = 0.0;       ///< from there to the steered axle farthest from it; 0: its sides turn unlike [m]
  double half_track = 0.0;  ///< mean distance of the wheels from the middle line [m]

  std::size_t count() const {
    return 1 + static_cast<std::size_t>(pitches) + static_cast<std::size_t>(rolls) + static_cast<std::size_t>(crabs) +
           static_cast<std::size_t>(steers);
  }
};

struct SteadyVehicles::Trial {
  SteadyVehicle vehicle{};
  std::vector<double> rest{};  ///< what is left of each balance, as a share of the weight
};

/// How each wheel moves in a turn, and in straight travel.
struct SteadyVehicles::Turning {
  std::vector<double> speeds{};    ///< of travel [m/s]
  std::vector<double> headings{};  ///< of its travel, to the left of that of the centre of gravity [rad]
  std::vector<double> steer{};     ///< of the wheel, to the left of the vehicle [rad]
  std::vector<double> rims{};      ///< rim speed that is asked of it over that of the drive line, without leads
};

/// Crab and steering of `vehicle` bring the centre of the turn, in lengths and half tracks from the wheels' middle, and
/// are none.
SteadyVehicles::Turning SteadyVehicles::turn_on_the_spot(const VehicleCondition& at, const Modes& m,
                                                         SteadyVehicle& vehicle) const {
  const double x = m.x0 + m.length * std::exchange(vehicle.crab, 0.0),
               y = m.y0 + m.half_track * std::exchange(vehicle.steering, 0.0);
  Turning all;
  for (const VehicleWheel& wheel : wheels_) {
    const double forward = (y - wheel.place.y) / m.half_track, left = (wheel.place.x - x) / m.half_track;
    all.speeds.push_back(at.speed * std::hypot(forward, left));
    all.headings.push_back(std::atan2(left, forward));
    all.steer.push_back(forward < 0.0 ? std::copysign(half_turn, left) : 0.0);
    all.rims.push_back(1.0);
  }
  return all;
}

/// `vehicle` brings crab and steering beyond those of a turn without side slip, and gets them as they are.
SteadyVehicles::Turning SteadyVehicles::turn(const VehicleCondition& at, const Modes& m, SteadyVehicle& vehicle) const {
  if (at.on_the_spot) return turn_on_the_spot(at, m, vehicle);
  const double curvature = at.curvature, x_g = vehicle_.centre_of_gravity.x, y_g = vehicle_.centre_of_gravity.y;
  Turning all;
  double steered_curvature = 0.0;  // of the turn to whose centre the steered wheels stand square
  double unlike = 0.0;             // of the sides' rim speeds
  if (curvature != 0.0) {
    vehicle.crab -= std::asin(std::clamp(curvature * (x_g - m.middle), -0.9, 0.9));
    const double straight_on = curvature / std::cos(vehicle.crab);
    constexpr double farthest = 1.5;  // [rad]
    if (m.lever != 0.0) {
      vehicle.steering = std::clamp(vehicle.steering + std::atan(straight_on * m.lever), -farthest, farthest);
      steered_curvature = std::tan(vehicle.steering) / m.lever;
    } else {
      unlike = std::exchange(vehicle.steering, 0.0) + straight_on * m.half_track;
    }
  }
  const double c = std::cos(vehicle.crab), s = std::sin(vehicle.crab);
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    const VehicleWheel& wheel = wheels_[i];
    const double dx = wheel.place.x - x_g, dy = wheel.place.y - y_g;
    const double forward = 1.0 - curvature * (dx * s + dy * c), left = curvature * (dx * c - dy * s);  // over the speed
    all.speeds.push_back(at.speed * std::hypot(forward, left));
    all.headings.push_back(std::atan2(left, forward));
    const bool steered = is_steered(vehicle_.axles[wheel.axle]);
    all.steer.push_back(!steered           ? 0.0
                        : curvature == 0.0 ? vehicle.steering
                                           : std::atan2(steered_curvature * (wheel.place.x - m.middle),
                                                        1.0 - steered_curvature * (wheel.place.y - m.y0)));
    double rim = 1.0;
    if (curvature != 0.0 && m.lever == 0.0) {
      constexpr double slowest = 1e-3;
      const double beside = wheel.place.y - m.y0;
      const double side = std::abs(beside) > in_one_place ? std::copysign(1.0, beside) : 0.0;
      rim = std::max(1.0 - side * unlike, slowest);
    } else if (curvature != 0.0 && vehicle_.drive_line == DriveLine::motors) {
      rim = std::hypot(forward, left);
    }
    all.rims.push_back(rim);
  }
  return all;
}

double SteadyVehicles::weight() const { return vehicle_.mass * gravity_of(vehicle_.soil); }

double SteadyVehicles::half_track() const { return modes({.on_the_spot = true}).half_track; }

SteadyVehicles::Modes SteadyVehicles::modes(const VehicleCondition& at) const {
  Modes m;
  const auto stiffness = [&](const VehicleWheel& wheel) { return vehicle_.axles[wheel.axle].stiffness.value_or(1.0); };
  for (const VehicleWheel& wheel : wheels_) {
    const double k = stiffness(wheel);
    m.stiffness += k, m.x0 += k * wheel.place.x, m.y0 += k * wheel.place.y;
  }
  m.x0 /= m.stiffness, m.y0 /= m.stiffness;
  for (const VehicleWheel& wheel : wheels_) {
    m.length = std::max(m.length, std::abs(wheel.place.x - m.x0));
    m.width = std::max(m.width, std::abs(wheel.place.y - m.y0));
  }
  m.pitches = m.length > in_one_place, m.rolls = m.width > in_one_place;
  const bool lopsided = std::abs(vehicle_.centre_of_gravity.y - m.y0) > in_one_place ||
                        std::abs(vehicle_.hitch.at.y - m.y0) > in_one_place;
  m.crabs = m.pitches && (at.cross_slope != 0.0 || (m.rolls && lopsided));
  m.steers = m.crabs && std::ranges::any_of(vehicle_.axles, is_steered);
  if (at.curvature == 0.0 && !at.on_the_spot) return m;
  m.crabs = m.steers = true;
  const bool all_steered = std::ranges::all_of(vehicle_.axles, is_steered);
  double held = 0.0;
  for (const VehicleAxle& axle : vehicle_.axles)
    if (all_steered || !is_steered(axle)) m.middle += axle.x, held += 1.0;
  m.middle /= held;
  for (const VehicleAxle& axle : vehicle_.axles)
    if (is_steered(axle) && std::abs(axle.x - m.middle) > std::abs(m.lever)) m.lever = axle.x - m.middle;
  for (const VehicleWheel& wheel : wheels_)
    m.half_track += std::abs(wheel.place.y - m.y0) / static_cast<double>(wheels_.size());
  return m;
}

SteadyWheel SteadyVehicles::rolled(std::size_t wheel, const OperatingCondition& at) const {
  SteadyWheel steady;
  if (at.load <= 0.0) {
    steady.lifted = true;
    steady.result.at = at;
    return steady;
  }
  try {
    steady.result = model_.evaluate(wheels_[wheel].scenario, at);
  } catch (const NoSolution& error) {
    throw VehicleGaveOut(GaveOut::wheel, wheel, error.what());
  }
  return steady;
}

SteadyWheel SteadyVehicles::free(std::size_t wheel, OperatingCondition at, const std::function<double(double)>& torque,
                                 double from, FoundRoot& found) const {
  SteadyWheel steady;
  const auto missing = [&](double slip) {
    at.slip = slip;
    steady = rolled(wheel, at);
    return steady.result.torque.value - torque(slip);
  };
  const double whole = at.load * wheels_[wheel].scenario.tire.radius;
  constexpr double small = 1e-13, rounding = 1e-12;  // shares of it: aimed at; what the wheel's own balance leaves
  const bool known = found.rise > 0.0;
  double here = known ? found.at : from, f = missing(here);
  if (steady.lifted) return steady;
  const auto rolls_at = [&](double slip) {
    found.at = slip;
    steady.result.torque.value = torque(slip);  // as it is defined, without what the search leaves
    return steady;
  };
  const auto between = [&](const gsl::Sample& a, const gsl::Sample& b) {
    found.rise = (b.f - a.f) / (b.x - a.x);
    return rolls_at(gsl::bracketed_root(missing, a, b, 1e-15, 0.01 * small * whole, "the slip at a torque"));
  };
  // By secants from where the last search ended, as long as they come closer.
  for (bool closer = known; closer && std::abs(f) > small * whole;) {
    const gsl::Sample before{here, f};
    here = std::clamp(here - f / found.rise, most_braked, 1.0);
    if (here == before.x) break;
    f = missing(here);
    closer = std::abs(f) < 0.5 * std::abs(before.f);
    if (closer) found.rise = (f - before.f) / (here - before.x);
    if (!closer && std::abs(f) > rounding * whole && (f < 0.0) != (before.f < 0.0)) return between(before, {here, f});
  }
  if (std::abs(f) <= (known ? rounding * whole : 0.0)) return rolls_at(here);
  const double direction = f < 0.0 ? 1.0 : -1.0, end = f < 0.0 ? 1.0 : most_braked;
  for (double step = 0.01; here != end; step *= 1.5) {
    const double next = direction > 0 ? std::min(here + step, end) : std::max(here - step, end);
    const double g = missing(next);
    if ((g < 0.0) != (f < 0.0) || g == 0.0) return between({here, f}, {next, g});
    here = next, f = g;
  }
  throw VehicleGaveOut(GaveOut::wheel, wheel,
                       torque(end) == 0.0 ? "no slip at which it rolls freely" : "no slip gives its torque");
}

int SteadyVehicles::balance_differential(const std::function<double(double)>& unlike, double most, double f_tol,
                                         FoundRoot* found) {
  const auto note = [&](double at, double rise) {
    if (found != nullptr) *found = {at, rise};
  };
  const bool known = found != nullptr && found->rise > 0.0;
  double here = known ? found->at : 0.0, f = unlike(here);
  // By secants from where the last search ended, as long as they come closer.
  for (bool closer = known; closer && std::abs(f) > 10 * f_tol;) {
    const double before = here, at_before = f;
    here = std::clamp(before - at_before / found->rise, -most, most);
    if (here == before) break;
    f = unlike(here);
    closer = std::abs(f) < 0.5 * std::abs(at_before);
    if (closer) found->at = here, found->rise = (f - at_before) / (here - before);
  }
  if (f == 0.0 || (known && std::abs(f) <= 1000 * f_tol)) return 0;
  if (known && std::isnan(f)) here = 0.0, f = unlike(here);
  const int direction = f < 0.0 ? 1 : -1;
  for (double step = 0.01; here != direction * most && !std::isnan(f); step *= 1.5) {
    const double next = std::clamp(here + direction * step, -most, most), g = unlike(next);
    if (std::isnan(g)) {
      if (step < 1e-6) break;
      step /= 6;
      continue;
    }
    if ((g < 0.0) != (f < 0.0) || g == 0.0) {
      const double root = gsl::bracketed_root(unlike, {here, f}, {next, g}, 1e-15, f_tol, "the speeds at equal torque");
      unlike(root);
      note(root, (g - f) / (next - here));
      return 0;
    }
    here = next, f = g;
  }
  note(0.0, 0.0);
  return direction;
}

void SteadyVehicles::roll_axle(std::size_t axle, double slip, const Rims& rims, std::vector<OperatingCondition>& at,
                               std::vector<SteadyWheel>& wheels, Found& found) const {
  const VehicleAxle& about = vehicle_.axles[axle];
  std::vector<std::size_t> mine;
  for (std::size_t i = 0; i < wheels_.size(); ++i)
    if (wheels_[i].axle == axle) mine.push_back(i);
  for (const std::size_t i : mine) {  // the heaviest wheel made the rut; the last one left its soil as it is
    double heaviest = 0.0;
    for (const std::size_t before : wheels_[i].in_rut_of) {
      const OperatingCondition& was = wheels[before].result.at;
      if (!wheels[before].lifted) heaviest = std::max(heaviest, was.load), at[i].rut_slip = was.slip;
    }
    if (heaviest > 0.0) at[i].rut_load = heaviest;
  }
  const auto no_torque = [](double) { return 0.0; };
  /// The slip at a rim speed `faster` times that of the drive line.
  const auto slip_at = [&](std::size_t i, double faster) {
    const double share =
        std::cos(at[i].yaw) * (at[i].speed / rims.travel) / ((1.0 + about.lead) * rims.asked[i] * faster);
    return share == 1.0 ? slip : std::max(slip_of_ratio(speed_ratio(slip) * share), most_braked);
  };
  const auto roll = [&](std::size_t i, double faster) {
    at[i].slip = slip_at(i, faster);
    wheels[i] = rolled(i, at[i]);
    return wheels[i].result.torque.value;
  };
  /// The wheel that is asked the same as the one beside it answers the same.
  const auto each = [&](const auto& answer) {
    const bool twins = mine.size() == 2 && at[mine[0]] == at[mine[1]] && rims.asked[mine[0]] == rims.asked[mine[1]];
    for (const std::size_t i : mine) {
      if (twins && i == mine[1])
        wheels[i] = wheels[mine[0]];
      else
        answer(i);
    }
  };
  if (about.driven == YesNo::no) {
    each([&](std::size_t i) { wheels[i] = free(i, at[i], no_torque, 0.0, found.wheels[i]); });
  } else if (vehicle_.is_open(about) && mine.size() == 2) {
    const std::size_t left = mine[0], right = mine[1];
    if (at[left].load <= 0.0 || at[right].load <= 0.0) {  // a wheel in the air takes no torque, nor does the other
      for (const std::size_t i : mine) wheels[i] = free(i, at[i], no_torque, 0.0, found.wheels[i]);
      return;
    }
    const auto unlike = [&](double d) { return roll(left, 1.0 + d) - roll(right, 1.0 - d); };
    FoundRoot* last = vehicle_.has_open_centre() ? &found.axles[axle] : nullptr;
    const int runs_away = balance_differential(unlike, nearly_all, 1e-15 * weight() * about.tire.radius, last);
    if (runs_away != 0)
      throw VehicleGaveOut(GaveOut::wheel, runs_away > 0 ? left : right,
                           "its differential turns it without end: it takes less torque than the other wheel");
  } else {
    each([&](std::size_t i) {
      const auto largest = [&, in_plane = at[i].speed * std::cos(at[i].yaw)](double at_slip) {
        if (!about.motor) return about.largest_torque.value_or(HUGE_VAL);
        const double spin = in_plane / speed_ratio(at_slip) / about.tire.radius;
        return spin > top_spin(*about.motor) ? 0.0 : torque_at_wheels(*about.motor, spin);
      };
      if (roll(i, 1.0) > largest(at[i].slip)) {
        wheels[i] = free(i, at[i], largest, at[i].slip, found.wheels[i]);
        wheels[i].at_largest_torque = true;
      }
    });
  }
}

void SteadyVehicles::roll_axles(double slip, const Rims& rims, std::vector<OperatingCondition>& at,
                                std::vector<SteadyWheel>& wheels, Found& found) const {
  const auto roll = [&](const Rims& asked) {
    for (std::size_t i = 0; i < wheels_.size(); ++i)
      if (i == 0 || wheels_[i].axle != wheels_[i - 1].axle) roll_axle(wheels_[i].axle, slip, asked, at, wheels, found);
  };
  if (!vehicle_.has_open_centre()) return roll(rims);
  /// One of its sides: a driven axle.
  struct Side {
    std::size_t axle = 0, wheel = 0;  ///< its first one
    double share = 0.0;
  };
  std::vector<Side> sides;
  for (std::size_t i = 0; i < wheels_.size(); ++i)
    if (const VehicleAxle& axle = vehicle_.axles[wheels_[i].axle];
        axle.driven == YesNo::yes && (sides.empty() || sides.back().axle != wheels_[i].axle))
      sides.push_back({wheels_[i].axle, i, axle.torque_share.value_or(1.0)});
  const double whole = sides[0].share + sides[1].share;
  const double first = sides[0].share / whole, second = sides[1].share / whole;
  /// Torque of an axle at its shaft over its share of the whole, at the rim [N].
  const auto taken = [&](const Side& side) {
    double torque = 0.0;
    for (std::size_t i = 0; i < wheels_.size(); ++i)
      if (wheels_[i].axle == side.axle) torque += wheels[i].result.torque.value;
    const VehicleAxle& axle = vehicle_.axles[side.axle];
    return torque * (1.0 + axle.lead) / axle.tire.radius / (side.share / whole);
  };
  std::optional<VehicleGaveOut> said;
  // Its slower side is slower by exp(-|x|), so that no step brakes its wheels where the other's still drive.
  const auto unlike = [&](double x) {
    const double slower = std::exp(-std::abs(x));
    const double speed_1 = x < 0.0 ? slower : (1.0 - second * slower) / first,
                 speed_2 = x < 0.0 ? (1.0 - first * slower) / second : slower;
    Rims asked = rims;
    for (std::size_t i = 0; i < wheels_.size(); ++i)
      asked.asked[i] *= wheels_[i].axle == sides[0].axle ? speed_1 : wheels_[i].axle == sides[1].axle ? speed_2 : 1.0;
    try {
      roll(asked);
    } catch (const VehicleGaveOut& error) {
      if (!said) said = error;
      return not_a_number;
    }
    return taken(sides[0]) - taken(sides[1]);
  };
  const int runs_away = balance_differential(unlike, -std::log(1.0 - nearly_all), 1e-15 * weight(), &found.centre);
  if (runs_away == 0) return;
  if (said) throw VehicleGaveOut(*said);
  throw VehicleGaveOut(GaveOut::wheel, sides[runs_away > 0 ? 0 : 1].wheel,
                       "the centre differential turns its axle without end: it takes less torque than the other one");
}

SteadyVehicles::Trial SteadyVehicles::trial(const VehicleCondition& at, double slip, const Modes& m,
                                            std::span<const double> x, Found& found) const {
  Trial trial;
  SteadyVehicle& v = trial.vehicle;
  v.at = at, v.slip = slip;
  std::size_t next = 1;
  const double pitched = m.pitches ? x[next++] : 0.0, rolled_over = m.rolls ? x[next++] : 0.0;
  v.crab = m.crabs ? turn_of(x[next++]) : 0.0, v.steering = m.steers ? turn_of(x[next++]) : 0.0;
  const double G = weight(), a = at.slope, b = at.cross_slope;
  const double centrifugal = vehicle_.mass * at.speed * at.speed * at.curvature;  // to the right
  const Turning turning = turn(at, m, v);
  Rims rims{at.speed, turning.rims};
  std::vector<OperatingCondition> conditions;
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    const VehicleWheel& wheel = wheels_[i];
    double share = x[0];
    if (m.pitches) share += pitched * (wheel.place.x - m.x0) / m.length;
    if (m.rolls) share += rolled_over * (wheel.place.y - m.y0) / m.width;
    const double load = G * (vehicle_.axles[wheel.axle].stiffness.value_or(1.0) / m.stiffness) * share;
    conditions.push_back({.load = load > lifts * G ? load : 0.0,
                          .speed = turning.speeds[i],
                          .longitudinal_incline = a,
                          .transverse_incline = b,
                          .yaw = std::clamp(v.crab + turning.steer[i] - turning.headings[i], -across, across),
                          .pass = wheel.pass()});
  }
  v.wheels.resize(wheels_.size());
  roll_axles(slip, rims, conditions, v.wheels, found);

  double pull = 0.0, left = 0.0, load = 0.0;
  std::vector<VehiclePoint> sunk;
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    const TractionResult& r = v.wheels[i].result;
    const GroundForce net = turned({r.drawbar_pull.value, r.lateral_force.value}, turning.headings[i],
                                   ForceFrame::wheel, ForceFrame::travel);
    pull += net.forward, left += net.left, load += r.at.load;
    if (!v.wheels[i].lifted) sunk.push_back({wheels_[i].place.x, wheels_[i].place.y, r.sinkage.value});
  }
  const double along = std::sin(a), across = std::cos(a) * std::sin(b), up = std::cos(a) * std::cos(b);
  if (!at.on_the_spot) v.pull = (pull + (load - G) * along) / std::cos(vehicle_.hitch.angle);
  if (!sunk.empty()) {
    const SinkagePlane plane = plane_through(sunk);
    v.nose_down = std::atan(plane.along), v.left_down = std::atan(plane.across);
  }
  const auto place = [&](const VehiclePoint& point) { return tilted(point, v.nose_down, v.left_down); };
  const auto along_vehicle = [&](double forward, double to_left) {
    return turned({forward, to_left}, v.crab, ForceFrame::travel, ForceFrame::wheel);
  };
  Wrench sum;
  sum.add(place(vehicle_.centre_of_gravity), along_vehicle(-G * along, -G * across - centrifugal), -G * up);
  sum.add(place(vehicle_.hitch.at), along_vehicle(-v.pull * std::cos(vehicle_.hitch.angle), 0.0),
          -v.pull * std::sin(vehicle_.hitch.angle));
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    SteadyWheel& wheel = v.wheels[i];
    const TractionResult& r = wheel.result;
    wheel.normal_load = r.at.load * up;
    const double forward = r.drawbar_pull.value + r.at.load * along, torque = r.torque.value;
    const double steer = r.at.yaw - v.crab + turning.headings[i];
    wheel.backward = at.on_the_spot && std::abs(steer) > 0.5 * half_turn;
    wheel.steer = wheel.backward ? steer - std::copysign(half_turn, steer) : steer;
    const GroundForce soil =
        turned({forward, r.lateral_force.value + r.at.load * across}, r.at.yaw, ForceFrame::travel, ForceFrame::wheel);
    const auto from_wheel = [&](const GroundForce& force) {
      return turned(force, steer, ForceFrame::wheel, ForceFrame::travel);
    };
    VehiclePoint ground = wheels_[i].place;
    ground.z = 0.0;
    sum.add(place(wheels_[i].place), from_wheel({soil.forward, 0.0}), wheel.normal_load);
    sum.add(place(ground), from_wheel({0.0, soil.left}), 0.0);
    sum.pitch -= torque * std::cos(steer), sum.roll += torque * std::sin(steer);
    if (wheel.lifted) continue;
    const double in_plane = r.at.speed * std::cos(r.at.yaw), rim = torque / wheels_[i].scenario.tire.radius;
    wheel.rim_speed = in_plane / speed_ratio(r.at.slip);
    wheel.power_in = torque == 0.0 ? 0.0 : rim * wheel.rim_speed;
    wheel.slip_loss = torque == 0.0 ? 0.0 : rim * (wheel.rim_speed - in_plane);
    wheel.soil_loss = rim * in_plane - forward * r.at.speed;
    v.power.into_wheels += wheel.power_in, v.power.slip_loss += wheel.slip_loss, v.power.soil_loss += wheel.soil_loss;
  }
  const VehiclePoint &centre = vehicle_.centre_of_gravity, &hitch = vehicle_.hitch.at;
  const double hitch_left = (hitch.x - centre.x) * std::sin(v.crab) + (hitch.y - centre.y) * std::cos(v.crab);
  const double hitch_speed = at.speed * (1.0 - at.curvature * hitch_left);
  v.power.drawbar = v.pull * std::cos(vehicle_.hitch.angle) * hitch_speed, v.power.climbing = G * along * at.speed;
  v.yaw_moment = sum.yaw;

  trial.rest.push_back((load - G - v.pull * std::sin(vehicle_.hitch.angle) / up) / G);
  if (m.pitches) trial.rest.push_back(sum.pitch / (G * m.length));
  if (m.rolls) trial.rest.push_back(sum.roll / (G * m.width));
  if (m.crabs) trial.rest.push_back((left + (load - G) * across - centrifugal) / G);
  if (m.steers) trial.rest.push_back(at.on_the_spot ? pull / G : sum.yaw / (G * m.length));
  if (at.on_the_spot) v.pull = sum.yaw / m.half_track;
  return trial;
}

double SteadyVehicles::fastest() const {
  const auto is_open = [&](const VehicleAxle& axle) { return axle.driven == YesNo::yes && vehicle_.is_open(axle); };
  return vehicle_.has_open_centre() || std::ranges::any_of(vehicle_.axles, is_open) ? 0.99 : 1.0;
}

SteadyVehicle SteadyVehicles::at_slip(const VehicleCondition& at, double slip) const {
  const Modes m = modes(at);
  std::vector<double> start(m.count(), 0.0);
  start[0] = 1.0;
  Found found_slips{std::vector<FoundRoot>(wheels_.size()), std::vector<FoundRoot>(vehicle_.axles.size()), {}};
  Trial last;
  std::vector<double> last_x;  // of `last`
  const auto rest = [&](std::span<const double> x, std::span<double> f) {
    constexpr double far_off = 10.0;  // shares of the weight: the search takes a shorter step
    try {
      last_x.clear();
      last = trial(at, slip, m, x, found_slips);
      last_x.assign(x.begin(), x.end());
      std::ranges::copy(last.rest, f.begin());
    } catch (const VehicleGaveOut&) {
      if (at.curvature == 0.0 && !at.on_the_spot) throw;
      std::ranges::fill(f, far_off);
    }
  };
  const gsl::SystemRoot root = gsl::system_root(rest, std::move(start), aimed_residual);
  SteadyVehicle found = last_x == root.x ? std::move(last.vehicle) : trial(at, slip, m, root.x, found_slips).vehicle;
  for (std::size_t i = 0; i < found.wheels.size(); ++i)
    if (std::abs(found.wheels[i].result.at.yaw) >= across)
      throw VehicleGaveOut(GaveOut::backward, i, "it would have to roll backward or straight across");
  if (root.residual <= good_residual) return found;
  if (std::ranges::any_of(found.wheels, &SteadyWheel::lifted))
    throw VehicleGaveOut(GaveOut::tips_over, std::nullopt, "it tips over");
  throw VehicleGaveOut(GaveOut::slides, std::nullopt, "no balance of the forces across its travel: it slides");
}

SteadyVehicle SteadyVehicles::at_most(const VehicleCondition& at, bool braked,
                                      const std::optional<double>& about) const {
  const double sign = braked ? -1.0 : 1.0;
  std::optional<VehicleGaveOut> said;
  const auto height = [&](double slip) {
    try {
      return sign * at_slip(at, slip).pull;
    } catch (const VehicleGaveOut& error) {
      if (!said) said = error;
      return -HUGE_VAL;
    }
  };
  const double first = braked ? most_braked : 0.0, last = braked ? 0.0 : fastest();
  std::vector<gsl::Sample> samples;
  for (int i = 0; first + i * scanned_slip < last; ++i) samples.push_back({first + i * scanned_slip, 0.0});
  samples.push_back({last, 0.0});
  std::vector<bool> asked(samples.size());
  const auto ask = [&](std::size_t i) {
    if (!asked[i]) samples[i].f = height(samples[i].x), asked[i] = true;
    return samples[i].f;
  };
  const auto top_of_hill = [&](std::size_t from) {
    for (std::size_t i = from;;) {
      const std::size_t left = i > 0 ? i - 1 : i, right = std::min(i + 1, samples.size() - 1);
      const std::size_t higher = ask(right) > ask(i) ? right : ask(left) > ask(i) ? left : i;
      if (higher == i) return i;
      i = higher;
    }
  };
  std::size_t i = 0;
  if (about) {
    i = top_of_hill(static_cast<std::size_t>(std::lround((*about - first) / scanned_slip)));
    for (std::size_t k = 0; samples[i].f == -HUGE_VAL && k < samples.size(); ++k)
      if (ask(k) > -HUGE_VAL) i = top_of_hill(k);
  } else {
    for (std::size_t k = 0; k < samples.size(); ++k) ask(k);
    i = static_cast<std::size_t>(std::ranges::max_element(samples, {}, &gsl::Sample::f) - samples.begin());
  }
  const auto top = samples.begin() + static_cast<std::ptrdiff_t>(i);
  if (top->f == -HUGE_VAL) throw VehicleGaveOut(*said);
  gsl::Sample best = *top;
  if (i > 0 && i + 1 < samples.size()) {
    const double floor = top->f - weight();  // where there is no balance
    const auto finite_height = [&](double slip) { return std::max(height(slip), floor); };
    best = gsl::bracketed_maximum(finite_height,
                                  {{samples[i - 1].x, std::max(samples[i - 1].f, floor)},
                                   best,
                                   {samples[i + 1].x, std::max(samples[i + 1].f, floor)}},
                                  1e-6, HUGE_VAL, "the slip of the largest pull");
  }
  return at_slip(at, best.x);
}

SteadyVehicle SteadyVehicles::pulling(const VehicleCondition& at) const {
  const auto missing = [&](double slip) { return at_slip(at, slip).pull - at.pull; };
  std::optional<VehicleGaveOut> said;
  gsl::Sample before, first;
  double silent = 0.0;                  // the last slip without a balance before the first one with
  bool answered = false, ever = false;  // just before, and at any slip
  const auto root = [&](const gsl::Sample& from, const gsl::Sample& to) {
    return at_slip(at, gsl::bracketed_root(missing, from, to, 1e-13, 1e-12 * weight(), "the slip that gives a pull"));
  };
  // From no slip outward: upward while it pulls too little, else downward.
  double direction = 0.0;
  for (int step = 0; scanned_slip * step <= (direction < 0.0 ? -most_braked : fastest()) + scanned_slip / 2; ++step) {
    const double slip =
        direction < 0.0 ? std::max(-step * scanned_slip, most_braked) : std::min(step * scanned_slip, fastest());
    try {
      const double f = missing(slip);
      if (f == 0.0) return at_slip(at, slip);
      if (answered && (before.f < 0.0) != (f < 0.0)) return root(before, {slip, f});
      before = {slip, f}, answered = true;
      if (!ever) first = before, ever = true;
      if (direction == 0.0) direction = f < 0.0 ? 1.0 : -1.0;
    } catch (const VehicleGaveOut& error) {
      if (!said) said = error;
      answered = false;
      if (!ever) silent = slip;
      if (direction == 0.0) direction = 1.0;
    }
  }
  if (!ever) throw VehicleGaveOut(*said);
  // In a tight turn the smallest slips may have no balance: where the first one with pulls too much, on toward them.
  gsl::Sample enough = first;
  constexpr double close = 1e-4;
  while (said && first.f > 0.0 && enough.x - silent > close) {
    const double slip = 0.5 * (silent + enough.x);
    try {
      const gsl::Sample middle{slip, missing(slip)};
      if (middle.f <= 0.0) return root(middle, enough);
      enough = middle;
    } catch (const VehicleGaveOut&) {
      silent = slip;
    }
  }
  const bool braked = direction < 0.0;
  const SteadyVehicle most = at_most(at, braked);  // it may lie between two of the slips above
  const gsl::Sample farthest{most.slip, most.pull - at.pull};
  if (first.f < 0.0 && farthest.f >= 0.0) return root(first, farthest);
  if (first.f > 0.0 && farthest.f <= 0.0) return root(first, farthest);
  if (said) throw VehicleGaveOut(*said);
  const GaveOut why = why_too_little(most, braked);
  throw VehicleGaveOut(why, weakest_wheel(most),
                       braked                   ? "its braked wheels do not hold it"
                       : why == GaveOut::torque ? "its motors give too little torque at every slip"
                                                : "its wheels pull too little at every slip");
}

std::size_t weakest_wheel(const SteadyVehicle& vehicle) {
  std::size_t weakest = 0;
  const auto share = [](const SteadyWheel& wheel) {
    return wheel.lifted ? -HUGE_VAL : wheel.result.drawbar_pull.value / wheel.result.at.load;
  };
  for (std::size_t i = 1; i < vehicle.wheels.size(); ++i)
    if (share(vehicle.wheels[i]) < share(vehicle.wheels[weakest])) weakest = i;
  return weakest;
}

GaveOut why_too_little(const SteadyVehicle& most, bool braked) {
  if (braked) return GaveOut::hold;
  return std::ranges::any_of(most.wheels, &SteadyWheel::at_largest_torque) ? GaveOut::torque : GaveOut::pull;
}

}  // namespace soilbin::compare
