// What ParaView reads.
#include "dem/archive/paraview.hpp"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <memory>
#include <sstream>

#include "tests/dem/archive_scene.hpp"

namespace soilbin::dem {
namespace {

using test::Folder;
using test::read_bytes;
using test::scene;
using test::write_bytes;
using ::testing::HasSubstr;

/// Reads .vtp and .pvd by Python's XML parser: a line a piece of data, name and numbers.
std::string by_python(const std::filesystem::path& path) {
  const char* script = R"(
import base64, struct, sys
import xml.etree.ElementTree as tree
root = tree.parse(sys.argv[1]).getroot()
assert root.tag == 'VTKFile' and root.get('byte_order') == 'LittleEndian'
print(root.get('type'), root.get('header_type'))
for piece in root.iter('Piece'):
    print(*(f'{key}={piece.get(key)}' for key in sorted(piece.keys())))
codes = {'Float32': 'f', 'Float64': 'd', 'Int32': 'i', 'UInt32': 'I', 'UInt8': 'B'}
for array in root.iter('DataArray'):
    data = base64.b64decode(array.text, validate=True)
    size, = struct.unpack_from('<Q', data)
    assert size == len(data) - 8, (size, len(data))
    code = codes[array.get('type')]
    numbers = struct.unpack_from(f'<{size // struct.calcsize(code)}{code}', data, 8)
    print(array.get('Name'), array.get('NumberOfComponents'), len(numbers), *(f'{x:.9g}' for x in numbers[:6]))
for entry in root.iter('DataSet'):
    print(entry.get('timestep'), entry.get('part'), entry.get('name'), entry.get('file'))
)";
  const Folder folder;
  write_bytes(folder / "read.py", script);
  const std::string command = "python3 '" + (folder / "read.py").string() + "' '" + path.string() + "' 2>&1";
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(::popen(command.c_str(), "r"), ::pclose);
  std::string text;
  std::array<char, 4096> part;
  while (const std::size_t size = std::fread(part.data(), 1, part.size(), pipe.get())) text.append(part.data(), size);
  return text;
}

TEST(ParaView, ReadsGrains) {
  Simulation simulation = scene(40);
  const Folder folder;
  export_to_paraview(folder.path(), "bed", simulation.state());
  const Grains& grains = simulation.state().grains;
  const std::size_t count = grains.count();
  const std::string text = by_python(folder / "bed-grains-000000000000.vtp");
  EXPECT_THAT(text, HasSubstr("PolyData UInt64\n"));
  EXPECT_THAT(text, HasSubstr("NumberOfPoints=" + std::to_string(count) + " NumberOfVerts=" + std::to_string(count)));
  std::ostringstream points;
  points.precision(9);
  points << "Points 3 " << 3 * count;
  for (int k = 0; k < 2; ++k) {
    const Vec3& at = grains.motion[k].position;
    points << ' ' << static_cast<float>(at.x) << ' ' << static_cast<float>(at.y) << ' ' << static_cast<float>(at.z);
  }
  EXPECT_THAT(text, HasSubstr(points.str() + "\n"));
  EXPECT_THAT(text, HasSubstr("radius None " + std::to_string(count)));
  EXPECT_THAT(text, HasSubstr("velocity 3 " + std::to_string(3 * count)));
  EXPECT_THAT(text, HasSubstr("id None " + std::to_string(count) + " 0 1 2 3 4 5\n"));
  EXPECT_THAT(text, HasSubstr("material None " + std::to_string(count) + " 0 0 0 0 0 0\n"));
  EXPECT_THAT(text, HasSubstr("connectivity None " + std::to_string(count) + " 0 1 2 3 4 5\n"));
  EXPECT_THAT(text, HasSubstr("offsets None " + std::to_string(count) + " 1 2 3 4 5 6\n"));
}

TEST(ParaView, ReadsBodiesWhereTheyAre) {
  Body body;
  body.surfaces = {{MeshSurface{std::make_shared<const TriangleMesh>(plate(2, 2, 1, 1)), nullptr}, 0}, {Plane{}, 0}};
  body.position = {10, 0, 0};
  body.rotation = rotation_by({0, 0, std::acos(0.0)});  // a quarter turn: x becomes y
  body.velocity = {1, 0, 0};
  body.spin = {0, 0, 2};
  body.force = {5, 6, 7};
  const Folder folder;
  write_bytes(folder / "body.vtp", body_vtp(body));
  const std::string text = by_python(folder / "body.vtp");
  EXPECT_THAT(text, HasSubstr("NumberOfPoints=4 NumberOfPolys=2\n"));
  EXPECT_THAT(text, HasSubstr("force 3 3 5 6 7\n"));
  // The first vertex (-1, -1) of the plate is at (10 + 1, -1) now; its velocity is (1, 0) + 2 (1, 1).
  EXPECT_THAT(text, HasSubstr("Points 3 12 11 -1 0"));
  EXPECT_THAT(text, HasSubstr("velocity 3 12 3 2 0"));
  EXPECT_THAT(text, HasSubstr("offsets None 2 3 6\n"));
}

TEST(ParaView, KnowsTheTimes) {
  Simulation simulation = scene(20);
  simulation.body(1).name = "a \"wheel\" & <more>";
  const Folder folder;
  for (int k = 0; k < 2; ++k) {
    export_to_paraview(folder.path(), "bed", simulation.state());
    simulation.run(50);
  }
  Simulation again = scene(20);
  again.body(1).name = simulation.body(1).name;
  again.run(50);
  EXPECT_EQ(by_python(folder / "bed.pvd"), fmt::format("Collection None\n"
                                                       "0 2 a \"wheel\" & <more> bed-body-1-000000000000.vtp\n"
                                                       "0 3 block bed-body-2-000000000000.vtp\n"
                                                       "0 0 grains bed-grains-000000000000.vtp\n"
                                                       "{0} 2 a \"wheel\" & <more> bed-body-1-000000000050.vtp\n"
                                                       "{0} 3 block bed-body-2-000000000050.vtp\n"
                                                       "{0} 0 grains bed-grains-000000000050.vtp\n",
                                                       again.time()));
  // Once more the same step: nothing is entered twice.
  const std::string before = read_bytes(folder / "bed.pvd");
  export_to_paraview(folder.path(), "bed", again.state());
  EXPECT_TRUE(read_bytes(folder / "bed.pvd") == before);
}

}  // namespace
}  // namespace soilbin::dem
