#include "dem/surface/mesh_files.hpp"

#include <assimp/MemoryIOWrapper.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/core.h>

#include <algorithm>
#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>

#include "dem/surface/mesh_checks.hpp"
#include "dem/surface/positive.hpp"
#include "scenario/atomic_file.hpp"
#include "scenario/errors.hpp"
#include "scenario/file_bytes.hpp"

namespace soilbin::dem {
namespace {

constexpr std::size_t header_size = 80, count_size = 4, record_size = 50;  // of binary STL [bytes]

void put(std::string& bytes, std::uint32_t value) {  // lowest byte first, whatever the machine
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<char>((value >> shift) & 0xff));
}

void put(std::string& bytes, const Vec3& p) {
  for (const double part : {p.x, p.y, p.z}) put(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(part)));
}

void require_unit(const std::string& file, double unit) {
  if (!positive(unit)) {
    refuse_mesh(file, fmt::format("its unit of length is {} m", unit), "it must be positive: 1e-3 for millimetres");
  }
}

std::string lower(std::string word) {
  for (char& c : word) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  return word;
}

std::uint32_t get(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (unsigned i = 0; i < 4; ++i) value |= std::uint32_t{static_cast<unsigned char>(bytes[at + i])} << (8 * i);
  return value;
}

/// The last three vertices are a triangle.
void close_triangle(MeshSoup& content) {
  const int last = static_cast<int>(content.vertices.size()) - 1;
  content.triangles.push_back({last - 2, last - 1, last});
}

MeshSoup parse_binary_stl(const std::string& bytes, const std::string& file) {
  if (bytes.size() < header_size + count_size) {
    refuse_mesh(file, fmt::format("{} bytes are too few for an STL file", bytes.size()), "copy or export it again");
  }
  const std::size_t count = get(bytes, header_size);
  if (const std::size_t whole = header_size + count_size + record_size * count; bytes.size() < whole) {
    refuse_mesh(file,
                fmt::format("it is cut short: {} triangles take {} bytes, there are {}", count, whole, bytes.size()),
                "copy or export it again");
  }
  MeshSoup content;
  for (std::size_t t = 0; t < count; ++t) {
    const std::size_t at = header_size + count_size + record_size * t + 12;  // after the normal
    for (std::size_t i = 0; i < 3; ++i) {
      const auto part = [&](std::size_t k) { return std::bit_cast<float>(get(bytes, at + 12 * i + 4 * k)); };
      content.vertices.push_back({part(0), part(1), part(2)});
    }
    close_triangle(content);
  }
  return content;
}

/// The numbers of a line 'vertex x y z'; false where they are no numbers or more or fewer.
bool parse_vertex(std::istringstream& words, Vec3& p) {
  std::string word;
  for (double* part : {&p.x, &p.y, &p.z}) {
    if (!(words >> word)) return false;
    const char *first = word.data() + (word.front() == '+'), *last = word.data() + word.size();
    if (const auto [end, error] = std::from_chars(first, last, *part); error != std::errc() || end != last)
      return false;
  }
  return !(words >> word);
}

/// The normals of facets are not looked at: the order of the vertices tells them.
MeshSoup parse_text_stl(const std::string& text, const std::string& file) {
  MeshSoup content;
  std::istringstream lines(text);
  std::string line, word, last;
  for (int number = 1; std::getline(lines, line); ++number) {
    const auto refuse = [&](const std::string& message) {
      throw InputError({file, number, 0}, message, line,
                       "text STL has 'facet', 'outer loop', three times 'vertex x y z', "
                       "'endloop', 'endfacet'");
    };
    std::istringstream words(line);
    if (!(words >> word)) continue;
    last = lower(word);
    if (last == "vertex") {
      Vec3 p;
      if (!parse_vertex(words, p)) refuse("three numbers are expected after 'vertex'");
      content.vertices.push_back(p);
    } else if (last == "endloop") {
      if (content.vertices.size() != 3 * content.triangles.size() + 3) refuse("a facet has three vertices");
      close_triangle(content);
    } else if (last != "solid" && last != "facet" && last != "outer" && last != "endfacet" && last != "endsolid") {
      refuse(fmt::format("'{}' is no word of text STL", word));
    }
  }
  if (last != "endsolid")
    refuse_mesh(file, "it is cut short: the last line is not 'endsolid'", "copy or export it again");
  return content;
}

