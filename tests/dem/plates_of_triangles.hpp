// One and the same plate, [-1, 1]^2 in z = 0 with normal +z, cut into triangles in many ways.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "dem/surface/touching_points.hpp"
#include "dem/surface/triangle_mesh.hpp"

namespace soilbin::dem::tests {

struct Soup {
  std::vector<Vec3> vertices;
  std::vector<std::array<int, 3>> triangles;
};

inline double uniform(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

inline Vec3 any_direction(std::mt19937_64& random) {
  for (;;) {
    const Vec3 v{uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)};
    if (squared(v) > 0.01 && squared(v) < 1) return unit(v);
  }
}

inline Rotation any_rotation(std::mt19937_64& random) {
  return rotation_by(uniform(random, 0, 3) * any_direction(random));
}

inline Soup moved(Soup soup, const Rotation& turn, const Vec3& shift) {
  for (Vec3& v : soup.vertices) v = turn(v) + shift;
  return soup;
}

inline Soup two_triangles() { return {{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}}; }

/// Four triangles round an inner vertex.
inline Soup fan(double x, double y) {
  return {{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {x, y, 0}}, {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}};
}

inline Soup cells(int n, int m) {
  Soup soup;
  for (int j = 0; j <= m; ++j) {
    for (int i = 0; i <= n; ++i) soup.vertices.push_back({-1 + 2.0 * i / n, -1 + 2.0 * j / m, 0});
  }
  for (int j = 0; j < m; ++j) {
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
      soup.triangles.push_back({a, b, c}), soup.triangles.push_back({a, c, d});
    }
  }
  return soup;
}

/// Twice the area of a, b, c seen from +z.
inline double turning(const Vec3& a, const Vec3& b, const Vec3& c) { return cross(b - a, c - a).z; }

/// The height of a triangle over its longest side.
inline double height_of(const Soup& s, const std::array<int, 3>& t) {
  const Vec3 &a = s.vertices[t[0]], &b = s.vertices[t[1]], &c = s.vertices[t[2]];
  return length(cross(b - a, c - a)) / std::sqrt(std::max({squared(b - a), squared(c - b), squared(a - c)}));
}

/// Swaps the diagonal of the quadrangle of two triangles, where it is convex and no triangle gets lower than `lowest`.
inline void flip(Soup& soup, int t, int i, double lowest) {
  const int a = soup.triangles[t][i], b = soup.triangles[t][(i + 1) % 3], c = soup.triangles[t][(i + 2) % 3];
  for (int u = 0; u < static_cast<int>(soup.triangles.size()); ++u) {
    for (int j = 0; j < 3; ++j) {
      if (soup.triangles[u][j] != b || soup.triangles[u][(j + 1) % 3] != a) continue;
      const int d = soup.triangles[u][(j + 2) % 3];
      const std::array<int, 3> one{a, d, c}, two{d, b, c};
      const auto& v = soup.vertices;
      if (turning(v[a], v[d], v[c]) <= 0 || turning(v[d], v[b], v[c]) <= 0) return;
      if (height_of(soup, one) < lowest || height_of(soup, two) < lowest) return;
      soup.triangles[t] = one, soup.triangles[u] = two;
      return;
    }
  }
}

/// Random points put into triangles, some of them close to an edge, and random flips: vertices of few and of many
/// triangles, corners from almost none to almost straight. No triangle is lower than `lowest`.
inline Soup random_plate(std::mt19937_64& random, int points, double lowest) {
  Soup soup = two_triangles();
  while (static_cast<int>(soup.vertices.size()) < points + 4) {
    const int t = static_cast<int>(random() % soup.triangles.size());
    const auto corners = soup.triangles[t];
    double u = uniform(random, 0.1, 1), v = uniform(random, 0.1, 1), w = uniform(random, 0.1, 1);
    if (random() % 3 == 0) w = std::pow(10, uniform(random, std::log10(lowest), -1));
    const double sum = u + v + w;
    const Vec3 p =
        (u * soup.vertices[corners[0]] + v * soup.vertices[corners[1]] + w * soup.vertices[corners[2]]) / sum;
    const int k = static_cast<int>(soup.vertices.size());
    soup.vertices.push_back(p);
    const std::array<std::array<int, 3>, 3> parts{
        {{corners[0], corners[1], k}, {corners[1], corners[2], k}, {corners[2], corners[0], k}}};
    if (std::any_of(parts.begin(), parts.end(), [&](const auto& part) {
          return turning(soup.vertices[part[0]], soup.vertices[part[1]], soup.vertices[part[2]]) <= 0 ||
                 height_of(soup, part) < lowest;
        })) {
      soup.vertices.pop_back();
      continue;
    }
    soup.triangles[t] = parts[0];
    soup.triangles.push_back(parts[1]), soup.triangles.push_back(parts[2]);
    for (int i = 0; i < 3; ++i) {
      flip(soup, static_cast<int>(random() % soup.triangles.size()), static_cast<int>(random() % 3), lowest);
    }
  }
  return soup;
}

inline std::vector<int> all_triangles(const TriangleMesh& mesh) {
  std::vector<int> all;
  for (int t = 0; t < mesh.size(); ++t) all.push_back(t);
  return all;
}

/// A cube [-1, 1]^3 as vertices and triangles, counter-clockwise seen from outside.
inline Soup cube() {
  return {{{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}},
          {{0, 3, 2},
           {0, 2, 1},
           {4, 5, 6},
           {4, 6, 7},
           {0, 1, 5},
           {0, 5, 4},
           {1, 2, 6},
           {1, 6, 5},
           {2, 3, 7},
           {2, 7, 6},
           {3, 0, 4},
           {3, 4, 7}}};
}

/// Where a sphere touches the mesh.
inline TouchingPoints touch(const TriangleMesh& mesh, const Vec3& c, double radius, double merge = 0.2) {
  TouchingPoints out;
  find_touching_points(mesh, all_triangles(mesh), c, radius, MergeAngle(merge), out);
  return out;
}

}  // namespace soilbin::dem::tests
