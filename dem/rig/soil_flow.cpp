#include "dem/rig/soil_flow.hpp"

#include <algorithm>
#include <cmath>

#include "dem/surface/mass_properties.hpp"
#include "scenario/estimate.hpp"

namespace soilbin::dem {

FlowMeter::FlowMeter(double cell, double ahead, double below, double above, double solid) : solid_(solid) {
  layout_.cell = cell;
  layout_.nx = 2 * static_cast<int>(std::ceil(ahead / cell));
  layout_.nz = static_cast<int>(std::ceil((below + above) / cell));
  layout_.x = -cell * layout_.nx / 2, layout_.z = -below;
  const std::size_t cells = static_cast<std::size_t>(layout_.nx) * layout_.nz;
  volume_.resize(cells), vx_.resize(cells), vz_.resize(cells);
}

void FlowMeter::add(const Grains& grains, const Vec3& axle) {
  moments_ += 1;
  for (std::size_t k = 0; k < grains.count(); ++k) {
    const auto& grain = grains.motion[k];
    const Vec3 from = grain.position - axle;
    if (std::abs(from.y) > layout_.cell) continue;
    const double ix = std::floor((from.x - layout_.x) / layout_.cell);
    const double iz = std::floor((from.z - layout_.z) / layout_.cell);
    if (!(ix >= 0 && ix < layout_.nx && iz >= 0 && iz < layout_.nz)) continue;
    const std::size_t at = static_cast<std::size_t>(iz) * layout_.nx + static_cast<std::size_t>(ix);
    const double volume = solid_ * sphere_volume(grain.radius);
    volume_[at] += volume;
    vx_[at] += volume * grain.velocity.x, vz_[at] += volume * grain.velocity.z;
  }
}

FlowMeter FlowMeter::empty_one() const {
  FlowMeter out = *this;
  out.moments_ = 0;
  for (std::vector<double>* sums : {&out.volume_, &out.vx_, &out.vz_}) std::fill(sums->begin(), sums->end(), 0.0);
  return out;
}

FlowMeter& FlowMeter::operator+=(const FlowMeter& other) {
  moments_ += other.moments_;
  for (std::size_t k = 0; k < volume_.size(); ++k)
    volume_[k] += other.volume_[k], vx_[k] += other.vx_[k], vz_[k] += other.vz_[k];
  return *this;
}

SoilFlow FlowMeter::flow() const {
  SoilFlow flow = layout_;
  const double nothing = not_a_number;
  const double room = moments_ * 2 * layout_.cell * layout_.cell * layout_.cell;
  for (std::size_t k = 0; k < volume_.size(); ++k) {
    flow.vx.push_back(volume_[k] > 0 ? vx_[k] / volume_[k] : nothing);
    flow.vz.push_back(volume_[k] > 0 ? vz_[k] / volume_[k] : nothing);
    flow.solid.push_back(room > 0 ? volume_[k] / room : 0);
  }
  return flow;
}

}  // namespace soilbin::dem
