#include "dem/surface/triangle_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "dem/surface/closest_point.hpp"
#include "dem/surface/positive.hpp"

namespace soilbin::dem {
namespace {

constexpr double most_cells_in_all = 2e6;

struct Range {
  int low, high;
};

/// The cells along one axis that [low, high] meets, of `count`.
Range cells_of(double low, double high, int count) {
  return {std::clamp(static_cast<int>(std::floor(low)), 0, count - 1),
          std::clamp(static_cast<int>(std::floor(high)), 0, count - 1)};
}

}  // namespace

TriangleGrid::TriangleGrid(const TriangleMesh& mesh, double reach) : mesh_(mesh), reach_(reach) {
  if (!positive(reach)) throw std::invalid_argument("a grid's reach must be positive and finite");
  // A hair more than the reach: no triangle is lost to rounding.
  const double margin = reach * (1 + 1e-9) + mesh.rounding();
  const Vec3 size = mesh.bounds().high - mesh.bounds().low + Vec3{2 * margin, 2 * margin, 2 * margin};
  origin_ = mesh.bounds().low - Vec3{margin, margin, margin};
  const auto cells = [&](double cell) {
    return std::ceil(size.x / cell) * std::ceil(size.y / cell) * std::ceil(size.z / cell);
  };
  cell_ = margin;
  while (cells(cell_) > most_cells_in_all) cell_ *= 1.1;
  per_metre_ = 1 / cell_;
  nx_ = static_cast<int>(std::ceil(size.x / cell_)), ny_ = static_cast<int>(std::ceil(size.y / cell_)),
  nz_ = static_cast<int>(std::ceil(size.z / cell_));

  const double from_middle = margin + 0.5 * std::sqrt(3.0) * cell_ * (1 + 1e-9);
  const auto each = [&](auto&& visit) {  // visit(cell) for every cell of every triangle, triangles ascending
    ClosestPoint unused;
    for (int t = 0; t < mesh.size(); ++t) {
      const Vec3 a = per_metre_ * (mesh.corner(t, 0) - origin_), b = per_metre_ * (mesh.corner(t, 1) - origin_),
                 c = per_metre_ * (mesh.corner(t, 2) - origin_);
      const double m = margin * per_metre_;
      const Range x = cells_of(std::min({a.x, b.x, c.x}) - m, std::max({a.x, b.x, c.x}) + m, nx_);
      const Range y = cells_of(std::min({a.y, b.y, c.y}) - m, std::max({a.y, b.y, c.y}) + m, ny_);
      const Range z = cells_of(std::min({a.z, b.z, c.z}) - m, std::max({a.z, b.z, c.z}) + m, nz_);
      for (int k = z.low; k <= z.high; ++k) {
        for (int j = y.low; j <= y.high; ++j) {
          for (int i = x.low; i <= x.high; ++i) {
            const Vec3 middle = origin_ + cell_ * Vec3{i + 0.5, j + 0.5, k + 0.5};
            if (closest_within(mesh, t, middle, from_middle, unused)) visit((k * ny_ + j) * nx_ + i, t);
          }
        }
      }
    }
  };
  std::vector<std::size_t> count(static_cast<std::size_t>(nx_) * ny_ * nz_ + 1, 0);
  each([&](int cell, int) { ++count[cell + 1]; });
  for (std::size_t i = 1; i < count.size(); ++i) count[i] += count[i - 1];
  if (count.back() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    throw std::invalid_argument("a grid's reach is too long for so fine a mesh");
  }
  first_.assign(count.begin(), count.end());
  listed_.resize(count.back());
  each([&](int cell, int t) { listed_[count[cell]++] = t; });
}

void TriangleGrid::near(const Vec3& point, double reach, std::vector<int>& out) const {
  if (!(reach <= reach_)) throw std::invalid_argument("asked for triangles farther than the grid's reach");
  out.clear();
  ClosestPoint unused;
  for (const int t : around(point)) {
    if (mesh_.ball(t).may_be_within(reach, point) && closest_within(mesh_, t, point, reach, unused)) out.push_back(t);
  }
}

}  // namespace soilbin::dem
