// How long work is done and watched: threads, progress, a stop from outside. Nothing here changes a result.
#pragma once

#include <functional>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <string_view>

namespace soilbin::dem {

/// Told now and then during long work.
struct Progress {
  std::string_view stage;   ///< "settling", "lowering", "driving", ...
  double done = 0;          ///< share of the whole work
  double seconds_left = 0;  ///< estimated, of the clock on the wall; NaN while unknown
};

struct WorkOptions {
  int threads = 0;  ///< 0: one a core, fewer for few grains (Numerics)
  std::function<void(const Progress&)> progress;
  std::stop_token stop;
  /// Gets what a person should know and that stops nothing: a bed that couldn't be kept, say.
  std::function<void(const std::string&)> tell{};
};

/// The work was stopped from outside.
class Stopped : public std::runtime_error {
 public:
  Stopped() : std::runtime_error("stopped") {}
};

}  // namespace soilbin::dem
