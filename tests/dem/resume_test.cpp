// Runs that are stopped, fail or are killed, and go on.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <random>
#include <thread>

#include "dem/archive/resumable_run.hpp"
#include "dem/archive/sealed_file.hpp"
#include "dem/archive/trajectory.hpp"
#include "scenario/errors.hpp"
#include "tests/dem/archive_scene.hpp"

namespace soilbin::dem {
namespace {

using test::Bits;
using test::Folder;
using test::read_bytes;
using test::scene;
using test::write_bytes;
using ::testing::HasSubstr;

constexpr std::int64_t target = 400, between_restarts = 7, between_frames = 20;
constexpr const char* child_folder = "SOILBIN_RESUME_TEST_FOLDER";

/// A number that outlives whoever writes it.
class SharedStep {
 public:
  explicit SharedStep(const std::filesystem::path& path) {
    const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (file < 0 || ::ftruncate(file, sizeof(std::int64_t)) != 0) std::abort();
    at_ = ::mmap(nullptr, sizeof(std::int64_t), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    ::close(file);
    if (at_ == MAP_FAILED) std::abort();
  }
  SharedStep(const SharedStep&) = delete;
  SharedStep& operator=(const SharedStep&) = delete;
  ~SharedStep() { ::munmap(at_, sizeof(std::int64_t)); }
  std::atomic_ref<std::int64_t> operator*() const { return std::atomic_ref(*static_cast<std::int64_t*>(at_)); }

 private:
  void* at_;
};

/// What drives the run: the wheel is sped up, frames are written, and the step is told.
void drive(Simulation& simulation, const std::filesystem::path& folder, const SharedStep* told) {
  const std::int64_t step = simulation.state().step;
  simulation.body(1).spin.y = 3 + 0.01 * static_cast<double>(step);
  if (step % between_frames == 0) write_frame(folder / "frames", simulation.setup(), simulation.state());
  if (told) **told = step;
}

RunEnd run_in(const std::filesystem::path& folder, const SharedStep* told, const std::atomic<bool>& stop) {
  Start start = resume_or_start(folder / "run.h5", [] { return scene(60); });
  const Driver driver{[&](Simulation& simulation) { drive(simulation, folder, told); }, {}};
  return run_resumably(start.simulation, target, {folder / "run.h5", 0, between_restarts}, stop, driver);
}

/// The program that is killed: this one, asked by its environment.
class Child : public ::testing::Environment {
 public:
  void SetUp() override {
    const char* folder = std::getenv(child_folder);
    if (!folder) return;
    const SharedStep told(std::filesystem::path(folder) / "step");
    const std::atomic<bool> never = false;
    std::_Exit(run_in(folder, &told, never) == RunEnd::reached ? 0 : 1);
  }
};
const ::testing::Environment* const child_environment = ::testing::AddGlobalTestEnvironment(new Child);

pid_t start_child(const std::filesystem::path& folder) {
  const std::string variable = std::string(child_folder) + "=" + folder.string();
  std::vector<char*> environment;
  for (char** entry = environ; *entry; ++entry) environment.push_back(*entry);
  environment.push_back(const_cast<char*>(variable.c_str()));
  environment.push_back(nullptr);
  std::string filter = "--gtest_filter=SlowResumable.SurvivesKill9AtAnyMoment", name = "child";
  char* const arguments[] = {name.data(), filter.data(), nullptr};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = -1;
  const int failed = ::posix_spawn(&child, "/proc/self/exe", &actions, nullptr, arguments, environment.data());
  posix_spawn_file_actions_destroy(&actions);
  return failed == 0 ? child : -1;
}

/// Waits until the child has come `steps` farther, or has ended; gives its status where it has.
bool ended_before(pid_t child, const SharedStep& told, std::int64_t steps, int& status) {
  const std::int64_t from = *told;
  while (true) {
    if (::waitpid(child, &status, WNOHANG) == child) return true;
    const std::int64_t now = *told;
    if (now < from ? now >= steps : now - from >= steps) return false;
    std::this_thread::sleep_for(std::chrono::microseconds(50));
  }
}

/// What must hold after each kill.
void check_after_kill(const Folder& folder, std::int64_t reached) {
  if (has_restart(folder / "run.h5")) {
    const LastGood found = read_last_good(folder / "run.h5");
    EXPECT_EQ(found.warning, "");  // the last one is there and whole, always
    EXPECT_GE(found.restart.state.step, reached - between_restarts);
  } else {
    EXPECT_LE(reached, between_restarts);
  }
  const auto frames = frames_of(folder / "frames");
  EXPECT_GE(frames.size(), static_cast<std::size_t>(reached / between_frames + 1));
  for (const auto& frame : frames) EXPECT_NO_THROW(read_frame(frame));
}

TEST(SlowResumable, SurvivesKill9AtAnyMoment) {
  const std::atomic<bool> never = false;
  const Folder whole, killed;
  ASSERT_EQ(run_in(whole.path(), nullptr, never), RunEnd::reached);

  const SharedStep told(killed / "step");
  std::mt19937 random(3);
  int kills = 0, status = 0;
  for (bool done = false; !done;) {
    *told = 0;
    const pid_t child = start_child(killed.path());
    ASSERT_GT(child, 0);
    // A few steps on, at some moment of a step or of the writing after it.
    done = ended_before(child, told, kills < 15 ? 1 + random() % 40 : 2 * target, status);
    if (done) break;
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 6000));
    ::kill(child, SIGKILL);
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    if (WIFEXITED(status)) break;  // it was faster
    ++kills;
    check_after_kill(killed, *told);
  }
  ASSERT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  EXPECT_GE(kills, 5);

