// A run in stages that goes on where it was, in the middle of a stage or between two, whoever moves its grains: the
// same calls come in the same order each time, and those of stages that are over do nothing. StagedRun (the engine) and
// LammpsRun (many processes) say how a step is made, what is looked after between steps, and where notes are kept.
//
//   run.keep("rig", rig);                                            // rig.state(notes) is found again here
//   run.once([&] { put_wheel(); });                                  // what was done before isn't done again
//   run.steps("lowering", 500, [&](std::int64_t k) { press(k); run.step(); });
//   run.loop("driving", [&] { return !over; }, [&] { drive(); run.step(); });
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "dem/archive/note_text.hpp"
#include "dem/archive/restart.hpp"
#include "dem/bed/work_options.hpp"

namespace soilbin::dem {

class RunStages {
 public:
  RunStages(const RunStages&) = delete;
  RunStages& operator=(const RunStages&) = delete;

  /// What a restart keeps beside the simulation, by part.state(notes) for writing and reading alike. Where the run goes
  /// on, `part` is what it was when this returns.
  template <class Part>
  void keep(const std::string& name, Part& part);

  /// Number of all steps that are to come, for the word about how far it is.
  void plan(double steps) { all_steps_ = steps; }

  /// Between two stages.
  void once(const std::function<void()>& what);
  /// `each` so many times; it gets which one, from 0, and takes a step.
  void steps(std::string_view stage, std::int64_t steps, const std::function<void(std::int64_t)>& each);
  /// `each` as long as `goes_on` holds. `share`: of the whole work that is done, where steps don't tell it.
  void loop(std::string_view stage, const std::function<bool()>& goes_on, const std::function<void()>& each,
            const std::function<double()>& share = {});

  /// Share of the planned steps that are taken.
  double done() const;
  /// On the clock on the wall before this run was gone on with [s].
  double earlier() const { return earlier_; }

  /// Where it is.
  template <class Notes>
  void state(Notes& notes) {
    notes(reached_, taken_, steps_, earlier_);
  }

 protected:
  RunStages() = default;
  ~RunStages() = default;

  virtual std::int64_t steps_between_looks() const { return 100; }
  /// Now and then between steps: words, stops, restarts.
  virtual void look(std::string_view stage, double share) = 0;
  /// The run goes on from these notes; `where`: the file that an error names.
  void go_on_from(Notes found, std::string where) { found_ = std::move(found), where_ = std::move(where); }
  /// The texts of all that is kept, by name.
  Notes kept_notes();
  void count_step() { ++steps_; }
  /// Puts it behind its last stage; whether it stood there before.
  bool end_stages();
  /// On the clock on the wall, with what it took before it was gone on with [s].
  double seconds() const;
  Progress progress(std::string_view stage, double share) const;

 private:
  struct Kept {
    std::string name;
    std::function<std::string()> text;
  };

  bool enters();

  std::vector<Kept> kept_;
  Notes found_;
  std::string where_;       ///< "" where the run begins anew
  int stage_ = 0;           ///< of those that were come by now
  int reached_ = 0;         ///< the one that it is in
  std::int64_t taken_ = 0;  ///< of its steps
  std::int64_t steps_ = 0;
  double all_steps_ = 1, earlier_ = 0;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

template <class Part>
void RunStages::keep(const std::string& name, Part& part) {
  kept_.push_back({name, [&part] {
                     NoteWriter writer;
                     part.state(writer);
                     return writer.text();
                   }});
  if (where_.empty()) return;
  NoteReader reader(where_ + ": " + name, found_[name]);
  part.state(reader);
  reader.end();
}

}  // namespace soilbin::dem
