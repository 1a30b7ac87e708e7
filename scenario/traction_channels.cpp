#include "scenario/traction_channels.hpp"

#include <fmt/core.h>

namespace soilbin {

double channel_scale(const TractionChannel& channel, double load, double radius) {
  if (channel.scale == ChannelScale::load_times_radius) return load * radius;
  return channel.scale == ChannelScale::radius ? radius : load;
}

std::string_view scale_in_words(const TractionChannel& channel) {
  if (channel.scale == ChannelScale::load_times_radius) return "load x radius";
  return channel.scale == ChannelScale::radius ? "radius" : "load";
}

std::string column_of(const TractionChannel& channel, std::string_view what) {
  std::string unit = channel.si_unit;
  std::erase(unit, ' ');
  return fmt::format("{}_{}{}{}", channel.name, what, what.empty() ? "" : "_", unit);
}

}  // namespace soilbin
