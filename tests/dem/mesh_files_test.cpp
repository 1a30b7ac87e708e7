// Files in and out: what comes back is what went in, and what is broken is told by name.
#include "dem/surface/mesh_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "dem/plates_of_triangles.hpp"
#include "dem/surface/mass_properties.hpp"
#include "dem/surface/shapes.hpp"
#include "scenario/errors.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin::dem {
namespace {

namespace fs = std::filesystem;

class MeshFiles : public testing::Test {
 protected:
  MeshFiles() : folder_(fs::path(testing::TempDir()) / ("mesh_files." + std::to_string(::getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~MeshFiles() override { fs::remove_all(folder_); }

  fs::path file(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  static std::string content(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
  }
  static std::string refusal(const fs::path& path, double unit = 1) {
    try {
      read_mesh(path, unit, {.closed = true});
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::StartsWith(path.string() + ":"));
      EXPECT_THAT(error.what(), testing::HasSubstr("hint: "));
      return error.what();
    }
    return "";
  }

  fs::path folder_;
};

/// The unit cube's triangles, as text STL.
std::string text_stl(const tests::Soup& soup) {
  std::ostringstream text;
  text << "solid part\n";
  for (const auto& t : soup.triangles) {
    text << " facet normal 0 0 0\n  outer loop\n";
    for (const int v : t) {
      const Vec3& p = soup.vertices[v];
      text << "   vertex " << p.x << ' ' << p.y << ' ' << p.z << '\n';
    }
    text << "  endloop\n endfacet\n";
  }
  text << "endsolid part\n";
  return text.str();
}

TEST_F(MeshFiles, ATireComesBackInSinglePrecision) {
  Tire tire;
  tire.name = "paper", tire.radius = 0.496, tire.width = 0.305;
  tire.lugs = {.height = 0.011, .count = 40, .thickness = 0.025, .pattern = LugPattern::chevron};
  const TriangleMesh mesh = tire_surface(tire, {.edge = 0.03});
  for (const double unit : {1.0, 1e-3, 0.0254}) {
    write_stl(folder_ / "tire.stl", mesh, unit);
    const TriangleMesh again = read_mesh(folder_ / "tire.stl", unit, {.closed = true});
    EXPECT_EQ(again.name(), (folder_ / "tire.stl").string());
    ASSERT_EQ(again.size(), mesh.size());
    EXPECT_EQ(again.vertices().size(), mesh.vertices().size());
    for (int t = 0; t < mesh.size(); ++t) {
      for (int i = 0; i < 3; ++i) {
        const double off = length(again.corner(t, i) - mesh.corner(t, i));
        EXPECT_LE(off, std::ldexp(length(mesh.corner(t, i)), -23));  // three coordinates, each to 2^-24
      }
      for (int i = 0; i < 3; ++i) EXPECT_EQ(again.across(t, i), mesh.across(t, i));
    }
    EXPECT_NEAR(mass_properties(again).volume, mass_properties(mesh).volume, 1e-7);
  }
}

Tire small_rover() {
  Tire tire;
  tire.name = "rover", tire.radius = 0.09, tire.width = 0.11;
  tire.lugs = {.height = 0.01, .count = 12, .thickness = 0.004};
  return tire;
}

TEST_F(MeshFiles, AWheelAsDrawnIsTheTiresSurfaceInWhateverUnitItWasDrawn) {
  const Tire tire = small_rover();
  const TriangleMesh made = tire_surface(tire, {.edge = 0.01});
  for (const double unit : {1e-3, 1e-2, 1.0, 0.0254}) {
    write_stl(folder_ / "wheel.stl", made, unit);
    const TriangleMesh drawn = tire_surface(tire, {.drawn = (folder_ / "wheel.stl").string()});
    ASSERT_EQ(drawn.size(), made.size()) << unit;
    EXPECT_NEAR(mass_properties(drawn).volume / mass_properties(made).volume, 1, 1e-6) << unit;
  }
}

TEST_F(MeshFiles, AWheelAsDrawnHasTheTiresSizeAndStandsOnItsAxle) {
  const fs::path path = folder_ / "wheel.stl";
  const auto says = [&](const TriangleMesh& mesh) -> std::string {
    write_stl(path, mesh, 1e-3);
    return soilbin::test::error_of([&] { tire_surface(small_rover(), {.drawn = path.string()}); });
  };
  Tire other = small_rover();
  EXPECT_EQ(says(tire_surface(other, {.edge = 0.01})), "");
  other.radius = 0.12;
  EXPECT_THAT(
      says(tire_surface(other, {.edge = 0.01})),
      testing::HasSubstr("it reaches 130 from its axle, y: no unit (mm, cm, m, inch) makes that the tire's 100 mm"));
  other = small_rover(), other.width = 0.08;
  EXPECT_THAT(says(tire_surface(other, {.edge = 0.01})),
              testing::HasSubstr("in mm it goes from -40 to 40 mm along y, 55 mm"));
  EXPECT_THAT(says(plate(0.2, 0.11, 1, 1)),
              testing::AllOf(testing::HasSubstr("not closed"), testing::HasSubstr("(100, -55, 0)")))
      << "an open mesh, told in the drawing's unit";
}

TEST_F(MeshFiles, WritesWhatTheFormatSays) {
  const tests::Soup soup = tests::cube();
  write_stl(folder_ / "cube.stl", TriangleMesh(soup.vertices, soup.triangles), 1);
  const std::string bytes = content(folder_ / "cube.stl");
  ASSERT_EQ(bytes.size(), 84u + 50u * 12u);
  EXPECT_NE(bytes.substr(0, 5), "solid");
  EXPECT_EQ(bytes.substr(80, 4), std::string("\x0c\0\0\0", 4));
  // First triangle: normal (0, 0, -1), first corner (-1, -1, -1); -1 is bf800000.
  EXPECT_EQ(bytes.substr(92, 16), std::string("\0\0\x80\xbf\0\0\x80\xbf\0\0\x80\xbf\0\0\x80\xbf", 16));
  EXPECT_EQ(bytes.substr(132, 2), std::string(2, '\0'));
}

TEST_F(MeshFiles, TextStlIsWeldedAndScaled) {
  const TriangleMesh mesh = read_mesh(file("CUBE.STL", text_stl(tests::cube())), 1e-3, {.closed = true});
  EXPECT_EQ(mesh.size(), 12);
  EXPECT_EQ(mesh.vertices().size(), 8u);
  EXPECT_NEAR(mass_properties(mesh).volume, 8e-9, 1e-20);
}

TEST_F(MeshFiles, ObjHasPolygonsAndParts) {
  const std::string cube =
      "# a cube of quadrangles\no cube\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
      "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
  const TriangleMesh one = read_mesh(file("one.obj", cube), 2, {.closed = true});
  EXPECT_EQ(one.size(), 12);
  EXPECT_NEAR(mass_properties(one).volume, 8, 1e-14);
  const std::string second =
      "o other\nv 5 0 0\nv 6 0 0\nv 5 1 0\nv 5 0 1\nf 9 11 10\nf 9 10 12\nf 9 12 11\nf 10 11 12\n";
  const TriangleMesh two = read_mesh(file("two.obj", cube + second), 1, {.closed = true});
  EXPECT_EQ(two.size(), 16);
  EXPECT_NEAR(mass_properties(two).volume, 1 + 1.0 / 6, 1e-7);
}

// What an OBJ names is not opened: a pipe would hang the command, and lines of another file would be quoted.
TEST_F(MeshFiles, AnObjOpensNothingButItself) {
  const std::string cube =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nusemtl red\n"
      "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  for (const std::string& other : {(folder_ / "pipe").string(), std::string("pipe"), std::string("/etc/passwd")}) {
    const TriangleMesh mesh = read_mesh(file("named.obj", "mtllib " + other + "\n" + cube), 1, {.closed = true});
    EXPECT_EQ(mesh.size(), 12) << other;
  }
  EXPECT_THAT(refusal(folder_ / "pipe"), testing::HasSubstr("no kind of mesh file"));
  fs::rename(folder_ / "pipe", folder_ / "pipe.obj");
  EXPECT_THAT(refusal(folder_ / "pipe.obj"), testing::HasSubstr("it can't be read"));
}

TEST_F(MeshFiles, BrokenFilesAreRefusedByName) {
  EXPECT_THAT(refusal(folder_ / "none.stl"), testing::HasSubstr("can't be read"));
  EXPECT_THAT(refusal(folder_), testing::HasSubstr("no kind of mesh file"));
  EXPECT_THAT(refusal(file("a.step", "x")), testing::HasSubstr("'.step' is no kind of mesh file"));
  EXPECT_THAT(refusal(file("empty.stl", "")), testing::HasSubstr("0 bytes are too few"));
  EXPECT_NE(refusal(file("empty.obj", "")), "");
  EXPECT_NE(refusal(file("words.obj", "these are no vertices\n")), "");
  EXPECT_THAT(refusal(file("cube.stl", text_stl(tests::cube())), 0), testing::HasSubstr("unit of length is 0 m"));

  const std::string text = text_stl(tests::cube());
  EXPECT_THAT(refusal(file("cut.stl", text.substr(0, text.find("vertex", text.size() / 2) + 8))),
              testing::HasSubstr("three numbers are expected after 'vertex'"));
  EXPECT_THAT(refusal(file("end.stl", text.substr(0, text.find("endsolid")))), testing::HasSubstr("'endsolid'"));
  const std::string fourth =
      "solid\n facet\n outer loop\n vertex 0 0 0\n vertex +1 0 0\n vertex 1 1 0\n vertex 0 1 0\n endloop\n";
  EXPECT_THAT(refusal(file("four.stl", fourth)), testing::HasSubstr("four.stl:8: a facet has three vertices"));
  EXPECT_THAT(refusal(file("word.stl", "solid a\nfacet normal 0 0 1\nouter lop\nvertx 1 2 3\n")),
              testing::HasSubstr("word.stl:4: 'vertx' is no word of text STL"));
  const tests::Soup soup = tests::cube();
  write_stl(folder_ / "whole.stl", TriangleMesh(soup.vertices, soup.triangles), 1);
  const std::string bytes = content(folder_ / "whole.stl");
  EXPECT_THAT(refusal(file("short.stl", bytes.substr(0, bytes.size() - 1))),
              testing::HasSubstr("cut short: 12 triangles take 684 bytes, there are 683"));
  EXPECT_THAT(refusal(file("header.stl", bytes.substr(0, 50))), testing::HasSubstr("too few"));
  std::string fewer = bytes;  // what follows the triangles told is not looked at
  fewer[80] = 11;
  EXPECT_THAT(refusal(file("fewer.stl", fewer)), testing::HasSubstr("not closed"));
  std::string nan = bytes;
  nan.replace(96, 4, "\xff\xff\xff\x7f");
  EXPECT_THAT(refusal(file("nan.stl", nan)), testing::HasSubstr("is not finite"));
}

// Any byte of a small file changed, or its end cut off: a mesh or an InputError, nothing else.
TEST_F(MeshFiles, SpoiltFilesNeverDoWorse) {
  const tests::Soup soup = tests::cube();
  write_stl(folder_ / "whole.stl", TriangleMesh(soup.vertices, soup.triangles), 1);
  std::mt19937_64 random(1);
  for (const auto& [name, whole] :
       {std::pair<std::string, std::string>{"b.stl", content(folder_ / "whole.stl")},
        {"t.stl", text_stl(soup)},
        {"o.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"}}) {
    int read = 0, refused = 0;
    for (int i = 0; i < (name == "o.obj" ? 40 : 400); ++i) {
      std::string spoilt = whole;
      for (int k = 0; k < 3; ++k) spoilt[random() % spoilt.size()] = static_cast<char>(random());
      if (i % 2) spoilt.resize(random() % spoilt.size());
      try {
        const TriangleMesh mesh = read_mesh(file(name, spoilt), 1);
        EXPECT_GE(mesh.size(), 1);
        for (const Vec3& v : mesh.vertices()) EXPECT_TRUE(std::isfinite(v.x + v.y + v.z)) << name;
        ++read;
      } catch (const InputError&) {
        ++refused;
      }
    }
    EXPECT_GT(refused, read) << name;
  }
}

}  // namespace
}  // namespace soilbin::dem
