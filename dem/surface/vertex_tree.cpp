#include "dem/surface/vertex_tree.hpp"

#include <algorithm>

namespace soilbin::dem {

struct VertexTree::Segment {
  Vec3 from, to;
  double squared_distance(const Vec3& p) const {
    const Vec3 along = to - from;
    return squared(p - from - std::clamp(dot(p - from, along) / squared(along), 0.0, 1.0) * along);
  }
};

VertexTree::VertexTree(const std::vector<Vec3>& vertices) : vertices_(vertices) {
  for (int i = 0; i < static_cast<int>(vertices.size()); ++i) order_.push_back(i);
  build(0, static_cast<int>(order_.size()));
}

int VertexTree::near_segment(int a, int b, double distance) const {
  int found = -1;
  search(0, {vertices_[a], vertices_[b]}, a, b, distance, found);
  return found;
}

int VertexTree::build(int first, int last) {
  Vec3 low = vertices_[order_[first]], high = low;
  for (int i = first; i < last; ++i) {
    const Vec3& p = vertices_[order_[i]];
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const Vec3 size = high - low;
  const int node = static_cast<int>(nodes_.size());
  nodes_.push_back({0.5 * (low + high), 0.5 * length(size) * (1 + 1e-12), first, last});
  if (last - first <= 4) return node;
  const auto part = [&](const Vec3& p) {
    return size.x >= std::max(size.y, size.z) ? p.x : size.y >= size.z ? p.y : p.z;
  };
  const int middle = (first + last) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                   [&](int i, int j) { return part(vertices_[i]) < part(vertices_[j]); });
  const int left = build(first, middle), right = build(middle, last);
  nodes_[node].left = left, nodes_[node].right = right;
  return node;
}

void VertexTree::search(int at, const Segment& segment, int a, int b, double distance, int& found) const {
  const Node& node = nodes_[at];
  const double reach = node.radius + distance;
  if (segment.squared_distance(node.centre) > reach * reach) return;
  if (node.left >= 0) {
    search(node.left, segment, a, b, distance, found);
    search(node.right, segment, a, b, distance, found);
    return;
  }
  for (int i = node.first; i < node.last; ++i) {
    const int v = order_[i];
    if (v == a || v == b || (found >= 0 && v > found)) continue;
    if (segment.squared_distance(vertices_[v]) <= distance * distance) found = v;
  }
}

}  // namespace soilbin::dem
