#include "dem/surface/inside.hpp"

#include <algorithm>
#include <cmath>

namespace soilbin::dem {
namespace {

const Rotation askew = rotation_by({0.6180339, 0.4142135, 0.7320508});

double squared_distance_to(const Vec3& p, const std::array<Vec3, 3>& t) {
  const Vec3 normal = cross(t[1] - t[0], t[2] - t[0]);
  bool over = true;
  double nearest = squared(p - t[0]);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &a = t[i], side = t[(i + 1) % 3] - a;
    if (dot(cross(normal, side), p - a) < 0) over = false;
    nearest = std::min(nearest, squared(p - a - std::clamp(dot(p - a, side) / squared(side), 0.0, 1.0) * side));
  }
  const double height = dot(normal, p - t[0]);
  return over ? height * height / squared(normal) : nearest;
}

}  // namespace

std::optional<LineHit> line_through(const Vec3& from, const Vec3& way, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, across = cross(way, ac);
  const double whole = dot(ab, across);
  if (whole == 0) return std::nullopt;
  const double of_b = dot(from - a, across) / whole;
  const Vec3 turned = cross(from - a, ab);
  const double of_c = dot(way, turned) / whole, least = std::min({of_b, of_c, 1 - of_b - of_c});
  if (!(least >= 0)) return std::nullopt;
  return LineHit{dot(ac, turned) / whole, least};
}

Solid::Solid(const std::vector<Vec3>& vertices, const std::vector<TriangleMesh::Corners>& triangles, double tolerance)
    : tolerance_(tolerance) {
  box_.low = box_.high = askew(vertices[triangles[0][0]]);
  for (const auto& c : triangles) {
    triangles_.push_back({{askew(vertices[c[0]]), askew(vertices[c[1]]), askew(vertices[c[2]])}});
    for (const Vec3& p : triangles_.back().corners) {
      box_.low = {std::min(box_.low.x, p.x), std::min(box_.low.y, p.y), std::min(box_.low.z, p.z)};
      box_.high = {std::max(box_.high.x, p.x), std::max(box_.high.y, p.y), std::max(box_.high.z, p.z)};
    }
  }
  // Few enough that long triangles do not fill all of them.
  cells_ = std::clamp(static_cast<int>(std::sqrt(static_cast<double>(triangles.size()))), 1, 64);
  listed_.resize(static_cast<std::size_t>(cells_) * static_cast<std::size_t>(cells_));
  for (int t = 0; t < static_cast<int>(triangles_.size()); ++t) {
    const auto& [a, b, c] = triangles_[t].corners;
    const auto from = cell_of(std::min({a.y, b.y, c.y}) - tolerance_, std::min({a.z, b.z, c.z}) - tolerance_);
    const auto to = cell_of(std::max({a.y, b.y, c.y}) + tolerance_, std::max({a.z, b.z, c.z}) + tolerance_);
    for (int i = from[0]; i <= to[0]; ++i)
      for (int j = from[1]; j <= to[1]; ++j) listed_[static_cast<std::size_t>(i * cells_ + j)].push_back(t);
  }
}

std::array<int, 2> Solid::cell_of(double y, double z) const {
  const auto along = [&](double at, double low, double high) {
    return high > low ? static_cast<int>(std::clamp(cells_ * (at - low) / (high - low), 0.0, cells_ - 1.0)) : 0;
  };
  return {along(y, box_.low.y, box_.high.y), along(z, box_.low.z, box_.high.z)};
}

Place Solid::place_of(const Vec3& point) const {
  const Vec3 p = askew(point);
  const auto beyond = [&](double at, double low, double high) {
    return at < low - tolerance_ || at > high + tolerance_;
  };
  if (beyond(p.x, box_.low.x, box_.high.x) || beyond(p.y, box_.low.y, box_.high.y) ||
      beyond(p.z, box_.low.z, box_.high.z))
    return Place::outside;
  const auto [i, j] = cell_of(p.y, p.z);
  bool inside = false;
  for (const int t : listed_[static_cast<std::size_t>(i * cells_ + j)]) {
    const auto& corners = triangles_[t].corners;
    if (squared_distance_to(p, corners) <= tolerance_ * tolerance_) return Place::on;
    const auto hit = line_through(p, {1, 0, 0}, corners[0], corners[1], corners[2]);
    if (hit && hit->along > 0) inside = !inside;
  }
  return inside ? Place::inside : Place::outside;
}

}  // namespace soilbin::dem
