#include "scenario/traction_channels.hpp"

#include <fmt/core.h>

namespace soilbin {

std::string column_of(const TractionChannel& channel, std::string_view what) {
  std::string unit = channel.si_unit;
  std::erase(unit, ' ');
  return fmt::format("{}_{}{}{}", channel.name, what, what.empty() ? "" : "_", unit);
}

}  // namespace soilbin
