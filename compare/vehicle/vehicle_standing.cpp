// How a vehicle stands on its wheels: tilt and loads.
#include <algorithm>
#include <cmath>

#include "compare/vehicle/steady_vehicle.hpp"

namespace soilbin::compare {
namespace {

double mean_of_places(const std::vector<double>& all) {
  double sum = 0.0;
  for (const double one : all) sum += one;
  return sum / static_cast<double>(all.size());
}

/// Loads of the axles that stand, by k_i (a + b x_i), x_i from the middle of the springs: a at once, then b.
std::vector<double> loads_of_standing(const std::vector<CarryingAxle>& axles, const std::vector<bool>& stands,
                                      double normal, double pitch) {
  double k = 0.0, kx = 0.0, first = 0.0;
  for (std::size_t i = 0; i < axles.size(); ++i)
    if (stands[i]) k += axles[i].stiffness, kx += axles[i].stiffness * axles[i].spring;
  const double x0 = kx / k;
  const double a = normal / k;
  double spread = 0.0, widest = 0.0;
  for (std::size_t i = 0; i < axles.size(); ++i) {
    if (!stands[i]) continue;
    const double lever = axles[i].spring - x0;
    first += axles[i].stiffness * axles[i].place, spread += axles[i].stiffness * lever * axles[i].place;
    widest = std::max(widest, std::abs(lever));
  }
  const double b = widest > in_one_place ? (pitch - a * first) / spread : 0.0;
  std::vector<double> loads(axles.size(), 0.0);
  for (std::size_t i = 0; i < axles.size(); ++i)
    if (stands[i]) loads[i] = axles[i].stiffness * (a + b * (axles[i].spring - x0));
  return loads;
}

}  // namespace

SinkagePlane plane_through(const std::vector<VehiclePoint>& points) {
  std::vector<double> xs, ys, zs;
  for (const VehiclePoint& point : points) xs.push_back(point.x), ys.push_back(point.y), zs.push_back(point.z);
  const double x0 = mean_of_places(xs), y0 = mean_of_places(ys), z0 = mean_of_places(zs);
  double xx = 0.0, yy = 0.0, xy = 0.0, xz = 0.0, yz = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double x = xs[i] - x0, y = ys[i] - y0, z = zs[i] - z0;
    xx += x * x, yy += y * y, xy += x * y, xz += x * z, yz += y * z;
  }
  constexpr double none = 1e-18;
  const double determinant = xx * yy - xy * xy;
  if (determinant > none) return {(xz * yy - yz * xy) / determinant, (yz * xx - xz * xy) / determinant};
  return {xx > none ? xz / xx : 0.0, yy > none ? yz / yy : 0.0};
}

VehiclePoint tilted(const VehiclePoint& p, double nose_down, double left_down) {
  const double s = std::sin(nose_down), c = std::cos(nose_down), t = std::sin(left_down), d = std::cos(left_down);
  const double z = -p.y * t + p.z * d, y = p.y * d + p.z * t;
  return {p.x * c + z * s, y, -p.x * s + z * c};
}

std::vector<double> axle_loads(const std::vector<CarryingAxle>& axles, double normal, double pitch) {
  std::vector<bool> stands(axles.size(), true);
  std::vector<double> loads = loads_of_standing(axles, stands, normal, pitch);
  for (std::size_t left = axles.size(); left > 1; --left) {
    const auto least = std::ranges::min_element(loads);
    if (*least >= 0.0) break;
    stands[static_cast<std::size_t>(least - loads.begin())] = false;
    loads = loads_of_standing(axles, stands, normal, pitch);
  }
  return loads;
}

}  // namespace soilbin::compare
