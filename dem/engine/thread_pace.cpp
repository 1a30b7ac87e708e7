#include "dem/engine/thread_pace.hpp"

#include <algorithm>

namespace soilbin::dem {
namespace {

constexpr double window = 0.5;      // [s]; a busy machine hands its cores on every few milliseconds
constexpr double fewest_steps = 4;  // a search now and then makes single steps long
constexpr double fed = 0.85;        // threads that got this share of a core each were not kept waiting
constexpr int wins_needed = 5, losses_allowed = 1;
constexpr double worth_it = 1.1;
constexpr double first_patience = 1, longest_patience = 64;  // [s]

}  // namespace

void ThreadPace::count_step(double wall, double processor) {
  if (most_ <= 1) return;
  ++steps_;
  wall_ += wall, processor_ += processor;
  if (wall_ >= window && steps_ >= fewest_steps) end_window();
}

void ThreadPace::end_window() {
  const bool starved = processor_ < fed * threads_ * wall_;
  if (other_ != 0) {
    Turns& turns = threads_ == kept_ ? of_kept_ : of_other_;
    turns.steps += steps_, turns.wall += wall_, turns.rate = steps_ / wall_;
    if (threads_ == other_) end_pair();
    if (other_ != 0) threads_ = threads_ == kept_ ? other_ : kept_;
  } else if ((since_trial_ += wall_) >= patience_) {
    other_ = starved && kept_ > 1 ? kept_ / 2 : std::min(2 * kept_, most_);
    if (other_ == kept_) other_ = 0;  // all of them, and none waits
  }
  steps_ = wall_ = processor_ = 0;
}

void ThreadPace::end_pair() {
  ++(of_other_.rate > of_kept_.rate ? wins_ : losses_);
  if (losses_ > losses_allowed)
    end_trial(false);
  else if (wins_ >= wins_needed)
    end_trial(of_other_.mean() > worth_it * of_kept_.mean());
}

void ThreadPace::end_trial(bool won) {
  if (won) kept_ = other_;
  patience_ = won ? first_patience : std::min(2 * patience_, longest_patience);
  threads_ = kept_;
  other_ = wins_ = losses_ = 0;
  since_trial_ = 0;
  of_kept_ = of_other_ = {};
}

}  // namespace soilbin::dem
