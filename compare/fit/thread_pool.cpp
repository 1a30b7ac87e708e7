#include "compare/fit/thread_pool.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>
#include <vector>

namespace soilbin::compare {

void ThreadPool::each(int count, const std::function<void(int, const Pulse&)>& work) const {
  std::atomic<int> next{0};
  std::atomic<bool> stopped{false};
  std::exception_ptr failure;
  struct Stopped {};
  const auto halt = [&] {
    if (stopped) throw Stopped();
  };
  const auto take = [&](const Pulse& own) {
    for (int i = next++; i < count && !stopped; i = next++) try {
        work(i, own);
      } catch (const Stopped&) {
      } catch (...) {
        if (!stopped.exchange(true)) failure = std::current_exception();
      }
  };
  std::vector<std::thread> others;
  for (int t = 1; t < std::min(threads, count); ++t) others.emplace_back([&] { take(halt); });
  take([&] {
    halt();
    pulse();
  });
  for (std::thread& t : others) t.join();
  if (failure) std::rethrow_exception(failure);
}

int ThreadPool::share_of(int i, int count) const {
  const int all = std::max(1, threads), full_rounds = count / all * all;
  return i < full_rounds ? 1 : std::max(1, all / (count - full_rounds));
}

}  // namespace soilbin::compare
