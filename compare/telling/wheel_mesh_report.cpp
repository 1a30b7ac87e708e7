// What was found in a drawing of a wheel and what was mended in it; soilbin-mesh/1: docs/guide/bring-a-tire.md.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "compare/telling/reports.hpp"
#include "dem/surface/drawn_wheel.hpp"

namespace soilbin::compare {
namespace {

constexpr double sharp = 0.87;             // cosine between the normals of two triangles: 30 degrees
constexpr std::size_t most_lines = 20000;  // of a picture; the longest

std::string count_of(int count, const char* one, const char* several) {
  return fmt::format("{} {}", count, count == 1 ? one : several);
}

/// Two axes of a view, and the way to who looks.
struct View {
  double dem::Vec3::*across;
  double dem::Vec3::*up;
  dem::Vec3 toward;
};

struct DrawnEdge {
  dem::Vec3 from, to;
  double squared_length;
};

/// Sharp edges that are turned to who looks, and outlines.
std::vector<DrawnEdge> edges_seen(const dem::TriangleMesh& mesh, const View& view) {
  std::vector<DrawnEdge> edges;
  for (int t = 0; t < mesh.size(); ++t)
    for (int i = 0; i < 3; ++i) {
      const int other = mesh.across(t, i).triangle;
      if (other < t) continue;  // each once
      const dem::Vec3 &here = mesh.frame(t).normal, &there = mesh.frame(other).normal;
      const double a = dot(here, view.toward), b = dot(there, view.toward);
      constexpr double edge_on = 1e-9;
      const bool outline = (a > edge_on) != (b > edge_on), seen = std::max(a, b) > edge_on;
      if (!outline && !(seen && dot(here, there) < sharp)) continue;
      const dem::Vec3 &from = mesh.corner(t, i), &to = mesh.corner(t, (i + 1) % 3);
      edges.push_back({from, to, squared(to - from)});
    }
  if (edges.size() > most_lines) {
    std::nth_element(edges.begin(), edges.begin() + most_lines, edges.end(),
                     [](const DrawnEdge& a, const DrawnEdge& b) { return a.squared_length > b.squared_length; });
    edges.resize(most_lines);
  }
  return edges;
}

/// Both axes to one scale, near enough: a panel's frame is about one and a half times as wide as high.
Plot view_plot(const dem::DrawnWheel& wheel, const std::string& title, const View& view, const char* across,
               double half_across) {
  constexpr double wide = 353.0 / 228.0, mm = 1000;
  const double half = 1.08 * mm * std::max(wheel.radius, half_across / wide);
  Plot plot{title, {across, -wide * half, wide * half}, {"z [mm]", -half, half}};
  Series lines{.label = "sharp edges and outlines"}, places{.label = "mended here", .mark = Mark::points, .color = 1};
  for (const DrawnEdge& edge : edges_seen(wheel.mesh, view)) {
    for (const dem::Vec3& end : {edge.from, edge.to}) {
      lines.x.push_back(mm * end.*view.across);
      lines.y.push_back(mm * end.*view.up);
    }
    lines.x.push_back(lines.x.back());
    lines.y.push_back(std::numeric_limits<double>::quiet_NaN());  // the next edge begins elsewhere
  }
  for (const dem::Vec3& place : wheel.mended_at) {
    places.x.push_back(mm * place.*view.across);
    places.y.push_back(mm * place.*view.up);
  }
  plot.series.push_back(std::move(lines));
  if (!places.x.empty()) plot.series.push_back(std::move(places));
  return plot;
}

NamedValues facts_of(const dem::DrawnWheel& wheel) {
  const auto mm = [](double metres) { return fmt::format("{:.4g}", 1000 * metres + 0.0); };
  const std::string others = wheel.other_units.empty()
                                 ? ""
                                 : fmt::format("; it could also be in {}: --unit", fmt::join(wheel.other_units, ", "));
  return {{{"unit", wheel.unit.name + others},
           {"axle", std::string(1, wheel.axle)},
           {"radius", mm(wheel.radius) + " mm, to the tips of lugs"},
           {"width",
            fmt::format("{} mm, from {} to {} mm along the axle", mm(wheel.width()), mm(wheel.left), mm(wheel.right))},
           {"volume", fmt::format("{:.4g} cm^3 within the outer surface", 1e6 * wheel.volume)}}};
}

nlohmann::ordered_json mesh_json(const dem::DrawnWheel& wheel, const std::string& file) {
  const dem::MeshMends& mends = wheel.mends;
  return {{"format", "soilbin-mesh/1"},
          {"file", file},
          {"triangles", wheel.mesh.size()},
          {"bodies", mends.bodies},
          {"unit", wheel.unit.name},
          {"unit_length", wheel.unit.metres},
          {"other_units", wheel.other_units},
          {"axle", std::string(1, wheel.axle)},
          {"radius", wheel.radius},
          {"left", wheel.left},
          {"right", wheel.right},
          {"width", wheel.width()},
          {"volume", wheel.volume},
          {"moved", {wheel.moved.x + 0.0, wheel.moved.y + 0.0, wheel.moved.z + 0.0}},
          {"mended",
           {{"tolerance", wheel.unit.metres * mends.tolerance},
            {"triangles_in_file", mends.given},
            {"slivers", mends.slivers},
            {"doubled", mends.doubled},
            {"split", mends.split},
            {"turned", mends.turned},
            {"walls_inside", mends.unreachable},
            {"edges_parted", mends.edges_parted},
            {"parts_inside", mends.bodies_inside}}},
          {"changes", wheel.changes}};
}

Sheet wheel_sheet(const dem::DrawnWheel& wheel, const std::string& file) {
  using dem::Vec3;
  Sheet sheet;
  sheet.title = file;
  sheet.note = fmt::format("{} triangles, drawn in {}, axle {}; radius {:.4g} mm, width {:.4g} mm", wheel.mesh.size(),
                           wheel.unit.name, wheel.axle, 1000 * wheel.radius, 1000 * wheel.width());
  sheet.plots.push_back(
      view_plot(wheel, "From the side", {&Vec3::x, &Vec3::z, {0, -1, 0}}, "x, forward [mm]", wheel.radius));
  sheet.plots.push_back(view_plot(wheel, "From the front", {&Vec3::y, &Vec3::z, {1, 0, 0}}, "y, along the axle [mm]",
                                  std::max(-wheel.left, wheel.right)));
  return sheet;
}

}  // namespace

Report report_on(const dem::DrawnWheel& wheel, const std::string& file) {
  Report report{file, "A drawing of a wheel, as the grain simulation uses it.",
                fmt::format("{}: {}, {}", file, count_of(wheel.mesh.size(), "triangle", "triangles"),
                            count_of(wheel.mends.bodies, "closed body", "closed bodies"))};
  report.add(facts_of(wheel));
  std::vector<BackedSentence> changes;
  for (const std::string& change : wheel.changes) changes.push_back({"changed", change});
  if (changes.empty()) changes.push_back({"", "Nothing had to be changed."});
  report.add(Sentences(changes));
  report.sheet = drawn_once([&wheel, file] { return wheel_sheet(wheel, file); });
  report.add("Seen", Figure{report.sheet, ""});
  report.data = [&wheel, file] { return mesh_json(wheel, file); };
  return report;
}

}  // namespace soilbin::compare
