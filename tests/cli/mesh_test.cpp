// soilbin mesh: what is in a drawing, what was mended, and what a person does about the rest.
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>

#include "tests/cli/command.hpp"

namespace soilbin::cli::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// A cylinder about an axis, as text STL: corners of its triangles in the axes' order that `place` gives.
std::string cylinder_stl(double radius, double width, const auto& place) {
  constexpr int sides = 48;
  std::ostringstream text;
  text.precision(17);
  text << "solid wheel\n";
  struct Point {
    double x, y, z;
  };
  const auto rim = [&](int k, double y) {
    const double turn = 2 * std::numbers::pi * (k % sides) / sides;
    return Point{radius * std::sin(turn), y, radius * std::cos(turn)};
  };
  const auto triangle = [&](const Point& a, const Point& b, const Point& c) {
    text << "facet normal 0 0 0\nouter loop\n";
    for (const Point& p : {a, b, c}) {
      const auto at = place(p.x, p.y, p.z);
      text << "vertex " << at[0] << ' ' << at[1] << ' ' << at[2] << '\n';
    }
    text << "endloop\nendfacet\n";
  };
  const double left = -width / 2, right = width / 2;
  for (int k = 0; k < sides; ++k) {
    const Point a = rim(k, left), b = rim(k, right), c = rim(k + 1, right), d = rim(k + 1, left);
    triangle(a, c, b), triangle(a, d, c), triangle({0, left, 0}, d, a), triangle({0, right, 0}, b, c);
  }
  return text.str() + "endsolid wheel\n";
}

std::array<double, 3> as_it_is(double x, double y, double z) { return {x, y, z}; }

TEST(Mesh, TellsWhatIsThereAndWhatWasMended) {
  const Scratch scratch;
  // Two cylinders of 62 and 20 mm and one width, drawn in mm about z.
  const auto about_z = [](double x, double y, double z) { return std::array<double, 3>{x, -z, y}; };
  const std::string outer = cylinder_stl(62, 40, about_z), hub = cylinder_stl(20, 40, about_z);
  const std::string file = scratch.write("wheel.stl", outer + hub).string();
  const Outcome told = soilbin("mesh '" + file + "'");
  EXPECT_EQ(told.status, 0) << told.err;
  EXPECT_THAT(told.out,
              AllOf(HasSubstr("wheel.stl: 192 triangles, 1 closed body\n"), HasSubstr("unit    mm; it could"),
                    HasSubstr("axle    z\n"), HasSubstr("radius  62 mm"), HasSubstr("width   40 mm"),
                    HasSubstr("volume  481.7 cm^3"), HasSubstr("changed: 1 part inside another body left out\n"),
                    HasSubstr("changed: turned from axle z to axle y: forward is the drawing's x, up its -y\n")));
  const nlohmann::json json = soilbin("mesh '" + file + "' --unit mm --json").json();
  EXPECT_EQ(json["format"], "soilbin-mesh/1");
  EXPECT_NEAR(json["radius"].get<double>(), 0.062, 1e-12);
  EXPECT_NEAR(json["volume"].get<double>(), 4.817e-4, 1e-7);
  EXPECT_EQ(json["mended"]["parts_inside"], 1);
  EXPECT_EQ(json["changes"].size(), 2U);
}

TEST(Mesh, DrawsTheWheel) {
  const Scratch scratch;
  const std::string file = scratch.write("wheel.stl", cylinder_stl(0.062, 0.04, as_it_is)).string();
  const Outcome drawn = soilbin("mesh '" + file + "' --plot '" + (scratch / "wheel.svg").string() + "'");
  EXPECT_EQ(drawn.status, 0) << drawn.err;
  EXPECT_THAT(drawn.out, HasSubstr("Nothing had to be changed.\n"));
  EXPECT_THAT(text_of(scratch / "wheel.svg"), AllOf(HasSubstr("From the side"), HasSubstr("From the front"),
                                                    HasSubstr("192 triangles, drawn in m, axle y")));
}

TEST(Mesh, OfAnotherSizeThanTheTireIsRefused) {
  const Scratch scratch;
  const std::string file = scratch.write("wheel.stl", cylinder_stl(62, 40, as_it_is)).string();
  const std::string tire =
      scratch.write("tire.yaml", "format: soilbin-tire/1\nsource: test\nradius: 62 mm\nwidth: 40 mm\n").string();
  EXPECT_EQ(soilbin("mesh '" + file + "' --tire '" + tire + "'").status, 0);
  const std::string large =
      scratch.write("large.yaml", "format: soilbin-tire/1\nsource: test\nradius: 80 mm\nwidth: 40 mm\n").string();
  EXPECT_THAT(soilbin("mesh '" + file + "' --tire '" + large + "'"),
              Refuses(AllOf(HasSubstr("it reaches 62 from its axle, y"), HasSubstr("the tire's 80 mm"),
                            HasSubstr("soilbin mesh FILE"))));
  EXPECT_EQ(soilbin("mesh '" + file + "' --unit furlong").status, 2);
  EXPECT_EQ(soilbin("mesh '" + (scratch / "none.stl").string() + "'").status, 2);
}

}  // namespace
}  // namespace soilbin::cli::test
