#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "dem/surface/mesh_checks.hpp"

namespace soilbin::dem {
namespace {

using CellIndex = std::array<std::int64_t, 3>;

struct CellIndexHash {
  std::size_t operator()(const CellIndex& cell) const {
    std::uint64_t h = 0;
    for (const std::int64_t i : cell) h = (h ^ static_cast<std::uint64_t>(i)) * 0x9E3779B97F4A7C15u, h ^= h >> 29;
    return static_cast<std::size_t>(h);
  }
};

/// Vertices that stay, by the cell they lie in.
class Kept {
 public:
  Kept(const std::vector<Vec3>& vertices, const Vec3& low, double cell, double distance)
      : vertices_(vertices), low_(low), cell_(cell), distance_(distance), next_(vertices.size(), -1) {}

  /// The lowest kept vertex within the distance of vertex v; v itself, then kept, if there is none.
  int stand_in(int v) {
    const Vec3& p = vertices_[v];
    const Vec3 margin{distance_, distance_, distance_};
    const CellIndex from = cell_of(p - margin), to = cell_of(p + margin);
    int found = v;
    for (auto i = from[0]; i <= to[0]; ++i) {
      for (auto j = from[1]; j <= to[1]; ++j) {
        for (auto k = from[2]; k <= to[2]; ++k) {
          const auto bucket = heads_.find({i, j, k});
          if (bucket == heads_.end()) continue;
          for (int other = bucket->second; other >= 0; other = next_[other]) {
            if (other < found && squared(vertices_[other] - p) <= distance_ * distance_) found = other;
          }
        }
      }
    }
    if (found == v) keep(v);
    return found;
  }

 private:
  CellIndex cell_of(const Vec3& p) const {
    const Vec3 at = (p - low_) / cell_;
    return {std::llround(std::floor(at.x)), std::llround(std::floor(at.y)), std::llround(std::floor(at.z))};
  }
  void keep(int v) {
    const auto [bucket, fresh] = heads_.try_emplace(cell_of(vertices_[v]), v);
    if (!fresh) next_[v] = bucket->second, bucket->second = v;
  }

  const std::vector<Vec3>& vertices_;
  Vec3 low_;
  double cell_, distance_;
  std::vector<int> next_;
  std::unordered_map<CellIndex, int, CellIndexHash> heads_;
};

}  // namespace

void weld(std::vector<Vec3>& vertices, std::vector<TriangleMesh::Corners>& triangles, double distance) {
  std::vector<char> used(vertices.size(), 0);
  for (const auto& corners : triangles) {
    for (const int corner : corners) used[corner] = 1;
  }
  const Box box = box_of(vertices, triangles);
  // Wide cells: most vertices look into one. Never so narrow that cells can't be counted.
  const double cell = std::max({16 * distance, 1e-9 * length(box.high - box.low), 1e-300});
  Kept kept(vertices, box.low, cell, distance);
  std::vector<int> number(vertices.size(), -1);
  std::vector<Vec3> staying;
  for (int v = 0; v < static_cast<int>(vertices.size()); ++v) {
    if (!used[v]) continue;
    const int stands = kept.stand_in(v);
    if (stands == v) {
      number[v] = static_cast<int>(staying.size());
      staying.push_back(vertices[v]);
    } else {
      number[v] = number[stands];
    }
  }
  for (auto& corners : triangles) {
    for (int& corner : corners) corner = number[corner];
  }
  vertices = std::move(staying);
}

}  // namespace soilbin::dem