  const State through = read_restart(whole / "run.h5").state, back = read_restart(killed / "run.h5").state;
  EXPECT_EQ(back.step, target);
  EXPECT_EQ(Bits(back), Bits(through));
  EXPECT_TRUE(read_bytes(killed / "run.h5") == read_bytes(whole / "run.h5"));
  const auto frames = frames_of(whole / "frames");
  ASSERT_EQ(frames.size(), static_cast<std::size_t>(target / between_frames + 1));
  for (const auto& frame : frames)
    EXPECT_TRUE(read_bytes(frame) == read_bytes(killed / ("frames/" + frame.filename().string())));
}

TEST(Resumable, StopsWhenAskedAndGoesOn) {
  const Folder whole, halted;
  const std::atomic<bool> never = false;
  ASSERT_EQ(run_in(whole.path(), nullptr, never), RunEnd::reached);
  std::atomic<bool> stop = false;
  Start start = resume_or_start(halted / "run.h5", [] { return scene(60); });
  EXPECT_EQ(start.told, "");
  const Driver driver{[&](Simulation& simulation) {
                        drive(simulation, halted.path(), nullptr);
                        if (simulation.state().step == 123) stop = true;
                      },
                      [] {
                        return Notes{{"phase", "one"}};
                      }};
  EXPECT_EQ(run_resumably(start.simulation, target, {halted / "run.h5", 0, 0}, stop, driver), RunEnd::interrupted);
  const Start again = resume_or_start(halted / "run.h5", [] { return scene(60); });
  EXPECT_EQ(again.simulation.state().step, 124);
  EXPECT_THAT(again.told, HasSubstr("run.h5, step 124"));
  EXPECT_EQ(again.notes, (Notes{{"phase", "one"}}));
  EXPECT_EQ(run_in(halted.path(), nullptr, never), RunEnd::reached);
  EXPECT_EQ(Bits(read_restart(halted / "run.h5").state), Bits(read_restart(whole / "run.h5").state));
}

TEST(Resumable, WritesByTheClock) {
  Simulation simulation = scene(20);
  const Folder folder;
  const std::atomic<bool> never = false;
  int restarts = 0;
  const Driver driver{{}, [&] {
                        ++restarts;
                        return Notes{};
                      }};
  run_resumably(simulation, 10, {folder / "run.h5", 1e-9, 0}, never, driver);
  EXPECT_EQ(restarts, 10);
  run_resumably(simulation, 60, {folder / "run.h5", 1e9, 0}, never, driver);
  EXPECT_EQ(restarts, 11);
}

TEST(Resumable, KeepsTheStateOfARunThatCannotGoOn) {
  Simulation simulation = scene(60);
  const Folder folder;
  const std::atomic<bool> never = false;
  const Driver driver{[](Simulation& now) {
                        if (now.state().step == 20) now.body(2).velocity = {0, 0, -300};  // the block falls
                      },
                      {}};
  std::string message;
  try {
    run_resumably(simulation, target, {folder / "run.h5", 0, 10}, never, driver);
  } catch (const RunStopped& stopped) {
    message = stopped.what();
  }
  EXPECT_THAT(message, HasSubstr("time "));
  EXPECT_THAT(message, HasSubstr("its state is in " + (folder / "run.h5.stopped").string()));
  const State kept = read_restart(folder / "run.h5.stopped").state;
  EXPECT_EQ(Bits(kept), Bits(simulation.state()));
  EXPECT_GT(kept.step, 20);
  EXPECT_LT(read_restart(folder / "run.h5").state.step, kept.step);
}

TEST(Resumable, NeverStartsAnewByMistake) {
  const Folder folder;
  write_bytes(folder / "run.h5", "not whole");
  EXPECT_THROW(resume_or_start(folder / "run.h5", [] { return scene(20); }), InputError);
  // The one before is good: it goes on from there, and says so.
  Simulation simulation = scene(20);
  simulation.run(30);
  write_restart(previous_of(folder / "run.h5"), simulation.setup(), simulation.state());
  const Start start = resume_or_start(folder / "run.h5", [] { return scene(20); });
  EXPECT_EQ(start.simulation.state().step, 30);
  EXPECT_THAT(start.told, HasSubstr("is no soilbin restart"));
  EXPECT_THAT(start.told, HasSubstr("run.h5.previous, step 30"));
}

}  // namespace
}  // namespace soilbin::dem
