#include "bekker_wong/effects/titles.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

namespace soilbin::bekker_wong {
namespace {

constexpr std::array<EffectTitle, 21> titles = {{
    {"exit_angle", "exit angle", "soil stays in contact behind the axle, or leaves early"},
    {"slip_sinkage", "slip sinkage", "the wheel digs itself in as slip grows"},
    {"lug_thrust", "lug thrust", "lugs shear on a larger radius and push soil with their faces"},
    {"bulldozing", "bulldozing", "a bow wave before the wheel resists"},
    {"multipass", "multipass", "earlier passes have compacted the rut"},
    {"tire_flexibility", "tire flexibility", "the carcass flattens"},
    {"rate_dependence", "rate dependence", "soil resists penetration or shear more at speed"},
    {"interface_limit", "interface limit", "the wheel's surface slides before the soil shears"},
    {"shear_hump", "shear hump", "shear stress peaks, then falls to a residual"},
    {"pressure_dependent_shear_modulus", "pressure-dependent shear modulus", "K changes with normal stress"},
    {"hard_layer", "hard layer", "the bin's floor or a firm layer stiffens the soil with depth"},
    {"moisture", "moisture", "strength changes with water content"},
    {"slope_weakening", "slope weakening", "part of the soil's strength already holds the slope"},
    {"sidewall_bulldozing", "side-wall bulldozing", "at yaw or on a cross slope the wheel's side pushes soil"},
    {"bed_tilt", "bed tilt", "the bed is not level"},
    {"rig_friction", "rig friction", "bearings and drive train take torque"},
    {"sensor_offset", "sensor offset", "a channel's zero or scale is off, or the zero of load or slip"},
    {"cross_talk", "cross-talk", "one channel leaks into another"},
    {"soil_gradient", "soil gradient", "the soil's strength varies along the bin"},
    {"drift", "drift", "the soil or an instrument drifts from run to run"},
    {"learned", "learned change", "a smooth function of conditions, learned from a campaign, without a cause"},
}};

}  // namespace

const EffectTitle& effect_title(std::string_view id) {
  const auto title = std::find_if(titles.begin(), titles.end(), [&](const EffectTitle& t) { return t.id == id; });
  if (title == titles.end()) throw std::out_of_range("no effect " + std::string(id));
  return *title;
}

}  // namespace soilbin::bekker_wong
