#include "scenario/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <system_error>

namespace soilbin {
namespace {

namespace fs = std::filesystem;

std::string reason_of(int error) { return std::generic_category().message(error); }

fs::path parent_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

/// Where a chain of links ends, be there a file or not.
fs::path behind_links(fs::path path) {
  constexpr int longest_chain = 40;  // as the system has it
  std::error_code none;
  for (int k = 0; k < longest_chain && fs::is_symlink(path, none); ++k) {
    const fs::path next = fs::read_symlink(path, none);
    path = next.is_absolute() ? next : parent_of(path) / next;
  }
  return path;
}

/// A device, a pipe or a socket, behind links too.
bool is_stream(const fs::path& path) {
  struct stat known {};
  return ::stat(path.c_str(), &known) == 0 && !S_ISREG(known.st_mode) && !S_ISDIR(known.st_mode);
}

/// A name beside the target that no other writer has.
std::string temporary_name(const fs::path& target, const char* end) {
  constexpr std::size_t enough = 100;  // of a name; a system has room for 255 characters
  const std::string name = target.filename().string().substr(0, enough);
  return (parent_of(target) / fmt::format(".{}.soilbin-{}", name, end)).string();
}

/// Makes a rename last; a folder that can't be opened or synced is no reason to fail.
void flush_folder(const fs::path& path) {
  const int descriptor = ::open(parent_of(path).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

/// Temporary files of a target whose writers are no more.
void remove_abandoned(const fs::path& target) {
  const std::string begin = fs::path(temporary_name(target, "")).filename().string();
  std::error_code none;
  for (fs::directory_iterator entry(parent_of(target), none), end; !none && entry != end; entry.increment(none)) {
    if (!entry->path().filename().string().starts_with(begin)) continue;
    const int descriptor = ::open(entry->path().c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0) continue;
    if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) ::unlink(entry->path().c_str());
    ::close(descriptor);
  }
}

/// Gives a file that has no name its first one; false with errno where that fails: EEXIST where somebody has it.
bool take_name(int descriptor, const fs::path& name) {
  const std::string self = fmt::format("/proc/self/fd/{}", descriptor);
  return ::linkat(AT_FDCWD, self.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0;
}

/// Names an open file beside the target, by a name that no other writer has; "" with errno where that fails.
std::string take_temporary_name(int descriptor, const fs::path& target) {
  static std::atomic<unsigned> count{0};
  for (;;) {
    const std::string name = temporary_name(target, fmt::format("{}-{}", ::getpid(), ++count).c_str());
    if (take_name(descriptor, name)) return name;
    if (errno != EEXIST) return "";
  }
}

mode_t default_mode() {
  const mode_t mask = ::umask(0);
  ::umask(mask);
  return static_cast<mode_t>(0666) & ~mask;
}

/// The nearest folder above a path that is there; what stands in the way, if that is no folder.
fs::path nearest_above(const fs::path& path) {
  std::error_code none;
  fs::path above = parent_of(fs::absolute(path, none));
  while (!fs::exists(above, none) && above != above.parent_path()) above = above.parent_path();
  return above;
}

std::string why_no_file_in(const fs::path& folder) {
  std::error_code none;
  if (!fs::is_directory(folder, none))
    return fmt::format("'{}' is a file, where a folder is to be\n  hint: name a new folder, or one that is there",
                       folder.string());
  try {
    const FreshFile trial(folder / "trial", Links::replaced);
  } catch (const std::runtime_error& error) {
    return fmt::format("no file can be made in '{}'{}\n  hint: name a folder that you may write to", folder.string(),
                       std::string(error.what()).substr(std::string(error.what()).rfind(": ")));
  }
  return "";
}

}  // namespace

FreshFile::FreshFile(const fs::path& path, Links links)
    : target_(links == Links::followed ? behind_links(path) : path) {
  if (links == Links::followed && is_stream(path)) {
    target_ = path, kind_ = Kind::stream;
    descriptor_ = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor_ < 0) fail("open", errno);
    return;
  }
  std::error_code none;
  if (fs::is_directory(target_, none) && !fs::is_symlink(target_, none)) fail("write", EISDIR);
  make_folder(parent_of(target_));
  if (!make_unnamed()) make_temporary();
  ::flock(descriptor_, LOCK_EX | LOCK_NB);  // says that its writer is alive
}

FreshFile::~FreshFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!name_.empty()) ::unlink(name_.c_str());
}

