// Vertices sorted into a tree of balls, to find those near an edge: what finds T-joints, to refuse or to mend them.
#pragma once

#include <vector>

#include "dem/surface/vec3.hpp"

namespace soilbin::dem {

/// Holds the vertices by reference.
class VertexTree {
 public:
  explicit VertexTree(const std::vector<Vec3>& vertices);

  /// The lowest vertex within `distance` of the segment from vertex a to vertex b and neither of the two, or -1.
  int near_segment(int a, int b, double distance) const;

 private:
  struct Node {
    Vec3 centre;
    double radius;
    int first, last;            // of order_
    int left = -1, right = -1;  // -1 both: a leaf
  };
  struct Segment;

  int build(int first, int last);
  void search(int at, const Segment& segment, int a, int b, double distance, int& found) const;

  const std::vector<Vec3>& vertices_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

}  // namespace soilbin::dem
