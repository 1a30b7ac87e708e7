#include "dem/surface/shapes.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "dem/surface/drawn_wheel.hpp"
#include "dem/surface/mesh_checks.hpp"
#include "dem/surface/positive.hpp"

namespace soilbin::dem {
namespace {

using std::numbers::pi;

void require(const std::string& shape, bool met, const std::string& message, const std::string& hint) {
  if (!met) refuse_mesh(shape, message, hint);
}

void require_size(const std::string& shape, const std::string& what, double size) {
  require(shape, positive(size), fmt::format("{} is {} m", what, size), "it must be positive and finite");
}

/// How many parts of at most `edge` a length is cut into.
int parts_of(const std::string& shape, double length, double edge) {
  require(shape, edge > 0, fmt::format("the target edge is {} m", edge), "it must be positive");
  const double parts = std::max(1.0, std::ceil(length / edge * (1 - 1e-9)));
  require(shape, parts <= 1e5, fmt::format("an edge of {} m cuts {} m into more than 100000 parts", edge, length),
          "take a longer edge");
  return static_cast<int>(parts);
}

/// Patches put side by side. Each brings its own vertices: welding joins them.
struct Patchwork {
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Corners> triangles;

  /// The cells n x m of a patch at(i, j); seen from outside, j runs to the left of i.
  void add(int n, int m, const std::function<Vec3(int, int)>& at) {
    const int first = static_cast<int>(vertices.size());
    for (int j = 0; j <= m; ++j) {
      for (int i = 0; i <= n; ++i) vertices.push_back(at(i, j));
    }
    for (int j = 0; j < m; ++j) {
      for (int i = 0; i < n; ++i) {
        const int a = first + j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
        triangles.push_back({a, b, c});
        triangles.push_back({a, c, d});
      }
    }
  }
};

/// A place on a wheel: distance from the axle, angle from the top towards the front, place along the axle.
Vec3 on_wheel(double radius, double angle, double y) { return {radius * std::sin(angle), y, radius * std::cos(angle)}; }

/// The tread in one plane square to the axle: angles round the base circle; intervals i to i + 1 of a bar are flagged.
struct Section {
  double radius = 0, height = 0, half_thickness = 0;
  int layers = 1;                             ///< of cells up a bar's side
  std::vector<double> angles;                 ///< of the base circle, ascending, one turn; the first is not repeated
  std::vector<char> in_bar;                   ///< interval i is under a bar
  std::vector<double> bar_centre, bar_share;  ///< at each angle of a bar: its middle, and how far off it, -1 to 1

