#include "dem/surface/drawn_wheel.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "dem/surface/mass_properties.hpp"
#include "dem/surface/mesh_checks.hpp"
#include "dem/surface/mesh_files.hpp"

namespace soilbin::dem {
namespace {

constexpr double same_reach = 0.02, same_width = 0.05;        // of the tire's
constexpr double smallest_radius = 0.01, largest_radius = 3;  // of a wheel without a tire [m]
constexpr double hardly_rounder = 0.02;

/// A quarter turn that takes the axis to y; coordinates stay what they are.
Vec3 turned_to_y(const Vec3& p, char axle) {
  return axle == 'x' ? Vec3{-p.y, p.x, p.z} : axle == 'z' ? Vec3{p.x, p.z, -p.y} : p;
}

/// How far points reach from the y axis, and from where to where along it.
struct Extent {
  double reach = 0, left = std::numeric_limits<double>::infinity(), right = -left;
  Extent(const std::vector<Vec3>& vertices, char axle, const Vec3& middle) {
    for (const Vec3& vertex : vertices) {
      const Vec3 p = turned_to_y(vertex - middle, axle);
      reach = std::max(reach, std::hypot(p.x, p.z));
      left = std::min(left, p.y), right = std::max(right, p.y);
    }
  }
};

/// A drawing, mended, in its own unit.
struct Drawing {
  std::string file;
  MeshSoup soup;
  MeshMends mends;
  MassProperties whole;

  explicit Drawing(const std::filesystem::path& path) : file(path.string()) {
    soup = mended(read_triangles(path), file, mends);
    whole = mass_properties(TriangleMesh(soup.vertices, soup.triangles, {.closed = true, .as_given = true}));
  }

