#include "dem/rig/tread_stress.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace soilbin::dem {

using std::numbers::pi;

TreadForces& TreadForces::operator+=(const TreadForces& other) {
  if (sectors.size() < other.sectors.size()) sectors.resize(other.sectors.size());
  for (std::size_t k = 0; k < other.sectors.size(); ++k) sectors[k] += other.sectors[k];
  thrust += other.thrust, resistance += other.resistance, side += other.side;
  return *this;
}

TreadForces tread_forces(const std::vector<Contact>& contacts, int body, const Vec3& centre, const WheelMotion& motion,
                         int sectors) {
  TreadForces out;
  out.sectors.resize(sectors);
  for (const Contact& contact : contacts) {
    if (contact.second != -1 - body) continue;
    const Vec3 arm = contact.point - centre, on_wheel = -contact.force;
    const double theta = std::atan2(dot(arm, motion.heading), -arm.z);
    const Vec3 outward{std::sin(theta) * motion.heading.x, std::sin(theta) * motion.heading.y, -std::cos(theta)};
    const Vec3 forward{std::cos(theta) * motion.heading.x, std::cos(theta) * motion.heading.y, std::sin(theta)};
    const Vec3 parts{-dot(on_wheel, outward), dot(on_wheel, forward), dot(on_wheel, motion.axle)};
    const auto sector = static_cast<int>((theta + pi) / (2 * pi) * sectors);
    out.sectors[std::clamp(sector, 0, sectors - 1)] += parts;
    out.thrust += parts.y * std::cos(theta);
    out.resistance -= parts.x * std::sin(theta);
    out.side += parts.z;
  }
  return out;
}

std::vector<StressSample> tread_stress(const TreadForces& sum, double count, const Tire& tire) {
  const auto n = static_cast<double>(sum.sectors.size());
  double largest = 0;
  for (const Vec3& sector : sum.sectors) largest = std::max(largest, sector.x);
  const auto bears = [&](const Vec3& sector) { return largest > 0 && sector.x >= 0.01 * largest; };
  const auto first = std::find_if(sum.sectors.begin(), sum.sectors.end(), bears);
  const auto last = std::find_if(sum.sectors.rbegin(), sum.sectors.rend(), bears).base();
  std::vector<StressSample> samples;
  const double area = 2 * pi / n * tire.radius * tire.width * count;
  for (auto sector = first; sector < last; ++sector) {
    const double theta = -pi + 2 * pi * (static_cast<double>(sector - sum.sectors.begin()) + 0.5) / n;
    samples.push_back({theta, sector->x / area, sector->y / area, sector->z / area});
  }
  return samples;
}

}  // namespace soilbin::dem
