// Which stage a run is in, for runs that go on where they were: the same calls come in the same order each time, and
// those of stages that are over do nothing.
//
//   if (counter.enters()) work();          // a stage without steps
//   if (counter.enters())
//     for (; goes_on(); ++counter.taken) step();
#pragma once

#include <cstdint>

namespace soilbin::dem {

struct StageCounter {
  int stage = 0;           ///< of those that were come by now
  int reached = 0;         ///< the one that it is in; kept in a restart
  std::int64_t taken = 0;  ///< of its steps; kept in a restart

  /// Whether the next stage is still to be done, or to be gone on with.
  bool enters() {
    ++stage;
    if (stage > reached) reached = stage, taken = 0;
    return stage == reached;
  }
};

}  // namespace soilbin::dem
