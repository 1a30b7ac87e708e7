#include "compare/recorded/kept_file.hpp"

#include <algorithm>
#include <optional>

#include "compare/report/sealed_json.hpp"
#include "scenario/atomic_file.hpp"
#include "scenario/file_bytes.hpp"

namespace soilbin::compare {
namespace {

namespace fs = std::filesystem;

fs::path journal_of(const fs::path& file) { return file.string() + ".journal"; }

std::uintmax_t size_of(const fs::path& file) {
  std::error_code none;
  const std::uintmax_t size = fs::file_size(file, none);
  return none ? 0 : size;
}

}  // namespace

std::vector<SourceText> kept_documents(const fs::path& file) {
  std::string journal;  // read first: what another process moves into the file meanwhile is read twice, not missed
  if (fs::exists(journal_of(file))) journal = read_bytes(journal_of(file), largest_json);
  std::vector<SourceText> documents{read_source_text(file, largest_json)};
  for (std::size_t begin = 0, end; (end = journal.find('\n', begin)) != journal.npos; begin = end + 1)
    documents.push_back(make_source_text(journal.substr(begin, end - begin), journal_of(file).string()));
  return documents;
}

KeptFile::KeptFile(fs::path file, Writers writers, std::function<void()> read, std::function<std::string()> text)
    : file_(std::move(file)), writers_(writers), read_(std::move(read)), text_(std::move(text)) {}

KeptFile::~KeptFile() {
  try {
    if (!file_.empty() && fs::exists(journal_of(file_))) add([] {}, "");
  } catch (...) {  // the journal is read as well as the file
  }
}

KeptFile::State KeptFile::state() const {
  State state;
  for (const fs::path& file : {file_, journal_of(file_)}) {
    std::error_code none;
    state.emplace_back(size_of(file), fs::last_write_time(file, none));
  }
  return state;
}

bool KeptFile::look() {
  if (file_.empty() || !fs::exists(file_)) return false;
  State now = state();
  if (now == known_) return false;
  const bool written_over = writers_ == Writers::one && !known_.empty();  // what is known here may be lost there
  read_();
  known_ = written_over ? State() : std::move(now);  // so add() looks again, and writes the whole file
  return true;
}

void KeptFile::add(const std::function<void()>& add, std::string line) {
  if (file_.empty()) return add();
  const fs::path folder = file_.has_parent_path() ? file_.parent_path() : fs::path(".");
  make_folder(folder);
  std::optional<FileLock> lock;
  if (writers_ == Writers::several) lock.emplace(folder, FileLock::Wait::until_free);
  const bool others_wrote = look();
  add();
  if ((lock || !others_wrote) && !line.empty() && size_of(journal_of(file_)) + line.size() < size_of(file_)) {
    std::ranges::replace(line, '\n', ' ');
    append_line(journal_of(file_), line);
  } else {
    const std::string text = text_();
    need_readable_size(file_, text);
    write_file_atomically(file_, text);
    std::error_code ignored;
    fs::remove(journal_of(file_), ignored);
  }
  known_ = state();
}

}  // namespace soilbin::compare
