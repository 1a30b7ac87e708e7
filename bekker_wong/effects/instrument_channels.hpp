// The four measured channels as effects of the rig see them.
#pragma once

#include <algorithm>
#include <array>

#include "bekker_wong/effect.hpp"
#include "scenario/traction_channels.hpp"
#include "scenario/yawed_frames.hpp"

namespace soilbin::bekker_wong {

/// A measured channel: its place in a reading, and the sizes that an error of its instrument plausibly has [SI].
struct Channel : TractionChannel {
  double Reading::*value;
  double usual;  ///< a default size of its error
  double limit;  ///< beyond it the reading would be useless
};

inline constexpr std::array<Channel, 4> measured_channels = {{
    {traction_channels[0], reading_members[0], 5.0, 1e4},
    {traction_channels[1], reading_members[1], 1.0, 1e4},
    {traction_channels[2], reading_members[2], 0.002, 0.2},
    {traction_channels[3], reading_members[3], 5.0, 1e4},
}};

/// Adds a force given along travel and to its left [N] to a reading, in the axes that the condition asks for.
inline void add_force_of_travel(Reading& reading, double forward, double left, const OperatingCondition& at) {
  const GroundForce added = turned({forward, left}, at.yaw, ForceFrame::travel, at.force_frame);
  reading.drawbar_pull += added.forward;
  reading.lateral_force += added.left;
}

/// Rim speed r w [m/s]. At full slip the forward speed says nothing of it, so v/(r w) is held above 0.02; 0 where the
/// wheel is locked.
inline double rim_speed(const Surroundings& around) {
  if (around.motion.locked) return 0.0;
  return around.at.speed / std::max(around.motion.travel_ratio, 0.02);
}

}  // namespace soilbin::bekker_wong
