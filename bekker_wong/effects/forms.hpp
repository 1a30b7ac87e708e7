// The published forms of each effect: one function a file of this folder, called by catalogue.cpp.
#pragma once

#include <vector>

#include "bekker_wong/effect.hpp"

namespace soilbin::bekker_wong {

std::vector<EffectForm> exit_angle_forms();
std::vector<EffectForm> slip_sinkage_forms();

/// A form's maker from an effect's type that is constructed from the vector of its parameters.
template <class T>
std::function<std::unique_ptr<const Effect>(const std::vector<double>&)> maker() {
  return [](const std::vector<double>& parameters) { return std::make_unique<const T>(parameters); };
}

}  // namespace soilbin::bekker_wong
