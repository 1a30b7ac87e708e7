#include "dem/surface/mesh_checks.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "dem/surface/positive.hpp"
#include "dem/surface/vertex_tree.hpp"
#include "scenario/errors.hpp"

namespace soilbin::dem {
namespace {

using Corners = TriangleMesh::Corners;

std::string show(const Vec3& p) { return fmt::format("({:.9g}, {:.9g}, {:.9g}) m", p.x, p.y, p.z); }

int next(int i) { return i == 2 ? 0 : i + 1; }

}  // namespace

std::vector<Side> sorted_sides(const std::vector<Corners>& triangles) {
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (int t = 0; t < static_cast<int>(triangles.size()); ++t) {
    for (int i = 0; i < 3; ++i) {
      const int a = triangles[t][i], b = triangles[t][next(i)];
      sides.push_back({std::min(a, b), std::max(a, b), t, i, a < b});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.triangle, a.edge) < std::tie(b.low, b.high, b.triangle, b.edge);
  });
  return sides;
}

void refuse_mesh(const std::string& name, const std::string& message, const std::string& hint) {
  throw InputError({name, 0, 0}, message, "", hint);
}

void check_numbers(const std::vector<Vec3>& vertices, const std::vector<Corners>& triangles, const std::string& name) {
  if (triangles.empty()) refuse_mesh(name, "there are no triangles", "a surface needs one at least");
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (!is_finite(vertices[v])) {
      refuse_mesh(name, fmt::format("vertex {} at {} is not finite", v, show(vertices[v])),
                  "numbers count from 0; check the program that wrote the mesh");
    }
  }
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (const int corner : triangles[t]) {
      if (corner < 0 || corner >= static_cast<int>(vertices.size())) {
        refuse_mesh(name, fmt::format("triangle {} has vertex {}, but there are {}", t, corner, vertices.size()),
                    "vertices and triangles count from 0");
      }
    }
  }
}

Box box_of(const std::vector<Vec3>& vertices, const std::vector<Corners>& triangles) {
  Box box{vertices[triangles[0][0]], vertices[triangles[0][0]]};
  for (const Corners& corners : triangles) {
    for (const int corner : corners) {
      const Vec3& p = vertices[corner];
      box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
      box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
    }
  }
  return box;
}

void check_triangles(const std::vector<Vec3>& vertices, const std::vector<Corners>& triangles, double distance,
                     const std::string& name) {
  std::vector<std::pair<Corners, int>> sorted;
  for (int t = 0; t < static_cast<int>(triangles.size()); ++t) {
    Corners c = triangles[t];
    const Vec3 &a = vertices[c[0]], &b = vertices[c[1]], &d = vertices[c[2]];
    const double longest = std::sqrt(std::max({squared(b - a), squared(d - b), squared(a - d)}));
    const double twice_area = length(cross(b - a, d - a));
    if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0] || !(twice_area > distance * longest)) {
      refuse_mesh(
          name,
          fmt::format("triangle {} at {} has no area: its height is {:.3g} m, below the welding distance {:.3g} m", t,
                      show(a), longest > 0 ? twice_area / longest : 0.0, distance),
          "leave it out and split its longest edge in the neighbour");
    }
    std::sort(c.begin(), c.end());
    sorted.push_back({c, t});
  }
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    if (sorted[i].first == sorted[i - 1].first) {
      refuse_mesh(name, fmt::format("triangles {} and {} are the same", sorted[i - 1].second, sorted[i].second),
                  "leave one out; two sides of a sheet need only one triangle");
    }
  }
}

std::vector<std::array<EdgeLink, 3>> link_edges(const std::vector<Vec3>& vertices,
                                                const std::vector<Corners>& triangles, const std::string& name) {
  std::vector<std::array<EdgeLink, 3>> links(triangles.size());
  const std::vector<Side> sides = sorted_sides(triangles);
  for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
    const Side &a = sides[i], &b = sides[i + 1];
    if (a.low != b.low || a.high != b.high) continue;
    const std::string edge = fmt::format("the edge from {} to {}", show(vertices[a.low]), show(vertices[a.high]));
    if (i + 2 < sides.size() && sides[i + 2].low == a.low && sides[i + 2].high == a.high) {
      refuse_mesh(name,
                  fmt::format("{} is shared by more than two triangles: {}, {}, {}", edge, a.triangle, b.triangle,
                              sides[i + 2].triangle),
                  "a surface may not branch: leave out the walls inside, or keep the parts apart");
    }
    if (a.forward == b.forward) {
      refuse_mesh(name, fmt::format("triangles {} and {} face opposite sides at {}", a.triangle, b.triangle, edge),
                  "let all triangles run counter-clockwise seen from outside");
    }
    links[a.triangle][a.edge] = {b.triangle, b.edge};
    links[b.triangle][b.edge] = {a.triangle, a.edge};
  }
  return links;
}

void check_t_joints(const std::vector<Vec3>& vertices, const std::vector<Corners>& triangles, double distance,
                    const std::string& name) {
  const VertexTree tree(vertices);
  const std::vector<Side> sides = sorted_sides(triangles);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const Side& side = sides[i];
    if (i > 0 && sides[i - 1].low == side.low && sides[i - 1].high == side.high) continue;
    const int joint = tree.near_segment(side.low, side.high, distance);
    if (joint < 0) continue;
    refuse_mesh(name,
                fmt::format("a T-joint: the vertex at {} lies inside the edge from {} to {} of triangle {}",
                            show(vertices[joint]), show(vertices[side.low]), show(vertices[side.high]), side.triangle),
                "split that triangle at the vertex");
  }
}

void check_closed(const std::vector<Vec3>& vertices, const std::vector<Corners>& triangles,
                  const std::vector<std::array<EdgeLink, 3>>& links, const std::string& name) {
  std::vector<int> round(vertices.size(), 0), any(vertices.size(), -1);
  double volume = 0;
  for (int t = 0; t < static_cast<int>(triangles.size()); ++t) {
    const Corners& c = triangles[t];
    const Vec3& origin = vertices[triangles[0][0]];
    volume += dot(vertices[c[0]] - origin, cross(vertices[c[1]] - origin, vertices[c[2]] - origin)) / 6;
    for (int i = 0; i < 3; ++i) {
      ++round[c[i]], any[c[i]] = t;
      if (links[t][i].triangle >= 0) continue;
      refuse_mesh(name,
                  fmt::format("not closed: the edge from {} to {} of triangle {} has no other triangle",
                              show(vertices[c[i]]), show(vertices[c[next(i)]]), t),
                  "close the hole in the program that drew it");
    }
  }
  for (int v = 0; v < static_cast<int>(vertices.size()); ++v) {
    if (round[v] == 0) continue;  // of no triangle
    int turned = 0;
    for (int t = any[v]; turned == 0 || t != any[v]; ++turned) {
      int i = 0;
      while (triangles[t][i] != v) ++i;
      t = links[t][i].triangle;  // across the edge that starts at v: round it one way
    }
    if (turned != round[v]) {
      refuse_mesh(name, fmt::format("two parts of the surface share only the vertex at {}", show(vertices[v])),
                  "keep the parts apart, or join them along edges");
    }
  }
  if (!(volume > 0)) {
    refuse_mesh(name, fmt::format("the triangles face inward: the volume is {:.6g} m^3", volume),
                "swap two corners of each triangle");
  }
}

}  // namespace soilbin::dem
