// The four channels that a wheel test measures and a model predicts, as one table: drawbar pull, torque, sinkage,
// lateral force, with names and units.
//
//   for (const TractionChannel& c : traction_channels)
//     fmt::print("{} = {:.4g} {}\n", c.title, (result.*c.predicted).value * c.per_si, c.unit);  // "sinkage = 12 mm"
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "scenario/traction_result.hpp"

namespace soilbin {

/// What a channel is told in shares of: forces of the load, the torque of load times radius, the sinkage of the radius.
enum class ChannelScale { load, load_times_radius, radius };

/// One channel: its names, its units, and where it stands in a result.
struct TractionChannel {
  std::string_view name;   ///< in files: "drawbar_pull"
  std::string_view title;  ///< for people: "drawbar pull"
  const char* si_unit;     ///< in files: "m"
  std::string_view unit;   ///< in which people read it: "mm"
  double per_si;           ///< units per SI unit: 1000 for mm
  const char* meaning;     ///< with its SI unit
  Estimate TractionResult::*predicted;
  bool sideways = false;  ///< across the wheel: nothing to tell without yaw and cross slope
  ChannelScale scale = ChannelScale::load;
};

/// In the order of every array over channels.
inline constexpr std::array<TractionChannel, 4> traction_channels = {{
    {"drawbar_pull", "drawbar pull", "N", "N", 1.0, "F_DP [N] along travel, less the slope's share of the load",
     &TractionResult::drawbar_pull},
    {"torque", "torque", "N m", "N m", 1.0, "M [N m]; positive drives", &TractionResult::torque, false,
     ChannelScale::load_times_radius},
    {"sinkage", "sinkage", "m", "mm", 1000.0, "z [m]", &TractionResult::sinkage, false, ChannelScale::radius},
    {"lateral_force", "lateral force", "N", "N", 1.0, "F_y [N], to the left of travel", &TractionResult::lateral_force,
     true},
}};

/// The channels in the wheel's plane, which every run tells: drawbar pull, torque, sinkage.
inline constexpr std::array<std::size_t, 3> channels_in_plane = {0, 1, 2};

/// W, W r or r, of a load W and a radius r.
double channel_scale(const TractionChannel& channel, double load, double radius);
/// "load", "load x radius", "radius".
std::string_view scale_in_words(const TractionChannel& channel);

/// The header of a CSV column, whose unit is SI: "torque_Nm"; with `what` between them, "torque_se_Nm".
std::string column_of(const TractionChannel& channel, std::string_view what = "");

}  // namespace soilbin
