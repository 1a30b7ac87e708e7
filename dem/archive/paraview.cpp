#include "dem/archive/paraview.hpp"

#include <fmt/core.h>

#include <bit>
#include <cstring>
#include <fstream>
#include <map>
#include <vector>

#include "scenario/atomic_file.hpp"
#include "scenario/markup.hpp"

namespace soilbin::dem {
namespace {

namespace fs = std::filesystem;

static_assert(std::endian::native == std::endian::little, "the files say LittleEndian");

std::string base64(std::string_view bytes) {
  static constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - at);
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = word << 8 | (k < count ? static_cast<unsigned char>(bytes[at + k]) : std::uint32_t{0});
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? letters[word >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

template <class T>
constexpr const char* vtk_type() {
  if constexpr (std::is_same_v<T, float>) return "Float32";
  if constexpr (std::is_same_v<T, double>) return "Float64";
  if constexpr (std::is_same_v<T, std::int32_t>) return "Int32";
  if constexpr (std::is_same_v<T, std::uint32_t>) return "UInt32";
  if constexpr (std::is_same_v<T, std::uint8_t>) return "UInt8";
}

/// Length in bytes and numbers, one after the other in base64. extra: further attributes.
template <class T>
std::string array(const char* name, const std::vector<T>& numbers, const std::string& extra = "") {
  const std::uint64_t size = numbers.size() * sizeof(T);
  std::string bytes(sizeof(size) + size, '\0');
  std::memcpy(bytes.data(), &size, sizeof(size));
  if (size > 0) std::memcpy(bytes.data() + sizeof(size), numbers.data(), size);
  return fmt::format("<DataArray type=\"{}\" Name=\"{}\"{} format=\"binary\">{}</DataArray>\n", vtk_type<T>(), name,
                     extra, base64(bytes));
}

std::string vectors(const char* name, const std::vector<float>& numbers) {
  return array(name, numbers, " NumberOfComponents=\"3\"");
}

void append(std::vector<float>& numbers, const Vec3& a) {
  for (const double part : {a.x, a.y, a.z}) numbers.push_back(static_cast<float>(part));
}

std::string poly_data(const std::string& field_data, const std::string& counts, const std::string& piece) {
  return fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n"
      "{}<Piece {}>\n{}</Piece>\n</PolyData>\n</VTKFile>\n",
      field_data, counts, piece);
}

/// `size` corners each, in order where `corners` says no other.
std::string cells(const char* name, std::size_t count, std::int32_t size, std::vector<std::int32_t> corners = {}) {
  std::vector<std::int32_t> ends;
  for (std::size_t k = 0; k < count; ++k) ends.push_back(static_cast<std::int32_t>(k + 1) * size);
  if (corners.empty())
    for (std::size_t k = 0; k < count; ++k) corners.push_back(static_cast<std::int32_t>(k));
  return fmt::format("<{0}>\n{1}{2}</{0}>\n", name, array("connectivity", corners), array("offsets", ends));
}

/// What XML takes as an attribute: no markup, no control characters.
constexpr std::size_t step_digits = 12;

/// Lines of a .pvd by the step and the name of their file.
using Entries = std::map<std::string, std::string>;

/// Sorts names that end in STEP.vtp by step: ParaView wants times to rise.
std::string key_of(const std::string& file) {
  const std::size_t end = step_digits + 4;
  return (file.size() < end ? std::string() : file.substr(file.size() - end)) + file;
}

std::string file_of(const std::string& line) {
  const std::string mark = "file=\"";
  const std::size_t begin = line.find(mark);
  if (!line.starts_with("<DataSet ") || begin == std::string::npos) return "";
  return line.substr(begin + mark.size(), line.find('"', begin + mark.size()) - begin - mark.size());
}

Entries read_pvd(const fs::path& path) {
  Entries entries;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);)
    if (const std::string name = file_of(line); !name.empty()) entries[key_of(name)] = line;
  return entries;
}

