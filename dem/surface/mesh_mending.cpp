#include "dem/surface/mesh_mending.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>

#include "dem/surface/inside.hpp"
#include "dem/surface/mesh_checks.hpp"
#include "dem/surface/vertex_tree.hpp"

namespace soilbin::dem {
namespace {

using Corners = TriangleMesh::Corners;

constexpr double share_of_diagonal = 1e-6;  ///< of the tolerance, as MeshOptions::weld has it
constexpr int most_rounds = 64;             ///< of taking out slivers that arise from others
constexpr std::size_t most_places = 100;

int following(int i) { return i == 2 ? 0 : i + 1; }

std::string place_in_drawing(const Vec3& p) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x, p.y, p.z); }

/// Sets that grow together.
class Groups {
 public:
  explicit Groups(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
  int of(int k) {
    while (parent_[k] != k) k = parent_[k] = parent_[parent_[k]];
    return k;
  }
  /// The lower one stands for both.
  void join(int a, int b) {
    a = of(a), b = of(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<int> parent_;
};

using Edge = std::pair<int, int>;  // vertices, ascending
Edge edge_of(int a, int b) { return std::minmax(a, b); }

/// Edges that are to be split, each at one vertex.
using Splits = std::map<Edge, int>;

bool has(const Corners& corners, int vertex) { return std::ranges::find(corners, vertex) != corners.end(); }

/// The edge of this triangle that is to be split, or -1.
int edge_to_split(const Corners& c, const Splits& splits) {
  for (int i = 0; i < 3; ++i) {
    const auto found = splits.find(edge_of(c[i], c[following(i)]));
    if (found != splits.end() && !has(c, found->second)) return i;
  }
  return -1;
}

/// The soup while it is mended: steps that each take it further.
class Mending {
 public:
  Mending(MeshSoup soup, const std::string& name, MeshMends& mends)
      : vertices_(std::move(soup.vertices)), triangles_(std::move(soup.triangles)), name_(name), mends_(mends) {
    check_numbers(vertices_, triangles_, name_);
    mends_ = {};
    mends_.given = static_cast<int>(triangles_.size());
    const Box box = box_of(vertices_, triangles_);
    mends_.tolerance = share_of_diagonal * length(box.high - box.low);
    weld(vertices_, triangles_, mends_.tolerance);
  }

  void close_cracks() {
    for (int round = 0; round < most_rounds; ++round) {
      const bool thinner = take_out_slivers();
      leave_out_doubled();
      if (triangles_.empty()) refuse_mesh(name_, "its triangles have no area", "export it again");
      if (!split_at_joints() && !thinner) return;
    }
    refuse_mesh(name_, fmt::format("triangles lower than {:.3g} of its units come up again and again", tolerance()),
                "mesh it anew, coarser, in the program that drew it");
  }

  MeshSoup outer_surfaces();

 private:
  double tolerance() const { return mends_.tolerance; }
  void note(const Vec3& place) {
    if (mends_.places.size() < most_places) mends_.places.push_back(place);
  }

  bool is_sliver(const Corners& c) const;
  bool take_out_slivers();
  void leave_out_doubled();
  bool split_at_joints();
  int split(const Splits& splits);
  MeshSoup bodies_of_outside(MeshSoup& open, std::vector<char>& turned);

  std::vector<Vec3> vertices_;
  std::vector<Corners> triangles_;
  const std::string& name_;
  MeshMends& mends_;
};

/// As check_triangles sees it.
bool Mending::is_sliver(const Corners& c) const {
  if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) return true;
  const Vec3 &a = vertices_[c[0]], &b = vertices_[c[1]], &d = vertices_[c[2]];
  const double longest = std::sqrt(std::max({squared(b - a), squared(d - b), squared(a - d)}));
  return !(length(cross(b - a, d - a)) > tolerance() * longest);
}

/// A sliver of two corners is nothing; one of three is its longest edge, with the tip across on it.
bool Mending::take_out_slivers() {
  Splits splits;
  std::vector<Corners> staying;
  bool any = false;
  for (const Corners& c : triangles_) {
    if (!is_sliver(c)) {
      staying.push_back(c);
      continue;
    }
    if (c[0] != c[1] && c[1] != c[2] && c[2] != c[0]) {
      int longest = 0;
      for (int i = 1; i < 3; ++i)
        if (squared(vertices_[c[following(i)]] - vertices_[c[i]]) >
            squared(vertices_[c[following(longest)]] - vertices_[c[longest]]))
          longest = i;
      const int tip = c[following(following(longest))];
      const auto [place, fresh] = splits.try_emplace(edge_of(c[longest], c[following(longest)]), tip);
      if (!fresh && place->second != tip) {  // the edge is split at another's tip first
        staying.push_back(c);
        continue;
      }
      note(vertices_[tip]);
    } else {
      note(vertices_[c[0]]);
    }
    ++mends_.slivers, any = true;
  }
  triangles_ = std::move(staying);
  split(splits);
  return any;
}

void Mending::leave_out_doubled() {
  std::vector<std::pair<Corners, int>> sorted;
  for (int t = 0; t < static_cast<int>(triangles_.size()); ++t) {
    Corners c = triangles_[t];
    std::ranges::sort(c);
    sorted.push_back({c, t});
  }
  std::ranges::sort(sorted);
  std::vector<char> doubled(triangles_.size(), 0);
  for (std::size_t k = 1; k < sorted.size(); ++k)
    if (sorted[k].first == sorted[k - 1].first) doubled[sorted[k].second] = 1;
  std::vector<Corners> staying;
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    if (!doubled[t]) {
      staying.push_back(triangles_[t]);
      continue;
    }
    ++mends_.doubled;
    note(vertices_[triangles_[t][0]]);
  }
  triangles_ = std::move(staying);
}

/// Where an edge has no neighbour and a vertex lies on it, the neighbour has that vertex.
bool Mending::split_at_joints() {
  const std::vector<Side> sides = sorted_sides(triangles_);
  Splits splits;
  std::optional<VertexTree> tree;
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i + 1;
    while (end < sides.size() && sides[end].low == sides[i].low && sides[end].high == sides[i].high) ++end;
    if (end == i + 1) {
      if (!tree) tree.emplace(vertices_);
      const int joint = tree->near_segment(sides[i].low, sides[i].high, tolerance());
      if (joint >= 0 && !has(triangles_[sides[i].triangle], joint)) splits[{sides[i].low, sides[i].high}] = joint;
    }
    i = end;
  }
  for (const auto& [edge, vertex] : splits) note(vertices_[vertex]);
  mends_.split += split(splits);
  return !splits.empty();
}

