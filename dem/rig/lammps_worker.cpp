#include "dem/rig/lammps_worker.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <memory>
#include <optional>
#include <sstream>

#include "dem/bed/bed_store.hpp"
#include "dem/rig/bed_job.hpp"
#include "dem/rig/run_inputs.hpp"
#include "dem/rig/wheel_job.hpp"
#include "scenario/atomic_file.hpp"
#include "scenario/errors.hpp"
#include "scenario/estimate.hpp"
#include "scenario/file_bytes.hpp"
#include "scenario/file_lock.hpp"
#include "scenario/quantity.hpp"

namespace soilbin::dem {

namespace fs = std::filesystem;

namespace {

constexpr int answered = 0, stopped = 3;  // exit statuses of the worker

/// A process in a group of its own, so that Ctrl-C reaches the command alone; its standard output is read here, its
/// standard error goes to a file.
class Child {
 public:
  Child(const std::vector<std::string>& words, const fs::path& errors);
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child();

  /// The next line, "" where none came within `wait` [s], none at the end.
  std::optional<std::string> line(double wait);
  void signal(int number) const { ::kill(id_, number); }
  /// Exit status, or 128 and the number of the signal that ended it.
  int end();

 private:
  pid_t id_ = -1;
  int output_ = -1;
  std::string read_;
};

Child::Child(const std::vector<std::string>& words, const fs::path& errors) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error(fmt::format("no pipe: {}", std::strerror(errno)));
  output_ = ends[0];
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawnattr_t group;
  posix_spawnattr_init(&group);
  posix_spawnattr_setflags(&group, POSIX_SPAWN_SETPGROUP);
  posix_spawnattr_setpgroup(&group, 0);
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const int failed = ::posix_spawnp(&id_, arguments[0], &actions, &group, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&group);
  ::close(ends[1]);
  if (failed == 0) return;
  ::close(output_);
  throw std::runtime_error(fmt::format(
      "{} can't be started: {}\n  hint: install MPI (mpi-default-bin), or name what starts processes here in "
      "SOILBIN_MPIRUN",
      words.front(), std::strerror(failed)));
}

Child::~Child() {
  ::close(output_);
  if (id_ > 0) {
    signal(SIGTERM);
    end();
  }
}

std::optional<std::string> Child::line(double wait) {
  while (true) {
    if (const std::size_t end = read_.find('\n'); end != std::string::npos) {
      std::string line = read_.substr(0, end);
      read_.erase(0, end + 1);
      return line;
    }
    pollfd ready{output_, POLLIN, 0};
    if (::poll(&ready, 1, static_cast<int>(1000 * wait)) <= 0) return "";
    std::array<char, 4096> bytes{};
    const ssize_t count = ::read(output_, bytes.data(), bytes.size());
    if (count <= 0) return std::nullopt;
    read_.append(bytes.data(), static_cast<std::size_t>(count));
  }
}

int Child::end() {
  int status = 0;
  while (::waitpid(id_, &status, 0) < 0 && errno == EINTR) {}
  id_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

std::string text_of(const fs::path& file) {
  constexpr std::size_t largest = std::size_t{1} << 20;
  try {
    return fs::exists(file) ? read_bytes(file, largest) : "";
  } catch (const std::runtime_error&) {
    return "";
  }
}

/// The last lines that say something, indented.
std::string last_lines(const fs::path& file) {
  constexpr std::size_t most = 6;
  std::vector<std::string> lines;
  std::istringstream text(text_of(file));
  for (std::string line; std::getline(text, line);)
    if (line.find_first_not_of("- \t\r") != std::string::npos) lines.push_back(line);
  std::string last;
  for (std::size_t k = lines.size() > most ? lines.size() - most : 0; k < lines.size(); ++k) last += "\n  " + lines[k];
  return last;
}

/// What the worker says of its progress: 'progress STAGE SHARE SECONDS', the stage of several words.
std::optional<Progress> progress_in(const std::string& line, std::string& stage) {
  std::istringstream words(line);
  std::vector<std::string> all;
  for (std::string word; words >> word;) all.push_back(word);
  if (all.size() < 4 || all[0] != "progress") return std::nullopt;
  stage.clear();
  for (std::size_t k = 1; k + 2 < all.size(); ++k) stage += (k > 1 ? " " : "") + all[k];
  return Progress{stage, read_number(all[all.size() - 2]).value_or(0.0), read_number(all.back()).value_or(0.0)};
}

/// Hands on what the worker says until it ends; gives its exit status. Whatever `how` throws stops the worker first.
/// Throws Stopped where someone else stopped it.
int follow(Child& child, const WorkOptions& how, const std::function<void()>& when_stopped) {
  constexpr double between_looks = 0.2;  // [s]
  std::string stage = "starting LAMMPS";
  Progress last{stage, 0, not_a_number};
  while (true) {
    const std::optional<std::string> line = child.line(between_looks);
    if (!line) {
      const int status = child.end();
      if (status != stopped) return status;
      when_stopped();
      throw Stopped();
    }
    if (const std::optional<Progress> now = progress_in(*line, stage))
      last = *now;
    else if (!line->empty() && how.tell)
      how.tell("lammps: " + *line);
    try {
      if (how.stop.stop_requested()) throw Stopped();
      if (how.progress && last.done < 1) how.progress(last);
    } catch (...) {
      child.signal(SIGUSR1);  // mpirun hands it on
      while (child.line(between_looks)) {}
      child.end();
      when_stopped();
      throw;
    }
  }
}

/// What the worker wrote instead of an answer.
[[noreturn]] void throw_error_of(const fs::path& folder, int status, int ranks) {
  const std::string text = text_of(folder / "error.txt");
  if (const std::size_t line = text.find('\n'); line != std::string::npos) {
    const std::string kind = text.substr(0, line);
    const std::string words = text.substr(line + 1, text.find_last_not_of('\n') - line);
    if (kind == "input") throw InputError(words);
    if (kind == "no_solution") throw NoSolution(words);
    if (kind == "stopped") throw RunStopped(words);
  }
  const std::string launcher = text_of(folder / "stderr.txt");
  if (launcher.find("allow-run-as-root") != std::string::npos)
    throw std::runtime_error(
        "mpirun starts nothing as root\n  hint: another user, or SOILBIN_MPIRUN=\"mpirun --allow-run-as-root\"");
  if (launcher.find("not enough slots") != std::string::npos)
    throw std::runtime_error(
        fmt::format("mpirun finds no room for {} processes on this machine\n  hint: fewer --ranks, "
                    "or SOILBIN_MPIRUN=\"mpirun --oversubscribe\"",
                    ranks));
  throw std::runtime_error(fmt::format("soilbin-lammps ended without an answer, on {} {}, exit status {}{}{}", ranks,
                                       ranks == 1 ? "process" : "processes", status, last_lines(folder / "log.lammps"),
                                       last_lines(folder / "stderr.txt")));
}

void refuse_what_it_lacks(const Rig& rig) {
  if (rig.onlooker.look)
    throw InputError("runs in LAMMPS keep no motion of the grains\n  hint: leave out --replay and --paraview");
  if (rig.patch) throw InputError("runs in LAMMPS have no moving patch\n  hint: leave out --engine lammps");
  if (rig.ledger) throw InputError("runs in LAMMPS keep no ledger of energy");
}

/// The folder, and its lock. Without a name a new one, which goes when the run does.
class JobFolder {
 public:
  explicit JobFolder(const fs::path& named) : path_(named), stays_(!named.empty()) {
    if (!stays_) {
      std::string name = (fs::temp_directory_path() / "soilbin-lammps-XXXXXX").string();
      if (!::mkdtemp(name.data())) throw std::runtime_error(fmt::format("{}: {}", name, std::strerror(errno)));
      path_ = name;
    }
    make_folder(path_);
    lock_ = std::make_unique<const FileLock>(lammps_lock(path_), FileLock::Wait::no);
    if (!lock_->is_held()) throw std::runtime_error(fmt::format("{}: another process is at this run", path_.string()));
  }
  JobFolder(const JobFolder&) = delete;
  JobFolder& operator=(const JobFolder&) = delete;
  ~JobFolder() {
    std::error_code gone_already;
    if (!stays_) fs::remove_all(path_, gone_already);
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
  bool stays_;
  std::unique_ptr<const FileLock> lock_;
};

}  // namespace

fs::path lammps_lock(const fs::path& folder) { return folder / "lock"; }

fs::path lammps_folder(const fs::path& restart) {
  if (restart.empty()) return {};
  const std::string stem = restart.stem().string();
  const std::size_t dash = stem.find('-');
  return restart.parent_path() / ("lammps-" + (dash == std::string::npos ? stem : stem.substr(dash + 1)));
}

namespace {

void refuse_without_program(const LammpsWorker& worker) {
  if (!fs::exists(worker.program))
    throw InputError(
        fmt::format("{} is not there\n  hint: install liblammps-dev and mpi-default-dev, and build soilbin again",
                    worker.program.string()));
}

/// Has the job in this folder done, until the file `answer` is there.
void work_in(const fs::path& folder, const fs::path& answer, const LammpsWorker& worker, const WorkOptions& how,
             const std::function<void(const std::string&)>& tell) {
  fs::remove(folder / "error.txt");
  std::vector<std::string> words;
  std::istringstream launcher(worker.launcher);
  for (std::string word; launcher >> word;) words.push_back(word);
  if (words.empty()) throw InputError("nothing is named that starts processes\n  hint: SOILBIN_MPIRUN=mpirun");
  words.insert(words.end(), {"-n", std::to_string(worker.ranks), worker.program.string(), folder.string()});
  Child child(words, folder / "stderr.txt");
  const int status = follow(child, how, [&] {
    if (tell && fs::exists(folder / "state")) tell("the work in LAMMPS is kept: the same command goes on from there");
  });
  if (status != answered || !fs::exists(answer)) throw_error_of(folder, status, worker.ranks);
}

}  // namespace

SettledBed bed_in_lammps(const LammpsWorker& worker, const BedRecipe& recipe, const fs::path& beds,
                         const WorkOptions& how) {
  check(recipe);
  if (beds.empty())
    throw InputError("there is no folder for the bed that LAMMPS settles\n  hint: export SOILBIN_BEDS=FOLDER");
  const fs::path report = fs::absolute(BedStore(beds).file(recipe)), folder = report.parent_path();
  if (!fs::exists(report)) {
    refuse_without_program(worker);
    const JobFolder held(folder);
    if (!fs::exists(report)) {
      write_bed_job(folder, recipe);
      work_in(folder, report, worker, how, how.tell);
    }
  }
  SettledBed bed{.recipe = recipe,
                 .setup = setup_of(recipe, how.threads),
                 .state = {},
                 .report = read_bed_report(folder),
                 .grains_in = folder};
  bed.state.gravity = {0, 0, -recipe.gravity}, bed.state.bodies = {bin_of(recipe.size)};
  return bed;
}

WheelRun run_in_lammps(const LammpsWorker& worker, const WheelOnBed& on, const OperatingCondition& at,
                       const WorkOptions& how, const Checkpoints& checkpoints) {
  refuse_what_it_lacks(on.rig);
  refuse_without_program(worker);
  const JobFolder folder(lammps_folder(checkpoints.restart));
  const fs::path answer = folder.path() / "answer.txt";
  if (!fs::exists(answer)) {
    write_job(folder.path() / "job.h5", on, at, inputs_text(on.bed.recipe, on.tire, on.contact, on.rig, at));
    work_in(folder.path(), answer, worker, how, checkpoints.tell);
  }
  if (how.progress) how.progress({"done", 1, 0});
  return read_answer(answer, on.tire, at, on.rig);
}

}  // namespace soilbin::dem
