// Files that are whole or refused. 512 bytes of text before the content say what it is, how long it is and its
// checksum; HDF5 takes them for a user block, so other programs read the file as it is.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace soilbin::dem {

/// What a sealed file holds, and the version of its layout.
struct FileKind {
  std::string name;  ///< of letters a .. z
  int version;
  std::string content = "HDF5 follows at byte 512, layout in docs/reference/dem-archive.md";  ///< for people
};

/// Beside the file: where the last one but one is kept.
std::filesystem::path previous_of(const std::filesystem::path& path);

enum class Keep { nothing, previous };

/// Writes a whole file or nothing (FreshFile): flushed to the disk, then renamed; a link of that name is replaced. With
/// Keep::previous the file that was there stays as previous_of(path), unless it is damaged; so at each moment a good
/// one is under one of the two names. Several may write the same path: the last one stays. Throws std::runtime_error
/// with file, step and the system's reason.
void write_sealed(const std::filesystem::path& path, const FileKind& kind, std::string_view content, Keep keep);

/// A file that came back as it was written.
class SealedFile {
 public:
  /// Throws InputError where the file can't be read, is of another kind or version, cut short or damaged.
  SealedFile(const std::filesystem::path& path, const FileKind& kind);
  std::string_view content() const;

 private:
  std::string bytes_;
};

}  // namespace soilbin::dem
