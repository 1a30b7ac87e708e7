// A JSON file that gets one answer after the other, from several processes at once, and loses none.
//
// An answer is one line of a journal beside the file, FILE.journal: a whole document of the file's format that holds it
// alone. Where the journal would become longer than the file, and at the end, both are made one file, in place of the
// old one; so the file is written a few times, however many answers it gets. A process that is killed leaves both, and
// kept_documents reads both. What it had not written to the end counts for nothing.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "scenario/file_lock.hpp"
#include "scenario/source_text.hpp"

namespace soilbin::compare {

/// The file, and the lines of its journal, which hold what came since. Throws InputError as read_source_text.
std::vector<SourceText> kept_documents(const std::filesystem::path& file);

class KeptFile {
 public:
  /// `read` adds what the file and its journal hold to what its owner knows; `text` is the file's text of all that is
  /// known. An empty name keeps nothing. One writer takes no lock; where it meets another's writing all the same, it
  /// writes the whole file.
  KeptFile(std::filesystem::path file, Writers writers, std::function<void()> read, std::function<std::string()> text);
  KeptFile(const KeptFile&) = delete;
  KeptFile& operator=(const KeptFile&) = delete;
  /// Makes file and journal one. What can't be written stays in the journal.
  ~KeptFile();

  /// Reads, where others have written since; whether they have.
  bool look();
  /// Reads what others have written, calls `add`, which changes what is known, and keeps that: `line` is the change as
  /// a document, or empty for one that needs the whole file written. Makes missing folders. Throws CannotWrite, also
  /// for a file that would be longer than what is read again (largest_json).
  void add(const std::function<void()>& add, std::string line);

 private:
  using State = std::vector<std::pair<std::uintmax_t, std::filesystem::file_time_type>>;
  State state() const;  ///< sizes and times of both files

  std::filesystem::path file_;
  Writers writers_;
  std::function<void()> read_;
  std::function<std::string()> text_;
  State known_{};  ///< as they were read or written here last
};

}  // namespace soilbin::compare
