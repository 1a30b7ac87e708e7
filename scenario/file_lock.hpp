// A lock on a file or a folder, so that one process at a time works on it.
#pragma once

#include <filesystem>
#include <functional>

namespace soilbin {

/// Processes that add to a file at the same time: several, each of which holds its folder's lock for it, or one. On
/// file systems without locks, as clusters have them, each process has a file of its own.
enum class Writers { several, one };

/// Held until it goes away, or the process does, however that ends (flock).
class FileLock {
 public:
  enum class Wait { until_free, no };

  /// On a folder, or on a file that is made where it isn't there; a link of that name is refused. Throws
  /// std::runtime_error with the system's reason where there can be no lock.
  FileLock(const std::filesystem::path& place, Wait wait);
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;
  ~FileLock();
  /// False where another one holds it and it wasn't waited for.
  bool is_held() const { return descriptor_ >= 0; }

 private:
  int descriptor_ = -1;
};

/// What every wait for a lock calls about ten times a second, with what it waits for: it may tell a person, or throw to
/// give up. The program sets it once, before there are threads; without it waits are silent.
void set_while_waiting(std::function<void(const std::filesystem::path& place)> look);

}  // namespace soilbin
