// Runs in stages that are stopped or killed, and go on.
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

#include "dem/archive/sealed_file.hpp"
#include "dem/rig/staged_run.hpp"
#include "scenario/errors.hpp"
#include "tests/dem/archive_scene.hpp"
#include "tests/dem/small_bed.hpp"

namespace soilbin::dem {
namespace {

using test::Bits;
using test::Folder;
using test::read_bytes;
using test::scene;
using test::write_bytes;
using ::testing::HasSubstr;

constexpr std::int64_t target = 6000, between_restarts = 100;
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

/// The wheel is sped up, and the step is told.
void run_in(const std::filesystem::path& folder, const SharedStep* told,
            const WorkOptions& how = test::with_threads(1)) {
  const Checkpoints kept{folder / "run.h5", 0, between_restarts};
  StagedRun run(kept, "a wheel that is sped up", how, [] { return scene(); });
  run.plan(target);
  run.through([&] {
    run.once([&] { run.simulation().body(1).velocity.x = 0.1; });
    run.steps("speeding up", target, [&](std::int64_t step) {
      run.simulation().body(1).spin.y = 3 + 0.002 * static_cast<double>(step);
      run.step();
      if (told) **told = step + 1;
    });
  });
}

/// The program that is killed: this one, asked by its environment.
class Child : public ::testing::Environment {
 public:
  void SetUp() override {
    const char* folder = std::getenv(child_folder);
    if (!folder) return;
    const SharedStep told(std::filesystem::path(folder) / "step");
    run_in(folder, &told);
    std::_Exit(0);
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
}

TEST(SlowResumable, SurvivesKill9AtAnyMoment) {
  const Folder whole, killed;
  run_in(whole.path(), nullptr);

  const SharedStep told(killed / "step");
  std::mt19937 random(3);
  int kills = 0, status = 0;
  for (bool done = false; !done;) {
    *told = 0;
    const pid_t child = start_child(killed.path());
    ASSERT_GT(child, 0);
    // A few steps on, at some moment of a step or of the writing after it.
    done = ended_before(child, told, kills < 15 ? 1 + random() % 300 : 2 * target, status);
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
}

TEST(Resumable, StopsWhenAskedAndGoesOn) {
  const Folder whole, halted;
  run_in(whole.path(), nullptr);
  std::stop_source stop;
  WorkOptions how = test::with_threads(1);
  how.stop = stop.get_token();
  how.progress = [&](const Progress& progress) {
    if (progress.done > 0.3) stop.request_stop();
  };
  EXPECT_THROW(run_in(halted.path(), nullptr, how), Stopped);
  const Start again = resume_or_start(halted / "run.h5", [] { return scene(60); });
  EXPECT_EQ(again.simulation.state().step, 2000);  // of 6000; asked for at 1900, it looks each 100
  EXPECT_THAT(again.message, HasSubstr("run.h5, step 2000"));
  run_in(halted.path(), nullptr);
  EXPECT_EQ(Bits(read_restart(halted / "run.h5").state), Bits(read_restart(whole / "run.h5").state));
}

TEST(Resumable, WritesByTheClock) {
  const Folder folder;
  const Checkpoints each_time{folder / "run.h5", 1e-9, 0}, never{folder / "run.h5", 1e9, 0};
  EXPECT_TRUE(Checkpointer(each_time, 0).is_due(1));
  EXPECT_FALSE(Checkpointer(never, 0).is_due(1));
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
  EXPECT_THAT(start.message, HasSubstr("is no soilbin restart"));
  EXPECT_THAT(start.message, HasSubstr("run.h5.previous, step 30"));
}

}  // namespace
}  // namespace soilbin::dem
