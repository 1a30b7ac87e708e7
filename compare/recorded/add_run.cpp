// Several processes may fill one record: each holds the folder's lock while it reads and replaces the file.
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "compare/recorded/record.hpp"
#include "scenario/atomic_file.hpp"

namespace soilbin::compare {
namespace {

class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder) : folder_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY)) {
    int status = folder_ < 0 ? -1 : ::flock(folder_, LOCK_EX);
    while (folder_ >= 0 && status != 0 && errno == EINTR) status = ::flock(folder_, LOCK_EX);
    if (status == 0) return;
    const std::string reason = std::strerror(errno);
    if (folder_ >= 0) ::close(folder_);
    throw std::runtime_error("cannot lock the folder " + folder.string() + ": " + reason);
  }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  ~FolderLock() { ::close(folder_); }

 private:
  int folder_;
};

}  // namespace

void add_run(const std::filesystem::path& file, const Record& empty, RecordedRun run) {
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
  std::filesystem::create_directories(folder);
  const FolderLock lock(folder);
  Record record = std::filesystem::exists(file) ? read_record(file) : empty;
  refuse_other_inputs(record, empty.inputs, file);
  if (find_run(record, run.answer.at, run.packing) != nullptr) return;
  record.runs.push_back(std::move(run));
  write_file_atomically(file, record_text(record));
}

}  // namespace soilbin::compare