/// Each triangle becomes those that its edges' splits make of it, in its place. Gives how many were split.
int Mending::split(const Splits& splits) {
  if (splits.empty()) return 0;
  std::vector<Corners> out, parts;
  int count = 0;
  for (const Corners& whole : triangles_) {
    parts = {whole};
    count += edge_to_split(whole, splits) >= 0;
    while (!parts.empty()) {
      const Corners c = parts.back();
      parts.pop_back();
      const int i = edge_to_split(c, splits);
      if (i < 0) {
        out.push_back(c);
        continue;
      }
      const int j = following(i), k = following(j), at = splits.at(edge_of(c[i], c[j]));
      parts.push_back({at, c[j], c[k]});
      parts.push_back({c[i], at, c[k]});
    }
  }
  triangles_ = std::move(out);
  return count;
}

// The outside.

/// A side of a triangle: that which its corners run counter-clockwise on, or the other.
struct Face {
  int triangle;
  bool front;
};

/// Triangles round every edge, in the order in which a turn about the edge, from its lower to its higher vertex,
/// meets them.
class Fans {
 public:
  Fans(const std::vector<Vec3>& vertices, const std::vector<Corners>& triangles)
      : sides_(sorted_sides(triangles)), place_(3 * triangles.size()), begin_(3 * triangles.size()) {
    for (std::size_t first = 0; first < sides_.size();) {
      std::size_t end = first + 1;
      while (end < sides_.size() && sides_[end].low == sides_[first].low && sides_[end].high == sides_[first].high)
        ++end;
      if (end - first > 2) sort(vertices, triangles, first, end);
      for (std::size_t k = first; k < end; ++k) {
        const std::size_t corner = 3 * static_cast<std::size_t>(sides_[k].triangle) + sides_[k].edge;
        place_[corner] = k, begin_[corner] = first;
      }
      ends_.push_back(end);
      first = end;
    }
  }