  int size() const { return static_cast<int>(angles.size()); }
  int wrap(int i) const { return i % size(); }
  /// The angle of station i at this layer of a bar: its sides are parallel, so the angle shrinks outward.
  double bar_angle(int i, int layer) const {
    if (layer == 0) return angles[i];
    const double rho = radius + height * layer / layers;
    const double half = std::asin(half_thickness / rho);
    return bar_centre[i] + bar_share[i] * half;
  }
  Vec3 at(int i, int layer, double y, double turn) const {
    const double rho = layer == 0 ? radius : radius + height * layer / layers;
    return on_wheel(rho, bar_angle(wrap(i), layer) + turn, y);
  }
};

/// Stations along the axle, and how far the section has turned there.
struct Sweep {
  std::vector<double> y, turn;
  int cells() const { return static_cast<int>(y.size()) - 1; }
};

/// A row of vertices round the axle, angles ascending.
struct Ring {
  int first = 0;
  std::vector<double> angles;
  int size() const { return static_cast<int>(angles.size()); }
  int vertex(int i) const { return first + i % size(); }
  double middle_of_edge(int i) const {
    const double next = i + 1 < size() ? angles[i + 1] : angles[0] + 2 * pi;
    return (angles[i] + next) / 2;
  }
};

/// The strip between two rings in one plane, seen from +y. The edge whose middle comes first is taken first, so that
/// each hangs on a corner of the other ring that it sees.
void add_strip(const Ring& outer, const Ring& inner, const std::function<void(int, int, int)>& triangle) {
  for (int i = 0, j = 0; i < outer.size() || j < inner.size();) {
    const bool take_outer =
        j == inner.size() || (i < outer.size() && outer.middle_of_edge(i) <= inner.middle_of_edge(j));
    if (take_outer) {
      triangle(outer.vertex(i), outer.vertex(i + 1), inner.vertex(j));
      ++i;
    } else {
      triangle(inner.vertex(j), outer.vertex(i), inner.vertex(j + 1));
      ++j;
    }
  }
}

/// A disc of triangles inside the base circle at one end of the axle, facing out: rings at about the edge's spacing.
void add_disc(Patchwork& work, const Section& section, double y, double turn, double edge) {
  const auto triangle = [&](int a, int b, int c) {
    work.triangles.push_back(y > 0 ? TriangleMesh::Corners{a, b, c} : TriangleMesh::Corners{a, c, b});
  };
  const auto add_ring = [&](double radius, std::vector<double> angles) {
    const Ring ring{static_cast<int>(work.vertices.size()), std::move(angles)};
    for (const double angle : ring.angles) work.vertices.push_back(on_wheel(radius, angle + turn, y));
    return ring;
  };
  Ring outer = add_ring(section.radius, section.angles);
  double longest = 0;
  for (int i = 0; i < outer.size(); ++i) longest = std::max(longest, 2 * (outer.middle_of_edge(i) - outer.angles[i]));
  // Rings lie inside the circle that the sides of the outermost touch.
  const double within = section.radius * std::cos(longest / 2);
  const int rings = edge < within ? parts_of("wheel", within, edge) : 1;
  for (int k = rings - 1; k >= 1; --k) {
    const int count = std::max(6, static_cast<int>(std::lround(2 * pi * k)));
    std::vector<double> angles;
    for (int i = 0; i < count; ++i) angles.push_back(section.angles[0] + 2 * pi * i / count);
    Ring inner = add_ring(within * k / rings, std::move(angles));
    add_strip(outer, inner, triangle);
    outer = std::move(inner);
  }
  const int centre = static_cast<int>(work.vertices.size());
  work.vertices.push_back({0, y, 0});
  for (int i = 0; i < outer.size(); ++i) triangle(outer.vertex(i), outer.vertex(i + 1), centre);
}

/// The ends of the bars in a plane square to the axle, seen from its left (+y) or its right.
void add_bar_ends(Patchwork& work, const Section& section, double y, double turn, bool from_left) {
  for (int i = 0; i < section.size(); ++i) {
    if (!section.in_bar[i]) continue;
    work.add(1, section.layers,
             [&](int a, int layer) { return section.at(i + (from_left ? 1 - a : a), layer, y, turn); });
  }
}

void add_tread(Patchwork& work, const Section& section, const Sweep& sweep) {
  for (int i = 0; i < section.size(); ++i) {
    const int top = section.in_bar[i] ? section.layers : 0;
    work.add(sweep.cells(), 1, [&](int j, int a) { return section.at(i + 1 - a, top, sweep.y[j], sweep.turn[j]); });
    const bool before = section.in_bar[section.wrap(i + section.size() - 1)], after = section.in_bar[i];
    if (before == after) continue;
    work.add(sweep.cells(), section.layers, [&](int j, int layer) {
      return section.at(i, after ? section.layers - layer : layer, sweep.y[j], sweep.turn[j]);
    });
  }
}

TriangleMesh swept(const std::string& name, const Section& section, const Sweep& sweep, double edge) {
  Patchwork work;
  add_tread(work, section, sweep);
  for (const std::size_t end : {std::size_t{0}, sweep.y.size() - 1}) {
    add_disc(work, section, sweep.y[end], sweep.turn[end], edge);
    add_bar_ends(work, section, sweep.y[end], sweep.turn[end], sweep.y[end] > 0);
  }
  return {std::move(work.vertices), std::move(work.triangles), {.closed = true, .weld = 1e-9, .name = name}};
}

/// Two halves of one base circle whose bars differ; the bars of each end in faces on the centre line.
TriangleMesh swept_halves(const std::string& name, const Section& right, const Section& left, double width, double edge,
                          double turn_per_metre) {
  const int n = parts_of(name, width / 2, edge);
  Patchwork work;
  for (const bool is_left : {false, true}) {
    const Section& section = is_left ? left : right;
    Sweep sweep;  // from low y to high
    for (int j = 0; j <= n; ++j) {
      sweep.y.push_back(width / 2 * (is_left ? 1.0 * j / n : 1.0 * j / n - 1));
      sweep.turn.push_back(-std::abs(sweep.y[j]) * turn_per_metre);
    }
    add_tread(work, section, sweep);
    const std::size_t outer = is_left ? sweep.y.size() - 1 : 0, inner = sweep.y.size() - 1 - outer;
    add_disc(work, section, sweep.y[outer], sweep.turn[outer], edge);
    add_bar_ends(work, section, sweep.y[outer], sweep.turn[outer], is_left);
    add_bar_ends(work, section, sweep.y[inner], sweep.turn[inner], !is_left);
  }
  return {std::move(work.vertices), std::move(work.triangles), {.closed = true, .weld = 1e-9, .name = name}};
}

/// Turned by -turn_per_metre times y, or of `halves` times |y|. Where it turns a station stands on the centre line.
Sweep sweep_over(const std::string& shape, double width, double edge, double turn_per_metre, bool halves) {
  const int n = turn_per_metre != 0 ? 2 * parts_of(shape, width / 2, edge) : parts_of(shape, width, edge);
  Sweep sweep;
  for (int j = 0; j <= n; ++j) {
    sweep.y.push_back(width * (2.0 * j / n - 1) / 2);
    sweep.turn.push_back(-(halves ? std::abs(sweep.y[j]) : sweep.y[j]) * turn_per_metre);
  }
  return sweep;
}

/// Every place of a bar, or of `sides` = 2 every second one: the even ones, or with `odd` the others.
Section lugged_section(const std::string& name, const Tire& tire, double edge, int sides = 1, bool odd = false) {
  require(name, tire.lugs.count && *tire.lugs.count > 0, "the number of lugs is not known", "give lugs.count");
  require(name, tire.lugs.thickness.has_value(), "the thickness of the lugs is not known", "give lugs.thickness");
  require_size(name, "lugs.thickness", *tire.lugs.thickness);
  const int count = sides * *tire.lugs.count;
  Section section;
  section.radius = tire.radius, section.height = tire.lugs.height;
  section.half_thickness = *tire.lugs.thickness / 2;
  const double share = section.half_thickness / tire.radius;
  require(name, why_no_gaps(tire).empty(), why_no_gaps(tire), "fewer or thinner lugs");
  const double half = std::asin(share), pitch = 2 * pi / count;
  section.layers = parts_of(name, section.height, edge);
  const int bar = parts_of(name, *tire.lugs.thickness, edge);
  // A chord of the base circle sags by radius (step/2)^2/2; steps of at most 0.3 rad keep a coarse tire round.
  const int gap = parts_of(name, pitch - 2 * half, std::min(edge / tire.radius, 0.3));
  for (int k = 0; k < count; ++k) {
    const double centre = k * pitch;
    for (int i = 0; i < bar + gap; ++i) {
      const bool in_bar = i < bar && k % sides == (odd ? 1 : 0);
      const double share_here = std::min(2.0 * i / bar - 1, 1.0);
      section.angles.push_back(i <= bar ? centre + share_here * half
                                        : centre + half + (pitch - 2 * half) * (i - bar) / gap);
      section.in_bar.push_back(in_bar);
      section.bar_centre.push_back(centre);
      section.bar_share.push_back(share_here);
    }
  }
  return section;
}

}  // namespace

TriangleMesh box(const Vec3& size, double edge) {
  require_size("box", "its length", size.x);
  require_size("box", "its width", size.y);
  require_size("box", "its height", size.z);
  const int n = parts_of("box", size.x, edge), m = parts_of("box", size.y, edge), k = parts_of("box", size.z, edge);
  const auto part = [](double whole, int i, int of) { return whole * (2.0 * i / of - 1) / 2; };
  Patchwork work;
  for (const double s : {-1.0, 1.0}) {  // on the sides of low coordinates the first axis runs backward
    const auto along = [s](int i, int of) { return s > 0 ? i : of - i; };
    work.add(n, m, [&](int i, int j) {
      return Vec3{part(size.x, along(i, n), n), part(size.y, j, m), s * size.z / 2};
    });
    work.add(m, k, [&](int i, int j) {
      return Vec3{s * size.x / 2, part(size.y, along(i, m), m), part(size.z, j, k)};
    });
    work.add(k, n, [&](int i, int j) {
      return Vec3{part(size.x, j, n), s * size.y / 2, part(size.z, along(i, k), k)};
    });
  }
  return {std::move(work.vertices), std::move(work.triangles), {.closed = true, .weld = 1e-9, .name = "box"}};
}

TriangleMesh plate(double length_x, double length_y, int n, int m) {
  require_size("plate", "its length", length_x);
  require_size("plate", "its width", length_y);
  require("plate", n >= 1 && m >= 1, fmt::format("{} x {} cells", n, m), "it has one cell at least each way");
  Patchwork work;
  work.add(n, m, [&](int i, int j) {
    return Vec3{length_x * (2.0 * i / n - 1) / 2, length_y * (2.0 * j / m - 1) / 2, 0};
  });
  return {std::move(work.vertices), std::move(work.triangles), {.weld = 1e-9, .name = "plate"}};
}

TriangleMesh smooth_wheel(double radius, double width, int segments, double edge) {
  require_size("smooth wheel", "its radius", radius);
  require_size("smooth wheel", "its width", width);
  require("smooth wheel", segments >= 3, fmt::format("{} segments", segments), "it has three at least");
  Section section;
  section.radius = radius;
  for (int i = 0; i < segments; ++i) section.angles.push_back(2 * pi * i / segments);
  section.in_bar.assign(segments, 0);
  section.bar_centre = section.bar_share = std::vector<double>(segments, 0.0);
  return swept("smooth wheel", section, sweep_over("smooth wheel", width, edge, 0, false), edge);
}

TriangleMesh tire_surface(const Tire& tire, const TireMeshing& meshing) {
  const std::string name = tire.name.empty() ? "tire" : tire.name;
  require_size(name, "its radius", tire.radius);
  require_size(name, "its width", tire.width);
  if (!meshing.drawn.empty()) return read_wheel(meshing.drawn, tire).mesh;
  require_size(name, "the target edge", meshing.edge);
  if (!is_lugged(tire)) {
    const int segments = std::max(24, parts_of(name, 2 * pi * tire.radius, meshing.edge));
    return smooth_wheel(tire.radius, tire.width, segments, meshing.edge);
  }
  const LugPattern pattern = tire.lugs.pattern;
  const double angle = tire.lugs.angle.value_or(pattern == LugPattern::straight ? 0.0 : usual_lug_angle);
  require(name, angle >= 0 && angle <= 1.2, fmt::format("a chevron angle of {} rad", angle), "it is from 0 to 1.2 rad");
  require(name, pattern != LugPattern::straight || angle == 0,
          fmt::format("straight lugs at an angle of {} rad", angle),
          "give lugs.pattern: chevron, slanted or staggered");
  const double slant = std::tan(angle) / tire.radius;
  if (pattern == LugPattern::staggered)
    return swept_halves(name, lugged_section(name, tire, meshing.edge, 2, true),
                        lugged_section(name, tire, meshing.edge, 2), tire.width, meshing.edge, slant);
  return swept(name, lugged_section(name, tire, meshing.edge),
               sweep_over(name, tire.width, meshing.edge, slant, pattern == LugPattern::chevron), meshing.edge);
}

}  // namespace soilbin::dem
