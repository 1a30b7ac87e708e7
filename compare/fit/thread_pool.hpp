// Independent pieces of work, several at once: the time changes, never the result.
#pragma once

#include <functional>

namespace soilbin::compare {

/// What a piece of work calls now and then; may throw to stop it.
using Pulse = std::function<void()>;

/// How many threads work at once, and what they call meanwhile.
struct ThreadPool {
  int threads = 1;
  Pulse pulse = [] {};  ///< on the caller's thread alone
  /// work(i, pulse) for every i from 0 to count - 1. The first exception of any stops the others at their next pulse
  /// and is thrown when all have ended.
  void each(int count, const std::function<void(int, const Pulse&)>& work) const;
  /// Threads that piece i of `count` may use itself: pieces of a last round that isn't full find some idle.
  int share_of(int i, int count) const;
};

}  // namespace soilbin::compare