  const std::vector<Side>& sides() const { return sides_; }
  /// [first, last) of each edge's sides.
  template <class Visit>
  void for_each_edge(const Visit& visit) const {
    std::size_t first = 0;
    for (const std::size_t end : ends_) visit(first, end), first = end;
  }
  std::size_t count_at(int triangle, int edge) const {
    const std::size_t first = begin_[3 * static_cast<std::size_t>(triangle) + edge];
    std::size_t end = first;
    while (end < sides_.size() && sides_[end].low == sides_[first].low && sides_[end].high == sides_[first].high) ++end;
    return end - first;
  }
  /// The face that is met next from this one across its edge, on the side that it faces.
  Face across(const Face& from, int edge) const {
    const std::size_t corner = 3 * static_cast<std::size_t>(from.triangle) + edge;
    const std::size_t at = place_[corner], first = begin_[corner], count = count_at(from.triangle, edge);
    const bool onward = from.front == sides_[at].forward;  // it faces the way of the turn
    const std::size_t next = first + (at - first + (onward ? 1 : count - 1)) % count;
    if (next == at) return {from.triangle, !from.front};
    return {sides_[next].triangle, onward ? !sides_[next].forward : sides_[next].forward};
  }

 private:
  void sort(const std::vector<Vec3>& vertices, const std::vector<Corners>& triangles, std::size_t first,
            std::size_t end) {
    const Vec3 a = vertices[sides_[first].low], axis = unit(vertices[sides_[first].high] - a);
    const auto away = [&](const Side& side) {
      const Vec3 to = vertices[triangles[side.triangle][following(following(side.edge))]] - a;
      return to - dot(to, axis) * axis;
    };
    const Vec3 right = unit(away(sides_[first])), up = cross(axis, right);
    std::vector<std::pair<double, Side>> by_angle;
    for (std::size_t k = first; k < end; ++k) {
      const Vec3 w = away(sides_[k]);
      double angle = std::atan2(dot(w, up), dot(w, right));
      if (angle < -same_angle) angle += 2 * std::numbers::pi;
      by_angle.push_back({angle, sides_[k]});
    }
    std::ranges::stable_sort(by_angle, {}, [](const auto& one) { return one.first; });
    // Two in one place are faces of two bodies, flush, with nothing between: each faces the other.
    for (std::size_t k = 0; k < by_angle.size();) {
      std::size_t last = k + 1;
      while (last < by_angle.size() && by_angle[last].first - by_angle[last - 1].first < same_angle) ++last;
      std::stable_partition(by_angle.begin() + static_cast<std::ptrdiff_t>(k),
                            by_angle.begin() + static_cast<std::ptrdiff_t>(last),
                            [](const auto& one) { return one.second.forward; });
      k = last;
    }
    for (std::size_t k = 0; k < by_angle.size(); ++k) sides_[first + k] = by_angle[k].second;
  }

  static constexpr double same_angle = 1e-6;  // [rad]

  std::vector<Side> sides_;
  std::vector<std::size_t> place_, begin_;  ///< of edge i of triangle t, at 3 t + i: its side, its edge's first side
  std::vector<std::size_t> ends_;           ///< of each edge's sides
};

Vec3 normal_by_corners(const std::vector<Vec3>& vertices, const Corners& c) {
  return cross(vertices[c[1]] - vertices[c[0]], vertices[c[2]] - vertices[c[0]]);
}

/// Six times the signed volume between triangles and a point.
double volume_of(const std::vector<Vec3>& vertices, const std::vector<Corners>& triangles, const std::vector<int>& of) {
  const Vec3 origin = vertices[triangles[of.front()][0]];
  double volume = 0;
  for (const int t : of) {
    const Corners& c = triangles[t];
    volume += dot(vertices[c[0]] - origin, cross(vertices[c[1]] - origin, vertices[c[2]] - origin));
  }
  return volume;
}

