// How soilbin writes files: whole or not at all, also where the disk is full or the program is killed.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace soilbin {

/// A file or a folder that can't be made; what() names it, the step and the system's reason.
struct CannotWrite : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What becomes of a name that is a symbolic link: the file that it leads to is written, as for names that a person
/// gave; or the link gives way to a file, as for names that the program chose in a folder that others may write to.
enum class Links { followed, replaced };

/// A file in the making. Nobody sees it before it is put in place; if it never is, nothing is left of it, however the
/// program ends. A program that is killed in the instant in which one file takes the other's place, or where the folder
/// can hold no file without a name (NFS), leaves a temporary file '.NAME.soilbin-XXXXXX', whose name no two writers
/// share; the next one that replaces the file removes it. A name that is a device or a pipe is written to as it comes.
class FreshFile {
 public:
  /// Makes missing folders. Throws CannotWrite, as do all.
  explicit FreshFile(const std::filesystem::path& path, Links links = Links::followed);
  FreshFile(const FreshFile&) = delete;
  FreshFile& operator=(const FreshFile&) = delete;
  ~FreshFile();

  void write(std::string_view bytes);
  /// Makes sure that what was written is on the disk.
  void flush();
  /// Gives the file its name, over what was there, whose permissions it takes.
  void put_in_place();

 private:
  enum class Kind { unnamed, temporary, stream };

  bool make_unnamed();
  void make_temporary();
  void take_permissions();
  [[noreturn]] void fail(const char* step, int reason) const;

  std::filesystem::path target_;
  std::string name_;  ///< of the temporary file, where there is one
  int descriptor_ = -1;
  Kind kind_ = Kind::unnamed;
};

/// Makes a folder and those above it, where they are missing. Throws CannotWrite.
void make_folder(const std::filesystem::path& folder);

/// Writes a whole file or nothing, and makes missing folders. On failure the target is as it was.
/// Throws CannotWrite.
void write_file_atomically(const std::filesystem::path& path, std::string_view content);

/// Adds a line to a file of lines, which is begun where it isn't there, and makes sure that it is on the disk. What
/// somebody who was stopped left behind the last whole line goes. A link of that name is refused. Throws CannotWrite.
void append_line(const std::filesystem::path& path, std::string_view line);

/// Why no file of this name could be written now, for people; "" where it could. Tries it in the nearest folder that is
/// there, and leaves nothing.
std::string why_not_writable(const std::filesystem::path& path);
/// Why a folder cannot be made or used, with the files in it; "" where it can.
std::string why_no_folder(const std::filesystem::path& path);

}  // namespace soilbin
