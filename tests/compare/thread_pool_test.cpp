// Pieces of work that several threads share.
#include "compare/fit/thread_pool.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

namespace soilbin::compare {
namespace {

TEST(ThreadPool, DoesEveryPieceOnce) {
  for (const int threads : {0, 1, 2, 7}) {
    std::vector<std::atomic<int>> done(100);
    ThreadPool{.threads = threads}.each(100, [&](int i, const Pulse& pulse) {
      pulse();
      ++done[static_cast<std::size_t>(i)];
    });
    for (const auto& times : done) EXPECT_EQ(times, 1);
  }
  ThreadPool{.threads = 3}.each(0, [](int, const Pulse&) { FAIL(); });
}

// Five folds on two cores: the fifth has both. On sixteen each has three.
TEST(ThreadPool, GivesThePiecesOfALastRoundTheThreadsThatAreIdle) {
  const auto shares = [](int threads) {
    std::vector<int> of;
    for (int i = 0; i < 5; ++i) of.push_back(ThreadPool{.threads = threads}.share_of(i, 5));
    return of;
  };
  EXPECT_EQ(shares(2), (std::vector<int>{1, 1, 1, 1, 2}));
  EXPECT_EQ(shares(16), std::vector<int>(5, 3));
  for (const int threads : {0, 1, 3, 5}) EXPECT_EQ(shares(threads), std::vector<int>(5, 1)) << threads;
}

// Progress is written by one thread.
TEST(ThreadPool, CallsItsPulseOnTheCallersThreadAlone) {
  const std::thread::id caller = std::this_thread::get_id();
  int pulses = 0;
  const ThreadPool pool{3, [&] {
                          EXPECT_EQ(std::this_thread::get_id(), caller);
                          ++pulses;
                        }};
  pool.each(50, [](int, const Pulse& pulse) {
    for (int k = 0; k < 3; ++k) pulse();
  });
  EXPECT_LE(pulses, 150);
}

TEST(ThreadPool, ThrowsThePieceThatFailedAndStartsNoMore) {
  std::atomic<int> started{0};
  const auto work = [&](int i, const Pulse&) {
    ++started;
    if (i == 3) throw std::runtime_error("the fourth");
  };
  EXPECT_THROW(ThreadPool{.threads = 1}.each(1000, work), std::runtime_error);
  EXPECT_EQ(started, 4);
}

// Ctrl-C: what the caller's pulse throws ends the pieces of all threads at their next pulse.
TEST(ThreadPool, EndsEveryThreadWhenThePulseThrows) {
  struct Interrupted {};
  const ThreadPool pool{3, [] { throw Interrupted(); }};
  const auto until_stopped = [](int, const Pulse& pulse) {
    while (true) pulse();
  };
  EXPECT_THROW(pool.each(3, until_stopped), Interrupted);
}

}  // namespace
}  // namespace soilbin::compare