/// A face that can be seen from far away: the last that a line square to a large triangle meets.
Face seen_from_outside(const std::vector<Vec3>& vertices, const std::vector<Corners>& triangles,
                       const std::vector<int>& part) {
  std::vector<int> by_area = part;
  const std::size_t tries = std::min<std::size_t>(by_area.size(), 16);
  std::vector<double> area(triangles.size(), 0);
  for (const int t : part) area[t] = squared(normal_by_corners(vertices, triangles[t]));
  std::partial_sort(by_area.begin(), by_area.begin() + static_cast<std::ptrdiff_t>(tries), by_area.end(),
                    [&](int a, int b) { return area[a] != area[b] ? area[a] > area[b] : a < b; });
  Face best{by_area.front(), true};
  double clearest = -1;
  for (std::size_t k = 0; k < tries && clearest < 1e-3; ++k) {
    const Corners& aim = triangles[by_area[k]];
    // Off the middle, so that a regular mesh's edges are not all on the line.
    const Vec3 from = 0.41 * vertices[aim[0]] + 0.33 * vertices[aim[1]] + 0.26 * vertices[aim[2]];
    const Vec3 way = unit(normal_by_corners(vertices, aim));
    double farthest = -1;
    Face last{by_area[k], true};
    double clear = 0;
    for (const int t : part) {
      const auto hit =
          line_through(from, way, vertices[triangles[t][0]], vertices[triangles[t][1]], vertices[triangles[t][2]]);
      if (!hit || hit->along <= farthest) continue;
      farthest = hit->along, clear = hit->clearance;
      last = {t, dot(normal_by_corners(vertices, triangles[t]), way) > 0};
    }
    if (clear > clearest) clearest = clear, best = last;
  }
  return best;
}

/// The groups of `count` triangles, in the order of their first one.
std::vector<std::vector<int>> members_of(Groups& groups, std::size_t count) {
  std::map<int, std::vector<int>> parts;
  for (int t = 0; t < static_cast<int>(count); ++t) parts[groups.of(t)].push_back(t);
  std::vector<std::vector<int>> out;
  for (auto& [first, part] : parts) out.push_back(std::move(part));
  return out;
}

/// The parts of a surface that hang together by edges.
std::vector<std::vector<int>> parts_by_edges(const std::vector<Corners>& triangles) {
  Groups groups(triangles.size());
  const std::vector<Side> sides = sorted_sides(triangles);
  for (std::size_t k = 1; k < sides.size(); ++k)
    if (sides[k].low == sides[k - 1].low && sides[k].high == sides[k - 1].high)
      groups.join(sides[k].triangle, sides[k - 1].triangle);
  return members_of(groups, triangles.size());
}

/// Gives each round of triangles about a vertex a vertex of its own, where an edge's triangles are taken in pairs:
/// those that bound the body between them, or, `apart` false, those that bound the space between them.
void part_rounds(MeshSoup& soup, const std::map<Edge, bool>& apart) {
  const Fans fans(soup.vertices, soup.triangles);
  Groups corners(3 * soup.triangles.size());
  const auto corner_at = [&](int t, int vertex) {
    for (int i = 0; i < 3; ++i)
      if (soup.triangles[t][i] == vertex) return 3 * t + i;
    return 3 * t;
  };
  fans.for_each_edge([&](std::size_t first, std::size_t end) {
    const auto way = apart.find({fans.sides()[first].low, fans.sides()[first].high});
    const bool by_body = way == apart.end() || way->second;
    for (std::size_t k = first; k < end; ++k) {
      const Side& side = fans.sides()[k];
      // All face outward: from the back of one the walk leads through its body.
      const Face next = end - first == 2 ? Face{fans.sides()[first + end - 1 - k].triangle, true}
                                         : fans.across({side.triangle, !by_body}, side.edge);
      for (const int vertex : {side.low, side.high})
        corners.join(corner_at(side.triangle, vertex), corner_at(next.triangle, vertex));
    }
  });
  std::vector<int> first_round(soup.vertices.size(), -1);
  std::map<int, int> own;  // vertex of the later rounds
  for (int t = 0; t < static_cast<int>(soup.triangles.size()); ++t)
    for (int i = 0; i < 3; ++i) {
      int& vertex = soup.triangles[t][i];
      const int round = corners.of(3 * t + i);
      if (first_round[vertex] == -1) first_round[vertex] = round;
      if (first_round[vertex] == round) continue;
      const auto [place, fresh] = own.try_emplace(round, static_cast<int>(soup.vertices.size()));
      if (fresh) soup.vertices.push_back(Vec3(soup.vertices[vertex]));
      vertex = place->second;
    }
}