MeshSoup parse_stl(const std::string& bytes, const std::string& file) {
  // Some binary files start with 'solid' too; no text has a zero.
  const std::size_t start = bytes.find_first_not_of(" \t\r\n");
  const bool text = start != std::string::npos && lower(bytes.substr(start, 5)) == "solid" &&
                    bytes.substr(0, 1024).find('\0') == std::string::npos;
  return text ? parse_text_stl(bytes, file) : parse_binary_stl(bytes, file);
}

/// All files that assimp gets to see: the one that was read. What it names (an OBJ's mtllib) isn't there.
class OneFile : public Assimp::IOSystem {
 public:
  static constexpr const char* name = "drawing.obj";
  explicit OneFile(const std::string& bytes) : bytes_(bytes) {}
  bool Exists(const char* file) const override { return std::string_view(file) == name; }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* file, const char*) override {
    if (!Exists(file)) return nullptr;
    return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(bytes_.data()), bytes_.size());
  }
  void Close(Assimp::IOStream* file) override { delete file; }

 private:
  const std::string& bytes_;
};

MeshSoup parse_obj(const std::string& bytes, const std::string& file) {
  Assimp::Importer importer;
  importer.SetIOHandler(new OneFile(bytes));  // which the importer deletes
  const aiScene* const scene = importer.ReadFile(OneFile::name, aiProcess_Triangulate);
  if (!scene) refuse_mesh(file, fmt::format("it can't be read: {}", importer.GetErrorString()), "export it again");
  MeshSoup content;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& part = *scene->mMeshes[m];
    const int first = static_cast<int>(content.vertices.size());
    for (unsigned v = 0; v < part.mNumVertices; ++v) {
      const auto& p = part.mVertices[v];
      content.vertices.push_back({p.x, p.y, p.z});
    }
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      const aiFace& face = part.mFaces[f];
      if (face.mNumIndices != 3) continue;  // points and lines
      content.triangles.push_back({first + static_cast<int>(face.mIndices[0]),
                                   first + static_cast<int>(face.mIndices[1]),
                                   first + static_cast<int>(face.mIndices[2])});
    }
  }
  return content;
}

}  // namespace

MeshSoup read_triangles(const std::filesystem::path& path) {
  const std::string file = path.string();
  const std::string extension = lower(path.extension().string());
  if (extension != ".stl" && extension != ".obj") {
    refuse_mesh(file, fmt::format("'{}' is no kind of mesh file that is read", extension), "take .stl or .obj");
  }
  if (!std::filesystem::is_regular_file(path) || !std::ifstream(path).good()) {
    refuse_mesh(file, "it can't be read", "is the name right, and may you read it?");
  }
  const std::string bytes = read_bytes(path, largest_mesh);
  return extension == ".stl" ? parse_stl(bytes, file) : parse_obj(bytes, file);
}

TriangleMesh read_mesh(const std::filesystem::path& path, double unit, MeshOptions options) {
  options.name = path.string();
  require_unit(options.name, unit);
  MeshSoup content = read_triangles(path);
  for (Vec3& v : content.vertices) v = unit * v;
  return {std::move(content.vertices), std::move(content.triangles), options};
}

void write_stl(const std::filesystem::path& path, const TriangleMesh& mesh, double unit) {
  require_unit(path.string(), unit);
  std::string bytes = fmt::format("binary STL by soilbin, unit {} m", unit);
  bytes.resize(header_size, ' ');
  bytes.reserve(header_size + count_size + record_size * static_cast<std::size_t>(mesh.size()));
  put(bytes, static_cast<std::uint32_t>(mesh.size()));
  for (int t = 0; t < mesh.size(); ++t) {
    put(bytes, mesh.frame(t).normal);
    for (int i = 0; i < 3; ++i) {
      const Vec3 p = mesh.corner(t, i) / unit;
      constexpr double most = std::numeric_limits<float>::max();
      if (std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) > most) {
        refuse_mesh(path.string(), "a coordinate is too large for single precision", "take a longer unit");
      }
      put(bytes, p);
    }
    bytes.append(2, '\0');  // the attributes of this triangle: none
  }
  write_file_atomically(path, bytes);
}

}  // namespace soilbin::dem
