#include "dem/rig/rut.hpp"

#include <algorithm>
#include <cmath>

namespace soilbin::dem {
namespace {

/// Means of values over equal cells of [lower, upper].
class RowOfCells {
 public:
  RowOfCells(double lower, double upper, double cell)
      : lower_(lower),
        count_(std::max(1, static_cast<int>(std::lround((upper - lower) / cell)))),
        side_((upper - lower) / count_),
        sum_(count_),
        weight_(count_) {}

  void add(double at, double value) {
    const int k = std::clamp(static_cast<int>((at - lower_) / side_), 0, count_ - 1);
    sum_[k] += value, weight_[k] += 1;
  }
  std::vector<double> middles(double from) const {
    std::vector<double> out;
    for (int k = 0; k < count_; ++k) out.push_back(lower_ + (k + 0.5) * side_ - from);
    return out;
  }
  std::vector<double> means() const {
    std::vector<double> out;
    for (int k = 0; k < count_; ++k) out.push_back(sum_[k] / std::max(weight_[k], 1.0));
    return out;
  }

 private:
  double lower_;
  int count_;
  double side_;
  std::vector<double> sum_, weight_;
};

}  // namespace

SurfaceHeight bed_surface(const Grains& grains, const BedSize& size, double smallest_radius) {
  return surface_height(grains, {0, size.length, 0, size.width}, smallest_radius / 2);
}

Rut rut_between(const SurfaceHeight& before, const SurfaceHeight& after, const Track& track, double cell) {
  const Footprint& over = before.over;
  const double dx = (over.x_upper - over.x_lower) / before.nx, dy = (over.y_upper - over.y_lower) / before.ny;
  RowOfCells across(over.y_lower, over.y_upper, cell), along(over.x_lower, over.x_upper, cell);
  Rut rut{.from = track.from, .to = track.to, .axle = track.axle, .y = {}, .across = {}, .x = {}, .along = {}};
  for (int iy = 0; iy < before.ny; ++iy) {
    for (int ix = 0; ix < before.nx; ++ix) {
      const double x = over.x_lower + (ix + 0.5) * dx, y = over.y_lower + (iy + 0.5) * dy;
      const double change = after.at(ix, iy) - before.at(ix, iy);
      (change > 0 ? rut.heaped : rut.dug) += std::abs(change) * dx * dy;
      if (x >= track.from && x <= track.to) across.add(y, change);
      if (std::abs(y - track.middle) <= track.width / 2) along.add(x, change);
    }
  }
  rut.volume = rut.heaped - rut.dug;
  rut.y = across.middles(track.middle), rut.x = along.middles(0);
  if (track.to > track.from) rut.across = across.means();
  rut.along = along.means();
  return rut;
}

}  // namespace soilbin::dem
