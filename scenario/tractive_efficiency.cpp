#include "scenario/tractive_efficiency.hpp"

#include <algorithm>
#include <cmath>

#include "scenario/yawed_frames.hpp"

namespace soilbin {
namespace {

/// v/w [m]: how far the wheel travels a radian of its rotation; NaN for a locked wheel.
double travel_per_radian(const OperatingCondition& at, double radius) {
  if (at.slip <= -1.0) return not_a_number;
  const double in_plane = radius * speed_ratio(at.slip);
  return at.slip_by == SlipBy::wheel_plane_speed ? in_plane / std::cos(at.yaw) : in_plane;
}

/// The force with which gravity pulls a wheel down the slope along its travel; 0 on level ground and uphill [N].
double downhill_force(const OperatingCondition& at) {
  return std::max(0.0, -at.load * std::sin(at.longitudinal_incline));
}

/// Power put in over v: the force along travel that would put it in [N].
double force_put_in(const TractionResult& result) { return pull_along_travel(result) / result.tractive_efficiency; }

}  // namespace

double pull_along_travel(const TractionResult& result) {
  const OperatingCondition& at = result.at;
  if (at.force_frame == ForceFrame::travel || at.yaw == 0.0) return result.drawbar_pull.value;
  const GroundForce given{result.drawbar_pull.value, result.lateral_force.value};
  return turned(given, at.yaw, at.force_frame, ForceFrame::travel).forward;
}

double tractive_efficiency(const TractionResult& result, double radius) {
  const double torque = result.torque.value;
  if (!(torque > 0.0)) return not_a_number;
  const double advance = travel_per_radian(result.at, radius);
  return pull_along_travel(result) * advance / (torque + downhill_force(result.at) * advance);
}

bool has_efficiency(const TractionResult& result) {
  return result.torque.value > 0.0 && result.tractive_efficiency >= 0.0 && result.tractive_efficiency <= 1.0;
}

double reported_efficiency(const TractionResult& result) {
  return has_efficiency(result) ? result.tractive_efficiency : not_a_number;
}

std::string why_no_efficiency(const TractionResult& result) {
  if (has_efficiency(result)) return "";
  if (result.tractive_efficiency > 1.0) return "more power would come out than is put in";
  return "the wheel has to be pushed or braked";
}

Estimate efficiency_with_error(const TractionResult& result) {
  const double ratio = result.tractive_efficiency, torque = result.torque.value, put_in = force_put_in(result);
  const bool turn = result.at.force_frame == ForceFrame::wheel;
  const double c = turn ? std::cos(result.at.yaw) : 1.0, s = turn ? std::sin(result.at.yaw) : 0.0;
  const double of_pull = std::hypot(c * result.drawbar_pull.std_error, s * result.lateral_force.std_error) / put_in;
  // The motor's share of what is put in is 1 - downhill force/put_in, and dTE/dM = -TE/M times it.
  const double of_torque = ratio * (1.0 - downhill_force(result.at) / put_in) * result.torque.std_error / torque;
  return {ratio, std::hypot(of_pull, of_torque)};
}

double mean_efficiency(const std::vector<const TractionResult*>& results) {
  double out = 0.0, in = 0.0;
  for (const TractionResult* result : results) out += pull_along_travel(*result), in += force_put_in(*result);
  return out / in;
}

}  // namespace soilbin