/// Makes a surface of which each edge has two triangles and each vertex one round of them. Gives how many edges had
/// more.
int take_apart(MeshSoup& soup, const std::string& name) {
  std::map<Edge, bool> apart;
  const auto crowded = [](const MeshSoup& of) {
    std::vector<Edge> edges;
    const std::vector<Side> sides = sorted_sides(of.triangles);
    for (std::size_t i = 2; i < sides.size(); ++i)
      if (sides[i].low == sides[i - 2].low && sides[i].high == sides[i - 2].high &&
          (edges.empty() || edges.back() != Edge{sides[i].low, sides[i].high}))
        edges.push_back({sides[i].low, sides[i].high});
    return edges;
  };
  const std::vector<Edge> at_first = crowded(soup);
  MeshSoup tried = soup;
  part_rounds(tried, apart);
  if (!at_first.empty() && !crowded(tried).empty()) {  // a body that touches itself: the spaces come apart instead
    for (const Edge& edge : at_first) apart[edge] = false;
    tried = soup;
    part_rounds(tried, apart);
  }
  if (const std::vector<Edge> still = crowded(tried); !still.empty())
    refuse_mesh(name,
                fmt::format("its surface branches at the edge from {} to {}",
                            place_in_drawing(tried.vertices[still.front().first]),
                            place_in_drawing(tried.vertices[still.front().second])),
                "keep the parts apart there in the program that drew it, or join them along faces");
  soup = std::move(tried);
  return static_cast<int>(at_first.size());
}

/// Triangles of a soup with the vertices that they have.
MeshSoup part_of(const MeshSoup& soup, const std::vector<int>& triangles) {
  MeshSoup part;
  std::map<int, int> number;
  for (const int t : triangles) {
    Corners c = soup.triangles[t];
    for (int& corner : c) {
      const auto [place, fresh] = number.try_emplace(corner, static_cast<int>(part.vertices.size()));
      if (fresh) part.vertices.push_back(soup.vertices[corner]);
      corner = place->second;
    }
    part.triangles.push_back(c);
  }
  return part;
}

/// Which parts lie inside a body: in it all over, and nothing of it in them.
class Nesting {
 public:
  Nesting(const MeshSoup& soup, const std::vector<std::vector<int>>& parts, double tolerance) : tolerance_(tolerance) {
    for (const std::vector<int>& part : parts) {
      pieces_.push_back(part_of(soup, part));
      boxes_.push_back(box_of(pieces_.back().vertices, pieces_.back().triangles));
    }
    solids_.resize(pieces_.size());
  }

  bool lies_inside(std::size_t inner, std::size_t outer, bool inner_is_closed) {
    if (!box_holds(boxes_[outer], boxes_[inner])) return false;
    if (any_sample(inner, outer, Place::outside)) return false;
    return !inner_is_closed || !any_sample(outer, inner, Place::inside);
  }

 private:
  bool box_holds(const Box& outer, const Box& inner) const {
    const auto holds = [&](double low, double high, double from, double to) {
      return from >= low - tolerance_ && to <= high + tolerance_;
    };
    return holds(outer.low.x, outer.high.x, inner.low.x, inner.high.x) &&
           holds(outer.low.y, outer.high.y, inner.low.y, inner.high.y) &&
           holds(outer.low.z, outer.high.z, inner.low.z, inner.high.z);
  }
  /// Whether a corner, the middle of an edge or of a triangle of one piece lies so to the body of another.
  bool any_sample(std::size_t of, std::size_t body, Place where) {
    if (!solids_[body]) solids_[body].emplace(pieces_[body].vertices, pieces_[body].triangles, tolerance_);
    const Solid& solid = *solids_[body];
    const MeshSoup& piece = pieces_[of];
    const auto is = [&](const Vec3& p) { return solid.place_of(p) == where; };
    for (const Corners& c : piece.triangles) {
      const Vec3 &a = piece.vertices[c[0]], &b = piece.vertices[c[1]], &d = piece.vertices[c[2]];
      if (is((a + b + d) / 3) || is(a) || is(b) || is(d) || is(0.5 * (a + b)) || is(0.5 * (b + d)) || is(0.5 * (d + a)))
        return true;
    }
    return false;
  }

