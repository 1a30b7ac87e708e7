// The forms of each effect: one function a file of this folder, called by catalogue.cpp. Whose they are:
// provenance.hpp.
#pragma once

#include <vector>

#include "bekker_wong/effect.hpp"

namespace soilbin::bekker_wong {

std::vector<EffectForm> exit_angle_forms();
std::vector<EffectForm> slip_sinkage_forms();
std::vector<EffectForm> lug_thrust_forms();
std::vector<EffectForm> bulldozing_forms();
std::vector<EffectForm> multipass_forms();
std::vector<EffectForm> tire_flexibility_forms();
std::vector<EffectForm> rate_dependence_forms();
std::vector<EffectForm> interface_limit_forms();
std::vector<EffectForm> shear_hump_forms();
std::vector<EffectForm> pressure_dependent_shear_modulus_forms();
std::vector<EffectForm> hard_layer_forms();
std::vector<EffectForm> moisture_forms();
std::vector<EffectForm> slope_weakening_forms();
std::vector<EffectForm> sidewall_bulldozing_forms();
std::vector<EffectForm> bed_tilt_forms();
std::vector<EffectForm> rig_friction_forms();
std::vector<EffectForm> sensor_offset_forms();
std::vector<EffectForm> cross_talk_forms();
std::vector<EffectForm> soil_gradient_forms();
std::vector<EffectForm> drift_forms();

/// Why a wheel driven in time can't take a form that changes what the rig's instruments show.
inline constexpr const char* of_an_instrument = "it belongs to a rig's instruments or bed, and a drive has none";

/// A form's maker from an effect's type that is constructed from the vector of its parameters.
template <class T>
std::function<std::unique_ptr<const Effect>(const std::vector<double>&)> maker() {
  return [](const std::vector<double>& parameters) { return std::make_unique<const T>(parameters); };
}

}  // namespace soilbin::bekker_wong
