#include "scenario/file_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace soilbin {

FileLock::FileLock(const std::filesystem::path& place, Wait wait)
    : descriptor_(std::filesystem::is_directory(place) ? ::open(place.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)
                                                       : ::open(place.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
  const int how = wait == Wait::no ? LOCK_EX | LOCK_NB : LOCK_EX;
  int status = descriptor_ < 0 ? -1 : ::flock(descriptor_, how);
  while (descriptor_ >= 0 && status != 0 && errno == EINTR) status = ::flock(descriptor_, how);
  if (status == 0) return;
  const int error = errno;
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
  if (wait == Wait::no && error == EWOULDBLOCK) return;
  throw std::runtime_error("cannot lock " + place.string() + ": " + std::strerror(error));
}

FileLock::~FileLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace soilbin