  double tolerance_;
  std::vector<MeshSoup> pieces_;
  std::vector<Box> boxes_;
  std::vector<std::optional<Solid>> solids_;
};

/// Leaves out the vertices of no triangle.
void forget_unused(MeshSoup& soup) {
  std::vector<int> number(soup.vertices.size(), -1);
  for (const Corners& c : soup.triangles)
    for (const int corner : c) number[corner] = 0;
  int count = 0;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] < 0) continue;
    soup.vertices[count] = soup.vertices[v];
    number[v] = count++;
  }
  soup.vertices.resize(static_cast<std::size_t>(count));
  for (Corners& c : soup.triangles)
    for (int& corner : c) corner = number[corner];
}

[[noreturn]] void refuse_open(const std::string& name, const MeshSoup& sheet) {
  const std::vector<Side> sides = sorted_sides(sheet.triangles);
  const auto same = [&](std::size_t a, std::size_t b) {
    return b < sides.size() && sides[a].low == sides[b].low && sides[a].high == sides[b].high;
  };
  int count = 0;
  std::size_t hole = 0;
  for (std::size_t i = 0; i < sides.size(); ++i)
    if (!same(i, i + 1) && (i == 0 || !same(i, i - 1)) && ++count == 1) hole = i;
  refuse_mesh(
      name,
      fmt::format("not closed: {} of its edges have one triangle only, such as that from {} to {} of the drawing",
                  count, place_in_drawing(sheet.vertices[sides[hole].low]),
                  place_in_drawing(sheet.vertices[sides[hole].high])),
      "close the hole in the program that drew it, or leave the open sheet out");
}

/// Which sides of each triangle a walk over the outside of its part meets.
constexpr char front_met = 1, back_met = 2;
std::vector<char> sides_met(const std::vector<Vec3>& vertices, const std::vector<Corners>& triangles,
                            const std::vector<std::vector<int>>& parts) {
  const Fans fans(vertices, triangles);
  std::vector<char> met(triangles.size(), 0);
  std::vector<Face> walk;
  const auto meet = [&](const Face& face) {
    const char side = face.front ? front_met : back_met;
    if ((met[face.triangle] & side) != 0) return;
    met[face.triangle] = static_cast<char>(met[face.triangle] | side);
    walk.push_back(face);
  };
  for (const std::vector<int>& part : parts) {
    meet(seen_from_outside(vertices, triangles, part));
    while (!walk.empty()) {
      const Face face = walk.back();
      walk.pop_back();
      for (int i = 0; i < 3; ++i) meet(fans.across(face, i));
    }
  }
  return met;
}

/// Which of the parts lie inside one of the first `closed` of them.
std::vector<char> hidden_parts(const MeshSoup& soup, const std::vector<std::vector<int>>& parts, std::size_t closed,
                               double tolerance) {
  std::vector<char> hidden(parts.size(), 0);
  if (parts.size() < 2) return hidden;
  Nesting nesting(soup, parts, tolerance);
  for (std::size_t inner = 0; inner < parts.size(); ++inner)
    for (std::size_t other = 0; other < closed && !hidden[inner]; ++other)
      if (other != inner && !hidden[other] && nesting.lies_inside(inner, other, inner < closed)) hidden[inner] = 1;
  return hidden;
}

