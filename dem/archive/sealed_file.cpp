#include "dem/archive/sealed_file.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <system_error>

#include "scenario/atomic_file.hpp"
#include "scenario/checksum.hpp"
#include "scenario/errors.hpp"

namespace soilbin::dem {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t header_bytes = 512;  // where HDF5 looks for its own beginning
constexpr std::string_view programme = "soilbin ";

std::string header_of(const FileKind& kind, std::string_view content) {
  std::string text = fmt::format("{}{} {}\nbytes {}\nfnv1a {:016x}\n{}\n", programme, kind.name, kind.version,
                                 content.size(), fnv1a(content), kind.content);
  text.resize(header_bytes, '\n');
  return text;
}

[[noreturn]] void refuse(const fs::path& path, const std::string& message, const std::string& hint) {
  throw InputError({path.string(), 0, 0}, message, "", hint);
}

[[noreturn]] void fail(const fs::path& path, const char* step, int reason) {
  throw std::runtime_error(
      fmt::format("{}: can't {}: {}", path.string(), step, std::generic_category().message(reason)));
}

bool is_good(const fs::path& path, const FileKind& kind) {
  try {
    const SealedFile file(path, kind);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

/// Gives the file a second name, in one step; it keeps its first.
void keep_previous(const fs::path& path) {
  const fs::path previous = previous_of(path), between = path.string() + ".keeping";
  ::unlink(between.c_str());
  // Without hard links for a moment only the previous one is there.
  if (::link(path.c_str(), between.c_str()) != 0) {
    if (std::rename(path.c_str(), previous.c_str()) != 0) fail(previous, "rename into place", errno);
    return;
  }
  if (std::rename(between.c_str(), previous.c_str()) != 0) fail(previous, "rename into place", errno);
  ::unlink(between.c_str());  // it stays where both names were one file before
}

/// The first two words after 'soilbin'; false where they aren't there.
bool kind_of(std::string_view bytes, FileKind& kind) {
  if (!bytes.starts_with(programme)) return false;
  char name[33] = "";
  if (std::sscanf(std::string(bytes.substr(programme.size(), 64)).c_str(), "%32[a-z] %6d\n", name, &kind.version) != 2)
    return false;
  kind.name = name;
  return true;
}

std::string read_whole(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) refuse(path, "is a folder", "give the file in it");
  if (fs::exists(path, error) && !fs::is_regular_file(path, error)) refuse(path, "is no regular file", "");
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) refuse(path, fmt::format("can't be read: {}", std::generic_category().message(errno)), "");
  std::string bytes(static_cast<std::size_t>(file.tellg()), '\0');
  file.seekg(0);
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (static_cast<std::size_t>(file.gcount()) != bytes.size()) refuse(path, "can't be read to its end", "");
  return bytes;
}

}  // namespace

fs::path previous_of(const fs::path& path) { return path.string() + ".previous"; }

void write_sealed(const fs::path& path, const FileKind& kind, std::string_view content, Keep keep) {
  FreshFile file(path, Links::replaced);
  file.write(header_of(kind, content));
  file.write(content);
  file.flush();
  if (keep == Keep::previous && is_good(path, kind)) keep_previous(path);
  file.put_in_place();
}

SealedFile::SealedFile(const fs::path& path, const FileKind& kind) : bytes_(read_whole(path)) {
  const std::string_view header = std::string_view(bytes_).substr(0, header_bytes);
  FileKind found;
  if (!kind_of(header, found))
    refuse(path, fmt::format("is no soilbin {}, or damaged at its beginning", kind.name),
           fmt::format("give a {} that soilbin wrote", kind.name));
  if (found.name != kind.name)
    refuse(path, fmt::format("is a soilbin {}, not a {}", found.name, kind.name),
           fmt::format("give a {} that soilbin wrote", kind.name));
  if (found.version != kind.version)
    refuse(path, fmt::format("is of version {}, this soilbin reads version {}", found.version, kind.version),
           "read it with the soilbin that wrote it");
  const char* copy = "take the one before it, or a copy of it";
  std::size_t whole = 0;
  const std::size_t at = header.find("\nbytes ");
  if (header.size() < header_bytes || at == std::string_view::npos ||
      std::sscanf(std::string(header.substr(at)).c_str(), "\nbytes %19zu\n", &whole) != 1)
    refuse(path, "is cut short or damaged at its beginning", copy);
  if (content().size() < whole)
    refuse(path, fmt::format("is cut short: {} bytes of {}", bytes_.size(), whole + header_bytes), copy);
  if (header != header_of(kind, content())) refuse(path, "is damaged: its checksum doesn't fit its content", copy);
}

std::string_view SealedFile::content() const { return std::string_view(bytes_).substr(header_bytes); }

}  // namespace soilbin::dem
