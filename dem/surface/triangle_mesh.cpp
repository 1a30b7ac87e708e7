#include "dem/surface/triangle_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "dem/surface/mesh_checks.hpp"

namespace soilbin::dem {
namespace {

/// The unit normal, from the two sides that meet in the widest angle: their cross product is the most exact.
Vec3 normal_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double ab = squared(b - a), bc = squared(c - b), ca = squared(a - c);
  if (bc >= ab && bc >= ca) return unit(cross(b - a, c - a));
  if (ca >= ab) return unit(cross(c - b, a - b));
  return unit(cross(a - c, b - c));
}

/// Round the longest side where the corner across it is not acute, else through the three corners.
BoundingBall ball_round(const std::array<Vec3, 3>& p) {
  Vec3 centre;
  bool acute = true;
  for (int i = 0; i < 3; ++i) {
    const Vec3 &a = p[i], &b = p[(i + 1) % 3], &c = p[(i + 2) % 3];
    if (dot(b - a, c - a) <= 0) centre = 0.5 * (b + c), acute = false;
  }
  if (acute) {
    const Vec3 ab = p[1] - p[0], ac = p[2] - p[0], n = cross(ab, ac);
    centre = p[0] + (squared(ac) * cross(n, ab) + squared(ab) * cross(ac, n)) / (2 * squared(n));
  }
  const BoundingBall ball{static_cast<float>(centre.x), static_cast<float>(centre.y), static_cast<float>(centre.z), 0};
  double radius = 0;
  for (const Vec3& corner : p) radius = std::max(radius, length(corner - Vec3{ball.x, ball.y, ball.z}));
  return {ball.x, ball.y, ball.z, static_cast<float>(radius * (1 + 1e-6))};
}

double angle_between(const Vec3& a, const Vec3& b) { return std::atan2(length(cross(a, b)), dot(a, b)); }

}  // namespace

TriangleMesh::TriangleMesh(std::vector<Vec3> vertices, std::vector<Corners> triangles, const MeshOptions& options)
    : vertices_(std::move(vertices)), triangles_(std::move(triangles)), closed_(options.closed), name_(options.name) {
  check_numbers(vertices_, triangles_, name_);
  const Box box = box_of(vertices_, triangles_);
  const double distance = options.weld * length(box.high - box.low);
  if (!(options.weld >= 0 && options.weld < 0.1)) {
    refuse_mesh(name_, "the welding distance must be from 0 to 0.1 of the mesh's diagonal", "1e-6 is the default");
  }
  if (!options.as_given) weld(vertices_, triangles_, distance);
  check_triangles(vertices_, triangles_, options.as_given ? 0 : distance, name_);
  links_ = link_edges(vertices_, triangles_, name_);
  if (!options.as_given) check_t_joints(vertices_, triangles_, distance, name_);
  if (closed_) check_closed(vertices_, triangles_, links_, name_);

  bounds_ = box_of(vertices_, triangles_);
  double farthest = 0;
  for (const Vec3& p : {bounds_.low, bounds_.high}) {
    farthest = std::max({farthest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  rounding_ = 16 * std::numeric_limits<double>::epsilon() * farthest;
  set_frames();
  set_vertex_data();
}

void TriangleMesh::set_frames() {
  frames_.resize(triangles_.size());
  for (int t = 0; t < size(); ++t) {
    const std::array<Vec3, 3> p{corner(t, 0), corner(t, 1), corner(t, 2)};
    balls_.push_back(ball_round(p));
    TriangleFrame& f = frames_[t];
    f.normal = normal_of(p[0], p[1], p[2]);
    f.offset = dot(f.normal, p[0]);
    for (int i = 0; i < 3; ++i) {
      f.sides[i] = unit(cross(p[(i + 1) % 3] - p[i], f.normal));
      f.side_offsets[i] = dot(f.sides[i], p[i]);
    }
    area_ += 0.5 * length(cross(p[1] - p[0], p[2] - p[0]));
  }
}

void TriangleMesh::set_vertex_data() {
  std::vector<std::vector<std::pair<int, int>>> round(vertices_.size());  // triangle and corner
  for (int t = 0; t < size(); ++t) {
    for (int i = 0; i < 3; ++i) round[triangles_[t][i]].push_back({t, i});
  }
  vertex_normals_.resize(vertices_.size());
  first_direction_ = {0};
  std::vector<int> reached_from(vertices_.size(), -1);  // the last vertex from which an edge led here
  for (int v = 0; v < static_cast<int>(vertices_.size()); ++v) {
    for (const auto& [t, i] : round[v]) {
      const int b = triangles_[t][(i + 1) % 3], c = triangles_[t][(i + 2) % 3];
      const Vec3 to_b = unit(vertices_[b] - vertices_[v]), to_c = unit(vertices_[c] - vertices_[v]);
      for (const int end : {b, c}) {
        if (reached_from[end] != v) {
          reached_from[end] = v;
          directions_.push_back(end == b ? to_b : to_c);
        }
      }
      // As wide as a straight line the sum of the two vanishes: across, in the plane, is half-way then.
      if (dot(to_b, to_c) < 0) directions_.push_back(unit(cross(frames_[t].normal, to_b - to_c)));
      vertex_normals_[v] += angle_between(to_b, to_c) * frames_[t].normal;
    }
    first_direction_.push_back(static_cast<int>(directions_.size()));
  }
}

}  // namespace soilbin::dem