/// Takes the outside of each part, turned outward, and parts it into bodies; `open` gets the surfaces that have no
/// inside, `turned` which triangles of the bodies faced inward.
MeshSoup Mending::bodies_of_outside(MeshSoup& open, std::vector<char>& turned) {
  std::vector<int> all(triangles_.size());
  std::iota(all.begin(), all.end(), 0);
  const bool inside_out = volume_of(vertices_, triangles_, all) < 0;
  if (inside_out)  // then faces that are flush face each other as they should
    for (Corners& c : triangles_) std::swap(c[1], c[2]);
  const std::vector<std::vector<int>> parts = parts_by_edges(triangles_);
  const std::vector<char> met = sides_met(vertices_, triangles_, parts);
  std::vector<char> is_open(triangles_.size(), 0);
  for (const std::vector<int>& part : parts)
    if (std::ranges::any_of(part, [&](int t) { return met[t] == (front_met | back_met); }))
      for (const int t : part) is_open[t] = 1;

  MeshSoup bodies{vertices_, {}};
  open.vertices = vertices_;
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    Corners c = triangles_[t];
    if (met[t] == back_met) std::swap(c[1], c[2]);
    if (is_open[t]) {
      open.triangles.push_back(c);
    } else if (met[t] == 0) {
      ++mends_.unreachable;
    } else {
      bodies.triangles.push_back(c);
      turned.push_back((met[t] == back_met) != inside_out);
    }
  }
  return bodies;
}

MeshSoup Mending::outer_surfaces() {
  MeshSoup open;
  std::vector<char> turned;
  MeshSoup bodies = bodies_of_outside(open, turned);
  if (bodies.triangles.empty()) refuse_open(name_, open);
  mends_.edges_parted = take_apart(bodies, name_);

  std::vector<std::vector<int>> parts = parts_by_edges(bodies.triangles);
  const std::size_t closed = parts.size();
  MeshSoup all = bodies;
  const int vertices = static_cast<int>(all.vertices.size()), triangles = static_cast<int>(all.triangles.size());
  if (!open.triangles.empty()) all.vertices.insert(all.vertices.end(), open.vertices.begin(), open.vertices.end());
  for (const Corners& c : open.triangles) all.triangles.push_back({c[0] + vertices, c[1] + vertices, c[2] + vertices});
  for (std::vector<int>& sheet : parts_by_edges(open.triangles)) {
    for (int& t : sheet) t += triangles;
    parts.push_back(std::move(sheet));
  }
  const std::vector<char> hidden = hidden_parts(all, parts, closed, tolerance());
  for (std::size_t p = closed; p < parts.size(); ++p)
    if (!hidden[p]) refuse_open(name_, part_of(all, parts[p]));

  std::vector<char> kept(bodies.triangles.size(), 0);
  for (std::size_t p = 0; p < closed; ++p) {
    if (hidden[p]) continue;
    ++mends_.bodies;
    for (const int t : parts[p]) kept[t] = 1;
  }
  mends_.bodies_inside = static_cast<int>(std::ranges::count(hidden, 1));
  MeshSoup out{std::move(bodies.vertices), {}};
  for (std::size_t t = 0; t < kept.size(); ++t) {
    if (!kept[t]) continue;
    out.triangles.push_back(bodies.triangles[t]);
    mends_.turned += turned[t];
  }
  forget_unused(out);
  return out;
}

std::string counted(int count, const char* one, const char* several) {
  return fmt::format("{} {}", count, count == 1 ? one : several);
}

}  // namespace

std::vector<std::string> MeshMends::in_words(const std::string& unit) const {
  std::vector<std::string> words;
  const auto say = [&](int count, const char* one, const char* several, const std::string& what) {
    if (count > 0) words.push_back(counted(count, one, several) + " " + what);
  };
  say(slivers, "sliver", "slivers", fmt::format("lower than {:.2g} {} taken out", tolerance, unit));
  say(doubled, "triangle", "triangles", "that doubled another left out");
  say(split, "triangle", "triangles", "split where a vertex lay on an open edge");
  say(turned, "triangle", "triangles", "that faced inward turned");
  say(unreachable, "triangle", "triangles", "of walls inside left out");
  say(edges_parted, "edge", "edges", "where more than two triangles met taken apart");
  say(bodies_inside, "part", "parts", "inside another body left out");
  return words;
}

MeshSoup mended(MeshSoup soup, const std::string& name, MeshMends& mends) {
  Mending mending(std::move(soup), name, mends);
  mending.close_cracks();
  return mending.outer_surfaces();
}

}  // namespace soilbin::dem
