// The four measured channels (drawbar pull, torque, sinkage, lateral force) as members of a run, so that code can go
// over them.
#pragma once

#include <array>
#include <optional>

#include "compare/measured/campaign.hpp"
#include "scenario/traction_channels.hpp"

namespace soilbin::compare {

/// A channel that a run may have measured.
struct ChannelView : TractionChannel {
  std::optional<double> Run::*measured;
};

inline constexpr std::array<ChannelView, 4> channel_views = {{
    {traction_channels[0], &Run::drawbar_pull},
    {traction_channels[1], &Run::torque},
    {traction_channels[2], &Run::sinkage},
    {traction_channels[3], &Run::lateral_force},
}};

}  // namespace soilbin::compare