void write_pvd(const fs::path& path, const Entries& entries) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
      "<Collection>\n";
  for (const auto& [key, line] : entries) text += line + '\n';
  write_file_atomically(path, text + "</Collection>\n</VTKFile>\n");
}

bool has_mesh(const Body& body) {
  for (const Surface& surface : body.surfaces)
    if (std::holds_alternative<MeshSurface>(surface.shape)) return true;
  return false;
}

/// Grains as points: radius, velocity (of the half step before), id, material.
std::string grains_vtp(const Grains& grains) {
  std::vector<float> positions, velocities, radii;
  for (std::size_t k = 0; k < grains.count(); ++k) {
    append(positions, grains.motion[k].position);
    append(velocities, grains.motion[k].velocity);
    radii.push_back(static_cast<float>(grains.motion[k].radius));
  }
  const std::string data = "<PointData Scalars=\"radius\" Vectors=\"velocity\">\n" + array("radius", radii) +
                           vectors("velocity", velocities) + array("id", grains.id) +
                           array("material", grains.material) + "</PointData>\n";
  return poly_data(
      "", fmt::format("NumberOfPoints=\"{0}\" NumberOfVerts=\"{0}\"", grains.count()),
      data + "<Points>\n" + vectors("Points", positions) + "</Points>\n" + cells("Verts", grains.count(), 1));
}

}  // namespace

std::string body_vtp(const Body& body) {
  std::vector<float> positions, velocities;
  std::vector<std::int32_t> corners;
  for (const Surface& surface : body.surfaces) {
    const auto* shape = std::get_if<MeshSurface>(&surface.shape);
    if (!shape) continue;
    const auto before = static_cast<std::int32_t>(positions.size() / 3);
    for (const Vec3& vertex : shape->mesh->vertices()) {
      const Vec3 at = body.to_bin(vertex);
      append(positions, at);
      append(velocities, body.velocity_at(at));
    }
    for (const auto& triangle : shape->mesh->triangles())
      for (const int corner : triangle) corners.push_back(before + corner);
  }
  const auto field = [](const char* name, const Vec3& a) {
    return array<double>(name, {a.x, a.y, a.z}, " NumberOfComponents=\"3\" NumberOfTuples=\"1\"");
  };
  const std::size_t count = corners.size() / 3;
  return poly_data("<FieldData>\n" + field("force", body.force) + field("torque", body.torque) + "</FieldData>\n",
                   fmt::format("NumberOfPoints=\"{}\" NumberOfPolys=\"{}\"", positions.size() / 3, count),
                   "<PointData Vectors=\"velocity\">\n" + vectors("velocity", velocities) + "</PointData>\n<Points>\n" +
                       vectors("Points", positions) + "</Points>\n" + cells("Polys", count, 3, std::move(corners)));
}

void export_to_paraview(const fs::path& folder, const std::string& name, const State& state) {
  make_folder(folder);
  const fs::path pvd = folder / (name + ".pvd");
  Entries entries = read_pvd(pvd);
  const auto add = [&](const std::string& part, int number, const std::string& title, const std::string& content) {
    const std::string file = fmt::format("{}-{}-{:0{}}.vtp", name, part, state.step, step_digits);
    write_file_atomically(folder / file, content);
    entries[key_of(escaped(file))] = fmt::format("<DataSet timestep=\"{}\" part=\"{}\" name=\"{}\" file=\"{}\"/>",
                                                 state.time, number, escaped(title), escaped(file));
  };
  add("grains", 0, "grains", grains_vtp(state.grains));
  for (std::size_t k = 0; k < state.bodies.size(); ++k)
    if (has_mesh(state.bodies[k]))
      add(fmt::format("body-{}", k), static_cast<int>(k) + 1, state.bodies[k].name, body_vtp(state.bodies[k]));
  write_pvd(pvd, entries);
}

}  // namespace soilbin::dem
