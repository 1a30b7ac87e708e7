#include "scenario/drive_way.hpp"

#include <algorithm>
#include <limits>

namespace soilbin {

Way::Way(const std::vector<Waypoint>& points, double blend) : points_(points), blend_(blend) {
  for (const Waypoint& point : points_) {
    if (!point.soil) continue;
    soils_.push_back(*point.soil);
    soil_from_.push_back(point.at > 0.0 ? point.at : -std::numeric_limits<double>::infinity());
  }
}

bool Way::turns() const {
  return std::any_of(points_.begin(), points_.end(), [](const Waypoint& point) { return point.yaw != 0.0; });
}

double Way::share(std::size_t i, double x) const {
  return std::clamp((x - soil_from_[i - 1]) / blend_ + 0.5, 0.0, 1.0);
}

Place Way::at(double x) const {
  Place place;
  for (std::size_t i = 1; i <= soils_.size(); ++i) {
    const double taken = share(i, x);
    if (taken <= 0.0) break;
    place.last_soil = i;
    if (taken >= 1.0) place.soil = i;
  }
  if (points_.empty()) return place;
  const auto next = std::upper_bound(points_.begin(), points_.end(), x,
                                     [](double value, const Waypoint& point) { return value < point.at; });
  const Waypoint& a = next == points_.begin() ? points_.front() : *(next - 1);
  const Waypoint& b = next == points_.end() ? points_.back() : *next;
  const double length = b.at - a.at, share = length > 0.0 ? (x - a.at) / length : 0.0;
  const auto between = [&](double Waypoint::*member) { return a.*member + share * (b.*member - a.*member); };
  place.longitudinal_incline = between(&Waypoint::longitudinal_incline);
  place.transverse_incline = between(&Waypoint::transverse_incline);
  place.yaw = between(&Waypoint::yaw);
  place.drawbar = between(&Waypoint::drawbar);
  if (length > 0.0) place.curvature = (b.longitudinal_incline - a.longitudinal_incline) / length;
  return place;
}

}  // namespace soilbin