  /// On the axle through the centroid, half-way between its ends.
  Vec3 middle(char axle) const {
    const Vec3& c = whole.centroid;
    const Extent extent(soup.vertices, axle, c);
    const double off = (extent.left + extent.right) / 2;
    return c + (axle == 'x' ? Vec3{off, 0, 0} : axle == 'y' ? Vec3{0, off, 0} : Vec3{0, 0, off});
  }
};

/// To four digits, a nanometre at the finest: less is rounding.
std::string in_mm(double metres) { return fmt::format("{:.4g}", std::round(1e9 * metres) / 1e6 + 0.0); }

std::string moved_in_words(const Vec3& by) {
  return fmt::format("moved by ({}, {}, {}) mm, so that the middle of its axle is the origin", in_mm(by.x), in_mm(by.y),
                     in_mm(by.z));
}

DrawnWheel placed(const Drawing& drawing, LengthUnit unit, char axle, const Vec3& middle) {
  std::vector<Vec3> vertices = drawing.soup.vertices;
  for (Vec3& v : vertices) v = unit.metres * turned_to_y(v - middle, axle);
  DrawnWheel wheel{
      .mesh = {std::move(vertices), drawing.soup.triangles, {.closed = true, .as_given = true, .name = drawing.file}},
      .unit = unit,
      .axle = axle,
      .moved = unit.metres * turned_to_y(-middle, axle),
      .volume = std::pow(unit.metres, 3) * drawing.whole.volume,
      .mends = drawing.mends};
  const Extent extent(wheel.mesh.vertices(), 'y', {});
  wheel.radius = extent.reach, wheel.left = extent.left, wheel.right = extent.right;
  for (const Vec3& place : drawing.mends.places)
    wheel.mended_at.push_back(unit.metres * turned_to_y(place - middle, axle));
  wheel.changes = drawing.mends.in_words(unit.name);
  if (axle != 'y')
    wheel.changes.push_back(fmt::format("turned from axle {} to axle y: forward is the drawing's {}", axle,
                                        axle == 'x' ? "-y, up its z" : "x, up its -y"));
  if (middle != Vec3{}) wheel.changes.push_back(moved_in_words(wheel.moved));
  return wheel;
}

double mismatch(double a, double b) { return std::abs(a - b) / std::max(a, b); }

/// How far the wheel is from the same about all directions square to this axis: by inertia, and by the box.
double unroundness(const Drawing& drawing, char axle) {
  const MassProperties& m = drawing.whole;
  const Box box = box_of(drawing.soup.vertices, drawing.soup.triangles);
  const Vec3 size = box.high - box.low;
  if (axle == 'x') return mismatch(m.yy, m.zz) + mismatch(size.y, size.z);
  if (axle == 'y') return mismatch(m.zz, m.xx) + mismatch(size.z, size.x);
  return mismatch(m.xx, m.yy) + mismatch(size.x, size.y);
}

char roundest_axle(const Drawing& drawing) {
  char best = 'y';
  double least = unroundness(drawing, 'y') - hardly_rounder;
  for (const char axle : {'x', 'z'})
    if (const double here = unroundness(drawing, axle); here < least) best = axle, least = here;
  return best;
}

}  // namespace

DrawnWheel read_wheel(const std::filesystem::path& file, const Tire& tire) {
  const Drawing drawing(file);
  const double outer = outer_radius(tire);
  const auto fits_width = [&](double side) { return std::abs(2 * side / tire.width - 1) <= same_width; };
  std::string nearly;  // what is as far from its axle as the tire, but not as wide
  for (const bool as_drawn : {true, false})
    for (const char axle : {'y', 'x', 'z'}) {
      const Vec3 middle = as_drawn ? Vec3{} : drawing.middle(axle);
      const Extent extent(drawing.soup.vertices, axle, middle);
      for (const LengthUnit unit : drawing_units) {
        if (!(std::abs(unit.metres * extent.reach / outer - 1) <= same_reach)) continue;
        if (fits_width(-unit.metres * extent.left) && fits_width(unit.metres * extent.right))
          return placed(drawing, unit, axle, middle);
        if (nearly.empty())
          nearly = fmt::format("in {} it goes from {} to {} mm along {}, {} mm either way are the tire's width",
                               unit.name, in_mm(unit.metres * extent.left), in_mm(unit.metres * extent.right), axle,
                               in_mm(tire.width / 2));
      }
    }
  if (!nearly.empty())
    refuse_mesh(file.string(), nearly, "give the tire the drawing's width: soilbin mesh FILE tells it");
  const char axle = roundest_axle(drawing);
  refuse_mesh(file.string(),
              fmt::format("it reaches {:.4g} from its axle, {}: no unit (mm, cm, m, inch) makes that the tire's {} mm",
                          Extent(drawing.soup.vertices, axle, drawing.middle(axle)).reach, axle, in_mm(outer)),
              "the tire's radius and lug height together are how far the mesh reaches: soilbin mesh FILE tells it");
}

DrawnWheel read_wheel(const std::filesystem::path& file, std::optional<LengthUnit> unit) {
  const Drawing drawing(file);
  const char axle = roundest_axle(drawing);
  const Vec3 middle = drawing.middle(axle);
  const Extent centred(drawing.soup.vertices, axle, middle), as_drawn(drawing.soup.vertices, axle, {});
  std::vector<std::string> others;
  const bool guessed = !unit;
  for (const LengthUnit one : drawing_units) {
    const double radius = one.metres * centred.reach;
    if (!(radius >= smallest_radius && radius <= largest_radius)) continue;
    if (!unit)
      unit = one;
    else if (guessed)
      others.push_back(fmt::format("{} (radius {} mm)", one.name, in_mm(radius)));
  }
  if (!unit)
    refuse_mesh(
        file.string(),
        fmt::format("it reaches {:.4g} from its axle, {}: no unit (mm, cm, m, inch) makes that a wheel of {} mm "
                    "to {} m",
                    centred.reach, axle, in_mm(smallest_radius), largest_radius),
        "say which unit it is in: --unit mm");
  // As a run would take it.
  const bool stands = std::abs(as_drawn.reach / centred.reach - 1) <= same_reach &&
                      std::abs(as_drawn.left + as_drawn.right) <= same_width * (centred.right - centred.left);
  DrawnWheel wheel = placed(drawing, *unit, axle, stands ? Vec3{} : middle);
  wheel.other_units = std::move(others);
  return wheel;
}

}  // namespace soilbin::dem
