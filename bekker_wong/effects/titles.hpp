// The effects' names for people. In files and flags an effect goes by its id.
//
//   effect_title("sidewall_bulldozing").name      // "side-wall bulldozing"
//   effect_title("sidewall_bulldozing").meaning   // "at yaw or on a cross slope the wheel's side pushes soil"
#pragma once

#include <string_view>

namespace soilbin::bekker_wong {

struct EffectTitle {
  std::string_view id, name, meaning;
};

/// The title of an effect of the catalogue, or of "learned". Throws std::out_of_range for another id.
const EffectTitle& effect_title(std::string_view id);

}  // namespace soilbin::bekker_wong