/// False where the file system has no such files.
bool FreshFile::make_unnamed() {
  descriptor_ = ::open(parent_of(target_).c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600);
  kind_ = Kind::unnamed;
  if (descriptor_ >= 0) return true;
  if (errno == EOPNOTSUPP || errno == EISDIR || errno == EINVAL || errno == ENOENT) return false;
  fail("create a file in its folder", errno);
}

void FreshFile::make_temporary() {
  std::string name = temporary_name(target_, "XXXXXX");
  descriptor_ = ::mkstemp(name.data());
  kind_ = Kind::temporary;
  if (descriptor_ < 0) fail("create a file in its folder", errno);
  name_ = name;
}

void FreshFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail("write", errno);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void FreshFile::flush() {
  if (::fsync(descriptor_) != 0 && !(kind_ == Kind::stream && (errno == EINVAL || errno == EROFS)))
    fail("flush", errno);
}

/// A file that was there keeps who may read and write it; where its owner can't be given, the owner is who writes.
void FreshFile::take_permissions() {
  struct stat known {};
  const bool there = ::lstat(target_.c_str(), &known) == 0 && S_ISREG(known.st_mode);
  if (there && ::fchown(descriptor_, known.st_uid, known.st_gid) != 0 && errno != EPERM) fail("set the owner", errno);
  const mode_t mode = there ? known.st_mode & static_cast<mode_t>(07777) : default_mode();
  if (::fchmod(descriptor_, mode) != 0) fail("set the mode", errno);
}

// There is no system call that names a file over another one: to replace it the file has a name of its own for an
// instant. What a program that was killed in that instant left is known by its lock, which went with the program.
void FreshFile::put_in_place() {
  flush();
  if (kind_ != Kind::stream) {
    take_permissions();
    const bool is_new = kind_ == Kind::unnamed && take_name(descriptor_, target_);
    if (!is_new) {
      if (kind_ == Kind::unnamed) name_ = take_temporary_name(descriptor_, target_);
      if (name_.empty()) fail("name", errno);
      if (std::rename(name_.c_str(), target_.c_str()) != 0) fail("rename into place", errno);
      name_.clear();
      remove_abandoned(target_);
    }
    flush_folder(target_);
  }
  const int closed = ::close(descriptor_);
  descriptor_ = -1;
  if (closed != 0) fail("close", errno);
}

void FreshFile::fail(const char* step, int reason) const {
  throw CannotWrite(fmt::format("{}: can't {}: {}", target_.string(), step, reason_of(reason)));
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error && !fs::is_directory(folder, error))
    throw CannotWrite(fmt::format("{}: can't make the folder: {}", folder.string(), error.message()));
}

void write_file_atomically(const fs::path& path, std::string_view content) {
  FreshFile file(path);
  file.write(content);
  file.put_in_place();
}

void append_line(const fs::path& path, std::string_view line) {
  const auto fail = [&](const char* step) {
    throw CannotWrite(fmt::format("{}: can't {}: {}", path.string(), step, reason_of(errno)));
  };
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
  if (file < 0) fail("open");
  const std::unique_ptr<const int, void (*)(const int*)> closes(&file, [](const int* it) { ::close(*it); });
  off_t end = ::lseek(file, 0, SEEK_END);
  for (char last = 0; end > 0 && ::pread(file, &last, 1, end - 1) == 1 && last != '\n';) --end;
  const std::string text = std::string(line) + "\n";
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t written = ::pwrite(file, text.data() + done, text.size() - done, end + static_cast<off_t>(done));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail("write");
    done += static_cast<std::size_t>(written);
  }
  if (::ftruncate(file, end + static_cast<off_t>(text.size())) != 0 || ::fsync(file) != 0) fail("flush");
}

std::string why_not_writable(const fs::path& path) {
  const fs::path target = behind_links(path);
  std::error_code none;
  if (fs::is_directory(target, none))
    return fmt::format("'{}' is a folder, where a file is to be written", path.string());
  if (::access(target.c_str(), F_OK) != 0 && (errno == ENAMETOOLONG || errno == ELOOP))
    return fmt::format("'{}' can't be written: {}", path.string(), reason_of(errno));
  if (fs::exists(target, none) && ::access(target.c_str(), W_OK) != 0)
    return fmt::format("'{}' can't be written: {}", path.string(), reason_of(errno));
  return is_stream(path) ? "" : why_no_file_in(nearest_above(target));
}

std::string why_no_folder(const fs::path& path) { return why_no_file_in(nearest_above(path / "file")); }

}  // namespace soilbin
