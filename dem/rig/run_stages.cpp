#include "dem/rig/run_stages.hpp"

#include <algorithm>
#include <utility>

#include "scenario/estimate.hpp"

namespace soilbin::dem {

/// Whether the next stage is still to be done, or to be gone on with.
bool RunStages::enters() {
  ++stage_;
  if (stage_ > reached_) reached_ = stage_, taken_ = 0;
  return stage_ == reached_;
}

void RunStages::once(const std::function<void()>& what) {
  if (enters()) what();
}

void RunStages::steps(std::string_view stage, std::int64_t steps, const std::function<void(std::int64_t)>& each) {
  loop(
      stage, [&] { return taken_ < steps; }, [&] { each(taken_); });
}

void RunStages::loop(std::string_view stage, const std::function<bool()>& goes_on, const std::function<void()>& each,
                     const std::function<double()>& share) {
  if (!enters()) return;
  const std::int64_t between_looks = steps_between_looks();
  for (; goes_on(); ++taken_) {
    if (taken_ % between_looks == 0) look(stage, share ? share() : done());
    each();
  }
}

bool RunStages::end_stages() {
  const bool was_through = reached_ > stage_;
  reached_ = stage_ + 1, taken_ = 0;
  return was_through;
}

Notes RunStages::kept_notes() {
  const double before = std::exchange(earlier_, seconds());
  Notes notes;
  for (const Kept& part : kept_) notes[part.name] = part.text();
  earlier_ = before;
  return notes;
}

double RunStages::done() const { return std::min(1.0, static_cast<double>(steps_) / all_steps_); }

double RunStages::seconds() const {
  return earlier_ + std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
}

Progress RunStages::progress(std::string_view stage, double share) const {
  const bool is_of_steps = all_steps_ > 1;  // without a plan it tells no time
  return {stage, share, share > 0 && is_of_steps ? seconds() * (1 - share) / share : not_a_number};
}

}  // namespace soilbin::dem
