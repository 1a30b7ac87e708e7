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

SurfaceHeight bare_floor(const Footprint& over, double spacing) {
  SurfaceHeight out;
  out.over = over;
  out.nx = std::max(1, static_cast<int>(std::lround((over.x_upper - over.x_lower) / spacing)));
  out.ny = std::max(1, static_cast<int>(std::lround((over.y_upper - over.y_lower) / spacing)));
  out.height.assign(static_cast<std::size_t>(out.nx) * out.ny, 0.0);
  return out;
}

void raise(SurfaceHeight& surface, const Vec3& centre, double radius) {
  const Footprint& over = surface.over;
  const double dx = (over.x_upper - over.x_lower) / surface.nx, dy = (over.y_upper - over.y_lower) / surface.ny;
  const Span xs = middles(centre.x, radius, over.x_lower, dx, surface.nx);
  const Span ys = middles(centre.y, radius, over.y_lower, dy, surface.ny);
  for (int iy = ys.first; iy <= ys.last; ++iy) {
    for (int ix = xs.first; ix <= xs.last; ++ix) {
      const double x = over.x_lower + (ix + 0.5) * dx - centre.x, y = over.y_lower + (iy + 0.5) * dy - centre.y;
      const double above2 = radius * radius - x * x - y * y;
      if (above2 <= 0) continue;
      double& h = surface.height[static_cast<std::size_t>(iy) * surface.nx + ix];
      h = std::max(h, centre.z + std::sqrt(above2));
    }
  }
}

SurfaceHeight surface_height(const Grains& grains, const Footprint& over, double spacing) {
  SurfaceHeight out = bare_floor(over, spacing);
  for (std::size_t k = 0; k < grains.count(); ++k) raise(out, grains.motion[k].position, grains.motion[k].radius);
  return out;
}

}  // namespace soilbin::dem
