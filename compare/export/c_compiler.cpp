// Compiles C to a shared library by the machine's compiler.
#include <fcntl.h>
#include <fmt/core.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "compare/export/wheel_fmu.hpp"

namespace soilbin::compare {
namespace {

namespace fs = std::filesystem;

/// A folder that is gone when this is.
class FolderForCompiler {
 public:
  FolderForCompiler() {
    std::error_code none;
    std::string name = (fs::temp_directory_path(none) / "soilbin-cc-XXXXXX").string();
    if (!none && ::mkdtemp(name.data()) != nullptr) path_ = name;
  }
  FolderForCompiler(const FolderForCompiler&) = delete;
  FolderForCompiler& operator=(const FolderForCompiler&) = delete;
  ~FolderForCompiler() {
    std::error_code ignored;
    if (made()) fs::remove_all(path_, ignored);
  }
  bool made() const { return !path_.empty(); }
  fs::path operator/(const std::string& name) const { return path_ / name; }

 private:
  fs::path path_;
};

std::string whole_file(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// Runs a program without input; what it says goes to `said`. Its status, or -1 where it can't be started.
int run_quietly(std::vector<std::string> words, const fs::path& said) {
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, said.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  ::posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  pid_t id = -1;
  const int failed = ::posix_spawnp(&id, arguments[0], &actions, nullptr, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) return -1;
  int status = 0;
  while (::waitpid(id, &status, 0) < 0)
    if (errno != EINTR) return -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

CompiledC compiled_by_cc(const std::vector<PackedFile>& files, const std::string& main) {
  const FolderForCompiler folder;
  if (!folder.made()) return {std::nullopt, "no folder can be made for the compiler: TMPDIR names none"};
  for (const PackedFile& file : files) {
    std::ofstream out(folder / file.name, std::ios::binary);
    out << file.content;
    if (!out.flush()) return {std::nullopt, fmt::format("{} can't be written", (folder / file.name).string())};
  }
  const fs::path library = folder / "made.so", said = folder / "said";
  const int status = run_quietly({"cc", "-std=c99", "-O2", "-fPIC", "-shared", "-fvisibility=hidden", "-o",
                                  library.string(), (folder / main).string(), "-lm"},
                                 said);
  if (status == 0) return {whole_file(library), ""};
  constexpr int not_found = 127;  // of a spawned program, where the system tells it so
  if (status < 0 || status == not_found) return {std::nullopt, "there is no compiler 'cc' here"};
  const std::string words = whole_file(said);
  return {std::nullopt, fmt::format("'cc' failed with status {}: {}", status, words.substr(0, words.find('\n')))};
}

}  // namespace soilbin::compare
