// How many threads take a step while other programs use the cores too. A thread that waits for one without a core costs
// more than it brings, so the number follows from the steps a second that were measured:
//
//   ThreadPace pace(2);                              // at most two threads, and two to begin with
//   while (...) step_with(pace.threads()), pace.count_step(wall, processor);
#pragma once

namespace soilbin::dem {

/// Keeps the number of threads whose steps take the least time of the clock. Where the threads got less of the
/// processors than they could use, half of them are tried; where there are fewer than the most, twice as many. A trial
/// takes turns with what is kept, half a second each, since the share that a busy machine gives varies: it is won by
/// five turns of six and a tenth more steps a second, and lost by two turns. The time to the next trial starts at 1 s
/// and doubles with each one lost, to 64 s at most.
class ThreadPace {
 public:
  explicit ThreadPace(int most = 1) : most_(most), kept_(most), threads_(most) {}

  /// For the next step.
  int threads() const { return threads_; }
  /// What is kept, whatever is on trial.
  int kept() const { return kept_; }
  int most() const { return most_; }
  /// `wall`: what the step took by the clock [s]; `processor`: what all threads of the process took of the processors
  /// [s].
  void count_step(double wall, double processor);

 private:
  struct Turns {
    double steps = 0, wall = 0;  ///< of all turns
    double rate = 0;             ///< of the last one [steps/s]
    double mean() const { return steps / wall; }
  };

  void end_window();
  void end_pair();
  void end_trial(bool won);

  int most_, kept_, threads_;
  double steps_ = 0, wall_ = 0, processor_ = 0;  // of this window
  double since_trial_ = 0, patience_ = 1;
  int other_ = 0;  // on trial; 0: none
  Turns of_kept_, of_other_;
  int wins_ = 0, losses_ = 0;
};

}  // namespace soilbin::dem
