#include "dem/bed/surface_height.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace soilbin::dem {
namespace {

/// Cells of a row whose middles lie within `reach` of `at`.
struct Span {
  int first, last;
};

Span middles(double at, double reach, double lower, double cell, int count) {
  const double from = std::ceil((at - reach - lower) / cell - 0.5), to = std::floor((at + reach - lower) / cell - 0.5);
  return {static_cast<int>(std::clamp(from, 0.0, static_cast<double>(count))),
          static_cast<int>(std::clamp(to, -1.0, count - 1.0))};
}

}  // namespace

double SurfaceHeight::mean() const {
  return std::accumulate(height.begin(), height.end(), 0.0) / static_cast<double>(height.size());
}

double SurfaceHeight::deviation() const {
  const double middle = mean();
  double sum = 0;
  for (const double h : height) sum += (h - middle) * (h - middle);
  return std::sqrt(sum / static_cast<double>(height.size()));
}

double SurfaceHeight::highest() const { return *std::max_element(height.begin(), height.end()); }

std::vector<double> SurfaceHeight::along() const {
  std::vector<double> means(nx);
  for (int iy = 0; iy < ny; ++iy)
    for (int ix = 0; ix < nx; ++ix) means[ix] += at(ix, iy) / ny;
  return means;
}

SurfaceHeight surface_height(const Grains& grains, const Footprint& over, double spacing) {
  SurfaceHeight out;
  out.over = over;
  const double length = over.x_upper - over.x_lower, width = over.y_upper - over.y_lower;
  out.nx = std::max(1, static_cast<int>(std::lround(length / spacing)));
  out.ny = std::max(1, static_cast<int>(std::lround(width / spacing)));
  out.height.assign(static_cast<std::size_t>(out.nx) * out.ny, 0.0);
  const double dx = length / out.nx, dy = width / out.ny;
  for (std::size_t k = 0; k < grains.count(); ++k) {
    const Vec3& at = grains.motion[k].position;
    const double radius = grains.motion[k].radius;
    const Span xs = middles(at.x, radius, over.x_lower, dx, out.nx);
    const Span ys = middles(at.y, radius, over.y_lower, dy, out.ny);
    for (int iy = ys.first; iy <= ys.last; ++iy) {
      for (int ix = xs.first; ix <= xs.last; ++ix) {
        const double x = over.x_lower + (ix + 0.5) * dx - at.x, y = over.y_lower + (iy + 0.5) * dy - at.y;
        const double above2 = radius * radius - x * x - y * y;
        if (above2 <= 0) continue;
        double& h = out.height[static_cast<std::size_t>(iy) * out.nx + ix];
        h = std::max(h, at.z + std::sqrt(above2));
      }
    }
  }
  return out;
}

}  // namespace soilbin::dem
