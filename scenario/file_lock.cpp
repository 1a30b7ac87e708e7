#include "scenario/file_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>

namespace soilbin {
namespace {

constexpr std::chrono::milliseconds between_looks{100};

std::function<void(const std::filesystem::path&)>& while_waiting() {
  static std::function<void(const std::filesystem::path&)> look;
  return look;
}

int opened(const std::filesystem::path& place) {
  std::error_code unseen;
  if (std::filesystem::is_directory(place, unseen)) return ::open(place.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  return ::open(place.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
}

/// Whether it was had at once; otherwise errno says why not.
bool try_lock(int descriptor) {
  int status = ::flock(descriptor, LOCK_EX | LOCK_NB);
  while (status != 0 && errno == EINTR) status = ::flock(descriptor, LOCK_EX | LOCK_NB);
  return status == 0;
}

/// Closes what it was given, unless it is taken out.
struct Opened {
  int descriptor;
  explicit Opened(int d) : descriptor(d) {}
  Opened(const Opened&) = delete;
  Opened& operator=(const Opened&) = delete;
  ~Opened() {
    if (descriptor >= 0) ::close(descriptor);
  }
};

}  // namespace

FileLock::FileLock(const std::filesystem::path& place, Wait wait) {
  Opened file(opened(place));
  const auto fail = [&] {
    throw std::runtime_error("cannot lock " + place.string() + ": " + std::generic_category().message(errno));
  };
  if (file.descriptor < 0) fail();
  while (!try_lock(file.descriptor)) {
    if (errno != EWOULDBLOCK) fail();
    if (wait == Wait::no) return;
    if (while_waiting()) while_waiting()(place);
    std::this_thread::sleep_for(between_looks);
  }
  descriptor_ = std::exchange(file.descriptor, -1);
}

FileLock::~FileLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void set_while_waiting(std::function<void(const std::filesystem::path&)> look) { while_waiting() = std::move(look); }

}  // namespace soilbin
