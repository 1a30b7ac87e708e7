// The four channels that a wheel test measures and a model predicts.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "compare/measured/campaign.hpp"
#include "scenario/traction_result.hpp"

namespace soilbin::compare {

/// One channel: its names, and where it stands in a result and in a measured run.
struct ChannelView {
  std::string_view name;   ///< in files: "drawbar_pull"
  std::string_view title;  ///< for people: "drawbar pull"
  std::string_view unit;   ///< in which people read it: "mm"
  double per_si;           ///< units per SI unit: 1000 for mm
  Estimate TractionResult::*predicted;
  std::optional<double> Run::*measured;
};

inline constexpr std::array<ChannelView, 4> channel_views = {{
    {"drawbar_pull", "drawbar pull", "N", 1.0, &TractionResult::drawbar_pull, &Run::drawbar_pull},
    {"torque", "torque", "N m", 1.0, &TractionResult::torque, &Run::torque},
    {"sinkage", "sinkage", "mm", 1000.0, &TractionResult::sinkage, &Run::sinkage},
    {"lateral_force", "lateral force", "N", 1.0, &TractionResult::lateral_force, &Run::lateral_force},
}};

/// The unit of a channel in files, which are in SI.
constexpr const char* si_unit(const ChannelView& channel) { return channel.per_si == 1.0 ? channel.unit.data() : "m"; }

}  // namespace soilbin::compare
