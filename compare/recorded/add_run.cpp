// Several processes may fill one record: each holds the folder's lock while it reads and replaces the file.
#include "compare/recorded/record.hpp"
#include "scenario/atomic_file.hpp"
#include "scenario/file_lock.hpp"

namespace soilbin::compare {

void add_run(const std::filesystem::path& file, const Record& empty, RecordedRun run) {
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
  make_folder(folder);
  const FileLock lock(folder, FileLock::Wait::until_free);
  Record record = std::filesystem::exists(file) ? read_record(file) : empty;
  refuse_other_inputs(record, empty.inputs, file);
  if (find_run(record, run.answer.at, run.packing) == nullptr) {
    record.runs.push_back(run);
    write_file_atomically(file, record_text(record));
  }
  if (run.when_safe) run.when_safe();
}

}  // namespace soilbin::compare
